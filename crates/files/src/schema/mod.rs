//! The JSON Schema of the files, for editors that complete and check while a file is written.
//!
//! A schema cannot say everything: units, formulas and names that belong together are checked by
//! [`file`](crate). What it refuses, reading refuses too.

#[cfg(test)]
mod tests;

use serde_json::Value;

use super::{catalogue, keys};

/// The schema (draft 2020-12) as text that ends in a newline.
///
/// ```
/// let schema = gumption_files::schema::text();
/// assert!(schema.contains("\"$schema\": \"https://json-schema.org/draft/2020-12/schema\""));
/// ```
pub fn text() -> String {
    format!("{:#}\n", value())
}

/// The schema as a JSON value.
pub fn value() -> Value {
    let effects = catalogue().effects.into_iter().map(|effect| effect.name).collect();
    keys::schema(&effects)
}

/// A distribution as files name it.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct NamedDistribution {
    /// Its name.
    pub name: &'static str,
    /// Its other names.
    pub aliases: &'static [&'static str],
    /// Its own keys, beside those that every input has.
    pub keys: &'static [&'static str],
}

/// The distributions in the order of JCGM 101, Table 1, then the others; `input-NAME` is the
/// definition of an input that has it in the schema.
pub fn distributions() -> Vec<NamedDistribution> {
    let named = |shape: &'static keys::FileShape| NamedDistribution {
        name: shape.name,
        aliases: shape.aliases,
        keys: shape.fields,
    };
    keys::SHAPES.iter().map(named).collect()
}
