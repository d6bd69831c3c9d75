//! Any file that a user may have written, checked.

use std::path::Path;

use super::certificate;
use super::context::Context;
use super::costs;
use super::model_reader::{ModelOptions, read_with};
use super::open::is_table_of_results;
use super::recipe;
use super::result;
use gumption_engine::task::Warning;
use gumption_text::json::{self, Json};
use gumption_text::{Diagnostics, SourceText};

/// What a file is, as its keys or its header tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextKind {
    /// A model file.
    Model,
    /// A case of the gap diagnosis: a model file with observations.
    Case,
    /// A certificate file.
    Certificate,
    /// A recipe of recordings.
    Recipe,
    /// A file of costs.
    Costs,
    /// A result that `gumption run --save` wrote.
    Result,
    /// A table of results to be compared.
    Comparison,
    /// Anything else.
    Other,
}

impl TextKind {
    /// The kind of a text. One that is not JSON, as while it is typed, is a model where it begins
    /// like an object.
    pub fn of(text: &str) -> Self {
        let start = text.trim_start_matches('\u{feff}').trim_start();
        if !start.starts_with('{') {
            return if is_table_of_results(text) { Self::Comparison } else { Self::Other };
        }
        let Ok(root) = json::parse(&SourceText::new("", text)) else { return Self::Model };
        let Json::Object(members) = &root.value else { return Self::Other };
        let has = |key: &str| members.iter().any(|member| member.key == key);
        if recipe::is_meant(&root) {
            Self::Recipe
        } else if costs::is_meant(&root) {
            Self::Costs
        } else if certificate::is_meant(&root) {
            Self::Certificate
        } else if result::is_meant(&root) || has("gumption") {
            Self::Result
        } else if has("observations") {
            Self::Case
        } else if has("inputs") || has("outputs") || has("equations") || has("model") {
            Self::Model
        } else {
            Self::Other
        }
    }

    /// The name that programs use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Model => "model",
            Self::Case => "case",
            Self::Certificate => "certificate",
            Self::Recipe => "recipe",
            Self::Costs => "costs",
            Self::Result => "result",
            Self::Comparison => "comparison",
            Self::Other => "other",
        }
    }
}

/// Checks a text: as a certificate, a recipe, a file of costs, a saved result or a case of the gap
/// diagnosis where it has a key that only those have, else as a model. Hands back the notes on it.
pub(super) fn check_text(
    files: Context<'_>,
    name: &str,
    text: &str,
    folder: &Path,
) -> Result<Vec<Warning>, Diagnostics> {
    if let Ok(root) = json::parse(&SourceText::new(name, text)) {
        if recipe::is_meant(&root) {
            return recipe::check_text(name, text, (files, files.folder(folder)))
                .map(|()| Vec::new());
        }
        if costs::is_meant(&root) {
            return costs::check_text(name, text).map(|()| Vec::new());
        }
        if result::is_meant(&root) {
            return result::read_text(files, name, text).map(|file| file.warnings);
        }
        if certificate::is_meant(&root) {
            return certificate::read_text(files, name, text, folder).map(|file| file.warnings);
        }
    }
    read_with(name, text, folder, ModelOptions::with(files), |reader| reader.checked())
}
