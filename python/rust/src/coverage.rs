//! The coverage of intervals as an argument: a probability or a factor.

use pyo3::prelude::*;

use crate::errors::argument;

/// The argument `coverage`.
pub(crate) fn probability(value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let p = value.extract().ok().filter(|p| 0.0 < *p && *p < 1.0);
    let what = "a probability between 0 and 1, such as 0.95,";
    p.ok_or_else(|| needed(value, "coverage", what))
}

/// The argument `k`.
pub(crate) fn factor(value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let k = value.extract().ok().filter(|k| 0.0 < *k && *k <= 8.0);
    k.ok_or_else(|| needed(value, "k", "a coverage factor above 0 and up to 8"))
}

/// An error if both are given.
pub(crate) fn check_one(py: Python<'_>, has_probability: bool, has_factor: bool) -> PyResult<()> {
    match has_probability && has_factor {
        true => Err(argument(py, "`coverage` and `k` say the same; give one of them")),
        false => Ok(()),
    }
}

/// An argument that is wrong, and what would be right.
pub(crate) fn needed(value: &Bound<'_, PyAny>, name: &str, what: &str) -> PyErr {
    match value.repr() {
        Ok(found) => argument(value.py(), format!("`{name}={found}`: {what} is needed")),
        Err(raised) => raised,
    }
}
