//! Contradictory coefficients: which they are, and whether rounding explains them.

use super::Correlation;
use super::error::{CorrelationError, unit};
use crate::linalg::CorrelationMatrix;

/// Largest allowed distance, in units of the last decimal, between a rounded coefficient and the
/// nearest possible one. The rounding of 2000 quantities, half a unit each and 0.29 in the root
/// mean square, moves the nearest matrix by up to one unit in some of the two million coefficients.
const FARTHEST: f64 = 2.0;

/// Whether a matrix may be a possible one whose coefficients were rounded to `decimals`. Such a
/// matrix differs by at most half a unit of the last decimal in each coefficient, so the nearest
/// possible one is not farther than that in all of them together. Among many quantities that would
/// still allow one coefficient to be quite wrong, so none may be farther than [`FARTHEST`] either.
pub(super) fn is_rounding(
    declared: &CorrelationMatrix,
    nearest: &CorrelationMatrix,
    decimals: usize,
) -> bool {
    let n = declared.size() as f64;
    let together = 0.5 * unit(decimals) * (n * (n - 1.0)).sqrt();
    let change = |(i, j)| (declared.get(i, j) - nearest.get(i, j)).abs();
    declared.distance(nearest) <= together * (1.0 + 1e-6)
        && declared.pairs().map(change).all(|change| change <= FARTHEST * unit(decimals))
}

/// The error for impossible coefficients.
pub(super) fn contradiction(
    members: &[usize],
    declared: &CorrelationMatrix,
    nearest: &CorrelationMatrix,
    decimals: usize,
) -> CorrelationError {
    let offending = offending(declared, 0.5 * unit(decimals));
    let part = declared.part(&offending);
    CorrelationError::Contradiction {
        members: offending.iter().map(|&i| members[i]).collect(),
        eigenvalue: part.lowest_eigenvalue(),
        nearest: changed(members, declared, nearest, decimals),
        decimals,
    }
}

/// A minimal set of contradictory rows: without any one of them, the rest is possible. If there are
/// several sets, it is the one that remains after leaving out row after row while the others still
/// contradict each other.
fn offending(matrix: &CorrelationMatrix, rounding: f64) -> Vec<usize> {
    let mut found: Vec<usize> = Vec::new();
    let mut rest: Vec<usize> = (0..matrix.size()).collect();
    loop {
        // add rows from the last one upwards until the contradiction appears: the row that causes
        // it belongs to the set, and the rows above it are not needed
        let order: Vec<usize> = found.iter().chain(rest.iter().rev()).copied().collect();
        match matrix.first_below(&order, -rounding) {
            Some(index) if index >= found.len() => {
                let taken = index - found.len();
                found.push(order[index]);
                rest.drain(..rest.len() - taken);
            }
            Some(_) => break,
            // no row alone is contradictory beyond rounding, only all of them together
            None => return (0..matrix.size()).collect(),
        }
    }
    found.sort_unstable();
    found
}

/// The coefficients that differ by half a unit of the last decimal or more.
pub(super) fn changed(
    members: &[usize],
    from: &CorrelationMatrix,
    to: &CorrelationMatrix,
    decimals: usize,
) -> Vec<Correlation> {
    let differs = |i: usize, j: usize| (from.get(i, j) - to.get(i, j)).abs() > 0.5 * unit(decimals);
    from.pairs()
        .filter(|&(i, j)| differs(i, j))
        .map(|(i, j)| Correlation {
            first: members[i],
            second: members[j],
            coefficient: to.get(i, j),
        })
        .collect()
}
