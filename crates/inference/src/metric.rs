//! Products of vectors of values in the metric of the residuals' covariance, the noise being known or
//! estimated before.

use crate::covariance::inner_root;
use crate::setup::Setup;
use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed;

/// The covariance B + L L' of the residuals, with B in blocks of the outputs of a row.
#[derive(Clone, Debug)]
pub struct Metric<'s> {
    setup: &'s Setup<'s>,
    /// Where the noise is estimated, the reciprocals of its standard deviations.
    weights: Option<Vec<f64>>,
    /// The columns of L, whitened by the blocks.
    basis: Vec<Vec<f64>>,
    /// Lower Cholesky root of I + L' inv(B) L.
    inner: Vec<f64>,
}

/// A vector of values, whitened by the blocks, and its coordinates along what is integrated out.
#[derive(Clone, Debug)]
pub struct White {
    /// By value, row by row.
    pub values: Vec<f64>,
    pub(crate) shared: Vec<f64>,
}

impl White {
    /// The product with another vector, what is integrated out being free.
    pub fn dot(&self, other: &Self) -> f64 {
        dot(&self.values, &other.values) - dot(&self.shared, &other.shared)
    }
}

impl<'s> Metric<'s> {
    /// `variances` are those of the noise by value, where it is estimated.
    pub fn new(setup: &'s Setup<'s>, variances: Option<&[f64]>) -> Self {
        let linear = &setup.linear;
        if !linear.fitted {
            let (basis, inner) = (linear.basis.clone(), linear.inner.clone());
            return Self { setup, weights: None, basis, inner };
        }
        let known = variances.unwrap_or(&linear.variances);
        let weights: Vec<f64> =
            known.iter().map(|v| v.max(f64::MIN_POSITIVE).sqrt().recip()).collect();
        let metric = Self { setup, weights: Some(weights), basis: Vec::new(), inner: Vec::new() };
        metric.with(&linear.raw_basis)
    }

    /// With more that is integrated out: columns of values whose factors are standard normal.
    pub fn with(&self, columns: &[Vec<f64>]) -> Self {
        let mut basis = self.basis.clone();
        basis.extend(columns.iter().map(|column| self.whiten(column)));
        let inner = inner_root(&basis);
        Self { setup: self.setup, weights: self.weights.clone(), basis, inner }
    }

    /// Values in units of the noise.
    pub fn whiten(&self, values: &[f64]) -> Vec<f64> {
        match &self.weights {
            Some(weights) => values.iter().zip(weights).map(|(x, w)| x * w).collect(),
            None => self.setup.linear.whiten_blocks(values),
        }
    }

    /// The same with the coordinates along what is integrated out.
    pub fn white(&self, values: &[f64]) -> White {
        let values = self.whiten(values);
        let shared = self.project(&values);
        White { values, shared }
    }

    /// What was whitened in a metric with the same noise.
    pub fn rewhitened(&self, white: &White) -> White {
        let values = white.values.clone();
        let shared = self.project(&values);
        White { values, shared }
    }

    /// The coordinates of whitened values along what is integrated out.
    fn project(&self, whitened: &[f64]) -> Vec<f64> {
        self.solved(self.basis.iter().map(|column| dot(column, whitened)).collect())
    }

    pub(crate) fn solved(&self, mut products: Vec<f64>) -> Vec<f64> {
        packed::solve(&self.inner, &mut products);
        products
    }

    /// The columns of what is integrated out, whitened.
    pub(crate) fn basis(&self) -> &[Vec<f64>] {
        &self.basis
    }

    /// Half the logarithm of the determinant of what is integrated out, beside that of the blocks.
    pub fn half_ln_det(&self) -> f64 {
        packed::ln_diagonal(&self.inner)
    }

    /// Whether a function of the rows can be taken out of the whitening: rows are independent.
    pub(crate) fn is_by_row(&self) -> bool {
        self.weights.is_some() || self.setup.linear.lags.is_empty()
    }
}
