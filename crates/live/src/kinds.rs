//! What the page's choices offer.

use gumption_files::schema;
use serde_json::{Value as Json, json};

use crate::reshape;

/// Distributions with their keys and those that a new one gets, and units.
pub(crate) fn all() -> Json {
    let distributions: Vec<Json> = schema::distributions()
        .iter()
        .map(|of| {
            let needed: Vec<&str> = reshape::needed(of.name).iter().map(|(key, _)| *key).collect();
            json!({ "name": of.name, "aliases": of.aliases, "keys": of.keys, "needed": needed })
        })
        .collect();
    let mut units: Vec<&str> = COMPOSED.to_vec();
    units.extend(gumption_units::symbols().map(gumption_units::Symbol::name));
    json!({ "distributions": distributions, "units": units, "version": env!("CARGO_PKG_VERSION") })
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
