//! Lower triangles stored row by row: the entry (i, j), j <= i, is at `triangle(i) + j`.
//!
//! A symmetric matrix and its Cholesky root L, with L L' the matrix, both fit into such a triangle;
//! factoring, inverting and solving work in place. The length of a slice gives the order.
//!
//! Left of the first nonzero entry of a row, the row of the Cholesky root is zero too (its
//! envelope: George and Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981,
//! chapter 4). Zeros there are skipped, so that independent blocks cost no more than each block
//! alone; no sum changes by this.

use nalgebra::DMatrix;

use super::{add_multiple, dot};
use crate::number::{CodePath, Kernel, elementary};

/// Number of entries of a lower triangle with `order` rows.
pub const fn triangle(order: usize) -> usize {
    order * (order + 1) / 2
}

/// The rows of a lower triangle, each up to its diagonal entry.
pub fn rows(lower: &[f64]) -> impl DoubleEndedIterator<Item = &[f64]> + ExactSizeIterator {
    (0..order(lower)).map(|i| row(lower, i))
}

/// The order of a lower triangle.
fn order(lower: &[f64]) -> usize {
    // (sqrt(8 n + 1) - 1)/2, exact if n is: no triangle in memory has more than 2^53 entries
    (((8 * lower.len() + 1) as f64).sqrt() as usize - 1) / 2
}

/// Row i of a lower triangle.
fn row(lower: &[f64], i: usize) -> &[f64] {
    &lower[triangle(i)..triangle(i + 1)]
}

/// The lower triangle of a square matrix.
pub fn of_matrix(matrix: &DMatrix<f64>) -> Vec<f64> {
    let entries = (0..matrix.nrows()).flat_map(|i| (0..=i).map(move |j| matrix[(i, j)]));
    entries.collect()
}

/// The lower triangular matrix with these entries; zeros above the diagonal.
pub fn to_matrix(lower: &[f64]) -> DMatrix<f64> {
    let order = order(lower);
    DMatrix::from_fn(order, order, |i, j| if j <= i { lower[triangle(i) + j] } else { 0.0 })
}

/// The symmetric matrix with this lower triangle.
pub fn to_symmetric(lower: &[f64]) -> DMatrix<f64> {
    let order = order(lower);
    DMatrix::from_fn(order, order, |i, j| lower[triangle(i.max(j)) + i.min(j)])
}

/// Replaces the lower triangle of a symmetric matrix by its Cholesky root.
///
/// # Errors
/// The first row whose pivot (the square of the root's diagonal entry) is not above `least`; rows
/// before it are replaced.
pub fn cholesky(matrix: &mut [f64], least: f64) -> Result<(), usize> {
    let firsts = firsts(matrix);
    for i in 0..firsts.len() {
        let pivot = eliminate(matrix, &firsts, i);
        if pivot <= least || pivot.is_nan() {
            return Err(i);
        }
        matrix[triangle(i) + i] = pivot.sqrt();
    }
    Ok(())
}

/// The same for a matrix that is positive definite apart from rounding, such as the identity plus
/// products: a pivot that rounding leaves at zero or below is replaced by the smallest normal
/// number.
pub fn cholesky_of_definite(matrix: &mut [f64]) {
    let firsts = firsts(matrix);
    for i in 0..firsts.len() {
        matrix[triangle(i) + i] = eliminate(matrix, &firsts, i).max(f64::MIN_POSITIVE).sqrt();
    }
}

/// Replaces row i of a matrix by that of its root, given the root's rows above and the beginning of
/// each row; the pivot is returned and not stored.
fn eliminate(matrix: &mut [f64], firsts: &[usize], i: usize) -> f64 {
    let (above, rest) = matrix.split_at_mut(triangle(i));
    let (row, diagonal) = rest.split_at_mut(i);
    for j in firsts[i]..i {
        let other = &above[triangle(j)..triangle(j + 1)];
        let first = firsts[i].max(firsts[j]);
        row[j] = (row[j] - dot(&row[first..j], &other[first..])) / other[j];
    }
    diagonal[0] - dot(&row[firsts[i]..], &row[firsts[i]..])
}

/// The column of the first nonzero entry of each row of a lower triangle, or of its diagonal.
fn firsts(lower: &[f64]) -> Vec<usize> {
    let first = |(i, row): (usize, &[f64])| first_of(row).min(i);
    rows(lower).enumerate().map(first).collect()
}

