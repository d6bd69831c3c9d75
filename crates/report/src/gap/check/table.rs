//! The page of a blind check for a terminal.

use super::super::table::section;
use super::design::CheckedDesign;
use super::{confusion, sheets, words};
use crate::{Grid, table::width, wrapped};
use gumption_gap::check::BlindCheckScores;

/// The scores of a blind check as a page of at most 100 columns: what was done, the scores, whether
/// probabilities mean what they say, the most frequent wrong verdicts, and the smallest effects that
/// are found.
pub fn table(design: &CheckedDesign, report: &BlindCheckScores) -> String {
    let mut page = vec![heading(design, report)];
    page.push(section("What was done") + &wrapped(&words::done(design, report)));
    let scores = Grid::of(&sheets::scores(report)).render(width());
    page.push(section("Scores") + &scores + &wrapped(words::RIGHT) + &wrapped(words::SCORES));
    let reliability = Grid::of(&sheets::reliability(report)).render(width());
    page.push(
        section("Do probabilities mean what they say?")
            + &reliability
            + &wrapped(&words::reliability(report)),
    );
    page.push(section("Wrong verdicts") + &wrong(report));
    if let Some(sheet) = sheets::smallest(report) {
        let smallest = Grid::of(&sheet).render(width());
        page.push(section("Smallest effects found") + &smallest + &wrapped(words::SMALLEST));
    }
    page.join("\n")
}

/// Title, settings and how often the verdict was right.
fn heading(design: &CheckedDesign, report: &BlindCheckScores) -> String {
    let heading = wrapped(&words::title(design)) + &wrapped(&words::settings(report));
    let beside = words::beside(report).map(|said| wrapped(&said)).unwrap_or_default();
    heading + "\n" + &wrapped(&words::verdict(report)) + &beside
}

fn wrong(report: &BlindCheckScores) -> String {
    let wrong = confusion::wrong(report);
    match sheets::wrong(&wrong) {
        Some(sheet) => {
            let rest = words::left_out(&wrong).map(|said| wrapped(&said));
            Grid::of(&sheet).render(width()) + &rest.unwrap_or_default()
        }
        None => wrapped(words::NONE_WRONG),
    }
}
