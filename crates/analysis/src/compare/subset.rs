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
        let mut best: Option<ReferenceValue> = None;
        let mut members: Vec<usize> = (0..count - out).collect();
        loop {
            let found = results.reference(&members)?;
            let better = best.as_ref().is_none_or(|best| found.chi_squared < best.chi_squared);
            if found.is_consistent() && better {
                best = Some(found);
            }
            if !next(&mut members, count) {
                break;
            }
        }
        if let Some(best) = best {
            return Some((best, SubsetSearch::All));
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

fn one_at_a_time(results: &Results, count: usize) -> Option<ReferenceValue> {
    let mut members: Vec<usize> = (0..count).collect();
    let mut found = results.reference(&members)?;
    while !found.is_consistent() {
        let without = (0..members.len()).filter_map(|place| {
            let mut fewer = members.clone();
            fewer.remove(place);
            results.reference(&fewer)
        });
        found = without.min_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared))?;
        members.clone_from(&found.members);
    }
    Some(found)
}

fn binomial(n: u64, k: u64) -> u64 {
    (0..k).fold(1u64, |product, i| product.saturating_mul(n - i) / (i + 1))
}
