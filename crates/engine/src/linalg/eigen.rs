//! Eigenvalues and eigenvectors of symmetric matrices: reduction to tridiagonal form by
//! reflections, then rotations with implicit shifts (Golub and Van Loan, Matrix Computations, 8.3).
//!
//! The entries of an eigenvector are adjacent in memory, and every step runs along them: a matrix
//! of a thousand rows then takes seconds instead of minutes.

use nalgebra::DMatrix;

use super::{add_multiple, dot};

/// Maximum number of sweeps for one eigenvalue; two are usual.
const MOST_SWEEPS: usize = 60;

/// Eigenvalues and eigenvectors of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigen {
    /// The eigenvalues, in no order.
    pub values: Vec<f64>,
    /// The eigenvectors of length 1, as columns in the same order.
    pub vectors: DMatrix<f64>,
}

impl Eigen {
    /// The eigenvalues and eigenvectors of a symmetric matrix.
    pub fn of(matrix: &DMatrix<f64>) -> Self {
        let n = matrix.nrows();
        let mut reduced = tridiagonal(matrix.clone());
        for first in 0..n {
            for _ in 0..MOST_SWEEPS {
                let last = block_end(first, &reduced);
                if last == first {
                    break;
                }
                sweep(first, last, &mut reduced);
            }
        }
        Self { values: reduced.diagonal, vectors: reduced.vectors }
    }

    /// The eigenvalues, each with its eigenvector.
    pub fn pairs(&self) -> impl Iterator<Item = (f64, &[f64])> {
        // columns of length 0 do not exist, so without eigenvalues nothing is split
        let n = self.values.len().max(1);
        self.values.iter().copied().zip(self.vectors.as_slice().chunks_exact(n))
    }
}

/// A symmetric matrix in tridiagonal form: with Q the matrix of the vectors, Q T Q' is the given
/// matrix.
struct Tridiagonal {
    diagonal: Vec<f64>,
    /// The entries beside the diagonal; the last one is unused.
    beside: Vec<f64>,
    vectors: DMatrix<f64>,
}

fn tridiagonal(mut a: DMatrix<f64>) -> Tridiagonal {
    let n = a.nrows();
    let mut vectors = DMatrix::identity(n, n);
    let mut beside = vec![0.0; n];
    for k in 0..n.saturating_sub(2) {
        // columns from k + 1 on, of a symmetric matrix the same as its rows
        let from = (k + 1) * n;
        let a = &mut a.as_mut_slice()[from..];
        let q = &mut vectors.as_mut_slice()[from..];
        // the reflection that leaves only the entry beside the diagonal of row k
        let mut v: Vec<f64> = a.chunks_exact(n).map(|column| column[k]).collect();
        let below: f64 = v[1..].iter().map(|x| x * x).sum();
        let norm = (v[0] * v[0] + below).sqrt();
        beside[k] = v[0];
        if below == 0.0 || norm == 0.0 {
            continue;
        }
        beside[k] = -norm.copysign(v[0]);
        v[0] -= beside[k];
        let beta = 2.0 / (v[0] * v[0] + below);
        let mut p = vec![0.0; v.len()];
        for (column, x) in a.chunks_exact(n).zip(&v) {
            add_multiple(&mut p, beta * x, &column[k + 1..]);
        }
        let half = 0.5 * beta * dot(&p, &v);
        add_multiple(&mut p, -half, &v);
        for ((column, x), y) in a.chunks_exact_mut(n).zip(&v).zip(&p) {
            add_multiple(&mut column[k + 1..], -x, &p);
            add_multiple(&mut column[k + 1..], -y, &v);
        }
        let mut r = vec![0.0; n];
        for (column, x) in q.chunks_exact(n).zip(&v) {
            add_multiple(&mut r, beta * x, column);
        }
        for (column, x) in q.chunks_exact_mut(n).zip(&v) {
            add_multiple(column, -x, &r);
        }
    }
    if n > 1 {
        beside[n - 2] = a[(n - 2, n - 1)];
    }
    Tridiagonal { diagonal: a.diagonal().as_slice().to_vec(), beside, vectors }
}

/// The end of the block that begins at `first`: the entry beside its last diagonal entry is 0 up to
/// rounding.
fn block_end(first: usize, Tridiagonal { diagonal, beside, .. }: &Tridiagonal) -> usize {
    let end = diagonal.len().saturating_sub(1);
    let falls_apart = |&m: &usize| {
        let size = diagonal[m].abs() + diagonal[m + 1].abs();
        beside[m].abs() <= 0.5 * f64::EPSILON * size || beside[m].abs() < f64::MIN_POSITIVE
    };
    (first..end).find(falls_apart).unwrap_or(end)
}

