//! Correlation matrices: factors, what is possible, and the nearest possible matrix.

use nalgebra::DMatrix;

use super::{Eigen, add_multiple, dot, packed};

/// With pivots of at least this size the Cholesky factor of a correlation matrix is well
/// determined.
const PIVOT: f64 = 1e-10;

/// Eigenvalues above minus this, times the number of rows, are zero up to rounding.
const ROUNDING: f64 = 1e-12;

/// Projections of [`CorrelationMatrix::nearest`] at most.
const PROJECTIONS: usize = 400;

/// Maximum of rows cubed times projections: about ten seconds. From 250 rows on the search may end
/// before the nearest matrix is found, at a possible one close to it.
const WORK: f64 = 4e8;

/// A symmetric matrix with ones on its diagonal, possible or not.
#[derive(Clone, Debug, PartialEq)]
pub struct CorrelationMatrix {
    entries: DMatrix<f64>,
}

impl CorrelationMatrix {
    /// The matrix of `n` uncorrelated quantities.
    pub fn identity(n: usize) -> Self {
        Self { entries: DMatrix::identity(n, n) }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.entries.nrows()
    }

    /// The coefficient of two rows.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.entries[(i, j)]
    }

    /// Sets the coefficient of two rows.
    pub fn set(&mut self, i: usize, j: usize, value: f64) {
        self.entries[(i, j)] = value;
        self.entries[(j, i)] = value;
    }

    /// The matrix of the rows and columns at `kept`.
    #[must_use]
    pub fn part(&self, kept: &[usize]) -> Self {
        let entry = |i, j| self.entries[(kept[i], kept[j])];
        Self { entries: DMatrix::from_fn(kept.len(), kept.len(), entry) }
    }

    /// The pairs of rows i < j.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let n = self.size();
        (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
    }

    /// The square root of the sum of the squared differences of all entries.
    pub fn distance(&self, other: &Self) -> f64 {
        distance(&self.entries, &other.entries)
    }

    /// Whether no eigenvalue is negative by more than rounding.
    pub fn is_semidefinite(&self) -> bool {
        let order: Vec<usize> = (0..self.size()).collect();
        self.regular_factor().is_some()
            || self.first_below(&order, -ROUNDING * self.size() as f64).is_none()
    }

    /// The first index in the order at which the rows up to it have an eigenvalue below `limit` <
    /// 0. No eigenvalues are computed: as long as there is none, the matrix minus `limit` on its
    /// diagonal has a Cholesky factor.
    pub fn first_below(&self, order: &[usize], limit: f64) -> Option<usize> {
        packed::cholesky(&mut self.lower(order, -limit), 0.0).err()
    }

    /// The least eigenvalue.
    pub fn lowest_eigenvalue(&self) -> f64 {
        Eigen::of(&self.entries).values.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// A lower triangular factor ([`packed`]) with rows of length 1, of a positive semi-definite
    /// matrix: Cholesky's or, for a nearly singular matrix, the triangular form of Q sqrt(D).
    pub fn factor(&self) -> Vec<f64> {
        self.regular_factor().unwrap_or_else(|| self.singular_factor())
    }

    fn regular_factor(&self) -> Option<Vec<f64>> {
        let order: Vec<usize> = (0..self.size()).collect();
        let mut factor = self.lower(&order, 0.0);
        packed::cholesky(&mut factor, PIVOT).is_ok().then_some(factor)
    }

    /// The lower triangle of the rows in an order, with `shift` added to the diagonal.
    fn lower(&self, order: &[usize], shift: f64) -> Vec<f64> {
        let mut lower = Vec::with_capacity(packed::triangle(order.len()));
        for (index, &i) in order.iter().enumerate() {
            lower.extend(order[..index].iter().map(|&j| self.entries[(j, i)]));
            lower.push(self.entries[(i, i)] + shift);
        }
        lower
    }

    /// Gram-Schmidt on the rows of Q sqrt(max(D, 0)).
    fn singular_factor(&self) -> Vec<f64> {
        let eigen = Eigen::of(&self.entries);
        // the square root of an eigenvalue that is zero apart from rounding would be far above
        // rounding
        let zero = 4.0 * f64::EPSILON * self.size() as f64;
        let above = eigen.pairs().filter(|(e, _)| *e > zero);
        let scaled: Vec<(f64, &[f64])> = above.map(|(e, q)| (e.sqrt(), q)).collect();
        // of a row that depends on the ones before it there is no direction
        let mut basis: Vec<Option<Vec<f64>>> = Vec::new();
        let mut factor: Vec<f64> = Vec::with_capacity(packed::triangle(self.size()));
        for i in 0..self.size() {
            let mut rest: Vec<f64> = scaled.iter().map(|(root, q)| q[i] * root).collect();
            let mut row: Vec<f64> = vec![0.0; basis.len()];
            // twice is enough: the second pass removes the rounding of the first one
            for _ in 0..2 {
                for (entry, unit) in row.iter_mut().zip(&basis) {
                    let Some(unit) = unit else { continue };
                    let along = dot(&rest, unit);
                    *entry += along;
                    add_multiple(&mut rest, -along, unit);
                }
            }
            let norm = dot(&rest, &rest).sqrt();
            let independent = norm > 1e-9;
            row.push(if independent { norm } else { 0.0 });
            basis.push(independent.then(|| rest.iter().map(|a| a / norm).collect()));
            let length = dot(&row, &row).sqrt();
            factor.extend(row.iter().map(|a| a / length));
        }
        factor
    }

    /// The possible correlation matrix nearest to this one in the Frobenius norm, by alternating
    /// projections with Dykstra's correction (Higham, IMA Journal of Numerical Analysis 22, 2002,
    /// algorithm 3.3), finally scaled to an exact diagonal of ones.
    #[must_use]
    pub fn nearest(&self) -> Self {
        let n = self.size();
        let size = n as f64;
        let affordable = WORK / (size * size * size).max(1.0);
        let projections = (affordable as usize).clamp(1, PROJECTIONS);
        let mut near = self.entries.clone();
        let mut correction = DMatrix::zeros(n, n);
        let mut semidefinite = self.entries.clone();
        for _ in 0..projections {
            let shifted = &near - &correction;
            semidefinite = clipped(&shifted);
            correction = &semidefinite - shifted;
            let mut next = semidefinite.clone();
            next.fill_diagonal(1.0);
            let moved = distance(&next, &near);
            near = next;
            if moved < 1e-13 * size {
                break;
            }
        }
        let scale: Vec<f64> =
            semidefinite.diagonal().iter().map(|d| d.max(f64::MIN_POSITIVE).sqrt()).collect();
        let mut nearest = Self::identity(n);
        for (i, j) in self.pairs() {
            let r = semidefinite[(i, j)] / (scale[i] * scale[j]);
            nearest.set(i, j, r.clamp(-1.0, 1.0));
        }
        nearest
    }
}

