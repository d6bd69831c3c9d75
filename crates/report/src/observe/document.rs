//! The observations as a document for a browser, for print and for GitHub.

use super::{ObservationReport, sheets, table};
use crate::document::{Block, Document};
use crate::plain;

/// The whole document.
pub(super) fn of(observed: &ObservationReport<'_>) -> Document {
    let title = observed.title.map(plain).filter(|title| !title.is_empty());
    let mut document = Document {
        title: title.unwrap_or_else(|| "Observations".to_owned()),
        subtitle: vec![plain(&table::method(observed))],
        ..Document::default()
    };
    for (values, channels) in observed.lines() {
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
    if !observed.warnings.is_empty() {
        document.section("Notes");
        let notes = observed.warnings.iter().map(|warning| plain(&warning.text));
        document.blocks.push(Block::List(notes.collect()));
    }
    document.section("To repeat this");
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
