//! The published examples that ship with the program: model files with the values that documents
//! print, and where these stand in the answer.

use gumption_analysis::verification::PublishedValue;
use serde::Deserialize;

/// A worked example with its published values.
#[derive(Debug)]
pub(super) struct Example {
    pub(super) name: String,
    /// Text of the model file.
    pub(super) model: &'static str,
    /// Replacements of inputs, as `gumption run --set` takes them.
    pub(super) set: Vec<String>,
    /// The document.
    pub(super) source: String,
    pub(super) published: Vec<PublishedValue>,
    /// What a reader of the table should know.
    pub(super) notes: String,
}

/// The values of one of the files under `tests/cases`; other keys are for other checks.
#[derive(Deserialize)]
struct Expectation {
    source: String,
    published: Vec<PublishedValue>,
    notes: String,
}

/// A measurement of a paper: a ready file, replacements in it, published values.
#[derive(Deserialize)]
struct PublishedMeasurement {
    example: String,
    model: String,
    set: Vec<String>,
    source: String,
    published: Vec<PublishedValue>,
    notes: String,
}

/// Published examples as texts, which a program carries with it.
#[derive(Clone, Copy, Debug, Default)]
pub struct PublishedExamples {
    /// Worked examples: name, model file, and what is published of it.
    pub cases: &'static [(&'static str, &'static str, &'static str)],
    /// Measurements of papers as a JSON list: ready file, replacements in it, published values.
    pub measurements: &'static str,
    /// The ready files that the list names.
    pub models: &'static [(&'static str, &'static str)],
    /// Further model files to start from, by name; what they are is in their `title` and `source`.
    pub more: &'static [(&'static str, &'static str)],
}

/// All examples, in the order in which they are printed.
///
/// # Errors
/// A text that cannot be read.
pub(super) fn all(published: &PublishedExamples) -> Result<Vec<Example>, String> {
    let PublishedExamples { cases, measurements, models, .. } = published;
    let mut examples = Vec::new();
    for (name, model, expected) in *cases {
        let Expectation { source, published, notes } =
            serde_json::from_str(expected).map_err(|error| format!("{name}: {error}"))?;
        let (name, set) = ((*name).to_owned(), Vec::new());
        examples.push(Example { name, model, set, source, published, notes });
    }
    if measurements.is_empty() {
        return Ok(examples);
    }
    let papers: Vec<PublishedMeasurement> = serde_json::from_str(measurements)
        .map_err(|error| format!("measurements of papers: {error}"))?;
    for PublishedMeasurement { example: name, model, set, source, published, notes } in papers {
        let found = models.iter().find(|(known, _)| *known == model);
        let (_, model) = found.ok_or_else(|| format!("{name}: no file for `{model}`"))?;
        examples.push(Example { name, model, set, source, published, notes });
    }
    Ok(examples)
}
