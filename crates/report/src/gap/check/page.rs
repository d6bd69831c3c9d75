//! The page of a blind check as a document, which all looks draw.

use super::design::CheckedDesign;
use super::{confusion, matrix, reliability, sheets, words};
use crate::Provenance;
use crate::document::{self, Block, Document};
use crate::gap::page::repeat;
use gumption_gap::check::BlindCheckScores;

/// The scores of a blind check as a page for a terminal of at most 100 columns, or as many as it has
/// ([`crate::within_width`]).
pub fn table(design: &CheckedDesign, report: &BlindCheckScores, provenance: &Provenance) -> String {
    document::text(|| page(design, report, provenance, true))
}

/// The scores of a blind check as one HTML file with figures that needs nothing else: it loads
/// nothing and runs nothing, reads in light and dark and prints on A4.
pub fn html(design: &CheckedDesign, report: &BlindCheckScores, provenance: &Provenance) -> String {
    document::html(|| page(design, report, provenance, false))
}

/// What was done, the scores, whether probabilities mean what they say, the most frequent wrong
/// verdicts, and the smallest effects that are found.
fn page(
    design: &CheckedDesign,
    report: &BlindCheckScores,
    provenance: &Provenance,
    terminal: bool,
) -> Document {
    let mut page = Document {
        title: words::title(design),
        subtitle: vec![words::settings(report)],
        terminal,
        ..Document::default()
    };
    let mut verdict = vec![words::verdict(report)];
    verdict.extend(words::beside(report));
    page.blocks.push(Block::Verdict(verdict));
    page.section("Method");
    page.text(words::done(design, report));
    page.section("Scores");
    page.table(sheets::scores(report));
    page.text(words::RIGHT);
    page.text(words::SCORES);
    page.section("Calibration of the probabilities");
    page.table(sheets::reliability(report));
    page.text(words::reliability(report));
    page.picture(|| Some(reliability::draw(report)), || None);
    page.section("Wrong verdicts");
    let wrong = confusion::wrong(report);
    match sheets::wrong(&wrong) {
        Some(sheet) => page.table(sheet),
        None => page.text(words::NONE_WRONG),
    }
    words::left_out(&wrong).into_iter().for_each(|said| page.text(said));
    page.picture(|| matrix::draw(report), || None);
    if let Some(sheet) = sheets::smallest(report) {
        page.section("Smallest effects found");
        page.table(sheet);
        page.text(words::SMALLEST);
    }
    let settings =
        [("draws", report.draws.to_string()), ("seed of the draws", report.seed.to_string())];
    repeat(&mut page, &settings, provenance);
    page
}
