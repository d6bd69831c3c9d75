//! The keys of a certificate file.

use super::node::{With, object, reference, texts};
use super::{Key, closed, closed_of, described, keys, referenced, text_of};
use gumption_analysis::certificate::contents::{
    ColumnContent, DecimalMark, Language, PerformanceLocation, Rounding,
};
use serde_json::Value;

pub(super) fn definitions() -> Vec<(String, Value)> {
    let definitions = [
        ("certificate", certificate()),
        ("certificate-row", row()),
        (
            "certificate-function",
            closed(
                "A calibration function of a certificate.",
                CERTIFICATE_FUNCTION,
                &["model", "fit"],
            ),
        ),
        ("layout", closed("The tables of a certificate.", LAYOUT, &[])),
        ("layout-table", closed("A table of results.", LAYOUT_TABLE, &["name", "columns"])),
        ("layout-column", closed("A column of a table.", LAYOUT_COLUMN, &[])),
        ("letterhead", closed("The head of the first page.", LETTERHEAD, &[])),
        ("device", device()),
        ("party", party()),
        ("localized", localized()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// Keys that only certificates have; a file with one of them, and without outputs, is meant as one.
pub(crate) const CERTIFICATE_KEYS: [&str; 4] = ["rows", "device", "customer", "laboratory"];

/// What a file looks like that is meant as a certificate.
pub(super) fn meant() -> Value {
    object([
        ("anyOf", Value::from(CERTIFICATE_KEYS.map(super::with_key).to_vec())),
        ("not", super::with_key("outputs")),
    ])
}

fn day(about: &str) -> Value {
    text_of(about).with("format", "date")
}

fn days() -> Value {
    object([
        ("description", Value::from("Day of the calibration, or its first and last day.")),
        (
            "anyOf",
            Value::from(vec![
                day("The day."),
                described("array", "First and last day.")
                    .with("items", day("A day."))
                    .with("minItems", 1)
                    .with("maxItems", 2),
            ]),
        ),
    ])
}

/// Keys of a certificate file.
pub(crate) const CERTIFICATE: &[Key] = keys![
    "format" => object([("const", Value::from(1))]),
    "title" => referenced("localized", "Title; `Calibration certificate` unless given."),
    "number" => text_of("Number of the certificate; `{readings}` becomes the name of the file of readings."),
    "device" => either("The device that was calibrated.", "device"),
    "customer" => either("The customer.", "party"),
    "laboratory" => either("The laboratory.", "party"),
    "responsible" => text_of("Who is responsible."),
    "calibration_date" => days(),
    "receipt_date" => day("Day on which the device was received."),
    "issue_date" => day("Day of issue."),
    "place" => described("string", "Where the calibration was made; in the laboratory unless given.")
                .with("enum", texts(PerformanceLocation::ALL.map(PerformanceLocation::name))),
    "environment" => referenced("localized", "Environment: temperature, humidity."),
    "method" => referenced("localized", "Method of calibration."),
    "traceability" => referenced("localized", "How the results are traceable to the SI."),
    "remarks" => remarks(),
    "language" => languages(),
    "decimal_mark" => described(
                "string",
                "Decimal mark of the pages; by the first language unless given.",
            )
            .with("enum", texts(DecimalMark::ALL.map(DecimalMark::name))),
    "coverage_factor" => described(
                "number",
                "Coverage factor for infinite degrees of freedom, for all rows; 2 unless given.",
            )
            .with("exclusiveMinimum", 0)
            .with("maximum", 8),
    "coverage_probability" => referenced("probability", "Coverage probability of all rows."),
    "coverage_factor_fixed" => described("boolean", "Keep the coverage factor whatever the degrees of freedom."),
    "rounding" => described(
                "string",
                "How U is rounded: to the nearest; as EA-4/02 asks (up where more than 5 % would be \
                 lost); up. Nearest unless given.",
            )
            .with("enum", texts(Rounding::ALL.map(Rounding::name))),
    "digits" => described("integer", "Significant digits of U; 2 unless given.")
                .with("minimum", 1)
                .with("maximum", 4),
    "equations" => described(
                "boolean",
                "State the models: their equations and what the symbols mean. True unless given.",
            ),
    "statement" => referenced("statement", "Which method gives U, for all rows; `auto` unless the model \
                                            files say otherwise."),
    "statement_tolerance" => referenced("statement-tolerance", "Tolerance of `auto`, for all rows."),
    "layout" => referenced("layout", "The tables of the results; one with the usual columns unless given."),
    "letterhead" => referenced("letterhead", "Pictures and accreditation at the head of the first page."),
    "correlations" => described("boolean", "State the correlation coefficients of the rows. False unless given."),
    "monte_carlo" => referenced("monte-carlo", "Trials and seed of all models, instead of their own."),
    "conditions" => names("Conditions that the table shows; all of them unless given."),
    "shared_inputs" => names("Inputs that are one and the same quantity in all model files."),
    "separate_inputs" => names("Inputs that have a value of their own in every row."),
    "rows" => described("array", "The rows of the table; one for each row of a model's conditions.")
                .with("items", reference("certificate-row"))
                .with("minItems", 1),
    "functions" => described(
                "array",
                "Calibration functions that are stated with U over their range, after the table.",
            )
            .with("items", reference("certificate-function")),
];

fn certificate() -> Value {
    let both = texts(["coverage_probability", "coverage_factor"]);
    closed("A certificate file: which results of which models are stated.", CERTIFICATE, &["rows"])
        .with("not", object([("required", both)]))
        .with("dependentRequired", object([("coverage_factor_fixed", texts(["coverage_factor"]))]))
}

fn value_or_text() -> Value {
    object([("type", texts(["number", "string"]))])
}

fn replaced() -> Value {
    described(
        "object",
        "Values of inputs (`tilt`), of their fields (`tilt.half_width`) or of conditions, in their \
         units, or as text with a unit.",
    )
    .with("additionalProperties", value_or_text().clone())
}

fn nominal() -> Value {
    value_or_text().with(
        "description",
        "Nominal value in the output's unit, a text with a unit of its own (`100 ohm`), or the name of a \
         condition or an input.",
    )
}

/// Keys of a layout: the columns of its only table, or several tables.
pub(crate) const LAYOUT: &[Key] = keys![
    "title" => referenced("localized", "The title above the table."),
    "columns" => columns(),
    "tables" => described("array", "Several tables; rows choose theirs by `table`.")
                .with("items", reference("layout-table"))
                .with("minItems", 1),
];

/// Keys of a table of a layout.
pub(crate) const LAYOUT_TABLE: &[Key] = keys![
    "name" => text_of("The name by which rows choose the table."),
    "title" => referenced("localized", "The title above the table."),
    "columns" => columns(),
];

/// Keys of a column.
pub(crate) const LAYOUT_COLUMN: &[Key] = keys![
    "quantity" => text_of("An output, an input or a condition; for an output's U or k it can be left out if the table has one output."),
    "show" => described("string", "What the column shows of an output; `value` unless given.")
                .with("enum", texts(ColumnContent::ALL.map(ColumnContent::name))),
    "heading" => referenced("localized", "The heading above it instead of the name."),
    "unit" => text_of("The unit; for `U` also `%`, `ppm` or `µΩ/Ω`: U relative to the value."),
    "relative_to" => text_of("The quantity to whose value U is relative; the quantity of the column unless given."),
    "decimals" => described("integer", "Number of decimals of an input or a condition.")
                .with("minimum", 0)
                .with("maximum", 15),
];

/// Keys of a letterhead.
pub(crate) const LETTERHEAD: &[Key] = keys![
    "logo" => referenced("file", "Logo of the laboratory, PNG or SVG."),
    "accreditation_mark" => referenced("file", "Mark of the accreditation body, PNG or SVG."),
    "accreditation_number" => text_of("Number of the accreditation."),
    "accreditation" => referenced("localized", "A text about the accreditation."),
];

fn columns() -> Value {
    let text = text_of(
        "A quantity, `E`; or what is shown of an output: `U(E)`, `k(E)`, `limits(E)`, `decision(E)`; \
         without the name if the table has one output.",
    );
    let kinds = vec![text, reference("layout-column")];
    described("array", "The columns, in order.")
        .with("items", object([("anyOf", Value::from(kinds))]))
        .with("minItems", 1)
}

/// Keys of a calibration function of a certificate.
pub(crate) const CERTIFICATE_FUNCTION: &[Key] = keys![
    "model" => referenced("file", "The model file."),
    "fit" => text_of("Its calibration function."),
    "label" => referenced("localized", "What it is called instead of its name."),
];

/// Keys of a row of a certificate.
pub(crate) const CERTIFICATE_ROW: &[Key] = keys![
    "model" => referenced("file", "The model file."),
    "output" => text_of("The output that is stated."),
    "table" => text_of("The table of the layout in which the row stands, if there are several."),
    "set" => replaced(),
    "nominal" => nominal(),
    "statement" => referenced("statement", "Which method gives U of this row."),
    "label" => referenced("localized", "What the row is called instead of the output's name."),
    "cmc" => referenced("width", "The laboratory's capability, instead of the capability of the output."),
    "cmc_floor" => described("boolean", "Raise U to the capability where it is below it."),
];

fn row() -> Value {
    closed("A row of a certificate.", CERTIFICATE_ROW, &["model", "output"])
        .with("dependentRequired", object([("cmc_floor", texts(["cmc"]))]))
        .with(
            "examples",
            vec![object([
                ("model", Value::from("inclined_plane.json")),
                ("output", Value::from("a_x")),
                ("set", object([("tilt", Value::from(15))])),
            ])],
        )
}

/// Keys of a device.
pub(crate) const DEVICE: &[Key] = keys![
    "name" => referenced("localized", "What it is."),
    "manufacturer" => text_of("Who made it."),
    "model" => text_of("Its model or type."),
    "condition" => referenced("localized", "Its condition when it was received."),
    "serial_number" => text_of("Its serial number; `{readings}` becomes the name of the file of readings."),
    "customer_number" => text_of("The customer's number for it; `{readings}` becomes the name of the file of readings."),
];

fn device() -> Value {
    closed("A device.", DEVICE, &["name"])
}

/// Keys of a laboratory or a customer.
pub(crate) const PARTY: &[Key] = keys![
    "name" => text_of("Its name."),
    "code" => text_of("Its accreditation or laboratory code."),
    "street" => text_of("Street."),
    "street_number" => text_of("Number in the street."),
    "post_code" => text_of("Post code."),
    "city" => text_of("City."),
    "country" => text_of("Country: two capital letters of ISO 3166-1.").with("pattern", "^[A-Z]{2}$"),
    "email" => text_of("Electronic mail."),
    "phone" => text_of("Telephone."),
];

fn party() -> Value {
    closed("A laboratory or a customer.", PARTY, &["name"])
}

/// A text, or an object.
fn either(about: &str, name: &str) -> Value {
    let kinds = vec![object([("type", Value::from("string"))]), reference(name)];
    object([("description", Value::from(about)), ("anyOf", Value::from(kinds))])
}

fn localized() -> Value {
    let properties = Language::ALL.map(|language| (language.code(), text_of("The text.")));
    let several = closed_of("A text for each language.", properties, &[]).with("minProperties", 1);
    let kinds = vec![object([("type", Value::from("string"))]), several];
    object([
        ("description", Value::from("A text, or one for each language.")),
        ("anyOf", Value::from(kinds)),
    ])
}

fn remarks() -> Value {
    let list =
        described("array", "Several.").with("items", object([("type", Value::from("string"))]));
    object([
        ("description", Value::from("Further remarks.")),
        ("anyOf", Value::from(vec![reference("localized"), list])),
    ])
}

fn languages() -> Value {
    let one = object([("enum", texts(Language::ALL.map(Language::code)))]);
    let several =
        described("array", "Several.").with("items", one.clone()).with("uniqueItems", true);
    object([
        ("description", Value::from("Language or languages of the sentences; `en` unless given.")),
        ("anyOf", Value::from(vec![one, several])),
    ])
}

fn names(about: &str) -> Value {
    let name = object([("type", Value::from("string"))]);
    let several = described("array", "Several.").with("items", name.clone());
    object([("description", Value::from(about)), ("anyOf", Value::from(vec![name, several]))])
}
