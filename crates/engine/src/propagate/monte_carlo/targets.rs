//! The order statistics that a run's figures are made of, and where they lie among counted cells.

use super::interval::{Ranks, rank_spread};
use super::partition::Leaf;

/// The order statistics that the symmetric interval, the median and their errors are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct SearchTargets {
    pub(super) trials: u64,
    pub(super) ranks: Ranks,
}

impl SearchTargets {
    pub(super) fn new(trials: u64, probability: f64) -> Self {
        Self { trials, ranks: Ranks::new(trials, probability) }
    }

    /// The ranks of the lower end, the upper end and the median with one standard deviation of the
    /// rank below and above each, and the two middle ranks.
    pub(super) fn ranks(&self) -> [u64; 11] {
        let Ranks { q, r } = self.ranks;
        let upper = (r + q).min(self.trials);
        let (middle, next) = (self.trials.div_ceil(2), self.trials / 2 + 1);
        let around = |rank: u64| {
            let spread = rank_spread(self.trials, rank);
            [rank.saturating_sub(spread).max(1), rank, (rank + spread).min(self.trials)]
        };
        let ([a, b, c], [d, e, f], [g, h, i]) = (around(r), around(upper), around(middle));
        [a, b, c, d, e, f, g, h, i, middle, next]
    }

    /// The share of the trials that each rank is.
    pub(super) fn shares(&self) -> [f64; 11] {
        self.ranks().map(|rank| (rank as f64 - 0.5) / self.trials as f64)
    }
}

/// The leaf that holds the order statistic of a rank.
pub(super) fn leaf_of(leaves: &[Leaf], rank: u64) -> usize {
    let after = leaves.partition_point(|leaf| leaf.below < rank);
    // the last leaf that begins below the rank; empty ones begin there too
    let mut number = after.saturating_sub(1);
    while number > 0 && leaves[number].count == 0 {
        number -= 1;
    }
    number
}
