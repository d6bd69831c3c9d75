//! Declared correlations between inputs that all rows share.

use nalgebra::DMatrix;

use crate::Case;

/// The matrix of the declared coefficients between these variables; `None` if there are none.
pub(crate) fn matrix(case: &Case, variables: &[usize]) -> Option<DMatrix<f64>> {
    let place = |variable: usize| variables.iter().position(|&known| known == variable);
    let mut matrix = DMatrix::identity(variables.len(), variables.len());
    let mut any = false;
    for correlation in &case.task.correlations {
        if let (Some(i), Some(j)) = (place(correlation.first), place(correlation.second)) {
            matrix[(i, j)] = correlation.coefficient;
            matrix[(j, i)] = correlation.coefficient;
            any = true;
        }
    }
    any.then_some(matrix)
}
