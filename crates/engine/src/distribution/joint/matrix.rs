//! Correlation matrices: factors, what is possible, and the nearest possible matrix.
//!
//! Sums, products, quotients and square roots in a fixed order, so that factors, and the draws
//! that come from them, are the same bits on every machine.

use super::Correlation;
use super::eigen::eigen;

/// Pivots of a correlation matrix from here on make its Cholesky factor well determined.
const PIVOT: f64 = 1e-10;

/// Eigenvalues above minus this, times the number of rows, are zero up to rounding.
const ROUNDING: f64 = 1e-12;

/// Projections of [`Symmetric::nearest_correlation`] at most.
const PROJECTIONS: usize = 400;

/// Rows cubed times projections at most: about ten seconds. From 250 rows on the search may end
/// before the nearest matrix is found, at a possible one near to it.
const WORK: f64 = 4e8;

/// A symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Symmetric {
    rows: Vec<Vec<f64>>,
}

impl Symmetric {
    pub(super) fn identity(n: usize) -> Self {
        let row = |i: usize| (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        Self { rows: (0..n).map(row).collect() }
    }

    /// The coefficients among `members`, which are in order.
    pub(super) fn of(members: &[usize], correlations: &[Correlation]) -> Self {
        let mut matrix = Self::identity(members.len());
        let place = |q: usize| members.binary_search(&q).ok();
        for c in correlations {
            if let (Some(i), Some(j)) = (place(c.first), place(c.second)) {
                matrix.set(i, j, c.coefficient);
            }
        }
        matrix
    }

    pub(super) fn size(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn get(&self, i: usize, j: usize) -> f64 {
        self.rows[i][j]
    }

    pub(super) fn set(&mut self, i: usize, j: usize, value: f64) {
        self.rows[i][j] = value;
        self.rows[j][i] = value;
    }

    /// The matrix of the rows and columns at `kept`.
    pub(super) fn part(&self, kept: &[usize]) -> Self {
        let row = |&i: &usize| kept.iter().map(|&j| self.rows[i][j]).collect();
        Self { rows: kept.iter().map(row).collect() }
    }

    /// The places i < j.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let n = self.size();
        (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
    }

    /// The root of the sum of the squared differences of all entries.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let entries = self.rows.iter().flatten().zip(other.rows.iter().flatten());
        entries.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    }

    /// Whether no eigenvalue is negative by more than rounding.
    pub(super) fn is_semidefinite(&self) -> bool {
        self.regular_factor().is_some() || self.is_above(-ROUNDING * self.size() as f64)
    }

    /// Whether every eigenvalue is above `limit` < 0.
    fn is_above(&self, limit: f64) -> bool {
        let order: Vec<usize> = (0..self.size()).collect();
        self.first_below(&order, limit).is_none()
    }

    /// The first place in the order at which the rows so far have an eigenvalue below `limit` < 0.
    /// It is told without eigenvalues: as long as there is none, the matrix less `limit` on its
    /// diagonal has a Cholesky factor.
    pub(super) fn first_below(&self, order: &[usize], limit: f64) -> Option<usize> {
        self.cholesky(order, -limit, 0.0).err()
    }

    pub(super) fn lowest_eigenvalue(&self) -> f64 {
        eigen(&self.rows).0.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// A lower triangular factor with rows of length 1, of a positive semi-definite correlation
    /// matrix: Cholesky's or, for a nearly singular matrix, the triangular form of Q sqrt(D).
    pub(super) fn factor(&self) -> Vec<Vec<f64>> {
        self.regular_factor().unwrap_or_else(|| self.singular_factor())
    }

    fn regular_factor(&self) -> Option<Vec<Vec<f64>>> {
        let order: Vec<usize> = (0..self.size()).collect();
        self.cholesky(&order, 0.0, PIVOT).ok()
    }

    /// Cholesky's factor of the rows in an order, with `shift` added to the diagonal; or the first
    /// place at which a pivot is not above `least`.
    fn cholesky(&self, order: &[usize], shift: f64, least: f64) -> Result<Vec<Vec<f64>>, usize> {
        let mut factor: Vec<Vec<f64>> = Vec::with_capacity(order.len());
        for (place, &i) in order.iter().enumerate() {
            let entries = &self.rows[i];
            let mut row = Vec::with_capacity(place + 1);
            for (above, &j) in factor.iter().zip(order) {
                let sum: f64 = row.iter().zip(above).map(|(a, b)| a * b).sum();
                row.push((entries[j] - sum) / above[row.len()]);
            }
            let pivot = entries[i] + shift - row.iter().map(|a| a * a).sum::<f64>();
            if pivot <= least || pivot.is_nan() {
                return Err(place);
            }
            row.push(pivot.sqrt());
            factor.push(row);
        }
        Ok(factor)
    }

    /// Gram-Schmidt on the rows of Q sqrt(max(D, 0)).
    fn singular_factor(&self) -> Vec<Vec<f64>> {
        let (values, vectors) = eigen(&self.rows);
        // the root of an eigenvalue that is zero but for rounding would be no rounding any more
        let zero = 4.0 * f64::EPSILON * self.size() as f64;
        let root = |e: &f64| if *e > zero { e.sqrt() } else { 0.0 };
        let roots: Vec<f64> = values.iter().map(root).collect();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let mut factor: Vec<Vec<f64>> = Vec::new();
        for i in 0..self.size() {
            let mut rest: Vec<f64> = vectors.iter().zip(&roots).map(|(q, d)| q[i] * d).collect();
            let mut row: Vec<f64> = vec![0.0; basis.len()];
            // twice is enough: the second pass takes away what the first one's rounding left
            for _ in 0..2 {
                for (entry, unit) in row.iter_mut().zip(&basis) {
                    let along: f64 = rest.iter().zip(unit).map(|(a, b)| a * b).sum();
                    *entry += along;
                    for (a, b) in rest.iter_mut().zip(unit) {
                        *a -= along * b;
                    }
                }
            }
            let norm = rest.iter().map(|a| a * a).sum::<f64>().sqrt();
            let independent = norm > 1e-9;
            row.push(if independent { norm } else { 0.0 });
            let unit = |a: &f64| if independent { a / norm } else { 0.0 };
            basis.push(rest.iter().map(unit).collect());
            let length = row.iter().map(|a| a * a).sum::<f64>().sqrt();
            factor.push(row.iter().map(|a| a / length).collect());
        }
        factor
    }

    /// The correlation matrix nearest to this one in the root of the sum of squares, by alternating
    /// projections with Dykstra's correction (Higham, IMA Journal of Numerical Analysis 22, 2002,
    /// algorithm 3.3), and at last scaled to an exact diagonal of ones.
    pub(super) fn nearest_correlation(&self) -> Self {
        let n = self.size();
        let affordable = WORK / (n as f64).powi(3).max(1.0);
        let projections = (affordable as usize).clamp(1, PROJECTIONS);
        let mut near = self.clone();
        let mut correction = vec![vec![0.0; n]; n];
        let mut semidefinite = self.clone();
        for _ in 0..projections {
            let mut shifted = near.clone();
            for (row, taken) in shifted.rows.iter_mut().zip(&correction) {
                for (entry, c) in row.iter_mut().zip(taken) {
                    *entry -= c;
                }
            }
            semidefinite = shifted.clipped();
            let changes = semidefinite.rows.iter().flatten().zip(shifted.rows.iter().flatten());
            for (c, (after, before)) in correction.iter_mut().flatten().zip(changes) {
                *c = after - before;
            }
            let mut next = semidefinite.clone();
            for (i, row) in next.rows.iter_mut().enumerate() {
                row[i] = 1.0;
            }
            let moved = next.distance(&near);
            near = next;
            if moved < 1e-13 * n as f64 {
                break;
            }
        }
        let scale: Vec<f64> =
            (0..n).map(|i| semidefinite.rows[i][i].max(f64::MIN_POSITIVE).sqrt()).collect();
        let mut nearest = Self::identity(n);
        for (i, j) in self.pairs() {
            let r = semidefinite.rows[i][j] / (scale[i] * scale[j]);
            nearest.set(i, j, r.clamp(-1.0, 1.0));
        }
        nearest
    }

    /// The nearest positive semi-definite matrix: negative eigenvalues become zero.
    fn clipped(&self) -> Self {
        let (values, vectors) = eigen(&self.rows);
        let mut clipped = self.clone();
        let negative = values.iter().zip(&vectors).filter(|(value, _)| **value < 0.0);
        for (value, vector) in negative {
            for (row, x) in clipped.rows.iter_mut().zip(vector) {
                for (entry, y) in row.iter_mut().zip(vector) {
                    *entry -= value * (x * y);
                }
            }
        }
        clipped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(upper: &[&[f64]]) -> Symmetric {
        let mut matrix = Symmetric::identity(upper.len() + 1);
        for (i, row) in upper.iter().enumerate() {
            for (k, &r) in row.iter().enumerate() {
                matrix.set(i, i + 1 + k, r);
            }
        }
        matrix
    }

    fn product(factor: &[Vec<f64>], i: usize, j: usize) -> f64 {
        factor[i].iter().zip(&factor[j]).map(|(a, b)| a * b).sum()
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
        let nearest = declared.nearest_correlation();
        for ((i, j), printed) in nearest.pairs().zip([0.7607, 0.1573, 0.7607]) {
            assert!((nearest.get(i, j) - printed).abs() < 5e-5, "{}", nearest.get(i, j));
        }
        assert!(nearest.is_semidefinite());
    }

    #[test]
    fn a_possible_matrix_is_its_own_nearest() {
        let declared = matrix(&[&[0.9, -0.36], &[-0.65]]);
        assert!(declared.nearest_correlation().distance(&declared) < 1e-12);
    }
}
