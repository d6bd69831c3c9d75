//! The keys of a certificate file.

use super::node::{Node, object, reference, texts};
use super::{closed, described, referenced, text_of};
use crate as file;
use gumption_analysis::certificate::contents::{Language, PerformanceLocation, Rounding};

pub(super) fn definitions() -> Vec<(String, Node)> {
    let definitions = [
        ("certificate", certificate()),
        ("certificate-row", row()),
        ("device", device()),
        ("party", party()),
        ("localized", localized()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// What a file looks like that is meant as a certificate.
pub(super) fn meant() -> Node {
    object([
        ("anyOf", Node::List(file::certificate_keys().map(super::with_key).to_vec())),
        ("not", super::with_key("outputs")),
    ])
}

fn certificate() -> Node {
    let day = |about: &str| text_of(about).with("format", "date");
    let days = object([
        ("description", Node::from("Day of the calibration, or its first and last day.")),
        (
            "anyOf",
            Node::List(vec![
                day("The day."),
                described("array", "First and last day.")
                    .with("items", day("A day."))
                    .with("minItems", 1u64)
                    .with("maxItems", 2u64),
            ]),
        ),
    ]);
    let properties = vec![
        ("format", object([("const", Node::from(1u64))])),
        ("title", referenced("localized", "Title; `Calibration certificate` unless given.")),
        ("number", text_of("Number of the certificate.")),
        ("device", either("The device that was calibrated.", "device")),
        ("customer", either("The customer.", "party")),
        ("laboratory", either("The laboratory.", "party")),
        ("responsible", text_of("Who is responsible.")),
        ("calibration_date", days),
        ("issue_date", day("Day of issue.")),
        (
            "place",
            described("string", "Where the calibration was made; in the laboratory unless given.")
                .with("enum", texts(PerformanceLocation::ALL.map(PerformanceLocation::name))),
        ),
        ("environment", referenced("localized", "Environment: temperature, humidity.")),
        ("method", referenced("localized", "Method of calibration.")),
        ("traceability", referenced("localized", "How the results are traceable to the SI.")),
        ("remarks", remarks()),
        ("language", languages()),
        (
            "coverage_factor",
            described(
                "number",
                "Coverage factor for infinite degrees of freedom, for all rows; 2 unless given.",
            )
            .with("exclusiveMinimum", 0.0)
            .with("maximum", 8.0),
        ),
        ("coverage_probability", referenced("probability", "Coverage probability of all rows.")),
        (
            "coverage_factor_fixed",
            described("boolean", "Keep the coverage factor whatever the degrees of freedom."),
        ),
        (
            "rounding",
            described(
                "string",
                "How U is rounded: to the nearest; as EA-4/02 asks (up where more than 5 % would be \
                 lost); up. Nearest unless given.",
            )
            .with("enum", texts(Rounding::ALL.map(Rounding::name))),
        ),
        (
            "digits",
            described("integer", "Significant digits of U; 2 unless given.")
                .with("minimum", 1u64)
                .with("maximum", 4u64),
        ),
        (
            "monte_carlo",
            referenced("monte-carlo", "Trials and seed of all models, in place of their own."),
        ),
        ("conditions", names("Conditions that the table shows; all of them unless given.")),
        ("shared_inputs", names("Inputs that are one and the same quantity in all model files.")),
        ("separate_inputs", names("Inputs that have a value of their own in every row.")),
        (
            "rows",
            described("array", "The rows of the table; one for each row of a model's conditions.")
                .with("items", reference("certificate-row"))
                .with("minItems", 1u64),
        ),
    ];
    let both = texts(["coverage_probability", "coverage_factor"]);
    closed("A certificate file: which results of which models are stated.", properties, &["rows"])
        .with("not", object([("required", both)]))
        .with("dependentRequired", object([("coverage_factor_fixed", texts(["coverage_factor"]))]))
}

fn row() -> Node {
    let value = object([("type", texts(["number", "string"]))]);
    let set = described(
        "object",
        "Values of inputs (`tilt`), of their fields (`tilt.half_width`) or of conditions, in their \
         units, or as text with a unit.",
    )
    .with("additionalProperties", value.clone());
    let nominal = value.with(
        "description",
        "Nominal value in the output's unit, or the name of a condition or an input.",
    );
    let properties = vec![
        ("model", referenced("file", "The model file.")),
        ("output", text_of("The output that is stated.")),
        ("set", set),
        ("nominal", nominal),
        ("label", referenced("localized", "What the row is called instead of the output's name.")),
        ("cmc", referenced("width", "The laboratory's capability, in place of the output's.")),
        ("cmc_floor", described("boolean", "Raise U to the capability where it is below it.")),
    ];
    closed("A row of a certificate.", properties, &["model", "output"])
        .with("dependentRequired", object([("cmc_floor", texts(["cmc"]))]))
        .with(
            "examples",
            vec![object([
                ("model", Node::from("inclined_plane.json")),
                ("output", Node::from("a_x")),
                ("set", object([("tilt", Node::from(15u64))])),
            ])],
        )
}

fn device() -> Node {
    let properties = vec![
        ("name", referenced("localized", "What it is.")),
        ("manufacturer", text_of("Who made it.")),
        ("model", text_of("Its model or type.")),
        ("serial_number", text_of("Its serial number.")),
        ("customer_number", text_of("The customer's number for it.")),
    ];
    closed("A device.", properties, &["name"])
}

fn party() -> Node {
    let properties = vec![
        ("name", text_of("Its name.")),
        ("code", text_of("Its accreditation or laboratory code.")),
        ("street", text_of("Street.")),
        ("street_number", text_of("Number in the street.")),
        ("post_code", text_of("Post code.")),
        ("city", text_of("City.")),
        (
            "country",
            text_of("Country: two capital letters of ISO 3166-1.").with("pattern", "^[A-Z]{2}$"),
        ),
        ("email", text_of("Electronic mail.")),
        ("phone", text_of("Telephone.")),
    ];
    closed("A laboratory or a customer.", properties, &["name"])
}

/// A text, or an object.
fn either(about: &str, name: &str) -> Node {
    let kinds = vec![object([("type", Node::from("string"))]), reference(name)];
    object([("description", Node::from(about)), ("anyOf", Node::List(kinds))])
}

fn localized() -> Node {
    let properties = Language::ALL.map(|language| (language.code(), text_of("The text.")));
    let several =
        closed("A text for each language.", properties.to_vec(), &[]).with("minProperties", 1u64);
    let kinds = vec![object([("type", Node::from("string"))]), several];
    object([
        ("description", Node::from("A text, or one for each language.")),
        ("anyOf", Node::List(kinds)),
    ])
}

fn remarks() -> Node {
    let list =
        described("array", "Several.").with("items", object([("type", Node::from("string"))]));
    object([
        ("description", Node::from("Further remarks.")),
        ("anyOf", Node::List(vec![reference("localized"), list])),
    ])
}

fn languages() -> Node {
    let one = object([("enum", texts(Language::ALL.map(Language::code)))]);
    let several =
        described("array", "Several.").with("items", one.clone()).with("uniqueItems", true);
    object([
        ("description", Node::from("Language or languages of the sentences; `en` unless given.")),
        ("anyOf", Node::List(vec![one, several])),
    ])
}

fn names(about: &str) -> Node {
    let name = object([("type", Node::from("string"))]);
    let several = described("array", "Several.").with("items", name.clone());
    object([("description", Node::from(about)), ("anyOf", Node::List(vec![name, several]))])
}
