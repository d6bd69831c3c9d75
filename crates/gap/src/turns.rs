//! Angles that come round, where nothing says that they do.

use super::departure::ends;
use gumption_engine::decimal::to_15_digits;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::number::smallest_first;
use gumption_inference::setup::Setup;
use gumption_units::Turn;

/// From one condition to the next a residual jumps by more than this part of a turn where it was
/// wrapped: what is left beside a whole turn is then less than a quarter.
const JUMP: f64 = 0.75;

/// What is to be said of an output that is an angle but is not said to be periodic: that values are
/// more than half a turn from the sim, or that they lie within one turn and jump by nearly a whole one
/// between neighbouring conditions, which no smooth effect does.
pub(crate) fn note(setup: &Setup<'_>) -> Option<Fact> {
    let data = &setup.data;
    let residuals = data.nominal_residuals();
    residuals.iter().enumerate().find_map(|(output, residuals)| {
        let quantity = &setup.case.model.outputs[data.outputs[output]].quantity;
        let is_angle = quantity.unit.turn() == Some(Turn::Angle);
        if data.turns[output].is_some() || !is_angle {
            return None;
        }
        let turn = to_15_digits(std::f64::consts::TAU / quantity.unit.factor());
        let (name, count) = (&quantity.name, residuals.len());
        let (lower, upper) = ends(&data.values[output]);
        let far = residuals.iter().filter(|residual| residual.abs() > 0.5 * turn).count();
        if far > 0 {
            return Some(fact!("whole-turns", far, count, name, turn));
        }
        let jumps = upper - lower <= turn && jumps(setup, residuals, JUMP * turn);
        jumps.then(|| fact!("whole-turns.jumps", name, turn))
    })
}

/// Whether residuals of rows that follow each other along one condition, all others being equal,
/// differ by more than `far`.
fn jumps(setup: &Setup<'_>, residuals: &[f64], far: f64) -> bool {
    let conditions: Vec<usize> = setup.case.set_conditions().collect();
    let value = |row: usize, condition: usize| setup.row(row).conditions[condition];
    conditions.iter().any(|&along| {
        let others = || conditions.iter().copied().filter(move |&condition| condition != along);
        let mut rows: Vec<usize> = (0..residuals.len()).collect();
        // each pass keeps the order of the one before
        for condition in std::iter::once(along).chain(others()) {
            smallest_first(&mut rows, |&row| value(row, condition));
        }
        rows.windows(2).any(|pair| {
            let [a, b] = [pair[0], pair[1]];
            (residuals[a] - residuals[b]).abs() > far
                && others().all(|condition| value(a, condition) == value(b, condition))
        })
    })
}
