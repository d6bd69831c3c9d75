//! Paired readings: several quantities whose i-th readings were taken together.
//!
//! All paired readings with the same number of values form one ensemble. The law of propagation
//! uses the correlation coefficients of the sample (JCGM 100, 5.2.3); trials are drawn from the
//! multivariate t distribution of JCGM 102, 5.3: N quantities read n times have n - N degrees of
//! freedom and the scale matrix S/n, with the divisor n - N in S.
//!
//! The parameters of one fitted calibration function form an ensemble too, with the coefficients of
//! their covariance matrix and the degrees of freedom of its residuals.

use std::sync::Arc;

use super::Correlation;
use super::error::CorrelationError;
use crate::distribution::{Distribution, Fitted, Readings, Stream, student};
use crate::linalg::CorrelationMatrix;
use crate::number::{COLUMN, Column};
use crate::regression::Regression;

/// Quantities with paired readings, or the parameters of a fit, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Ensemble {
    /// Indices of the quantities.
    pub members: Vec<usize>,
    /// Correlation coefficients of the sample.
    pub(super) coefficients: CorrelationMatrix,
    /// The fit to which the parameters belong.
    pub(super) fit: Option<Arc<Regression>>,
}

/// The ensembles among these quantities, by the index of their first members.
pub fn ensembles(distributions: &[Arc<Distribution>]) -> Vec<Ensemble> {
    let mut sets: Vec<Vec<(usize, &Readings)>> = Vec::new();
    for (index, distribution) in distributions.iter().enumerate() {
        let Distribution::Readings(readings) = &**distribution else {
            continue;
        };
        if readings.together() < 2 {
            continue;
        }
        let length = readings.values().len();
        match sets.iter_mut().find(|set| set[0].1.values().len() == length) {
            Some(set) => set.push((index, readings)),
            None => sets.push(vec![(index, readings)]),
        }
    }
    let ensemble = |set: Vec<(usize, &Readings)>| Ensemble {
        members: set.iter().map(|(index, _)| *index).collect(),
        coefficients: coefficients(&set.iter().map(|(_, r)| r.values()).collect::<Vec<_>>()),
        fit: None,
    };
    sets.into_iter().map(ensemble).chain(fits(distributions)).collect()
}

/// The parameters of each fit.
fn fits(distributions: &[Arc<Distribution>]) -> impl Iterator<Item = Ensemble> {
    let mut sets: Vec<Vec<(usize, &Fitted)>> = Vec::new();
    for (index, distribution) in distributions.iter().enumerate() {
        let Distribution::Fitted(fitted) = &**distribution else {
            continue;
        };
        let same = |set: &&mut Vec<(usize, &Fitted)>| Arc::ptr_eq(set[0].1.fit(), fitted.fit());
        match sets.iter_mut().find(same) {
            Some(set) => set.push((index, fitted)),
            None => sets.push(vec![(index, fitted)]),
        }
    }
    let ensemble = |set: Vec<(usize, &Fitted)>| {
        let fit = set.first().map(|(_, fitted)| Arc::clone(fitted.fit()));
        let mut coefficients = CorrelationMatrix::identity(set.len());
        for (i, j) in coefficients.pairs() {
            let (first, second) = (set[i].1, set[j].1);
            if let (Some(of), Some(with)) = (first.parameter(), second.parameter()) {
                coefficients.set(i, j, first.fit().correlation(of, with));
            }
        }
        Ensemble { members: set.iter().map(|(index, _)| *index).collect(), coefficients, fit }
    };
    sets.into_iter().map(ensemble).collect::<Vec<_>>().into_iter()
}

impl Ensemble {
    /// The coefficients of all pairs.
    pub(crate) fn correlations(&self) -> impl Iterator<Item = Correlation> + '_ {
        self.coefficients.pairs().map(|(i, j)| Correlation {
            first: self.members[i],
            second: self.members[j],
            coefficient: self.coefficients.get(i, j),
        })
    }

    /// Checks that every member has the declared number of partners.
    pub(super) fn check(
        &self,
        distributions: &[Arc<Distribution>],
    ) -> Result<(), CorrelationError> {
        let count = self.members.len();
        if self.fit.is_some() {
            return Ok(());
        }
        let wrong = self.members.iter().find(|&&member| {
            !matches!(distributions.get(member).map(|d| &**d),
                Some(Distribution::Readings(readings)) if readings.together() == count)
        });
        match wrong {
            Some(&member) => Err(CorrelationError::Unpaired { member, count }),
            None => Ok(()),
        }
    }
}

/// Correlation coefficients of samples of equal length, none of which is constant.
fn coefficients(samples: &[&[f64]]) -> CorrelationMatrix {
    let offsets: Vec<Vec<f64>> = samples
        .iter()
        .map(|values| {
            // relative to the first value, so that a common large part does not cost digits
            let origin = values[0];
            let mean = values.iter().map(|v| v - origin).sum::<f64>() / values.len() as f64;
            values.iter().map(|v| v - origin - mean).collect()
        })
        .collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let norms: Vec<f64> = offsets.iter().map(|a| product(a, a).sqrt()).collect();
    let mut coefficients = CorrelationMatrix::identity(samples.len());
    for (i, j) in coefficients.pairs() {
        let r = product(&offsets[i], &offsets[j]) / norms[i] / norms[j];
        coefficients.set(i, j, r.clamp(-1.0, 1.0));
    }
    coefficients
}

/// Fills the columns of the members with a spherical t distribution of `dof` degrees of freedom:
/// given the first k members, the next is a t with `dof` + k degrees of freedom, scaled by
/// sqrt((dof + their sum of squares)/(dof + k)) (Ding, The American Statistician 70, 2016).
#[inline(always)]
pub(super) fn draw_spherical(
    dof: f64,
    members: impl Iterator<Item = usize>,
    streams: &mut [Stream],
    registers: &mut [Column],
    register: &[usize],
) {
    let mut squares = Column::ZERO;
    for (k, member) in members.enumerate() {
        let out = &mut registers[register[member]];
        let above = dof + k as f64;
        student::draw(0.0, 1.0, above, &mut streams[member], out);
        for t in 0..COLUMN {
            out.0[t] *= ((dof + squares.0[t]) / above).sqrt();
            squares.0[t] += out.0[t] * out.0[t];
        }
    }
}
