//! Budgets of spreadsheets as model files.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gumption_foreign::{ImportOptions, Question, RefusedBudget, read_budget, sheet_names};
use gumption_report::words::{self, Language};
use gumption_text::{Diagnostic, DiagnosticKind};
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::LiveError;
use crate::controls;

/// Errors of an answer, at most.
const MOST: usize = 20;

/// A request of the call `import`.
#[derive(Debug, Deserialize)]
pub(crate) struct ImportRequest {
    /// The file's name, whose extension gives its kind.
    name: String,
    /// Its content.
    base64: String,
    /// What the user has said of the sheet.
    #[serde(default)]
    options: ImportOptions,
    /// The language of the notes.
    #[serde(default)]
    lang: Language,
}

/// The cells of a sheet with the model file of its budget, or with what is not clear.
pub(crate) fn imported(asked: &ImportRequest) -> Result<Json, LiveError> {
    let bytes = STANDARD
        .decode(&asked.base64)
        .map_err(|why| LiveError::Request(format!("`base64`: {why}")))?;
    // only a name, so that no folder is searched
    let name = Path::new(Path::new(&asked.name).file_name().unwrap_or_default());
    let sheets = sheet_names(name, bytes.clone());
    let (sheet, made) = read_budget(name, bytes, &asked.options);
    let mut answer = json!({ "sheets": sheets, "sheet": sheet });
    match made {
        Ok(made) => {
            let language = asked.lang;
            let notes = made.notes.iter().map(|note| words::sentence(note, language));
            answer["notes"] = json!(notes.collect::<Vec<_>>());
            answer["text"] = json!(made.text);
        }
        Err(RefusedBudget { diagnostics, questions }) => {
            let sentences: Vec<String> = questions.iter().map(Question::to_string).collect();
            let is_mistake = |of: &&Diagnostic| !sentences.contains(&of.message());
            let mistakes = diagnostics.0.iter().filter(is_mistake).take(MOST).map(mistake);
            answer["mistakes"] = json!(mistakes.collect::<Vec<_>>());
            answer["questions"] =
                json!(questions.iter().take(MOST).map(question).collect::<Vec<_>>());
        }
    }
    Ok(answer)
}

/// What is asked, with the rows that it is about and the controls of the page that answer it.
fn question(of: &Question) -> Json {
    json!({
        "about": of.about,
        "readings": of.readings,
        "rows": [of.rows.start(), of.rows.end()],
        "controls": controls::of(&of.option),
    })
}

/// An error with its row, if it is one of the table.
fn mistake(of: &Diagnostic) -> Json {
    let row = matches!(of.kind, DiagnosticKind::Table { .. }).then(|| of.position().0);
    let message = of.message();
    json!({ "row": row, "controls": controls::of(&message), "message": message })
}
