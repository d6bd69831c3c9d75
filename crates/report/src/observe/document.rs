//! The observations as a document for a browser, for print and for GitHub.

use super::{ObservationReport, figures, sheets, table};
use crate::document::{Block, Document};
use crate::plain;
use gumption_signal::{ChannelObservation, RecordTrace};

/// Figures of a page at most; it is some megabytes then.
const MOST_FIGURES: usize = 40;

/// Figures up to which none are folded away.
const UNFOLDED: usize = 6;

/// The whole document.
pub(super) fn of(observed: &ObservationReport<'_>) -> Document {
    let title = observed.title.map(plain).filter(|title| !title.is_empty());
    let mut document = Document {
        title: title.unwrap_or_else(|| "Observations".to_owned()),
        subtitle: vec![plain(&table::method(observed))],
        ..Document::default()
    };
    let all: usize = observed.traces.iter().map(Vec::len).sum();
    let mut left = MOST_FIGURES;
    for (row, (values, observation)) in observed.rows.iter().enumerate() {
        for channels in &observation.frequencies {
            line(&mut document, observed, values, channels);
        }
        let traces = observed.traces.get(row).map_or(&[][..], Vec::as_slice);
        let traces = traces.get(..left.min(traces.len())).unwrap_or(&[]);
        left -= traces.len();
        if let Some(channels) = observation.frequencies.first() {
            let at = plain(&table::at(observed, values, channels));
            records(&mut document, observed, traces, (&at, channels), all > UNFOLDED);
        }
    }
    if all > MOST_FIGURES {
        document.text(format!(
            "Figures of the first {MOST_FIGURES} of {all} records; run a recipe with fewer rows \
             for the others."
        ));
    }
    if !observed.warnings.is_empty() {
        document.section("Notes");
        document.blocks.push(Block::List(crate::words::lines(observed.warnings)));
    }
    document.section("Reproducing this result");
    let digests = &observed.provenance.files;
    let mut lines = vec![
        format!("gumption {}", env!("CARGO_PKG_VERSION")),
        format!("recipe, SHA-256: {}", observed.provenance.model_sha256),
    ];
    lines
        .extend(digests.iter().map(|(name, digest)| format!("{}, SHA-256: {digest}", plain(name))));
    document.blocks.push(Block::List(lines));
    document
}

/// What was found in a row at a frequency.
fn line(
    document: &mut Document,
    observed: &ObservationReport<'_>,
    values: &[f64],
    channels: &[ChannelObservation],
) {
    document.section(plain(&table::at(observed, values, channels)));
    document.table(sheets::components(observed, channels));
    document.table(sheets::channels(observed, channels));
    let made_of = sheets::made_of(observed, channels);
    if !made_of.is_empty() {
        document.sentence(&format!("u^2 of the amplitudes: {made_of}"));
    }
    let findings = table::findings(observed, channels);
    if !findings.is_empty() {
        document.blocks.push(Block::List(findings.iter().map(|said| plain(said)).collect()));
    }
}

/// The figures of a row's records.
fn records(
    document: &mut Document,
    observed: &ObservationReport<'_>,
    traces: &[RecordTrace],
    at: (&str, &[ChannelObservation]),
    folded: bool,
) {
    let drawn = traces.iter().filter_map(|trace| figures::record(observed, trace, at));
    let blocks: Vec<Block> = drawn.map(Block::Figure).collect();
    match folded && !blocks.is_empty() {
        true => {
            let title = "Waveform, fit, residuals and spectrum of each channel".to_owned();
            document.blocks.push(Block::Folded(title, blocks));
        }
        false => document.blocks.extend(blocks),
    }
}
