//! What a file holds that an input can take: the columns of a table, the quantities of a certificate, the
//! outputs of a saved result.

use gumption_files::{FileReader, TextKind, certificate_listing_text};
use gumption_text::{FileSource, SourceText, bytes, table};
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::LiveError;

/// A request of the call `contents`.
#[derive(Debug, Deserialize)]
pub(crate) struct ContentsRequest {
    /// The file, as the open text would name it.
    file: String,
}

/// What the file holds: `columns`, `quantities` or `outputs`.
pub(crate) fn contents(
    files: FileReader<'_>,
    folder: &dyn FileSource,
    asked: &ContentsRequest,
) -> Result<Json, LiveError> {
    let name = &asked.file;
    let refused = |why: String| LiveError::Request(format!("`{name}`: {why}"));
    let content = folder.content(name, bytes::MOST).map_err(refused)?;
    let text = bytes::text(&content).map_err(refused)?;
    let faults = |found: gumption_text::Diagnostics| LiveError::Request(found.to_string());
    if text.trim_start().starts_with('<') {
        let listed = certificate_listing_text(name, &text).map_err(faults)?;
        return Ok(json!({ "quantities": listed.results }));
    }
    if TextKind::of(&text) == TextKind::Result {
        let result = files.result_text(name, &text).map_err(faults)?;
        let outputs = result.outputs.iter();
        let outputs: Vec<Json> =
            outputs.map(|of| json!({ "name": of.name, "unit": of.unit.text() })).collect();
        return Ok(json!({ "outputs": outputs }));
    }
    // cells need not be numbers here
    let table = table::parse(&SourceText::new(name.as_str(), &text), Some(&[]));
    let table = table.map_err(|faults| {
        let faults = faults.iter().map(|(_, kind)| kind.to_string());
        refused(faults.collect::<Vec<_>>().join("; "))
    })?;
    Ok(json!({ "columns": table.columns }))
}
