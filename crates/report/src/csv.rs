//! One line for each output and row of conditions, in full precision, for spreadsheets.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::EvaluationReport;
use super::answer::in_memory;
use super::table::{one_line, stopped};
use gumption_engine::model::{Output, Quantity};
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::Dof;
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
    let outputs = &task.model.outputs;
    let texts: Vec<OutputTexts> =
        outputs.iter().map(|output| OutputTexts::of(task, output)).collect();
    let mut cells = Cells { writer: &mut writer, text: String::new() };
    for row in &evaluation.rows {
        for (texts, figures) in texts.iter().zip(&row.outputs) {
            if task.swept {
                for place in 0..task.model.conditions.len() {
                    cells.number(row.conditions.get(place).copied())?;
                }
            }
            cells.texts([&texts.name, &texts.unit])?;
            cells.figures(figures)?;
            cells.texts([&texts.equation])?;
            if limited {
                let stated = figures.capability.as_deref();
                cells.number(stated.map(|stated| stated.cmc))?;
                cells.number(stated.map(|stated| stated.expanded_uncertainty))?;
            }
            cells.end()?;
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

/// What an output has in each of its lines.
struct OutputTexts {
    name: String,
    unit: String,
    equation: String,
}

impl OutputTexts {
    fn of(task: &Task, output: &Output) -> Self {
        let Quantity { name, unit, .. } = &output.quantity;
        Self { name: text(name), unit: text(unit.text()), equation: equation(task, name) }
    }
}

/// The equation of an output, if it has one.
fn equation(task: &Task, output: &str) -> String {
    let mut equations = task.statement.equations.iter();
    let own = equations.find(|(name, _)| name == output);
    own.map_or_else(String::new, |(_, equation)| text(equation))
}

/// The cells of a line, written one after the other.
struct Cells<'w, W: Write> {
    writer: &'w mut csv::Writer<W>,
    /// The text of a number, kept for the next one.
    text: String,
}

impl<W: Write> Cells<'_, W> {
    fn texts<const N: usize>(&mut self, texts: [&str; N]) -> csv::Result<()> {
        texts.into_iter().try_for_each(|text| self.writer.write_field(text))
    }

    fn number(&mut self, value: Option<f64>) -> csv::Result<()> {
        self.text.clear();
        append_number(&mut self.text, value);
        self.writer.write_field(&self.text)
    }

    fn figures(&mut self, output: &OutputEvaluation) -> csv::Result<()> {
        let gum = output.gum.as_ref();
        let figures = output.monte_carlo.as_deref();
        let interval = gum.and_then(|gum| gum.interval());
        let dof = gum.and_then(|gum| match gum.dof {
            Dof::Finite(dof) => Some(dof),
            Dof::Infinite | Dof::Undefined => None,
        });
        for value in [
            gum.map(|gum| gum.estimate),
            gum.map(|gum| gum.standard_uncertainty),
            dof,
            gum.and_then(|gum| gum.coverage_factor),
            gum.and_then(|gum| gum.expanded_uncertainty()),
            interval.map(|[low, _]| low),
            interval.map(|[_, high]| high),
        ] {
            self.number(value)?;
        }
        self.texts([&figures.map(|figures| figures.trials.to_string()).unwrap_or_default()])?;
        for value in [
            figures.and_then(|figures| figures.estimate),
            figures.and_then(|figures| figures.standard_uncertainty),
            figures.map(|figures| figures.median),
            figures.map(|figures| figures.symmetric_interval[0]),
            figures.map(|figures| figures.symmetric_interval[1]),
            figures.map(|figures| figures.shortest_interval[0]),
            figures.map(|figures| figures.shortest_interval[1]),
        ] {
            self.number(value)?;
        }
        self.texts([match output.validation.and_then(|validation| validation.gum_valid) {
            Some(true) => "true",
            Some(false) => "false",
            None => "",
        }])
    }

    /// Ends the line.
    fn end(&mut self) -> csv::Result<()> {
        self.writer.write_record(None::<&[u8]>)
    }
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
    let mut text = String::new();
    append_number(&mut text, value);
    text
}

/// Appends that text; nothing where there is no number.
fn append_number(text: &mut String, value: Option<f64>) {
    let Some(value) = value.filter(|value| value.is_finite()) else { return };
    // a String takes whatever is written
    let _ = write!(text, "{value:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
}

/// A user's text as a cell: on one line of printable characters, and no formula.
pub(crate) fn text(text: &str) -> String {
    let text = one_line(text);
    let formula = text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']);
    if formula { format!("'{text}") } else { text }
}
