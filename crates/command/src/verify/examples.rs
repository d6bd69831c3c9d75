//! The published examples in the program: model files with the values that documents print, and the
//! paths of these values in the answer.

use gumption_analysis::verification::PublishedValue;
use serde::Deserialize;

/// A worked example with its published values.
#[derive(Debug)]
pub(crate) struct Example {
    pub(crate) name: String,
    /// Text of the model file.
    pub(crate) model: &'static str,
    /// Replacements of inputs, as `gumption run --set` takes them.
    pub(crate) set: Vec<String>,
    /// The document.
    pub(crate) source: String,
    pub(crate) published: Vec<PublishedValue>,
    /// What a reader of the table should know.
    pub(crate) notes: String,
}

/// A published measurement: ready file, replacements in it, published values.
#[derive(Deserialize)]
struct PublishedMeasurement {
    example: String,
    model: String,
    set: Vec<String>,
    source: String,
    published: Vec<PublishedValue>,
    notes: String,
}

/// Published examples as texts in the program.
#[derive(Clone, Copy, Debug, Default)]
pub struct PublishedExamples {
    /// Worked examples from documents: name and model file.
    pub cases: &'static [(&'static str, &'static str)],
    /// Published values, as a JSON list of measurements: the case or ready file (`model`),
    /// replacements in it (`set`), the document (`source`), the values (`published`) and notes for
    /// the reader (`notes`). May be empty.
    pub values: &'static str,
    /// Ready files that the list names besides the cases.
    pub models: &'static [(&'static str, &'static str)],
    /// Further model files as starting points, by name; their `title` and `source` describe them.
    pub more: &'static [(&'static str, &'static str)],
}

impl PublishedExamples {
    /// The model files that serve as starting points, by name.
    pub fn starting_points(&self) -> impl Iterator<Item = (&str, &str)> + Clone {
        self.cases.iter().chain(self.more).copied()
    }

    /// All with published values, in the order in which they are printed.
    ///
    /// # Errors
    /// A text cannot be read.
    pub(crate) fn with_values(&self) -> Result<Vec<Example>, String> {
        if self.values.is_empty() {
            return Ok(Vec::new());
        }
        let values: Vec<PublishedMeasurement> = serde_json::from_str(self.values)
            .map_err(|error| format!("published values: {error}"))?;
        values
            .into_iter()
            .map(|value| {
                let PublishedMeasurement { example: name, model, set, source, published, notes } =
                    value;
                let found = self.cases.iter().chain(self.models).find(|(known, _)| *known == model);
                let (_, model) = found.ok_or_else(|| format!("{name}: no file for `{model}`"))?;
                Ok(Example { name, model, set, source, published, notes })
            })
            .collect()
    }
}
