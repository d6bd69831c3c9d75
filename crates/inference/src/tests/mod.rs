//! The posterior against exact values and independent computations.

mod beside;
pub(crate) mod cases;
mod discrepancy;
mod evidence;
mod influence;
mod likelihood;
mod shape;
pub(crate) mod simulator;
mod thresholds;

use crate::logarithm::HALF_LN_TWO_PI;
use nalgebra::{DMatrix, DVector};

/// Logarithm of a normal density with a dense covariance matrix.
fn ln_normal(residuals: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
    let root = covariance.clone().cholesky().unwrap();
    let half_ln_det: f64 = root.l().diagonal().map(f64::ln).sum();
    let square = residuals.dot(&root.solve(residuals));
    -0.5 * square - half_ln_det - residuals.len() as f64 * HALF_LN_TWO_PI
}
