//! Pilot refinement: bracketing the order statistics of a long run from a part of its trials.
//!
//! Without it the first pass over all trials counts in equal cells, and only the second has narrow
//! cells where they matter. A part of the trials (the first 1/64) tells where a rank of all trials
//! will lie: the rank of a share p among n trials of the part scatters by sqrt(n p (1 - p)), as
//! binomial counts do, so five standard deviations to both sides hold it but for once in 1.7 million.
//! This is the bracketing of Floyd and Rivest's SELECT (Communications of the ACM 18, 1975) with
//! counts in place of a partition in memory. Two passes over the part make these cells narrow and
//! mark those whose values will be kept; the first pass over all trials then mostly finds every
//! order statistic. Where it does not, the later passes narrow the cells as they would have without
//! a pilot, so that the figures are the same.

use super::interval::Ranks;
use super::partition::{Leaf, Partition};
use super::passes::Pass;
use super::request::Request;
use super::targets::{SearchTargets, leaf_of};

/// This part of the trials is looked at beforehand, twice.
const PART: u64 = 64;

/// How many standard deviations an order statistic is looked for to both sides of where the part has
/// it. It lies farther away once in 1.7 million runs.
const MARGIN: f64 = 5.0;

/// Narrow cells of all outputs together. They cost a search nothing but memory.
const NARROW: usize = 1 << 18;

/// Of more outputs the values that are likely to be asked for would hardly find room.
const MOST_OUTPUTS: usize = 16;

/// Of how many trials the cells are made ready beforehand; `None` of very many outputs, which are
/// not.
pub(super) fn part(trials: u64, outputs: usize) -> Option<u64> {
    (outputs <= MOST_OUTPUTS).then_some(trials / PART)
}

/// Divides the cells that matter, from the counts of a first pass over the part.
pub(super) fn divide(coarse: &Pass, request: Request<'_>, partitions: &mut [Partition]) {
    let search = SearchTargets::new(request.trials, request.probability);
    let outputs = partitions.len();
    for (partition, tally) in partitions.iter_mut().zip(&coarse.tallies) {
        let leaves = partition.leaves(tally);
        let mut wanted = around_targets(&leaves, coarse.trials, &search);
        near_the_shortest(&leaves, coarse.trials, request.probability, &mut wanted);
        let count = wanted.iter().filter(|wanted| **wanted).count();
        let parts = NARROW / outputs / count.max(1);
        let parts = parts.clamp(16, 4096);
        partition.refine(&leaves, |_| false, |leaf| if wanted[leaf] { parts } else { 0 });
    }
}

/// Marks the cells whose values are kept, from the counts of a second pass over the part.
pub(super) fn mark(
    narrow: &Pass,
    request: Request<'_>,
    partitions: &mut [Partition],
    budget: usize,
) {
    let search = SearchTargets::new(request.trials, request.probability);
    for (partition, tally) in partitions.iter_mut().zip(&narrow.tallies) {
        let leaves = partition.leaves(tally);
        let wanted = around_targets(&leaves, narrow.trials, &search);
        let count = leaves.iter().zip(&wanted).filter(|(_, wanted)| **wanted);
        let count: u64 = count.map(|(leaf, _)| leaf.count).sum();
        // a tenth more than expected still has room
        if count.saturating_mul(PART + PART / 10) < budget as u64 {
            partition.refine(&leaves, |leaf| wanted[leaf], |_| 0);
        }
    }
}

/// The rank that is so many standard deviations of a rank beyond the one that a share of the trials
/// has in the part.
fn rank_beyond(share: f64, trials: u64, deviations: f64) -> u64 {
    let n = trials as f64;
    let rank = share * n + deviations * ((n * share * (1.0 - share)).sqrt() + 1.0);
    (rank.clamp(1.0, n.max(1.0))) as u64
}

/// The leaves in which the targets' order statistics of all trials may lie.
fn around_targets(leaves: &[Leaf], trials: u64, search: &SearchTargets) -> Vec<bool> {
    let mut wanted = vec![false; leaves.len()];
    if trials == 0 {
        return wanted;
    }
    for share in search.shares() {
        let [from, to] =
            [-MARGIN, MARGIN].map(|margin| leaf_of(leaves, rank_beyond(share, trials, margin)));
        wanted[from..=to].fill(true);
    }
    wanted
}

/// Adds the leaves that the ends of the shortest interval of all trials may lie in: of the part's
/// intervals those whose length is within the scatter of the least.
fn near_the_shortest(leaves: &[Leaf], trials: u64, probability: f64, wanted: &mut [bool]) {
    let Ranks { q, r } = Ranks::new(trials, probability);
    let top = trials.saturating_sub(q);
    if top == 0 {
        return;
    }
    let error = |rank: u64| {
        let share = rank as f64 / trials as f64;
        let [below, above] =
            [-1.0, 1.0].map(|d| leaves[leaf_of(leaves, rank_beyond(share, trials, d))]);
        0.5 * (above.greatest - below.least)
    };
    let scatter = MARGIN * (error(r) + error((r + q).min(trials)));
    let spans = leaves.iter().enumerate().filter(|(_, leaf)| leaf.count > 0 && leaf.below < top);
    let spans: Vec<_> = spans
        .map(|(number, leaf)| {
            let (first, last) = (leaf.below + 1, (leaf.below + leaf.count).min(top));
            let (from, to) = (leaf_of(leaves, first + q), leaf_of(leaves, last + q));
            let least = leaves[from].least - leaf.greatest;
            (number, from, to, least, leaves[to].greatest - leaf.least)
        })
        .collect();
    let bound = spans.iter().map(|span| span.4).fold(f64::INFINITY, f64::min) + scatter;
    for (number, from, to, ..) in spans.into_iter().filter(|span| span.3 <= bound) {
        wanted[number] = true;
        wanted[from..=to].fill(true);
    }
}
