//! Tolerance limits of a value that comes round: 359.8 deg lies within -1 deg and 1 deg.

use super::error_law::ErrorLaw;
use crate::propagate::monte_carlo::onto_branch;

/// How many scales of a law its values can be away.
const REACH: f64 = 40.0;

/// The most turns to either side that are looked at.
const MOST_TURNS: f64 = 1000.0;

/// The value moved by whole turns to within half a turn of the middle.
pub(super) fn near(mut value: f64, middle: f64, turn: f64) -> f64 {
    onto_branch(std::slice::from_mut(&mut value), middle, turn);
    value
}

/// The middle of limits.
fn middle([lower, upper]: [f64; 2]) -> f64 {
    lower + 0.5 * (upper - lower)
}

/// The limits for values within half a turn of `middle`. Where they reach beyond that branch the lower
/// one comes out above the upper one: values above the one or below the other are inside.
pub(in crate::propagate) fn on_branch(
    limits: [f64; 2],
    middle_of_branch: f64,
    turn: f64,
) -> [f64; 2] {
    let width = limits[1] - limits[0];
    if width.is_nan() || width >= turn {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    let moved = near(middle(limits), middle_of_branch, turn) - middle(limits);
    let [lower, upper] = limits.map(|limit| limit + moved);
    if upper > middle_of_branch + 0.5 * turn {
        [lower, upper - turn]
    } else if lower < middle_of_branch - 0.5 * turn {
        [lower + turn, upper]
    } else {
        [lower, upper]
    }
}

/// The estimate on the branch of the limits.
pub(super) fn at_limits(estimate: f64, limits: [f64; 2], turn: Option<f64>) -> f64 {
    match turn {
        Some(turn) if middle(limits).is_finite() => near(estimate, middle(limits), turn),
        _ => estimate,
    }
}

/// The limits on the branch of what was known before measuring.
pub(super) fn at_prior(limits: [f64; 2], prior: Option<f64>, turn: Option<f64>) -> [f64; 2] {
    match (prior, turn) {
        (Some(prior), Some(turn)) if middle(limits).is_finite() => {
            let moved = near(middle(limits), prior, turn) - middle(limits);
            limits.map(|limit| limit + moved)
        }
        _ => limits,
    }
}

/// The probability of a value within the limits, modulo a turn if there is one.
pub(super) fn share(law: &ErrorLaw, estimate: f64, limits: [f64; 2], turn: Option<f64>) -> f64 {
    let within = |moved: f64| law.share(limits.map(|limit| limit + moved - estimate));
    let Some(turn) = turn.filter(|_| middle(limits).is_finite()) else { return within(0.0) };
    if limits[1] - limits[0] >= turn {
        return 1.0;
    }
    let turns = (REACH * law.scale() / turn).ceil().clamp(1.0, MOST_TURNS) as i32;
    let others = (1..=turns).map(|k| f64::from(k) * turn);
    let beside: f64 = others.map(|moved| within(moved) + within(-moved)).sum();
    (within(0.0) + beside).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of values, moved to the branch: the same ones are inside as by the remainder.
    #[test]
    fn limits_hold_the_values_that_the_remainder_holds() {
        for limits in [[-1.0, 1.0], [-182.0, -179.0], [359.0, 361.0], [0.0, 359.0], [719.5, 900.0]]
        {
            for estimate in [359.8, 179.5, -179.9, 0.0, 1000.0, 90.0] {
                let [lower, upper] = on_branch(limits, estimate, 360.0);
                for step in 0..720 {
                    // never on a limit
                    let value = near(estimate + 0.5 * f64::from(step) + 0.137, estimate, 360.0);
                    let inside = match lower <= upper {
                        true => value >= lower && value <= upper,
                        false => value >= lower || value <= upper,
                    };
                    let expected = (value - limits[0]).rem_euclid(360.0) <= limits[1] - limits[0];
                    assert_eq!(inside, expected, "{value} in {limits:?} about {estimate}");
                }
            }
        }
        assert_eq!(on_branch([0.0, 360.0], 7.0, 360.0), [f64::NEG_INFINITY, f64::INFINITY]);
    }

    /// A normal law far wider than a turn is even over it: to 1e-9, as its first harmonic is
    /// exp(-2 (pi u/T)^2) = 5e-35. A narrow one is where it is: Phi(12) - Phi(-8).
    #[test]
    fn shares_modulo_a_turn() {
        let wide = share(&ErrorLaw::normal(720.0), 17.0, [-1.0, 89.0], Some(360.0));
        assert!((wide - 0.25).abs() < 1e-9, "{wide}");
        let narrow = share(&ErrorLaw::normal(0.1), 359.8, [-1.0, 1.0], Some(360.0));
        assert!((narrow - 1.0).abs() < 1e-14, "{narrow}");
        assert_eq!(share(&ErrorLaw::normal(0.1), 5.0, [0.0, 400.0], Some(360.0)), 1.0);
    }
}
