//! Sums of all trials over a fixed tree of chunks.
//!
//! Rounding makes the sum of floating-point numbers depend on the order of the additions. Here the
//! order is a function of the number of chunks alone: chunks are added up in pairs, pairs of pairs
//! and so on to groups of a power of two, and the groups one after the other. Any stretch of the
//! chunks can then be summed up by itself, anywhere: what it hands over are the largest whole
//! branches that it holds, and stretches put together in any order have the bits of one run. A
//! stretch holds no more branches than the tree is high, to both sides, so memory grows with the
//! logarithm of the trials.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::moments::{Moments, correlation, group_error};
use super::plan::Reference;
use super::shortest_scatter::BATCHES;
use super::sums::Sums;

/// Pairs of outputs at most of which the products of groups of chunks are held: 1 MiB.
const MOST_GROUPED: usize = 4096;

/// The sums of all outputs over some trials.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ChunkSums {
    pub(super) trials: u64,
    /// One entry for each output.
    pub(super) outputs: Vec<Sums>,
}

impl ChunkSums {
    /// Adds those of trials that follow.
    fn add(&mut self, other: &Self) {
        self.trials += other.trials;
        if self.outputs.len() < other.outputs.len() {
            self.outputs.resize_with(other.outputs.len(), Sums::default);
        }
        for (sums, other) in self.outputs.iter_mut().zip(&other.outputs) {
            sums.merge(other);
        }
    }
}

/// How many of so many chunks make a group: a power of two, so that there are no more groups than
/// batches.
fn chunks_in_group(chunks: u64) -> u64 {
    chunks.div_ceil(BATCHES as u64).max(1).next_power_of_two()
}

/// Branches of the tree over all chunks: those that some of the chunks fill.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SumTree {
    group: u64,
    /// By the number of its first chunk each branch with the number of its chunks, a power of two.
    branches: BTreeMap<u64, (u64, ChunkSums)>,
}

impl SumTree {
    /// Of so many chunks, none of which is there yet.
    pub(super) fn new(chunks: u64) -> Self {
        Self { group: chunks_in_group(chunks), branches: BTreeMap::new() }
    }

    /// Puts in a branch of `length` chunks, and joins it with the one beside it as far as there is
    /// one.
    pub(super) fn insert(&mut self, first: u64, length: u64, sums: ChunkSums) {
        let (mut first, mut length, mut sums) = (first, length, sums);
        while length < self.group {
            let beside = first ^ length;
            if self.branches.get(&beside).is_none_or(|(found, _)| *found != length) {
                break;
            }
            let Some((_, mut other)) = self.branches.remove(&beside) else { break };
            if beside < first {
                other.add(&sums);
                (first, sums) = (beside, other);
            } else {
                sums.add(&other);
            }
            length *= 2;
        }
        self.branches.insert(first, (length, sums));
    }

    /// Takes over the branches of another stretch.
    pub(super) fn merge(&mut self, other: Self) {
        for (first, (length, sums)) in other.branches {
            self.insert(first, length, sums);
        }
    }

    /// Its branches in order: first chunk, number of chunks, sums.
    pub(super) fn branches(&self) -> impl Iterator<Item = (u64, u64, &ChunkSums)> {
        self.branches.iter().map(|(first, (length, sums))| (*first, *length, sums))
    }

    /// Whether a branch of the tree begins at a chunk and has so many.
    pub(super) fn is_branch(&self, first: u64, length: u64) -> bool {
        length.is_power_of_two() && length <= self.group && first.is_multiple_of(length)
    }
}

/// The sums of all trials, and of some groups of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Totals {
    tree: SumTree,
    /// Groups that are whole.
    settled: u64,
    pub(super) whole: ChunkSums,
    /// Without products of very many outputs.
    pub(super) groups: Vec<ChunkSums>,
}

