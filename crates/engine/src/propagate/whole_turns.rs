//! Values that come round, moved by whole turns: 359.8 deg lies within -1 deg and 1 deg.

/// Moves values by whole turns to within half a turn of the middle.
#[inline(always)]
pub fn onto_branch(values: &mut [f64], middle: f64, turn: f64) {
    // adding and taking away 1.5 x 2^52 rounds to the nearest integer; phases of more turns than
    // that have lost their angle anyway
    const ROUND: f64 = 6_755_399_441_055_744.0;
    for value in values {
        let turns = ((*value - middle) / turn + ROUND) - ROUND;
        *value -= turn * turns;
    }
}

/// The value moved by whole turns to within half a turn of the middle.
pub(super) fn near(mut value: f64, middle: f64, turn: f64) -> f64 {
    onto_branch(std::slice::from_mut(&mut value), middle, turn);
    value
}

/// The middle of limits.
pub(super) fn middle([lower, upper]: [f64; 2]) -> f64 {
    lower + 0.5 * (upper - lower)
}

/// The limits for values within half a turn of `middle`. Where they reach beyond that branch the lower
/// one comes out above the upper one: values above the one or below the other are inside.
pub(super) fn on_branch(limits: [f64; 2], middle_of_branch: f64, turn: f64) -> [f64; 2] {
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
}
