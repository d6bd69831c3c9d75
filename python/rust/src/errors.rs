//! What is wrong, as Python exceptions with the text of the command line.

use gumption::command::{Failure, Mistake};
use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

create_exception!(
    gumption,
    ModelError,
    PyValueError,
    "A mistake in a model, another file or an argument.\n\n\
     The text is what the command line says on standard error, with the place in the file.\n\n\
     Attributes\n\
     ----------\n\
     errors : list of dict\n    \
         Every mistake with the keys ``file``, ``line``, ``column``, ``code``, ``message`` and\n    \
         ``suggestion``, as ``gumption check --format json`` lists them; empty where an argument is at\n    \
         fault.\n"
);

/// A failure of the command line.
pub(crate) fn failed(py: Python<'_>, failure: &Failure) -> PyErr {
    let text = failure.to_string();
    let text = text.trim_end().to_owned();
    match failure {
        Failure::System(_) => PyOSError::new_err(text),
        Failure::Argument(_) => refused(py, text, &[]),
        Failure::Diagnostics(diagnostics) => {
            let mistakes: Vec<Mistake> = diagnostics.0.iter().map(Mistake::from).collect();
            refused(py, text, &mistakes)
        }
    }
}

/// A mistake of an argument.
pub(crate) fn argument(py: Python<'_>, message: impl Into<String>) -> PyErr {
    failed(py, &Failure::Argument(message.into()))
}

fn refused(py: Python<'_>, text: String, mistakes: &[Mistake]) -> PyErr {
    let error = ModelError::new_err(text);
    match listed(py, mistakes).and_then(|list| error.value(py).setattr("errors", list)) {
        Ok(()) => error,
        Err(other) => other,
    }
}

fn listed<'py>(py: Python<'py>, mistakes: &[Mistake]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for mistake in mistakes {
        let entry = PyDict::new(py);
        entry.set_item("file", &mistake.file)?;
        entry.set_item("line", mistake.line)?;
        entry.set_item("column", mistake.column)?;
        entry.set_item("code", mistake.code)?;
        entry.set_item("message", &mistake.message)?;
        entry.set_item("suggestion", &mistake.suggestion)?;
        list.append(entry)?;
    }
    Ok(list)
}
