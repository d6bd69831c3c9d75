//! Units: what they are in formulas, products of them, and conversions.

use gumption::unit::{Exponent, Unit};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::errors::argument;

fn read(py: Python<'_>, text: &str) -> PyResult<Unit> {
    Unit::parse(text).map_err(|error| argument(py, format!("the unit `{text}`: {error}")))
}

/// The factor and the offset with which a value in a unit becomes its number in coherent SI units (of
/// a Celsius temperature the number of degrees Celsius): `value * factor + offset`.
#[pyfunction]
pub(crate) fn unit_scale(py: Python<'_>, unit: &str) -> PyResult<(f64, f64)> {
    let parsed = read(py, unit)?;
    Ok((parsed.factor(), parsed.offset()))
}

/// The unit of the number that a value in a unit is in formulas, such as `m` of `mm`; whether values
/// are counted from a zero of their own, as of `degC` and `dBm`; and whether they are proportional to
/// an angle, as of `deg` and `deg/s`.
#[pyfunction]
pub(crate) fn unit_within(py: Python<'_>, unit: &str) -> PyResult<(String, bool, bool)> {
    let parsed = read(py, unit)?;
    let dimension = parsed.dimension();
    let within = match parsed.zero() {
        Some(_) if parsed.has_reference() => parsed.text().to_owned(),
        Some(_) => "degC".to_owned(),
        None if dimension.is_none() && parsed.counts_angle() => "rad".to_owned(),
        None => dimension.usual_unit(),
    };
    let is_angle = parsed.angle_exponent() == Exponent::ONE;
    Ok((within, parsed.zero().is_some(), is_angle))
}

/// The text of a product of powers of units, of a numerator and a denominator each.
#[pyfunction]
pub(crate) fn unit_product(py: Python<'_>, parts: Vec<(String, i32, i32)>) -> PyResult<String> {
    let mut factors = Vec::with_capacity(parts.len());
    for (unit, numerator, denominator) in &parts {
        let power = Exponent::new(*numerator, *denominator);
        factors.push((
            read(py, unit)?,
            power.ok_or_else(|| argument(py, "an exponent out of range"))?,
        ));
    }
    let product = Unit::product(factors);
    let product =
        product.ok_or_else(|| argument(py, "the exponents of a unit are out of range"))?;
    Ok(product.text().to_owned())
}

/// The unit of the difference of two values in a unit: `K` for `degC`, `dB` for `dBm`.
#[pyfunction]
pub(crate) fn unit_of_differences(py: Python<'_>, unit: &str) -> PyResult<String> {
    let parsed = read(py, unit)?;
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
    let (from, to) = (read(py, unit)?, read(py, wanted)?);
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
