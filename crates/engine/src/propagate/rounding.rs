//! What double precision leaves of a result.
//!
//! A number of double precision has a relative spacing of 2^-52. Trials of an input that is large
//! beside its standard uncertainty, such as a time stamp of 1.8e9 s known to 50 ns, take few different
//! values, and so does a difference of two large quantities: figures of such trials are those of a
//! staircase, and its estimate may be off by a step. The error is propagated as uncertainties are: each
//! operation's result is off by half a spacing at most, and the output by that times its slope.

use super::evaluation::{EvaluationError, OutputEvaluation};
use super::gum::Gum;
use super::monte_carlo::MonteCarlo;
use crate::decimal::significant;
use crate::number::Shortest;
use crate::task::{Row, Task, Warning};

/// Half of the relative spacing of numbers.
const HALF_SPACING: f64 = f64::EPSILON / 2.0;

/// A share of the standard uncertainty that moves the second digit of an interval's end.
const NOTEWORTHY: f64 = 0.005;

/// A share from which on trials mean nothing.
const TOO_MUCH: f64 = 0.05;

/// What rounding does to an output.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rounding {
    /// The error of rounding, in the output's unit.
    pub(super) error: f64,
    /// The variable whose own rounding is most of it.
    variable: Option<usize>,
    /// Whether a product or a quotient of numbers that are not zero has vanished, or nearly so.
    pub(super) underflows: bool,
}

impl Rounding {
    /// That of an output at the estimates of a row; `None` of a function that is not recorded.
    pub(super) fn of(task: &Task, row: &Row, output: usize) -> Option<Self> {
        if task.function.is_some() {
            return None;
        }
        let mut values: Vec<f64> = row.distributions.iter().map(|d| d.mean()).collect();
        values.extend(&row.conditions);
        let program = &task.model.program;
        let terms = program.rounding_terms(&values, output, HALF_SPACING);
        let error = terms.squares.sqrt();
        let (variable, largest) = terms.largest_variable;
        let is_most = largest * largest > 0.2 * terms.squares && variable < row.distributions.len();
        Some(Self { error, variable: is_most.then_some(variable), underflows: terms.underflows })
    }

    /// The share of a standard uncertainty that it is; 0 of a constant.
    fn share(&self, u: f64) -> f64 {
        if u > 0.0 && self.error.is_finite() { self.error / u } else { 0.0 }
    }

    /// What it says of an output, after its name.
    fn text(&self, task: &Task, row: &Row, (output, u): (usize, f64)) -> String {
        let named = task.model.outputs.get(output);
        let (name, unit) =
            named.map_or(("", ""), |of| (&*of.quantity.name, of.quantity.unit.text()));
        let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
        let mut text = format!(
            "`{name}`: numbers of double precision, with 16 digits, leave {}{unit} of it undetermined, \
             {} % of its standard uncertainty",
            significant(self.error, 2),
            significant(100.0 * self.share(u), 2)
        );
        let input = self.variable.and_then(|v| task.variables.get(v).zip(row.distributions.get(v)));
        if let Some((variable, distribution)) = input {
            let unit = match variable.unit.text() {
                "1" | "" => String::new(),
                unit => format!(" {unit}"),
            };
            text += &format!(
                ": `{}` is {}{unit} with a standard uncertainty of {}{unit}; make it the difference from \
                 a reference value",
                variable.name,
                Shortest(distribution.mean()),
                significant(distribution.standard_uncertainty(), 2)
            );
        } else {
            text += ": large numbers cancel in its equations; write them with small differences";
        }
        text
    }
}

/// The standard uncertainty that rounding is compared with: that of the law of propagation, or a larger
/// one where the model is not linear.
fn uncertainty(gum: &Gum, second: Option<f64>, figures: Option<&MonteCarlo>) -> f64 {
    let of_trials = figures.map_or(0.0, |figures| {
        let [low, high] = figures.symmetric_interval;
        0.25 * (high - low)
    });
    gum.standard_uncertainty.max(second.unwrap_or(0.0)).max(of_trials)
}

/// Refuses trials that show the spacing of numbers and not the uncertainty of an output.
pub(super) fn check(
    task: &Task,
    (number, row): (usize, &Row),
    gums: &[Option<Gum>],
    figures: &[Option<MonteCarlo>],
) -> Result<(), EvaluationError> {
    for (output, (gum, figures)) in gums.iter().zip(figures).enumerate() {
        let Some((gum, figures)) = gum.as_ref().zip(figures.as_ref()) else { continue };
        let Some(rounding) = Rounding::of(task, row, output) else { return Ok(()) };
        let u = uncertainty(gum, None, Some(figures));
        if rounding.share(u) > TOO_MUCH {
            let text = rounding.text(task, row, (output, u));
            let message = format!(
                "{text}. `trials` of 0 evaluates it by the law of propagation alone, which has the \
                 slopes and not the digits"
            );
            return Err(EvaluationError::Rounding { row: number, output, message });
        }
    }
    Ok(())
}

/// The notes on an output whose last digits, or all, double precision does not hold.
pub(super) fn notes(
    task: &Task,
    row: &Row,
    (output, evaluated): (usize, &OutputEvaluation),
) -> Vec<Warning> {
    let Some(gum) = &evaluated.gum else { return Vec::new() };
    let Some(rounding) = Rounding::of(task, row, output) else { return Vec::new() };
    let name = task.model.outputs.get(output).map_or("", |of| &*of.quantity.name);
    let mut notes = Vec::new();
    let second = evaluated.second_order.as_ref().map(|second| second.standard_uncertainty);
    let u = uncertainty(gum, second, evaluated.monte_carlo.as_ref());
    if rounding.share(u) > NOTEWORTHY {
        let text = rounding.text(task, row, (output, u));
        notes.push(Warning::new("double-precision", name, text));
    }
    if rounding.underflows {
        let text = format!(
            "`{name}`: a product or a quotient in its equations is below the smallest number of double \
             precision, 2.2e-308, and counts as less than it is; choose units of the size of the \
             quantities"
        );
        notes.push(Warning::new("underflow", name, text));
    }
    notes
}
