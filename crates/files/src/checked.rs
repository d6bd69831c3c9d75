//! Any file that a user may have written, checked.

use std::path::Path;

use super::certificate;
use super::json;
use super::model_file::{read_with, text_of};
use super::problem::{Log, Problems};
use super::recipe;
use super::{Fault, Source};

/// Checks a file: as a certificate, a recipe or a case of the gap diagnosis where it has a key that
/// only those have, else as a model.
///
/// # Errors
/// All mistakes of the file and of the files that it names, in the order of their places.
pub fn check(path: &Path) -> Result<(), Problems> {
    let name = path.display().to_string();
    match text_of(path) {
        Ok(text) => check_text(&name, &text, path.parent().unwrap_or_else(|| Path::new(""))),
        Err(message) => {
            let log = Log::new(Source::new(name, ""));
            log.report(&(0..0), Fault::Unreadable { message });
            Err(log.into_problems())
        }
    }
}

/// Checks a file's text as [`check`] does; what it names is looked for in `folder`.
///
/// # Errors
/// All mistakes of the text and of the files that it names, in the order of their places.
pub fn check_text(name: &str, text: &str, folder: &Path) -> Result<(), Problems> {
    if let Ok(root) = json::parse(&Source::new(name, text)) {
        if recipe::is_meant(&root) {
            return recipe::check_text(name, text, folder);
        }
        if certificate::is_meant(&root) {
            return certificate::read_text(name, text, folder).map(|_| ());
        }
    }
    read_with(name, text, folder, (&[], None), |reader| reader.checked())
}
