//! The audit as a document for a browser, for print and for GitHub.

use super::{AuditReport, figure, sheets, words};
use crate::document::{Block, Document};
use crate::{plain, statement};

/// The whole document.
pub(super) fn of(report: &AuditReport<'_>) -> Document {
    let mut document = Document {
        title: words::title(report),
        subtitle: vec![words::settings(report)],
        ..Document::default()
    };
    let contradicted = words::contradicted(report).into_iter();
    let said: Vec<String> = contradicted.chain(words::offsets(report)).collect();
    document.blocks.extend((!said.is_empty()).then_some(Block::Verdict(said)));
    statement::section(&mut document, statement::TITLE, report.task.into());
    for (row, of_row) in report.audit.rows.iter().enumerate() {
        for (output, of) in of_row.outputs.iter().enumerate() {
            document.section(words::heading(report, row, output));
            document.text(words::baseline(report, output, of));
            document.blocks.push(Block::Verdict(vec![words::verdict(report, of)]));
            let name = |variable| plain(report.name(variable));
            document.figure(figure::tornado(of, name));
            document.table(sheets::widths(report, of));
            if let Some(shapes) = sheets::shapes(report, of) {
                document.text("With another shape:");
                document.table(shapes);
            }
            document.figure(figure::shapes(of, name));
        }
    }
    if let Some(evidence) = sheets::evidence(report) {
        document.section("Do the readings agree?");
        document.table(evidence);
        document.text(words::EVIDENCE);
    }
    document.section("How to read this");
    for said in [words::MOVES, words::SHAPES, words::SOBOL] {
        document.text(said);
    }
    if !report.warnings.is_empty() {
        document.section("Notes");
        document.blocks.push(Block::List(crate::words::lines(report.warnings)));
    }
    document.section("Reproducing this result");
    let provenance = report.provenance;
    let mut lines = vec![
        format!("gumption {}", env!("CARGO_PKG_VERSION")),
        format!("trials: {}", report.audit.question.trials),
        format!("seed: {}", report.task.settings.seed),
        format!("model file, SHA-256: {}", provenance.model_sha256),
    ];
    let files = provenance.files.iter();
    lines.extend(files.map(|(name, digest)| format!("{}, SHA-256: {digest}", plain(name))));
    document.blocks.push(Block::List(lines));
    document
}
