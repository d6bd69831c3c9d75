//! Files to start from: an empty one, templates of measurements, published examples.

use gumption_units::nearest;
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::edit::{Edit, edited};
use crate::tree::path_of;
use crate::{Live, LiveError, gallery};

/// A request of the call `new`.
#[derive(Debug, Deserialize)]
pub(crate) struct NewRequest {
    #[serde(default)]
    example: Option<String>,
    #[serde(default)]
    template: Option<String>,
    /// The kind of an empty file: a model unless given.
    #[serde(default)]
    kind: EmptyKind,
}

/// The kinds of empty files.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum EmptyKind {
    #[default]
    Model,
    Certificate,
    Case,
}

impl EmptyKind {
    fn text(self) -> &'static str {
        match self {
            Self::Model => EMPTY,
            Self::Certificate => EMPTY_CERTIFICATE,
            Self::Case => EMPTY_CASE,
        }
    }
}

/// A model without content.
const EMPTY: &str = "{\n  \"format\": 1,\n  \"title\": \"\",\n  \"inputs\": {},\n  \"equations\": {},\n  \"outputs\": {}\n}\n";

/// A certificate without rows.
const EMPTY_CERTIFICATE: &str = "{\n  \"format\": 1,\n  \"rows\": []\n}\n";

/// A case of the gap diagnosis without data.
const EMPTY_CASE: &str = "{\n  \"format\": 1,\n  \"title\": \"\",\n  \"inputs\": {},\n  \"conditions\": {},\n  \"equations\": {},\n  \"outputs\": {},\n  \"observations\": {},\n  \"effects\": {}\n}\n";

/// The text of a new file.
pub(crate) fn new(live: &Live<'_>, asked: &NewRequest) -> Result<Json, LiveError> {
    let templates = live.catalogue.iter().filter_map(|entry| Some((entry.name(), entry.template?)));
    let title = asked.example.as_deref().and_then(gallery::title);
    let text = match (&asked.example, &asked.template) {
        (Some(name), _) => named(name, live.examples.iter().copied(), "example")?,
        (None, Some(name)) => named(name, templates, "measurement")?,
        (None, None) => asked.kind.text(),
    };
    let Some(title) = title else { return Ok(json!({ "text": text })) };
    let titled = Edit::set(path_of(["title"]), json!(title));
    let text = edited(text, &[titled]).map_err(LiveError::Internal)?;
    Ok(json!({ "text": text }))
}

fn named<'t>(
    name: &str,
    all: impl Iterator<Item = (&'t str, &'t str)>,
    what: &str,
) -> Result<&'t str, LiveError> {
    let all: Vec<(&str, &str)> = all.collect();
    if let Some((_, text)) = all.iter().find(|(of, _)| *of == name) {
        return Ok(text);
    }
    let near = nearest(name, all.iter().map(|(of, _)| *of));
    let hint = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    Err(LiveError::Request(format!("there is no {what} `{name}`{hint}")))
}
