//! The proposal of the importance sampling: a mixture of t distributions.
//!
//! An integral by importance sampling is as good as its proposal is near to the posterior, and fails
//! silently where the proposal has no mass. Hence three precautions. The components have heavier tails
//! than a posterior, so that no single draw can carry most of the weight. The prior itself is one of
//! them with a small share (defensive sampling, Hesterberg 1995, Technometrics 37, 185), so that no
//! region is left out altogether. And a new proposal is not used instead of the old ones but beside
//! them: every draw is weighed by the mixture of all proposals so far (adaptive multiple importance
//! sampling; see the module `evidence`), so that a bad adaptation costs draws and not correctness.
//!
//! Between rounds the mixture is adapted to the weighted draws by one step of expectation maximization.

use nalgebra::{DMatrix, DVector};

use crate::integral::search::Mode;
use crate::latent::{bounded_from_normal, ln_priors};
use crate::logarithm::HALF_LN_TWO_PI;
use gumption_engine::distribution::{Normal, Stream};
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::{COLUMN, CodePath, Column, Kernel, elementary};

/// Degrees of freedom of the components: heavier tails than those of a posterior, so that no draw
/// can carry most of the weight.
const DOF: usize = 6;

/// The share of the prior itself among the components: no region is left out altogether.
const DEFENCE: f64 = 0.04;

/// Components whose weight is lower than the largest by this factor's logarithm are left out.
const DEPTH: f64 = 7.0;

/// The power of their densities with which modes get their shares: a mode that is less dense than the
/// approximation has it would else be drawn from too rarely.
pub(crate) const TEMPER: f64 = 0.7;

/// The logarithm of the share of draws that a mode gets, but for a constant; `covariance` is that of
/// its neighbourhood, and `best` the cost that costs are relative to.
pub(crate) fn ln_share(mode: &Mode, covariance: &DMatrix<f64>, best: f64) -> f64 {
    let half_ln_det = 0.5 * elementary::ln(covariance.determinant().max(f64::MIN_POSITIVE));
    TEMPER * (best - mode.cost) + half_ln_det
}

/// A mixture of t distributions and the prior.
#[derive(Clone, Debug)]
pub(crate) struct Mixture {
    unknowns: usize,
    /// For each unknown quantity whether its prior is rectangular.
    bounded: Vec<bool>,
    components: Vec<Component>,
}

#[derive(Clone, Debug)]
struct Component {
    share: f64,
    mean: Vec<f64>,
    /// Lower Cholesky root of the scale matrix, row by row of the triangle.
    root: Vec<f64>,
    /// Its inverse.
    inverse: Vec<f64>,
    /// Logarithm of the density at the mean.
    ln_peak: f64,
}

impl Component {
    fn new(share: f64, mean: Vec<f64>, scale: &DMatrix<f64>) -> Option<Self> {
        let d = mean.len();
        let mut root = packed::of_matrix(scale);
        packed::cholesky(&mut root, 0.0).ok()?;
        let mut inverse = root.clone();
        packed::invert(&mut inverse);
        let (nu, dim) = (DOF as f64, d as f64);
        let ln_peak = libm::lgamma(0.5 * (nu + dim))
            - libm::lgamma(0.5 * nu)
            - 0.5 * dim * elementary::ln(nu * std::f64::consts::PI)
            - packed::ln_diagonal(&root);
        (ln_peak.is_finite()).then_some(Self { share, mean, root, inverse, ln_peak })
    }

    /// The squared distance of each lane from the mean, in the metric of the scale.
    #[inline(always)]
    fn distances(&self, scores: &[Column], out: &mut Column) {
        let d = self.mean.len();
        out.0.fill(0.0);
        for i in 0..d {
            let mut y = [0.0; COLUMN];
            for j in 0..=i {
                let (factor, mean) = (self.inverse[triangle(i) + j], self.mean[j]);
                let scores = &scores[j].0;
                for lane in 0..COLUMN {
                    y[lane] += factor * (scores[lane] - mean);
                }
            }
            for lane in 0..COLUMN {
                out.0[lane] += y[lane] * y[lane];
            }
        }
    }
}

