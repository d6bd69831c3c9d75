//! A term of the grammar as a matrix of features: its covariance is their product.

use nalgebra::DMatrix;

use super::grammar::{Of, Term};
use crate::Case;
use crate::data::Data;
use gumption_engine::number::{ascending, elementary, median};

/// Distinct coordinates beyond which the covariance is taken from nodes (Nystroem).
const MOST_COORDINATES: usize = 160;

/// So many nodes where there are more coordinates: a third of the shortest length apart.
const NODES: usize = 64;

/// Coordinates and nodes where the noise is estimated, so that every evaluation factors a matrix of
/// that order.
const FITTED_NODES: usize = 40;

/// A function of coordinates with so many values each on average cannot be mistaken for noise.
const REPEATED: f64 = 2.0;

/// A smooth function has a length of so many spacings of its coordinates: the coefficient of
/// correlation of neighbours is then 0.72.
const SPACINGS: f64 = 1.5;

/// Eigenvalues below this share of the largest are left out.
const LEAST_EIGENVALUE: f64 = 1e-9;

/// A function's coordinates at the values of a data set, and what each value is multiplied by.
#[derive(Clone, Debug)]
pub(crate) struct Coordinates {
    /// Distinct coordinates, scaled to the range of the data.
    distinct: Vec<Vec<f64>>,
    /// For each value that is touched: its place (row times outputs plus output), coordinate, number
    /// of the function, factor.
    touched: Vec<(usize, usize, usize, f64)>,
    /// Number of functions.
    functions: usize,
}

/// How a condition's values are placed on a line: in proportion, or by their logarithm where the
/// levels are spaced more evenly so.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FeatureAxis {
    logarithmic: bool,
    lower: f64,
    range: f64,
}

impl FeatureAxis {
    fn linear(values: &[f64]) -> Self {
        let lower = values.iter().copied().fold(f64::INFINITY, f64::min);
        let upper = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range = if upper > lower { upper - lower } else { 1.0 };
        Self { logarithmic: false, lower, range }
    }

    fn spaced(mut values: Vec<f64>) -> Self {
        ascending(&mut values);
        values.dedup();
        let spread = |values: &[f64]| {
            let gaps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let mean = gaps.iter().sum::<f64>() / gaps.len().max(1) as f64;
            let squares: f64 = gaps.iter().map(|gap| (gap / mean - 1.0).powi(2)).sum();
            squares / gaps.len().max(1) as f64
        };
        let positive = values.first().is_some_and(|least| *least > 0.0);
        let logarithms: Vec<f64> = values.iter().copied().map(elementary::ln).collect();
        let logarithmic = positive && values.len() > 2 && spread(&logarithms) < spread(&values);
        let (lower, upper) = if logarithmic {
            (logarithms.first(), logarithms.last())
        } else {
            (values.first(), values.last())
        };
        let (lower, upper) = (lower.copied().unwrap_or(0.0), upper.copied().unwrap_or(1.0));
        let range = if upper > lower { upper - lower } else { 1.0 };
        Self { logarithmic, lower, range }
    }

    /// From 0 to 1 within the range of the data.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let value =
            if self.logarithmic { elementary::ln(value.max(f64::MIN_POSITIVE)) } else { value };
        (value - self.lower) / self.range
    }
}

/// The axes of a case's conditions, and of what the model says of each output.
#[derive(Clone, Debug)]
pub struct Axes {
    conditions: Vec<FeatureAxis>,
    /// How many of them do not follow from the order of the rows.
    measured: usize,
    sims: Vec<FeatureAxis>,
}

/// One row of conditions with what the model says there: of the data, or of new conditions.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    pub(crate) conditions: Vec<f64>,
    /// For each observed output.
    pub(crate) sims: Vec<f64>,
}

impl Axes {
    pub(crate) fn new(case: &Case, data: &Data) -> Self {
        let conditions = (0..case.described()).map(|condition| {
            let values = data.ids.iter().map(|&id| case.task.rows[id].conditions[condition]);
            FeatureAxis::spaced(values.collect())
        });
        let sims = (0..data.outputs.len()).map(|output| {
            let values: Vec<f64> =
                data.points.iter().map(|point| point.tangent.touching[output]).collect();
            FeatureAxis::linear(&values)
        });
        let measured = case.measured();
        Self { conditions: conditions.collect(), measured, sims: sims.collect() }
    }

