//! The keys of a recipe.

use super::node::{Node, object, reference, texts};
use super::values::whole;
use super::{closed, described, named, referenced, text_of};
use crate as file;
use gumption_signal::{Amplitude, Method, PhaseUnit};

pub(super) fn definitions() -> Vec<(String, Node)> {
    let definitions = [
        ("recipe", recipe()),
        ("recording", recording()),
        ("channel", channel()),
        ("step", step()),
        ("recipe-row", row()),
        ("recipe-frequency", frequency()),
        ("recipe-condition", condition()),
        ("quantity", quantity()),
        ("column", column()),
    ];
    definitions.into_iter().map(|(name, node)| (name.to_owned(), node)).collect()
}

/// What a file looks like that is meant as a recipe.
pub(super) fn meant() -> Node {
    super::with_key(file::RECIPE_KEY)
}

fn recipe() -> Node {
    let one_of =
        |about: &str, names: Vec<&str>| described("string", about).with("enum", texts(names));
    let multiples = described("array", "Multiples of the frequency that are given; 1 unless told.")
        .with("items", whole("A multiple.", 1, 50))
        .with("minItems", 1u64);
    let rows = described("array", "Recordings made together, one row of the answer each.")
        .with("items", reference("recipe-row"))
        .with("minItems", 1u64);
    let properties = vec![
        ("format", object([("const", Node::from(1u64))])),
        ("title", text_of("Title.")),
        ("source", text_of("Where it comes from.")),
        (
            "recordings",
            named("The recordings, by name.", reference("recording")).with("minProperties", 1u64),
        ),
        (
            "channels",
            named("The channels, by name.", reference("channel")).with("minProperties", 1u64),
        ),
        ("reference", text_of("The channel that phases and delays are counted from.")),
        ("frequency", frequencies("The frequency of the excitation, for all rows.")),
        ("components", multiples),
        (
            "harmonics",
            whole("The highest multiple that counts as distortion; 5 unless told.", 1, 50),
        ),
        (
            "method",
            one_of(
                "Least-squares fit of sines, or Fourier transform of a whole number of periods between \
                 zero crossings; sine-fit unless told.",
                Method::ALL.map(Method::name).to_vec(),
            ),
        ),
        (
            "amplitude",
            one_of(
                "Peak or RMS amplitudes; peak unless told.",
                Amplitude::ALL.map(Amplitude::name).to_vec(),
            ),
        ),
        (
            "phase_unit",
            one_of(
                "Unit of phases; deg unless told.",
                PhaseUnit::ALL.map(PhaseUnit::name).to_vec(),
            ),
        ),
        ("conditions", named("Columns of conditions.", reference("recipe-condition"))),
        ("rows", rows),
        (
            "trials",
            whole(
                "Trials of the check by Monte Carlo; 2000 unless told, 0 for none.",
                0,
                1_000_000,
            ),
        ),
        ("seed", described("integer", "Seed of the trials; 1 unless told.").with("minimum", 0u64)),
    ];
    closed(
        "A recipe: which channels of which recordings, and what is taken from them.",
        properties,
        &["recordings", "channels"],
    )
}

fn recording() -> Node {
    let properties = vec![
        ("file", referenced("file", "CSV, WAV (`.wav`) or NumPy (`.npy`) file.")),
        (
            "sampling_rate",
            object([
                ("description", Node::from("Sampling rate, in Hz unless told; or how to find it.")),
                ("anyOf", Node::List(vec![reference("quantity"), search()])),
            ]),
        ),
        ("time", referenced("column", "The column of instants.")),
        ("time_unit", referenced("unit", "Unit of the instants; s unless told.")),
        (
            "jitter",
            referenced(
                "quantity",
                "RMS deviation of instants from even spacing, in s unless told.",
            ),
        ),
        (
            "from",
            referenced("quantity", "Instant at which the used part begins, in s unless told."),
        ),
        ("to", referenced("quantity", "Instant at which it ends.")),
    ];
    closed("A recording.", properties, &[])
}

/// The search for a sampling rate.
fn search() -> Node {
    let hertz = |about: &str| referenced("quantity", about);
    let search = closed(
        "The sampling rate at which an oscillation of known frequency is strongest.",
        vec![
            ("channel", text_of("The channel that has the oscillation.")),
            ("frequency", hertz("Its frequency, in Hz unless told; the recipe's unless told.")),
            ("from", hertz("The least rate that comes into question.")),
            ("to", hertz("The greatest.")),
            ("step", hertz("The step of the first look; 1 Hz unless told.")),
        ],
        &["channel", "from", "to"],
    );
    closed("A sampling rate that is searched.", vec![("search", search)], &["search"])
}

fn channel() -> Node {
    let range =
        described("array", "Lowest and highest raw value; beyond it the channel is saturated.")
            .with("items", object([("type", Node::from("number"))]))
            .with("minItems", 2u64)
            .with("maxItems", 2u64);
    let steps = described("array", "What is done with the signal, in order.")
        .with("items", reference("step"));
    let properties = vec![
        ("recording", text_of("The recording; may be left out where there is one.")),
        ("column", referenced("column", "Its column.")),
        ("unit", referenced("unit", "Unit of its values.")),
        (
            "raw_unit",
            referenced("unit", "Unit of the raw values; 1 (counts) where they are scaled."),
        ),
        ("scale", referenced("quantity", "What one raw unit is: 0.244e-3 g_n for a count.")),
        ("sensitivity", referenced("quantity", "What raw values are divided by: 0.01 V/(m/s^2).")),
        ("offset", described("number", "The raw value that means zero; it is taken off.")),
        ("resolution", described("number", "Step of the raw values.").with("minimum", 0.0)),
        ("bits", whole("Bits of the converter, whose span is `range`.", 1, 64)),
        ("range", range),
        ("steps", steps),
    ];
    closed("A channel.", properties, &["column"])
        .with("dependentRequired", object([("bits", texts(["range"]))]))
}