/// `peak` times what is left of a t density in `dimensions` at squared distances: the power -(DOF +
/// d)/2 of 1 + m/DOF by products and a root, which cost a tenth of a logarithm and an exponential.
#[inline(always)]
fn fall_off(dimensions: usize, peak: f64, distances: &Column, densities: &mut Column) {
    let twice = DOF + dimensions;
    let mut square = Column::ZERO;
    for lane in 0..COLUMN {
        square.0[lane] = 1.0 / (1.0 + distances.0[lane] / DOF as f64);
    }
    for lane in 0..COLUMN {
        let root = if twice % 2 == 1 { square.0[lane].sqrt() } else { 1.0 };
        densities.0[lane] = peak * root;
    }
    let mut power = twice / 2;
    while power > 0 {
        if power % 2 == 1 {
            for lane in 0..COLUMN {
                densities.0[lane] *= square.0[lane];
            }
        }
        for lane in 0..COLUMN {
            square.0[lane] *= square.0[lane];
        }
        power /= 2;
    }
}

/// Squared distances from a component, and its density there.
struct Distances<'m> {
    component: &'m Component,
    scores: &'m [Column],
    peak: f64,
    distances: &'m mut Column,
    densities: &'m mut Column,
}

impl Kernel for Distances<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { component, scores, peak, distances, densities } = self;
        component.distances(scores, distances);
        fall_off(component.mean.len(), peak, distances, densities);
    }
}

/// The logarithm of a mixture's density at a column of points.
struct LnDensity<'m> {
    mixture: &'m Mixture,
    scores: &'m [Column],
}

impl Kernel for LnDensity<'_> {
    type Output = [f64; COLUMN];

    #[inline(always)]
    fn run(self) -> [f64; COLUMN] {
        let Self { mixture, scores } = self;
        let (most, peaks) = mixture.peaks();
        let ln_prior = if peaks.is_empty() { 0.0 } else { elementary::ln(DEFENCE) };
        let ln_priors = ln_priors(&mixture.bounded, scores);
        let mut sums = [0.0; COLUMN];
        for lane in 0..COLUMN {
            sums[lane] = elementary::exp(ln_prior + ln_priors[lane] - most);
        }
        let (mut distances, mut densities) = (Column::ZERO, Column::ZERO);
        for (component, &peak) in mixture.components.iter().zip(&peaks) {
            component.distances(scores, &mut distances);
            fall_off(mixture.unknowns, peak, &distances, &mut densities);
            for lane in 0..COLUMN {
                sums[lane] += densities.0[lane];
            }
        }
        // a point so far out that doubles do not reach has no prior density either
        for sum in &mut sums {
            *sum = most + elementary::ln(sum.max(f64::MIN_POSITIVE));
        }
        sums
    }
}

/// Adds numbers given by their logarithms, each of `terms` times the same factor, lane by lane.
pub(crate) fn add_ln(sums: &mut [f64], terms: &[f64; COLUMN], ln_factor: f64) {
    CodePath::best().run(AddLn { sums, terms, ln_factor });
}

struct AddLn<'a> {
    sums: &'a mut [f64],
    terms: &'a [f64; COLUMN],
    ln_factor: f64,
}

impl Kernel for AddLn<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (sum, term) in self.sums.iter_mut().zip(self.terms) {
            let term = term + self.ln_factor;
            let (most, least) = if *sum > term { (*sum, term) } else { (term, *sum) };
            *sum = most + elementary::ln(1.0 + elementary::exp(least - most));
        }
    }
}

impl Mixture {
    /// A component at each mode, with a share as its neighbourhood has of the posterior in the
    /// Gaussian approximation.
    pub(crate) fn at_modes(bounded: &[bool], modes: &[Mode]) -> Self {
        let unknowns = bounded.len();
        let best = modes.iter().map(|mode| mode.cost).fold(f64::INFINITY, f64::min);
        let mut components = Vec::new();
        for mode in modes {
            let Some(inverse) = mode.information.clone().try_inverse() else { continue };
            let share = elementary::exp(ln_share(mode, &inverse, best).max(-600.0));
            components.extend(Component::new(share, mode.scores.clone(), &inverse));
        }
        let mut mixture = Self { unknowns, bounded: bounded.to_vec(), components };
        mixture.normalize();
        mixture
    }

