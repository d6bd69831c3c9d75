//! A Python function in place of a model's program.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use gumption::task::ColumnFunction;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;

/// A Python callable that takes a list of arrays, one for each variable, and gives a list of arrays of
/// the same length, one for each output.
#[derive(Debug)]
pub(crate) struct PythonFunction {
    function: Py<PyAny>,
    stop: Arc<AtomicBool>,
    raised: Mutex<Option<PyErr>>,
}

impl PythonFunction {
    pub(crate) fn new(function: Py<PyAny>, stop: Arc<AtomicBool>) -> Self {
        Self { function, stop, raised: Mutex::new(None) }
    }

    /// What it raised first.
    pub(crate) fn raised(&self) -> Option<PyErr> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn call(
        &self,
        py: Python<'_>,
        variables: &[Vec<f64>],
        outputs: &mut [Vec<f64>],
    ) -> PyResult<()> {
        let columns = variables.iter().map(|column| PyArray1::from_slice(py, column));
        let found = self.function.bind(py).call1((PyList::new(py, columns)?,))?;
        let found: Vec<Bound<'_, PyArray1<f64>>> = found.extract()?;
        if found.len() != outputs.len() {
            let reason = format!("{} outputs came back in place of {}", found.len(), outputs.len());
            return Err(PyValueError::new_err(reason));
        }
        for (out, column) in outputs.iter_mut().zip(&found) {
            let column = column.readonly();
            let values = column.as_array();
            if values.len() != out.len() {
                let reason = format!("{} values came back in place of {}", values.len(), out.len());
                return Err(PyValueError::new_err(reason));
            }
            out.iter_mut().zip(values).for_each(|(out, value)| *out = *value);
        }
        Ok(())
    }
}

impl ColumnFunction for PythonFunction {
    fn evaluate(&self, variables: &[Vec<f64>], outputs: &mut [Vec<f64>]) {
        if self.stop.load(Ordering::Relaxed) {
            return;
        }
        if let Err(error) = Python::attach(|py| self.call(py, variables, outputs)) {
            self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            self.stop.store(true, Ordering::Relaxed);
        }
    }
}
