//! Gaussian processes: functions of several variables from their values at some points.

use gumption_engine::linalg::dot;

use crate::conditioned::{Conditioned, Nugget, Target, ValueScatter};
use crate::lengths::ScatteredLengths;
use crate::matern::{correlation, correlations};
use crate::trend::Trend;

/// Functions of several variables that vary at the same lengths, each known at the same points: Gaussian
/// processes with the covariance function of Matérn, ν = 5/2, about a [`Trend`] (Rasmussen and Williams
/// 2006, 2.2 and 2.7). The variance of each is that of its greatest likelihood.
///
/// ```
/// use gumption_emulator::{GaussianProcess, Trend, likeliest_lengths};
///
/// let points: Vec<Vec<f64>> = (0..9).map(|i| vec![-1.0 + 0.25 * f64::from(i)]).collect();
/// let squares: Vec<f64> = points.iter().map(|p| p[0] * p[0]).collect();
/// let lengths = likeliest_lengths(&points, &squares, Trend::Linear, None);
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

impl GaussianProcess {
    /// The functions with these values at points, which vary at lengths with these logarithms.
    pub fn new(
        points: Vec<Vec<f64>>,
        values: &[Vec<f64>],
        trend: Trend,
        ln_lengths: &[f64],
    ) -> Self {
        let conditioned = Conditioned::new(points, trend, ln_lengths, None);
        let targets = values.iter().map(|values| conditioned.target(values)).collect();
        Self { conditioned, targets }
    }

    /// A function whose values at points scatter about it: it passes between them. Its value and deviation
    /// somewhere are those of the function, without the scatter.
    pub fn scattered(
        points: Vec<Vec<f64>>,
        values: &[f64],
        trend: Trend,
        lengths: &ScatteredLengths,
        scatter: ValueScatter,
    ) -> Self {
        let nugget = Nugget { share: lengths.share, scatter };
        let conditioned = Conditioned::new(points, trend, &lengths.ln_lengths, Some(nugget));
        let targets = vec![conditioned.target(values)];
        Self { conditioned, targets }
    }

    /// The expected value of each function at a point.
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        let Conditioned { points, inverse_squares, .. } = &self.conditioned;
        let correlations = correlations(point, points, inverse_squares);
        self.targets.iter().map(|target| target.value(point, &correlations)).collect()
    }

    /// The standard deviation of the value of each function at a point that comes from the scatter of the values
    /// that it was learnt from.
    pub(crate) fn scattered_deviations(&self, point: &[f64]) -> Vec<f64> {
        let Conditioned { points, inverse_squares, .. } = &self.conditioned;
        let correlations = correlations(point, points, inverse_squares);
        let variance = self.conditioned.scattered(correlations, point);
        vec![variance.sqrt(); self.targets.len()]
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
                .map(|(j, slopes)| dot(slopes, &target.weights) + target.trend_slope(j))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::halton::space_filling_scores;
    use crate::lengths::{likeliest_lengths, scattered_lengths};
    use crate::uniforms::Uniforms;
    use gumption_engine::distribution::StreamKey;
    use gumption_engine::special::normal;

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
        let lengths = likeliest_lengths(&points, &values, trend, None);
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

    /// A noisy function, ten times: the errors of what is found for it beside the points are as large as its
    /// deviations say. The mean square of ten times 35 errors in units of the deviations is 1 within a factor of
    /// two: those of one time go together, and count as about five. Each value scatters by 0.05, and the function
    /// that passes between them is off by clearly less: some 12 lengths of 60 values leave a root of a fifth,
    /// more at the edges. With a scatter of a millionth it goes through them.
    #[test]
    fn a_noisy_function_is_known_as_well_as_its_deviation_says() {
        let points = points(95);
        let (known, unseen) = points.split_at(60);
        let noisy = |block: u64| -> Vec<f64> {
            let mut random = Uniforms::new(StreamKey::new(2, "noisy"), block);
            known.iter().map(|p| wave(p) + 0.05 * normal::quantile(random.next())).collect()
        };
        let fitted = |values: &[f64], variance: f64| {
            let scatter = ValueScatter { variance, count: 60 };
            let lengths = scattered_lengths(known, values, Trend::Linear, scatter, None);
            GaussianProcess::scattered(known.to_vec(), values, Trend::Linear, &lengths, scatter)
        };
        let (mut relative, mut square) = (0.0, 0.0);
        for block in 0..10 {
            let process = fitted(&noisy(block), 0.05 * 0.05);
            for point in unseen {
                let there = &process.predict(point)[0];
                let error = there.value - wave(point);
                relative += (error / there.deviation).powi(2) / 350.0;
                square += error * error / 350.0;
            }
        }
        assert!((0.5..2.0).contains(&relative), "{relative}");
        assert!(square.sqrt() < 0.035, "{square}");
        let values = noisy(0);
        let through = fitted(&values, 1e-12);
        for (point, value) in known.iter().zip(&values) {
            assert!((through.values(point)[0] - value).abs() < 1e-4);
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
