//! All files that may name typed measurements, read with a catalogue of these.

use std::path::{Path, PathBuf};

use super::case::{self, CaseFile};
use super::certificate::{self, CertificateFile};
use super::checked;
use super::context::Context;
use super::either::{self, ModelOrResult};
use super::model_file::{self, ModelFile};
use super::open::open;
use super::overrides::Override;
use super::readings_file::{NewReadings, ReadingsFile};
use super::recipe::{self, RecipeFile};
use super::result::{self, ResultFile};
use gumption_engine::model::typed::Catalogue;
use gumption_engine::task::{Row, Trials, Warning};
use gumption_text::{Diagnostics, FileSource};

/// Reads files that may name the typed measurements of a catalogue: the built-in ones
/// ([`FileReader::default`]), or those of one's own as well.
///
/// Some methods have a function that does the same with the built-in measurements. A text's `name` is
/// used in messages, and the files that it names are looked for in `folder`.
///
/// # Errors
/// Each method gives all mistakes of the file and of those that it names, in the order of their
/// places, those of the file first.
#[derive(Clone, Copy, Debug)]
pub struct FileReader<'c>(Context<'c>);

impl Default for FileReader<'static> {
    fn default() -> Self {
        Self::new(gumption_measurements::catalogue())
    }
}

#[allow(clippy::missing_errors_doc)] // said of all of them at the type
impl<'c> FileReader<'c> {
    /// Readers of files that may name these measurements.
    pub fn new(catalogue: &'c Catalogue) -> Self {
        Self(Context::new(catalogue))
    }

    /// The same for files that may name others below these folders too. Without them a file names
    /// files below its own folder, or below the nearest folder above that holds an (empty) file
    /// `.gumption-root`; others are refused, since a file may come from a stranger.
    #[must_use]
    pub fn allowing(self, folders: &'c [PathBuf]) -> Self {
        Self(Context { allowed: folders, ..self.0 })
    }

