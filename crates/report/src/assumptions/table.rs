//! The page for a terminal.

use super::{AuditReport, sheets, words};
use crate::printed::on_terminal;
use crate::{Grid, statement, table::width, wrapped};

/// The audit as a page: for each output the figures as stated, what every assumption does, and what
/// other shapes do; then what the readings say.
pub fn table(report: &AuditReport<'_>) -> String {
    on_terminal(|| {
        let mut heading = wrapped(&words::title(report)) + &wrapped(&words::settings(report));
        heading += &words::contradicted(report).map(|said| wrapped(&said)).unwrap_or_default();
        heading += &words::offsets(report).iter().map(|said| wrapped(said)).collect::<String>();
        let stated: String =
            statement::lines(report.task.into()).iter().map(|line| wrapped(line)).collect();
        let mut page = vec![heading];
        page.extend((!stated.is_empty()).then_some(stated));
        for (number, row) in report.audit.rows.iter().enumerate() {
            for (output, of) in row.outputs.iter().enumerate() {
                let mut text = section(&words::heading(report, number, output));
                text += &wrapped(&words::baseline(report, output, of));
                text += &wrapped(&words::verdict(report, of));
                text += &format!("\n{}", Grid::of(&sheets::widths(report, of)).render(width()));
                if let Some(shapes) = sheets::shapes(report, of) {
                    text += &format!("\nwith another shape\n{}", Grid::of(&shapes).render(width()));
                }
                page.push(text);
            }
        }
        if let Some(evidence) = sheets::evidence(report) {
            let table = Grid::of(&evidence).render(width());
            page.push(section("Readings") + &table + &wrapped(words::EVIDENCE));
        }
        page.push(wrapped(words::MOVES) + &wrapped(words::SHAPES) + &wrapped(words::SOBOL));
        page.join("\n")
    })
}

fn section(title: &str) -> String {
    format!("{title}\n{}\n", "═".repeat(title.chars().count()))
}