impl Totals {
    /// Of so many chunks, none of which is there yet.
    pub(super) fn new(chunks: u64) -> Self {
        let (whole, groups) = (ChunkSums::default(), Vec::new());
        Self { tree: SumTree::new(chunks), settled: 0, whole, groups }
    }

    /// Sums that are complete.
    pub(super) fn of(whole: ChunkSums, groups: Vec<ChunkSums>) -> Self {
        Self { tree: SumTree::new(0), settled: groups.len() as u64, whole, groups }
    }

    /// Takes over the next chunks, or any others.
    pub(super) fn take(&mut self, tree: SumTree) {
        self.tree.merge(tree);
        self.settle();
    }

    /// Takes over one chunk.
    pub(super) fn take_chunk(&mut self, number: u64, sums: ChunkSums) {
        self.tree.insert(number, 1, sums);
        self.settle();
    }

    /// Adds the groups that are whole to the sums of all, in order.
    fn settle(&mut self) {
        let group = self.tree.group;
        while let Entry::Occupied(next) = self.tree.branches.entry(self.settled * group) {
            if next.get().0 != group {
                break;
            }
            let (_, sums) = next.remove();
            self.settled += 1;
            self.add_group(sums);
        }
    }

    fn add_group(&mut self, mut sums: ChunkSums) {
        self.whole.add(&sums);
        let outputs = sums.outputs.len();
        if outputs * outputs.saturating_sub(1) / 2 > MOST_GROUPED {
            sums.outputs.iter_mut().for_each(|sums| sums.products = Vec::new());
        }
        self.groups.push(sums);
    }

    /// Adds what is left: the last group, and where the run was stopped what it came to.
    pub(super) fn close(&mut self) {
        let group = self.tree.group;
        let mut open: Option<(u64, ChunkSums)> = None;
        for (first, (_, sums)) in std::mem::take(&mut self.tree.branches) {
            match &mut open {
                Some((number, own)) if *number == first / group => own.add(&sums),
                _ => {
                    let before = open.replace((first / group, sums));
                    before.into_iter().for_each(|(_, sums)| self.add_group(sums));
                }
            }
        }
        open.into_iter().for_each(|(_, sums)| self.add_group(sums));
    }

    /// The moments of all trials of an output, with the errors that the scatter of the groups gives.
    pub(super) fn moments(&self, output: usize, reference: Reference) -> Moments {
        let of = |sums: &ChunkSums| {
            let own = sums.outputs.get(output).cloned().unwrap_or_default();
            Moments::new(sums.trials, reference, &own)
        };
        let all = of(&self.whole);
        let shapes = self.groups.iter().map(|group| {
            let moments = of(group);
            (group.trials, [moments.skewness, moments.excess_kurtosis])
        });
        let shapes: Vec<(u64, [f64; 2])> = shapes.collect();
        let pooled = [all.skewness, all.excess_kurtosis];
        let [skewness, kurtosis] = [0, 1].map(|which| {
            let figures = shapes.iter().map(|(trials, shape)| (*trials, shape[which]));
            group_error(&figures.collect::<Vec<_>>(), pooled[which])
        });
        Moments { shape_errors: [skewness, kurtosis], ..all }
    }

    /// The correlation coefficients of all outputs i < j.
    pub(super) fn correlations(&self) -> Vec<f64> {
        self.pairs().filter_map(|(i, j)| coefficient(&self.whole, i, j)).collect()
    }

    /// The numerical standard errors of these coefficients; `None` where they cannot be told, and of
    /// very many outputs.
    pub(super) fn correlation_errors(&self, pooled: &[f64]) -> Vec<Option<f64>> {
        let error = |((i, j), &pooled): ((usize, usize), &f64)| {
            let groups = self.groups.iter().filter(|group| group.trials > 1);
            let figures = groups.map(|group| Some((group.trials, coefficient(group, i, j)?)));
            let figures: Vec<(u64, f64)> = figures.collect::<Option<_>>()?;
            group_error(&figures, pooled).filter(|error| error.is_finite())
        };
        self.pairs().zip(pooled).map(error).collect()
    }

    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        let outputs = self.whole.outputs.len();
        (0..outputs).flat_map(move |i| (i + 1..outputs).map(move |j| (i, j)))
    }
}

