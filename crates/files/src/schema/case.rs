//! The keys of a case of the gap diagnosis: observations, effects, catalogue, prior.

use std::collections::BTreeSet;

use super::node::{Node, object, reference, texts};
use super::{closed, described, named, referenced, text_of};
use crate as file;

pub(super) fn definitions() -> Vec<(String, Node)> {
    let definitions = [
        ("observations", observations()),
        ("observed-output", observed()),
        ("effects", effects()),
        ("effect", effect()),
        ("catalogue", catalogue()),
        ("prior", prior()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

fn observations() -> Node {
    let columns = named(
        "The observed outputs, each with its columns of the table.",
        reference("observed-output"),
    )
    .with("minProperties", 1u64);
    let properties = vec![
        (
            "file",
            referenced(
                "file",
                "A CSV file with a header of names and a row for each measurement: conditions and \
                 outputs in their units.",
            ),
        ),
        ("columns", columns),
    ];
    let example = object([
        ("file", Node::from("data.csv")),
        (
            "columns",
            object([(
                "a_x",
                object([
                    ("value", Node::from("a_x")),
                    ("standard_uncertainty", Node::from("u_a_x")),
                ]),
            )]),
        ),
    ]);
    closed("Measured data of a gap case.", properties, &["file", "columns"])
        .with("examples", vec![example])
}

fn observed() -> Node {
    let properties = vec![
        ("value", text_of("The column of the measured values.")),
        (
            "standard_uncertainty",
            text_of(
                "The column of their standard uncertainties; without it the noise is estimated from \
                 the data.",
            ),
        ),
        (
            "sim",
            text_of(
                "The column of somebody else's simulation of the output, in place of an equation; \
                 effects can then override outputs only.",
            ),
        ),
        (
            "sim_standard_uncertainty",
            text_of("The column of the simulation's standard uncertainties."),
        ),
        (
            "sim_covariance",
            referenced(
                "file",
                "The covariance matrix of the simulation's values: a CSV file with a header, and a \
                 row and a column for each row of the data.",
            ),
        ),
    ];
    let of_the_simulation = ["sim_standard_uncertainty", "sim_covariance"];
    closed("What was measured of an output.", properties, &["value"])
        .with("dependentRequired", object(of_the_simulation.map(|key| (key, texts(["sim"])))))
        .with("not", object([("required", texts(of_the_simulation))]))
}

fn effects() -> Node {
    object([
        (
            "description",
            Node::from(
                "Candidate effects that the model leaves out, by name; several at once compose in \
                 this order.",
            ),
        ),
        ("type", Node::from("object")),
        ("propertyNames", object([("pattern", Node::from("^[^/+]+$"))])),
        ("additionalProperties", reference("effect")),
        ("maxProperties", Node::from(200u64)),
    ])
}

fn effect() -> Node {
    let parameters = named(
        "The effect's unknown quantities with their prior distributions. A parameter hides a \
         quantity of the same name.",
        reference("input"),
    )
    .with("minProperties", 1u64);
    let overrides = object([
        (
            "description",
            Node::from(
                "Inputs, quantities and outputs of the model, and what they become. In a formula a \
                 quantity's own name means its value without this override.",
            ),
        ),
        ("type", Node::from("object")),
        ("additionalProperties", text_of("A formula in coherent SI units.")),
        ("minProperties", Node::from(1u64)),
    ]);
    let properties = vec![
        ("parameters", parameters),
        ("overrides", overrides),
        ("about", text_of("What it is, in words.")),
        ("source", text_of("Where it comes from.")),
    ];
    let offset = object([
        ("unit", Node::from("deg")),
        ("distribution", Node::from("normal")),
        ("mean", Node::from(0.0)),
        ("std", Node::from(0.6)),
    ]);
    let example = object([
        ("parameters", object([("d", offset)])),
        ("overrides", object([("alpha", Node::from("alpha + d"))])),
    ]);
    closed("An effect that the model leaves out.", properties, &["parameters", "overrides"])
        .with("examples", vec![example])
}

fn catalogue() -> Node {
    let names: BTreeSet<String> =
        file::catalogue().effects.into_iter().map(|effect| effect.name).collect();
    let name = object([("enum", texts(names.iter().map(String::as_str)))]);
    described("array", "Ready-made effects, added after the own: `gumption models --effects`.")
        .with("items", name)
        .with("uniqueItems", true)
        .with("examples", vec![texts(["lateral-mode"])])
}

fn prior() -> Node {
    let share = |about: &str| described("number", about).with("minimum", 0.0).with("maximum", 1.0);
    let properties = vec![
        ("none", share("No gap; 0.15.")),
        ("one", share("One effect, shared equally among them; 0.55.")),
        ("two", share("Two effects, shared equally among the pairs; 0.15.")),
        ("three", share("Three effects, shared equally among the triples; 0.")),
        ("unexplained", share("A gap that none of them makes; 0.15.")),
    ];
    closed("Prior probabilities, which sum to 1.", properties, &[])
}
