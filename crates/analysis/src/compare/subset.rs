//! The largest consistent subset of laboratories.

use super::laboratories::{ReferenceValue, Results};

/// How the subset was looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SubsetSearch {
    /// Among all subsets: it is the largest one, and of those of its size the one with the smallest
    /// chi-squared.
    All,
    /// By taking out one laboratory at a time, that whose absence lowers chi-squared most: where
    /// there are too many subsets.
    OneAtATime,
}

impl SubsetSearch {
    /// The words of the answer.
    pub fn name(self) -> &'static str {
        match self {
            Self::All => "all subsets",
            Self::OneAtATime => "one at a time",
        }
    }
}

/// At most so many subsets are looked at.
const MOST: u64 = 200_000;

/// The largest consistent subset of `count` laboratories; `None` if a covariance matrix is not
/// positive definite. One laboratory alone is consistent.
pub(super) fn largest(results: &Results, count: usize) -> Option<(ReferenceValue, SubsetSearch)> {
    let mut looked_at = 0u64;
    for out in 1..count {
        looked_at = looked_at.saturating_add(binomial(count as u64, out as u64));
        if looked_at > MOST {
            return one_at_a_time(results, count).map(|found| (found, SubsetSearch::OneAtATime));
        }
        let found = results.reference(&smallest(results, count, out)?)?;
        // the others of its size have larger chi-squared
        if found.is_consistent() {
            return Some((found, SubsetSearch::All));
        }
    }
    None
}

/// The next choice of as many out of `count`, in lexical order; `false` after the last.
fn next(chosen: &mut [usize], count: usize) -> bool {
    let size = chosen.len();
    let Some(place) = (0..size).rev().find(|&place| chosen[place] < count - size + place) else {
        return false;
    };
    let first = chosen[place] + 1;
    for (offset, chosen) in chosen[place..].iter_mut().enumerate() {
        *chosen = first + offset;
    }
    true
}

/// Differences of chi-squared below this share are rounding.
const ROUNDING: f64 = 1e-9;

/// The subset without `out` laboratories that has the smallest chi-squared; the first one of equals.
fn smallest(results: &Results, count: usize, out: usize) -> Option<Vec<usize>> {
    let precision = results.precision(&(0..count).collect::<Vec<_>>())?;
    let mut best: Option<(f64, Vec<usize>)> = None;
    let mut members: Vec<usize> = (0..count - out).collect();
    loop {
        // what is left of a few is told best by themselves
        let chi_squared = if 2 * out > count {
            results.reference(&members)?.chi_squared
        } else {
            let left: Vec<usize> =
                (0..count).filter(|place| members.binary_search(place).is_err()).collect();
            match precision.chi_squared_without(&left) {
                Some(found) => found,
                None => results.reference(&members)?.chi_squared,
            }
        };
        if best.as_ref().is_none_or(|(least, _)| chi_squared < least * (1.0 - ROUNDING)) {
            best = Some((chi_squared, members.clone()));
        }
        if !next(&mut members, count) {
            return best.map(|(_, members)| members);
        }
    }
}

fn one_at_a_time(results: &Results, count: usize) -> Option<ReferenceValue> {
    let mut members: Vec<usize> = (0..count).collect();
    let mut found = results.reference(&members)?;
    while !found.is_consistent() {
        let precision = results.precision(&members)?;
        let mut best: Option<(f64, usize)> = None;
        for place in 0..members.len() {
            let Some(chi_squared) = precision.chi_squared_without(&[place]) else { continue };
            if best.is_none_or(|(least, _)| chi_squared < least * (1.0 - ROUNDING)) {
                best = Some((chi_squared, place));
            }
        }
        members.remove(best?.1);
        found = results.reference(&members)?;
    }
    Some(found)
}

fn binomial(n: u64, k: u64) -> u64 {
    (0..k).fold(1u64, |product, i| product.saturating_mul(n - i) / (i + 1))
}
