//! Profile paths of a posterior: where a parameter is hardly known, the others follow it along a curve
//! that a mixture about the mode leaves. The curve is found by holding the parameter at values over all
//! of its prior and maximizing over everything else, as for a profile likelihood.

use nalgebra::DMatrix;

use crate::integral::mixture::Mixture;
use crate::integral::search::{self, Mode};
use crate::latent::EDGE;
use crate::likelihood::Likelihood;
use gumption_engine::number::{elementary, smallest_first};

/// Values of a parameter over its prior.
const VALUES: usize = 16;

/// Normal scores are held within this of 0.
const FAR: f64 = 3.0;

/// Modes from which ridges are followed, at most.
const MOST_MODES: usize = 3;

/// Points are added where a ridge bends, this often at most.
const ROUNDS: usize = 3;

/// Points whose density is lower than the mode's by this factor's logarithm are left out.
const DEPTH: f64 = 10.0;

/// The spread of a component along the ridge, in distances between neighbouring points.
const SPREAD: f64 = 0.6;

/// A point of a ridge: the best of everything else with one score held.
struct RidgePoint {
    held: usize,
    best: Mode,
}

/// A mixture along the ridges through the best modes, in the scores after the first `shared` ones;
/// none where the posterior is narrow in all of them.
pub(crate) fn mixture(
    likelihood: &Likelihood<'_>,
    modes: &[Mode],
    shared: usize,
) -> Option<Mixture> {
    let bounded = likelihood.bounded();
    let best = modes.iter().map(|mode| mode.cost).fold(f64::INFINITY, f64::min);
    let mut components = Vec::new();
    for mode in modes.iter().take(MOST_MODES).filter(|mode| mode.cost < best + 3.0) {
        let starts: Vec<(usize, Vec<f64>)> = (shared..bounded.len())
            .flat_map(|held| {
                let most = if bounded[held] { EDGE } else { FAR };
                (0..VALUES).map(move |n| {
                    let value = most * ((2 * n + 1) as f64 / VALUES as f64 - 1.0);
                    (held, follow(mode, held, value))
                })
            })
            .collect();
        let mut points = climb(likelihood, &starts, best);
        for _ in 0..ROUNDS {
            let between = bends(&points);
            if between.is_empty() {
                break;
            }
            points.extend(climb(likelihood, &between, best));
        }
        for held in shared..bounded.len() {
            let own: Vec<&RidgePoint> = ridge(&points, held);
            if own.len() > 1 {
                components.extend((0..own.len()).filter_map(|n| component(&own, n, &bounded)));
            }
        }
    }
    (!components.is_empty()).then(|| Mixture::of(&bounded, components))
}

/// Where a score is at `value` and the others follow in the Gaussian approximation at the mode.
fn follow(mode: &Mode, held: usize, value: f64) -> Vec<f64> {
    let move_by = value - mode.scores[held];
    let mut scores = mode.scores.clone();
    let slopes = search::freed(&mode.information, held).cholesky().map(|root| {
        let mut column = mode.information.column(held).into_owned();
        column[held] = 0.0;
        root.solve(&column)
    });
    if let Some(slopes) = slopes {
        scores.iter_mut().zip(slopes.iter()).for_each(|(score, slope)| *score -= slope * move_by);
    }
    scores[held] = value;
    scores
}

/// The points reached from starts, those far below the best mode left out.
fn climb(likelihood: &Likelihood<'_>, starts: &[(usize, Vec<f64>)], best: f64) -> Vec<RidgePoint> {
    search::profile(likelihood, starts)
        .into_iter()
        .filter(|(_, mode)| mode.cost < best + DEPTH)
        .map(|(held, best)| RidgePoint { held, best })
        .collect()
}

/// The points of one ridge in order.
fn ridge(points: &[RidgePoint], held: usize) -> Vec<&RidgePoint> {
    let mut own: Vec<&RidgePoint> = points.iter().filter(|point| point.held == held).collect();
    smallest_first(&mut own, |a| a.best.scores[held]);
    own
}

/// Starts between neighbours of points that the straight line through their neighbours misses by
/// more than a standard deviation.
fn bends(points: &[RidgePoint]) -> Vec<(usize, Vec<f64>)> {
    let last = points.iter().map(|point| point.held).max().unwrap_or(0);
    let mut starts = Vec::new();
    for held in 0..=last {
        let own = ridge(points, held);
        let bent: Vec<bool> = (0..own.len())
            .map(|n| {
                if n == 0 || n + 1 == own.len() {
                    return false;
                }
                let [before, here, after] = [n - 1, n, n + 1].map(|n| &own[n].best.scores);
                let share = (here[held] - before[held]) / (after[held] - before[held]);
                let missed = nalgebra::DVector::from_iterator(
                    here.len(),
                    (0..here.len()).map(|i| before[i] + share * (after[i] - before[i]) - here[i]),
                );
                (&own[n].best.information * &missed).dot(&missed) > 1.0
            })
            .collect();
        for n in 1..own.len() {
            if bent[n - 1] || bent[n] {
                let (a, b) = (&own[n - 1].best.scores, &own[n].best.scores);
                starts.push((held, a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()));
            }
        }
    }
    starts
}

/// A component about a point of a ridge: as wide as the others are known there, and along the ridge
/// as long as the distance to its neighbours. Logarithm of its weight, mean and scale.
fn component(
    ridge: &[&RidgePoint],
    n: usize,
    bounded: &[bool],
) -> Option<(f64, Vec<f64>, DMatrix<f64>)> {
    let RidgePoint { held, best } = ridge[n];
    let before = &ridge[n.saturating_sub(1)].best.scores;
    let after = &ridge[(n + 1).min(ridge.len() - 1)].best.scores;
    let steps = if n == 0 || n + 1 == ridge.len() { 1.0 } else { 2.0 };
    let tangent = nalgebra::DVector::from_iterator(
        before.len(),
        before.iter().zip(after).map(|(a, b)| SPREAD * (b - a) / steps),
    );
    let mut scale = search::freed(&best.information, *held).try_inverse()?;
    scale[(*held, *held)] = 0.0;
    scale += &tangent * tangent.transpose();
    // the prior of bounded scores is flat
    let flat: f64 =
        best.scores.iter().zip(bounded).filter(|(_, b)| **b).map(|(s, _)| 0.5 * s * s).sum();
    let half_ln_det: f64 =
        scale.clone().cholesky()?.l().diagonal().iter().copied().map(elementary::ln).sum();
    Some((-0.7 * (best.cost - flat) + half_ln_det, best.scores.clone(), scale))
}