/// The correlation coefficient of the outputs i < j; `None` where their products are not there.
fn coefficient(sums: &ChunkSums, i: usize, j: usize) -> Option<f64> {
    let (a, b) = (sums.outputs.get(i)?, sums.outputs.get(j)?);
    let product = *a.products.get(j - i - 1)?;
    Some(correlation(sums.trials, a, b, product))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One chunk's sums, of values that do not add up without rounding.
    fn chunk(number: u64) -> ChunkSums {
        let value = 1.0 / (number as f64 + 3.0);
        let sums = Sums { inside: number, powers: [value; 4], products: vec![value * value] };
        ChunkSums { trials: 7, outputs: vec![sums, Sums::default()] }
    }

    fn in_order(chunks: u64) -> Totals {
        let mut totals = Totals::new(chunks);
        (0..chunks).for_each(|number| totals.take_chunk(number, chunk(number)));
        totals.close();
        totals
    }

    /// Chunks summed up in stretches of any length, put together in any order, have the bits of all
    /// in order.
    #[test]
    fn stretches_in_any_order_have_the_same_bits() {
        for chunks in [1, 2, 31, 32, 33, 64, 65, 100, 1000, 4097] {
            let whole = in_order(chunks);
            assert_eq!(whole.whole.trials, 7 * chunks);
            assert!(whole.groups.len() <= BATCHES);
            for step in [1, 3, 7, 64, 1000] {
                let mut starts: Vec<u64> = (0..chunks).step_by(step as usize).collect();
                // a fixed shuffle
                starts.sort_by_key(|start| (start.wrapping_mul(0x9e37_79b9_7f4a_7c15), *start));
                let mut totals = Totals::new(chunks);
                for start in starts {
                    let mut tree = SumTree::new(chunks);
                    let own = start..(start + step).min(chunks);
                    own.rev().for_each(|number| tree.insert(number, 1, chunk(number)));
                    assert!(
                        tree.branches().all(|(first, length, _)| tree.is_branch(first, length))
                    );
                    totals.take(tree);
                }
                totals.close();
                assert_eq!(totals, whole, "{chunks} chunks by {step}");
            }
        }
    }

    /// Up to as many chunks as there are batches, sums are those of one chunk after the other.
    #[test]
    fn few_chunks_are_added_one_after_the_other() {
        let plain = (0..32).map(|n| chunk(n).outputs[0].powers[0]).fold(0.0, |a, b| a + b);
        assert_eq!(in_order(32).whole.outputs[0].powers[0].to_bits(), plain.to_bits());
    }

    /// The chunks of 10^12 trials: a stretch of a million of them, and the whole in stretches that
    /// come in order, hold a few dozen branches.
    #[test]
    fn memory_grows_with_the_height_of_the_tree() {
        let chunks = 15_258_790;
        let mut tree = SumTree::new(chunks);
        let light = |trials| ChunkSums { trials, outputs: Vec::new() };
        for number in 5_000_001..6_000_000 {
            tree.insert(number, 1, light(1));
        }
        assert!(tree.branches().count() <= 40, "{}", tree.branches().count());
        let mut totals = Totals::new(chunks);
        let mut most = 0;
        // 977 parts
        for start in (0..chunks).step_by(15_619) {
            let end = (start + 15_619).min(chunks);
            let mut part = SumTree::new(chunks);
            (start..end).for_each(|number| part.insert(number, 1, light(1)));
            totals.take(part);
            most = most.max(totals.tree.branches().count() + totals.groups.len());
        }
        totals.close();
        assert_eq!(totals.whole.trials, chunks);
        assert!(most <= 80, "{most}");
    }
}
