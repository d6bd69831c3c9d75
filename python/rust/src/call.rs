//! Commands as functions, and the command line as a program.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use gumption::command::{Exit, Failure, GivenFile};
use gumption::unit::Unit;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::application;
use crate::errors::{argument, failed};
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

/// The factor and the offset with which a value in a unit becomes its number in coherent SI units (of
/// a Celsius temperature the number of degrees Celsius): `value * factor + offset`.
#[pyfunction]
pub(crate) fn unit_scale(py: Python<'_>, unit: &str) -> PyResult<(f64, f64)> {
    let parsed = Unit::parse(unit);
    let parsed = parsed.map_err(|error| argument(py, format!("the unit `{unit}`: {error}")))?;
    Ok((parsed.factor(), parsed.offset()))
}

/// The unit of the number that a value in a unit is in formulas, such as `m` of `mm`; whether values
/// are counted from a zero of their own, as of `degC` and `dBm`; and whether they are proportional to
/// an angle, as of `deg` and `deg/s`.
#[pyfunction]
pub(crate) fn unit_within(py: Python<'_>, unit: &str) -> PyResult<(String, bool, bool)> {
    let parsed = Unit::parse(unit);
    let parsed = parsed.map_err(|error| argument(py, format!("the unit `{unit}`: {error}")))?;
    let dimension = parsed.dimension();
    let within = match parsed.zero() {
        Some(_) if parsed.has_reference() => parsed.text().to_owned(),
        Some(_) => "degC".to_owned(),
        None if dimension.is_none() && parsed.counts_angle() => "rad".to_owned(),
        None => dimension.usual_unit(),
    };
    let is_angle = parsed.angle_exponent() == gumption::unit::Exponent::ONE;
    Ok((within, parsed.zero().is_some(), is_angle))
}

/// The text of a product of powers of units, of a numerator and a denominator each.
#[pyfunction]
pub(crate) fn unit_product(py: Python<'_>, parts: Vec<(String, i32, i32)>) -> PyResult<String> {
    let mut factors = Vec::with_capacity(parts.len());
    for (unit, numerator, denominator) in &parts {
        let parsed = gumption::unit::Unit::parse(unit);
        let parsed = parsed.map_err(|error| argument(py, format!("the unit `{unit}`: {error}")))?;
        let power = gumption::unit::Exponent::new(*numerator, *denominator);
        factors.push((parsed, power.ok_or_else(|| argument(py, "an exponent out of range"))?));
    }
    let product = gumption::unit::Unit::product(factors);
    let product =
        product.ok_or_else(|| argument(py, "the exponents of a unit are out of range"))?;
    Ok(product.text().to_owned())
}

/// The unit of the difference of two values in a unit: `K` for `degC`, `dB` for `dBm`.
#[pyfunction]
pub(crate) fn unit_of_differences(py: Python<'_>, unit: &str) -> PyResult<String> {
    let parsed = gumption::unit::Unit::parse(unit);
    let parsed = parsed.map_err(|error| argument(py, format!("the unit `{unit}`: {error}")))?;
    let text = parsed.of_differences().text().to_owned();
    Ok(if parsed.is_celsius() { "K".to_owned() } else { text })
}

/// Whether values in one unit can be converted to another.
#[pyfunction]
pub(crate) fn units_fit(first: &str, second: &str) -> bool {
    let parse = |text| Unit::parse(text).ok();
    parse(first).zip(parse(second)).is_some_and(|(first, second)| first.is_compatible(&second))
}

/// Values in one unit, converted to another with the zeros of their scales; or differences, which have no
/// zero.
#[pyfunction]
pub(crate) fn convert<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    unit: &str,
    wanted: &str,
    are_differences: bool,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let parse = |text: &str| {
        let parsed = Unit::parse(text);
        parsed.map_err(|error| argument(py, format!("the unit `{text}`: {error}")))
    };
    let (from, to) = (parse(unit)?, parse(wanted)?);
    let values = values.as_array();
    let values = values.iter();
    let converted: Result<Vec<f64>, _> = if are_differences {
        let factor = Unit::conversion_factor(&from.of_differences(), &to.of_differences());
        factor.map(|factor| values.map(|value| value * factor).collect())
    } else {
        values.map(|value| Unit::convert(*value, &from, &to)).collect()
    };
    let converted = converted.map_err(|error| argument(py, error.to_string()))?;
    Ok(PyArray1::from_vec(py, converted))
}

/// The command line; the first argument is the name of the program. It gives the exit code.
#[pyfunction]
pub(crate) fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    let ended = py.detach(|| application().main_of(arguments));
    // an exit code shows its number in no other way
    (0..=u8::MAX).find(|&code| ended == std::process::ExitCode::from(code)).unwrap_or(1)
}
