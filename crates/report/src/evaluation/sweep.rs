//! A sweep over conditions: a table and a figure for each output.

use super::{Extent, Shown, figures, terminal};
use crate::document::{Block, Document};
use crate::printed;
use crate::table::{self, conditions_text, sweep};
use crate::{EvaluationReport, wrapped};

/// Rows of a table on a page that is no page for a terminal, at most.
const MOST_ROWS: usize = 2000;

/// The table of each output alone.
pub(super) fn tables(document: &mut Document, report: &EvaluationReport<'_>) {
    let EvaluationReport { task, evaluation, .. } = *report;
    let digits = evaluation.settings.digits_on_pages();
    for (output, declared) in task.model.outputs.iter().enumerate() {
        document.section(table::title_text(&declared.quantity));
        document.table(sweep::sheet(task, &evaluation.rows, output, digits));
    }
}

/// The sections of all outputs.
pub(super) fn sections(document: &mut Document, report: &EvaluationReport<'_>, shown: &Shown<'_>) {
    let EvaluationReport { task, evaluation, .. } = *report;
    let first = evaluation.rows.get(..MOST_ROWS).filter(|_| !document.terminal);
    let rows = first.unwrap_or(&evaluation.rows);
    for (output, declared) in task.model.outputs.iter().enumerate() {
        document.section(table::title_text(&declared.quantity));
        document.table(sweep::sheet(task, rows, output, evaluation.settings.digits_on_pages()));
        if rows.len() < evaluation.rows.len() {
            let all = printed::grouped(evaluation.rows.len() as u64);
            let first = printed::grouped(MOST_ROWS as u64);
            document.text(format!("The first {first} of {all} rows; all of them: --format csv."));
        }
        let settings = &evaluation.settings;
        let taken = sweep::taken(settings, &evaluation.rows, output);
        let line = sweep::capability_line_text(task, &evaluation.rows, output);
        let decided = sweep::conformity(task, &evaluation.rows, output);
        for said in taken.into_iter().chain(decided).chain(line) {
            document.text(said);
        }
        document.picture(|| figures::sweep(task, rows, (output, settings)), || None);
        let has_shares = !document.terminal || shown.extent == Extent::Full;
        if let Some(sheet) = sweep::shares(task, rows, output).filter(|_| has_shares) {
            document.text("Shares of the variance in %:");
            document.table(sheet);
        }
        for (place, row) in rows.iter().enumerate().filter(|_| document.terminal) {
            let drawn = shown.histogram(place, output).zip(row.outputs.get(output));
            let Some((counts, found)) = drawn else { continue };
            let at = conditions_text(&task.model.conditions, &row.conditions);
            let histogram = terminal::histogram(&declared.quantity, found, counts);
            document.blocks.push(Block::Characters(wrapped(&format!("at {at}")) + &histogram));
        }
    }
    let apart = sweep::apart(task, rows);
    if !apart.is_empty() {
        let tables = apart.into_iter().map(Block::Table).collect();
        document.blocks.push(Block::Folded("All conditions of the rows".to_owned(), tables));
    }
    document.text(sweep::MORE);
}
