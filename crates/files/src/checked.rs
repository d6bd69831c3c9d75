//! Any file that a user may have written, checked.

use std::path::Path;

use super::certificate;
use super::diagnostics::Diagnostics;
use super::json;
use super::model_reader::{ModelOptions, read_with};
use super::open::open;
use super::recipe;
use super::source::SourceText;

/// Checks a file: as a certificate, a recipe or a case of the gap diagnosis where it has a key that
/// only those have, else as a model.
///
/// # Errors
/// All mistakes of the file and of the files that it names, in the order of their places.
pub fn check(path: &Path) -> Result<(), Diagnostics> {
    open(path, check_text)
}

/// Checks a file's text as [`check`] does; what it names is looked for in `folder`.
///
/// # Errors
/// All mistakes of the text and of the files that it names, in the order of their places.
pub fn check_text(name: &str, text: &str, folder: &Path) -> Result<(), Diagnostics> {
    if let Ok(root) = json::parse(&SourceText::new(name, text)) {
        if recipe::is_meant(&root) {
            return recipe::check_text(name, text, folder);
        }
        if certificate::is_meant(&root) {
            return certificate::read_text(name, text, folder).map(|_| ());
        }
    }
    read_with(name, text, folder, ModelOptions::default(), |reader| reader.checked())
}
