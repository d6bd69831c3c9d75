//! Angles are the same after a turn: 359.95 deg and 0.02 deg are 0.07 deg apart, on the branch on which
//! they lie nearest to each other.

use super::Reader;
use gumption_analysis::compare::StatedResult;
use gumption_engine::decimal::{Decimal, to_15_digits, to_position};
use gumption_engine::number::Shortest;
use gumption_units::{Turn, Unit};

/// Angles within this share of a turn are on the same branch, but for the rounding of binary fractions.
const HALF: f64 = 0.5 * (1.0 + 1e-12);

/// The length of a turn in a unit of plane angle; `None` for other units, and for `rev` and `turn`, whose
/// numbers count turns.
fn turn(unit: &Unit) -> Option<f64> {
    let is_angle = unit.dimension().is_none() && unit.turn() == Some(Turn::Angle);
    if !is_angle || unit.counts_revolutions() {
        return None;
    }
    let revolution = Unit::parse("rev").ok()?;
    Unit::conversion_factor(&revolution, unit).ok()
}

/// How many turns are to be added to each of some angles so that all lie within half a turn, none to the
/// first one.
///
/// # Errors
/// The places of two of them for which that cannot be: an angle of more than a turn, which may be counted
/// in turns, and one that is far from it; or two that half a turn does not hold together with the others.
fn branches(angles: &[f64], turn: f64) -> Result<Vec<f64>, [usize; 2]> {
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
    // from one of them on all lie within half a turn
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

/// An angle moved by turns, without what binary fractions add to it where these are whole numbers.
fn moved(angle: f64, by: f64) -> f64 {
    match Decimal::shortest(angle) {
        Some(digits) if by.fract() == 0.0 => to_position(angle + by, digits.position().min(0)),
        _ => angle + by,
    }
}

/// Results with the names that they are called by in messages.
pub(super) type Named<'a> = (String, &'a mut StatedResult);

impl Reader<'_> {
    /// Brings angles of one quantity to one branch, which a note says.
    ///
    /// # Errors
    /// Two that may be apart by turns that are counted, as a sentence.
    pub(super) fn on_one_branch(
        &mut self,
        results: &mut [Named<'_>],
        unit: Option<&Unit>,
    ) -> Result<(), String> {
        let Some((unit, turn)) = unit.and_then(|unit| Some((unit, turn(unit)?))) else {
            return Ok(());
        };
        let said = |value: f64| unit.after(&Shortest(to_15_digits(value)).to_string());
        let angles: Vec<f64> = results.iter().map(|(_, result)| result.value).collect();
        let added = branches(&angles, turn).map_err(|pair| {
            let of = |place: usize| results.get(place).map(|(name, of)| (name, said(of.value)));
            let [a, b] = pair.map(|place| of(place).map_or_else(String::new, |(name, value)| {
                format!("`{name}`, {value}")
            }));
            format!(
                "{a}, and {b}, are more than half a turn apart: as directions they are to be compared \
                 within one turn, as a count of turns they differ by that many; write directions from 0 \
                 to {} that half a turn holds, or the numbers without their unit where turns count",
                said(turn)
            )
        })?;
        for ((name, result), turns) in
            results.iter_mut().zip(added).filter(|(_, turns)| *turns != 0.0)
        {
            let before = result.value;
            result.value = moved(result.value, turns * turn);
            result.printed[0] = moved(result.printed[0], turns * turn);
            self.moved.push(format!("{} of `{name}` as {}", said(before), said(result.value)));
        }
        Ok(())
    }
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
    fn moved_angles_have_their_digits() {
        assert_eq!([moved(359.95, -360.0), moved(0.02, 360.0)], [-0.05, 360.02]);
        assert_eq!(moved(3.1, -6.25), -3.15);
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
