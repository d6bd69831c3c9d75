//! How fast a function varies along each dimension, by greatest likelihood.

use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::triangle;
use gumption_engine::number::elementary;

use crate::conditioned::{Conditioned, Nugget, ValueScatter};
use crate::matern::correlation;
use crate::minimum::minimum;
use crate::trend::Trend;

/// The logarithm of the length that is likeliest beforehand: twice what the points' scale is.
const USUAL: f64 = 0.7;

/// How much the square of a logarithm's distance from the usual one counts against it: where the values do
/// not tell, the length is that.
const PULL: f64 = 0.02;

/// Logarithms of lengths are within this of 0.
const LIMIT: f64 = 4.0;

/// The logarithm of the scatter's share is this times what is looked for as lengths are.
const SHARE: f64 = 10.0;

/// Steps of the search at most.
const STEPS: usize = 20;

/// The logarithms of the lengths, one for each dimension, with which a function with these values at some
/// points is likeliest as a [`GaussianProcess`](crate::GaussianProcess), with a little in favour of a length of
/// 2. They are within -4 and 4. The search begins at those given, or at a length of 2, and makes 20 steps at
/// most.
pub fn likeliest_lengths(
    points: &[Vec<f64>],
    values: &[f64],
    trend: Trend,
    start: Option<&[f64]>,
) -> Vec<f64> {
    let usual = usual(points);
    minimum(start.unwrap_or(&usual), LIMIT, STEPS, |ln_lengths| {
        against(points, values, trend, ln_lengths, None)
    })
}

/// At which lengths a function varies whose values scatter, and how much.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatteredLengths {
    /// The logarithms of the lengths, one for each dimension.
    pub ln_lengths: Vec<f64>,
    /// The variance of the scatter, relative to that of the function.
    pub share: f64,
}

/// The same for values that scatter with a known variance: with it the variance of the function is found as the
/// lengths are, from 4e-18 to 2e17 of the scatter's. Its density beforehand is proportional to its root, so that it
/// is not zero where the values do not tell (Chung et al., Psychometrika 78 (2013) 685).
pub fn scattered_lengths(
    points: &[Vec<f64>],
    values: &[f64],
    trend: Trend,
    scatter: ValueScatter,
    start: Option<&[f64]>,
) -> ScatteredLengths {
    let mut at = start.map_or_else(|| usual(points), <[f64]>::to_vec);
    let mean = dot(values, values) / values.len().max(1) as f64;
    at.push(elementary::ln(scatter.variance / mean.max(f64::MIN_POSITIVE)) / SHARE);
    let mut ln_lengths = minimum(&at, LIMIT, STEPS, |at| {
        let (share, ln_lengths) = at.split_last().unwrap_or((&0.0, at));
        let nugget = Nugget { share: elementary::exp(SHARE * share), scatter };
        let (value, mut gradient) = against(points, values, trend, ln_lengths, Some(nugget));
        gradient.iter_mut().skip(ln_lengths.len()).for_each(|slope| *slope *= SHARE);
        (value, gradient)
    });
    let share = elementary::exp(SHARE * ln_lengths.pop().unwrap_or(0.0));
    ScatteredLengths { ln_lengths, share }
}

fn usual(points: &[Vec<f64>]) -> Vec<f64> {
    vec![USUAL; points.first().map_or(0, Vec::len)]
}

