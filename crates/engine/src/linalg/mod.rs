//! Dense linear algebra with a fixed order of operations.
//!
//! The type of a matrix is nalgebra's `DMatrix`, and its products, Cholesky and triangular solves
//! are nalgebra's generic loops. With its features `alloc` and `libm-force`, and without `std`, it
//! uses neither matrixmultiply, whose kernels fuse products on some machines, nor logarithms of the
//! platform. This module adds what nalgebra does not have:
//!
//! - [`BlockedRoot`]: Cholesky roots of large matrices, in tiles and on all threads;
//! - [`DenseRoot`]: roots of dense matrices, compiled once for all crates;
//! - [`packed`]: lower triangles stored row by row, for loops over many small matrices;
//! - [`Eigen`]: eigenvalues of symmetric matrices with the eigenvectors beside each other in memory;
//! - [`CorrelationMatrix`]: factors of nearly singular correlation matrices and the nearest possible
//!   matrix.
//!
//! Every routine consists of sums, products, quotients and square roots in a fixed order, so its
//! results are the same bits on every machine.

mod blocked;
mod correlation;
mod dense;
mod eigen;
pub mod packed;

pub use blocked::BlockedRoot;
pub use correlation::CorrelationMatrix;
pub use dense::{DenseRoot, column_products, principal_part};
pub use eigen::Eigen;

/// The sum of the products of two vectors, from the first entry to the last.
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Adds a multiple of a vector to another.
pub fn add_multiple(sum: &mut [f64], factor: f64, terms: &[f64]) {
    for (sum, term) in sum.iter_mut().zip(terms) {
        *sum += factor * term;
    }
}