    /// The same with files in memory: where a file names one of these names, it is this content, and
    /// nothing is looked for on the disk. So a program hands over tables, samples and saved results
    /// that it has made itself.
    ///
    /// ```
    /// use std::path::Path;
    /// use gumption_files::FileReader;
    ///
    /// let held = [("lengths.csv".to_owned(), b"L\n1\n2\n".to_vec())];
    /// let model = r#"{"format": 1, "inputs": {"a": {"unit": "mm", "distribution": "constant", "value": 3}},
    ///     "conditions": {"file": "lengths.csv", "units": {"L": "mm"}},
    ///     "equations": {"y": "a + L"}, "outputs": {"y": {"unit": "mm"}}}"#;
    /// let file = FileReader::default().holding(&held).model_text("m", model, Path::new(""), &[])?;
    /// assert_eq!(file.task.rows.len(), 2);
    /// # Ok::<(), gumption_text::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn holding(self, files: &'c [(String, Vec<u8>)]) -> Self {
        Self(Context { held: files, ..self.0 })
    }

    /// The same for files of a folder that was opened, and nothing above it: a `.gumption-root` above
    /// that folder allows nothing.
    #[must_use]
    pub fn within(self, folder: Option<&'c Path>) -> Self {
        Self(Context { within: folder, ..self.0 })
    }

    /// The same with a source that the tables, samples, results, certificates and model files come from
    /// which a file names; nothing of them is looked for on the disk. Recordings are.
    #[must_use]
    pub fn reading(self, source: &'c dyn FileSource) -> Self {
        Self(Context { source: Some(source), ..self.0 })
    }

    /// The same, taking saved results that were changed since they were written, with a note, where
    /// `accepted`. What is not consistent is refused all the same.
    #[must_use]
    pub fn accepting_changed_results(self, accepted: bool) -> Self {
        Self(Context { changed_results: accepted, ..self.0 })
    }

    /// The same for a run with so many trials, whatever a model file says: what trials alone need is not
    /// asked for where there are none.
    #[must_use]
    pub fn making(self, trials: Option<Trials>) -> Self {
        Self(Context { trials, ..self.0 })
    }

    /// The same with readings that replace those of the model file, or of the model files of a
    /// certificate: columns by the names of inputs whose distribution is `readings`, a line for each
    /// reading.
    ///
    /// ```
    /// use std::path::Path;
    /// use gumption_files::{FileReader, ReadingsFile};
    ///
    /// let today = ReadingsFile::of("today.csv", b"V [mV]\n5011\n5013\n5015\n".to_vec())?;
    /// let model = r#"{"format": 1,
    ///     "inputs": {"V": {"unit": "V", "distribution": "readings", "values": [5.0, 5.1, 5.2]}},
    ///     "equations": {"y": "2*V"}, "outputs": {"y": {"unit": "V"}}}"#;
    /// let file = FileReader::default().with_readings(Some(&today));
    /// let file = file.model_text("m", model, Path::new(""), &[])?;
    /// assert_eq!(file.task.rows[0].distributions[0].mean(), 5.013);
    /// # Ok::<(), gumption_text::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn with_readings(self, readings: Option<&'c ReadingsFile>) -> Self {
        let readings = readings.map(|file| NewReadings { file, model: None });
        Self(Context { readings, ..self.0 })
    }

    /// A model file, with values in place of some of its own.
    pub fn model(self, path: &Path, overrides: &[Override]) -> Result<ModelFile, Diagnostics> {
        model_file::read(self.0, path, overrides)
    }

    /// A model file's text, with values in place of some of its own.
    pub fn model_text(
        self,
        name: &str,
        text: &str,
        folder: &Path,
        overrides: &[Override],
    ) -> Result<ModelFile, Diagnostics> {
        model_file::read_text(self.0, name, text, folder, overrides)
    }

    /// A model file that a file of this folder names.
    pub fn named_model(self, name: &str, folder: &Path) -> Result<ModelFile, String> {
        match model_file::named(self.0, self.0.folder(folder), name, &[]) {
            Ok(Ok(file)) => Ok(file),
            Ok(Err(found)) => Err(found.0.first().map_or_else(String::new, |of| of.message())),
            Err(reason) => Err(reason.to_string()),
        }
    }

    /// A model file or a saved result: a file with the key `result` is one.
    pub fn either(self, path: &Path) -> Result<ModelOrResult, Diagnostics> {
        open(path, |name, text, folder| self.either_text(name, text, folder))
    }

    /// A text as [`FileReader::either`] reads a file.
    pub fn either_text(
        self,
        name: &str,
        text: &str,
        folder: &Path,
    ) -> Result<ModelOrResult, Diagnostics> {
        either::read_text(self.0, name, text, folder)
    }

    /// A case of the gap diagnosis.
    pub fn case(self, path: &Path) -> Result<CaseFile, Diagnostics> {
        open(path, |name, text, folder| self.case_text(name, text, folder))
    }

    /// A case's text.
    pub fn case_text(self, name: &str, text: &str, folder: &Path) -> Result<CaseFile, Diagnostics> {
        case::read_text(self.0, name, text, folder)
    }

    /// What a case's sim has in the rows of a table of conditions, which stands in the current
    /// folder.
    pub fn case_at(self, path: &Path, conditions: &Path) -> Result<Vec<Row>, Diagnostics> {
        open(path, |name, text, folder| self.case_text_at(name, text, folder, conditions))
    }

    /// What the sim of a case's text has in the rows of a table of conditions, which stands in the
    /// current folder.
    pub fn case_text_at(
        self,
        name: &str,
        text: &str,
        folder: &Path,
        conditions: &Path,
    ) -> Result<Vec<Row>, Diagnostics> {
        case::read_at(self.0, name, text, folder, conditions)
    }

    /// A saved result's text.
    pub fn result_text(self, name: &str, text: &str) -> Result<ResultFile, Diagnostics> {
        result::read_text(self.0, name, text)
    }

    /// A recipe; its recordings are opened later.
    pub fn recipe(self, path: &Path) -> Result<RecipeFile, Diagnostics> {
        open(path, |name, text, folder| self.recipe_text(name, text, folder))
    }

    /// A recipe's text.
    pub fn recipe_text(
        self,
        name: &str,
        text: &str,
        folder: &Path,
    ) -> Result<RecipeFile, Diagnostics> {
        recipe::read_text(name, text, (self.0, self.0.folder(folder)))
    }

    /// A certificate file with its model files.
    pub fn certificate(self, path: &Path) -> Result<CertificateFile, Diagnostics> {
        open(path, |name, text, folder| self.certificate_text(name, text, folder))
    }

    /// A certificate file's text with its model files.
    pub fn certificate_text(
        self,
        name: &str,
        text: &str,
        folder: &Path,
    ) -> Result<CertificateFile, Diagnostics> {
        certificate::read_text(self.0, name, text, folder)
    }

    /// Checks a file: as a certificate, a recipe or a case of the gap diagnosis where it has a key
    /// that only those have, else as a model. What is right and seldom meant is handed back.
    pub fn check(self, path: &Path) -> Result<Vec<Warning>, Diagnostics> {
        open(path, |name, text, folder| self.check_text(name, text, folder))
    }

    /// Checks a file's text as [`FileReader::check`] does.
    pub fn check_text(
        self,
        name: &str,
        text: &str,
        folder: &Path,
    ) -> Result<Vec<Warning>, Diagnostics> {
        checked::check_text(self.0, name, text, folder)
    }
}

macro_rules! with_built_in_measurements {
    ($($name:ident = $method:ident($($argument:ident: $kind:ty),*) -> $read:ty;)*) => {
        $(
            #[doc = concat!("[`FileReader::", stringify!($method), "`] with the built-in measurements.")]
            ///
            /// # Errors
            /// All mistakes, in the order of their places.
            pub fn $name($($argument: $kind),*) -> Result<$read, Diagnostics> {
                FileReader::default().$method($($argument),*)
            }
        )*
    };
}

with_built_in_measurements! {
    read = model(path: &Path, overrides: &[Override]) -> ModelFile;
    read_text = model_text(name: &str, text: &str, folder: &Path, overrides: &[Override]) -> ModelFile;
    read_case = case(path: &Path) -> CaseFile;
    read_certificate = certificate(path: &Path) -> CertificateFile;
    read_result = result_text(name: &str, text: &str) -> ResultFile;
    read_recipe = recipe(path: &Path) -> RecipeFile;
    read_recipe_text = recipe_text(name: &str, text: &str, folder: &Path) -> RecipeFile;
    check = check(path: &Path) -> Vec<Warning>;
    check_text = check_text(name: &str, text: &str, folder: &Path) -> Vec<Warning>;
}
