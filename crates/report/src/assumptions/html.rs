//! The page for a browser and for print.

use maud::{Markup, html};

use super::{AuditReport, figure, sheets, words};
use crate::html::table;
use crate::html::{figure as numbered, page};
use crate::{plain, statement};

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
            div.verdict { p { strong { (said) } } }
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

/// The audit as one HTML file with figures that needs nothing else.
pub fn html(report: &AuditReport<'_>) -> String {
    let mut number = 0;
    let title = words::title(report);
    let mut sections: Vec<Markup> = Vec::new();
    for (row, of_row) in report.audit.rows.iter().enumerate() {
        for (output, of) in of_row.outputs.iter().enumerate() {
            let drawing = figure::draw(of, |variable| plain(report.name(variable)));
            let drawing = drawing.map(|drawing| {
                number += 1;
                numbered(number, &drawing)
            });
            sections.push(html! {
                h2 { (words::heading(report, row, output)) }
                p { (words::baseline(report, output, of)) }
                p { strong { (words::verdict(report, of)) } }
                (table(&sheets::widths(report, of)))
                @if let Some(shapes) = sheets::shapes(report, of) {
                    h3 { "With another shape" }
                    (table(&shapes))
                }
                @if let Some(drawing) = drawing { (drawing) }
            });
        }
    }
    let body = html! {
        h1 { (title) }
        p.settings { (words::settings(report)) }
        @if let Some(said) = words::contradicted(report) {
            div.verdict { p { strong { (said) } } }
        }
        @let stated = statement::lines(report.task);
        @if !stated.is_empty() {
            h2 { "Measurement model" }
            ul { @for line in &stated { li { (line) } } }
        }
        @for section in &sections { (section) }
        @if let Some(evidence) = sheets::evidence(report) {
            h2 { "Do the readings agree?" }
            (table(&evidence))
            p { (words::EVIDENCE) }
        }
        h2 { "How to read this" }
        p { (words::MOVES) }
        p { (words::SHAPES) }
        p { (words::SOBOL) }
        @if !report.warnings.is_empty() {
            h2 { "Notes" }
            ul { @for warning in report.warnings { li { (plain(&warning.text)) } } }
        }
        h2 { "To repeat this" }
        div.table {
            table {
                tbody {
                    tr { td { "program" } td { "gumption " (env!("CARGO_PKG_VERSION")) } }
                    tr { td { "trials" } td { (report.audit.question.trials) } }
                    tr { td { "seed" } td { (report.task.settings.seed) } }
                    tr {
                        td { "model file, SHA-256" }
                        td { code { (report.provenance.model_sha256) } }
                    }
                    @for (name, digest) in &report.provenance.files {
                        tr { td { (plain(name)) ", SHA-256" } td { code { (digest) } } }
                    }
                }
            }
        }
    };
    page(&title, &body)
}
