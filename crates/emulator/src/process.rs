//! Gaussian processes: functions of several variables from their values at some points.

use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::{self, triangle};

use crate::lengths;
use crate::matern::{correlation, inverse_squares};
use crate::singular::add_multiple;
use crate::trend::{Trend, functions};

/// What is added to the correlation of each value with itself, so that rounding leaves it positive definite.
const NUGGET: f64 = 1e-9;

/// The same for the functions of the trend, relative.
const RIDGE: f64 = 1e-12;

/// The least variance of a residual that is taken for one.
const LEAST_VARIANCE: f64 = 1e-30;

/// Functions of several variables that vary at the same lengths, each known at the same points: Gaussian
/// processes with the covariance function of Matérn, ν = 5/2, about a [`Trend`] (Rasmussen and Williams
/// 2006, 2.2 and 2.7). The variance of each is that of its greatest likelihood.
///
/// ```
/// use gumption_emulator::{GaussianProcess, Trend};
///
/// let points: Vec<Vec<f64>> = (0..9).map(|i| vec![-1.0 + 0.25 * f64::from(i)]).collect();
/// let squares: Vec<f64> = points.iter().map(|p| p[0] * p[0]).collect();
/// let lengths = GaussianProcess::likeliest_lengths(&points, &squares, Trend::Linear, None);
/// let process = GaussianProcess::new(points, &[squares], Trend::Linear, &lengths);
/// let between = &process.predict(&[0.1])[0];
/// assert!((between.value - 0.01).abs() < 1e-3 && (between.gradient[0] - 0.2).abs() < 1e-2);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianProcess {
    conditioned: Conditioned,
    targets: Vec<Target>,
}

/// A value of a Gaussian process between its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficient {
    /// The expected value.
    pub value: f64,
    /// Its derivative along each dimension.
    pub gradient: Vec<f64>,
    /// Its standard deviation.
    pub deviation: f64,
}

/// Points and lengths made ready for values at them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Conditioned {
    pub(crate) points: Vec<Vec<f64>>,
    pub(crate) inverse_squares: Vec<f64>,
    /// The Cholesky root of the correlations, a packed lower triangle.
    pub(crate) root: Vec<f64>,
    /// The functions of the trend at the points, whitened by the root.
    trend: Vec<Vec<f64>>,
    /// The Cholesky root of their products with each other.
    trend_root: Vec<f64>,
}

/// A function, as its values at the points give it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Target {
    /// What the correlations with the points are multiplied by.
    pub(crate) weights: Vec<f64>,
    /// What the functions of the trend are multiplied by.
    trend: Vec<f64>,
    pub(crate) variance: f64,
}

impl Conditioned {
    pub(crate) fn new(points: Vec<Vec<f64>>, trend: Trend, ln_lengths: &[f64]) -> Self {
        let inverse_squares = inverse_squares(ln_lengths);
        let mut root = Vec::with_capacity(triangle(points.len()));
        for (i, point) in points.iter().enumerate() {
            root.extend(points[..i].iter().map(|b| correlation(point, b, &inverse_squares).value));
            root.push(1.0 + NUGGET);
        }
        packed::cholesky_of_definite(&mut root);
        let count = trend.functions(points.len(), ln_lengths.len());
        let mut trend = vec![Vec::with_capacity(points.len()); count];
        for point in &points {
            for (column, function) in trend.iter_mut().zip(functions(count, point)) {
                column.push(function);
            }
        }
        let mut trend_root = Vec::new();
        for i in 0..count {
            packed::solve(&root, &mut trend[i]);
            trend_root.extend(trend[..i].iter().map(|other| dot(other, &trend[i])));
            trend_root.push(dot(&trend[i], &trend[i]) * (1.0 + RIDGE));
        }
        packed::cholesky_of_definite(&mut trend_root);
        Self { points, inverse_squares, root, trend, trend_root }
    }

    /// The function with these values at the points.
    pub(crate) fn target(&self, values: &[f64]) -> Target {
        let mut residual = values.to_vec();
        packed::solve(&self.root, &mut residual);
        let mut trend: Vec<f64> = self.trend.iter().map(|of| dot(of, &residual)).collect();
        packed::solve(&self.trend_root, &mut trend);
        packed::solve_transposed(&self.trend_root, &mut trend);
        for (factor, of) in trend.iter().zip(&self.trend) {
            add_multiple(&mut residual, -factor, of);
        }
        let variance = dot(&residual, &residual) / values.len().max(1) as f64 + LEAST_VARIANCE;
        packed::solve_transposed(&self.root, &mut residual);
        Target { weights: residual, trend, variance }
    }

