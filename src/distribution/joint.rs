//! The joint distribution of many quantities: which of them are drawn together, and how.

use std::fmt;

use nalgebra::DMatrix;

use super::{Distribution, Stream, StreamKey, normal};
use crate::number::Column;

/// A declared correlation coefficient of two quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// Place of the first quantity.
    pub first: usize,
    /// Place of the second quantity.
    pub second: usize,
    /// The coefficient r, from -1 to 1.
    pub coefficient: f64,
}

/// How far below zero an eigenvalue may lie because coefficients were printed with few digits:
/// rounding each to the third decimal moves an eigenvalue of an n x n matrix by up to 0.0005 n.
const ROUNDING: f64 = 5e-4;

/// Why quantities with these correlations cannot be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum CorrelationError {
    /// The coefficients of the quantities at these places contradict each other: their matrix is
    /// not positive semi-definite.
    Contradiction {
        /// The quantities.
        members: Vec<usize>,
        /// The lowest eigenvalue.
        eigenvalue: f64,
    },
    /// A coefficient between quantities whose joint draw is not built yet (all but normal ones).
    NotNormal {
        /// The quantity that is not drawn from a normal distribution.
        member: usize,
    },
}

impl fmt::Display for CorrelationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Contradiction { members, eigenvalue } => write!(
                f,
                "the correlation coefficients of the quantities {members:?} contradict each other \
                 (their matrix has the eigenvalue {eigenvalue:.3})"
            ),
            Self::NotNormal { member } => {
                write!(f, "quantity {member} is correlated but not normal")
            }
        }
    }
}

impl std::error::Error for CorrelationError {}

/// Quantities that are drawn together from a joint normal distribution.
#[derive(Clone, Debug)]
struct Group {
    members: Vec<usize>,
    /// Lower triangular factor of the correlation matrix, row by row.
    factor: Vec<Vec<f64>>,
}

/// How a set of quantities is drawn.
#[derive(Clone, Debug, Default)]
pub(crate) struct Joint {
    groups: Vec<Group>,
    /// Whether some matrix was positive semi-definite only up to the rounding of its coefficients.
    pub(crate) rounded: bool,
}

impl Joint {
    /// The joint draw of quantities with these distributions and coefficients. Constants take no
    /// part; coefficients of 0 say nothing.
    pub(crate) fn new(
        distributions: &[Distribution],
        correlations: &[Correlation],
    ) -> Result<Self, CorrelationError> {
        let varies = |q: usize| distributions.get(q).is_some_and(|d| d.constant().is_none());
        let active: Vec<Correlation> = correlations
            .iter()
            .copied()
            .filter(|c| c.coefficient != 0.0 && varies(c.first) && varies(c.second))
            .collect();
        let mut joint = Self::default();
        for members in connected(&active) {
            let coefficients = matrix(&members, &active);
            let (factor, rounded) = factorize(&coefficients).map_err(|eigenvalue| {
                CorrelationError::Contradiction { members: members.clone(), eigenvalue }
            })?;
            if let Some(&member) = members
                .iter()
                .find(|&&m| distributions.get(m).is_some_and(|d| !d.is_drawn_normal()))
            {
                return Err(CorrelationError::NotNormal { member });
            }
            joint.rounded |= rounded;
            joint.groups.push(Group { members, factor });
        }
        Ok(joint)
    }

    /// The same draw with quantities counted among `kept` only (in order); no group has members
    /// outside it.
    pub(crate) fn restricted(mut self, kept: &[usize]) -> Self {
        for group in &mut self.groups {
            for member in &mut group.members {
                *member = kept.binary_search(member).unwrap_or(*member);
            }
        }
        self
    }
}

/// The sets of quantities that coefficients link, each in order.
fn connected(correlations: &[Correlation]) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = Vec::new();
    for c in correlations {
        let (mut joined, rest): (Vec<_>, Vec<_>) = sets
            .into_iter()
            .partition(|set: &Vec<usize>| set.contains(&c.first) || set.contains(&c.second));
        joined.push(vec![c.first, c.second]);
        let mut set: Vec<usize> = joined.concat();
        set.sort_unstable();
        set.dedup();
        sets = rest;
        sets.push(set);
    }
    sets.sort();
    sets
}