    /// A length over a condition in its unit, or the factor where the condition is placed by its
    /// logarithm; and whether it is.
    pub fn length(&self, condition: usize, length: f64) -> (f64, bool) {
        let axis = &self.conditions[condition];
        let own = length * axis.range;
        (if axis.logarithmic { elementary::exp(own) } else { own }, axis.logarithmic)
    }

    /// A length over the model's own value, in the unit of the outputs.
    pub fn sim_length(&self, outputs: &[usize], length: f64) -> f64 {
        length * outputs.iter().map(|&output| self.sims[output].range).fold(0.0, f64::max)
    }
}

/// The sites of a data set, a row each.
pub(crate) fn sites(case: &Case, data: &Data) -> Vec<Site> {
    data.point_of
        .iter()
        .enumerate()
        .map(|(row, &point)| Site {
            conditions: case.task.rows[data.ids[row]].conditions.clone(),
            sims: data.points[point].tangent.touching.clone(),
        })
        .collect()
}

impl Coordinates {
    pub(crate) fn new(term: &Term, axes: &Axes, sites: &[Site], outputs: usize) -> Self {
        let mut distinct: Vec<Vec<f64>> = Vec::new();
        let mut known = std::collections::HashMap::new();
        let mut touched = Vec::new();
        // a function of the model's value that several outputs share has one scale for all of them
        let widest = term.outputs.iter().map(|&o| axes.sims[o].range).fold(0.0, f64::max);
        for (row, site) in sites.iter().enumerate() {
            for (number, &output) in term.outputs.iter().enumerate() {
                let coordinate: Vec<f64> = match term.of {
                    Of::Constant => Vec::new(),
                    Of::Condition(c) => vec![axes.conditions[c].place(site.conditions[c])],
                    Of::Level(c) => vec![site.conditions[c]],
                    Of::WithHistory(c, history) => [c, history]
                        .map(|condition| {
                            axes.conditions[condition].place(site.conditions[condition])
                        })
                        .to_vec(),
                    Of::Sim if term.common => vec![site.sims[output] / widest],
                    Of::Sim => vec![axes.sims[output].place(site.sims[output])],
                    Of::Together => axes
                        .conditions
                        .iter()
                        .zip(&site.conditions)
                        .take(axes.measured)
                        .map(|(axis, value)| axis.place(*value))
                        .collect(),
                };
                let key: Vec<u64> = coordinate.iter().map(|x| x.to_bits()).collect();
                let place = *known.entry(key).or_insert_with(|| {
                    distinct.push(coordinate);
                    distinct.len() - 1
                });
                let factor = if term.relative { site.sims[output] } else { 1.0 };
                if factor != 0.0 {
                    let function = if term.common { 0 } else { number };
                    touched.push((row * outputs + output, place, function, factor));
                }
            }
        }
        let functions = if term.common { 1 } else { term.outputs.len() };
        Self { distinct, touched, functions }
    }

    /// Whether the function has its values at the same coordinates as another.
    pub(crate) fn is_at_same(&self, other: &Self) -> bool {
        self.distinct == other.distinct
    }

    /// Features of the function at the distinct coordinates, a row each; `nodes` are those of the
    /// data, from which the function at other coordinates follows.
    pub(crate) fn roots(&self, term: &Term, length: f64, nodes: &Nodes) -> DMatrix<f64> {
        let cross = DMatrix::from_fn(self.distinct.len(), nodes.places.len(), |i, j| {
            covariance(term, length, &self.distinct[i], &nodes.places[j])
        });
        cross * &nodes.roots
    }

    /// The features of all values: for each one the columns of its function. Rows are values.
    pub(crate) fn features(&self, roots: &DMatrix<f64>, values: usize) -> DMatrix<f64> {
        let rank = roots.ncols();
        let mut features = DMatrix::zeros(values, rank * self.functions);
        for &(value, place, function, factor) in &self.touched {
            for k in 0..rank {
                features[(value, function * rank + k)] = factor * roots[(place, k)];
            }
        }
        features
    }

