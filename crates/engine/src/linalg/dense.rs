//! Cholesky roots of dense matrices and products of these, compiled once: nalgebra's loops are
//! generic, so each crate that calls them compiles its own copy, with the crate's own level of
//! optimization.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// The Cholesky root of a symmetric positive definite matrix.
#[derive(Clone, Debug)]
pub struct DenseRoot(Cholesky<f64, Dyn>);

impl DenseRoot {
    /// The root of a matrix, of which the lower triangle is read; `None` if it is not positive
    /// definite.
    pub fn of(matrix: DMatrix<f64>) -> Option<Self> {
        matrix.cholesky().map(Self)
    }

    /// The solution x of A x = `vector` for the matrix A.
    pub fn solve(&self, vector: &DVector<f64>) -> DVector<f64> {
        self.0.solve(vector)
    }

    /// The inverse of the matrix.
    pub fn inverse(&self) -> DMatrix<f64> {
        self.0.inverse()
    }
}

/// The rows and columns of a matrix with these indices, in their order.
pub fn principal_part(matrix: &DMatrix<f64>, places: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(places.len(), places.len(), |i, j| matrix[(places[i], places[j])])
}

/// The products of the columns of a matrix with those of another with as many rows.
pub fn column_products(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    a.tr_mul(b)
}

#[cfg(test)]
mod tests {
    use super::{DenseRoot, column_products, principal_part};
    use nalgebra::{DMatrix, DVector};

    /// Of 2 by 2 by hand; a matrix that is not positive definite has no root.
    #[test]
    fn roots_solve() {
        let matrix = DMatrix::from_row_slice(2, 2, &[4.0, 2.0, 2.0, 3.0]);
        let root = DenseRoot::of(matrix.clone()).unwrap();
        let solved = root.solve(&DVector::from_row_slice(&[10.0, 9.0]));
        // for numbers of this size within some roundings
        assert!((solved[0] - 1.5).abs() < 1e-15 && (solved[1] - 2.0).abs() < 1e-15);
        assert!((root.inverse() * &matrix - DMatrix::identity(2, 2)).amax() < 1e-15);
        assert_eq!(principal_part(&matrix, &[1, 0]).as_slice(), [3.0, 2.0, 2.0, 4.0]);
        assert_eq!(column_products(&matrix, &matrix)[(0, 1)], 14.0);
        assert!(DenseRoot::of(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 1.0])).is_none());
    }
}
