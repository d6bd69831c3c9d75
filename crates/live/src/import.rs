//! Budgets of spreadsheets as model files.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gumption_foreign::{ImportOptions, import_budget_bytes};
use gumption_report::words;
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::LiveError;
use gumption_report::words::Language;

/// A request of the call `import`.
#[derive(Debug, Deserialize)]
pub(crate) struct ImportRequest {
    /// The file's name, whose extension gives its kind.
    name: String,
    /// Its content.
    base64: String,
    /// The language of the notes.
    #[serde(default)]
    lang: Language,
}

/// The model file of a budget.
pub(crate) fn imported(asked: &ImportRequest) -> Result<Json, LiveError> {
    let bytes = STANDARD
        .decode(&asked.base64)
        .map_err(|why| LiveError::Request(format!("`base64`: {why}")))?;
    // only a name, so that no folder is searched
    let name = Path::new(&asked.name).file_name().unwrap_or_default();
    match import_budget_bytes(Path::new(name), bytes, &ImportOptions::default()) {
        Ok(made) => {
            let language = asked.lang;
            let notes = made.notes.iter().map(|note| words::sentence(note, language));
            Ok(json!({"text": made.text, "notes": notes.collect::<Vec<_>>()}))
        }
        Err(found) => {
            let found: Vec<String> =
                found.diagnostics.0.iter().take(20).map(ToString::to_string).collect();
            Err(LiveError::Request(found.join("\n")))
        }
    }
}