/// The index of the first nonzero value; the number of values if all are zero.
#[inline(always)]
fn first_of(values: &[f64]) -> usize {
    values.iter().position(|value| *value != 0.0).unwrap_or(values.len())
}

/// The sum of the logarithms of a triangle's diagonal: for a Cholesky root half the logarithm of
/// the determinant of its matrix.
pub fn ln_diagonal(lower: &[f64]) -> f64 {
    rows(lower).filter_map(<[f64]>::last).map(|pivot| elementary::ln(*pivot)).sum()
}

/// Replaces a lower triangle by its inverse.
pub fn invert(lower: &mut [f64]) {
    for i in 0..order(lower) {
        let (above, rest) = lower.split_at_mut(triangle(i));
        let pivot = 1.0 / rest[i];
        for j in 0..i {
            // columns left of j in this row already belong to the inverse, those from j on do not
            let sum: f64 = (j..i).map(|k| rest[k] * above[triangle(k) + j]).sum();
            rest[j] = -pivot * sum;
        }
        rest[i] = pivot;
    }
}

/// Replaces y by inv(L) y for a lower triangle L of its length.
pub fn solve(lower: &[f64], y: &mut [f64]) {
    for (i, row) in rows(lower).enumerate() {
        y[i] = (y[i] - dot(&row[..i], y)) / row[i];
    }
}

/// Number of vectors that are processed together, interleaved in memory.
pub const TOGETHER: usize = 16;

/// Replaces each of many vectors y by inv(L) y for a lower triangle L of their length, and adds the
/// squares of each result. Groups of [`TOGETHER`] vectors follow each other; in a group, entry i of
/// vector n is at `i * TOGETHER + n`. The bits are those of [`solve`].
///
/// # Panics
/// If the numbers of sums of squares and of vectors differ.
pub fn solve_many(lower: &[f64], vectors: &mut [f64], squares: &mut [f64]) {
    assert_eq!(vectors.len(), squares.len() * order(lower), "a sum for each vector");
    CodePath::best().run(SolveMany { lower, vectors, squares });
}

struct SolveMany<'a> {
    lower: &'a [f64],
    vectors: &'a mut [f64],
    squares: &'a mut [f64],
}

impl Kernel for SolveMany<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let firsts = firsts(self.lower);
        let group = (firsts.len() * TOGETHER).max(1);
        let groups = self.vectors.chunks_exact_mut(group);
        for (group, squares) in groups.zip(self.squares.chunks_exact_mut(TOGETHER)) {
            let mut lengths = [0.0; TOGETHER];
            // results before the first nonzero entries are zero, and so are later ones whose rows
            // do not extend back to `end`, the last nonzero entry
            let begin = first_of(group) / TOGETHER;
            let mut end = begin;
            for i in begin..group.len() / TOGETHER {
                let row = row(self.lower, i);
                let (known, rest) = group.split_at_mut(i * TOGETHER);
                let first = firsts[i].max(begin);
                if first >= end && rest[..TOGETHER].iter().all(|entry| *entry == 0.0) {
                    continue;
                }
                end = i + 1;
                let mut sums = [0.0; TOGETHER];
                let known = known.chunks_exact(TOGETHER).skip(first);
                for (entry, known) in row[first..].iter().zip(known) {
                    for (sum, known) in sums.iter_mut().zip(known) {
                        *sum += entry * known;
                    }
                }
                for ((y, sum), length) in rest.iter_mut().zip(&sums).zip(&mut lengths) {
                    *y = (*y - sum) / row[i];
                    *length += *y * *y;
                }
            }
            squares.copy_from_slice(&lengths);
        }
    }
}

/// Adds to the lower triangle of a symmetric matrix the products w w' of rows w of its order, one
/// row after the other.
pub fn add_squares(matrix: &mut [f64], rows: &[f64]) {
    CodePath::best().run(AddSquares { matrix, rows });
}

struct AddSquares<'a> {
    matrix: &'a mut [f64],
    rows: &'a [f64],
}

impl Kernel for AddSquares<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for row in self.rows.chunks_exact(order(self.matrix).max(1)) {
            let first = first_of(row);
            for (i, &factor) in row.iter().enumerate().skip(first) {
                // rows hold features of one output each, so that many entries are zero
                if factor != 0.0 {
                    let sums = &mut self.matrix[triangle(i)..triangle(i + 1)][first..];
                    for (sum, other) in sums.iter_mut().zip(&row[first..]) {
                        *sum += factor * other;
                    }
                }
            }
        }
    }
}

