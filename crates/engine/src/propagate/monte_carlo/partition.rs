//! A partition of the line into cells that can be made finer where it matters.
//!
//! Where more values would have to be kept than memory allows, they are counted in cells instead;
//! later passes regenerate them and keep, or count more finely, only what lies in the few cells on
//! which the wanted order statistics depend.

use super::parts::{ByteReader, Damaged, Writer};
use super::sorting::sort;

/// Cells of the first pass.
const FIRST_CELLS: usize = 1 << 14;

/// Cells of a partition that is read, at most: some times as many as passes make.
const MOST_CELLS: usize = 1 << 23;

/// Grids within each other in a partition that is read, at most: each pass adds one.
const DEEPEST: usize = 32;

/// Values that are looked up together.
const TOGETHER: usize = 256;

/// What becomes of the values in a cell.
#[derive(Clone, Debug)]
enum Cell {
    /// They are counted.
    Count,
    /// They are counted and kept.
    Keep,
    /// They are counted in the cells of a finer grid.
    Split(Box<Grid>),
}

/// Equal cells from `low` on; the first and the last reach to infinity.
#[derive(Clone, Debug)]
struct Grid {
    low: f64,
    inverse: f64,
    cells: Vec<Cell>,
}

/// The partition of one output's values.
#[derive(Clone, Debug)]
pub(super) struct Partition {
    root: Grid,
    index: Index,
}

/// The cells as values are looked up: a pass does so for each of them, which is most of its time, so
/// that what it touches has to be small.
#[derive(Clone, Debug, Default)]
struct Index {
    /// The cells of all grids one behind the other, four bytes for each.
    slots: Vec<Slot>,
    /// The root first.
    grids: Vec<GridIndex>,
    leaves: usize,
}

/// What becomes of the values in a cell, in the lowest two bits, and above them the number of the leaf,
/// or of the finer grid.
#[derive(Clone, Copy, Debug)]
struct Slot(u32);

/// A grid of the index.
#[derive(Clone, Copy, Debug)]
struct GridIndex {
    low: f64,
    inverse: f64,
    /// The place of its first cell, and how many come behind that.
    first: usize,
    last: usize,
}

/// What one pass over the trials found.
#[derive(Clone, Debug)]
pub(super) struct PassTally {
    leaves: Vec<Counted>,
    kept: Vec<f64>,
}

/// The number of values in a leaf, the least and the greatest.
#[derive(Clone, Copy, Debug)]
struct Counted {
    count: u64,
    extremes: [f64; 2],
}

/// A leaf of the partition after a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leaf {
    /// Number of values.
    pub(super) count: u64,
    /// Number of values in the leaves below it.
    pub(super) below: u64,
    /// The least and the greatest value.
    pub(super) least: f64,
    pub(super) greatest: f64,
    /// Index of its first value among the kept ones, if they were kept.
    pub(super) kept: Option<usize>,
}

impl Grid {
    fn new(low: f64, high: f64, cells: usize) -> Self {
        let inverse = cells as f64 / (high - low);
        // cells narrower than the spacing of numbers would be all the same
        let inverse = if inverse.is_finite() { inverse } else { 0.0 };
        Self { low, inverse, cells: vec![Cell::Count; cells] }
    }

    fn visit<'g>(&'g mut self, out: &mut Vec<&'g mut Cell>) {
        for cell in &mut self.cells {
            match cell {
                Cell::Split(grid) => grid.visit(out),
                other => out.push(other),
            }
        }
    }

    fn kept(&self, out: &mut Vec<bool>) {
        for cell in &self.cells {
            match cell {
                Cell::Split(grid) => grid.kept(out),
                other => out.push(matches!(other, Cell::Keep)),
            }
        }
    }

    /// Cells of one kind in a row are written as their number.
    fn write(&self, out: &mut Writer) {
        out.reals(&[self.low, self.inverse]);
        out.number(self.cells.len() as u64);
        for same in self.cells.chunk_by(Cell::is_alike) {
            match &same[0] {
                Cell::Split(grid) => {
                    out.number(0);
                    grid.write(out);
                }
                Cell::Count => out.number(2 * same.len() as u64 - 1),
                Cell::Keep => out.number(2 * same.len() as u64),
            }
        }
    }

    /// A grid of at most so many cells, those within it included, which are then fewer.
    fn read(from: &mut ByteReader<'_>, room: &mut usize, depth: usize) -> Result<Self, Damaged> {
        let [low, inverse] = from.reals()?;
        let count = from.at_most(*room as u64, "too many cells")? as usize;
        Damaged::unless(count > 0 && depth <= DEEPEST, "no cells")?;
        *room -= count;
        let mut cells = Vec::with_capacity(count);
        while cells.len() < count {
            let left = (count - cells.len()) as u64;
            match from.at_most(2 * left, "too many cells")? {
                0 => cells.push(Cell::Split(Box::new(Self::read(from, room, depth + 1)?))),
                same if same % 2 == 0 => {
                    cells.extend(std::iter::repeat_n(Cell::Keep, (same / 2) as usize));
                }
                same => cells.extend(std::iter::repeat_n(Cell::Count, same.div_ceil(2) as usize)),
            }
        }
        Ok(Self { low, inverse, cells })
    }
}

