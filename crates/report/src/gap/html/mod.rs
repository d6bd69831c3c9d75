//! The page for a browser and for print.

mod bars;
mod intervals;
mod predictions;
mod residuals;
mod shrinkage;
mod where_map;

use maud::{Markup, html};

use super::{composed, departure, digits, sheets, words};
pub(crate) use crate::html::Drawing;
pub(super) use crate::html::WIDTH;
use crate::html::{figure, page, table};
use crate::{Provenance, plain};
use gumption_gap::Diagnosis;

/// The diagnosis as one HTML file with figures that needs nothing else: it loads nothing and runs
/// nothing, reads in light and dark and prints on A4.
pub fn html(diagnosis: &Diagnosis, provenance: &Provenance) -> String {
    let mut number = 0;
    let mut drawn = |drawing: Drawing| {
        number += 1;
        figure(number, drawing.svg, &drawing.caption)
    };
    let outputs = 0..diagnosis.outputs.len();
    let title = words::title(diagnosis);
    let settings = [
        ("seed", diagnosis.seed.to_string()),
        ("coverage probability", digits::percent(diagnosis.probability)),
    ];
    let body = html! {
        h1 { (title) }
        p.settings { (words::settings(diagnosis)) }
        div.verdict {
            p { strong { (words::verdict(diagnosis)) } }
            @for said in words::conflicts(diagnosis) { p { (said) } }
            @for said in words::noise_verdict(diagnosis) { p { (said) } }
            @if let Some(said) = words::present(diagnosis) { p { (said) } }
            @if let Some(said) = words::look_alikes(diagnosis) { p { (said) } }
        }
        h2 { "Is there a gap?" }
        p { (words::gap(diagnosis)) }
        h2 { "Where?" }
        @match sheets::regions(diagnosis) {
            Some(sheet) => { (table(&sheet)) p { (words::REGIONS) } }
            None => p { (words::NO_REGION) }
        }
        @if let Some(drawing) = where_map::draw(diagnosis) { (drawn(drawing)) }
        @if let Some(sheet) = sheets::present(diagnosis) {
            h2 { "Which effects are there?" }
            (table(&sheet))
        }
        h2 { "Which together?" }
        (table(&sheets::hypotheses(diagnosis)))
        @if let Some(said) = sheets::left_out(diagnosis) { p { (said) } }
        (drawn(bars::draw(diagnosis)))
        @if let Some(sheet) = sheets::parameters(diagnosis) {
            h2 { "Parameters of the verdict" }
            (table(&sheet))
            @if let Some(drawing) = intervals::draw(diagnosis) { (drawn(drawing)) }
        }
        @let departure = departure::sentences(diagnosis);
        @if !departure.is_empty() {
            h2 { "What the departure looks like" }
            ul { @for said in departure { li { (said) } } }
        }
        @let composed = composed::sentences(diagnosis);
        @if !composed.is_empty() {
            h2 { "What would explain it: composed, not from your list" }
            ul { @for said in composed { li { (said) } } }
            p { (composed::HOW_TO_USE) }
        }
        h2 { "How far does it shrink?" }
        (table(&sheets::shrinkage(diagnosis)))
        @for said in words::shrinkage(diagnosis) { p { (said) } }
        @for said in words::noise(diagnosis) { p { (said) } }
        @if let Some(drawing) = shrinkage::draw(diagnosis) { (drawn(drawing)) }
        @for output in outputs.clone() {
            @if let Some(drawing) = residuals::draw(diagnosis, output) { (drawn(drawing)) }
        }
        h2 { "What to measure next" }
        p { (words::next(diagnosis)) }
        @if let Some(rows) = &diagnosis.prediction {
            h2 { "Corrected prediction" }
            @for output in outputs {
                h3 { (words::axis(&diagnosis.outputs[output])) }
                (table(&sheets::prediction(diagnosis, rows, output, false)))
                @if let Some(drawing) = predictions::draw(diagnosis, rows, output) {
                    (drawn(drawing))
                }
            }
        }
        @let notes = words::notes(diagnosis);
        @if !notes.is_empty() {
            h2 { "Notes" }
            ul { @for note in notes { li { (note) } } }
        }
        h2 { "To repeat this" }
        (repeat(&settings, provenance))
    };
    page(&title, &body)
}

/// Everything that is needed to get the same answer again; `settings` are those of the command, with
/// their names.
pub(super) fn repeat(settings: &[(&str, String)], provenance: &Provenance) -> Markup {
    html! {
        div.table {
            table {
                tbody {
                    tr { td { "program" } td { "gumption " (env!("CARGO_PKG_VERSION")) } }
                    @for (name, value) in settings {
                        tr { td { (name) } td { (value) } }
                    }
                    tr {
                        td { "case file, SHA-256" }
                        td { code { (provenance.model_sha256) } }
                    }
                    @for (name, digest) in &provenance.files {
                        tr { td { (plain(name)) ", SHA-256" } td { code { (digest) } } }
                    }
                }
            }
        }
        p { "The same program, files and seed give the same figures on any number of threads." }
    }
}
