//! The keys of a file of costs, for plans.

use super::node::{With, object, reference};
use super::values::whole;
use super::{Key, closed, described, keys, referenced, text_of};
use serde_json::Value;

pub(super) fn definitions() -> Vec<(String, Value)> {
    let definitions = [("costs", root()), ("cost", cost()), ("offer", offer())];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// The key that only files of costs have.
pub(crate) const COSTS_KEY: &str = "costs";

/// What a file looks like that is meant as one of costs.
pub(super) fn meant() -> Value {
    super::with_key(COSTS_KEY)
}

fn positive(about: &str) -> Value {
    described("number", about).with("exclusiveMinimum", 0)
}

/// Keys of a file of costs.
pub(crate) const COSTS: &[Key] = keys![
    "format" => object([("const", Value::from(1))]),
    "title" => text_of("Title."),
    "currency" => text_of("What costs are counted in: `EUR`, `h`."),
    "costs" => described(
        "object",
        "Inputs, or components as `input/component`, with what their improvement costs; one that is \
         not named stays as it is.",
    )
    .with("additionalProperties", reference("cost")),
];

fn root() -> Value {
    closed("What improvements of inputs cost, for `gumption plan --cost`.", COSTS, &[COSTS_KEY])
}

/// Keys of the costs of an input.
pub(crate) const COST: &[Key] = keys![
    "cost" => positive(
        "The scale of the cost cost ((u0/u)^power - 1) of a standard uncertainty u instead of u0: \
         nothing as it is, and with power 1 the cost of halving it.",
    ),
    "power" => positive("The power; 1 unless given.").with("maximum", 100),
    "least" => referenced(
        "value",
        "The smallest standard uncertainty that can be had, in the input's unit; 0 unless given.",
    ),
    "per_reading" => positive("The cost of each further reading, of an input of readings."),
    "most" => whole("The most readings altogether.", 2, 1_000_000_000),
    "offers" => described("array", "What can replace the present inputs.")
        .with("items", reference("offer"))
        .with("minItems", 1),
];

fn cost() -> Value {
    let one = ["cost", "per_reading", "offers"].map(super::with_key);
    closed(
        "What the improvement of an input costs: one of `cost`, `per_reading`, `offers`.",
        COST,
        &[],
    )
    .with("oneOf", Value::from(one.to_vec()))
}

/// Keys of an offer.
pub(crate) const OFFER: &[Key] = keys![
    "standard_uncertainty" => referenced("value", "The standard uncertainty that the input then has."),
    "cost" => described("number", "Its cost.").with("minimum", 0),
    "about" => text_of("What it is."),
];

fn offer() -> Value {
    closed("Another instrument or calibration.", OFFER, &["standard_uncertainty", "cost"])
}
