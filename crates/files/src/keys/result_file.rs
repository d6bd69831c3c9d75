//! The result file: what `gumption run --save` writes and the distribution `result` reads.
//!
//! Its objects may have further keys, as a later version may write more.

use super::node::{With, object, reference, texts};
use super::values::whole;
use super::{described, named, referenced, text_of};
use gumption_analysis::integrity;
use serde_json::Value;

pub(super) fn definitions() -> Vec<(String, Value)> {
    let definitions = [
        ("result", root()),
        ("result-output", output()),
        ("result-scores", scores()),
        ("result-input", input()),
        ("result-provenance", provenance()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// An object that has at least these properties.
fn open(about: &str, properties: Vec<(&str, Value)>, required: &[&str]) -> Value {
    described("object", about)
        .with("properties", object(properties))
        .with("required", texts(required.iter().copied()))
}

/// A number, or null.
fn or_null(about: &str, above: Option<u64>) -> Value {
    let kinds = texts(["number", "null"]);
    let node = object([("description", Value::from(about)), ("type", kinds)]);
    match above {
        Some(limit) => node.with("exclusiveMinimum", limit),
        None => node,
    }
}

fn numbers() -> Value {
    object([("type", Value::from("number"))])
}

/// Two ends, or null where `nullable`.
fn interval(about: &str, nullable: bool) -> Value {
    let kind = if nullable { texts(["array", "null"]) } else { Value::from("array") };
    object([("description", Value::from(about)), ("type", kind)])
        .with("items", numbers())
        .with("minItems", 2)
        .with("maxItems", 2)
}

/// Entries of two of a kind and a coefficient.
fn coefficients(about: &str, of: &Value, coefficient: Value) -> Value {
    let entry = described("array", "Two of them and their coefficient.")
        .with("prefixItems", vec![of.clone(), of.clone(), coefficient])
        .with("items", false)
        .with("minItems", 3);
    described("array", about).with("items", entry)
}

fn root() -> Value {
    let format = object([
        ("description", Value::from("Version of the file's form.")),
        ("const", Value::from(1)),
    ]);
    let result = object([
        ("description", Value::from("What tells a result file: true.")),
        ("const", Value::from(true)),
    ]);
    let coefficient = |kind: Value| {
        object([("description", Value::from("The coefficient.")), ("type", kind)])
            .with("minimum", -1)
            .with("maximum", 1)
    };
    let name = text_of("Name of an output.");
    let place = described("integer", "Place in `inputs`, counted from 0.").with("minimum", 0);
    let properties = vec![
        ("format", format),
        ("result", result),
        ("gumption", text_of("Version of the program that wrote the file.")),
        ("title", text_of("Title of the model that was evaluated.")),
        ("coverage_probability", referenced("probability", "That of all intervals of the file.")),
        ("outputs", named("The results.", reference("result-output"))),
        (
            "output_correlations",
            coefficients(
                "Correlation coefficients between outputs, from the trials; null where there is \
                 none.",
                &name,
                coefficient(texts(["number", "null"])),
            ),
        ),
        ("scores", reference("result-scores")),
        (
            "inputs",
            described(
                "array",
                "The inputs that the outputs go back to: those of the model file, and in place of \
                 a saved result that it took, that result's own. Those of a saved result that are \
                 correlated with one of them stand there as well, with sensitivity coefficients of \
                 0. What is known exactly is not among them.",
            )
            .with("items", reference("result-input")),
        ),
        (
            "input_correlations",
            coefficients(
                "Correlation coefficients between `inputs` that are not 0.",
                &place,
                coefficient(Value::from("number")),
            ),
        ),
        ("provenance", reference("result-provenance")),
        (
            integrity::PARTS,
            described(
                "object",
                "The first digits of the SHA-256 of each part, by the keys that lead to it with `/` \
                 between them, to tell what was changed.",
            )
            .with("additionalProperties", object([("type", Value::from("string"))])),
        ),
        (
            integrity::DIGEST,
            text_of(
                "SHA-256 of all else in the file, in hexadecimal: of its JSON without blanks, the \
                 keys in order, a comma after each member, numbers as whole ones or as d.ddde-d.",
            ),
        ),
    ];
    let required = ["format", "result", "outputs", "scores", "inputs", "provenance"];
    open("A result file, as `gumption run --save` writes it.", properties, &required)
}

fn output() -> Value {
    let zero_or_more = described(
        "number",
        "Standard uncertainty by the law of propagation, or that of the trials where there is none.",
    )
    .with("minimum", 0);
    let status = object([
        ("description", Value::from("What `dof` null means.")),
        ("enum", texts(["finite", "infinite", "undefined"])),
    ]);
    let sensitivities = object([
        (
            "description",
            Value::from(
                "Sensitivity coefficients to `inputs`, in order, in output unit per input unit; \
                 null where they do not say how the output varies.",
            ),
        ),
        ("type", texts(["array", "null"])),
        ("items", numbers()),
    ]);
    let quantiles = described(
        "array",
        "Quantiles of the trials: entry k, counted from 0, belongs to the probability Phi(from + k \
         step) of `scores`.",
    )
    .with("items", numbers())
    .with("minItems", 2);
    let ranks = described(
        "array",
        "Ranks of the output, from 1, in a few of the trials that stand for all; entry i of all \
         outputs is of the same trial. So outputs of one file are drawn together. Not where there \
         is one output alone, nor of one that does not vary.",
    )
    .with("items", described("integer", "A rank.").with("minimum", 1))
    .with("minItems", 2)
    .with("maxItems", 1_000_000)
    .with("uniqueItems", true);
    let properties = vec![
        ("unit", reference("unit")),
        ("estimate", described("number", "The estimate.")),
        ("standard_uncertainty", zero_or_more),
        ("dof", or_null("Effective degrees of freedom; null: see `dof_status`.", Some(0))),
        ("dof_status", status),
        ("coverage_factor", or_null("Coverage factor k.", Some(0))),
        ("expanded_uncertainty", or_null("Expanded uncertainty U = k u.", None)),
        ("interval", interval("Coverage interval of the law of propagation.", true)),
        (
            "standard_deviation",
            or_null("Standard deviation of the trials; null where there is none.", None),
        ),
        (
            "drawn_dof",
            or_null(
                "The fewest degrees of freedom of a t distribution that the trials depend on; null \
                 for none.",
                Some(0),
            ),
        ),
        (
            "effective_trials",
            referenced(
                "positive",
                "Number of trials that the figures are worth, where that is below the number of \
                 trials: where saved results of limited trials went in.",
            ),
        ),
        ("symmetric_interval", interval("Symmetric coverage interval of the trials.", false)),
        ("shortest_interval", interval("Shortest coverage interval of the trials.", false)),
        ("sensitivities", sensitivities),
        ("quantiles", quantiles),
        ("ranks", ranks),
    ];
    let required = ["unit", "estimate", "standard_uncertainty", "sensitivities", "quantiles"];
    open("What was found for an output, in its unit.", properties, &required)
}

fn scores() -> Value {
    let properties = vec![
        ("from", described("number", "The first score.")),
        ("step", referenced("positive", "The distance of two scores.")),
        ("count", whole("How many there are.", 2, 1_000_001)),
    ];
    open("The standard normal scores of the quantiles.", properties, &["from", "step", "count"])
}

fn input() -> Value {
    let properties = vec![
        ("model_sha256", text_of("SHA-256 of the model file that names it, in hexadecimal.")),
        ("name", text_of("Its name there: `input` or `input/component`.")),
        ("unit", text_of("Its unit.")),
        ("distribution", text_of("Name of its distribution.")),
        ("estimate", described("number", "Its estimate.")),
        ("standard_uncertainty", referenced("positive", "Its standard uncertainty.")),
        (
            "standard_deviation",
            or_null("Standard deviation of the drawn values; null where there is none.", Some(0)),
        ),
        ("dof", or_null("Degrees of freedom; null for infinite.", Some(0))),
        (
            "data_sha256",
            text_of(
                "SHA-256 of the file that it was read from, or of those of several; with others it is \
                 another quantity.",
            ),
        ),
        (
            "certified",
            text_of(
                "Of a value of a digital calibration certificate, whose SHA-256 is `data_sha256`, its \
                 place there: it is then the same quantity in every model that takes it from there.",
            ),
        ),
        ("row", text_of("The conditions that it has a value of its own for.")),
        (
            "follows_conditions",
            described(
                "boolean",
                "Whether its figures follow the conditions: it is then the same quantity also with \
                 others, which elsewhere tell another one.",
            ),
        ),
        ("replaced", text_of("What was put in place of values of the file for it then.")),
    ];
    let required = ["model_sha256", "name", "estimate", "standard_uncertainty"];
    open("An input of a model file, as it was when the result was saved.", properties, &required)
}

fn provenance() -> Value {
    let properties = vec![
        ("model_sha256", text_of("SHA-256 of the model file that was evaluated, in hexadecimal.")),
        ("seed", whole("Seed of the random streams.", 0, u64::MAX)),
        ("trials", whole("Number of trials.", 0, 1_000_000_000_000)),
        (
            "files",
            described("object", "SHA-256 of every other file that was read, by its name.")
                .with("additionalProperties", object([("type", Value::from("string"))])),
        ),
    ];
    open("Where the result comes from.", properties, &["model_sha256"])
}
