//! What a file is read with, whatever its kind: the measurements that it may name, and where the files
//! that it names are.

use std::path::{Path, PathBuf};

use super::readings_file::NewReadings;
use gumption_engine::model::typed::Catalogue;
use gumption_engine::task::Trials;
use gumption_text::{FileSource, Folder};

/// What a file is read with; [`FileReader`](super::FileReader) says what each of it is for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Context<'c> {
    /// The measurements that files may name.
    pub(super) catalogue: &'c Catalogue,
    pub(super) allowed: &'c [PathBuf],
    pub(super) held: &'c [(String, Vec<u8>)],
    pub(super) source: Option<&'c dyn FileSource>,
    pub(super) within: Option<&'c Path>,
    /// Whether saved results that were changed are taken.
    pub(super) changed_results: bool,
    pub(super) trials: Option<Trials>,
    /// Readings that replace those of model files.
    pub(super) readings: Option<NewReadings<'c>>,
}

impl<'c> Context<'c> {
    /// Files that may name these measurements, and files below their own folder.
    pub(super) fn new(catalogue: &'c Catalogue) -> Self {
        Self {
            catalogue,
            allowed: &[],
            held: &[],
            source: None,
            within: None,
            changed_results: false,
            trials: None,
            readings: None,
        }
    }

    /// The trials of a model file that says so many.
    pub(super) fn trials(self, of_file: Trials) -> Trials {
        self.trials.unwrap_or(of_file)
    }

    /// The folder that a file's names are relative to.
    pub(super) fn folder<'f>(self, path: &'f Path) -> Folder<'f>
    where
        'c: 'f,
    {
        Folder::new(path, self.allowed).holding(self.held).sourced(self.source).within(self.within)
    }
}
