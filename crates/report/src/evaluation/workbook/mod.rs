//! An evaluation as a workbook: the GUM budget in live formulas, so that an auditor can change what
//! is known about an input and see y, u and U follow, and the Monte Carlo figures as they are.

mod budget;
mod distribution;
mod inputs;
mod model;
mod results;
mod tape;

use std::io;

use rust_xlsxwriter::XlsxError;

use self::inputs::Places;
use self::tape::Tape;
use super::{Shown, repeat};
use crate::document::{Block, Document};
use crate::table::correlations;
use crate::table::correlations::Coefficients;
use crate::workbook::{Book, Leaf, Look, failed};
use crate::{EvaluationReport, fits, plain, regions, statement, table};
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::task::Task;

/// Lines of all budgets together, at most; of longer ones only the results are written.
const MOST_LINES: usize = 50_000;

/// Cells of all models together, at most; of larger ones the sensitivity coefficients are numbers.
const MOST_CELLS: usize = 100_000;

/// Results of a workbook, at most: one for each output in each row of conditions. Workbooks are made
/// in memory, and so many take half a gigabyte.
pub const MOST_RESULTS: usize = 100_000;

/// The evaluation as the bytes of an XLSX file.
///
/// # Errors
/// More results than [`MOST_RESULTS`].
pub fn xlsx(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> io::Result<Vec<u8>> {
    write(report, shown).map_err(failed)
}

fn write(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> Result<Vec<u8>, XlsxError> {
    let task = report.task;
    let mut book = Book::new(&plain(&task.title))?;
    let mut results = book.leaf("Results")?;
    let measurement = measurement(&mut book, task)?;
    if lines(report) > MOST_LINES {
        results::write(&mut results, report, (&Places::default(), &[]))?;
        book.push(results)?;
        measurement.into_iter().try_for_each(|leaf| book.push(leaf))?;
        return about(book, report, shown);
    }
    // formulas of the results refer to the budgets behind them
    let mut inputs = book.leaf("Inputs")?;
    let places = inputs::write(&mut inputs, report)?;
    let tapes = tapes(report);
    let mut sensitivities = Vec::new();
    let mut steps = None;
    if let Some(tapes) = &tapes {
        let mut leaf = book.leaf("Model")?;
        sensitivities = model::write(&mut leaf, report, tapes, &places)?;
        steps = Some(leaf);
    }
    let mut budgets = Vec::new();
    let mut totals = Vec::new();
    for (output, declared) in task.model.outputs.iter().enumerate() {
        let mut leaf = book.leaf(&format!("Budget {}", plain(&declared.quantity.name)))?;
        let live = budget::Live { inputs: &places, model: &sensitivities };
        totals.push(budget::write(&mut leaf, report, output, &live)?);
        budgets.push(leaf);
    }
    results::write(&mut results, report, (&places, &totals))?;
    for leaf in [results, inputs].into_iter().chain(budgets) {
        book.push(leaf)?;
    }
    if let [row] = report.evaluation.rows.as_slice()
        && let Some(Coefficients::Matrix(sheet)) = correlations::found(task, row)
    {
        let mut leaf = book.leaf("Correlations")?;
        leaf.title(0, "Correlation of the outputs")?;
        places.marked(&mut leaf, (1, 0), "Of the inputs as evaluated")?;
        leaf.table(2, &sheet)?;
        book.push(leaf)?;
    }
    let mut leaf = book.leaf("Distributions")?;
    if distribution::write(&mut leaf, report, shown, &places)? {
        book.push(leaf)?;
    }
    let settings = &report.evaluation.settings;
    let mut functions = Document::default();
    let curves = task.curves.iter().map(|curve| &**curve);
    fits::sections(&mut functions, curves, settings.coverage, settings.digits_on_pages());
    worksheet(&mut book, "Calibration functions", &functions, None)?;
    if let [row] = report.evaluation.rows.as_slice() {
        let mut found = Document::default();
        regions::sections(&mut found, task, row);
        worksheet(&mut book, "Regions", &found, Some(&places))?;
    }
    for leaf in measurement.into_iter().chain(steps) {
        book.push(leaf)?;
    }
    about(book, report, shown)
}

/// A worksheet of sections, without their figures; none where there is nothing. Figures of inputs that
/// may be changed are marked.
fn worksheet(
    book: &mut Book,
    name: &str,
    document: &Document,
    inputs: Option<&Places>,
) -> Result<(), XlsxError> {
    if document.blocks.is_empty() {
        return Ok(());
    }
    let mut leaf = book.leaf(name)?;
    let mut row = 0;
    if let Some(inputs) = inputs {
        inputs.marked(&mut leaf, (row, 0), "Of the inputs as evaluated")?;
        row += 1;
    }
    for block in &document.blocks {
        match block {
            Block::Section(title) => {
                row += u32::from(row > 0);
                leaf.title(row, title)?;
                row += 1;
            }
            Block::Text(text) => {
                leaf.line(row, text)?;
                row += 1;
            }
            Block::Verdict(texts) | Block::List(texts) => {
                for text in texts {
                    leaf.line(row, text)?;
                    row += 1;
                }
            }
            Block::Table(sheet) => row = leaf.table(row + 1, sheet)? + 1,
            // what is folded on a page stands on other worksheets, and an evaluation has one language
            Block::Figure(_)
            | Block::Characters(_)
            | Block::InLanguage(..)
            | Block::Folded(..)
            | Block::Listing { .. }
            | Block::Signature(_)
            | Block::End(_) => {}
        }
    }
    book.push(leaf)
}

/// The worksheet that states the measurement: sources and equations.
fn measurement(book: &mut Book, task: &Task) -> Result<Option<Leaf>, XlsxError> {
    let sources = statement::sources(task.into());
    let equations = statement::sheet(task.into());
    if sources.is_empty() && equations.is_none() {
        return Ok(None);
    }
    let mut leaf = book.leaf("Measurement")?;
    leaf.title(0, "Measurement model")?;
    let mut at = 1;
    for said in sources {
        leaf.line(at, &said)?;
        at += 1;
    }
    if let Some(sheet) = equations {
        at = leaf.table(at + 1, &sheet)?;
    }
    if let Some(said) = statement::left_out(task.into()) {
        leaf.line(at, &said)?;
    }
    Ok(Some(leaf))
}

/// The lines of all budgets.
fn lines(report: &EvaluationReport<'_>) -> usize {
    let of_row = |row: &RowEvaluation| -> usize {
        let gums = row.outputs.iter().filter_map(|output| output.gum.as_ref());
        gums.map(|gum| gum.budget().count() + gum.correlations().count() + 12).sum()
    };
    let rows = &report.evaluation.rows;
    let inputs = rows.len() * (report.task.variables.len() + 6);
    rows.iter().map(of_row).sum::<usize>() + inputs
}

/// The models of all rows; `None` where a spreadsheet could not follow them.
fn tapes(report: &EvaluationReport<'_>) -> Option<Vec<Tape>> {
    let program = &report.task.model.program;
    let each = program.nodes.len().saturating_mul(4 + program.outputs.len());
    if each.saturating_mul(report.task.rows.len()) > MOST_CELLS {
        return None;
    }
    let mut all = Vec::new();
    for row in &report.task.rows {
        let values = row.estimates();
        all.push(Tape::of(program, &values)?);
    }
    Some(all)
}

/// Numbers whose digits a spreadsheet keeps, 15 of them.
const MOST_KEPT: f64 = 1e15;

/// What is needed to get the same answer again.
fn about(
    mut book: Book,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
) -> Result<Vec<u8>, XlsxError> {
    let mut leaf = book.leaf("About")?;
    leaf.title(0, "Reproducing this result")?;
    let mut row = 2;
    for (name, value) in repeat::lines(report, shown) {
        leaf.text(row, 0, &name)?;
        // a seed may have more digits than a spreadsheet keeps
        match value.parse::<f64>().ok().filter(|value| value.abs() < MOST_KEPT) {
            Some(value) => leaf.number((row, 1), value, None, Look::Plain)?,
            None => leaf.text(row, 1, &value)?,
        }
        row += 1;
    }
    if !report.warnings.is_empty() {
        leaf.title(row + 1, "Notes")?;
        row += 2;
        for said in crate::words::lines(report.warnings) {
            leaf.line(row, &said)?;
            row += 1;
        }
    }
    let quantities = table::quantities(report.task);
    if !quantities.is_empty() {
        leaf.title(row + 1, "Quantities")?;
        row += 2;
        for (name, about) in quantities {
            leaf.text(row, 0, &plain(name))?;
            leaf.text(row, 1, &plain(about))?;
            row += 1;
        }
    }
    if !shown.model.trim().is_empty() {
        leaf.title(row + 1, "The model file")?;
        row += 2;
        for line in shown.model.lines() {
            leaf.code(row, line)?;
            row += 1;
        }
    }
    book.push(leaf)?;
    book.bytes()
}
