//! Tables of figures, and running text, within the width of a terminal.

pub(super) mod budget;
mod columns;
pub(super) mod comparison;
pub(super) mod correlations;
mod grid;
pub(super) mod rows;
pub(super) mod shares;
pub(super) mod sweep;
mod text;
mod width;

pub use columns::BudgetColumn;
pub use grid::Grid;
pub(crate) use text::{one_line, printable};
pub use text::{plain, wrapped};
pub(crate) use width::USUAL;
pub use width::{Screen, within_screen, within_width};
pub(crate) use width::{shows_print, text_width, width};

use super::number::exact;
use super::printed::{self, grouped};
use gumption_engine::decimal::to_position;
use gumption_engine::model::{InputQuantity, Quantity};
use gumption_engine::propagate::{Evaluation, RowEvaluation};
use gumption_engine::task::{Coverage, Settings, Task, Trials, Variable};
use gumption_units::Unit;

/// Coverage and trials: those that were asked for, and of a run that was stopped those that were made.
pub(super) fn settings_text(evaluation: &Evaluation) -> String {
    let Settings { coverage, trials, seed, .. } = evaluation.settings;
    let mut line = format!("coverage probability {}", coverage_text(coverage));
    let (each, together) = match evaluation.rows.len() {
        0 | 1 => ("", ""),
        _ => (" for each row", " in all rows together"),
    };
    let asked = match trials {
        Trials::Fixed(0) => return line,
        Trials::Fixed(count) => grouped(count),
        Trials::Adaptive => "as many".to_owned(),
    };
    let needed = if trials == Trials::Adaptive { " as are needed" } else { "" };
    line += &match evaluation.stopped {
        false => format!("; {asked} Monte Carlo trials{each}{needed}, seed {seed}"),
        true => format!(
            "; {} Monte Carlo trials{together}, seed {seed}, as it was stopped; {asked}{needed} were asked \
             for{each}",
            grouped(trials_made(evaluation))
        ),
    };
    line
}

/// The conditions where there is one row of them.
pub(super) fn at(task: &Task, evaluation: &Evaluation) -> Option<String> {
    let [row] = evaluation.rows.as_slice() else { return None };
    task.swept.then(|| format!("at {}", conditions_text(&task.model.conditions, &row.conditions)))
}

/// Names of inputs, components and conditions with what they are, where that is said.
pub(super) fn quantities(task: &Task) -> Vec<(&str, &str)> {
    let mut variables = task.variables.iter();
    let mut entries: Vec<(&str, &str)> = Vec::new();
    for InputQuantity { quantity, parts } in &task.model.inputs {
        if *parts != 1 {
            entries.push((&quantity.name, &quantity.about));
        }
        let parts = variables.by_ref().take(*parts);
        let says_more =
            |part: &&Variable| part.name == quantity.name || part.about != quantity.about;
        let own = parts.filter(|part| part.shown).filter(says_more);
        entries.extend(own.map(|part| (part.name.as_str(), part.about.as_str())));
    }
    let conditions = task.model.conditions.iter();
    entries.extend(conditions.map(|condition| (condition.name.as_str(), condition.about.as_str())));
    entries.retain(|(_, about)| !about.trim().is_empty());
    entries
}

/// What is said where there is none.
pub(super) const NO_BUDGET: &str =
    "There is no budget: the estimate or a sensitivity coefficient is not finite here.";

/// Name, unit and words of an output.
pub(super) fn title_text(quantity: &Quantity) -> String {
    let mut line = plain(&quantity.name);
    if quantity.unit.has_name() {
        line += &format!(" in {}", unit_text(&quantity.unit));
    }
    if !quantity.about.trim().is_empty() {
        line += &format!(": {}", plain(&quantity.about));
    }
    line
}

/// Trials that were left out because an output was not finite.
pub(super) fn left_out(row: &RowEvaluation) -> Option<String> {
    let undefined = row.undefined.as_ref()?;
    let [count, trials] = [undefined.count, undefined.trials].map(grouped);
    Some(format!("{count} of {trials} trials have no finite result and are left out"))
}

/// Whether the run was stopped, and when.
pub(crate) fn stopped(evaluation: &Evaluation) -> Option<String> {
    let trials = grouped(trials_made(evaluation));
    evaluation.stopped.then(|| format!("stopped after {trials} trials"))
}

/// The trials behind the figures, of all rows together.
fn trials_made(evaluation: &Evaluation) -> u64 {
    let outputs = evaluation.rows.iter().filter_map(|row| row.outputs.first());
    outputs.filter_map(|output| output.monte_carlo.as_deref()).map(|figures| figures.trials).sum()
}

pub(super) fn coverage_text(coverage: Coverage) -> String {
    match coverage {
        Coverage::Usual | Coverage::Factor { factor: 2.0, .. } => "approximately 95 %".to_owned(),
        _ => {
            // 99.73 % for K = 3, but 95 % for 0.95
            format!("{} %", exact(to_position(100.0 * coverage.probability(), -4)))
        }
    }
}

/// Rows that are named, at most.
const MOST_NAMED: usize = 20;

/// The numbers of rows, from 1, of which these are the places.
pub(crate) fn row_numbers(places: &[usize]) -> String {
    let named: Vec<String> =
        places.iter().take(MOST_NAMED).map(|place| (place + 1).to_string()).collect();
    named.join(", ") + if places.len() > MOST_NAMED { ", ..." } else { "" }
}

/// `f = 10 Hz, tilt = 35 deg`.
pub(crate) fn conditions_text(conditions: &[Quantity], values: &[f64]) -> String {
    let parts: Vec<String> = conditions
        .iter()
        .zip(values)
        .map(|(condition, &value)| {
            let value = in_unit(&exact(value), &condition.unit);
            format!("{} = {value}", plain(&condition.name))
        })
        .collect();
    parts.join(", ")
}

/// A number with its unit, if the unit has a name, in the notation of the page.
pub(crate) fn in_unit(number: &str, unit: &Unit) -> String {
    plain(&printed::with_unit(number, unit))
}

/// The text of a unit in the notation of the page.
pub(crate) fn unit_text(unit: &Unit) -> String {
    plain(&printed::unit(unit))
}
