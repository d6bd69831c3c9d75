//! What double precision leaves of a result.
//!
//! Numbers of double precision have a relative spacing of 2^-52. Trials of an input that is large beside
//! its standard uncertainty, such as a time stamp of 1.8e9 s known to 50 ns, take few different values:
//! their figures are those of a staircase, and the input's estimate may itself be off by half a step.

use super::evaluation_error::EvaluationError;
use super::gum::{BudgetLine, Gum};
use super::monte_carlo::MonteCarlo;
use crate::decimal::significant;
use crate::fact;
use crate::fact::Argument;
use crate::model::Output;
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

/// The input whose last digits count, as text.
struct CoarseInput<'t> {
    name: &'t str,
    /// Half of the spacing of numbers at its estimate, with its unit.
    undetermined: String,
    /// That in per cent of its standard uncertainty.
    share: String,
    estimate: String,
    standard_uncertainty: String,
}

impl<'t> CoarseInput<'t> {
    fn of(task: &'t Task, line: &BudgetLine, share: f64) -> Self {
        let variable = task.variables.get(line.variable);
        let in_unit = |number: String| match variable {
            Some(variable) => variable.unit.after(&number),
            None => number,
        };
        Self {
            name: variable.map_or("", |variable| variable.name.as_str()),
            undetermined: in_unit(significant(HALF_SPACING * line.estimate.abs(), 2)),
            share: significant(100.0 * share, 2),
            estimate: in_unit(Shortest(line.estimate).to_string()),
            standard_uncertainty: in_unit(significant(line.standard_uncertainty, 2)),
        }
    }
}

/// Refuses trials that would show the spacing of numbers and not the uncertainty of an output.
pub(super) fn check(task: &Task, row: usize, gums: &[Option<Gum>]) -> Result<(), EvaluationError> {
    for ((output, of), gum) in task.model.outputs.iter().enumerate().zip(gums) {
        let found = gum.as_ref().and_then(coarsest).filter(|(_, share)| *share > TOO_MUCH);
        if let Some((line, share)) = found {
            let CoarseInput { name, undetermined, share, estimate, standard_uncertainty } =
                CoarseInput::of(task, &line, share);
            let message = format!(
                "`{}`: numbers of double precision, with 16 digits, leave {undetermined} of `{name}` \
                 undetermined, {share} % of its standard uncertainty: it is {estimate} with a standard \
                 uncertainty of {standard_uncertainty}; make it the difference from a reference value. \
                 `trials` of 0 evaluates it by the law of propagation alone, which has the slopes and not \
                 the digits",
                of.quantity.name
            );
            return Err(EvaluationError::Rounding { row, output, message });
        }
    }
    Ok(())
}

/// How many times the rounding of the operations, at the estimates of the inputs, trials scatter at most
/// where they do not vary: elementary functions are off by more than half a spacing, and trials lie on
/// both sides of the estimates.
const ROUNDINGS: f64 = 4.0;

/// The outputs that do not vary: the law of propagation gives no uncertainty, and the trials scatter by no
/// more than the rounding of the operations between inputs and output.
pub(super) fn constant(
    task: &Task,
    row: &Row,
    gums: &[Option<Gum>],
    figures: &[Option<MonteCarlo>],
) -> Vec<bool> {
    let scatter = |(gum, figures): (&Option<Gum>, &Option<MonteCarlo>)| {
        let scatter = figures.as_ref()?.standard_uncertainty?;
        let u = gum.as_ref()?.standard_uncertainty;
        // what varies at all has an uncertainty of the size of its scatter by both methods
        (scatter > 0.0 && u < 0.5 * scatter).then_some(scatter)
    };
    let scatters: Vec<Option<f64>> = gums.iter().zip(figures).map(scatter).collect();
    if task.function.is_some() || scatters.iter().all(Option::is_none) {
        return vec![false; scatters.len()];
    }
    let rounding = task.model.program.rounding(&row.estimates());
    let is_rounding = |(scatter, rounding): (Option<f64>, f64)| {
        scatter.is_some_and(|scatter| scatter <= ROUNDINGS * rounding)
    };
    scatters.into_iter().zip(rounding).map(is_rounding).collect()
}

/// The note on an output whose last digits, or all, double precision does not hold.
pub(super) fn note(output: &Output, task: &Task, gum: &Gum) -> Option<Warning> {
    let (line, share) = coarsest(gum)?;
    let name = &output.quantity.name;
    let input = CoarseInput::of(task, &line, share);
    let fact = fact!(
        "double-precision",
        name,
        input = input.name,
        undetermined = Argument::Number(input.undetermined),
        share = Argument::Number(input.share),
        estimate = Argument::Number(input.estimate),
        uncertainty = Argument::Number(input.standard_uncertainty),
    );
    Some(Warning::new(name, fact))
}

/// The note on an output in whose equations a number vanishes.
pub(super) fn underflow(name: &str) -> Warning {
    Warning::new(name, fact!("underflow", name))
}
