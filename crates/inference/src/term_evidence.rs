//! The evidence of a departure of one term, its linear amplitudes in closed form.
//!
//! The data are y = sim + J x + a k(1) g(1) + a k(2) g(2) + noise: the inputs x and the factors k are
//! normal, so that the evidence at an amplitude a is exact. The amplitude is in standard uncertainties
//! (root mean square over the values that are touched) and log-uniform over three decades; the
//! parameters of g are uniform in shares of their ranges. Those are integrated on a grid, or by
//! Laplace's method about the best point where the grid is too coarse for what the data tell.

use nalgebra::{DMatrix, DVector};

use super::metric::{Metric, White};
use super::shape::Shape;
use crate::logarithm::{HALF_LN_TWO_PI, ln_add};
use crate::setup::Setup;
use gumption_engine::linalg::dot;
use gumption_engine::number::elementary;

/// Amplitudes in standard uncertainties, and the points of the integral over their logarithm.
const AMPLITUDES: [f64; 2] = [3.0, 3000.0];
const STEPS: usize = 15;

/// Rounds of the search between the values of a grid.
const ROUNDS: usize = 40;

/// The first step of second differences, as a share of a parameter's range.
const STEP: f64 = 1e-3;

/// The widest standard deviation of a parameter that is uniform in its range, as a share of it.
const WIDEST: f64 = 0.288_675_134_594_812_9;

/// What a departure of a target does to the data, in a metric.
#[derive(Debug)]
pub struct Frame<'m> {
    metric: &'m Metric<'m>,
    setup: &'m Setup<'m>,
    sensitivities: Vec<f64>,
    residuals: &'m White,
    by_point: Option<ByPoint>,
    touched: f64,
}

/// Sums over the values of each point, where rows are independent.
#[derive(Debug)]
struct ByPoint {
    squares: Vec<f64>,
    products: Vec<f64>,
    basis: Vec<Vec<f64>>,
}

/// The amplitudes of a departure with known functions.
#[derive(Clone, Debug)]
pub struct Fit {
    /// By how much the logarithm of the evidence is above that without the departure.
    pub gain: f64,
    /// What each function is multiplied by, at the most probable amplitude.
    pub factors: Vec<f64>,
    /// The covariance matrix of these.
    pub covariance: DMatrix<f64>,
}

impl<'m> Frame<'m> {
    /// `None` where the departure does nothing to the data.
    pub fn new(
        metric: &'m Metric<'m>,
        setup: &'m Setup<'m>,
        sensitivities: &[f64],
        residuals: &'m White,
    ) -> Option<Self> {
        let touched = sensitivities.iter().filter(|s| **s != 0.0).count() as f64;
        if touched == 0.0 || sensitivities.iter().any(|s| !s.is_finite()) {
            return None;
        }
        let by_point = metric.is_by_row().then(|| {
            let white = metric.whiten(sensitivities);
            let data = &setup.data;
            let (points, outputs) = (data.points.len(), data.outputs.len());
            let sums = |other: &[f64]| {
                let mut sums = vec![0.0; points];
                for (row, &point) in data.point_of.iter().enumerate() {
                    let own = row * outputs..(row + 1) * outputs;
                    sums[point] += dot(&white[own.clone()], &other[own]);
                }
                sums
            };
            ByPoint {
                squares: sums(&white),
                products: sums(&residuals.values),
                basis: metric.basis().iter().map(|column| sums(column)).collect(),
            }
        });
        let sensitivities = sensitivities.to_vec();
        Some(Self { metric, setup, sensitivities, residuals, by_point, touched })
    }

    /// What the functions, given by point, do to the data: by value.
    pub(crate) fn column(&self, by_point: &[f64]) -> Vec<f64> {
        let outputs = self.setup.data.outputs.len();
        let of = |(value, s): (usize, &f64)| {
            let g = by_point[self.setup.data.point_of[value / outputs]];
            if *s == 0.0 { 0.0 } else { s * g }
        };
        self.sensitivities.iter().enumerate().map(of).collect()
    }

