//! The parts of a page that other pages show.

use maud::{Markup, html};

use super::{AuditReport, sheets, words};
use crate::html::table;

/// The sections of the outputs and of the readings alone, as HTML that needs the style of
/// [`crate::page_style`] and stands below a heading of second level.
pub fn fragment(report: &AuditReport<'_>) -> String {
    let mut parts: Vec<Markup> = Vec::new();
    for (row, of_row) in report.audit.rows.iter().enumerate() {
        for (output, of) in of_row.outputs.iter().enumerate() {
            parts.push(html! {
                h3 { (words::heading(report, row, output)) }
                p { (words::baseline(report, output, of)) }
                p { strong { (words::verdict(report, of)) } }
                (table(&sheets::widths(report, of)))
                @if let Some(shapes) = sheets::shapes(report, of) {
                    h4 { "With another shape" }
                    (table(&shapes))
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
            (table(&evidence))
        }
        p.settings { (words::MOVES) }
    }
    .into_string()
}
