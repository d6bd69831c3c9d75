//! The keys of a case of the gap diagnosis: observations, effects, catalogue, prior.

use std::collections::BTreeSet;

use super::node::{With, object, reference, texts};
use super::{Key, closed, described, keys, named, referenced, text_of};
use serde_json::Value;

/// `names` are those of the catalogue's effects.
pub(super) fn definitions(names: &BTreeSet<String>) -> Vec<(String, Value)> {
    let definitions = [
        ("observations", observations()),
        ("observed-output", observed()),
        ("simulator", simulator()),
        ("effects", effects()),
        ("effect", effect()),
        ("catalogue", catalogue(names)),
        ("prior", prior()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

fn observed_columns() -> Value {
    named("The observed outputs, each with its columns of the table.", reference("observed-output"))
        .with("minProperties", 1)
}

/// Keys of `observations`.
pub(crate) const OBSERVATIONS: &[Key] = keys![
    "file" => referenced(
                "file",
                "A CSV file with a header of names and a row for each measurement: conditions and \
                 outputs in their units.",
            ),
    "values" => values(),
    "columns" => observed_columns(),
    "order" => text_of(
                "The column that says in which order the rows were taken, as a number. Without it and \
                 `time` they were taken in the order of the file.",
            ),
    "time" => text_of(
                "The column that says when each row was taken, as a number in the unit of its heading.",
            ),
    "replication" => text_of(
                "The column that says which device, day or other unit of replication a row belongs to, \
                 as a number: effects are tried with one size for all of them and with one of each \
                 one's own.",
            ),
];

fn values() -> Value {
    let cells = object([("type", Value::from("number"))]);
    let column = described("array", "Its values, one for each row.")
        .with("items", cells)
        .with("minItems", 1);
    object([
        (
            "description",
            Value::from(
                "The data themselves instead of a file: the columns by their headings, each a list \
                 of numbers, all of the same length.",
            ),
        ),
        ("type", Value::from("object")),
        ("additionalProperties", column),
        ("minProperties", Value::from(1)),
    ])
}

fn observations() -> Value {
    let example = object([
        ("file", Value::from("data.csv")),
        (
            "columns",
            object([(
                "a_x",
                object([
                    ("value", Value::from("a_x")),
                    ("standard_uncertainty", Value::from("u_a_x")),
                ]),
            )]),
        ),
    ]);
    let data = ["file", "values"].map(|key| object([("required", texts([key]))]));
    closed("Measured data of a gap case.", OBSERVATIONS, &["columns"])
        .with("oneOf", Value::from(data.to_vec()))
        .with("not", object([("required", texts(["order", "time"]))]))
        .with("examples", vec![example])
}

/// Keys of an observed output.
pub(crate) const OBSERVED: &[Key] = keys![
    "value" => text_of("The column of the measured values."),
    "standard_uncertainty" => column_or_width(
                "The column of their standard uncertainties, or one for all rows: a number in the \
                 output's unit, or a text such as `0.02 N` or `0.1 % + 0.02 N` (of the measured value). \
                 Without it the noise is estimated from the data.",
            ),
    "sim" => text_of(
                "The column of another program's simulation of the output, instead of an equation; \
                 effects can then override outputs only.",
            ),
    "sim_standard_uncertainty" => column_or_width(
                "The column of the simulation's standard uncertainties, or one for all rows.",
            ),
    "sim_covariance" => referenced(
                "file",
                "The covariance matrix of the simulation's values: a CSV file with a header, and a \
                 row and a column for each row of the data.",
            ),
];

fn column_or_width(about: &str) -> Value {
    let kinds = vec![object([("type", Value::from("string"))]), reference("width")];
    object([("description", Value::from(about)), ("anyOf", Value::from(kinds))])
}

fn observed() -> Value {
    let of_the_simulation = ["sim_standard_uncertainty", "sim_covariance"];
    closed("What was measured of an output.", OBSERVED, &["value"])
        .with("dependentRequired", object(of_the_simulation.map(|key| (key, texts(["sim"])))))
        .with("not", object([("required", texts(of_the_simulation))]))
}

/// Keys of `simulator`.
pub(crate) const SIMULATOR: &[Key] = keys![
    "outputs" => named(
                "What the program gives, each output of the file with the unit that it is given in.",
                reference("unit"),
            )
            .with("minProperties", 1),
    "about" => text_of("Which program it is, in words: version, solver, tolerance."),
    "noisy" => described(
                "boolean",
                "Whether the program's answers scatter from run to run at the same parameters (random numbers, \
                 solvers that depend on threads). Some runs are then repeats, and its mean is the sim.",
            ),
];

fn simulator() -> Value {
    let about = "A program that gives the outputs of all rows at once, instead of `equations`. The \
                 command line says which program, and no file. It gets all inputs, and the parameters of \
                 all effects that say `\"simulator\": true`.";
    let example = object([
        ("outputs", object([("angle", Value::from("mrad"))])),
        ("about", Value::from("pendulum.py, RK45, tolerance 1e-9")),
    ]);
    closed(about, SIMULATOR, &["outputs"]).with("examples", vec![example])
}

fn effects() -> Value {
    object([
        (
            "description",
            Value::from(
                "Candidate effects that the model leaves out, by name; several at once compose in \
                 this order.",
            ),
        ),
        ("type", Value::from("object")),
        ("propertyNames", object([("pattern", Value::from("^[^/+]+$"))])),
        ("additionalProperties", reference("effect")),
        ("maxProperties", Value::from(200)),
    ])
}

fn parameters() -> Value {
    named(
        "The effect's unknown quantities with their prior distributions; `{}` for an effect of \
         known size. A parameter hides a quantity of the same name.",
        reference("input"),
    )
}

fn overrides() -> Value {
    object([
        (
            "description",
            Value::from(
                "Inputs, quantities and outputs of the model, and what they become. In a formula a \
                 quantity's own name means its value without this override.",
            ),
        ),
        ("type", Value::from("object")),
        ("additionalProperties", text_of("A formula in coherent SI units.")),
        ("minProperties", Value::from(1)),
    ])
}

/// Keys of an effect.
pub(crate) const EFFECT: &[Key] = keys![
    "parameters" => parameters(),
    "overrides" => overrides(),
    "simulator" => described(
                "boolean",
                "Whether the simulator does it by itself, at its parameters; it then overrides nothing.",
            ),
    "neutral" => named(
                "Parameters that make an effect of the simulator absent, and their values. 0 of an effect \
                 with one parameter; the others are then at the medians of their priors.",
                reference("value"),
            )
            .with("minProperties", 1),
    "about" => text_of("What it is, in words."),
    "source" => text_of("Where it comes from."),
    // what `gumption gap` says of an effect that it composed, so that the entry of the answer can
    // stand here as it is
    "name" => of_composed(),
    "quantity" => of_composed(),
    "kind" => of_composed(),
    "over" => of_composed(),
    "form" => of_composed(),
    "terms" => of_composed(),
    "beside" => of_composed(),
    "estimates" => of_composed(),
    "probability" => of_composed(),
    "shrinks" => of_composed(),
];

fn of_composed() -> Value {
    object([(
        "description",
        Value::from("From the answer of `gumption gap`, of an effect that was composed; not read."),
    )])
}

fn effect() -> Value {
    let offset = object([
        ("unit", Value::from("deg")),
        ("distribution", Value::from("normal")),
        ("mean", Value::from(0)),
        ("std", Value::from(0.6)),
    ]);
    let example = object([
        ("parameters", object([("d", offset)])),
        ("overrides", object([("alpha", Value::from("alpha + d"))])),
    ]);
    let by_itself = object([
        ("properties", object([("simulator", object([("const", Value::from(true))]))])),
        ("required", texts(["simulator"])),
        ("not", object([("required", texts(["overrides"]))])),
    ]);
    let by_formulas = object([
        ("required", texts(["overrides"])),
        ("not", object([("required", texts(["neutral"]))])),
    ]);
    closed("An effect that the model leaves out.", EFFECT, &["parameters"])
        .with("anyOf", vec![by_formulas, by_itself])
        .with("examples", vec![example])
}

fn catalogue(effects: &BTreeSet<String>) -> Value {
    let name = object([("enum", texts(effects.iter().map(String::as_str)))]);
    let list = described("array", "Their names.").with("items", name).with("uniqueItems", true);
    let all = object([("const", Value::from("all"))]);
    let about = "Ready-made effects, added after the own: names of `gumption models --effects`, or \
                 `\"all\"` for every one that can act on the model.";
    object([("description", Value::from(about)), ("anyOf", Value::from(vec![list, all]))])
        .with("examples", vec![texts(["lateral-mode"])])
}

fn share(about: &str) -> Value {
    described("number", about).with("minimum", 0).with("maximum", 1)
}

/// Keys of `prior`.
pub(crate) const PRIOR: &[Key] = keys![
    "none" => share("No gap; 0.15."),
    "one" => share("One effect, shared equally among them; 0.55."),
    "two" => share("Two effects, shared equally among the pairs; 0.15."),
    "three" => share("Three effects, shared equally among the triples; 0."),
    "unexplained" => share("A gap that none of them makes; 0.15."),
];

fn prior() -> Value {
    closed("Prior probabilities, which sum to 1.", PRIOR, &[])
}
