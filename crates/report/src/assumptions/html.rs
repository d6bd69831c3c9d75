//! The parts of a page that other pages show.

use maud::{Markup, html};

use super::{AuditReport, sheets, words};
use crate::html::table;
use crate::printed::{Notation, in_print, notation, with_comma};
use crate::sheet::Sheet;
use crate::words::Language;

/// The sections of the outputs and of the readings alone, as HTML that needs the style of
/// [`crate::page_style`] and stands below a heading of second level. Numbers have the decimal mark of
/// the language.
pub fn fragment(report: &AuditReport<'_>, language: Language) -> String {
    in_print(language.notation(), || sections(report))
}

fn sections(report: &AuditReport<'_>) -> String {
    let mut parts: Vec<Markup> = Vec::new();
    for (row, of_row) in report.audit.rows.iter().enumerate() {
        for (output, of) in of_row.outputs.iter().enumerate() {
            parts.push(html! {
                h3 { (words::heading(report, row, output)) }
                p { (words::baseline(report, output, of)) }
                p { strong { (words::verdict(report, of)) } }
                (shown(sheets::widths(report, of)))
                @if let Some(shapes) = sheets::shapes(report, of) {
                    h4 { "With another shape" }
                    (shown(shapes))
                }
            });
        }
    }
    html! {
        @if let Some(said) = words::contradicted(report) {
            div.verdict {
                p { strong { (said) } }
                @for said in words::offsets(report) { p { (said) } }
            }
        }
        @for part in &parts { (part) }
        @if let Some(evidence) = sheets::evidence(report) {
            h3 { "Do the readings agree?" }
            (shown(evidence))
        }
        p.settings { (words::MOVES) }
    }
    .into_string()
}

/// A table with the decimal mark of the page; its first two columns are names.
fn shown(mut sheet: Sheet) -> Markup {
    if notation() == Notation::PrintWithComma {
        for column in sheet.columns.iter_mut().skip(2) {
            column.cells.iter_mut().for_each(|cell| *cell = with_comma(cell));
        }
    }
    table(&sheet)
}