/// One pass of rotations from the end of a block to its beginning, where the eigenvalue near the
/// shift comes out.
fn sweep(first: usize, last: usize, reduced: &mut Tridiagonal) {
    let Tridiagonal { diagonal, beside, vectors } = reduced;
    let n = diagonal.len();
    let slope = (diagonal[first + 1] - diagonal[first]) / (2.0 * beside[first]);
    let shift = beside[first] / (slope + length(slope, 1.0).copysign(slope));
    let mut g = diagonal[last] - diagonal[first] + shift;
    let (mut sine, mut cosine, mut taken) = (1.0, 1.0, 0.0);
    for i in (first..last).rev() {
        let (f, b) = (sine * beside[i], cosine * beside[i]);
        let r = length(f, g);
        beside[i + 1] = r;
        if r == 0.0 {
            // the block splits here
            diagonal[i + 1] -= taken;
            beside[last] = 0.0;
            return;
        }
        (sine, cosine) = (f / r, g / r);
        g = diagonal[i + 1] - taken;
        let t = (diagonal[i] - g) * sine + 2.0 * cosine * b;
        taken = sine * t;
        diagonal[i + 1] = g + taken;
        g = cosine * t - b;
        let (here, next) = vectors.as_mut_slice()[i * n..(i + 2) * n].split_at_mut(n);
        for (x, y) in here.iter_mut().zip(next) {
            (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
        }
    }
    diagonal[first] -= taken;
    beside[first] = g;
    beside[last] = 0.0;
}

fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
        DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j])
    }

    /// The matrix with 2 on the diagonal and -1 beside it has the eigenvalues
    /// 2 - 2 cos(k pi/(n + 1)); mixed by a reflection it keeps them. Rounding grows with n.
    #[test]
    fn second_differences_have_their_closed_form() {
        for n in [1, 2, 3, 10, 60] {
            let entry = |i: usize, j: usize| match i.abs_diff(j) {
                0 => 2.0,
                1 => -1.0,
                _ => 0.0,
            };
            // H A H with H = 1 - 2 v v^T / v^T v and v = (1, 2, 3, ...)
            let v: Vec<f64> = (1..=n).map(f64::from).collect();
            let square = dot(&v, &v);
            let reflect = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> {
                let along = |row: &Vec<f64>| 2.0 * dot(row, &v) / square;
                let image = |row: &Vec<f64>| {
                    let t = along(row);
                    row.iter().zip(&v).map(|(x, v)| x - t * v).collect()
                };
                rows.iter().map(image).collect()
            };
            let transposed = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> {
                (0..rows.len()).map(|j| rows.iter().map(|row| row[j]).collect()).collect()
            };
            let size = n as usize;
            let plain: Vec<Vec<f64>> =
                (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
            let mixed = reflect(&transposed(&reflect(&plain)));
            for matrix in [plain, mixed] {
                let eigen = Eigen::of(&self::matrix(&matrix));
                for (value, vector) in eigen.pairs() {
                    let image: Vec<f64> = matrix.iter().map(|row| dot(row, vector)).collect();
                    let miss = image.iter().zip(vector).map(|(a, x)| (a - value * x).abs());
                    assert!(miss.fold(0.0, f64::max) < 1e-13 * f64::from(n), "{n}");
                    assert!((dot(vector, vector) - 1.0).abs() < 1e-13, "{n}");
                }
                let mut values = eigen.values;
                values.sort_unstable_by(f64::total_cmp);
                for (k, value) in values.iter().enumerate() {
                    let angle = (k as f64 + 1.0) * std::f64::consts::PI / (f64::from(n) + 1.0);
                    let exact = 2.0 - 2.0 * angle.cos();
                    assert!((value - exact).abs() < 1e-13 * f64::from(n), "{n}: {value} {exact}");
                }
            }
        }
    }

    /// A matrix that is diagonal already, one of equal entries, and one of zeros.
    #[test]
    fn degenerate_matrices() {
        let eigen = Eigen::of(&matrix(&[vec![3.0, 0.0], vec![0.0, -1.0]]));
        assert_eq!((eigen.values, eigen.vectors), (vec![3.0, -1.0], DMatrix::identity(2, 2)));
        let mut values = Eigen::of(&DMatrix::from_element(5, 5, 1.0)).values;
        values.sort_unstable_by(f64::total_cmp);
        assert!((values[4] - 5.0).abs() < 1e-14 && values[3].abs() < 1e-14, "{values:?}");
        assert_eq!(Eigen::of(&DMatrix::zeros(4, 4)).values, vec![0.0; 4]);
        assert_eq!(Eigen::of(&DMatrix::zeros(0, 0)).pairs().count(), 0);
    }
}
