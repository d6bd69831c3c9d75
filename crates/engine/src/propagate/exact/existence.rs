//! Whether an output has an expectation and a standard deviation, as far as its inputs tell one by one.

use super::Problem;
use super::tails::diverges;
use super::term::{End, ring_at_end};
use crate::distribution::Distribution;
use crate::number::elementary;
use crate::propagate::golden_section;

/// Probabilities between whose quantiles a pole is looked for, below the median. Where the input comes to
/// it with less than the first, no number of trials would tell that a moment does not exist.
const NODES: [f64; 16] =
    [1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45];

/// Golden sections after which a pole is known to 1e-11 of where it was looked for.
const SECTIONS: u32 = 54;

/// Distances from a pole, in parts of where it was looked for, from whose outputs its order follows.
const DISTANCES: [f64; 2] = [1e-6, 1e-9];

/// What the order of a pole may be off by.
const OF_ORDER: f64 = 0.02;

/// The order of the sharpest pole of a function along points of its argument, 1 for 1/x; that of a
/// function without one is about 0. `heights` are its moduli at the points, `modulus` that at a share of
/// the way from a point to the next one.
pub(crate) fn pole_order(heights: &[f64], modulus: impl Fn(usize, f64) -> f64) -> f64 {
    let mut most: f64 = 0.0;
    for place in 0..heights.len().saturating_sub(1) {
        // a pole lies beside the higher of two points, and its other side is no higher
        let from = place.saturating_sub(1);
        let to = (place + 2).min(heights.len() - 1);
        let highest = heights[from..=to].iter().copied().fold(0.0, f64::max);
        if heights[place].max(heights[place + 1]) < highest {
            continue;
        }
        let at = golden_section::least([0.0, 1.0], SECTIONS, |share| -modulus(place, share));
        for side in [-1.0, 1.0] {
            let [far, near] = DISTANCES.map(|distance| modulus(place, at + side * distance));
            let own = elementary::ln(near / far) / elementary::ln(DISTANCES[0] / DISTANCES[1]);
            if own.is_finite() {
                most = most.max(own);
            }
        }
    }
    most
}

/// The order of the sharpest pole of a function between quantiles of its argument.
fn order(distribution: &Distribution, modulus: impl Fn(f64) -> f64) -> f64 {
    let nodes = distribution.quantiles_about_median(&NODES);
    let heights: Vec<f64> = nodes.iter().map(|&node| modulus(node)).collect();
    pole_order(&heights, |place, share| {
        modulus(nodes[place] + share * (nodes[place + 1] - nodes[place]))
    })
}

/// Whether the expectation of the output exists, and that of its square: with the other inputs at their
/// medians, the tails of each input and the poles within its range add a finite amount to both. A
/// quotient whose divisor reaches zero often enough has neither.
pub(crate) fn of_moments(problem: &Problem<'_>) -> [bool; 2] {
    let row = problem.row;
    let median = |distribution: &Distribution| {
        distribution.constant().unwrap_or_else(|| distribution.quantile(0.5))
    };
    let quantiles = |distribution: &Distribution| {
        distribution.constant().is_some() || distribution.has_quantiles()
    };
    let mut exist = [true; 2];
    if !row.distributions.iter().all(|distribution| quantiles(distribution)) {
        return exist;
    }
    let medians = row.distributions.iter().map(|distribution| median(distribution));
    let mut values: Vec<f64> = medians.chain(row.conditions.iter().copied()).collect();
    for (place, distribution) in row.distributions.iter().enumerate() {
        if distribution.constant().is_some() {
            continue;
        }
        let order = order(distribution, |at| {
            let mut values = values.clone();
            values[place] = at;
            problem.task.model.program.evaluate(&values)[problem.output].abs()
        });
        for (exist, power) in exist.iter_mut().zip([1.0, 2.0]) {
            *exist &= power * order < 1.0 - OF_ORDER;
        }
        // tails lighter than any power
        let is_light =
            distribution.is_drawn_normal() || matches!(**distribution, Distribution::Lognormal(_));
        if is_light {
            continue;
        }
        for end in End::BOTH {
            // of the modulus and of the square, in the two innermost rings
            let [inner, outer] = [0, 1].map(|ring| {
                let mut sums = [0.0; 2];
                for [at, weight] in ring_at_end(distribution, end, ring) {
                    values[place] = at;
                    let y = problem.task.model.program.evaluate(&values)[problem.output].abs();
                    sums[0] += weight * y;
                    sums[1] += weight * y * y;
                }
                sums
            });
            values[place] = median(distribution);
            for (exist, (inner, outer)) in exist.iter_mut().zip(inner.into_iter().zip(outer)) {
                *exist &= !diverges(inner, outer);
            }
        }
    }
    exist
}