/// Replaces y by inv(L') y for a lower triangle L of its length.
pub fn solve_transposed(lower: &[f64], y: &mut [f64]) {
    for (i, row) in rows(lower).enumerate().rev() {
        let (before, rest) = y.split_at_mut(i);
        rest[0] /= row[i];
        add_multiple(before, -rest[0], row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATRIX: [[f64; 3]; 3] = [[4.0, 0.6, -0.4], [0.6, 2.0, 0.3], [-0.4, 0.3, 1.0]];

    fn lower() -> Vec<f64> {
        of_matrix(&DMatrix::from_fn(3, 3, |i, j| MATRIX[i][j]))
    }

    // Rounding of a 3 x 3 factorization: a few 1e-16.
    #[test]
    fn a_root_gives_its_matrix_back_and_its_inverse_whitens_it() {
        let dense = DMatrix::from_fn(3, 3, |i, j| MATRIX[i][j]);
        let mut root = lower();
        cholesky(&mut root, 0.0).unwrap();
        assert_eq!(to_symmetric(&root).lower_triangle(), to_matrix(&root));
        assert_eq!(to_symmetric(&root).transpose(), to_symmetric(&root));
        let mut clamped = lower();
        cholesky_of_definite(&mut clamped);
        assert_eq!(root, clamped);
        assert!((to_matrix(&root) * to_matrix(&root).transpose() - &dense).abs().max() < 1e-15);
        assert!((ln_diagonal(&root) - 0.5 * libm::log(dense.determinant())).abs() < 1e-15);
        let mut inverse = root.clone();
        invert(&mut inverse);
        let inverse = to_matrix(&inverse);
        let white = &inverse * &dense * inverse.transpose();
        assert!((white - DMatrix::identity(3, 3)).abs().max() < 1e-14);
        let mut y = [1.0, -2.0, 0.5];
        let expected = dense.try_inverse().unwrap() * DMatrix::from_column_slice(3, 1, &y);
        solve(&root, &mut y);
        solve_transposed(&root, &mut y);
        for (y, expected) in y.iter().zip(expected.iter()) {
            assert!((y - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn many_vectors_are_solved_as_each_of_them() {
        let order = 37;
        let rows: Vec<f64> =
            (0..50 * order).map(|n| ((n * 7919) % 101) as f64 / 50.0 - 1.0).collect();
        let mut root = vec![0.0; triangle(order)];
        (0..order).for_each(|i| root[triangle(i) + i] = 1.0);
        let mut plain = root.clone();
        add_squares(&mut root, &rows);
        for row in rows.chunks(order) {
            for i in 0..order {
                add_multiple(&mut plain[triangle(i)..=triangle(i) + i], row[i], row);
            }
        }
        assert_eq!(root, plain);
        cholesky_of_definite(&mut root);
        let count = 2 * TOGETHER;
        let mut vectors = vec![0.0; count * order];
        for (n, row) in rows.chunks(order).take(count).enumerate() {
            let first = n / TOGETHER * TOGETHER * order + n % TOGETHER;
            for (i, value) in row.iter().enumerate() {
                vectors[first + i * TOGETHER] = *value;
            }
        }
        let mut squares = vec![0.0; count];
        solve_many(&root, &mut vectors, &mut squares);
        for (row, square) in rows.chunks(order).zip(&squares) {
            let mut one = row.to_vec();
            solve(&root, &mut one);
            assert_eq!(dot(&one, &one).to_bits(), square.to_bits());
        }
    }

    #[test]
    fn the_first_row_without_a_pivot_is_named() {
        // the third row is the sum of the first two
        let mut singular = vec![1.0, 0.0, 1.0, 1.0, 1.0, 2.0, 0.0, 0.0, 0.0, 1.0];
        assert_eq!(cholesky(&mut singular, 0.0), Err(2));
        assert_eq!(cholesky(&mut [f64::NAN], 0.0), Err(0));
        assert_eq!(cholesky(&mut [], 0.0), Ok(()));
    }

    #[test]
    fn lengths_give_orders() {
        for n in [0, 1, 2, 3, 10, 99, 2000] {
            assert_eq!(order(&vec![0.0; triangle(n)]), n);
        }
    }
}
