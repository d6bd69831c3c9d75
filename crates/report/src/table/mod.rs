//! The page for a terminal.

pub(super) mod budget;
mod columns;
pub(super) mod comparison;
pub(super) mod correlations;
mod grid;
pub(super) mod sweep;
mod text;
mod width;

use crate::words::Language;
pub use columns::BudgetColumn;
pub use grid::Grid;
pub use text::{grouped, plain, wrapped};
pub(crate) use text::{one_line, printable};
use width::USUAL;
pub use width::within_width;
pub(crate) use width::{text_width, width};

use std::io::{self, Write};

use self::budget::Budget;
use super::EvaluationReport;
use super::answer::in_memory;
use super::document::{self, Document};
use super::number::exact;
use super::statement;
use gumption_engine::decimal::to_position;
use gumption_engine::model::{InputQuantity, Output, Quantity};
use gumption_engine::propagate::{Evaluation, OutputEvaluation, RowEvaluation};
use gumption_engine::task::{Coverage, Settings, Task, Trials, Variable};
use gumption_units::Unit;

/// How the page looks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TableStyle {
    /// Significant digits of standard uncertainties, those of the settings unless given; estimates
    /// are rounded to match.
    pub digits: Option<u32>,
    /// Columns of the budget beside the usual ones. Each has its own place, whatever the order here.
    pub columns: Vec<BudgetColumn>,
}

/// The results as a page of at most 100 columns: for each output the budget, the two methods side
/// by side and what their comparison says. A sweep over conditions gives one table for each
/// output with a line for each row of conditions.
///
/// Warnings are not part of the page; a run that was stopped is marked at its end.
pub fn table(report: &EvaluationReport<'_>, style: &TableStyle) -> String {
    in_memory(|bytes| write_table(report, style, bytes))
}

/// Writes what [`table`] gives, part by part.
///
/// # Errors
/// Those of the writer.
pub fn write_table(
    report: &EvaluationReport<'_>,
    style: &TableStyle,
    mut out: impl Write,
) -> io::Result<()> {
    let EvaluationReport { task, evaluation, .. } = *report;
    let digits = style.digits.unwrap_or(evaluation.settings.digits);
    out.write_all(heading(task, evaluation).as_bytes())?;
    let mut below = |part: String| {
        out.write_all(b"\n")?;
        out.write_all(part.as_bytes())
    };
    equations(task).into_iter().chain(legend(task)).try_for_each(&mut below)?;
    match evaluation.rows.as_slice() {
        [row] => {
            for (output, figures) in task.model.outputs.iter().zip(&row.outputs) {
                below(section(report, output, figures, digits, &style.columns))?;
            }
            let whole = correlations::table(task, row)
                .into_iter()
                .chain(left_out(row).map(|said| said + "\n"));
            whole.into_iter().try_for_each(&mut below)?;
            let mut regions = Document::default();
            crate::regions::sections(&mut regions, task, row);
            if !regions.blocks.is_empty() {
                below(document::below(&regions))?;
            }
        }
        rows => sweep::tables(task, rows, digits).try_for_each(&mut below)?,
    }
    let mut fits = Document::default();
    let curves = task.curves.iter().map(|curve| &**curve);
    crate::fits::sections(&mut fits, curves, evaluation.settings.coverage, digits);
    if !fits.blocks.is_empty() {
        below(document::below(&fits))?;
    }
    if let Some(said) = stopped(evaluation) {
        below(said + "\n")?;
    }
    Ok(())
}

/// Title, coverage, trials; the conditions where there is one row of them.
fn heading(task: &Task, evaluation: &Evaluation) -> String {
    let mut heading = wrapped(&plain(&task.title)) + &wrapped(&settings_text(evaluation));
    heading += &at(task, evaluation).map(|at| wrapped(&at)).unwrap_or_default();
    heading
}

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

/// The sources and the equations.
fn equations(task: &Task) -> Option<String> {
    let page: String = statement::lines(task.into()).iter().map(|line| wrapped(line)).collect();
    (!page.is_empty()).then_some(page)
}

/// What the quantities are, in words: inputs, their components where those say more, conditions.
fn legend(task: &Task) -> Option<String> {
    let entries = quantities(task);
    (!entries.is_empty()).then(|| text::definitions(&entries))
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

/// Everything about one output.
fn section(
    report: &EvaluationReport<'_>,
    output: &Output,
    figures: &OutputEvaluation,
    digits: u32,
    columns: &[BudgetColumn],
) -> String {
    let EvaluationReport { task, evaluation, .. } = *report;
    let mut parts = vec![title(&output.quantity)];
    match &figures.gum {
        Some(gum) => {
            let budget = Budget { task, output: &output.quantity, gum, digits };
            parts.push(budget.table(&evaluation.settings, columns));
        }
        None => parts.push(wrapped(NO_BUDGET)),
    }
    parts.extend(comparison::table(&output.quantity, figures, &evaluation.settings));
    let said = comparison::differences(report, output, figures, Language::English);
    parts.extend(said.iter().map(|said| wrapped(said)));
    parts.extend(comparison::capability(output, figures, digits).map(|said| wrapped(&said)));
    parts.join("\n")
}

/// Name, unit and words of an output, underlined.
fn title(quantity: &Quantity) -> String {
    let line = wrapped(&title_text(quantity));
    let longest = line.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    format!("{line}{}\n", "═".repeat(longest.min(width())))
}

/// Name, unit and words of an output.
pub(super) fn title_text(quantity: &Quantity) -> String {
    let mut line = plain(&quantity.name);
    if quantity.unit.has_name() {
        line += &format!(" in {}", plain(quantity.unit.text()));
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
    outputs.filter_map(|output| output.monte_carlo.as_ref()).map(|figures| figures.trials).sum()
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

/// A number with its unit, if that has a name.
pub(crate) fn in_unit(number: &str, unit: &Unit) -> String {
    plain(&unit.after(number))
}