impl Cell {
    /// Whether two cells are written as one; split ones never are.
    fn is_alike(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Count, Self::Count) | (Self::Keep, Self::Keep))
    }
}

impl Partition {
    /// Equal cells between two values that hold nearly all.
    pub(super) fn new(low: f64, high: f64) -> Self {
        Self::of(Grid::new(low, high, FIRST_CELLS))
    }

    fn of(root: Grid) -> Self {
        Self { index: Index::of(&root), root }
    }

    pub(super) fn tally(&self) -> PassTally {
        PassTally { leaves: vec![Counted::NONE; self.index.leaves], kept: Vec::new() }
    }

    /// Keeps the values of the leaves for which `keep` says so, and splits those that `split` gives
    /// a number of cells, between their extremes.
    pub(super) fn refine(
        &mut self,
        leaves: &[Leaf],
        keep: impl Fn(usize) -> bool,
        split: impl Fn(usize) -> usize,
    ) {
        let mut cells = Vec::with_capacity(self.index.leaves);
        self.root.visit(&mut cells);
        for (number, (cell, leaf)) in cells.into_iter().zip(leaves).enumerate() {
            *cell = match split(number) {
                0 if keep(number) => Cell::Keep,
                0 => Cell::Count,
                parts => Cell::Split(Box::new(Grid::new(leaf.least, leaf.greatest, parts))),
            };
        }
        self.index = Index::of(&self.root);
    }

    /// The partition as bytes.
    pub(super) fn write(&self, out: &mut Writer) {
        self.root.write(out);
    }

    /// A partition from bytes.
    pub(super) fn read(from: &mut ByteReader<'_>) -> Result<Self, Damaged> {
        let mut room = MOST_CELLS;
        Ok(Self::of(Grid::read(from, &mut room, 0)?))
    }

    /// For each leaf whether its values are kept.
    pub(super) fn kept_leaves(&self) -> Vec<bool> {
        let mut kept = Vec::with_capacity(self.index.leaves);
        self.root.kept(&mut kept);
        kept
    }

    /// The leaves with what a pass found in them.
    pub(super) fn leaves(&self, tally: &PassTally) -> Vec<Leaf> {
        let kept = self.kept_leaves();
        let (mut below, mut index) = (0, 0);
        let found = tally.counted().zip(kept);
        found
            .map(|((count, [least, greatest]), is_kept)| {
                let leaf = Leaf { count, below, least, greatest, kept: is_kept.then_some(index) };
                below += count;
                index += if is_kept { count as usize } else { 0 };
                leaf
            })
            .collect()
    }
}

impl Index {
    fn of(root: &Grid) -> Self {
        let mut index = Self::default();
        index.add(root);
        index
    }

    /// Adds a grid and those within it; its leaves are numbered in the order of their values.
    fn add(&mut self, grid: &Grid) -> usize {
        let Grid { low, inverse, ref cells } = *grid;
        let (number, first) = (self.grids.len(), self.slots.len());
        self.grids.push(GridIndex { low, inverse, first, last: cells.len() - 1 });
        self.slots.resize(first + cells.len(), Slot::counted(0));
        for (place, cell) in cells.iter().enumerate() {
            self.slots[first + place] = match cell {
                Cell::Split(finer) => Slot::split(self.add(finer)),
                Cell::Count => Slot::counted(self.next()),
                Cell::Keep => Slot::kept(self.next()),
            };
        }
        number
    }

    fn next(&mut self) -> usize {
        self.leaves += 1;
        self.leaves - 1
    }
}

impl GridIndex {
    /// The place of the cell of a value; a greater value never has a lower cell.
    #[inline(always)]
    fn place(self, value: f64) -> usize {
        let position = (value - self.low) * self.inverse;
        // the conversion takes what is below 0 to 0
        self.first + (position as u32 as usize).min(self.last)
    }
}

impl Slot {
    const COUNTED: u32 = 0;
    const KEPT: u32 = 1;
    const SPLIT: u32 = 2;

    /// Partitions have far fewer cells than 2^30.
    fn new(number: usize, kind: u32) -> Self {
        Self((number as u32) << 2 | kind)
    }

    fn counted(leaf: usize) -> Self {
        Self::new(leaf, Self::COUNTED)
    }

