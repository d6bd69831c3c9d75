//! Whether the correlation coefficients of laboratories belong to a joint distribution, and whether
//! the matrix can be inverted accurately.

use super::laboratories::{Impossible, Laboratory};
use gumption_engine::linalg::{dot, packed};

/// The smallest fraction of a laboratory's variance that the other laboratories may leave
/// unexplained. Results computed with the inverse matrix have a relative error of double precision
/// (1.1e-16, at most 200 times) divided by this fraction: 1e-9 leaves four digits of weights and
/// uncertainties. Stated coefficients have fewer digits than the nine nines that come so near to 1.
const LEAST: f64 = 1e-9;

/// Checks that the matrix of coefficients is positive definite beyond rounding.
///
/// The pivots of the Cholesky decomposition of a correlation matrix are the fractions of each
/// variance that the previous laboratories do not explain.
pub(super) fn check(
    laboratories: &[Laboratory],
    coefficient: impl Fn(usize, usize) -> f64,
) -> Result<(), Impossible> {
    let n = laboratories.len();
    let name = |place: usize| laboratories.get(place).map_or("", |of| &of.label).to_owned();
    let pairs = || (0..n).flat_map(|i| (0..i).map(move |j| (j, i)));
    if let Some((j, i)) = pairs().find(|&(j, i)| 1.0 - coefficient(j, i).powi(2) < LEAST) {
        let coefficient = coefficient(j, i);
        return Err(Impossible::FullyCorrelated { laboratories: [name(j), name(i)], coefficient });
    }
    let row = |i: usize| (0..i).map(|j| coefficient(i, j)).chain([1.0]).collect::<Vec<f64>>();
    let mut lower: Vec<f64> = (0..n).flat_map(row).collect();
    packed::cholesky(&mut lower, LEAST).map_err(|i| {
        // its entries left of the diagonal are those of the root already
        let explained = packed::rows(&lower).nth(i).map_or(&[][..], |row| &row[..i]);
        Impossible::Dependent { laboratory: name(i), left: 1.0 - dot(explained, explained) }
    })
}