    /// Half the logarithm of the determinant of the correlations.
    pub(crate) fn ln_root(&self) -> f64 {
        packed::ln_diagonal(&self.root)
    }

    /// The inverse of the correlations, a packed lower triangle.
    pub(crate) fn inverse(&self) -> Vec<f64> {
        let mut root = self.root.clone();
        packed::invert(&mut root);
        let mut inverse = vec![0.0; root.len()];
        for row in packed::rows(&root) {
            for (i, &factor) in row.iter().enumerate() {
                add_multiple(&mut inverse[triangle(i)..triangle(i + 1)], factor, &row[..=i]);
            }
        }
        inverse
    }

    /// The variance, relative to that of a target, that the points leave at one with these correlations to
    /// them.
    fn left(&self, mut correlations: Vec<f64>, point: &[f64]) -> f64 {
        packed::solve(&self.root, &mut correlations);
        let known = dot(&correlations, &correlations);
        let count = self.trend.len();
        let trend = functions(count, point).zip(&self.trend);
        let mut unknown: Vec<f64> =
            trend.map(|(function, of)| function - dot(of, &correlations)).collect();
        packed::solve(&self.trend_root, &mut unknown);
        (1.0 - known).max(NUGGET) + dot(&unknown, &unknown)
    }
}

impl GaussianProcess {
    /// The logarithms of the lengths, one for each dimension, with which a function is likeliest, and a
    /// little for lengths near 2; the lengths are within e^-4 and e^4. The search begins at those given, or
    /// at 2, and makes 20 steps at most.
    pub fn likeliest_lengths(
        points: &[Vec<f64>],
        values: &[f64],
        trend: Trend,
        start: Option<&[f64]>,
    ) -> Vec<f64> {
        lengths::likeliest(points, values, trend, start)
    }

    /// The functions with these values at points, which vary at lengths with these logarithms.
    pub fn new(
        points: Vec<Vec<f64>>,
        values: &[Vec<f64>],
        trend: Trend,
        ln_lengths: &[f64],
    ) -> Self {
        let conditioned = Conditioned::new(points, trend, ln_lengths);
        let targets = values.iter().map(|values| conditioned.target(values)).collect();
        Self { conditioned, targets }
    }

    /// The expected value of each function at a point.
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        let Conditioned { points, inverse_squares, .. } = &self.conditioned;
        let correlations: Vec<f64> =
            points.iter().map(|known| correlation(point, known, inverse_squares).value).collect();
        self.targets.iter().map(|target| target.value(point, &correlations)).collect()
    }

    /// The expected value of each function at a point, its gradient and its standard deviation.
    pub fn predict(&self, point: &[f64]) -> Vec<Coefficient> {
        let Conditioned { points, inverse_squares, .. } = &self.conditioned;
        let mut correlations = Vec::with_capacity(points.len());
        // the derivatives of the correlations, of all points along one dimension after the other
        let mut slopes = vec![Vec::with_capacity(points.len()); point.len()];
        for known in points {
            let to = correlation(point, known, inverse_squares);
            correlations.push(to.value);
            for (j, slopes) in slopes.iter_mut().enumerate() {
                slopes.push(-to.falling * inverse_squares[j] * (point[j] - known[j]));
            }
        }
        let coefficient = |target: &Target| Coefficient {
            value: target.value(point, &correlations),
            gradient: slopes
                .iter()
                .enumerate()
                .map(|(j, slopes)| {
                    dot(slopes, &target.weights) + target.trend.get(j + 1).copied().unwrap_or(0.0)
                })
                .collect(),
            deviation: target.variance,
        };
        let mut coefficients: Vec<Coefficient> = self.targets.iter().map(coefficient).collect();
        let left = self.conditioned.left(correlations, point);
        for coefficient in &mut coefficients {
            coefficient.deviation = (coefficient.deviation * left).sqrt();
        }
        coefficients
    }
}

