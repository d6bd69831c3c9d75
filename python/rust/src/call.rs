//! Commands as functions, and the command line as a program.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use gumption::command::{Exit, Failure, GivenFile};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::application;
use crate::errors::failed;
use crate::model::Model;
use crate::supervised::{supervised, supervised_within};

/// Runs a command and gives back what it would have printed, what it would have said on standard
/// error, and whether its answer was "yes" where it asks something.
#[pyfunction]
#[pyo3(signature = (arguments, model=None, text=None, held=Vec::new()))]
pub(crate) fn call(
    py: Python<'_>,
    arguments: Vec<OsString>,
    model: Option<&Bound<'_, Model>>,
    text: Option<String>,
    held: Vec<(String, Vec<u8>)>,
) -> PyResult<(Py<PyBytes>, String, bool)> {
    let input = model.map(|model| {
        let source = &model.get().source;
        GivenFile {
            name: source.name.clone(),
            text: source.text.clone(),
            folder: source.folder.clone(),
            held: source.held.clone(),
            ..GivenFile::default()
        }
    });
    // what stands for standard input is called so
    let stdin = |text| GivenFile { name: "<stdin>".to_owned(), text, held, ..GivenFile::default() };
    let input = input.or_else(|| text.map(stdin));
    let called = supervised(py, None, |watch| {
        application().call(arguments, input, std::sync::Arc::clone(&watch.stop))
    })?;
    let answered = called.map_err(|failure| failed(py, &failure))?;
    let bytes = PyBytes::new(py, &answered.answer).unbind();
    Ok((bytes, answered.notes, answered.exit == Exit::Done))
}

/// The text of a case of the gap diagnosis, a file's or a given one, with the files that it names, by
/// their names: all that it takes to read it elsewhere.
#[pyfunction]
#[pyo3(signature = (path, text=None))]
#[allow(clippy::type_complexity)] // what stands in the line above
pub(crate) fn case_source(
    py: Python<'_>,
    path: PathBuf,
    text: Option<String>,
) -> PyResult<(String, Vec<(String, Py<PyBytes>)>)> {
    let files = application().files();
    let read = supervised_within(py, &AtomicBool::new(false), || match &text {
        Some(text) => files.case_text("<stdin>", text, Path::new("")),
        None => files.case(&path),
    })?;
    let file = read.map_err(|found| failed(py, &Failure::Diagnostics(found)))?;
    let named = file.files.iter();
    let named = named.map(|(name, bytes)| (name.clone(), PyBytes::new(py, bytes).unbind()));
    Ok((file.source.text.clone(), named.collect()))
}

/// The models that a workbook or a Digital Calibration Certificate carries: name, text, and the files
/// that they name.
#[pyfunction]
#[allow(clippy::type_complexity)] // what stands in the line above
pub(crate) fn carried_models(
    py: Python<'_>,
    path: PathBuf,
) -> PyResult<Vec<(String, String, Vec<(String, Py<PyBytes>)>)>> {
    let found = py.detach(|| gumption::file::carried_models(&path));
    let found = found.map_err(|found| failed(py, &Failure::Diagnostics(found)))?;
    let file = |(name, bytes): (String, Vec<u8>)| (name, PyBytes::new(py, &bytes).unbind());
    let model = |of: gumption::file::CarriedModel| {
        (of.name, of.text, of.files.into_iter().map(file).collect())
    };
    Ok(found.into_iter().map(model).collect())
}

/// The command line; the first argument is the name of the program. It gives the exit code.
#[pyfunction]
pub(crate) fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    let ended = py.detach(|| application().main_of(arguments));
    // an exit code shows its number in no other way
    (0..=u8::MAX).find(|&code| ended == std::process::ExitCode::from(code)).unwrap_or(1)
}