    /// For each value the variance of the function, of unit variance, that features do not determine: all
    /// of it at a level that the data do not have, or farther than its length from them.
    pub(crate) fn undetermined(&self, roots: &DMatrix<f64>, values: usize) -> Vec<f64> {
        let mut variances = vec![0.0; values];
        for &(value, place, _, factor) in &self.touched {
            variances[value] = factor * factor * (1.0 - roots.row(place).norm_squared()).max(0.0);
        }
        variances
    }

    /// The shortest length of a smooth function that can be told from noise: where every value has a
    /// coordinate of its own, a function that varies from one to the next is as white as noise is.
    pub(crate) fn shortest_length(&self) -> f64 {
        let repeats =
            self.touched.len() as f64 / (self.functions * self.distinct.len()).max(1) as f64;
        if repeats >= REPEATED || self.distinct.len() > MOST_COORDINATES {
            return 0.0;
        }
        let distance = |a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
        };
        let nearest: Vec<f64> = (0..self.distinct.len())
            .map(|i| {
                let others = (0..self.distinct.len()).filter(|j| *j != i);
                others
                    .map(|j| distance(&self.distinct[i], &self.distinct[j]))
                    .fold(f64::INFINITY, f64::min)
            })
            .filter(|distance| distance.is_finite())
            .collect();
        median(nearest).map_or(0.0, |distance| SPACINGS * distance)
    }

    /// The values that the term touches.
    pub(crate) fn touched(&self) -> impl Iterator<Item = usize> {
        self.touched.iter().map(|(value, ..)| *value)
    }
}

/// Places from which a function is known, and the inverse root of its covariance there.
#[derive(Clone, Debug)]
pub struct Nodes {
    places: Vec<Vec<f64>>,
    roots: DMatrix<f64>,
}

impl Nodes {
    pub(crate) fn new(term: &Term, length: f64, coordinates: &Coordinates, fitted: bool) -> Self {
        let all = &coordinates.distinct;
        let (most, nodes) =
            if fitted { (FITTED_NODES, FITTED_NODES) } else { (MOST_COORDINATES, NODES) };
        let places: Vec<Vec<f64>> = if all.len() <= most {
            all.clone()
        } else {
            let mut sorted = all.clone();
            sorted.sort_by(|a, b| {
                a.iter()
                    .zip(b)
                    .map(|(a, b)| a.total_cmp(b))
                    .find(|o| o.is_ne())
                    .unwrap_or(std::cmp::Ordering::Equal)
            });
            (0..nodes).map(|k| sorted[k * (sorted.len() - 1) / (nodes - 1)].clone()).collect()
        };
        let matrix = DMatrix::from_fn(places.len(), places.len(), |i, j| {
            covariance(term, length, &places[i], &places[j])
        });
        let eigen = matrix.symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let kept: Vec<usize> = (0..places.len())
            .filter(|&k| eigen.eigenvalues[k] > LEAST_EIGENVALUE * largest)
            .collect();
        let roots = DMatrix::from_fn(places.len(), kept.len(), |i, k| {
            eigen.eigenvectors[(i, kept[k])] / eigen.eigenvalues[kept[k]].sqrt()
        });
        Self { places, roots }
    }

    /// Number of features of one function.
    pub(crate) fn rank(&self) -> usize {
        self.roots.ncols()
    }
}

/// The covariance of a function of unit variance between two coordinates: Matern 5/2 (Rasmussen and
/// Williams 2006, eq 4.17) of their distance.
fn covariance(term: &Term, length: f64, a: &[f64], b: &[f64]) -> f64 {
    match term.of {
        Of::Constant => 1.0,
        Of::Level(_) => f64::from(u8::from(a == b)),
        _ => {
            let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
            let x = (5.0 * squares).sqrt() / length;
            (1.0 + x + x * x / 3.0) * elementary::exp(-x)
        }
    }
}
