//! Everything that is needed to get the same answer again.

use super::Shown;
use crate::document::{Block, Document};
use crate::sheet::Sheet;
use crate::table;
use crate::table::printable;
use crate::{EvaluationReport, plain};
use gumption_engine::task::Trials;

/// Program, settings, digests, and the text of the model file where the page shows it.
pub(super) fn section(document: &mut Document, report: &EvaluationReport<'_>, shown: &Shown<'_>) {
    document.section("Reproducing this result");
    let lines = lines(report, shown);
    let mut sheet = Sheet::default();
    sheet.text("what", lines.iter().map(|(name, _)| name.clone()));
    sheet.text("value", lines.into_iter().map(|(_, value)| value));
    document.table(sheet);
    document
        .text("The same program, files and seed give the same result with any number of threads.");
    let model = shown.model;
    if !model.trim().is_empty() {
        let about = "The model file:".to_owned();
        document.blocks.push(Block::Listing { about, text: printable(model) });
    }
}

/// Names and values.
pub(super) fn lines(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> Vec<(String, String)> {
    let EvaluationReport { evaluation, provenance, .. } = report;
    let settings = &evaluation.settings;
    let asked = match settings.trials {
        Trials::Fixed(trials) => trials.to_string(),
        Trials::Adaptive => format!("adaptive, by rule {}", settings.rule.name()),
    };
    // the result of a stopped run does not come out again
    let trials = match table::stopped(evaluation) {
        Some(stopped) => format!("{asked}; {stopped}"),
        None => asked,
    };
    let mut lines = vec![
        ("program".to_owned(), format!("gumption {}", env!("CARGO_PKG_VERSION"))),
        ("seed".to_owned(), settings.seed.to_string()),
        ("trials".to_owned(), trials),
        ("coverage probability".to_owned(), evaluation.coverage_probability.to_string()),
        ("digits".to_owned(), settings.digits.to_string()),
    ];
    lines.extend(settings.shown_digits.map(|n| ("shown digits".to_owned(), n.to_string())));
    // a task that was made in Rust has no file
    if !provenance.model_sha256.is_empty() {
        lines.push(("model file, SHA-256".to_owned(), provenance.model_sha256.clone()));
    }
    lines.extend(shown.replaced.iter().map(|text| ("replaced".to_owned(), plain(text))));
    let digest =
        |(name, digest): &(String, String)| (format!("{}, SHA-256", plain(name)), digest.clone());
    lines.extend(provenance.files.iter().map(digest));
    lines
}
