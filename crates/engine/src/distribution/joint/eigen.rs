//! Eigenvalues and eigenvectors of symmetric matrices: reflections to three diagonals, then
//! rotations with implicit shifts (Golub and Van Loan, Matrix Computations, 8.3).
//!
//! Rows of eigenvectors are kept beside each other in memory, so that every step runs along rows.
//! Sums, products, quotients and square roots in a fixed order: the same bits on every machine.

/// Rotations of one eigenvalue at most; two sweeps for each are the rule.
const MOST_SWEEPS: usize = 60;

/// The eigenvalues of a symmetric matrix given by its rows, and in the same order its eigenvectors
/// of length 1.
pub(super) fn eigen(rows: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (mut diagonal, mut beside, mut vectors) = tridiagonal(rows);
    let n = diagonal.len();
    for first in 0..n {
        for _ in 0..MOST_SWEEPS {
            let last = block_end(first, &diagonal, &beside);
            if last == first {
                break;
            }
            sweep(first, last, &mut diagonal, &mut beside, &mut vectors);
        }
    }
    (diagonal, vectors)
}

/// The diagonal, the entries beside it, and the orthogonal matrix whose rows, times the given
/// matrix, times its transpose are those three diagonals.
fn tridiagonal(rows: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>, Vec<Vec<f64>>) {
    let n = rows.len();
    let mut a: Vec<Vec<f64>> = rows.to_vec();
    let unit = |i: usize| (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
    let mut q: Vec<Vec<f64>> = (0..n).map(unit).collect();
    let mut beside = vec![0.0; n];
    for k in 0..n.saturating_sub(2) {
        // the reflection that leaves of column k only the entry below the diagonal
        let mut v: Vec<f64> = a[k + 1..].iter().map(|row| row[k]).collect();
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
        for (row, x) in a[k + 1..].iter().zip(&v) {
            add(&mut p, beta * x, &row[k + 1..]);
        }
        let half = 0.5 * beta * dot(&p, &v);
        add(&mut p, -half, &v);
        for ((row, x), y) in a[k + 1..].iter_mut().zip(&v).zip(&p) {
            add(&mut row[k + 1..], -x, &p);
            add(&mut row[k + 1..], -y, &v);
        }
        let mut r = vec![0.0; n];
        for (row, x) in q[k + 1..].iter().zip(&v) {
            add(&mut r, beta * x, row);
        }
        for (row, x) in q[k + 1..].iter_mut().zip(&v) {
            add(row, -x, &r);
        }
    }
    if n > 1 {
        beside[n - 2] = a[n - 1][n - 2];
    }
    ((0..n).map(|i| a[i][i]).collect(), beside, q)
}

/// The end of the block that begins at `first`: the entry beside its last diagonal one is 0 up to
/// rounding.
fn block_end(first: usize, diagonal: &[f64], beside: &[f64]) -> usize {
    let n = diagonal.len();
    (first..n.saturating_sub(1))
        .find(|&m| {
            let size = diagonal[m].abs() + diagonal[m + 1].abs();
            beside[m].abs() <= 0.5 * f64::EPSILON * size || beside[m].abs() < f64::MIN_POSITIVE
        })
        .unwrap_or(n.saturating_sub(1))
}

/// One pass of rotations from the end of a block to its beginning, where the eigenvalue near the
/// shift comes out.
fn sweep(
    first: usize,
    last: usize,
    diagonal: &mut [f64],
    beside: &mut [f64],
    vectors: &mut [Vec<f64>],
) {
    let slope = (diagonal[first + 1] - diagonal[first]) / (2.0 * beside[first]);
    let shift = beside[first] / (slope + length(slope, 1.0).copysign(slope));
    let mut g = diagonal[last] - diagonal[first] + shift;
    let (mut sine, mut cosine, mut taken) = (1.0, 1.0, 0.0);
    for i in (first..last).rev() {
        let (f, b) = (sine * beside[i], cosine * beside[i]);
        let r = length(f, g);
        beside[i + 1] = r;
        if r == 0.0 {
            // the block fell apart
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
        let (above, below) = vectors.split_at_mut(i + 1);
        for (x, y) in above[i].iter_mut().zip(&mut below[0]) {
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

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn add(sum: &mut [f64], factor: f64, terms: &[f64]) {
    for (s, t) in sum.iter_mut().zip(terms) {
        *s += factor * t;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
                let (mut values, vectors) = eigen(&matrix);
                for (value, vector) in values.iter().zip(&vectors) {
                    let image: Vec<f64> = matrix.iter().map(|row| dot(row, vector)).collect();
                    let miss = image.iter().zip(vector).map(|(a, x)| (a - value * x).abs());
                    assert!(miss.fold(0.0, f64::max) < 1e-13 * f64::from(n), "{n}");
                    assert!((dot(vector, vector) - 1.0).abs() < 1e-13, "{n}");
                }
                values.sort_by(f64::total_cmp);
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
        let (values, vectors) = eigen(&[vec![3.0, 0.0], vec![0.0, -1.0]]);
        assert_eq!((values, vectors), (vec![3.0, -1.0], vec![vec![1.0, 0.0], vec![0.0, 1.0]]));
        let (mut values, _) = eigen(&vec![vec![1.0; 5]; 5]);
        values.sort_by(f64::total_cmp);
        assert!((values[4] - 5.0).abs() < 1e-14 && values[3].abs() < 1e-14, "{values:?}");
        assert_eq!(eigen(&vec![vec![0.0; 4]; 4]).0, vec![0.0; 4]);
        assert!(eigen(&[]).0.is_empty());
    }
}
