//! The branch on which angles lie closest to each other: angles that differ by whole turns are
//! equal.

use gumption_units::{Turn, Unit};

/// Angles within this fraction of a turn are on the same branch; the excess allows for binary
/// rounding.
const HALF: f64 = 0.5 * (1.0 + 1e-12);

/// The length of a turn in a unit of plane angle; `None` for other units, and for `rev` and `turn`, whose
/// numbers count turns.
pub fn turn(unit: &Unit) -> Option<f64> {
    let is_angle = unit.dimension().is_none() && unit.turn() == Some(Turn::Angle);
    if !is_angle || unit.counts_revolutions() {
        return None;
    }
    let revolution = Unit::parse("rev").ok()?;
    Unit::conversion_factor(&revolution, unit).ok()
}

/// Returns the number of turns to add to each angle so that all lie within half a turn; 0 for the
/// first one. The angles and `turn` have the same unit.
///
/// # Errors
/// The indices of two angles that cannot be brought together: an angle of more than one turn, which
/// may be counted in turns, and one far from it; or two angles that half a turn does not span.
pub fn branches(angles: &[f64], turn: f64) -> Result<Vec<f64>, [usize; 2]> {
    let by = |better: fn(f64, f64) -> bool| {
        (0..angles.len()).reduce(|a, b| if better(angles[b], angles[a]) { b } else { a })
    };
    let none = || vec![0.0; angles.len()];
    let (Some(least), Some(greatest)) = (by(|b, a| b < a), by(|b, a| b > a)) else {
        return Ok(none());
    };
    if angles[greatest] - angles[least] <= HALF * turn {
        return Ok(none());
    }
    if angles[greatest].max(-angles[least]) > turn * (1.0 + 1e-12) {
        return Err([least, greatest]);
    }
    let ahead = |from: f64, angle: f64| (angle - from).rem_euclid(turn);
    // all lie within half a turn, counted from one of them
    let start = angles.iter().copied().find(|start| {
        angles.iter().all(|angle| {
            let ahead = ahead(*start, *angle);
            ahead <= HALF * turn || turn - ahead <= 1e-12 * turn
        })
    });
    let Some(start) = start else { return Err([least, greatest]) };
    let added = |angle: f64| {
        let ahead = ahead(start, angle);
        let ahead = if ahead <= HALF * turn { ahead } else { ahead - turn };
        ((start + ahead - angle) / turn).round()
    };
    let first = angles.first().map_or(0.0, |first| added(*first));
    Ok(angles.iter().map(|angle| added(*angle) - first).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_come_to_the_nearest_branch() {
        for (angles, expected) in [
            (&[359.95, 0.02][..], Some(&[0.0, 1.0][..])),
            (&[0.02, 359.95], Some(&[0.0, -1.0])),
            (&[-179.9, 179.9], Some(&[0.0, -1.0])),
            (&[0.0, 180.0], Some(&[0.0, 0.0])),
            (&[0.0, 360.0], Some(&[0.0, -1.0])),
            (&[0.0, 170.0, -170.0], None),
            (&[180.0, 170.0, -170.0], Some(&[0.0, 0.0, 1.0])),
            (&[-170.0, 180.0, 170.0], Some(&[0.0, -1.0, -1.0])),
            (&[0.1, 359.9, 0.0, 359.8], Some(&[0.0, -1.0, 0.0, -1.0])),
            (&[0.0, 120.0, 240.0], None),
            (&[5.0, 725.0], None),
            (&[725.0, 724.9], Some(&[0.0, 0.0])),
            (&[], Some(&[])),
        ] {
            assert_eq!(branches(angles, 360.0).ok().as_deref(), expected, "{angles:?}");
        }
    }

    #[test]
    fn units_of_angle_have_a_turn() {
        let of = |text: &str| turn(&Unit::parse(text).unwrap());
        assert_eq!(
            [of("deg"), of("gon"), of("arcsec")],
            [Some(360.0), Some(400.0), Some(1_296_000.0)]
        );
        assert!((of("mrad").unwrap() / (2000.0 * std::f64::consts::PI) - 1.0).abs() < 1e-15);
        for other in ["rev", "turn", "1", "%", "deg/s", "V", "rad/V"] {
            assert_eq!(of(other), None, "{other}");
        }
    }
}
