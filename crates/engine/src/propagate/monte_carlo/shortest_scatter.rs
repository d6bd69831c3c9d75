//! How far the ends of the shortest interval scatter, and whether there is one such interval.
//!
//! Batches of the trials have shortest intervals of their own, whose scatter is brought to the
//! number of all trials. Where along the possible intervals the shortest one lies is known only to
//! the cube root of the trials where the density has a smooth peak (Kim and Pollard, Annals of
//! Statistics 18, 1990). Where the density falls from a limit on, the interval begins at the limit,
//! to which it comes as near as the least of the trials (`limit_scatter`), and its other end is a
//! quantile, which settles with the square root. Where the density is flat, or rises to both limits,
//! many intervals are equally short and the trials choose among them by chance: then there is no one
//! interval to have a numerical error.

use super::interval::{Ranks, quantile_error, rank_spread, shortest};
use super::limit_scatter;
use super::order::Order;
use crate::distribution::BLOCK;
use crate::number::elementary;

/// Batches of the trials whose scatter gives numerical standard errors.
pub(super) const BATCHES: usize = 32;

/// Blocks in a batch, at most. Of longer runs the first batches stand for all.
const LARGEST_BATCH: u64 = 64;

/// One of so many batches is asked for the numerical standard errors of its order statistics.
const ASKED: u64 = 4;

/// So many batches are needed to say that they do not agree on where the interval lies.
const ENOUGH: usize = 16;

/// The standard deviation of the batches' intervals along all possible ones, as a share of them,
/// from which on they are taken as chosen by chance. Equally likely ones have 0.29, the two ends of
/// an arcsine distribution 0.5; a normal distribution in batches of two thousand has 0.13.
const BY_CHANCE: f64 = 0.22;

/// The interval begins at the limit if its lower end is one of so many lowest values in nearly all
/// batches, or the very lowest in a quarter of them: where the density at the other end is not much
/// smaller than at the limit, some begin farther in.
const LOWEST: u64 = 5;

/// But only where it could lie at so many places.
const MANY_PLACES: u64 = 4 * LOWEST;

/// Consecutive blocks that are summed up together and make a batch.
pub(super) fn batch_blocks(trials: u64) -> u64 {
    trials.div_ceil(BLOCK as u64).div_ceil(BATCHES as u64).clamp(1, LARGEST_BATCH)
}

/// The shortest interval of a batch.
#[derive(Clone, Debug)]
pub(super) struct BatchInterval {
    number: u64,
    trials: u64,
    ends: [f64; 2],
    /// The numerical standard errors of the order statistics of these ranks; not a number where they
    /// were not asked for.
    errors: [f64; 2],
    /// The rank of the lower end, from 1, and the largest that it can have.
    rank: u64,
    most: u64,
    /// By how much each end moves from one rank of the batch to the next; where errors were asked for.
    steps: [f64; 2],
}

impl BatchInterval {
    /// Of the trials of the batch of this number; `None` if an order statistic was not kept.
    pub(super) fn of(order: &mut Order, probability: f64, number: u64) -> Option<Self> {
        let trials = order.trials;
        let Ranks { q, .. } = Ranks::new(trials, probability);
        let (ends, rank) = shortest(order, probability)?;
        let upper = (rank + q).min(trials);
        // their mean over some batches will do
        let is_asked = number.is_multiple_of(ASKED);
        let mut error = |rank| quantile_error(order, rank).unwrap_or(f64::NAN);
        let errors = if is_asked { [error(rank), error(upper)] } else { [f64::NAN; 2] };
        let step = |error: f64, rank| error / rank_spread(trials, rank) as f64;
        let steps = [step(errors[0], rank), step(errors[1], upper)];
        let most = trials.saturating_sub(q).max(1);
        Some(Self { number, trials, ends, errors, rank, most, steps })
    }

    /// The number of the batch.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// The trials of the batch next to its least one, or its greatest one, in `order`.
    pub(super) fn nearest(&self, order: &mut Order, end: usize) -> Vec<f64> {
        limit_scatter::nearest(order, end == 1, self.most)
    }