    /// The amplitudes of functions given by point; `None` where they are not finite or do nothing.
    pub(crate) fn fit(&self, columns: &[Vec<f64>]) -> Option<Fit> {
        if columns.iter().flatten().any(|g| !g.is_finite()) {
            return None;
        }
        let d = columns.len();
        let mut gram = DMatrix::zeros(d, d);
        let mut products = DVector::zeros(d);
        let mut scales = Vec::with_capacity(d);
        match &self.by_point {
            Some(ByPoint { squares, products: of_residuals, basis }) => {
                let shared: Vec<Vec<f64>> = columns
                    .iter()
                    .map(|g| {
                        self.metric.solved(basis.iter().map(|column| dot(column, g)).collect())
                    })
                    .collect();
                for i in 0..d {
                    for j in 0..=i {
                        let (a, b) = (&columns[i], &columns[j]);
                        let own: f64 =
                            squares.iter().zip(a).zip(b).map(|((s, a), b)| s * a * b).sum();
                        if i == j {
                            scales.push((own / self.touched).sqrt());
                        }
                        let value = own - dot(&shared[i], &shared[j]);
                        gram[(i, j)] = value;
                        gram[(j, i)] = value;
                    }
                    products[i] =
                        dot(of_residuals, &columns[i]) - dot(&shared[i], &self.residuals.shared);
                }
            }
            None => {
                let white: Vec<White> =
                    columns.iter().map(|g| self.metric.white(&self.column(g))).collect();
                for i in 0..d {
                    for j in 0..=i {
                        let value = white[i].dot(&white[j]);
                        gram[(i, j)] = value;
                        gram[(j, i)] = value;
                    }
                    let own = dot(&white[i].values, &white[i].values);
                    scales.push((own / self.touched).sqrt());
                    products[i] = white[i].dot(self.residuals);
                }
            }
        }
        solved(&gram, &products, &scales)
    }

    /// The evidence of a shape over its parameters; `at` are the values of what it is a function of
    /// by point, `grid` its functions at the grid.
    pub fn on_grid(&self, grid: &[(Vec<f64>, Vec<Vec<f64>>)]) -> Option<OnGrid> {
        let mut best: Option<(f64, &Vec<f64>)> = None;
        let mut sum = f64::NEG_INFINITY;
        for (shares, columns) in grid {
            let Some(fit) = self.fit(columns) else { continue };
            sum = ln_add(sum, fit.gain);
            if best.is_none_or(|(gain, _)| fit.gain > gain) {
                best = Some((fit.gain, shares));
            }
        }
        let (gain, shares) = best?;
        let mean = sum - elementary::ln(grid.len() as f64);
        Some(OnGrid { shares: shares.clone(), gain, mean })
    }

    /// The best point near that of a grid, and the evidence about it.
    pub fn refined(&self, shape: &Shape, at: &[f64], found: OnGrid) -> Integrated {
        let gain = |shares: &[f64]| {
            let columns = shape.columns(at, &shape.parameters(shares));
            self.fit(&columns).map_or(f64::NEG_INFINITY, |fit| fit.gain)
        };
        let d = shape.ranges.len();
        let OnGrid { mut shares, gain: mut best, mean } = found;
        if !shape.is_smooth() {
            let widths = vec![0.0; d];
            return Integrated { shares, best, ln_evidence: mean, widths };
        }
        let mut steps: Vec<f64> =
            shape.ranges.iter().map(|range| 0.5 / range.grid.max(1) as f64).collect();
        for _ in 0..ROUNDS {
            let before = best;
            for n in 0..d {
                for sign in [1.0, -1.0] {
                    let mut moved = shares.clone();
                    moved[n] = (moved[n] + sign * steps[n]).clamp(0.0, 1.0);
                    let own = gain(&moved);
                    if own > best {
                        best = own;
                        shares = moved;
                    }
                }
            }
            if best <= before {
                steps.iter_mut().for_each(|step| *step *= 0.4);
                if steps.iter().all(|step| *step < 1e-6) {
                    break;
                }
            }
        }
        let (ln_volume, widths) = volume(&gain, &shares, best);
        Integrated { ln_evidence: mean.max(best + ln_volume), shares, best, widths }
    }
}

/// The best value of a grid.
#[derive(Clone, Debug)]
pub struct OnGrid {
    pub(crate) shares: Vec<f64>,
    /// Logarithm of the gain in evidence there.
    pub gain: f64,
    pub(crate) mean: f64,
}

/// The evidence of a shape over its parameters.
#[derive(Clone, Debug)]
pub struct Integrated {
    /// Shares of the parameters' ranges at the best point.
    pub shares: Vec<f64>,
    /// The gain there.
    pub best: f64,
    /// The logarithm of the evidence above that without the departure.
    pub ln_evidence: f64,
    /// Standard deviations of the shares.
    pub widths: Vec<f64>,
}

