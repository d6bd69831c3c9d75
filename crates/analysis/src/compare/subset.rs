//! The largest consistent subset of laboratories.

use super::laboratories::{ReferenceValue, Results};

/// How the subset was searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SubsetSearch {
    /// Among all subsets: it is the largest one, and among subsets of its size the one with the
    /// smallest chi-squared.
    All,
    /// By removing one laboratory at a time, the one whose removal lowers chi-squared most; used if
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

/// Maximum number of subsets that are evaluated.
const MOST: u64 = 200_000;

/// Other subsets that are as good as the chosen one: of the same size, with the same chi-squared.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ties {
    /// Their number; if one laboratory is removed at a time, how many times another one could have
    /// been removed.
    pub count: usize,
    /// The members of the first of these subsets, in the order of the rows; empty if one laboratory
    /// is removed at a time.
    pub subsets: Vec<Vec<usize>>,
}

/// Maximum number of other subsets whose members are kept.
const MOST_KEPT: usize = 10;

/// The largest consistent subset and how it was found.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) reference: ReferenceValue,
    pub(super) search: SubsetSearch,
    pub(super) ties: Ties,
}

/// The largest consistent subset of `count` laboratories; `None` if a covariance matrix is not
/// positive definite. One laboratory alone is consistent.
pub(super) fn largest(results: &Results, count: usize) -> Option<Found> {
    let noise = noise(results.reference(&(0..count).collect::<Vec<_>>())?.chi_squared);
    let mut looked_at = 0u64;
    for out in 1..count {
        looked_at = looked_at.saturating_add(binomial(count as u64, out as u64));
        if looked_at > MOST {
            return one_at_a_time(results, count);
        }
        let (members, ties) = smallest(results, (count, out), noise)?;
        let reference = results.reference(&members)?;
        // the other subsets of its size have a larger chi-squared
        if reference.is_consistent() {
            return Some(Found { reference, search: SubsetSearch::All, ties });
        }
    }
    None
}

/// The next combination out of `count`, in lexical order; `false` after the last.
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

/// Relative differences of chi-squared below this are rounding.
const ROUNDING: f64 = 1e-9;

/// The rounding of the chi-squared of some laboratories, which is computed by subtraction from that
/// of all: a few hundred times the rounding of doubles, 1.1e-16.
fn noise(of_all: f64) -> f64 {
    1e-13 * of_all
}

/// The subset without `out` laboratories that has the smallest chi-squared, the first one among
/// equals, and the equals.
fn smallest(
    results: &Results,
    (count, out): (usize, usize),
    noise: f64,
) -> Option<(Vec<usize>, Ties)> {
    let precision = results.precision(&(0..count).collect::<Vec<_>>())?;
    let mut best: Option<(f64, Vec<usize>)> = None;
    let mut ties = Ties::default();
    let mut members: Vec<usize> = (0..count - out).collect();
    loop {
        // for the few remaining ones a direct computation is more accurate
        let chi_squared = if 2 * out > count {
            results.reference(&members)?.chi_squared
        } else {
            match precision.chi_squared_without(&without(&members, count)) {
                Some(found) => found,
                None => results.reference(&members)?.chi_squared,
            }
        };
        let within = |least: f64| ROUNDING * least.abs() + noise;
        match &best {
            Some((least, _)) if chi_squared > least + within(*least) => {}
            Some((least, _)) if chi_squared >= least - within(*least) => {
                ties.count += 1;
                if ties.subsets.len() < MOST_KEPT {
                    ties.subsets.push(members.clone());
                }
            }
            _ => {
                best = Some((chi_squared, members.clone()));
                ties = Ties::default();
            }
        }
        if !next(&mut members, count) {
            return best.map(|(_, members)| (members, ties));
        }
    }
}

/// The indices below `count` that are not in the sorted list `places`.
fn without(places: &[usize], count: usize) -> Vec<usize> {
    let mut others = Vec::with_capacity(count - places.len());
    let mut from = 0;
    for &place in places {
        others.extend(from..place);
        from = place + 1;
    }
    others.extend(from..count);
    others
}

fn one_at_a_time(results: &Results, count: usize) -> Option<Found> {
    let mut members: Vec<usize> = (0..count).collect();
    let mut reference = results.reference(&members)?;
    let mut ties = Ties::default();
    while !reference.is_consistent() {
        let precision = results.precision(&members)?;
        let noise = noise(reference.chi_squared);
        let mut best: Option<(f64, usize)> = None;
        let mut equals = 0;
        for place in 0..members.len() {
            let Some(chi_squared) = precision.chi_squared_without(&[place]) else { continue };
            let within = |least: f64| ROUNDING * least.abs() + noise;
            match best {
                Some((least, _)) if chi_squared > least + within(least) => {}
                Some((least, _)) if chi_squared >= least - within(least) => equals += 1,
                _ => (best, equals) = (Some((chi_squared, place)), 0),
            }
        }
        members.remove(best?.1);
        ties.count += equals;
        reference = results.reference(&members)?;
    }
    Some(Found { reference, search: SubsetSearch::OneAtATime, ties })
}

fn binomial(n: u64, k: u64) -> u64 {
    (0..k).fold(1u64, |product, i| product.saturating_mul(n - i) / (i + 1))
}
