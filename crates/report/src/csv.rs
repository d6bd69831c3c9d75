//! One line for each output and row of conditions, in full precision, for spreadsheets.

use std::io::{self, Write};

use super::EvaluationReport;
use super::answer::in_memory;
use super::table::{one_line, stopped};
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::{OutputEvaluation, RowEvaluation};
use gumption_engine::task::Task;

const COLUMNS: [&str; 19] = [
    "output",
    "unit",
    "gum_estimate",
    "gum_standard_uncertainty",
    "dof",
    "coverage_factor",
    "expanded_uncertainty",
    "gum_low",
    "gum_high",
    "mc_trials",
    "mc_estimate",
    "mc_standard_uncertainty",
    "mc_median",
    "mc_symmetric_low",
    "mc_symmetric_high",
    "mc_shortest_low",
    "mc_shortest_high",
    "gum_valid",
    "equation",
];

/// The last columns, where some output has a capability.
const CAPABILITY: [&str; 2] = ["cmc", "stated_expanded_uncertainty"];

/// The results as comma-separated values: a header, then one line for each output in each row of
/// conditions, where some output has a capability with it and the expanded uncertainty that is to be
/// stated. Numbers have full precision; an empty cell stands for what is infinite or not defined.
///
/// A text that a spreadsheet would take for a formula gets an apostrophe in front. A run that was
/// stopped says so in a comment at the end.
pub fn csv(report: &EvaluationReport<'_>) -> String {
    in_memory(|bytes| write_csv(report, bytes))
}

/// Writes what [`csv()`] gives, line by line.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(report: &EvaluationReport<'_>, mut out: impl Write) -> io::Result<()> {
    let EvaluationReport { task, evaluation, .. } = report;
    let mut writer = csv::Writer::from_writer(&mut out);
    let conditions = task.model.conditions.iter().filter(|_| task.swept);
    let names = conditions.map(|condition| heading(&condition.name));
    let outputs = evaluation.rows.iter().flat_map(|row| &row.outputs);
    let limited = outputs.into_iter().any(|figures| figures.capability.is_some());
    let last = CAPABILITY.map(str::to_owned).into_iter().filter(|_| limited);
    let header: Vec<String> = names.chain(COLUMNS.map(str::to_owned)).chain(last).collect();
    writer.write_record(&header)?;
    for row in &evaluation.rows {
        for record in records(task, row, limited) {
            writer.write_record(&record)?;
        }
    }
    writer.flush()?;
    drop(writer);
    match stopped(evaluation) {
        Some(said) => writeln!(out, "# {said}"),
        None => Ok(()),
    }
}

/// The heading of a condition, which is none of the other columns.
fn heading(condition: &str) -> String {
    let taken = COLUMNS.contains(&condition) || CAPABILITY.contains(&condition);
    if taken { format!("condition_{condition}") } else { text(condition) }
}

fn records<'a>(
    task: &'a Task,
    row: &'a RowEvaluation,
    limited: bool,
) -> impl Iterator<Item = Vec<String>> + 'a {
    let conditions: Vec<String> = (0..task.model.conditions.len())
        .filter(|_| task.swept)
        .map(|place| number(row.conditions.get(place).copied()))
        .collect();
    task.model.outputs.iter().zip(&row.outputs).map(move |(output, figures)| {
        let mut record = conditions.clone();
        record.push(text(&output.quantity.name));
        record.push(text(output.quantity.unit.text()));
        record.extend(cells(figures));
        record.push(equation(task, &output.quantity.name));
        if limited {
            let stated = figures.capability.as_deref();
            record.push(number(stated.map(|stated| stated.cmc)));
            record.push(number(stated.map(|stated| stated.expanded_uncertainty)));
        }
        record
    })
}

/// The equation of an output, if it has one.
fn equation(task: &Task, output: &str) -> String {
    let mut equations = task.statement.equations.iter();
    let own = equations.find(|(name, _)| name == output);
    own.map_or_else(String::new, |(_, equation)| text(equation))
}

fn cells(output: &OutputEvaluation) -> [String; 16] {
    let gum = output.gum.as_ref();
    let figures = output.monte_carlo.as_deref();
    let interval = gum.and_then(|gum| gum.interval());
    let dof = gum.and_then(|gum| match gum.dof {
        Dof::Finite(dof) => Some(dof),
        Dof::Infinite | Dof::Undefined => None,
    });
    let valid = output.validation.and_then(|validation| validation.gum_valid);
    [
        number(gum.map(|gum| gum.estimate)),
        number(gum.map(|gum| gum.standard_uncertainty)),
        number(dof),
        number(gum.and_then(|gum| gum.coverage_factor)),
        number(gum.and_then(|gum| gum.expanded_uncertainty())),
        number(interval.map(|[low, _]| low)),
        number(interval.map(|[_, high]| high)),
        figures.map(|figures| figures.trials.to_string()).unwrap_or_default(),
        number(figures.and_then(|figures| figures.estimate)),
        number(figures.and_then(|figures| figures.standard_uncertainty)),
        number(figures.map(|figures| figures.median)),
        number(figures.map(|figures| figures.symmetric_interval[0])),
        number(figures.map(|figures| figures.symmetric_interval[1])),
        number(figures.map(|figures| figures.shortest_interval[0])),
        number(figures.map(|figures| figures.shortest_interval[1])),
        valid.map(|valid| valid.to_string()).unwrap_or_default(),
    ]
}

/// The records that `write` writes, as text (RFC 4180).
pub fn of_records(write: impl FnOnce(&mut csv::Writer<&mut Vec<u8>>) -> csv::Result<()>) -> String {
    in_memory(|bytes| {
        let mut writer = csv::Writer::from_writer(bytes);
        write(&mut writer)?;
        csv::Result::Ok(writer.flush()?)
    })
}

/// Shortest text that reads back as the same number.
pub(super) fn number(value: Option<f64>) -> String {
    match value {
        Some(value) if value.is_finite() => {
            let text = format!("{value:?}");
            text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
        }
        _ => String::new(),
    }
}

/// A user's text as a cell: on one line of printable characters, and no formula.
pub(crate) fn text(text: &str) -> String {
    let text = one_line(text);
    let formula = text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']);
    if formula { format!("'{text}") } else { text }
}
