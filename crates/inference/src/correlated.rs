//! Declared correlations between inputs that have their values in common over the same rows.

use gumption_engine::linalg::{CorrelationMatrix, packed};
use nalgebra::DMatrix;

use crate::Case;

/// The lower triangular root of the matrix of the declared coefficients between these variables, which
/// may be singular; `None` if there are none.
pub fn root(case: &Case, variables: &[usize]) -> Option<DMatrix<f64>> {
    let place = |variable: usize| variables.iter().position(|&known| known == variable);
    let mut matrix = CorrelationMatrix::identity(variables.len());
    let mut any = false;
    for correlation in &case.task.correlations {
        if let (Some(i), Some(j)) = (place(correlation.first), place(correlation.second)) {
            matrix.set(i, j, correlation.coefficient);
            any = true;
        }
    }
    any.then(|| packed::to_matrix(&matrix.factor()))
}