    /// Where the interval lies along all possible ones, from 0 to 1.
    fn place(&self) -> f64 {
        if self.most > 1 { (self.rank - 1) as f64 / (self.most - 1) as f64 } else { 0.5 }
    }
}

/// What the batches tell of the shortest interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShortestScatter {
    /// Numerical standard errors of its ends; not a number where there are too few batches to tell,
    /// or no one interval.
    pub(super) errors: [f64; 2],
    /// Whether there is one shortest interval.
    pub(super) unique: bool,
}

impl ShortestScatter {
    /// From the batches of a run of `total` trials. `near` gives the trials of a batch next to its
    /// least one (0) or its greatest one (1): asked for only where the interval begins at a limit.
    pub(super) fn of(
        mut batches: Vec<BatchInterval>,
        total: u64,
        near: impl Fn(&[BatchInterval], usize) -> Vec<Vec<f64>>,
    ) -> Self {
        let largest = batches.iter().map(|batch| batch.trials).max().unwrap_or(0);
        // a last batch of few trials would scatter more than the others
        batches.retain(|batch| 2 * batch.trials > largest);
        if batches.len() < 4 {
            return Self { errors: [f64::NAN; 2], unique: true };
        }
        let places: Vec<f64> = batches.iter().map(BatchInterval::place).collect();
        if batches.len() >= ENOUGH && variance(&places).sqrt() > BY_CHANCE {
            return Self { errors: [f64::NAN; 2], unique: false };
        }
        let ratio = largest as f64 / total as f64;
        let at_limit = at_limits(&batches);
        let errors = [0, 1].map(|end| {
            let mean = |of: &dyn Fn(&BatchInterval) -> f64| {
                let known: Vec<f64> = batches.iter().map(of).filter(|x| x.is_finite()).collect();
                known.iter().sum::<f64>() / known.len() as f64
            };
            // that of a quantile, which settles with the square root
            let quantile = mean(&|batch| batch.errors[end].powi(2));
            if at_limit[1 - end] {
                return (ratio * quantile).sqrt();
            }
            if at_limit[end] {
                let near = near(&batches, end);
                let near: Vec<&[f64]> = near.iter().map(Vec::as_slice).collect();
                let sampled = batches.iter().map(|batch| batch.trials).sum();
                let step = mean(&|batch| batch.steps[1 - end].powi(2)).sqrt() * ratio;
                return limit_scatter::scatter(&near, sampled, total, step);
            }
            let scatter =
                variance(&batches.iter().map(|batch| batch.ends[end]).collect::<Vec<_>>());
            let third = elementary::cbrt(ratio).powi(2);
            let by_third = third * scatter;
            // an end that scatters little more than a quantile is one for the most part
            let more = scatter / quantile - 1.0;
            if more >= 1.0 || more.is_nan() {
                return by_third.sqrt();
            }
            let apart = ratio * quantile + third * f64::max(scatter - quantile, 0.0);
            let more = more.max(0.0);
            (more * by_third + (1.0 - more) * apart).sqrt()
        });
        Self { errors, unique: true }
    }
}

/// Whether the interval begins at the least, or ends at the greatest value. Where it seems to do both,
/// it does neither.
fn at_limits(batches: &[BatchInterval]) -> [bool; 2] {
    let share = |is: &dyn Fn(&BatchInterval) -> bool| {
        let are = batches.iter().filter(|batch| batch.most > MANY_PLACES && is(batch)).count();
        are as f64 / batches.len() as f64
    };
    let at = |place: &dyn Fn(&BatchInterval) -> u64| {
        share(&|batch| place(batch) <= LOWEST) >= 0.9 || share(&|batch| place(batch) == 1) >= 0.25
    };
    let lower = at(&|batch| batch.rank);
    let upper = at(&|batch| (batch.most + 1).saturating_sub(batch.rank));
    [lower && !upper, upper && !lower]
}

/// The variance of some values, with divisor n - 1.
pub(super) fn variance(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0)
}