    /// Components with these logarithms of weights, means and scales.
    pub(crate) fn of(bounded: &[bool], components: Vec<(f64, Vec<f64>, DMatrix<f64>)>) -> Self {
        let most = components.iter().map(|(ln, ..)| *ln).fold(f64::NEG_INFINITY, f64::max);
        let components = components
            .into_iter()
            .filter(|(ln, ..)| *ln > most - DEPTH)
            .filter_map(|(ln, mean, scale)| {
                Component::new(elementary::exp(ln - most), mean, &scale)
            })
            .collect();
        let mut mixture = Self { unknowns: bounded.len(), bounded: bounded.to_vec(), components };
        mixture.normalize();
        mixture
    }

    /// A mixture of about `count` components fitted to points of equal weight.
    pub(crate) fn fitted(bounded: &[bool], columns: &[Vec<Column>], count: usize) -> Option<Self> {
        let d = bounded.len();
        let points: Vec<Vec<f64>> = columns
            .iter()
            .flat_map(|column| {
                (0..COLUMN).map(move |lane| column.iter().map(|c| c.0[lane]).collect::<Vec<f64>>())
            })
            .collect();
        let n = points.len() as f64;
        let mean: Vec<f64> =
            (0..d).map(|i| points.iter().map(|point| point[i]).sum::<f64>() / n).collect();
        let covariance = DMatrix::from_fn(d, d, |i, j| {
            let products = points.iter().map(|point| (point[i] - mean[i]) * (point[j] - mean[j]));
            products.sum::<f64>() / n + if i == j { 1e-12 } else { 0.0 }
        });
        let whole = Component::new(1.0, mean, &covariance)?;
        let distance = |a: &[f64], b: &[f64]| -> f64 {
            (0..d)
                .map(|i| {
                    let y: f64 =
                        (0..=i).map(|j| whole.inverse[triangle(i) + j] * (a[j] - b[j])).sum();
                    y * y
                })
                .sum()
        };
        // centres as far from each other as points are, then the mean of what is nearest to each
        let mut centres = vec![whole.mean.clone()];
        let mut nearest: Vec<f64> =
            points.iter().map(|point| distance(point, &centres[0])).collect();
        while centres.len() < count {
            let far = (0..points.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b]))?;
            centres.push(points[far].clone());
            for (nearest, point) in nearest.iter_mut().zip(&points) {
                *nearest = nearest.min(distance(point, &points[far]));
            }
        }
        for _ in 0..3 {
            let mut sums = vec![(0.0, vec![0.0; d]); count];
            for point in &points {
                let own = (0..count).min_by(|&a, &b| {
                    distance(point, &centres[a]).total_cmp(&distance(point, &centres[b]))
                })?;
                sums[own].0 += 1.0;
                sums[own].1.iter_mut().zip(point).for_each(|(sum, x)| *sum += x);
            }
            for (centre, (weight, sum)) in centres.iter_mut().zip(sums) {
                if weight > 0.0 {
                    *centre = sum.into_iter().map(|sum| sum / weight).collect();
                }
            }
        }
        let shrink = elementary::pow(count as f64, -2.0 / d.max(1) as f64);
        let components = centres
            .into_iter()
            .filter_map(|centre| Component::new(1.0, centre, &(&covariance * shrink)))
            .collect();
        let mut mixture = Self { unknowns: d, bounded: bounded.to_vec(), components };
        mixture.normalize();
        let weights = vec![1.0 / n; points.len()];
        for _ in 0..6 {
            mixture = mixture.adapted(columns, &weights);
        }
        (!mixture.components.is_empty()).then_some(mixture)
    }

    fn normalize(&mut self) {
        let sum: f64 = self.components.iter().map(|component| component.share).sum();
        if sum <= 0.0 || sum.is_nan() {
            self.components.clear();
        }
        for component in &mut self.components {
            component.share *= (1.0 - DEFENCE) / sum;
        }
    }

    /// Draws a column of points.
    pub(crate) fn draw(&self, stream: &mut Stream) -> Vec<Column> {
        let d = self.unknowns;
        let mut normals = vec![Column::ZERO; d.max(1) + DOF];
        for column in &mut normals {
            standard_normals(stream, column);
        }
        let mut choice = [0.0; COLUMN];
        stream.uniform(&mut choice);
        let mut scores = vec![Column::ZERO; d];
        for lane in 0..COLUMN {
            let mut left = choice[lane];
            let component = self.components.iter().find(|component| {
                left -= component.share;
                left < 0.0
            });
            match component {
                None => {
                    for i in 0..d {
                        let normal = normals[i].0[lane];
                        scores[i].0[lane] =
                            if self.bounded[i] { bounded_from_normal(normal) } else { normal };
                    }
                }
                Some(component) => {
                    let squares: f64 =
                        normals[d.max(1)..].iter().map(|n| n.0[lane] * n.0[lane]).sum();
                    let stretch = (DOF as f64 / squares).sqrt();
                    for i in 0..d {
                        let sum: f64 = (0..=i)
                            .map(|j| component.root[triangle(i) + j] * normals[j].0[lane])
                            .sum();
                        scores[i].0[lane] = component.mean[i] + stretch * sum;
                    }
                }
            }
        }
        scores
    }

    /// The logarithm of the density at a column of points, relative to the standard normal density
    /// without its constant: ln q + d/2 ln(2 pi).
    pub(crate) fn ln_density(&self, scores: &[Column]) -> [f64; COLUMN] {
        CodePath::best().run(LnDensity { mixture: self, scores })
    }

    /// The logarithm that densities are relative to, so that they stay within the range of doubles,
    /// and each component's peak relative to it. Densities include the factor (2 pi)^(d/2).
    fn peaks(&self) -> (f64, Vec<f64>) {
        let constant = self.unknowns as f64 * HALF_LN_TWO_PI;
        let ln: Vec<f64> = self
            .components
            .iter()
            .map(|component| {
                elementary::ln(component.share.max(f64::MIN_POSITIVE))
                    + component.ln_peak
                    + constant
            })
            .collect();
        let most = ln.iter().copied().fold(0.0, f64::max);
        (most, ln.into_iter().map(|ln| elementary::exp(ln - most)).collect())
    }

    /// The mixture after one step of expectation maximization towards weighted points (Cappe, Douc,
    /// Guillin, Marin, Robert 2008, Statistics and Computing 18, 447, with t components).
    pub(crate) fn adapted(&self, columns: &[Vec<Column>], weights: &[f64]) -> Self {
        let d = self.unknowns;
        let count = self.components.len();
        let mut shares = vec![0.0; count];
        let mut squared = vec![0.0; count];
        let mut scales = vec![0.0; count];
        let mut means = vec![DVector::<f64>::zeros(d); count];
        let mut products = vec![vec![0.0; triangle(d)]; count];
        let mut away = vec![0.0; d];
        let mut distances = vec![Column::ZERO; count];
        let mut densities = vec![Column::ZERO; count];
        let (_, peaks) = self.peaks();
        for (scores, weights) in columns.iter().zip(weights.chunks(COLUMN)) {
            if weights.iter().all(|weight| *weight <= 0.0) {
                continue;
            }
            let each = self.components.iter().zip(&peaks);
            let out = distances.iter_mut().zip(&mut densities);
            for ((component, &peak), (distances, densities)) in each.zip(out) {
                CodePath::best().run(Distances { component, scores, peak, distances, densities });
            }
            for (lane, &weight) in weights.iter().enumerate() {
                if weight <= 0.0 {
                    continue;
                }
                let sum: f64 = densities.iter().map(|density| density.0[lane]).sum();
                if sum <= 0.0 {
                    continue;
                }
                for k in 0..count {
                    let part = weight * densities[k].0[lane] / sum;
                    if part < 1e-12 {
                        continue;
                    }
                    let pull = part * (DOF + d) as f64 / (DOF as f64 + distances[k].0[lane]);
                    shares[k] += part;
                    squared[k] += part * part;
                    scales[k] += pull;
                    let mean = &self.components[k].mean;
                    for ((away, score), mean) in away.iter_mut().zip(scores).zip(mean) {
                        *away = score.0[lane] - mean;
                    }
                    let products = &mut products[k];
                    for i in 0..d {
                        let pulled = pull * away[i];
                        means[k][i] += pulled;
                        let row = &mut products[triangle(i)..=triangle(i) + i];
                        for (product, away) in row.iter_mut().zip(&away) {
                            *product += pulled * away;
                        }
                    }
                }
            }
        }
        let mut components = Vec::new();
        for (k, old) in self.components.iter().enumerate() {
            if shares[k] < 1e-3 {
                continue;
            }
            let effective = shares[k] * shares[k] / squared[k].max(f64::MIN_POSITIVE);
            let shift = &means[k] / scales[k];
            let mut scale = DMatrix::from_fn(d, d, |i, j| {
                products[k][triangle(i.max(j)) + i.min(j)] / shares[k]
                    - shift[i] * shift[j] * scales[k] / shares[k]
            });
            // few points say little of a shape: the old one counts as some more
            let faith = effective / (effective + 2.0 * d as f64);
            let before = DMatrix::from_fn(d, d, |i, j| {
                (0..=i.min(j)).map(|m| old.root[triangle(i) + m] * old.root[triangle(j) + m]).sum()
            });
            scale = scale * faith + before * (1.0 - faith);
            let mean = old.mean.iter().zip(shift.iter()).map(|(m, s)| m + faith * s).collect();
            match Component::new(shares[k], mean, &scale) {
                Some(component) => components.push(component),
                None => components.push(Component { share: shares[k], ..old.clone() }),
            }
        }
        let mut mixture = Self { unknowns: d, bounded: self.bounded.clone(), components };
        mixture.normalize();
        mixture
    }
}

