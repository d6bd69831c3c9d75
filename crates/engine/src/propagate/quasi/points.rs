//! The inputs at the points of a net.

use std::sync::Arc;

use super::net;
use crate::distribution::{Dependence, Distribution, FromScore, Linked};
use crate::linalg::packed;
use crate::number::{COLUMN, Column};
use crate::special;

/// How the values of an input follow from its coordinate.
enum CoordinateWay {
    /// From the standard normal score.
    Score(FromScore),
    /// By the quantile function.
    Quantile(Arc<Distribution>),
    /// From the values of a spherical t.
    Spherical { location: f64, scale: f64 },
}

/// Several inputs that are drawn together.
struct Set {
    /// Their places among the inputs.
    members: Vec<usize>,
    factor: Vec<f64>,
    /// Degrees of freedom of a multivariate t.
    dof: Option<f64>,
}

/// The inputs of a row that vary, as functions of the points of a net.
pub(super) struct NetInputs {
    ways: Vec<CoordinateWay>,
    /// The dimension of the net that each one takes.
    dimensions: Vec<usize>,
    sets: Vec<Set>,
}

impl NetInputs {
    /// Inputs with these distributions; `order` are their places, the most important one first;
    /// members of `linked` count places among all variables, of which `varying` are these.
    ///
    /// # Errors
    /// Why they cannot be had.
    pub(super) fn new(
        distributions: &[Arc<Distribution>],
        varying: &[usize],
        linked: &[Linked],
        order: &[usize],
    ) -> Result<Self, String> {
        let mut ways: Vec<CoordinateWay> = Vec::with_capacity(distributions.len());
        for distribution in distributions {
            ways.push(match &**distribution {
                shape if !shape.has_quantiles() => {
                    let name = shape.name();
                    return Err(format!("no quantiles are known of the distribution `{name}`"));
                }
                Distribution::Samples(_) => CoordinateWay::Quantile(Arc::clone(distribution)),
                _ => CoordinateWay::Score(FromScore::of(distribution)),
            });
        }
        let mut sets = Vec::new();
        for set in linked {
            let places = set.members.iter().map(|m| varying.binary_search(m).ok());
            let Some(members) = places.collect::<Option<Vec<usize>>>() else {
                continue;
            };
            let (factor, dof) = match &set.dependence {
                Dependence::Scores(factor) => (factor.clone(), None),
                Dependence::Student(dof, factor) => (factor.clone(), Some(*dof)),
                Dependence::Trials => {
                    let why = "the joint distribution of outputs of one saved result, or of \
                               parameters of a fit, is known only by draws";
                    return Err(why.to_owned());
                }
            };
            if dof.is_some() {
                for &m in &members {
                    if let Distribution::Readings(readings) = &*distributions[m] {
                        let (location, scale) = (distributions[m].mean(), readings.drawn_scale());
                        ways[m] = CoordinateWay::Spherical { location, scale };
                    }
                }
            }
            sets.push(Set { members, factor, dof });
        }
        let mut dimensions = vec![0; distributions.len()];
        for (dimension, &place) in order.iter().enumerate() {
            dimensions[place] = dimension;
        }
        Ok(Self { ways, dimensions, sets })
    }

    /// The coordinates of a randomization.
    pub(super) fn coordinates(&self, seed: u64) -> Vec<net::NetCoordinate> {
        self.dimensions.iter().map(|&d| net::NetCoordinate::new(d, seed)).collect()
    }

    /// The values of all inputs at `COLUMN` points from `first` on.
    pub(super) fn fill(&self, coordinates: &[net::NetCoordinate], first: u32, out: &mut [Column]) {
        let mut scores: Vec<Column> = vec![Column::ZERO; out.len()];
        for (i, (coordinate, scores)) in coordinates.iter().zip(&mut scores).enumerate() {
            let set = self.sets.iter().find_map(|set| {
                let place = set.members.iter().position(|&m| m == i)?;
                set.dof.map(|dof| dof + place as f64)
            });
            for (k, score) in scores.0.iter_mut().enumerate() {
                let p = coordinate.at(first + k as u32);
                *score = match (&self.ways[i], set) {
                    (CoordinateWay::Quantile(_), _) => p,
                    (_, Some(dof)) => special::student::quantile(p, dof),
                    _ => special::normal::quantile(p),
                };
            }
        }
        for set in &self.sets {
            if let Some(dof) = set.dof {
                let mut squares = [0.0; COLUMN];
                for (place, &m) in set.members.iter().enumerate() {
                    let above = dof + place as f64;
                    for (value, square) in scores[m].0.iter_mut().zip(&mut squares) {
                        *value *= ((dof + *square) / above).sqrt();
                        *square += *value * *value;
                    }
                }
            }
            for (&member, row) in set.members.iter().zip(packed::rows(&set.factor)).rev() {
                let mut sum = Column::ZERO;
                for (&weight, &other) in row.iter().zip(&set.members) {
                    for (sum, score) in sum.0.iter_mut().zip(&scores[other].0) {
                        *sum += weight * score;
                    }
                }
                scores[member] = sum;
            }
        }
        for ((way, scores), out) in self.ways.iter().zip(&scores).zip(out) {
            match way {
                CoordinateWay::Score(from) => from.values(scores, out),
                CoordinateWay::Spherical { location, scale } => {
                    for (out, score) in out.0.iter_mut().zip(&scores.0) {
                        *out = location + scale * score;
                    }
                }
                CoordinateWay::Quantile(distribution) => {
                    for (out, &p) in out.0.iter_mut().zip(&scores.0) {
                        *out = if p < 0.5 {
                            distribution.quantile(p)
                        } else {
                            distribution.quantile_upper(1.0 - p)
                        };
                    }
                }
            }
        }
    }
}
