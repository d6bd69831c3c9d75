//! Temperatures of certificates that are differences: an error of indication of 0.05 °C is 0.05 K, and
//! the temperature 0.05 °C is 273.2 K.

use gumption_units::{Dimension, Unit};
use roxmltree::Node;

use super::Fault;
use super::document::{self, BLANKS, Measured, names};
use gumption_text::deviation_words::{PARTS_OF_TYPES, is_of_difference};

/// What a temperature of a certificate is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TemperatureKind {
    /// A temperature, or no temperature at all.
    Value,
    /// A difference of temperatures.
    Difference,
    /// Nothing tells but a word of its name or of that of its result, by which it would be a difference.
    Named(String),
    /// Nothing tells, and one of its values, in K, would be a temperature near absolute zero.
    NearZero(f64),
}

impl TemperatureKind {
    /// The unit of its values, which is K of a difference in °C.
    pub(super) fn unit(&self, unit: Unit) -> Unit {
        let is_scaled = unit.is_celsius() && unit.factor() == 1.0;
        match self {
            Self::Difference if is_scaled => Unit::parse("K").unwrap_or(unit),
            _ => unit,
        }
    }
}

/// Values below this, in K, are asked whether they are temperatures: few laboratories measure below the
/// boiling point of nitrogen, 77 K.
const COLD: f64 = 75.0;

/// What a quantity is; `stated` is what the model file says of it.
///
/// # Errors
/// What the model file says is not what the certificate does.
pub(super) fn kind(
    node: Node<'_, '_>,
    measured: &Measured,
    stated: Option<bool>,
) -> Result<TemperatureKind, Fault> {
    if !measures_temperature(&measured.unit) {
        return Ok(TemperatureKind::Value);
    }
    if measured.is_difference && stated == Some(false) {
        let reason =
            "this quantity is said once in °C and once in K, by which it is a difference of \
                      temperatures: leave out `difference`"
                .to_owned();
        return Err((document::tag(node), reason));
    }
    let types = node.attribute("refType").unwrap_or_default();
    let mut types = types.split(BLANKS).map(str::to_lowercase);
    let is_typed = types.any(|kind| PARTS_OF_TYPES.iter().any(|word| kind.contains(word)));
    if measured.is_difference || stated.unwrap_or(is_typed) {
        return Ok(TemperatureKind::Difference);
    }
    if stated.is_some() {
        return Ok(TemperatureKind::Value);
    }
    // certificates of one kind of result name it once, and its values `Measured value`
    let results = node.ancestors().filter(|above| above.tag_name().name() == "result");
    let mut names = names(node).into_iter().chain(results.flat_map(names));
    if let Some(name) = names.find(|name| is_of_difference(name)) {
        return Ok(TemperatureKind::Named(name));
    }
    let unit = &measured.unit;
    let kelvin = measured.values.iter().map(|value| value * unit.factor());
    let cold = kelvin.filter(|value| unit.zero().is_none() && *value < COLD);
    Ok(cold.reduce(f64::min).map_or(TemperatureKind::Value, TemperatureKind::NearZero))
}

/// Whether a unit is one of temperatures, and of their differences.
fn measures_temperature(unit: &Unit) -> bool {
    unit.dimension() == Dimension::TEMPERATURE
}
