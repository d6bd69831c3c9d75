//! The whole document.

use super::{Shown, figures, repeat, results, sweep};
use crate::document::{Block, Document};
use crate::sheet::Sheet;
use crate::statement;
use crate::table;
use crate::table::correlations;
use crate::{EvaluationReport, plain};
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::task::Task;

/// Outputs up to which a page needs no table of all of them above their sections.
const MOST_UNSUMMED: usize = 3;

/// The document of an evaluation: for one row of conditions everything about each output, for a
/// sweep a table and a figure for each. One for a `terminal` has no notes, which stand on standard
/// error beside it.
pub(super) fn of(report: &EvaluationReport<'_>, shown: &Shown<'_>, terminal: bool) -> Document {
    let EvaluationReport { task, evaluation, warnings, .. } = *report;
    let title = plain(&task.title);
    let mut document = Document {
        title: if title.is_empty() { "Measurement uncertainty".to_owned() } else { title },
        terminal,
        ..Document::default()
    };
    document.subtitle.push(table::settings_text(evaluation));
    document.subtitle.extend(table::at(task, evaluation));
    document.subtitle.extend(table::stopped(evaluation));
    statement::section(&mut document, statement::TITLE, task.into());
    if let [row] = evaluation.rows.as_slice() {
        if row.outputs.len() > MOST_UNSUMMED {
            document.section("Results");
            let digits = evaluation.settings.digits_on_pages();
            document.table(table::sweep::summary(task, row, digits));
            if let Some(said) = table::sweep::explained(row.outputs.iter(), digits) {
                document.text(said);
            }
        }
        for output in 0..row.outputs.len() {
            let folded = row.outputs.len() > MOST_UNSUMMED;
            results::section(&mut document, report, shown, (output, folded));
        }
    }
    together_of(&mut document, report, shown);
    if let Some(sheet) = quantities(task) {
        document.section("Quantities");
        document.table(sheet);
    }
    if let Some(drawing) = (!terminal).then(|| figures::inputs(task)).flatten() {
        document.section("What is known about the inputs");
        document.figure(Some(drawing));
    }
    if !warnings.is_empty() && !terminal {
        document.section("Notes");
        document.blocks.push(Block::List(crate::words::lines(warnings)));
    }
    repeat::section(&mut document, report, shown);
    document
}

/// What concerns all outputs of an evaluation.
pub(super) fn together_of(
    document: &mut Document,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
) {
    let EvaluationReport { task, evaluation, .. } = *report;
    match evaluation.rows.as_slice() {
        [row] => {
            together(document, task, row);
            crate::regions::sections(document, task, row);
        }
        _ => sweep::sections(document, report, shown),
    }
    let digits = evaluation.settings.digits_on_pages();
    let curves = task.curves.iter().map(|curve| &**curve);
    crate::fits::sections(document, curves, evaluation.settings.coverage, digits);
}

/// How the outputs vary together, and the trials that were left out.
fn together(document: &mut Document, task: &Task, row: &RowEvaluation) {
    match correlations::found(task, row) {
        Some(correlations::Coefficients::Matrix(sheet)) => {
            document.section("Correlation of the outputs");
            document.table(sheet);
        }
        Some(correlations::Coefficients::TooMany(said)) => {
            document.section("Correlation of the outputs");
            document.text(said);
        }
        None => {}
    }
    if let Some(said) = table::left_out(row) {
        document.sentence(&said);
    }
}

/// What the quantities are, in words.
fn quantities(task: &Task) -> Option<Sheet> {
    let entries = table::quantities(task);
    if entries.is_empty() {
        return None;
    }
    let mut sheet = Sheet::default();
    sheet.text("quantity", entries.iter().map(|(name, _)| plain(name)));
    sheet.text("what it is", entries.iter().map(|(_, about)| plain(about)));
    Some(sheet)
}
