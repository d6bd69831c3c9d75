//! The keys of the files: each stands once, with its name and with what the JSON Schema says of its
//! value. Readers refuse what is not among them, and the schema is made of them.

mod case;
mod certificate;
mod check;
mod costs;
mod fits;
mod homes;
mod model_file;
pub(crate) mod node;
mod recipe;
mod shapes;
mod values;

use std::collections::BTreeSet;

use serde_json::Value;

use crate::result;
pub(crate) use case::{EFFECT, OBSERVATIONS, OBSERVED, PRIOR, SIMULATOR};
pub(crate) use certificate::{
    CERTIFICATE, CERTIFICATE_FUNCTION, CERTIFICATE_KEYS, CERTIFICATE_ROW, DEVICE, LAYOUT,
    LAYOUT_COLUMN, LAYOUT_TABLE, LETTERHEAD, PARTY,
};
pub(crate) use check::{check, check_names};
pub(crate) use costs::{COST, COSTS, COSTS_KEY, OFFER};
pub(crate) use fits::{
    CERTIFIED_TABLE, COMPLEX_ORDINATES, COMPLEX_POINTS, COVARIANCE_FILE, FIT, POINTS,
};
pub(crate) use model_file::{
    CMC_LINE, CONDITION, CORRELATION_MATRIX, MODEL, MONTE_CARLO, OUTPUT, REGION,
    TABLE_OF_CONDITIONS, TOLERANCE,
};
use node::{With, object, reference};
pub(crate) use recipe::{
    BASELINE, CHANNEL, FREQUENCY, LOW_PASS, OF_OSCILLATIONS, POINT, QUANTITY, RECIPE,
    RECIPE_CONDITION, RECIPE_KEY, RECIPE_ROW, RECORDING, RESPONSE, SEARCH, SEARCHED, STEPS,
    TRUNCATION, WAVEFORM_NOISE, WAVEFORM_QUANTITIES,
};
pub(crate) use shapes::{
    COMPLEX, COMPLEX_INPUT, COMPONENT, COMPOSED, FileShape, INPUT, POOLED, SHAPES,
};
pub(crate) use values::READINGS;

/// A key that an object of a file may have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    pub(crate) name: &'static str,
    /// What the schema says of its value.
    schema: fn() -> Value,
}

/// A table of keys; what the schema says of each is made when it is wanted.
macro_rules! keys {
    ($($name:literal => $schema:expr),* $(,)?) => {
        &[$(Key { name: $name, schema: || $schema }),*]
    };
}
use keys;

/// The schema; `effects` are the names of the catalogue of effects.
pub(crate) fn schema(effects: &BTreeSet<String>) -> Value {
    let mut definitions = model_file::definitions();
    definitions.extend(case::definitions(effects));
    definitions.extend(certificate::definitions());
    definitions.extend(costs::definitions());
    definitions.extend(fits::definitions());
    definitions.extend(recipe::definitions());
    definitions.extend(result::definitions());
    definitions.extend(shapes::definitions());
    definitions.extend(values::definitions());
    object([
        ("$schema", Value::from("https://json-schema.org/draft/2020-12/schema")),
        ("title", Value::from("Files of gumption")),
        (
            "description",
            Value::from(
                "Files of gumption, format 1. Model files: a measurement with what is known about \
                 its inputs, to be evaluated by the GUM and by Monte Carlo; with observations a case \
                 of the gap diagnosis. Certificate files: which results of which models are stated. \
                 Recipes: what is taken from which recordings. Files of costs: what improvements of inputs cost. Result files: what an evaluation found, to be the input of another one.",
            ),
        ),
        ("if", with_key("result")),
        ("then", reference("result")),
        (
            "else",
            object([
                ("if", recipe::meant()),
                ("then", reference("recipe")),
                (
                    "else",
                    object([
                        ("if", costs::meant()),
                        ("then", reference("costs")),
                        (
                            "else",
                            object([
                                ("if", certificate::meant()),
                                ("then", reference("certificate")),
                                ("else", reference("model")),
                            ]),
                        ),
                    ]),
                ),
            ]),
        ),
        ("$defs", object(definitions)),
    ])
}

/// An object with a key of this name.
fn with_key(key: &str) -> Value {
    object([("type", Value::from("object")), ("required", node::texts([key]))])
}

/// An object that has these keys and no others.
fn closed(about: &str, keys: &[Key], required: &[&str]) -> Value {
    closed_of(about, keys.iter().map(|key| (key.name, (key.schema)())), required)
}

/// An object that has these properties and no others; keys that begin with `$` belong to editors.
fn closed_of<'k>(
    about: &str,
    properties: impl IntoIterator<Item = (&'k str, Value)>,
    required: &[&str],
) -> Value {
    let closed = object([
        ("description", Value::from(about)),
        ("type", Value::from("object")),
        ("properties", object(properties)),
        ("patternProperties", object([("^\\$", Value::from(true))])),
        ("additionalProperties", Value::from(false)),
    ]);
    if required.is_empty() {
        closed
    } else {
        closed.with("required", node::texts(required.iter().copied()))
    }
}

/// An object whose keys are names of quantities.
fn named(about: &str, value: Value) -> Value {
    object([
        ("description", Value::from(about)),
        ("type", Value::from("object")),
        ("propertyNames", reference("name")),
        ("additionalProperties", value),
    ])
}

/// A text with a description.
fn text_of(about: &str) -> Value {
    described("string", about)
}

fn described(kind: &str, about: &str) -> Value {
    object([("description", Value::from(about)), ("type", Value::from(kind))])
}

/// A reference with a description of its own.
fn referenced(name: &str, about: &str) -> Value {
    object([("description", Value::from(about)), ("$ref", Value::from(format!("#/$defs/{name}")))])
}
