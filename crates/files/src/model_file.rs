//! A model file as a whole.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::context::Context;
use super::model_reader::{ModelOptions, read_with};
use super::model_readings::ModelReadings;
use super::open::{open, text};
use super::overrides::Override;
use super::readings_file::NewReadings;
use gumption_engine::task::{Evidence, Task, Warning};
use gumption_text::{
    Diagnostic, DiagnosticKind, Diagnostics, FileSource, Folder, SourceText, bytes,
};

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

/// The files beside a model that lies in another folder than the file that names it.
#[derive(Debug)]
struct FilesBeside<'a> {
    above: &'a str,
    source: &'a dyn FileSource,
}

impl FileSource for FilesBeside<'_> {
    fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, String> {
        match self.above {
            "" => self.source.content(name, most),
            above => self.source.content(&format!("{above}/{name}"), most),
        }
    }
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

/// A model file that a file of a folder names: from memory, from a source or from the disk; or why
/// there is none.
pub(super) fn named(
    files: Context<'_>,
    folder: Folder<'_>,
    name: &str,
    overrides: &[Override],
) -> Result<Result<ModelFile, Diagnostics>, DiagnosticKind> {
    let readings = files.readings.map(|new| NewReadings { model: Some(name), ..new });
    let files = Context { readings, ..files };
    if !folder.holds(name) {
        return Ok(read(files, &folder.file(name)?, overrides));
    }
    let content = folder.content(name, bytes::MOST)?;
    let text = text(content).map_err(|message| DiagnosticKind::Unreadable { message })?;
    // what it names lies beside it
    let above = name.rsplit_once('/').map_or("", |(above, _)| above);
    let beside = folder.source().map(|source| FilesBeside { above, source });
    let files = match &beside {
        Some(beside) => Context { source: Some(beside), ..files },
        None => files,
    };
    Ok(read_text(files, name, &text, Path::new(above), overrides))
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
