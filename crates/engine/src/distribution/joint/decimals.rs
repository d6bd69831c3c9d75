//! How exactly coefficients are given.

use std::sync::Arc;

use super::Correlation;
use crate::distribution::Distribution;

/// The number of decimals with which the coefficients of a group are given: that of the longest
/// one, because trailing zeros are often left out. It is at least 2, so that a rough 0.9 does not
/// mean anything from 0.85 to 0.95, and at most 6. The coefficients of saved results scatter with
/// their trials; they count as given with 2.
pub(super) fn decimals(
    members: &[usize],
    correlations: &[Correlation],
    distributions: &[Arc<Distribution>],
) -> usize {
    let of = |c: &Correlation| {
        let text = c.coefficient.to_string();
        text.split_once('.').map_or(0, |(_, decimals)| decimals.len())
    };
    let inside = correlations.iter().filter(|c| members.binary_search(&c.first).is_ok());
    let inside = inside.filter(|c| !are_linked_results(distributions, c.first, c.second));
    inside.map(of).max().unwrap_or(0).clamp(2, 6)
}

/// Whether two quantities are dependent saved results.
pub(super) fn are_linked_results(
    distributions: &[Arc<Distribution>],
    first: usize,
    second: usize,
) -> bool {
    let saved = |q: usize| distributions.get(q).and_then(|d| d.saved());
    saved(first).zip(saved(second)).is_some_and(|(a, b)| a.is_linked(b))
}
