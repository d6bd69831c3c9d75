//! Tolerance limits of a value that comes round: 359.8 deg lies within -1 deg and 1 deg.

use super::error_law::ErrorLaw;
use crate::propagate::whole_turns::{middle, near};

/// How many scales of a law its values can be away.
const REACH: f64 = 40.0;

/// The most turns to either side that are looked at.
const MOST_TURNS: f64 = 1000.0;

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
