//! The page for a terminal.

mod budget;
mod columns;
mod comparison;
mod correlations;
mod grid;
mod sweep;
mod text;

pub use columns::Column;
pub(crate) use grid::Grid;
pub(crate) use text::{grouped, plain, wrapped};

use std::io::{self, Write};

use self::budget::Budget;
use super::Report;
use crate::model::{InputQuantity, Output, Quantity};
use crate::propagate::{Evaluation, OutputEvaluation, RowEvaluation};
use crate::task::{Coverage, Settings, Task, Trials};
use crate::unit::Unit;

/// Characters in a line, at most.
pub(crate) const WIDTH: usize = 100;

/// How the page looks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Style {
    /// Significant digits of standard uncertainties, those of the settings unless given; estimates
    /// are rounded to match.
    pub digits: Option<u32>,
    /// Columns of the budget beside the usual ones. Each has its own place, whatever the order here.
    pub columns: Vec<Column>,
}

/// The results as a page of at most 100 columns: for each output the budget, the two methods side
/// by side and what their comparison says. A sweep over conditions gives one table for each
/// output with a line for each row of conditions.
///
/// Warnings are not part of the page; a run that was stopped is marked at its end.
pub fn table(report: &Report<'_>, style: &Style) -> String {
    let mut bytes = Vec::new();
    let written = write_table(report, style, &mut bytes);
    debug_assert!(written.is_ok(), "{written:?}");
    String::from_utf8(bytes).unwrap_or_default()
}

/// Writes what [`table`] gives, part by part.
///
/// # Errors
/// Those of the writer.
pub fn write_table(report: &Report<'_>, style: &Style, mut out: impl Write) -> io::Result<()> {
    let Report { task, evaluation, .. } = *report;
    let digits = style.digits.unwrap_or(evaluation.settings.digits);
    out.write_all(heading(task, evaluation).as_bytes())?;
    let mut below = |part: String| {
        out.write_all(b"\n")?;
        out.write_all(part.as_bytes())
    };
    legend(task).into_iter().try_for_each(&mut below)?;
    match evaluation.rows.as_slice() {
        [row] => {
            for (output, figures) in task.model.outputs.iter().zip(&row.outputs) {
                below(section(task, evaluation, output, figures, digits, &style.columns))?;
            }
            let whole = correlations::table(task, row).into_iter().chain(left_out(row));
            whole.into_iter().try_for_each(&mut below)?;
        }
        rows => sweep::tables(task, rows, digits).try_for_each(&mut below)?,
    }
    if evaluation.stopped {
        let trials = trials_made(evaluation);
        below(format!("stopped after {} trials\n", grouped(trials)))?;
    }
    Ok(())
}

/// Title, coverage, trials; the conditions where there is one row of them.
fn heading(task: &Task, evaluation: &Evaluation) -> String {
    let Settings { coverage, trials, seed, .. } = evaluation.settings;
    let mut line = format!("coverage probability {}", coverage_text(coverage));
    let each = if evaluation.rows.len() > 1 { " for each row" } else { "" };
    match trials {
        Trials::Fixed(0) => {}
        Trials::Fixed(count) => {
            line += &format!("; {} Monte Carlo trials{each}, seed {seed}", grouped(count));
        }
        Trials::Adaptive => {
            line += &format!("; as many Monte Carlo trials{each} as are needed, seed {seed}");
        }
    }
    let mut heading = wrapped(&plain(&task.title)) + &wrapped(&line);
    if let [row] = evaluation.rows.as_slice()
        && task.swept
    {
        let at = conditions_text(&task.model.conditions, &row.conditions);
        heading += &wrapped(&format!("at {at}"));
    }
    heading
}

/// What the quantities are, in words: inputs, their components where those say more, conditions.
fn legend(task: &Task) -> Option<String> {
    let mut variables = task.variables.iter();
    let mut entries: Vec<(&str, &str)> = Vec::new();
    for InputQuantity { quantity, parts } in &task.model.inputs {
        if *parts != 1 {
            entries.push((&quantity.name, &quantity.about));
        }
        let parts = variables.by_ref().take(*parts);
        let own = parts.filter(|part| part.name == quantity.name || part.about != quantity.about);
        entries.extend(own.map(|part| (part.name.as_str(), part.about.as_str())));
    }
    let conditions = task.model.conditions.iter();
    entries.extend(conditions.map(|condition| (condition.name.as_str(), condition.about.as_str())));
    entries.retain(|(_, about)| !about.trim().is_empty());
    (!entries.is_empty()).then(|| text::definitions(&entries))
}

/// Everything about one output.
fn section(
    task: &Task,
    evaluation: &Evaluation,
    output: &Output,
    figures: &OutputEvaluation,
    digits: u32,
    columns: &[Column],
) -> String {
    let mut parts = vec![title(&output.quantity)];
    match &figures.gum {
        Some(gum) => {
            let budget = Budget { task, output: &output.quantity, gum, digits };
            parts.push(budget.table(&evaluation.settings, columns));
        }
        None => parts.push(wrapped(
            "There is no budget: the estimate or a sensitivity coefficient is not finite here.",
        )),
    }
    parts.extend(comparison::table(&output.quantity, figures, digits));
    parts.extend(comparison::capability(output, figures));
    parts.join("\n")
}

/// Name, unit and words of an output, underlined.
fn title(quantity: &Quantity) -> String {
    let mut line = plain(&quantity.name);
    if has_name(&quantity.unit) {
        line += &format!(" in {}", plain(quantity.unit.text()));
    }
    if !quantity.about.trim().is_empty() {
        line += &format!(": {}", plain(&quantity.about));
    }
    let line = wrapped(&line);
    let width = line.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    format!("{line}{}\n", "═".repeat(width.min(WIDTH)))
}

/// Trials that were left out because an output was not finite.
fn left_out(row: &RowEvaluation) -> Option<String> {
    let undefined = row.undefined.as_ref()?;
    let [count, trials] = [undefined.count, undefined.trials].map(grouped);
    Some(format!("{count} of {trials} trials have no finite result and are left out\n"))
}

/// The trials behind the figures, of all rows together.
fn trials_made(evaluation: &Evaluation) -> u64 {
    let outputs = evaluation.rows.iter().filter_map(|row| row.outputs.first());
    outputs.filter_map(|output| output.monte_carlo.as_ref()).map(|figures| figures.trials).sum()
}

fn coverage_text(coverage: Coverage) -> String {
    match coverage {
        Coverage::Factor { factor: 2.0, .. } => "approximately 95 %".to_owned(),
        _ => {
            // 99.73 % for K = 3, but 95 % for 0.95
            let percent = 100.0 * coverage.probability();
            let digits: f64 = format!("{percent:.4}").parse().unwrap_or(percent);
            format!("{digits} %")
        }
    }
}

/// `f = 10 Hz, tilt = 35 deg`.
pub(crate) fn conditions_text(conditions: &[Quantity], values: &[f64]) -> String {
    let parts: Vec<String> = conditions
        .iter()
        .zip(values)
        .map(|(condition, &value)| {
            let value = in_unit(&super::number::exact(value), &condition.unit);
            format!("{} = {value}", plain(&condition.name))
        })
        .collect();
    parts.join(", ")
}

/// A number with its unit, if that has a name.
fn in_unit(number: &str, unit: &Unit) -> String {
    if has_name(unit) { format!("{number} {}", plain(unit.text())) } else { number.to_owned() }
}

fn has_name(unit: &Unit) -> bool {
    !matches!(unit.text().trim(), "" | "1")
}
