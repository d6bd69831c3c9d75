//! Angles are the same after a turn: 359.95 deg and 0.02 deg are 0.07 deg apart, on the branch on which
//! they lie nearest to each other.

use super::ComparisonReader;
use gumption_analysis::compare::StatedResult;
use gumption_engine::decimal::{Decimal, to_15_digits, to_position};
use gumption_engine::fact;
use gumption_engine::fact::Argument;
use gumption_engine::number::Shortest;
use gumption_text::angle_branches::{branches, turn};
use gumption_units::Unit;

/// An angle moved by turns, without what binary fractions add to it where these are whole numbers.
fn moved(angle: f64, by: f64) -> f64 {
    match Decimal::shortest(angle) {
        Some(digits) if by.fract() == 0.0 => to_position(angle + by, digits.position().min(0)),
        _ => angle + by,
    }
}

/// Results with the names that they are called by in messages.
pub(super) type Named<'a> = (String, &'a mut StatedResult);

impl ComparisonReader<'_> {
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
            let of = |place: usize| results.get(place).map(|(name, number)| (name, said(number.value)));
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
            let [angle, compared] =
                [before, result.value].map(|value| Argument::Number(said(value)));
            self.moved.push(fact!("angle-branch.moved", angle, name = &*name, compared));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moved_angles_have_their_digits() {
        assert_eq!([moved(359.95, -360.0), moved(0.02, 360.0)], [-0.05, 360.02]);
        assert_eq!(moved(3.1, -6.25), -3.15);
    }
}