impl Target {
    fn value(&self, point: &[f64], correlations: &[f64]) -> f64 {
        let trend = functions(self.trend.len(), point).zip(&self.trend);
        let trend: f64 = trend.map(|(function, factor)| function * factor).sum();
        trend + dot(correlations, &self.weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::halton::space_filling_scores;
    use gumption_engine::distribution::StreamKey;

    /// Points of a plane, about -1 to 1.
    fn points(count: usize) -> Vec<Vec<f64>> {
        let mut points = space_filling_scores(count, 2, StreamKey::new(1, "process"));
        points.iter_mut().flatten().for_each(|x| *x /= 3.0);
        points
    }

    fn wave(p: &[f64]) -> f64 {
        (1.5 * p[0]).sin() * (0.5 * p[1]).exp() + 3.0 * p[0]
    }

    fn fitted(count: usize, trend: Trend, of: impl Fn(&[f64]) -> f64) -> GaussianProcess {
        let points = points(count);
        let values: Vec<f64> = points.iter().map(|p| of(p)).collect();
        let lengths = GaussianProcess::likeliest_lengths(&points, &values, trend, None);
        GaussianProcess::new(points, &[values], trend, &lengths)
    }

    /// What is added to the diagonal counts as a variance of each value, of which the deviation at a point is
    /// the root; it was chosen so that this is small.
    #[test]
    fn it_goes_through_its_points() {
        for trend in [Trend::None, Trend::Linear] {
            let process = fitted(30, trend, wave);
            for point in points(30) {
                let there = &process.predict(&point)[0];
                assert!((there.value - wave(&point)).abs() < 3.0 * there.deviation, "{there:?}");
                assert!(there.deviation < 1e-3, "{there:?}");
            }
        }
    }

    /// Differences over 1e-3 have an error of 2e-7 times the third derivative, which is of the order of 10, and
    /// a rounding of 1e-16 times the sum of the weights, of up to some 10 millions, over 1e-3.
    #[test]
    fn gradients_are_those_of_the_values() {
        for trend in [Trend::None, Trend::Linear] {
            let process = fitted(30, trend, wave);
            for point in [[0.1, -0.2], [0.9, 0.4], [-1.3, 1.1]] {
                let there = process.predict(&point).remove(0);
                assert_eq!(process.values(&point), [there.value]);
                for j in 0..2 {
                    let at = |step: f64| {
                        let mut moved = point;
                        moved[j] += step;
                        process.values(&moved)[0]
                    };
                    let difference = (at(1e-3) - at(-1e-3)) / 2e-3;
                    assert!((there.gradient[j] - difference).abs() < 5e-6, "{trend:?} {point:?}");
                }
            }
        }
    }

    /// A plane is its own trend: nothing is left for the process, near the points or far from them.
    #[test]
    fn a_plane_is_known_everywhere() {
        let plane = |p: &[f64]| 2.0 - p[0] + 0.5 * p[1];
        let process = fitted(12, Trend::Linear, plane);
        for point in [[0.3, 0.3], [5.0, -4.0]] {
            let there = &process.predict(&point)[0];
            // the ridge of 1e-12 and rounding, at 5 times the size of the points
            assert!((there.value - plane(&point)).abs() < 1e-10, "{there:?}");
            assert!(there.deviation < 1e-9, "{there:?}");
            assert!((there.gradient[0] + 1.0).abs() < 1e-10, "{there:?}");
        }
    }

    /// By hand: one point at 0 with the value 2, without a trend; at the distance at which r = 1 the
    /// correlation is (7/3)/e. The variance of the greatest likelihood is 2² = 4.
    #[test]
    fn one_point_by_hand() {
        let process = GaussianProcess::new(vec![vec![0.0]], &[vec![2.0]], Trend::None, &[0.0]);
        let there = process.predict(&[1.0 / 5f64.sqrt()]).remove(0);
        let correlation = 7.0 / 3.0 / std::f64::consts::E;
        // within the 1e-9 on the diagonal
        assert!((there.value - 2.0 * correlation).abs() < 1e-8);
        assert!((there.deviation - 2.0 * (1.0 - correlation * correlation).sqrt()).abs() < 1e-8);
    }

    /// Values beside those it learnt from lie within a few of its own standard deviations: of a smooth
    /// function, for which the covariance function is too rough, well within.
    #[test]
    fn deviations_hold_what_was_not_seen() {
        let process = fitted(25, Trend::Linear, wave);
        let unseen = &points(60)[25..];
        for point in unseen {
            let there = &process.predict(point)[0];
            assert!((there.value - wave(point)).abs() < 4.0 * there.deviation, "{there:?}");
        }
    }
}