/// Minus the logarithm of the likelihood of lengths, and of the scatter's share where there is one, with the
/// trend and without scatter the variance at their likeliest, and its gradient (Rasmussen and Williams 2006,
/// equation 5.9), at last by the logarithm of the share.
fn against(
    points: &[Vec<f64>],
    values: &[f64],
    trend: Trend,
    ln_lengths: &[f64],
    nugget: Option<Nugget>,
) -> (f64, Vec<f64>) {
    let conditioned = Conditioned::new(points.to_vec(), trend, ln_lengths, nugget);
    let target = conditioned.target(values);
    let count = values.len() as f64;
    let mut likelihood = 0.5 * count * elementary::ln(target.variance) + conditioned.ln_root();
    let inverse = conditioned.inverse();
    let mut gradient = vec![0.0; ln_lengths.len()];
    let squares = &conditioned.inverse_squares;
    for (i, a) in points.iter().enumerate() {
        for (k, b) in points[..i].iter().enumerate() {
            let explained = target.weights[i] * target.weights[k] / target.variance;
            let factor =
                (inverse[triangle(i) + k] - explained) * correlation(a, b, squares).falling;
            for (j, gradient) in gradient.iter_mut().enumerate() {
                *gradient += factor * (a[j] - b[j]) * (a[j] - b[j]) * squares[j];
            }
        }
    }
    let mut pull = 0.0;
    for (ln, gradient) in ln_lengths.iter().zip(&mut gradient) {
        pull += PULL * (ln - USUAL) * (ln - USUAL);
        *gradient += 2.0 * PULL * (ln - USUAL);
    }
    if let Some(Nugget { share, scatter }) = nugget {
        let fit = target.squares / target.variance;
        likelihood += 0.5 * (fit + elementary::ln(share));
        let own = |i: usize| {
            let explained = target.weights[i] * target.weights[i] / target.variance;
            inverse[triangle(i) + i] - explained
        };
        let own: f64 = (0..scatter.count.min(points.len())).map(own).sum();
        gradient.push(0.5 * (share * own + fit - count + 1.0));
    }
    (likelihood + pull, gradient)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::halton::space_filling_scores;
    use gumption_engine::distribution::StreamKey;

    fn points() -> Vec<Vec<f64>> {
        space_filling_scores(20, 3, StreamKey::new(3, "lengths"))
    }

    /// Differences over 1e-4 have an error of 1e-8 times the third derivative, which is of the order of the
    /// 20 values. A part of the likelihood is the logarithm of a determinant of many small pivots: its
    /// rounding is 1e-16 over the smallest, 1e-7.
    #[test]
    fn the_gradient_is_that_of_the_likelihood() {
        let points = points();
        let values: Vec<f64> =
            points.iter().map(|p| p[0].sin() + 0.3 * p[1] * p[1] + 0.1 * p[2]).collect();
        for trend in [Trend::None, Trend::Linear] {
            for at in [[0.7, 0.7, 0.7], [0.1, -0.5, 1.5]] {
                let (_, gradient) = against(&points, &values, trend, &at, None);
                for j in 0..3 {
                    let value = |step: f64| {
                        let mut moved = at;
                        moved[j] += step;
                        against(&points, &values, trend, &moved, None).0
                    };
                    let difference = (value(1e-4) - value(-1e-4)) / 2e-4;
                    assert!((gradient[j] - difference).abs() < 1e-5, "{trend:?} {j}");
                }
            }
        }
    }

    /// The same with a scatter of all values but the last five, by the logarithm of its share as well.
    #[test]
    fn the_gradient_with_scatter_is_that_of_the_likelihood() {
        let points = points();
        let values: Vec<f64> = points.iter().map(|p| p[0].sin() + 0.3 * p[1] * p[1]).collect();
        let scatter = ValueScatter { variance: 0.01, count: 15 };
        for trend in [Trend::None, Trend::Linear] {
            let at = [0.1, -0.5, 1.5, -3.0];
            let there = |at: [f64; 4]| {
                let nugget = Nugget { share: at[3].exp(), scatter };
                against(&points, &values, trend, &at[..3], Some(nugget))
            };
            let (_, gradient) = there(at);
            for j in 0..4 {
                let value = |step: f64| {
                    let mut moved = at;
                    moved[j] += step;
                    there(moved).0
                };
                let difference = (value(1e-4) - value(-1e-4)) / 2e-4;
                let error = (gradient[j] - difference).abs();
                assert!(error < 1e-5 * (1.0 + difference.abs()), "{trend:?} {j} {error}");
            }
        }
    }

    /// A function of one of three variables: the other two get long lengths.
    #[test]
    fn variables_without_influence_get_long_lengths() {
        let points = points();
        let values: Vec<f64> = points.iter().map(|p| (2.0 * p[0]).sin()).collect();
        let found = likeliest_lengths(&points, &values, Trend::None, None);
        assert!(found[0] < 1.0 && found[1] > 2.0 && found[2] > 2.0, "{found:?}");
    }
}
