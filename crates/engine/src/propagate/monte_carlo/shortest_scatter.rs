//! How far the ends of the shortest interval scatter, and whether there is one such interval.
//!
//! Batches of the trials have shortest intervals of their own, whose scatter is brought to the
//! number of all trials. Where along the possible intervals the shortest one lies is known only to
//! the cube root of the trials where the density has a smooth peak (Kim and Pollard, Annals of
//! Statistics 18, 1990). Where the density falls from a limit on, the interval begins at the limit,
//! and its other end is a quantile, which settles with the square root. Where the density is flat,
//! or rises to both limits, many intervals are equally short and the trials choose among them by
//! chance: then there is no one interval to have a numerical error.

use super::interval::{Ranks, quantile_error, shortest};
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
/// batches.
const LOWEST: u64 = 5;

/// But only where it could lie at so many places.
const MANY_PLACES: u64 = 10 * LOWEST;

/// Consecutive blocks that are summed up together and make a batch.
pub(super) fn batch_blocks(trials: u64) -> u64 {
    trials.div_ceil(BLOCK as u64).div_ceil(BATCHES as u64).clamp(1, LARGEST_BATCH)
}

/// The shortest interval of a batch.
#[derive(Clone, Copy, Debug)]
pub(super) struct BatchInterval {
    trials: u64,
    ends: [f64; 2],
    /// The numerical standard errors of the order statistics of these ranks; not a number where they
    /// were not asked for.
    errors: [f64; 2],
    /// The rank of the lower end, from 1, and the largest that it can have.
    rank: u64,
    most: u64,
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
        Some(Self { trials, ends, errors, rank, most: trials.saturating_sub(q).max(1) })
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
    /// From the batches of a run of `total` trials.
    pub(super) fn of(mut batches: Vec<BatchInterval>, total: u64) -> Self {
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
        let nearly_all = |is: &dyn Fn(&BatchInterval) -> bool| {
            10 * batches.iter().filter(|batch| is(batch)).count() >= 9 * batches.len()
        };
        let at_limit = [
            nearly_all(&|batch| batch.rank <= LOWEST && batch.most > MANY_PLACES),
            nearly_all(&|batch| batch.most - batch.rank < LOWEST && batch.most > MANY_PLACES),
        ];
        let errors = [0, 1].map(|end| {
            let scatter =
                variance(&batches.iter().map(|batch| batch.ends[end]).collect::<Vec<_>>());
            let squares = batches.iter().map(|batch| batch.errors[end].powi(2));
            let known: Vec<f64> = squares.filter(|square| square.is_finite()).collect();
            let quantile = known.iter().sum::<f64>() / known.len().max(1) as f64;
            let by_quantile = ratio * quantile;
            if at_limit[1 - end] {
                return by_quantile.sqrt();
            }
            let third = elementary::cbrt(ratio);
            if at_limit[end] {
                // the least of the trials would come as near to the limit as there are trials, but a
                // peak may lie too near to the limit for a batch to tell, so this may be too large
                return third * scatter.sqrt();
            }
            if scatter > 2.0 * quantile {
                return third * scatter.sqrt();
            }
            // an end that scatters little more than a quantile
            (by_quantile + third * third * f64::max(scatter - quantile, 0.0)).sqrt()
        });
        Self { errors, unique: true }
    }
}

/// The variance of some values, with divisor n - 1.
fn variance(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0)
}
