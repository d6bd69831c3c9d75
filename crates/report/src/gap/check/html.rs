//! The page of a blind check for a browser and for print.

use maud::html;

use super::super::html::repeat;
use super::design::CheckedDesign;
use super::{confusion, matrix, reliability, sheets, words};
use crate::Provenance;
use crate::html::{Drawing, figure, page, table};
use gumption_gap::check::BlindCheckScores;

/// The scores of a blind check as one HTML file with figures that needs nothing else: it loads
/// nothing and runs nothing, reads in light and dark and prints on A4.
pub fn html(design: &CheckedDesign, report: &BlindCheckScores, provenance: &Provenance) -> String {
    let mut number = 0;
    let mut drawn = |drawing: Drawing| {
        number += 1;
        figure(number, &drawing)
    };
    let wrong = confusion::wrong(report);
    let settings =
        [("draws", report.draws.to_string()), ("seed of the draws", report.seed.to_string())];
    let title = words::title(design);
    let body = html! {
        h1 { (title) }
        p.settings { (words::settings(report)) }
        div.verdict {
            p { strong { (words::verdict(report)) } }
            @if let Some(said) = words::beside(report) { p { (said) } }
        }
        h2 { "What was done" }
        p { (words::done(design, report)) }
        h2 { "Scores" }
        (table(&sheets::scores(report)))
        p { (words::RIGHT) }
        p { (words::SCORES) }
        h2 { "Do probabilities mean what they say?" }
        (table(&sheets::reliability(report)))
        p { (words::reliability(report)) }
        (drawn(reliability::draw(report)))
        h2 { "Wrong verdicts" }
        @match sheets::wrong(&wrong) {
            Some(sheet) => (table(&sheet)),
            None => p { (words::NONE_WRONG) }
        }
        @if let Some(said) = words::left_out(&wrong) { p { (said) } }
        @if let Some(drawing) = matrix::draw(report) { (drawn(drawing)) }
        @if let Some(sheet) = sheets::smallest(report) {
            h2 { "Smallest effects found" }
            (table(&sheet))
            p { (words::SMALLEST) }
        }
        h2 { "To repeat this" }
        (repeat(&settings, provenance))
    };
    page(&title, &body)
}
