//! A model file as a whole.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::context::Context;
use super::model_reader::{ModelOptions, read_with};
use super::model_readings::ModelReadings;
use super::open::open;
use super::overrides::Override;
use gumption_engine::task::{Evidence, Task, Warning};
use gumption_text::{Diagnostic, DiagnosticKind, Diagnostics, SourceText};

/// A model file that was read and found right.
#[derive(Debug)]
pub struct ModelFile {
    /// The evaluation that it asks for.
    pub task: Task,
    /// Notes on what was read.
    pub warnings: Vec<Warning>,
    /// The file's text.
    pub source: Arc<SourceText>,
    /// The content of the tables that were read, by name.
    pub files: Vec<(String, Vec<u8>)>,
    /// Where each output stands in the file, for messages of the evaluation.
    pub output_places: Vec<Range<usize>>,
    /// Readings that what is assumed about inputs can be tested against.
    pub evidence: Vec<Evidence>,
    /// Which inputs have readings.
    pub readings: ModelReadings,
}

/// Reads and checks a model file.
pub(super) fn read(
    files: Context<'_>,
    path: &Path,
    overrides: &[Override],
) -> Result<ModelFile, Diagnostics> {
    open(path, |name, text, folder| read_text(files, name, text, folder, overrides))
}

/// Reads and checks a model file's text.
pub(super) fn read_text(
    files: Context<'_>,
    name: &str,
    text: &str,
    folder: &Path,
    overrides: &[Override],
) -> Result<ModelFile, Diagnostics> {
    let options = ModelOptions { files, overrides, at: None };
    read_with(name, text, folder, options, |reader| Some(reader.found()?.file))
}

impl ModelFile {
    /// What went wrong in the evaluation, as a mistake of the file: everything but a failing system
    /// follows from what it says.
    pub fn evaluation_failed(&self, message: String) -> Diagnostics {
        let (source, span) = self.output_place(0);
        Diagnostics(vec![Diagnostic { source, span, kind: DiagnosticKind::Evaluation { message } }])
    }

    /// The place of an output in the file, for messages of the evaluation.
    pub fn output_place(&self, output: usize) -> (Arc<SourceText>, Range<usize>) {
        let span = self.output_places.get(output).cloned().unwrap_or(0..0);
        (self.source.clone(), span)
    }
}
