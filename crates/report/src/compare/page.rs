//! The pages for a terminal, for a browser, and for GitHub.

use std::borrow::Cow;

use maud::html;

use super::{Compare, figure, proficiency, sheets, words};
use crate::document::{self, Block, Document, sentence};
use crate::html::{figure as numbered, page, table as html_table};
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
    }
}

/// The values of every estimator, for laboratories.
fn estimators(compare: &Compare) -> Option<(Sheet, String)> {
    match compare {
        Compare::Pairs { .. } | Compare::Proficiency { .. } => None,
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
    }
}

/// The comparison as a text page.
pub fn table(compare: &Compare) -> String {
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
}

/// The comparison as one self-contained HTML file.
pub fn html(compare: &Compare, warnings: &[Warning]) -> String {
    let title = words::title(compare);
    let drawing = figure::draw(compare);
    let body = html! {
        h1 { (title) }
        div.verdict { @for said in words::verdict(compare) { p { (said) } } }
        @if !warnings.is_empty() {
            ul { @for said in crate::words::lines(warnings) { li { (sentence(&said)) } } }
        }
        (html_table(&sheet(compare)))
        @if let Some(drawing) = drawing { (numbered(1, &drawing)) }
        @if let Some((sheet, said)) = estimators(compare) { (html_table(&sheet)) p { (said) } }
        @for note in notes(compare) { p { (note) } }
        p.settings { "gumption " (env!("CARGO_PKG_VERSION")) }
    };
    page(&title, &body)
}

/// The comparison as Markdown, as GitHub shows it.
pub fn markdown(compare: &Compare, warnings: &[Warning]) -> String {
    let mut document = Document { title: words::title(compare), ..Document::default() };
    let verdict = words::verdict(compare);
    document.blocks.push(Block::Text(verdict.join(" ")));
    if !warnings.is_empty() {
        let said = crate::words::lines(warnings);
        document.blocks.push(Block::List(said.iter().map(|said| sentence(said)).collect()));
    }
    document.blocks.push(Block::Table(sheet(compare)));
    if let Some((sheet, said)) = estimators(compare) {
        document.table(sheet);
        document.text(said);
    }
    document.blocks.extend(notes(compare).into_iter().map(|note| Block::Text(note.into_owned())));
    document::markdown(&document)
}
