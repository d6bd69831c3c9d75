//! What double precision leaves of a result.
//!
//! Numbers of double precision have a relative spacing of 2^-52. Trials of an input that is large beside
//! its standard uncertainty, such as a time stamp of 1.8e9 s known to 50 ns, take few different values:
//! their figures are those of a staircase, and the input's estimate may itself be off by half a step.

use super::evaluation::{EvaluationError, OutputEvaluation};
use super::gum::{BudgetLine, Gum};
use crate::decimal::significant;
use crate::number::Shortest;
use crate::task::{Row, Task, Warning};

/// Half of the relative spacing of numbers.
const HALF_SPACING: f64 = f64::EPSILON / 2.0;

/// A share of an input's standard uncertainty that moves the second digit of an interval's end.
const NOTEWORTHY: f64 = 0.005;

/// A share from which on trials mean nothing.
const TOO_MUCH: f64 = 0.05;

/// A contribution counts from this share of the output's standard uncertainty on.
const COUNTS: f64 = 0.1;

/// The input of an output whose standard uncertainty is the smallest beside its spacing, and that spacing
/// as its share.
fn coarsest(gum: &Gum) -> Option<(BudgetLine, f64)> {
    let least = COUNTS * gum.standard_uncertainty;
    let share = |line: BudgetLine| {
        let share = HALF_SPACING * line.estimate.abs() / line.standard_uncertainty;
        (line, share)
    };
    gum.budget()
        .filter(|line| line.standard_uncertainty > 0.0 && line.contribution >= least)
        .map(share)
        .filter(|(_, share)| share.is_finite() && *share > NOTEWORTHY)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// What is said of it.
fn text(task: &Task, output: usize, (line, share): (&BudgetLine, f64)) -> String {
    let name = task.model.outputs.get(output).map_or("", |of| &*of.quantity.name);
    let variable = task.variables.get(line.variable);
    let (input, unit) = variable.map_or(("", ""), |of| (of.name.as_str(), of.unit.text()));
    let unit = if matches!(unit, "" | "1") { String::new() } else { format!(" {unit}") };
    format!(
        "`{name}`: numbers of double precision, with 16 digits, leave {}{unit} of `{input}` undetermined, \
         {} % of its standard uncertainty: it is {}{unit} with a standard uncertainty of {}{unit}; make it \
         the difference from a reference value",
        significant(HALF_SPACING * line.estimate.abs(), 2),
        significant(100.0 * share, 2),
        Shortest(line.estimate),
        significant(line.standard_uncertainty, 2)
    )
}

/// Refuses trials that would show the spacing of numbers and not the uncertainty of an output.
pub(super) fn check(task: &Task, row: usize, gums: &[Option<Gum>]) -> Result<(), EvaluationError> {
    for (output, gum) in gums.iter().enumerate() {
        let found = gum.as_ref().and_then(coarsest).filter(|(_, share)| *share > TOO_MUCH);
        if let Some((line, share)) = found {
            let message = format!(
                "{}. `trials` of 0 evaluates it by the law of propagation alone, which has the slopes \
                 and not the digits",
                text(task, output, (&line, share))
            );
            return Err(EvaluationError::Rounding { row, output, message });
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
    let name = task.model.outputs.get(output).map_or("", |of| &*of.quantity.name);
    let mut notes = Vec::new();
    if let Some((line, share)) = evaluated.gum.as_ref().and_then(coarsest) {
        let text = text(task, output, (&line, share));
        notes.push(Warning::new("double-precision", name, text));
    }
    let mut values: Vec<f64> = row.distributions.iter().map(|d| d.mean()).collect();
    values.extend(&row.conditions);
    if task.function.is_none() && task.model.program.underflows(&values, output) {
        let text = format!(
            "`{name}`: a product, a quotient or a power in its equations is below the smallest number of \
             double precision, 2.2e-308, and counts as less than it is; choose units of the size of the \
             quantities"
        );
        notes.push(Warning::new("underflow", name, text));
    }
    notes
}
