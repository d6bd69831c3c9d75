//! Any file that a user may have written, checked.

use std::path::Path;

use super::certificate;
use super::costs;
use super::diagnostics::Diagnostics;
use super::json;
use super::model_reader::{ModelOptions, read_with};
use super::reader::FileReader;
use super::recipe;
use super::source::SourceText;

/// Checks a text: as a certificate, a recipe, a file of costs or a case of the gap diagnosis where it has a key that
/// only those have, else as a model.
pub(super) fn check_text(
    files: FileReader<'_>,
    name: &str,
    text: &str,
    folder: &Path,
) -> Result<(), Diagnostics> {
    if let Ok(root) = json::parse(&SourceText::new(name, text)) {
        if recipe::is_meant(&root) {
            return recipe::check_text(name, text, files.folder(folder));
        }
        if costs::is_meant(&root) {
            return costs::check_text(name, text);
        }
        if certificate::is_meant(&root) {
            return files.certificate_text(name, text, folder).map(|_| ());
        }
    }
    read_with(name, text, folder, ModelOptions::with(files), |reader| reader.checked())
}
