//! Coefficients that contradict each other: which they are, and what rounding explains.

use super::Correlation;
use super::error::{CorrelationError, unit};
use crate::linalg::CorrelationMatrix;

/// Units of the last decimal that the nearest possible coefficient may be away from one that was only
/// rounded. The rounding of 2000 quantities, half a unit each and 0.29 in the root mean square, takes
/// the nearest matrix up to one unit away in some of the two million coefficients.
const FARTHEST: f64 = 2.0;

/// Whether a matrix may be a possible one whose coefficients were rounded to so many decimals. Such
/// a one lies at most half a unit of the last decimal away in each coefficient, so the nearest
/// possible one is not farther than that in all of them together. Among many quantities that leaves
/// room for one coefficient that is quite wrong, so none may be farther than [`FARTHEST`] either.
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

/// The error for coefficients that no quantities can have.
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

/// Rows that contradict each other: leaving out any one of them leaves a possible matrix. Where
/// several sets do, it is the one that remains when row after row is left out as long as the others
/// still contradict each other.
fn offending(matrix: &CorrelationMatrix, rounding: f64) -> Vec<usize> {
    let mut found: Vec<usize> = Vec::new();
    let mut rest: Vec<usize> = (0..matrix.size()).collect();
    loop {
        // beside those found, from the last row upwards as many as it takes: the row that makes
        // the contradiction belongs to it, and what stands above that row is not needed
        let order: Vec<usize> = found.iter().chain(rest.iter().rev()).copied().collect();
        match matrix.first_below(&order, -rounding) {
            Some(index) if index >= found.len() => {
                let taken = index - found.len();
                found.push(order[index]);
                rest.drain(..rest.len() - taken);
            }
            Some(_) => break,
            // no row is at fault beyond rounding, only all of them together
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
