//! A partition of the line into cells that can be made finer where it matters.
//!
//! Where more values would have to be kept than memory allows, they are counted in cells instead;
//! later passes regenerate them and keep, or count more finely, only what lies in the few cells on
//! which the wanted order statistics depend.

use super::parts::{Damaged, Reader, Writer};
use super::sorting::sort;

/// Cells of the first pass.
const FIRST_CELLS: usize = 1 << 14;

/// Cells of a partition that is read, at most: some times as many as passes make.
const MOST_CELLS: usize = 1 << 23;

/// Grids within each other in a partition that is read, at most: each pass adds one.
const DEEPEST: usize = 32;

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
    /// The number of each cell among the leaves of the partition; of the first leaf below it if it
    /// is split.
    leaves: Vec<usize>,
}

/// The partition of one output's values.
#[derive(Clone, Debug)]
pub(super) struct Partition {
    root: Grid,
    leaves: usize,
}

/// What one pass over the trials found.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    /// For each leaf the number of values, the least and the greatest.
    counts: Vec<u64>,
    extremes: Vec<[f64; 2]>,
    kept: Vec<f64>,
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
        Self { low, inverse, cells: vec![Cell::Count; cells], leaves: vec![0; cells] }
    }

    /// The cell of a value; a greater value never has a lower cell.
    #[inline(always)]
    fn cell(&self, value: f64) -> usize {
        let position = (value - self.low) * self.inverse;
        // the conversion takes what is below 0 to 0
        (position as usize).min(self.cells.len() - 1)
    }

    fn number(&mut self, next: &mut usize) {
        for (cell, leaf) in self.cells.iter_mut().zip(&mut self.leaves) {
            *leaf = *next;
            match cell {
                Cell::Split(grid) => grid.number(next),
                _ => *next += 1,
            }
        }
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
    fn read(from: &mut Reader<'_>, room: &mut usize, depth: usize) -> Result<Self, Damaged> {
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
        Ok(Self { low, inverse, cells, leaves: vec![0; count] })
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
        let mut partition = Self { root: Grid::new(low, high, FIRST_CELLS), leaves: 0 };
        partition.number();
        partition
    }

    fn number(&mut self) {
        self.leaves = 0;
        self.root.number(&mut self.leaves);
    }

    pub(super) fn tally(&self) -> Tally {
        Tally {
            counts: vec![0; self.leaves],
            extremes: vec![[f64::INFINITY, f64::NEG_INFINITY]; self.leaves],
            kept: Vec::new(),
        }
    }

    /// Keeps the values of the leaves for which `keep` says so, and splits those that `split` gives
    /// a number of cells, between their extremes.
    pub(super) fn refine(
        &mut self,
        leaves: &[Leaf],
        keep: impl Fn(usize) -> bool,
        split: impl Fn(usize) -> usize,
    ) {
        let mut cells = Vec::with_capacity(self.leaves);
        self.root.visit(&mut cells);
        for (number, (cell, leaf)) in cells.into_iter().zip(leaves).enumerate() {
            *cell = match split(number) {
                0 if keep(number) => Cell::Keep,
                0 => Cell::Count,
                parts => Cell::Split(Box::new(Grid::new(leaf.least, leaf.greatest, parts))),
            };
        }
        self.number();
    }

    /// The partition as bytes.
    pub(super) fn write(&self, out: &mut Writer) {
        self.root.write(out);
    }

    /// A partition from bytes.
    pub(super) fn read(from: &mut Reader<'_>) -> Result<Self, Damaged> {
        let mut room = MOST_CELLS;
        let mut partition = Self { root: Grid::read(from, &mut room, 0)?, leaves: 0 };
        partition.number();
        Ok(partition)
    }

    /// For each leaf whether its values are kept.
    pub(super) fn kept_leaves(&self) -> Vec<bool> {
        let mut kept = Vec::with_capacity(self.leaves);
        self.root.kept(&mut kept);
        kept
    }

    /// The leaves with what a pass found in them.
    pub(super) fn leaves(&self, tally: &Tally) -> Vec<Leaf> {
        let kept = self.kept_leaves();
        let (mut below, mut index) = (0, 0);
        let found = tally.counts.iter().zip(&tally.extremes).zip(kept);
        found
            .map(|((&count, &[least, greatest]), is_kept)| {
                let leaf = Leaf { count, below, least, greatest, kept: is_kept.then_some(index) };
                below += count;
                index += if is_kept { count as usize } else { 0 };
                leaf
            })
            .collect()
    }
}

impl Tally {
    /// Counts a block's values.
    pub(super) fn add(&mut self, partition: &Partition, values: &[f64]) {
        for &value in values {
            let mut grid = &partition.root;
            let leaf = loop {
                let cell = grid.cell(value);
                match &grid.cells[cell] {
                    Cell::Count => break grid.leaves[cell],
                    Cell::Keep => {
                        self.kept.push(value);
                        break grid.leaves[cell];
                    }
                    Cell::Split(finer) => grid = finer,
                }
            };
            self.counts[leaf] += 1;
            let [least, greatest] = &mut self.extremes[leaf];
            *least = if value < *least { value } else { *least };
            *greatest = if value > *greatest { value } else { *greatest };
        }
    }

    /// Adds what another thread found.
    pub(super) fn merge(&mut self, other: Self) {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
        for (extreme, [least, greatest]) in self.extremes.iter_mut().zip(other.extremes) {
            *extreme = [extreme[0].min(least), extreme[1].max(greatest)];
        }
        self.kept.extend(other.kept);
    }

    /// For each leaf the number of its values, the least and the greatest.
    pub(super) fn counted(&self) -> impl Iterator<Item = (u64, [f64; 2])> + '_ {
        self.counts.iter().copied().zip(self.extremes.iter().copied())
    }

    /// The kept values as they came.
    pub(super) fn kept(&self) -> &[f64] {
        &self.kept
    }

    /// Sets what was found in a leaf.
    pub(super) fn set(&mut self, leaf: usize, count: u64, extremes: [f64; 2]) {
        self.counts[leaf] = count;
        self.extremes[leaf] = extremes;
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
