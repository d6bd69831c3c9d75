//! A case of the gap diagnosis as a whole: a model file with observations and candidate effects.

use std::path::Path;
use std::sync::Arc;

use super::Fault;
use super::effects;
use super::model_file::{Found, ModelReader, read_file};
use super::problem::Problems;
use super::results::Results;
use super::source::Source;
use crate::task::{Case, Row, Warning};

/// A case that was read and found right.
#[derive(Debug)]
pub struct CaseFile {
    /// The case.
    pub case: Case,
    /// Notes on what was read.
    pub warnings: Vec<Warning>,
    /// The file's text.
    pub source: Arc<Source>,
    /// The content of the tables that were read, by name.
    pub files: Vec<(String, Vec<u8>)>,
}

/// Reads and checks a case.
///
/// # Errors
/// All mistakes of the file and its tables, in the order of their places.
pub fn read(path: &Path) -> Result<CaseFile, Problems> {
    read_file(path, &[], None, |reader| reader.case())
}

/// What a case's sim has in the rows of a table of conditions, which stands in the current folder.
///
/// # Errors
/// All mistakes of the file and its tables, in the order of their places.
pub fn read_at(path: &Path, conditions: &Path) -> Result<Vec<Row>, Problems> {
    read_file(path, &[], Some(conditions), |reader| {
        reader.found().map(|found| found.file.task.rows)
    })
}

impl ModelReader<'_> {
    /// The case, unless the file has mistakes.
    pub(super) fn case(&self) -> Option<CaseFile> {
        let found = self.found();
        let prior = effects::prior(&self.root);
        if self.root.get("observations").is_none() {
            let what = "a case of the gap diagnosis";
            self.root.report(Fault::MissingKey { key: "observations", what });
        }
        let Found { file, sim, observed, simulated } = found?;
        let mut warnings = file.warnings;
        let results = Results::new(self.folder);
        let candidates = match self.root.get("effects") {
            Some(member) => effects::read(self.log, member, &sim, &results, &mut warnings)?,
            None => Vec::new(),
        };
        let case = Case { task: file.task, sim, observed, simulated, candidates, prior: prior? };
        Some(CaseFile { case, warnings, source: file.source, files: file.files })
    }
}
