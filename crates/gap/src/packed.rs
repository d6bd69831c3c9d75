//! Stand-in until the engine's linalg lands.
use gumption_engine::number::elementary;
use nalgebra::DMatrix;
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}
pub const fn triangle(order: usize) -> usize {
    order * (order + 1) / 2
}
fn order(lower: &[f64]) -> usize {
    (((8 * lower.len() + 1) as f64).sqrt() as usize - 1) / 2
}
pub fn rows(lower: &[f64]) -> impl DoubleEndedIterator<Item = &[f64]> + ExactSizeIterator {
    (0..order(lower)).map(|i| &lower[triangle(i)..triangle(i + 1)])
}
pub fn of_matrix(matrix: &DMatrix<f64>) -> Vec<f64> {
    let entries = (0..matrix.nrows()).flat_map(|i| (0..=i).map(move |j| matrix[(i, j)]));
    entries.collect()
}
pub fn to_matrix(lower: &[f64]) -> DMatrix<f64> {
    let order = order(lower);
    DMatrix::from_fn(order, order, |i, j| if j <= i { lower[triangle(i) + j] } else { 0.0 })
}
pub fn cholesky(matrix: &mut [f64], least: f64) -> Result<(), usize> {
    for i in 0..order(matrix) {
        let pivot = eliminate(matrix, i);
        if pivot <= least || pivot.is_nan() {
            return Err(i);
        }
        matrix[triangle(i) + i] = pivot.sqrt();
    }
    Ok(())
}
pub fn cholesky_of_definite(matrix: &mut [f64]) {
    for i in 0..order(matrix) {
        matrix[triangle(i) + i] = eliminate(matrix, i).max(f64::MIN_POSITIVE).sqrt();
    }
}
fn eliminate(matrix: &mut [f64], i: usize) -> f64 {
    let (above, rest) = matrix.split_at_mut(triangle(i));
    let (row, diagonal) = rest.split_at_mut(i);
    for j in 0..i {
        let other = &above[triangle(j)..triangle(j + 1)];
        row[j] = (row[j] - dot(&row[..j], other)) / other[j];
    }
    diagonal[0] - dot(row, row)
}
pub fn ln_diagonal(lower: &[f64]) -> f64 {
    rows(lower).filter_map(<[f64]>::last).map(|pivot| elementary::ln(*pivot)).sum()
}
pub fn invert(lower: &mut [f64]) {
    for i in 0..order(lower) {
        let (above, rest) = lower.split_at_mut(triangle(i));
        let pivot = 1.0 / rest[i];
        for j in 0..i {
            let sum: f64 = (j..i).map(|k| rest[k] * above[triangle(k) + j]).sum();
            rest[j] = -pivot * sum;
        }
        rest[i] = pivot;
    }
}
pub fn solve(lower: &[f64], y: &mut [f64]) {
    for (i, row) in rows(lower).enumerate() {
        y[i] = (y[i] - dot(&row[..i], y)) / row[i];
    }
}
pub fn solve_transposed(lower: &[f64], y: &mut [f64]) {
    for (i, row) in rows(lower).enumerate().rev() {
        let (before, rest) = y.split_at_mut(i);
        rest[0] /= row[i];
        let f = -rest[0];
        for (s, t) in before.iter_mut().zip(row) {
            *s += f * t;
        }
    }
}
