//! The JSON Schema of the files, for editors that complete and check while a file is written.
//!
//! A schema cannot say everything: units, formulas and names that belong together are checked by
//! [`file`](crate). What it refuses, reading refuses too.

#[cfg(test)]
mod tests;

use super::{catalogue, keys};

/// The schema (draft 2020-12) as text that ends in a newline.
///
/// ```
/// let schema = gumption_files::schema::text();
/// assert!(schema.contains("\"$schema\": \"https://json-schema.org/draft/2020-12/schema\""));
/// ```
pub fn text() -> String {
    let effects = catalogue().effects.into_iter().map(|effect| effect.name).collect();
    format!("{:#}\n", keys::schema(&effects))
}