/// Fills a column with standard normal draws.
pub fn standard_normals(stream: &mut Stream, column: &mut Column) {
    Normal::standard_draw(stream, column);
}

#[cfg(test)]
mod tests {
    use super::{DOF, Mixture, add_ln};
    use gumption_engine::number::{COLUMN, Column};
    use nalgebra::DMatrix;

    #[test]
    fn densities_are_those_of_t_distributions_and_the_prior() {
        for unknowns in [1, 2, 3] {
            let scale = DMatrix::from_diagonal_element(unknowns, unknowns, 0.04);
            let mixture =
                Mixture::of(&vec![false; unknowns], vec![(0.0, vec![0.5; unknowns], scale)]);
            let mut scores = vec![Column::ZERO; unknowns];
            for column in &mut scores {
                column.0 = std::array::from_fn(|lane| 0.1 * lane as f64 - 3.0);
            }
            let found = mixture.ln_density(&scores);
            let (nu, d) = (DOF as f64, unknowns as f64);
            let ln_peak = libm::lgamma(0.5 * (nu + d))
                - libm::lgamma(0.5 * nu)
                - 0.5 * d * (nu * std::f64::consts::PI).ln()
                - d * 0.2f64.ln();
            for lane in 0..COLUMN {
                let x = scores[0].0[lane];
                let m = d * ((x - 0.5) / 0.2).powi(2);
                let t = (ln_peak - 0.5 * (nu + d) * (m / nu).ln_1p()).exp();
                let normal = (-0.5 * d * x * x).exp();
                let root = (2.0 * std::f64::consts::PI).powf(0.5 * d);
                // the density times the root of two pi for each unknown
                let wanted = (0.96 * t * root + 0.04 * normal).ln();
                // a few roundings of each of some ten operations
                assert!((found[lane] - wanted).abs() < 1e-12, "{unknowns} {x}");
            }
        }
    }

    #[test]
    fn logarithms_are_added() {
        let mut sums = [f64::NEG_INFINITY; COLUMN];
        sums[1] = 700.0;
        add_ln(&mut sums, &[-900.0; COLUMN], 1.0);
        assert_eq!(sums[0], -899.0);
        assert_eq!(sums[1], 700.0);
        add_ln(&mut sums, &[-900.0; COLUMN], 1.0);
        assert!((sums[0] - (-899.0 + 2f64.ln())).abs() < 1e-12);
    }
}
