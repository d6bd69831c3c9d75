//! The model file: its root, outputs, conditions, correlations and settings.

use super::node::{Node, object, reference, texts};
use super::values::whole;
use super::{closed, described, named, referenced, text_of};

pub(super) fn definitions() -> Vec<(String, Node)> {
    let definitions = [
        ("model", root()),
        ("output", output()),
        ("tolerance", tolerance()),
        ("conditions", conditions()),
        ("condition", condition()),
        ("table-of-conditions", table_of_conditions()),
        ("correlation", correlation()),
        ("correlation-matrix", correlation_matrix()),
        ("monte-carlo", monte_carlo()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

fn root() -> Node {
    let properties =
        vec![
        (
            "format",
            object([
                ("description", Node::from("Version of the file's form.")),
                ("const", Node::from(1u64)),
            ]),
        ),
        ("title", text_of("What is measured, in a line.")),
        ("source", text_of("The document that the measurement follows.")),
        ("about", text_of("Remarks.")),
        (
            "inputs",
            named(
                "What is known about the input quantities; their order is that of every table.",
                reference("input"),
            ),
        ),
        (
            "correlations",
            described("array", "Correlation coefficients of inputs or components.")
                .with("items", reference("correlation")),
        ),
        ("correlation_matrix", reference("correlation-matrix")),
        ("conditions", reference("conditions")),
        (
            "equations",
            named(
                "Formulas, in order; each may use inputs, conditions and the quantities above it.",
                text_of("A formula in coherent SI units."),
            )
            .with("minProperties", 1u64),
        ),
        ("model", text_of("Name of a typed model, in place of `equations`: `gumption models`.")),
        (
            "outputs",
            named("The quantities to report.", reference("output")).with("minProperties", 1u64),
        ),
        ("coverage_probability", referenced("probability", "Coverage probability; 0.95.")),
        (
            "coverage_factor",
            described("number", "Coverage factor for infinite degrees of freedom; sets the \
                                 coverage probability.")
                .with("exclusiveMinimum", 0.0)
                .with("maximum", 8.0),
        ),
        (
            "coverage_factor_fixed",
            described("boolean", "Keep the coverage factor whatever the degrees of freedom."),
        ),
        ("monte_carlo", reference("monte-carlo")),
        (
            "check_units",
            described("boolean", "Whether dimensions are checked through the formulas; true."),
        ),
        (
            "allow_undefined",
            described("number", "Share of trials that may have no finite result; 0.")
                .with("minimum", 0.0)
                .with("maximum", 1.0),
        ),
        ("observations", reference("observations")),
        ("effects", reference("effects")),
        ("catalogue", reference("catalogue")),
        ("prior", reference("prior")),
    ];
    // an output may also come from a column of the observations
    let makers = ["equations", "model", "observations"];
    let either = makers.map(|key| object([("required", texts([key]))])).to_vec();
    let both = [["coverage_probability", "coverage_factor"], ["equations", "model"]];
    let both = both.map(|keys| object([("required", texts(keys))])).to_vec();
    let without_inputs = vec![
        object([("required", texts(["inputs"]))]),
        object([("required", texts(["observations"]))]),
    ];
    closed("A model file.", properties, &["outputs"])
        .with("anyOf", either)
        .with("allOf", vec![object([("anyOf", Node::List(without_inputs))])])
        .with("not", object([("anyOf", Node::List(both))]))
        .with("dependentRequired", object([("coverage_factor_fixed", texts(["coverage_factor"]))]))
        .with("examples", vec![example()])
}

/// A whole file.
fn example() -> Node {
    let voltage = object([
        ("unit", Node::from("V")),
        ("distribution", Node::from("normal")),
        ("mean", Node::from(5.01)),
        ("expanded", Node::from(0.02)),
        ("k", Node::from(2.0)),
        ("about", Node::from("voltmeter's certificate")),
    ]);
    let resistance = object([
        ("unit", Node::from("ohm")),
        ("distribution", Node::from("readings")),
        ("values", Node::List([99.8, 100.1, 100.0, 99.9].map(Node::from).to_vec())),
    ]);
    object([
        ("format", Node::from(1u64)),
        ("title", Node::from("Power in a resistor")),
        ("inputs", object([("voltage", voltage), ("resistance", resistance)])),
        ("equations", object([("power", Node::from("voltage^2/resistance"))])),
        ("outputs", object([("power", object([("unit", Node::from("mW"))]))])),
    ])
}

/// Keys of an output.
fn output() -> Node {
    let properties = vec![
        ("unit", reference("unit")),
        ("about", text_of("What it is, in words.")),
        (
            "periodic",
            referenced("positive", "The length of a turn in the output's unit, for phases."),
        ),
        ("tolerance", reference("tolerance")),
        (
            "cmc",
            referenced("width", "The laboratory's capability: its smallest expanded uncertainty."),
        ),
        ("cmc_floor", described("boolean", "Raise a smaller expanded uncertainty to `cmc`.")),
    ];
    closed("A quantity to report.", properties, &[])
        .with("dependentRequired", object([("cmc_floor", texts(["cmc"]))]))
}

fn tolerance() -> Node {
    let prior = described("object", "What was known before measuring, for global risks.")
        .with("properties", object([("distribution", reference("distribution"))]))
        .with("required", texts(["distribution"]));
    let limits = ["lower", "upper"].map(|key| object([("required", texts([key]))])).to_vec();
    let properties = vec![
        ("lower", referenced("number", "Lower tolerance limit.")),
        ("upper", referenced("number", "Upper tolerance limit.")),
        ("prior", prior),
        (
            "risk",
            described("number", "The wanted risk of false acceptance, for guard bands.")
                .with("exclusiveMinimum", 0u64)
                .with("exclusiveMaximum", 0.5),
        ),
    ];
    closed("Limits that the output should conform to.", properties, &[]).with("anyOf", limits)
}

fn conditions() -> Node {
    let text = object([("file", object([("type", Node::from("string"))]))]);
    object([
        (
            "description",
            Node::from("Conditions to sweep over: a grid of values, or the rows of a table."),
        ),
        ("type", Node::from("object")),
        ("if", object([("properties", text), ("required", texts(["file"]))])),
        ("then", reference("table-of-conditions")),
        (
            "else",
            named("A grid; the last condition is the fastest.", reference("condition"))
                .with("minProperties", 1u64),
        ),
    ])
}

fn condition() -> Node {
    let properties = vec![
        ("unit", reference("unit")),
        (
            "values",
            referenced("numbers", "The values; without them, a column of the observations."),
        ),
        ("about", text_of("What it is, in words.")),
    ];
    closed("A quantity that is set and known.", properties, &[])
}

fn table_of_conditions() -> Node {
    let units = named("Units of the columns, 1 unless given.", reference("unit"));
    let columns = described("array", "The columns that are conditions, all unless given.")
        .with("items", reference("name"))
        .with("minItems", 1u64);
    let properties = vec![
        ("file", referenced("file", "A CSV file with a header of names.")),
        ("units", units),
        ("columns", columns),
    ];
    closed("The rows of a table.", properties, &["file"])
}

fn correlation() -> Node {
    let name = || text_of("Name of an input, or `input/component`.");
    let coefficient = described("number", "The correlation coefficient of the two quantities.")
        .with("minimum", -1.0)
        .with("maximum", 1.0);
    described("array", "Two names and their coefficient.")
        .with("prefixItems", vec![name(), name(), coefficient])
        .with("items", false)
        .with("minItems", 3u64)
        .with(
            "examples",
            vec![Node::List(vec![Node::from("a_ref"), Node::from("tilt"), Node::from(0.2)])],
        )
}

fn correlation_matrix() -> Node {
    let row = object([
        ("type", Node::from("array")),
        ("items", object([("type", Node::from("number"))])),
    ]);
    let names = described("array", "The inputs, in the order of rows and columns.")
        .with("items", object([("type", Node::from("string"))]));
    let properties = vec![
        ("names", names),
        ("values", described("array", "The rows of the matrix.").with("items", row)),
        ("file", referenced("file", "A CSV file: a header of names, then the rows.")),
    ];
    let alternatives = vec![
        object([("required", texts(["names", "values"]))]),
        object([("required", texts(["file"]))]),
    ];
    closed("A matrix of correlation coefficients.", properties, &[]).with("oneOf", alternatives)
}

fn monte_carlo() -> Node {
    let trials = object([
        (
            "description",
            Node::from(
                "Number of trials, 1 000 000 unless given; 0 for the GUM alone, `adaptive` for as \
                 many as the digits need.",
            ),
        ),
        (
            "anyOf",
            Node::List(vec![
                object([("const", Node::from("adaptive"))]),
                object([("const", Node::from(0u64))]),
                whole("A number of trials.", 2, 1_000_000_000_000),
            ]),
        ),
    ]);
    let properties = vec![
        ("trials", trials),
        (
            "rule",
            object([
                (
                    "description",
                    Node::from(
                        "When an adaptive run stops: `7.9` (JCGM 101), which is the default, or \
                         `stein`, the two-stage rule, which meets the tolerance more often.",
                    ),
                ),
                ("enum", texts(["7.9", "stein"])),
            ]),
        ),
        ("seed", whole("Seed of the random streams; 1.", 0, u64::MAX)),
        ("digits", whole("Digits of the standard uncertainty that are held meaningful; 2.", 1, 15)),
        ("max_trials", whole("Largest number of an adaptive run; 1e9.", 20_000, 1_000_000_000_000)),
    ];
    closed("Settings of the Monte Carlo method.", properties, &[])
}
