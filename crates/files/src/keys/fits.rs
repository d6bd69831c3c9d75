//! The keys of calibration functions.

use super::node::{With, object, reference, texts};
use super::values::whole;
use super::{Key, closed, described, keys, named, referenced, text_of, with_key};
use serde_json::Value;

pub(super) fn definitions() -> Vec<(String, Value)> {
    let definitions = [
        ("fits", named("Calibration functions by name, which formulas call.", reference("fit"))),
        ("fit", closed("Points and the curve that is fitted to them.", FIT, &["x", "y"])),
        ("points", closed("A coordinate of the points.", POINTS, &[])),
        ("complex-points", closed("Complex ordinates.", COMPLEX_ORDINATES, &["complex"])),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// Keys of a calibration function.
pub(crate) const FIT: &[Key] = keys![
    "form" => text_of(
            "`straight-line` (unless given), `polynomial`, or a formula of x and parameters: \
             `a + b*exp(-x/c)`.",
        ),
    "degree" => object([
            ("description", Value::from("Degree of a polynomial; `auto` takes the one with the smallest AICc.")),
            ("anyOf", Value::from(vec![whole("The degree.", 1, 20), object([("enum", texts(["auto"]))])])),
        ]),
    "origin" => referenced("value", "Where the powers of x count from; 0."),
    "x" => referenced("points", "The abscissae."),
    "y" => object([
            ("description", Value::from("The ordinates.")),
            ("if", with_key("complex")),
            ("then", reference("complex-points")),
            ("else", reference("points")),
        ]),
    "cross_covariance" => covariance(
            "Covariances of x with y: of each point, or a matrix whose entry (i, j) is that of x i with \
             y j.",
        ),
    "weights" => described(
            "string",
            "`estimated`: the uncertainties are relative to each other only, and the residuals tell \
             their common factor.",
        )
        .with("enum", texts(["stated", "estimated"])),
    "start" => described("object", "Values near the parameters of a formula, with their units: `2 kN`.")
        .with("additionalProperties", reference("value")),
    "about" => text_of("What it is, in words."),
    "group" => text_of("A group of the budget, for subtotals."),
];

/// Keys of complex ordinates.
pub(crate) const COMPLEX_ORDINATES: &[Key] = keys![
    "complex" => closed("Both parts of the values.", COMPLEX_POINTS, &[]),
    "about" => text_of("What it is, in words."),
];

/// Keys of both parts of complex ordinates.
pub(crate) const COMPLEX_POINTS: &[Key] = keys![
    "re" => referenced("points", "The real part."),
    "im" => referenced("points", "The imaginary part, in the unit of the real one."),
    "modulus" => referenced("points", "The modulus."),
    "phase" => referenced("points", "The phase, in radians unless it says its own unit."),
    "correlation" => correlation(),
    "covariance" => covariance(
            "The covariance matrix of all first parts, then all second ones, in squares and products of \
             their units.",
        ),
];

/// Keys of a table of a Digital Calibration Certificate.
pub(crate) const CERTIFIED_TABLE: &[Key] = keys![
    "file" => referenced("file", "A Digital Calibration Certificate (XML)."),
    "id" => text_of("The `id` of the quantity."),
    "ref_type" => text_of("The `refType` of the quantity."),
    "within" => text_of("The `id`, a `refType` or a name of what the quantity stands in."),
    "status" => described("string", "Before or after what the quantity was measured.")
        .with("enum", texts(crate::dcc::STATUSES)),
    "quantity" => whole("The place of the quantity among all of the certificate, from 0.", 0, 1_000_000),
    "at" => text_of("The quantity beside it over which it is a table, by its name."),
];

/// Keys of a coordinate.
pub(crate) const POINTS: &[Key] = keys![
    "dcc" => closed(
        "A table of a certificate, with units and uncertainties, in place of values: of x its abscissae.",
        CERTIFIED_TABLE,
        &["file", "at"],
    ),
    "unit" => reference("unit"),
    "values" => referenced("values", "The values."),
    "file" => referenced("file", "A CSV file with a header of names, instead of `values`."),
    "column" => text_of("The column of the file; `x` or `y` unless given."),
    "standard_uncertainty" => uncertainty(),
    "covariance" => covariance("The covariance matrix, in squares of the unit."),
    "about" => text_of("What it is, in words."),
];

fn uncertainty() -> Value {
    let number = || object([("type", Value::from("number")), ("minimum", Value::from(0))]);
    let list = object([("type", Value::from("array")), ("items", number())]);
    let text =
        text_of("A specification of each value, such as `0.1 % of reading + 2 uV`, or a column.");
    object([
        ("description", Value::from("Standard uncertainty of all values, or of each.")),
        ("anyOf", Value::from(vec![number(), list, text])),
    ])
}

fn correlation() -> Value {
    let number =
        || object([("type", "number".into()), ("minimum", (-1).into()), ("maximum", 1.into())]);
    let list = object([("type", Value::from("array")), ("items", number())]);
    let about =
        "Correlation coefficient of both parts of every point, or of each; a column of the file.";
    object([
        ("description", Value::from(about)),
        ("anyOf", Value::from(vec![number(), list, described("string", "A column.")])),
    ])
}

fn covariance(about: &str) -> Value {
    let number = || object([("type", Value::from("number"))]);
    let row = || object([("type", Value::from("array")), ("items", number())]);
    let entry = object([("anyOf", Value::from(vec![number(), row()]))]);
    let list = object([("type", Value::from("array")), ("items", entry)]);
    let file = closed("A table of numbers.", COVARIANCE_FILE, &["file"]);
    object([("description", Value::from(about)), ("anyOf", Value::from(vec![list, file]))])
}

/// Keys of a covariance matrix in a file.
pub(crate) const COVARIANCE_FILE: &[Key] = keys![
    "file" => referenced("file", "A CSV file of numbers, with or without a header, or an .npy file."),
];
