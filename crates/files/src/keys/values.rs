//! Values that many keys have: numbers of a range, widths, estimates, units, names.

use super::node::{With, object, texts};
use super::{Key, closed, described, keys, referenced, text_of};
use gumption_engine::task::StatementMethod;
use serde_json::Value;

/// The pattern of a name, in what regular expressions have in every language (JSON Schema 2020-12 Core,
/// 6.4), which no classes of letters are: all but the signs, spaces and controls up to U+00BF, and the
/// punctuation of Unicode; no digit in front. It takes every name that the reader takes.
const NAME: &str = "^[^\u{1}-@\\[-\\^`{-©«-´¶-¹»-¿×÷\u{2000}-\u{206f}]\
                    [^\u{1}-/:-@\\[-\\^`{-©«-´¶-¹»-¿×÷\u{2000}-\u{206f}]*$";

/// A number with an open lower limit, an open upper one, or both.
fn number(about: &str, above: Option<u64>, below: Option<u64>) -> Value {
    let mut number = described("number", about);
    if let Some(limit) = above {
        number = number.with("exclusiveMinimum", limit);
    }
    if let Some(limit) = below {
        number = number.with("exclusiveMaximum", limit);
    }
    number
}

/// A number, or a text of the given kind.
fn number_or_text(about: &str, number: Value, text: Value) -> Value {
    object([("description", Value::from(about)), ("anyOf", Value::from(vec![number, text]))])
}

/// A whole number from `least` to `most`.
pub(super) fn whole(about: &str, least: u64, most: u64) -> Value {
    described("integer", about).with("minimum", least).with("maximum", most)
}

/// At least one number.
fn list(about: &str) -> Value {
    let number = object([("type", Value::from("number"))]);
    described("array", about).with("items", number).with("minItems", 1)
}

/// Keys of readings that a distribution is tested against.
pub(crate) const READINGS: &[Key] = keys![
    "values" => referenced("values", "The readings."),
    "file" => text_of("A file with one reading in each line, or a table with `column`."),
    "column" => referenced("column", "The column of the file that has the readings."),
];

pub(super) fn definitions() -> Vec<(String, Value)> {
    let numbers = object([("type", Value::from("number"))]);
    let formula = text_of(
        "A value with a unit, such as `100 ohm`, or a formula of conditions and constants, evaluated \
         in SI units.",
    );
    let specification = text_of(
        "A specification: terms of `x %` or `x ppm` (of the reading; also `x % rdg`), `x % of VALUE \
         UNIT`, `x % of range`, `x % FS`, `x counts` and `VALUE UNIT`, joined by `+`, which add \
         linearly; `Q[a; b L] nm, L in mm`; `greater of A and B`; or, in an input and of a \
         capability, a formula of conditions, evaluated in SI units. A capability may have `x % of \
         CONDITION` too.",
    );
    let with_unit = text_of("A value with a unit, converted to the quantity's: `100 ohm`.")
        .with("pattern", "^\\s*[-+]?[0-9.]");
    let value = number_or_text(
        "A number in the quantity's unit, or a value with a unit of its own.",
        numbers.clone(),
        with_unit,
    );
    let definitions = [
        ("number", described("number", "A number in the quantity's unit.")),
        ("value", value.clone()),
        (
            "values",
            described("array", "Values of the quantity.").with("items", value).with("minItems", 1),
        ),
        ("positive", number("A number above 0.", Some(0), None)),
        ("probability", number("A probability between 0 and 1.", Some(0), Some(1))),
        (
            "statement",
            described(
                "string",
                "Which method gives the stated value and U: `gum`, the law of propagation with k from \
                 the effective degrees of freedom; `monte-carlo`, the interval of the trials; `auto`, \
                 the law of propagation where its endpoints agree with those of trials with infinite \
                 degrees of freedom, and the trials elsewhere.",
            )
            .with("enum", texts(StatementMethod::ALL.map(StatementMethod::name))),
        ),
        (
            "statement-tolerance",
            number(
                "Largest difference of an endpoint, relative to U, with which `auto` states the law of \
                 propagation; 0.05 unless given.",
                Some(0),
                Some(1),
            ),
        ),
        ("numbers", list("Numbers in the quantity's unit.")),
        (
            "estimate",
            number_or_text(
                "The estimate, in the quantity's unit, or a formula of the conditions.",
                numbers.clone(),
                formula,
            )
            .with("examples", Value::from(vec![Value::from(9.81), Value::from("2*f_nominal")])),
        ),
        (
            "positive-estimate",
            number_or_text(
                "The estimate, above 0, in the quantity's unit, or a formula of the conditions.",
                number("The estimate.", Some(0), None),
                text_of("A formula of conditions and constants, evaluated in SI units."),
            ),
        ),
        (
            "width",
            number_or_text(
                "A width above 0 in the quantity's unit, or a specification as data sheets have \
                 it.",
                number("A width in the quantity's unit.", Some(0), None),
                specification,
            )
            .with(
                "examples",
                Value::from(vec![
                    Value::from(0.01),
                    Value::from("0.02 % + 0.005 % of 10 V + 2 uV"),
                ]),
            ),
        ),
        (
            "unit",
            text_of(
                "A unit: SI units with prefixes, products, quotients and powers, and units of \
                 laboratories; `1` for a number.",
            )
            .with("examples", texts(["m/s^2", "kHz", "kg*m^-3", "degC", "deg", "%", "1"])),
        ),
        (
            "name",
            text_of(
                "A name: letters of any alphabet, digits and `_`; no function's name, not `pi`.",
            )
            .with("pattern", NAME),
        ),
        ("file", text_of("A path, relative to the folder of this file.")),
        (
            "values-or-file",
            closed("Readings of the same quantity.", READINGS, &[]).with("minProperties", 1),
        ),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}
