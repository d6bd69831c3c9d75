//! The pages for a terminal, for a browser, and for GitHub.

use std::borrow::Cow;

use super::{Compare, figure, gauge, proficiency, sheets, words};
use crate::document::{self, Block, Document, sentence};
use crate::printed::on_terminal;
use crate::sheet::Sheet;
use crate::{Grid, table::width, wrapped};
use gumption_engine::task::Warning;

fn sheet(compare: &Compare) -> Sheet {
    match compare {
        Compare::Pairs { pairs, compared, units, rounding } => {
            sheets::pairs((pairs, compared), units, *rounding)
        }
        Compare::Laboratories { comparison, unit } => sheets::laboratories(comparison, unit),
        Compare::Proficiency { test, unit } => proficiency::sheet(test, unit),
        Compare::Gauge { study, unit } => gauge::sheet(study, unit),
    }
}

/// The values of every estimator, for laboratories; the mean squares of a gauge.
fn estimators(compare: &Compare) -> Option<(Sheet, String)> {
    match compare {
        Compare::Pairs { .. } | Compare::Proficiency { .. } => None,
        Compare::Gauge { study, unit } => Some((gauge::squares(study), gauge::inputs(study, unit))),
        Compare::Laboratories { comparison, .. } => {
            Some((sheets::estimators(comparison), words::recommended(comparison)))
        }
    }
}

fn notes(compare: &Compare) -> Vec<Cow<'static, str>> {
    match compare {
        Compare::Pairs { rounding: true, .. } => vec![words::PAIRS.into(), words::ROUNDING.into()],
        Compare::Pairs { .. } => vec![words::PAIRS.into()],
        Compare::Laboratories { comparison, .. } => {
            vec![words::laboratories(comparison).into(), words::ESTIMATORS.into()]
        }
        Compare::Proficiency { test, .. } => vec![proficiency::explained(test).into()],
        Compare::Gauge { study, .. } => vec![gauge::explained(study).into()],
    }
}

/// The comparison as a text page.
pub fn table(compare: &Compare) -> String {
    on_terminal(|| {
        let paragraphs = |of: &[&str]| of.iter().map(|text| wrapped(text)).collect::<String>();
        let verdict = words::verdict(compare);
        let verdict: Vec<&str> = verdict.iter().map(String::as_str).collect();
        let table = Grid::of(&sheet(compare)).render(width());
        let mut parts = vec![paragraphs(&verdict), table];
        if let Some((sheet, said)) = estimators(compare) {
            parts.push(Grid::of(&sheet).render(width()) + &wrapped(&said));
        }
        parts.push(notes(compare).iter().map(|note| wrapped(note)).collect());
        parts.join("\n")
    })
}

fn document(compare: &Compare, warnings: &[Warning]) -> Document {
    let mut document = Document { title: words::title(compare), ..Document::default() };
    document.blocks.push(Block::Verdict(words::verdict(compare)));
    if !warnings.is_empty() {
        let said = crate::words::lines(warnings);
        document.blocks.push(Block::List(said.iter().map(|said| sentence(said)).collect()));
    }
    document.table(sheet(compare));
    document.figure(figure::draw(compare));
    if let Some((sheet, said)) = estimators(compare) {
        document.table(sheet);
        document.text(said);
    }
    for note in notes(compare) {
        document.text(note);
    }
    document
}

/// The comparison as one self-contained HTML file.
pub fn html(compare: &Compare, warnings: &[Warning]) -> String {
    document::html(|| document(compare, warnings))
}

/// The comparison as Markdown, as GitHub shows it.
pub fn markdown(compare: &Compare, warnings: &[Warning]) -> String {
    document::markdown(|| document(compare, warnings))
}
