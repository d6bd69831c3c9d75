//! The whole document.

use super::{Extent, Shown, brief, figures, repeat, results, sweep};
use crate::document::{Block, Document, sentence};
use crate::sheet::Sheet;
use crate::statement;
use crate::table;
use crate::table::comparison;
use crate::table::correlations;
use crate::{EvaluationReport, plain};
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::task::{Task, Warning};

/// Outputs up to which their sections are not folded.
const MOST_UNFOLDED: usize = 3;

/// How a usual text page becomes a full one.
const MORE: &str = "Everything: --full.";

/// The document of an evaluation: for one row of conditions everything about each output, for a
/// sweep a table and a figure for each.
pub(super) fn of(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> Document {
    let mut document = titled(report);
    if let [row] = report.evaluation.rows.as_slice()
        && row.outputs.len() > 1
    {
        document.section("Results");
        summary(&mut document, report, row);
    }
    sections(&mut document, report, shown);
    let notes = notes(report);
    if !notes.is_empty() {
        document.section("Notes");
        document.blocks.push(Block::List(crate::words::lines(&notes)));
    }
    repeat::section(&mut document, report, shown);
    document
}

/// The document of an evaluation for a text page. Notes are not part of it; the command prints them on
/// standard error.
pub(super) fn text(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> Document {
    let EvaluationReport { task, evaluation, .. } = *report;
    let row = match evaluation.rows.as_slice() {
        [row] => Some(row),
        _ => None,
    };
    let first = row.map_or_else(Vec::new, |row| brief::results(report, row));
    let remarks = row.map_or_else(Vec::new, |row| brief::remarks(report, row));
    let mut document = match shown.extent {
        Extent::Full => titled(report),
        Extent::Brief | Extent::Usual => Document::default(),
    };
    document.terminal = true;
    document.first = first;
    match shown.extent {
        Extent::Brief => {
            if row.is_none() {
                sweep::tables(&mut document, report);
            }
        }
        Extent::Usual => {
            document.remarks = remarks;
            usual(&mut document, report, shown);
            let mut settings = vec![plain(&task.title)];
            settings.extend(table::at(task, evaluation));
            settings.push(table::settings_text(evaluation));
            settings.extend(table::stopped(evaluation));
            settings.retain(|said| !said.is_empty());
            document.text(format!("{} {MORE}", sentence(&settings.join("; "))));
        }
        Extent::Full => {
            document.remarks = remarks;
            sections(&mut document, report, shown);
            repeat::section(&mut document, report, shown);
        }
    }
    document
}

/// The notes that the sections of the outputs do not have already.
fn notes(report: &EvaluationReport<'_>) -> Vec<Warning> {
    let EvaluationReport { task, evaluation, warnings, .. } = *report;
    let is_single = evaluation.rows.len() == 1;
    let is_shown = |warning: &&Warning| {
        is_single
            && task
                .model
                .outputs
                .iter()
                .any(|output| comparison::is_of_output(warning, &output.quantity.name))
    };
    warnings.iter().filter(|warning| !is_shown(warning)).cloned().collect()
}

/// A document with its title and what the evaluation is.
fn titled(report: &EvaluationReport<'_>) -> Document {
    let EvaluationReport { task, evaluation, .. } = *report;
    let title = plain(&task.title);
    let title = if title.is_empty() { "Measurement uncertainty".to_owned() } else { title };
    let mut document = Document { title, ..Document::default() };
    document.subtitle.push(table::settings_text(evaluation));
    document.subtitle.extend(table::at(task, evaluation));
    document.subtitle.extend(table::stopped(evaluation));
    document
}

/// The results of several outputs in a table.
fn summary(document: &mut Document, report: &EvaluationReport<'_>, row: &RowEvaluation) {
    let digits = report.evaluation.settings.digits_on_pages();
    document.table(table::sweep::summary(report.task, row, digits));
    if let Some(said) = table::sweep::explained(row.outputs.iter(), digits) {
        document.text(said);
    }
}

/// The budget and both methods of a single output; the results of several outputs and the shares of the
/// inputs; the table of a sweep; and the distributions if they are drawn.
fn usual(document: &mut Document, report: &EvaluationReport<'_>, shown: &Shown<'_>) {
    let EvaluationReport { task, evaluation, .. } = *report;
    let [row] = evaluation.rows.as_slice() else {
        return sweep::sections(document, report, shown);
    };
    let digits = evaluation.settings.digits_on_pages();
    let is_single = row.outputs.len() == 1;
    let has_budgets = is_single || !shown.columns.is_empty();
    if !is_single {
        summary(document, report, row);
    }
    if !has_budgets && let Some(sheet) = table::shares::sheet(task, row, digits) {
        document.text(table::shares::ABOUT);
        document.table(sheet);
    }
    let mut distributions = Vec::new();
    for output in 0..row.outputs.len() {
        let Some(section) = results::section_of(report, shown, (0, output), true) else { continue };
        if has_budgets {
            if !is_single {
                document.section(section.title);
            }
            document.blocks.extend(section.budget.blocks);
            document.blocks.extend(section.comparison.blocks);
        }
        distributions.extend(section.distribution.blocks);
    }
    document.blocks.extend(distributions);
    crate::regions::sections(document, task, row);
    if let Some(said) = table::left_out(row) {
        document.sentence(&said);
    }
}

/// The sections about the outputs, the measurement and its inputs.
fn sections(document: &mut Document, report: &EvaluationReport<'_>, shown: &Shown<'_>) {
    let EvaluationReport { task, evaluation, .. } = *report;
    if let [row] = evaluation.rows.as_slice() {
        for output in 0..row.outputs.len() {
            let folded = row.outputs.len() > MOST_UNFOLDED;
            results::section(document, report, shown, (output, folded));
        }
    }
    together_of(document, report, shown);
    statement::section(document, statement::TITLE, task.into());
    if let Some(sheet) = quantities(task) {
        document.section("Quantities");
        document.table(sheet);
    }
    if let Some(drawing) = (!document.terminal).then(|| figures::inputs(task)).flatten() {
        document.section("Input distributions");
        document.figure(Some(drawing));
    }
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
            if row.regions.is_empty() {
                let of_row = (0, evaluation.coverage_probability);
                let drawn = || figures::scatter(task, of_row, shown.trials);
                document.picture(drawn, || None);
            }
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
