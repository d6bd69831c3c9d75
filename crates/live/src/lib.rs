//! The live page: its answers while a model is edited, and the page itself.
//!
//! Every answer is text to text: nothing here opens a file, starts a thread, reads a clock or uses
//! a network, so that a server on the user's machine and a browser alone give the same answers.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod answer;
mod audit;
mod certificate;
mod controls;
mod description;
mod diagnostics;
mod edit;
mod examples;
pub mod gallery;
mod german;
mod held;
mod import;
mod inputs;
mod kinds;
mod language;
mod named;
mod open;
mod outputs;
pub mod page;
mod quantity;
mod reshape;
mod table;
#[cfg(test)]
mod tests;
mod tree;
mod ways;

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption_engine::model::typed::Catalogue;
use gumption_files::FileReader;
use serde::de::DeserializeOwned;
use serde_json::json;

pub use description::FileDescription;
pub use diagnostics::mistakes;
pub use gumption_text::FileSource;
pub use held::HeldFiles;

/// Maximum size of a text that can be edited on the page, in bytes.
const MOST_TEXT: usize = 5_000_000;

/// Answers about models that are being edited.
#[derive(Clone, Debug)]
pub struct Live<'a> {
    catalogue: &'a Catalogue,
    examples: Vec<(&'a str, &'a str)>,
}

/// Why a call has no answer. A model with errors has one: the list of them.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LiveError {
    /// There is no call of that name.
    Unknown(String),
    /// The request does not match the call; the reason, in a sentence.
    Request(String),
    /// An error of the program itself.
    Internal(String),
}

impl fmt::Display for LiveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => write!(f, "there is no call `{name}`"),
            Self::Request(why) | Self::Internal(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for LiveError {}

impl<'a> Live<'a> {
    /// Answers for files that may name these measurements; `examples` are model files as starting
    /// points, by name.
    pub fn new(
        catalogue: &'a Catalogue,
        examples: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Self {
        Self { catalogue, examples: examples.into_iter().collect() }
    }

    /// The answer to a call: both are JSON texts. `folder` gives the files that a model names; when
    /// `stop` becomes true, what has been computed so far is the answer.
    ///
    /// | call | request | answer |
    /// |---|---|---|
    /// | `answer` | `text`, `name`, `edits`, `trials`, `full`, `narrow`, `output`, `row`, `lang` | errors; or inputs, outputs, results, parts of the page; of a certificate the models of its rows |
    /// | `audit` | `text`, `name`, `lang` | `html`: what the Type B assumptions decide |
    /// | `edit` | `text`, `edits` | `text` |
    /// | `reshape` | `text`, `path`, `way`, `kept` | `text` with another way in which an input is known |
    /// | `new` | `example`, `template` or nothing | `text` |
    /// | `examples` | | `large`, `fields`: starting points with titles and sources by field of work |
    /// | `kinds` | | distributions with their keys, ways in which inputs are known, units |
    /// | `effects` | | the ready-made effects of cases |
    /// | `table` | `text` | headings and numbers of a pasted table |
    /// | `contents` | `file` | `columns`, `quantities` or `outputs` of a file that an input can name |
    /// | `model` | `model`: a name as a certificate has it | its outputs, inputs, conditions |
    /// | `import` | `name`, `base64`, `options`, `lang` | `sheet`: its cells; `text`, `notes`; or `questions`, `mistakes` |
    ///
    /// # Errors
    /// The call does not exist, or the request does not match it.
    pub fn call(
        &self,
        name: &str,
        request: &str,
        folder: &dyn FileSource,
        stop: &Arc<AtomicBool>,
    ) -> Result<String, LiveError> {
        let files = FileReader::new(self.catalogue).reading(folder);
        let answer = match name {
            "answer" => answer::answer(files, folder, &asked(request)?, stop)?,
            "audit" => audit::audited(files, &asked(request)?, stop)?,
            "edit" => {
                let asked: edit_call::EditRequest = asked(request)?;
                let text = quantity::edited(limited(&asked.text)?, &asked.edits);
                json!({ "text": text.map_err(LiveError::Request)? })
            }
            "reshape" => reshape::reshaped(files, &asked(request)?)?,
            "new" => examples::new(self, &asked(request)?)?,
            "examples" => gallery::list(self),
            "kinds" => kinds::all(),
            "contents" => named::contents(files, folder, &asked(request)?)?,
            "model" => certificate::contents(files, &asked(request)?),
            "effects" => json!(gumption_files::catalogue().effects),
            "table" => table::pasted(&asked(request)?)?,
            "import" => import::imported(&asked(request)?)?,
            other => return Err(LiveError::Unknown(other.to_owned())),
        };
        Ok(answer.to_string())
    }
}

mod edit_call {
    use serde::Deserialize;

    /// A request of the call `edit`.
    #[derive(Debug, Deserialize)]
    pub(super) struct EditRequest {
        pub(super) text: String,
        pub(super) edits: Vec<super::edit::Edit>,
    }
}

/// Parses the request of a call.
fn asked<T: DeserializeOwned>(request: &str) -> Result<T, LiveError> {
    serde_json::from_str(request).map_err(|why| LiveError::Request(format!("the request: {why}")))
}

/// Checks the size of a text.
fn limited(text: &str) -> Result<&str, LiveError> {
    if text.len() <= MOST_TEXT {
        return Ok(text);
    }
    let most = MOST_TEXT / 1_000_000;
    Err(LiveError::Request(format!(
        "the text is larger than {most} MB, which the page takes at most"
    )))
}
