//! Runs at the start with the same parameters: whether a simulator repeats, and how it scatters.

use gumption_emulator::{Scatter, SimulatorRun};
use gumption_engine::decimal::significant;
use gumption_engine::linalg::dot;

use super::simulator_runs::SimulatorRuns;
use super::{MakeRuns, refused};
use crate::{Case, OverrideError};

/// Runs with the same parameters at the start of a simulator that is said to give the same again.
const CHECKED: usize = 2;

/// The same of one whose outputs scatter: its deviation is known to a relative 1/sqrt(2*3*rows).
const SCATTERED: usize = 4;

/// Differences between two runs with the same parameters that do not count: the norm over all rows, in u. It is
/// a tenth of the error of an emulator that is small enough.
const SAME: f64 = 0.05;

/// How many runs with the same parameters a diagnosis begins with.
pub(super) fn count(is_noisy: bool) -> usize {
    if is_noisy { SCATTERED } else { CHECKED }
}

/// The first runs: the plain simulator with all inputs at their medians, several times. Of one that repeats a
/// single run is given back.
///
/// # Errors
/// A simulator that gives something else again and is not said to be noisy; a noisy one of which fewer than two
/// runs succeeded.
pub(super) fn start(
    case: &Case,
    runs: &mut SimulatorRuns,
    make: &mut MakeRuns<'_>,
) -> Result<(Vec<SimulatorRun>, Option<Scatter>), OverrideError> {
    let mut made = runs.repeats(count(runs.is_noisy()), make)?;
    if runs.is_noisy() {
        let repeats = made.iter().map(|run| &run.outputs[..]).collect();
        let scatter = Scatter::of(&[repeats], case.simulated - 1);
        let scatter = scatter.ok_or_else(|| refused(without_scatter(runs, made.len())))?;
        return Ok((made, Some(scatter)));
    }
    if let [first, second] = &made[..] {
        check(case, "with all inputs at their medians", &first.outputs, &second.outputs)?;
    }
    made.truncate(1);
    Ok((made, None))
}

fn without_scatter(runs: &SimulatorRuns, made: usize) -> String {
    let failed = runs.failed().map(|(at, why)| format!(": {at}: {why}")).unwrap_or_default();
    format!(
        "the scatter of a noisy simulator takes at least two runs with all inputs at their medians, and {made} of \
         {SCATTERED} succeeded{failed}"
    )
}

/// Compares two runs with the same parameters, in u; `at` says which parameters.
///
/// # Errors
/// They differ.
pub(super) fn check(
    case: &Case,
    at: &str,
    first: &[f64],
    second: &[f64],
) -> Result<(), OverrideError> {
    let difference: Vec<f64> = first.iter().zip(second).map(|(a, b)| a - b).collect();
    let norm = dot(&difference, &difference).sqrt();
    if norm <= SAME {
        return Ok(());
    }
    let largest = (0..difference.len()).fold(0, |largest: usize, place| {
        if difference[place].abs() > difference[largest].abs() { place } else { largest }
    });
    let rows = case.task.rows.len();
    let output = &case.model.conditions[case.described() + largest / rows].name;
    let row = largest % rows + 1;
    let number = |value: f64| significant(value, 2);
    Err(refused(format!(
        "the simulator does not repeat: two runs {at} differ by {} standard \
         uncertainties of the data, the norm over all rows, and most at `{output}` in row {row}, by {}; if its \
         outputs scatter from run to run, say so with `\"noisy\": true` in `simulator` (Python: `noisy=True`)",
        number(norm),
        number(difference[largest].abs())
    )))
}
