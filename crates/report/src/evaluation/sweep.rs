//! A sweep over conditions: a table and a figure for each output.

use super::figures;
use crate::EvaluationReport;
use crate::document::{Block, Document};
use crate::table;
use crate::table::sweep;

/// Rows of a table on a page, at most.
const MOST_ROWS: usize = 2000;

/// The sections of all outputs.
pub(super) fn sections(document: &mut Document, report: &EvaluationReport<'_>) {
    let EvaluationReport { task, evaluation, .. } = *report;
    let rows = evaluation.rows.get(..MOST_ROWS).unwrap_or(&evaluation.rows);
    for (output, declared) in task.model.outputs.iter().enumerate() {
        document.section(table::title_text(&declared.quantity));
        document.table(sweep::sheet(task, rows, output, evaluation.settings.digits));
        if rows.len() < evaluation.rows.len() {
            let all = table::grouped(evaluation.rows.len() as u64);
            let first = table::grouped(MOST_ROWS as u64);
            document.text(format!("The first {first} of {all} rows; all of them: --format csv."));
        }
        let settings = &evaluation.settings;
        let taken = sweep::taken(settings, &evaluation.rows, output);
        for said in taken.into_iter().chain(sweep::conformity(task, &evaluation.rows, output)) {
            document.text(said);
        }
        document.figure(figures::sweep(task, rows, (output, settings)));
        if let Some(sheet) = sweep::shares(task, rows, output) {
            document.text("Shares of the variance in %:");
            document.table(sheet);
        }
    }
    let apart = sweep::apart(task, rows);
    if !apart.is_empty() {
        let tables = apart.into_iter().map(Block::Table).collect();
        document.blocks.push(Block::Folded("All conditions of the rows".to_owned(), tables));
    }
    document.text(sweep::MORE);
}
