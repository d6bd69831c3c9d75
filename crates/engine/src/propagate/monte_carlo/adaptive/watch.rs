//! The figures of the blocks of one output: how they scatter, and the tolerance that they are to meet.

use super::blocks::Figures;
use super::{AdaptiveSearch, FIGURES};
use crate::propagate::validate::numerical_tolerance;

/// The running comparison of one output's blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    blocks: f64,
    origin: Figures,
    /// Sums of the figures and of their squares about the first block's.
    sums: Figures,
    squares: Figures,
    /// Sum over the blocks of their squared deviations about their own mean.
    within: f64,
    trials: f64,
}

impl Watch {
    pub(super) fn add(&mut self, figures: Option<Figures>, block: u64) {
        let Some(figures) = figures else {
            return;
        };
        if self.blocks == 0.0 {
            self.origin = figures;
        }
        for (i, figure) in figures.iter().enumerate() {
            let d = figure - self.origin[i];
            self.sums[i] += d;
            self.squares[i] += d * d;
        }
        let n = block as f64;
        self.within += (n - 1.0) * figures[1] * figures[1];
        self.blocks += 1.0;
        self.trials += n;
    }

    /// The squared scatter of a figure between blocks, summed.
    fn scatter(&self, figure: usize) -> f64 {
        let mean = self.sums[figure] / self.blocks;
        f64::max(self.squares[figure] - self.blocks * mean * mean, 0.0)
    }

    /// Whether the output has no variance, so that the ends of its interval are watched alone.
    fn has_no_variance(search: AdaptiveSearch<'_>, output: usize) -> bool {
        search.moment_order.get(output).is_some_and(|&dof| dof <= 2.0)
    }

    /// The figures that are watched.
    fn watched(search: AdaptiveSearch<'_>, output: usize) -> std::ops::Range<usize> {
        if Self::has_no_variance(search, output) { 2..FIGURES } else { 0..FIGURES }
    }

    /// The tolerance from the standard deviation of all trials so far (7.9.4 i and j); from that of
    /// the law of propagation where there is none, or where there are no trials; and from a quarter of
    /// the interval, about that of a normal distribution, where the law has none either.
    pub(super) fn tolerance(&self, search: AdaptiveSearch<'_>, output: usize) -> f64 {
        let size = self.trials / self.blocks;
        let all = ((self.within + size * self.scatter(0)) / (self.trials - 1.0)).sqrt();
        let by_gum = Self::has_no_variance(search, output) || self.blocks == 0.0;
        let of_law = search.gum.get(output).copied().filter(|u| *u > 0.0);
        let u = if by_gum { of_law.unwrap_or_else(|| self.quarter()) } else { all };
        numerical_tolerance(u, search.digits) / search.strictness
    }

    /// A quarter of the mean interval of the blocks; 0 without any.
    fn quarter(&self) -> f64 {
        let mean = |figure: usize| self.origin[figure] + self.sums[figure] / self.blocks;
        if self.blocks > 0.0 { 0.25 * (mean(3) - mean(2)) } else { 0.0 }
    }

    /// Whether twice the standard deviation of the mean of every figure is within the tolerance
    /// (7.9.4 k).
    pub(super) fn is_stable(&self, search: AdaptiveSearch<'_>, output: usize) -> bool {
        if self.blocks < 2.0 {
            return false;
        }
        let tolerance = self.tolerance(search, output);
        Self::watched(search, output).all(|figure| {
            let s = (self.scatter(figure) / (self.blocks * (self.blocks - 1.0))).sqrt();
            2.0 * s <= tolerance
        })
    }

    /// So many blocks that the mean of every figure is within the tolerance with the confidence
    /// that belongs to the two-sided t factor `t` (Stein's second stage). Infinite where there is
    /// no scatter to tell it from.
    pub(super) fn blocks_needed(&self, search: AdaptiveSearch<'_>, output: usize, t: f64) -> f64 {
        if self.blocks < 2.0 {
            return f64::INFINITY;
        }
        let tolerance = self.tolerance(search, output);
        let needed = Self::watched(search, output).map(|figure| {
            let variance = self.scatter(figure) / (self.blocks - 1.0);
            // figures that do not scatter are known
            if variance == 0.0 { 0.0 } else { variance * (t / tolerance).powi(2) }
        });
        needed.fold(0.0, f64::max)
    }
}
