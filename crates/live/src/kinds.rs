//! What the page's choices offer.

use gumption_files::schema;
use serde_json::{Value as Json, json};

use crate::ways;

/// Distributions with their keys, the ways in which inputs are known, and units.
pub(crate) fn all() -> Json {
    let distributions: Vec<Json> = schema::distributions()
        .iter()
        .map(|of| json!({ "name": of.name, "aliases": of.aliases, "keys": of.keys }))
        .collect();
    let mut units: Vec<&str> = COMPOSED.to_vec();
    units.extend(gumption_units::symbols().map(gumption_units::Symbol::name));
    json!({ "distributions": distributions, "ways": ways::listed(), "units": units, "version": env!("CARGO_PKG_VERSION") })
}

/// Units with prefixes and composed units that are offered besides the symbols; any other can be
/// typed.
const COMPOSED: &[&str] = &[
    "1",
    "m/s^2",
    "m/s",
    "mm",
    "um",
    "nm",
    "mV",
    "uV",
    "mA",
    "uA",
    "kohm",
    "mohm",
    "mW",
    "kHz",
    "MHz",
    "kPa",
    "hPa",
    "MPa",
    "kN",
    "mg",
    "g",
    "ml",
    "ms",
    "us",
    "kg/m^3",
    "mV/(m/s^2)",
    "1/K",
    "ppm/degC",
];