/// The square root of the sum of the squared differences of all entries.
fn distance(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The nearest positive semi-definite matrix: negative eigenvalues become zero.
fn clipped(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let mut clipped = matrix.clone();
    for (value, vector) in Eigen::of(matrix).pairs().filter(|(value, _)| *value < 0.0) {
        for (mut column, x) in clipped.column_iter_mut().zip(vector) {
            for (entry, y) in column.iter_mut().zip(vector) {
                *entry -= value * (x * y);
            }
        }
    }
    clipped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(upper: &[&[f64]]) -> CorrelationMatrix {
        let mut matrix = CorrelationMatrix::identity(upper.len() + 1);
        for (i, row) in upper.iter().enumerate() {
            for (k, &r) in row.iter().enumerate() {
                matrix.set(i, i + 1 + k, r);
            }
        }
        matrix
    }

    fn product(factor: &[f64], i: usize, j: usize) -> f64 {
        let row = |i| packed::rows(factor).nth(i).unwrap();
        dot(row(i), row(j))
    }

    // The tolerances are rounding: a regular factor to 1e-15 a step, a singular one to the root of
    // the rounding that its vanishing pivot leaves.
    #[test]
    fn factors_multiply_back() {
        let cases = [
            (matrix(&[&[0.9, -0.36], &[-0.65]]), 1e-14),
            (matrix(&[&[1.0, 1.0], &[1.0]]), 1e-9),
            (matrix(&[&[1.0, 0.3], &[0.3]]), 1e-9),
            (matrix(&[&[-1.0]]), 1e-9),
        ];
        for (matrix, tolerance) in cases {
            assert!(matrix.is_semidefinite());
            let factor = matrix.factor();
            for (i, j) in matrix.pairs() {
                assert!((product(&factor, i, j) - matrix.get(i, j)).abs() < tolerance);
                assert!((product(&factor, i, i) - 1.0).abs() < 1e-14);
            }
        }
    }

    /// Higham 2002, section 4: the nearest correlation matrix to the 3 x 3 one with ones beside
    /// the diagonal and 0 in the corner has 0.7607 and 0.1573.
    #[test]
    fn nearest_matrix_of_higham() {
        let declared = matrix(&[&[1.0, 0.0], &[1.0]]);
        assert!(!declared.is_semidefinite());
        let nearest = declared.nearest();
        for ((i, j), printed) in nearest.pairs().zip([0.7607, 0.1573, 0.7607]) {
            assert!((nearest.get(i, j) - printed).abs() < 5e-5, "{}", nearest.get(i, j));
        }
        assert!(nearest.is_semidefinite());
    }

    #[test]
    fn a_possible_matrix_is_its_own_nearest() {
        let declared = matrix(&[&[0.9, -0.36], &[-0.65]]);
        assert!(declared.nearest().distance(&declared) < 1e-12);
    }
}
