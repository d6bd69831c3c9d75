//! How fast a function varies along each dimension, by greatest likelihood.

use gumption_engine::linalg::packed::triangle;
use gumption_engine::number::elementary;

use crate::conditioned::Conditioned;
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
    let usual = vec![USUAL; points.first().map_or(0, Vec::len)];
    minimum(start.unwrap_or(&usual), LIMIT, STEPS, |ln_lengths| {
        against(points, values, trend, ln_lengths)
    })
}

/// Minus the logarithm of the likelihood of lengths, with the variance and the trend at their likeliest,
/// and its gradient (Rasmussen and Williams 2006, equation 5.9).
fn against(
    points: &[Vec<f64>],
    values: &[f64],
    trend: Trend,
    ln_lengths: &[f64],
) -> (f64, Vec<f64>) {
    let conditioned = Conditioned::new(points.to_vec(), trend, ln_lengths);
    let target = conditioned.target(values);
    let count = values.len() as f64;
    let likelihood = 0.5 * count * elementary::ln(target.variance) + conditioned.ln_root();
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
                let (_, gradient) = against(&points, &values, trend, &at);
                for j in 0..3 {
                    let value = |step: f64| {
                        let mut moved = at;
                        moved[j] += step;
                        against(&points, &values, trend, &moved).0
                    };
                    let difference = (value(1e-4) - value(-1e-4)) / 2e-4;
                    assert!((gradient[j] - difference).abs() < 1e-5, "{trend:?} {j}");
                }
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
