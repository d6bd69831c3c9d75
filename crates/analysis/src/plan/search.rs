//! The required uncertainty of a single input.

use super::trial_budget::{Change, TrialBudget};

/// Number of steps by which a standard uncertainty is reduced before bisection: U may rise on the
/// way, if correlated contributions cancel or the coverage factor grows.
const STEPS: u32 = 200;

/// Number of bisections, after which the interval holds only neighbouring numbers.
const HALVINGS: u32 = 60;

/// Larger numbers of readings are unrealistic.
pub(super) const MOST_READINGS: u64 = 1_000_000_000;

/// The largest standard uncertainty of a variable, below the present one, with which the target
/// holds.
pub(super) fn needed(budget: &TrialBudget<'_>, variable: usize) -> Option<f64> {
    let now = budget.uncertainty(variable);
    let holds = |u: f64| budget.holds(&vec![(variable, Change::Width(u))]);
    let step = |number: u32| now * f64::from(STEPS - number) / f64::from(STEPS);
    let first = (1..=STEPS).find(|&number| holds(step(number)))?;
    Some(boundary(step(first), step(first - 1), holds))
}

/// The boundary between `inside`, where a condition holds, and `outside`, where it does not; the
/// result is on the inside.
pub(super) fn boundary(inside: f64, outside: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut inside, mut outside) = (inside, outside);
    for _ in 0..HALVINGS {
        let middle = 0.5 * inside + 0.5 * outside;
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

/// The smallest number of readings above the present one with which the target holds.
pub(super) fn readings_needed(budget: &TrialBudget<'_>, variable: usize, now: u64) -> Option<u64> {
    let holds = |count: u64| budget.holds(&vec![(variable, Change::Readings(count as f64))]);
    let (mut below, mut above) = (now, now.saturating_mul(2).max(2));
    while !holds(above) {
        if above >= MOST_READINGS {
            return None;
        }
        (below, above) = (above, above.saturating_mul(2).min(MOST_READINGS));
    }
    while above - below > 1 {
        let middle = below + (above - below) / 2;
        if holds(middle) {
            above = middle;
        } else {
            below = middle;
        }
    }
    Some(above)
}

/// Points of the curve of an input.
const POINTS: u32 = 40;

/// U (or u) as a function of the standard uncertainty of a variable, from 0 to 1.5 times the
/// present value.
pub(super) fn curve(budget: &TrialBudget<'_>, variable: usize) -> Vec<(f64, f64)> {
    let now = budget.uncertainty(variable);
    let point = |number: u32| {
        let u = 1.5 * now * f64::from(number) / f64::from(POINTS);
        Some((u, budget.figure(&vec![(variable, Change::Width(u))])?))
    };
    (0..=POINTS).filter_map(point).filter(|(_, figure)| figure.is_finite()).collect()
}
