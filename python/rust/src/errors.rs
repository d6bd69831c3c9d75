//! What is wrong, as Python exceptions with the text of the command line.

use gumption::command::{Failure, Mistake};
use gumption::file::{Diagnostic, Diagnostics};
use gumption::report::plain;
use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::argument_place::{Argument, Places};

create_exception!(
    gumption,
    ModelError,
    PyValueError,
    "A mistake in a model, another file or an argument.\n\n\
     The text is what the command line says on standard error, with the place in the file; about a model\n\
     that Python made it names the argument.\n\n\
     Attributes\n\
     ----------\n\
     errors : list of dict\n    \
         Every mistake with the keys ``file``, ``line``, ``column``, ``code``, ``message`` and\n    \
         ``suggestion``, as ``gumption check --format json`` lists them, and ``argument``, the argument\n    \
         of Python with the keys in it, such as ``mass.std``; `None` for a place in a file. Empty where\n    \
         an option of a command is at fault.\n"
);

/// A failure of the command line.
pub(crate) fn failed(py: Python<'_>, failure: &Failure) -> PyErr {
    failed_with(py, failure, &[])
}

/// The same where files are held that Python may have made of tables.
pub(crate) fn failed_with(py: Python<'_>, failure: &Failure, held: &[&str]) -> PyErr {
    match failure {
        Failure::System(_) => PyOSError::new_err(failure.to_string().trim_end().to_owned()),
        Failure::Argument(message) => refused(py, plain(message), &[]),
        Failure::Diagnostics(found) => {
            let mut places = Places::among(held);
            let all: Vec<Found<'_>> =
                found.0.iter().map(|one| (one, places.of(&one.source, one.span.start))).collect();
            refused(py, told(&all), &all)
        }
    }
}

/// A mistake of an argument.
pub(crate) fn argument(py: Python<'_>, message: impl Into<String>) -> PyErr {
    failed(py, &Failure::Argument(message.into()))
}

/// An error, and where it is in what Python gave; `None` for a place in a file.
type Found<'f> = (&'f Diagnostic, Option<Argument>);

/// Maximum number of errors that a text has, as on the command line.
const MOST: usize = 200;

/// The errors as a text: those of files as on the command line, with the line that is wrong.
fn told(all: &[Found<'_>]) -> String {
    let one = |(diagnostic, place): &Found<'_>| match place {
        Some(place) => place.told(&Mistake::from(*diagnostic).message),
        None => {
            let alone = Diagnostics(vec![(*diagnostic).clone()]);
            Failure::Diagnostics(alone).to_string().trim_end().to_owned()
        }
    };
    let mut lines: Vec<String> = all.iter().take(MOST).map(one).collect();
    if all.len() > MOST {
        lines.push(format!("and {} more; `errors` lists them", all.len() - MOST));
    }
    lines.join("\n")
}

fn refused(py: Python<'_>, text: String, all: &[Found<'_>]) -> PyErr {
    let error = ModelError::new_err(text);
    match listed(py, all).and_then(|list| error.value(py).setattr("errors", list)) {
        Ok(()) => error,
        Err(other) => other,
    }
}

fn listed<'py>(py: Python<'py>, all: &[Found<'_>]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for (diagnostic, place) in all {
        let mistake = Mistake::from(*diagnostic);
        let entry = PyDict::new(py);
        entry.set_item("file", &mistake.file)?;
        entry.set_item("line", mistake.line)?;
        entry.set_item("column", mistake.column)?;
        entry.set_item("code", mistake.code)?;
        entry.set_item("message", &mistake.message)?;
        entry.set_item("suggestion", &mistake.suggestion)?;
        entry.set_item("argument", place.as_ref().and_then(Argument::path))?;
        list.append(entry)?;
    }
    Ok(list)
}