/// The logarithm of the volume of a normal peak of `gain`, in shares, and its widths (Laplace's
/// method).
fn volume(gain: &dyn Fn(&[f64]) -> f64, shares: &[f64], best: f64) -> (f64, Vec<f64>) {
    let d = shares.len();
    let at = |moves: &[(usize, f64)]| {
        let mut moved = shares.to_vec();
        for &(n, step) in moves {
            moved[n] += step;
        }
        gain(&moved)
    };
    // steps over which the gain falls by about one half
    let mut widths = vec![WIDEST; d];
    for (n, width) in widths.iter_mut().enumerate() {
        let mut step = STEP;
        for _ in 0..4 {
            let curvature = (2.0 * best - at(&[(n, step)]) - at(&[(n, -step)])) / (step * step);
            if !(curvature > 0.0 && curvature.is_finite()) {
                break;
            }
            *width = curvature.sqrt().recip().min(WIDEST);
            step = 0.7 * *width;
        }
    }
    let information = DMatrix::from_fn(d, d, |i, j| {
        if i == j {
            return 1.0;
        }
        let (a, b) = (0.5 * widths[i], 0.5 * widths[j]);
        let mixed = at(&[(i, a), (j, b)]) - at(&[(i, a), (j, -b)]) - at(&[(i, -a), (j, b)])
            + at(&[(i, -a), (j, -b)]);
        // the mixed derivative in units of the widths: steps of half a width on either side
        (-mixed).clamp(-0.98, 0.98)
    });
    let ln_widths: f64 = widths.iter().map(|width| elementary::ln(*width)).sum();
    let half_ln_det = information
        .clone()
        .cholesky()
        .map_or(0.0, |root| root.l().diagonal().iter().map(|x| elementary::ln(*x)).sum::<f64>());
    if let Some(inverse) = information.try_inverse() {
        for (n, width) in widths.iter_mut().enumerate() {
            *width = (*width * inverse[(n, n)].max(1.0).sqrt()).min(WIDEST);
        }
    }
    (HALF_LN_TWO_PI * d as f64 + ln_widths - half_ln_det, widths)
}

/// The integral over the amplitude; the scales take the functions to unit root mean square.
pub fn solved(gram: &DMatrix<f64>, products: &DVector<f64>, scales: &[f64]) -> Option<Fit> {
    if scales.iter().any(|scale| !(*scale > 0.0 && scale.is_finite())) {
        return None;
    }
    let d = scales.len();
    let (values, vectors) = if d == 1 {
        let own = gram[(0, 0)] / (scales[0] * scales[0]);
        (vec![own], DMatrix::identity(1, 1))
    } else {
        let unit = DMatrix::from_fn(d, d, |i, j| gram[(i, j)] / (scales[i] * scales[j]));
        let eigen = unit.symmetric_eigen();
        (eigen.eigenvalues.iter().copied().collect(), eigen.eigenvectors)
    };
    let along: Vec<f64> =
        (0..d).map(|n| (0..d).map(|i| vectors[(i, n)] * products[i] / scales[i]).sum()).collect();
    let [low, high] = AMPLITUDES;
    let ratio = elementary::ln(high / low) / STEPS as f64;
    let mut sum = f64::NEG_INFINITY;
    let mut best = (f64::NEG_INFINITY, low);
    for step in 0..STEPS {
        let amplitude = low * elementary::exp(ratio * (step as f64 + 0.5));
        let a = amplitude * amplitude;
        let mut ln = 0.0;
        for (value, along) in values.iter().zip(&along) {
            let growth = 1.0 + a * value.max(0.0);
            ln += 0.5 * (a * along * along / growth - elementary::ln(growth));
        }
        sum = ln_add(sum, ln);
        if ln > best.0 {
            best = (ln, amplitude);
        }
    }
    let gain = sum - elementary::ln(STEPS as f64);
    if !gain.is_finite() {
        return None;
    }
    let a = best.1 * best.1;
    let part = |n: usize| a / (1.0 + a * values[n].max(0.0));
    let factors = (0..d)
        .map(|i| (0..d).map(|n| vectors[(i, n)] * part(n) * along[n]).sum::<f64>() / scales[i])
        .collect();
    let covariance = DMatrix::from_fn(d, d, |i, j| {
        let sum: f64 = (0..d).map(|n| vectors[(i, n)] * part(n) * vectors[(j, n)]).sum();
        sum / (scales[i] * scales[j])
    });
    Some(Fit { gain, factors, covariance })
}