    fn kept(leaf: usize) -> Self {
        Self::new(leaf, Self::KEPT)
    }

    fn split(grid: usize) -> Self {
        Self::new(grid, Self::SPLIT)
    }

    fn kind(self) -> u32 {
        self.0 & 3
    }

    /// Of the leaf, or of the grid.
    fn number(self) -> usize {
        (self.0 >> 2) as usize
    }
}

impl Counted {
    const NONE: Self = Self { count: 0, extremes: [f64::INFINITY, f64::NEG_INFINITY] };

    #[inline(always)]
    fn add(&mut self, value: f64) {
        self.count += 1;
        let [least, greatest] = &mut self.extremes;
        *least = if value < *least { value } else { *least };
        *greatest = if value > *greatest { value } else { *greatest };
    }

    fn merge(&mut self, other: Self) {
        let [[a, b], [least, greatest]] = [self.extremes, other.extremes];
        *self = Self { count: self.count + other.count, extremes: [a.min(least), b.max(greatest)] };
    }
}

impl PassTally {
    /// Counts a block's values. Whether a cell is split is nothing that a processor can guess, and it
    /// waits for the memory where it guesses wrong: so all values are looked up before any is counted.
    pub(super) fn add(&mut self, partition: &Partition, values: &[f64]) {
        let Index { slots, grids, .. } = &partition.index;
        let Some(root) = grids.first() else { return };
        let (mut found, mut open) = ([Slot(0); TOGETHER], [0_u16; TOGETHER]);
        for values in values.chunks(TOGETHER) {
            let found = &mut found[..values.len()];
            let mut count = 0;
            for (place, (slot, &value)) in found.iter_mut().zip(values).enumerate() {
                *slot = slots[root.place(value)];
                open[count] = place as u16;
                count += usize::from(slot.kind() == Slot::SPLIT);
            }
            while count > 0 {
                let mut left = 0;
                for next in 0..count {
                    let place = usize::from(open[next]);
                    let slot = slots[grids[found[place].number()].place(values[place])];
                    found[place] = slot;
                    open[left] = place as u16;
                    left += usize::from(slot.kind() == Slot::SPLIT);
                }
                count = left;
            }
            for (slot, &value) in found.iter().zip(values) {
                self.leaves[slot.number()].add(value);
            }
            let kept = found.iter().zip(values).filter(|(slot, _)| slot.kind() == Slot::KEPT);
            self.kept.extend(kept.map(|(_, value)| *value));
        }
    }

    /// Adds what another thread found.
    pub(super) fn merge(&mut self, other: Self) {
        for (leaf, more) in self.leaves.iter_mut().zip(other.leaves) {
            leaf.merge(more);
        }
        self.kept.extend(other.kept);
    }

    /// For each leaf the number of its values, the least and the greatest.
    pub(super) fn counted(&self) -> impl Iterator<Item = (u64, [f64; 2])> + '_ {
        self.leaves.iter().map(|leaf| (leaf.count, leaf.extremes))
    }

    /// The kept values as they came.
    pub(super) fn kept(&self) -> &[f64] {
        &self.kept
    }

    /// Sets what was found in a leaf.
    pub(super) fn set(&mut self, leaf: usize, count: u64, extremes: [f64; 2]) {
        self.leaves[leaf] = Counted { count, extremes };
    }

    /// The same with these kept values.
    pub(super) fn with_kept(self, kept: Vec<f64>) -> Self {
        Self { kept, ..self }
    }

    /// The kept values in order.
    pub(super) fn into_sorted(mut self) -> Vec<f64> {
        sort(&mut self.kept);
        self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refined_leaves_keep_the_order_of_values() {
        let values: Vec<f64> = (0..10_000).map(|i| f64::from(i * 7919 % 10_007)).collect();
        let mut partition = Partition::new(100.0, 9_000.0);
        let mut tally = partition.tally();
        tally.add(&partition, &values);
        let leaves = partition.leaves(&tally);
        assert_eq!(leaves.iter().map(|l| l.count).sum::<u64>(), 10_000);
        // the outermost cells hold everything beyond
        assert_eq!(leaves.first().unwrap().least, 0.0);
        let last = leaves.len() - 1;
        partition.refine(&leaves, |leaf| leaf == last, |leaf| if leaf == 0 { 4 } else { 0 });
        let mut tally = partition.tally();
        tally.add(&partition, &values);
        let leaves = partition.leaves(&tally);
        let filled: Vec<&Leaf> = leaves.iter().filter(|l| l.count > 0).collect();
        assert!(filled.windows(2).all(|w| w[0].greatest < w[1].least));
        let kept = tally.into_sorted();
        assert_eq!(kept.len() as u64, leaves.last().unwrap().count);
        assert_eq!(leaves.last().unwrap().kept, Some(0));
    }
}