fn step() -> Node {
    let name = object([("enum", texts(file::STEPS.map(|(name, _)| name)))]);
    let hertz = |about: &str| referenced("quantity", about);
    let corners = described("array", "Corner frequencies of high-passes of first order, in Hz.")
        .with("items", object([("type", Node::from("number"))]))
        .with("minItems", 1u64);
    let point = closed(
        "A point of a response.",
        vec![
            ("frequency", hertz("Its frequency, in Hz unless told.")),
            ("gain", referenced("quantity", "Amplitude after over amplitude before.")),
            ("phase", referenced("quantity", "Phase after less phase before, in deg unless told.")),
        ],
        &["frequency", "gain"],
    );
    let properties = vec![
        ("step", name.clone()),
        ("cutoff", hertz("Corner of a low-pass or high-pass filter, in Hz unless told.")),
        ("low", hertz("Lower corner of a band-pass filter.")),
        ("high", hertz("Upper corner of a band-pass filter.")),
        (
            "order",
            whole("Poles of a filter: 6 unless told; even for a band-pass, 2 unless told.", 1, 24),
        ),
        ("both_ways", described("boolean", "Run the filter forward and backward: no phase shift.")),
        (
            "correct",
            described(
                "boolean",
                "Divide amplitudes and phases by the filter's own gain; true unless told.",
            ),
        ),
        ("times", whole("How many derivatives or integrals; 1 unless told.", 1, 4)),
        ("unit", referenced("unit", "Unit of the values after the step.")),
        (
            "highest",
            hertz("Highest frequency that is kept; one multiple above those fitted unless told."),
        ),
        ("radius", referenced("quantity", "Distance of the sensor from the axis, with its unit.")),
        ("gain", referenced("quantity", "Gain that the signal is divided by.")),
        ("phase", referenced("quantity", "Phase that is taken off, in deg unless told.")),
        ("delay", referenced("quantity", "Delay that is taken off, in s unless told.")),
        (
            "response",
            described("array", "Points of the response that the signal is divided by.")
                .with("items", point)
                .with("minItems", 1u64),
        ),
        ("high_passes", corners),
        (
            "segments",
            whole(
                "Segments of the cross-spectrum; one a period, 32 at most, unless told.",
                2,
                10_000,
            ),
        ),
    ];
    let whole = closed("A step with its parameters.", properties, &["step"]);
    object([
        ("description", Node::from("A step: its name, or an object with its name and parameters.")),
        ("anyOf", Node::List(vec![name, whole])),
    ])
}

fn row() -> Node {
    let number = object([("type", Node::from("number"))]);
    let properties = vec![
        ("files", named("The file of each recording.", referenced("file", "The file."))),
        ("frequency", frequencies("The frequency of this row.")),
        ("conditions", named("Values of the conditions, in their units.", number)),
        (
            "from",
            referenced("quantity", "Instant at which the used part begins, in s unless told."),
        ),
        ("to", referenced("quantity", "Instant at which it ends.")),
    ];
    closed("A row of a recipe.", properties, &[])
}

/// A number, numbers, or an object.
fn frequencies(about: &str) -> Node {
    let number = object([("type", Node::from("number")), ("exclusiveMinimum", Node::from(0u64))]);
    let several = object([
        ("type", Node::from("array")),
        ("items", number.clone()),
        ("minItems", Node::from(1u64)),
    ]);
    object([
        ("description", Node::from(about)),
        ("anyOf", Node::List(vec![number, several, reference("recipe-frequency")])),
    ])
}

fn frequency() -> Node {
    let properties = vec![
        (
            "value",
            described("number", "The value, or a first guess.").with("exclusiveMinimum", 0.0),
        ),
        ("values", referenced("numbers", "Several.")),
        ("unit", referenced("unit", "Unit; Hz unless told.")),
        (
            "standard_uncertainty",
            described("number", "Standard uncertainty, in that unit.").with("minimum", 0.0),
        ),
        ("estimate", described("boolean", "Estimate it from the recording (four-parameter fit).")),
        ("name", referenced("name", "Name of the column; f unless told.")),
    ];
    closed("A frequency.", properties, &[])
}

fn condition() -> Node {
    let properties = vec![
        ("unit", referenced("unit", "Its unit.")),
        ("value", described("number", "Its value, where it is the same in all rows.")),
        ("about", text_of("What it is.")),
    ];
    closed("A condition of recordings.", properties, &[])
}

fn quantity() -> Node {
    let properties = vec![
        ("value", described("number", "The value.")),
        ("unit", referenced("unit", "Its unit.")),
        (
            "standard_uncertainty",
            described("number", "Standard uncertainty, in that unit.").with("minimum", 0.0),
        ),
    ];
    let whole = closed("A value with its unit.", properties, &["value"]);
    let number = object([("type", Node::from("number"))]);
    object([
        ("description", Node::from("A number, or a value with unit and standard uncertainty.")),
        ("anyOf", Node::List(vec![number, whole])),
    ])
}

fn column() -> Node {
    let number = whole("Its number, from 1.", 1, 100_000);
    object([
        ("description", Node::from("A column, by its name in the header or by its number.")),
        ("anyOf", Node::List(vec![text_of("Its name."), number])),
    ])
}
