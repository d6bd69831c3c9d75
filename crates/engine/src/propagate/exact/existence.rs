//! Whether an output has an expectation and a standard deviation, as far as its inputs tell one by one.

use super::Problem;
use super::tails::diverges;
use super::term::{End, ring_at_end};
use crate::distribution::Distribution;

/// Whether the expectation of the output exists, and that of its square: with the other inputs at their
/// medians, the tails of each input add a finite amount to both. A quotient whose divisor reaches zero
/// often enough has neither.
pub(crate) fn of_moments(problem: &Problem<'_>) -> [bool; 2] {
    let row = problem.row;
    let median = |of: &Distribution| of.constant().unwrap_or_else(|| of.quantile(0.5));
    let quantiles = |of: &Distribution| of.constant().is_some() || of.has_quantiles();
    let mut exist = [true; 2];
    if !row.distributions.iter().all(|of| quantiles(of)) {
        return exist;
    }
    let medians = row.distributions.iter().map(|of| median(of));
    let mut values: Vec<f64> = medians.chain(row.conditions.iter().copied()).collect();
    for (place, distribution) in row.distributions.iter().enumerate() {
        // tails lighter than any power
        let is_light =
            distribution.is_drawn_normal() || matches!(**distribution, Distribution::Lognormal(_));
        if distribution.constant().is_some() || is_light {
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