fn matrix(members: &[usize], correlations: &[Correlation]) -> DMatrix<f64> {
    let mut matrix = DMatrix::identity(members.len(), members.len());
    let place = |q: usize| members.binary_search(&q).ok();
    for c in correlations {
        if let (Some(i), Some(j)) = (place(c.first), place(c.second)) {
            matrix[(i, j)] = c.coefficient;
            matrix[(j, i)] = c.coefficient;
        }
    }
    matrix
}

/// The lower triangular factor, and whether the matrix had to be taken as semi-definite within the
/// rounding of its coefficients; the lowest eigenvalue where that does not help.
fn factorize(matrix: &DMatrix<f64>) -> Result<(Vec<Vec<f64>>, bool), f64> {
    let n = matrix.nrows();
    let rows = |l: &DMatrix<f64>| (0..n).map(|i| (0..=i).map(|j| l[(i, j)]).collect()).collect();
    if let Some(cholesky) = matrix.clone().cholesky() {
        return Ok((rows(&cholesky.l()), false));
    }
    let eigen = matrix.clone().symmetric_eigen();
    let lowest = eigen.eigenvalues.min();
    if lowest < -ROUNDING * n as f64 {
        return Err(lowest);
    }
    // Q sqrt(max(D, 0)) is a factor; its LQ form is the triangular one, scaled to unit variances
    let roots = eigen.eigenvalues.map(|e| e.max(0.0).sqrt());
    let factor = &eigen.eigenvectors * DMatrix::from_diagonal(&roots);
    let mut lower = factor.transpose().qr().r().transpose();
    for mut row in lower.row_iter_mut() {
        let norm = row.norm();
        if norm > 0.0 {
            row /= norm;
        }
    }
    Ok((rows(&lower), lowest < -1e-12 * n as f64))
}

/// The running draw of a set of quantities through one block.
#[derive(Debug)]
pub(crate) struct Draws<'a> {
    distributions: &'a [Distribution],
    joint: &'a Joint,
    in_group: Vec<bool>,
    streams: Vec<Stream>,
}

impl<'a> Draws<'a> {
    /// The draws of block `block`; `keys` are the streams of the quantities.
    pub(crate) fn new(
        distributions: &'a [Distribution],
        joint: &'a Joint,
        keys: &[StreamKey],
        block: u64,
    ) -> Self {
        let mut in_group = vec![false; distributions.len()];
        for &member in joint.groups.iter().flat_map(|g| &g.members) {
            in_group[member] = true;
        }
        let streams = keys.iter().map(|key| key.block(block)).collect();
        Self { distributions, joint, in_group, streams }
    }

    /// Draws the next column of every quantity that is `used`; `register[q]` is where it goes.
    #[inline(always)]
    pub(crate) fn column(&mut self, registers: &mut [Column], register: &[usize], used: &[bool]) {
        for (q, distribution) in self.distributions.iter().enumerate() {
            if used[q] && !self.in_group[q] {
                distribution.draw(&mut self.streams[q], &mut registers[register[q]]);
            }
        }
        for group in &self.joint.groups {
            if group.members.iter().any(|&m| used[m]) {
                self.group(group, registers, register);
            }
        }
    }

    /// Independent standard normals, mixed by the factor from the last row upwards, so that every
    /// row still finds the normals above it unmixed.
    #[inline(always)]
    fn group(&mut self, group: &Group, registers: &mut [Column], register: &[usize]) {
        for &m in &group.members {
            normal::draw(0.0, 1.0, &mut self.streams[m], &mut registers[register[m]]);
        }
        for (i, row) in group.factor.iter().enumerate().rev() {
            let m = group.members[i];
            let (mean, std) =
                (self.distributions[m].mean(), self.distributions[m].standard_uncertainty());
            let mut sum = Column::ZERO;
            for (&weight, &other) in row.iter().zip(&group.members) {
                let z = &registers[register[other]].0;
                for t in 0..z.len() {
                    sum.0[t] += weight * z[t];
                }
            }
            let out = &mut registers[register[m]].0;
            for t in 0..out.len() {
                out[t] = mean + std * sum.0[t];
            }
        }
    }
}
