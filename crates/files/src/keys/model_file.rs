//! The model file: its root, outputs, conditions, correlations and settings.

use super::node::{With, object, reference, texts};
use super::values::whole;
use super::{Key, closed, described, keys, named, referenced, text_of};
use gumption_engine::model::GuardRule;
use serde_json::Value;

pub(super) fn definitions() -> Vec<(String, Value)> {
    let definitions = [
        ("model", root()),
        ("output", output()),
        ("tolerance", tolerance()),
        ("cmc-line", cmc_line()),
        ("conditions", conditions()),
        ("condition", condition()),
        ("table-of-conditions", table_of_conditions()),
        ("correlation", correlation()),
        ("correlation-matrix", correlation_matrix()),
        ("monte-carlo", monte_carlo()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// Keys of a model file and of a case.
pub(crate) const MODEL: &[Key] = keys![
    "format" => object([
                (
                    "description",
                    Value::from(
                        "Version of the file's form. 2 says that formulas whose units are not \
                         checked are written for the numbers in the declared units.",
                    ),
                ),
                ("enum", Value::from(vec![1, 2])),
            ]),
    "title" => text_of("What is measured, in a line."),
    "source" => text_of("The document that the measurement follows."),
    "about" => text_of("Remarks."),
    "units" => described("object", "Units of one's own by name: `\"HBW\": \"1\"`.")
        .with("additionalProperties", object([("type", Value::from("string"))])),
    "inputs" => named(
                "The input quantities with their distributions; tables list them in this order.",
                object([("anyOf", Value::from(vec![reference("input"), reference("stated")]))]),
            ),
    "fits" => reference("fits"),
    "date_origin" => text_of(
        "The day from which dates count, as `2020-01-01`: a date as a value is the number of days since it.",
    ),
    "correlations" => described("array", "Correlation coefficients of inputs or components.")
                .with("items", reference("correlation")),
    "correlation_matrix" => reference("correlation-matrix"),
    "conditions" => reference("conditions"),
    "equations" => named(
                "Formulas, in order; each may use inputs, conditions and the quantities above it.",
                text_of("A formula in coherent SI units."),
            )
            .with("minProperties", 1),
    "model" => text_of("Name of a typed model, instead of `equations`; `gumption models` lists them."),
    "outputs" => named("The quantities to report.", reference("output")).with("minProperties", 1),
    "regions" => described("array", "Outputs that are covered together (JCGM 102).")
                .with("items", closed("Two outputs or more.", REGION, &["outputs"])),
    "coverage_probability" => referenced("probability", "Coverage probability; 0.9545 (coverage factor 2) unless given."),
    "coverage_factor" => described("number", "Coverage factor for infinite degrees of freedom; sets the \
                                 coverage probability.")
                .with("exclusiveMinimum", 0)
                .with("maximum", 8),
    "coverage_factor_fixed" => described("boolean", "Keep the coverage factor whatever the degrees of freedom."),
    "statement" => referenced("statement", "Which method gives the stated value and U; `auto` unless given."),
    "statement_tolerance" => reference("statement-tolerance"),
    "shown_digits" => whole(
        "Significant digits of uncertainties on pages; the `digits` of `monte_carlo` unless given.", 1, 15
    ),
    "monte_carlo" => reference("monte-carlo"),
    "method" => object([
        (
            "description",
            Value::from(
                "Results in addition to the results of the trials: `exact` for sums and products \
                 of independent contributions, `quasi` for quasi-random points, `monte-carlo` (the \
                 default) for none; `auto` takes exact results if there are any.",
            ),
        ),
        ("enum", texts(["auto", "monte-carlo", "exact", "quasi"])),
    ]),
    "check_units" => described(
        "boolean",
        "Whether dimensions are checked through the formulas; true. If false, formulas compute \
         with the numbers in the declared units, and nothing is converted.",
    ),
    "allow_undefined" => described("number", "Share of trials that may have no finite result; 0.")
                .with("minimum", 0)
                .with("maximum", 1),
    "observations" => reference("observations"),
    "simulator" => reference("simulator"),
    "effects" => reference("effects"),
    "catalogue" => reference("catalogue"),
    "prior" => reference("prior"),
];

fn root() -> Value {
    // an output may also come from a column of the observations
    let makers = ["equations", "model", "observations"];
    let either = makers.map(|key| object([("required", texts([key]))])).to_vec();
    let both = [
        ["coverage_probability", "coverage_factor"],
        ["equations", "model"],
        ["simulator", "equations"],
        ["simulator", "model"],
        ["simulator", "fits"],
    ];
    let both = both.map(|keys| object([("required", texts(keys))])).to_vec();
    let without_inputs = vec![
        object([("required", texts(["inputs"]))]),
        object([("required", texts(["observations"]))]),
        object([("required", texts(["fits"]))]),
    ];
    closed("A model file.", MODEL, &["outputs"])
        .with("anyOf", either)
        .with("allOf", vec![object([("anyOf", Value::from(without_inputs))])])
        .with("not", object([("anyOf", Value::from(both))]))
        .with(
            "dependentRequired",
            object([
                ("coverage_factor_fixed", texts(["coverage_factor"])),
                ("simulator", texts(["observations"])),
            ]),
        )
        .with("examples", vec![example()])
}

/// A whole file.
fn example() -> Value {
    let voltage = object([
        ("unit", Value::from("V")),
        ("distribution", Value::from("normal")),
        ("mean", Value::from(5.01)),
        ("expanded", Value::from(0.02)),
        ("k", Value::from(2)),
        ("about", Value::from("voltmeter's certificate")),
    ]);
    let resistance = object([
        ("unit", Value::from("ohm")),
        ("distribution", Value::from("readings")),
        ("values", Value::from(vec![Value::from(99.8), 100.1.into(), 100.into(), 99.9.into()])),
    ]);
    object([
        ("format", Value::from(1)),
        ("title", Value::from("Power in a resistor")),
        ("inputs", object([("voltage", voltage), ("resistance", resistance)])),
        ("equations", object([("power", Value::from("voltage^2/resistance"))])),
        ("outputs", object([("power", object([("unit", Value::from("mW"))]))])),
    ])
}

/// Keys of a coverage region.
pub(crate) const REGION: &[Key] = keys![
    "outputs" => described("array", "Names of outputs; the name of a complex output means its two parts.")
                .with("items", object([("type", Value::from("string"))]))
                .with("minItems", 1),
    "probability" => referenced("probability", "Coverage probability; the value of the file unless given."),
];

/// Keys of an output.
pub(crate) const OUTPUT: &[Key] = keys![
    "unit" => reference("unit"),
    "about" => text_of("What it is, in words."),
    "complex" => described("string", "The formula's value is complex, and is reported as two outputs: `re-im` as \
                 NAME.re and NAME.im, `polar` as NAME.abs and NAME.arg.")
                .with("enum", texts(["re-im", "polar"])),
    "phase_unit" => referenced("unit", "The unit of the phase of a complex output; rad."),
    "periodic" => referenced("width", "The length of a turn in the output's unit, for phases."),
    "tolerance" => reference("tolerance"),
    "cmc" => referenced("width", "The laboratory's capability: its smallest expanded uncertainty."),
    "cmc_floor" => described("boolean", "Raise a smaller expanded uncertainty to `cmc`."),
    "cmc_line" => reference("cmc-line"),
];

/// Keys of `cmc_line`.
pub(crate) const CMC_LINE: &[Key] = keys![
    "over" => referenced("name", "The condition L."),
    "form" => described("string", "`Q` for Q[a; bL] = sqrt(a^2 + (b L)^2), `sum` for a + b L.")
                .with("enum", texts(["Q", "sum"])),
    "digits" => whole("Significant digits of a and b; 2.", 1, 6),
];

fn cmc_line() -> Value {
    closed(
        "The smallest line over a condition that lies on or above U of all rows, for a CMC.",
        CMC_LINE,
        &["over", "form"],
    )
}

fn output() -> Value {
    closed("A quantity to report.", OUTPUT, &[])
        .with("dependentRequired", object([("cmc_floor", texts(["cmc"]))]))
}

fn prior_of_tolerance() -> Value {
    described(
        "object",
        "What was known before measuring, for global risks: a distribution with its keys.",
    )
    .with("properties", object([("distribution", reference("distribution"))]))
    .with("required", texts(["distribution"]))
}

/// Keys of `tolerance`.
pub(crate) const TOLERANCE: &[Key] = keys![
    "lower" => limit("Lower tolerance limit, or a formula of the conditions."),
    "upper" => limit("Upper tolerance limit, or a formula of the conditions."),
    "prior" => prior_of_tolerance(),
    "risk" => described("number", "The wanted risk of false acceptance, for guard bands.")
                .with("exclusiveMinimum", 0)
                .with("exclusiveMaximum", 0.5),
    "guard_band" => guard_band(),
    "statement" => described("string", "`binary`, or with a guard band `non-binary`: pass, conditional pass, conditional fail, fail (ILAC-G8, 4.2.3).")
        .with("enum", texts(["binary", "non-binary"])),
    "specification" => described("string", "The specification that states the tolerance, for certificates."),
    "agreed" => described("boolean", "Whether the decision rule was agreed with the customer."),
];

fn guard_band() -> Value {
    let about = "The width of the guard band in multiples of the expanded uncertainty U (ILAC-G8: 1), or \
                 the name of a rule.";
    let factor = object([("type", Value::from("number")), ("exclusiveMinimum", Value::from(0))]);
    let rule = object([("enum", texts(GuardRule::ALL.map(GuardRule::name)))]);
    object([("description", Value::from(about)), ("anyOf", Value::from(vec![factor, rule]))])
}

fn limit(about: &str) -> Value {
    let formula = object([("type", Value::from("string"))]);
    object([
        ("description", Value::from(about)),
        (
            "anyOf",
            Value::from(vec![reference("value"), formula, object([("type", Value::from("null"))])]),
        ),
    ])
}

fn tolerance() -> Value {
    let limits = ["lower", "upper"].map(|key| object([("required", texts([key]))])).to_vec();
    closed("Limits that the output should conform to.", TOLERANCE, &[]).with("anyOf", limits)
}

fn conditions() -> Value {
    let text = object([("file", object([("type", Value::from("string"))]))]);
    object([
        (
            "description",
            Value::from("Conditions to sweep over: a grid of values, or the rows of a table."),
        ),
        ("type", Value::from("object")),
        ("if", object([("properties", text), ("required", texts(["file"]))])),
        ("then", reference("table-of-conditions")),
        (
            "else",
            named("A grid; the last condition is the fastest.", reference("condition"))
                .with("minProperties", 1),
        ),
    ])
}

/// Keys of a condition of a grid.
pub(crate) const CONDITION: &[Key] = keys![
    "unit" => reference("unit"),
    "values" => referenced("values", "The values; without them, a column of the observations."),
    "range" => range(),
    "about" => text_of("What it is, in words."),
];

fn range() -> Value {
    referenced(
        "values",
        "The least and the greatest value that it can be set to: where a gap diagnosis may propose to \
         measure.",
    )
    .with("minItems", 2)
    .with("maxItems", 2)
    .with("examples", vec![Value::from(vec![1, 500])])
}

fn condition() -> Value {
    closed("A quantity that is set and known.", CONDITION, &[])
}

fn units_of_columns() -> Value {
    named("Units of the columns, 1 unless given.", reference("unit"))
}

fn columns() -> Value {
    described("array", "The columns that are conditions, all unless given.")
        .with("items", reference("name"))
        .with("minItems", 1)
}

/// Keys of a table of conditions.
pub(crate) const TABLE_OF_CONDITIONS: &[Key] = keys![
    "file" => referenced("file", "A CSV file with a header of names."),
    "units" => units_of_columns(),
    "columns" => columns(),
];

fn table_of_conditions() -> Value {
    closed("The rows of a table.", TABLE_OF_CONDITIONS, &["file"])
}

fn correlation() -> Value {
    let name = || text_of("Name of an input, or `input/component`.");
    let coefficient = described("number", "The correlation coefficient of the two quantities.")
        .with("minimum", -1)
        .with("maximum", 1);
    described("array", "Two names and their coefficient.")
        .with("prefixItems", vec![name(), name(), coefficient])
        .with("items", false)
        .with("minItems", 3)
        .with(
            "examples",
            vec![Value::from(vec![Value::from("a_ref"), Value::from("tilt"), Value::from(0.2)])],
        )
}

fn row_of_matrix() -> Value {
    object([("type", Value::from("array")), ("items", object([("type", Value::from("number"))]))])
}

fn names_of_matrix() -> Value {
    described("array", "The inputs, in the order of rows and columns.")
        .with("items", object([("type", Value::from("string"))]))
}

/// Keys of `correlation_matrix`.
pub(crate) const CORRELATION_MATRIX: &[Key] = keys![
    "names" => names_of_matrix(),
    "values" => described("array", "The rows of the matrix.").with("items", row_of_matrix()),
    "file" => referenced("file", "A CSV file: a header of names, then the rows."),
];

fn correlation_matrix() -> Value {
    let alternatives = vec![
        object([("required", texts(["names", "values"]))]),
        object([("required", texts(["file"]))]),
    ];
    closed("A matrix of correlation coefficients.", CORRELATION_MATRIX, &[])
        .with("oneOf", alternatives)
}

fn trials() -> Value {
    object([
        (
            "description",
            Value::from(
                "Number of trials; 1 000 000 unless given, and more where the digits of a result \
                 need them; 0 for the GUM alone, `adaptive` for as many as the digits need.",
            ),
        ),
        (
            "anyOf",
            Value::from(vec![
                object([("const", Value::from("adaptive"))]),
                object([("const", Value::from(0))]),
                whole("A number of trials.", 2, 1_000_000_000_000),
            ]),
        ),
    ])
}

/// Keys of `monte_carlo`.
pub(crate) const MONTE_CARLO: &[Key] = keys![
    "trials" => trials(),
    "rule" => object([
                (
                    "description",
                    Value::from(
                        "When an adaptive run stops: `7.9` (JCGM 101), which is the default, or \
                         `stein`, the two-stage rule, which meets the tolerance more often.",
                    ),
                ),
                ("enum", texts(["7.9", "stein"])),
            ]),
    "seed" => whole("Seed of the random streams; 1.", 0, u64::MAX),
    "digits" => whole("Digits of the standard uncertainty that are held meaningful; 2.", 1, 15),
    "max_trials" => whole("Largest number of an adaptive run; 1e9.", 20_000, 1_000_000_000_000),
];

fn monte_carlo() -> Value {
    closed("Settings of the Monte Carlo method.", MONTE_CARLO, &[])
}
