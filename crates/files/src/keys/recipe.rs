//! The keys of a recipe.

use super::node::{With, object, reference, texts};
use super::values::whole;
use super::{Key, closed, described, keys, named, referenced, text_of};
use gumption_signal::{Amplitude, Method, PhaseUnit};
use serde_json::Value;

pub(super) fn definitions() -> Vec<(String, Value)> {
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
pub(super) fn meant() -> Value {
    super::with_key(RECIPE_KEY)
}

fn one_of(about: &str, names: Vec<&str>) -> Value {
    described("string", about).with("enum", texts(names))
}

fn multiples() -> Value {
    described("array", "Multiples of the frequency that are given; 1 unless told.")
        .with("items", whole("A multiple.", 1, 50))
        .with("minItems", 1)
}

fn rows() -> Value {
    described("array", "Recordings made together, one row of the answer each.")
        .with("items", reference("recipe-row"))
        .with("minItems", 1)
}

/// Keys of a recipe.
pub(crate) const RECIPE: &[Key] = keys![
    "format" => object([("const", Value::from(1))]),
    "title" => text_of("Title."),
    "source" => text_of("Where it comes from."),
    "recordings" => named("The recordings, by name.", reference("recording")).with("minProperties", 1),
    "channels" => named("The channels, by name.", reference("channel")).with("minProperties", 1),
    "reference" => text_of("The channel that phases and delays are counted from."),
    "frequency" => frequencies("The frequency of the excitation, for all rows."),
    "components" => multiples(),
    "harmonics" => whole("The highest multiple that counts as distortion; 5 unless told.", 1, 50),
    "method" => one_of(
                "Least-squares fit of sines, or Fourier transform of a whole number of periods between \
                 zero crossings; sine-fit unless told.",
                Method::ALL.map(Method::name).to_vec(),
            ),
    "amplitude" => one_of(
                "Peak or RMS amplitudes; peak unless told.",
                Amplitude::ALL.map(Amplitude::name).to_vec(),
            ),
    "phase_unit" => one_of(
                "Unit of phases; deg unless told.",
                PhaseUnit::ALL.map(PhaseUnit::name).to_vec(),
            ),
    "conditions" => named("Columns of conditions.", reference("recipe-condition")),
    "rows" => rows(),
    "trials" => whole(
                "Trials of the check by Monte Carlo; 2000 unless told, 0 for none.",
                0,
                1_000_000,
            ),
    "seed" => described("integer", "Seed of the trials; 1 unless told.").with("minimum", 0),
];

fn recipe() -> Value {
    closed(
        "A recipe: which channels of which recordings, and what is taken from them.",
        RECIPE,
        &["recordings", "channels"],
    )
}

/// Keys of a recording.
pub(crate) const RECORDING: &[Key] = keys![
    "file" => referenced("file", "CSV, WAV (`.wav`) or NumPy (`.npy`) file."),
    "sampling_rate" => object([
                ("description", Value::from("Sampling rate, in Hz unless told; or how to find it.")),
                ("anyOf", Value::from(vec![reference("quantity"), closed("A sampling rate that is searched.", SEARCHED, &["search"])])),
            ]),
    "time" => referenced("column", "The column of instants."),
    "time_unit" => referenced("unit", "Unit of the instants; s unless told."),
    "jitter" => referenced(
                "quantity",
                "RMS deviation of instants from even spacing, in s unless told.",
            ),
    "from" => referenced("quantity", "Instant at which the used part begins, in s unless told."),
    "to" => referenced("quantity", "Instant at which it ends."),
];

fn recording() -> Value {
    closed("A recording.", RECORDING, &[])
}

fn hertz(about: &str) -> Value {
    referenced("quantity", about)
}

/// Keys of a search for the sampling rate.
pub(crate) const SEARCH: &[Key] = keys![
    "channel" => text_of("The channel that has the oscillation."),
    "frequency" => hertz("Its frequency, in Hz unless told; the recipe's unless told."),
    "from" => hertz("The least rate that comes into question."),
    "to" => hertz("The greatest."),
    "step" => hertz("The step of the first look; 1 Hz unless told."),
];

fn search() -> Value {
    let about = "The sampling rate at which an oscillation of known frequency is strongest.";
    closed(about, SEARCH, &["channel", "from", "to"])
}

/// The key of a sampling rate that is searched for.
pub(crate) const SEARCHED: &[Key] = keys!["search" => search()];

fn range() -> Value {
    described("array", "Lowest and highest raw value; beyond it the channel is saturated.")
        .with("items", object([("type", Value::from("number"))]))
        .with("minItems", 2)
        .with("maxItems", 2)
}

fn steps() -> Value {
    described("array", "What is done with the signal, in order.").with("items", reference("step"))
}

/// Keys of a channel.
pub(crate) const CHANNEL: &[Key] = keys![
    "recording" => text_of("The recording; may be left out where there is one."),
    "column" => referenced("column", "Its column."),
    "unit" => referenced("unit", "Unit of its values."),
    "raw_unit" => referenced("unit", "Unit of the raw values; 1 (counts) where they are scaled."),
    "scale" => referenced("quantity", "What one raw unit is: 0.244e-3 g_n for a count."),
    "sensitivity" => referenced("quantity", "What raw values are divided by: 0.01 V/(m/s^2)."),
    "offset" => described("number", "The raw value that means zero; it is taken off."),
    "resolution" => described("number", "Step of the raw values.").with("minimum", 0),
    "bits" => whole("Bits of the converter, whose span is `range`.", 1, 64),
    "range" => range(),
    "steps" => steps(),
];

fn channel() -> Value {
    closed("A channel.", CHANNEL, &["column"])
        .with("dependentRequired", object([("bits", texts(["range"]))]))
}

/// Keys of a point of a response.
pub(crate) const POINT: &[Key] = keys![
    "frequency" => hertz("Its frequency, in Hz unless told."),
    "gain" => referenced("quantity", "Amplitude after over amplitude before."),
    "phase" => referenced("quantity", "Phase after less phase before, in deg unless told."),
];

fn point() -> Value {
    closed("A point of a response.", POINT, &["frequency", "gain"])
}

fn step_name() -> Value {
    object([("enum", texts(STEPS.map(|(name, _)| name)))])
}

fn corners() -> Value {
    described("array", "Corner frequencies of high-passes of first order, in Hz.")
        .with("items", object([("type", Value::from("number"))]))
        .with("minItems", 1)
}

/// The key that only recipes have.
pub(crate) const RECIPE_KEY: &str = "recordings";

/// The names of the steps, and their keys beside `step`.
pub(crate) const STEPS: [(&str, &[&str]); 14] = [
    ("remove-mean", &[]),
    ("remove-trend", &[]),
    ("whole-periods", &[]),
    ("low-pass", &["cutoff", "order", "both_ways", "correct"]),
    ("high-pass", &["cutoff", "order", "both_ways", "correct"]),
    ("band-pass", &["low", "high", "order", "both_ways", "correct"]),
    ("derivative", &["times", "unit", "highest"]),
    ("integral", &["times", "unit", "highest"]),
    ("tangential", &["radius", "unit", "highest"]),
    ("radial", &["radius", "unit", "highest"]),
    ("correct", &["gain", "phase", "delay", "response", "high_passes"]),
    ("delay", &["segments"]),
    ("rms", &[]),
    (
        "waveform",
        &[
            "response",
            "unit",
            "low_pass",
            "truncation",
            "noise",
            "baseline",
            "delay",
            "additional",
            "quantities",
        ],
    ),
];

/// Keys of any step; each has some of them.
const STEP: &[Key] = keys![
    "step" => step_name().clone(),
    "cutoff" => hertz("Corner of a low-pass or high-pass filter, in Hz unless told."),
    "low" => hertz("Lower corner of a band-pass filter."),
    "high" => hertz("Upper corner of a band-pass filter."),
    "order" => whole("Poles of a filter: 6 unless told; even for a band-pass, 2 unless told.", 1, 24),
    "both_ways" => described("boolean", "Run the filter forward and backward: no phase shift."),
    "correct" => described(
                "boolean",
                "Divide amplitudes and phases by the filter's own gain; true unless told.",
            ),
    "times" => whole("How many derivatives or integrals; 1 unless told.", 1, 4),
    "unit" => referenced("unit", "Unit of the values after the step."),
    "highest" => hertz("Highest frequency that is kept; one multiple above those fitted unless told."),
    "radius" => referenced("quantity", "Distance of the sensor from the axis, with its unit."),
    "gain" => referenced("quantity", "Gain that the signal is divided by."),
    "phase" => referenced("quantity", "Phase that is taken off, in deg unless told."),
    "delay" => referenced("quantity", "Delay that is taken off, in s unless told."),
    "response" => response(),
    "high_passes" => corners(),
    "segments" => whole(
                "Segments of the cross-spectrum, of whole periods each (of one alone the coherence \
                 is 1); unless told as many, 32 at most, as make its uncertainty smallest.",
                2,
                10_000,
            ),
    "low_pass" => one_way(
        "Low-pass of a waveform; `none`: none.",
        &["none"],
        closed("A low-pass of equal poles.", LOW_PASS, &["cutoff"]),
    ),
    "truncation" => one_way(
        "What is known of the part that the low-pass takes away; `none`: the signal has nothing there.",
        &["none"],
        closed("A bound: of its size, or of the spectrum's fall.", TRUNCATION, &[]),
    ),
    "noise" => closed(
        "Noise of a waveform: of a part of the record or of a channel without a signal, or stated.",
        WAVEFORM_NOISE,
        &[],
    ),
    "baseline" => closed(
        "Part of a waveform's record without a signal, whose mean is taken off.",
        BASELINE,
        &["from", "to"],
    ),
    "additional" => referenced(
        "quantity",
        "Standard uncertainty of each value of a waveform by what the record has beside the signal, in the unit of the \
         answer unless told.",
    ),
    "quantities" => described("array", "Figures of a waveform.").with("items", waveform_quantity()),
];

/// Keys of the low-pass of a waveform.
pub(crate) const LOW_PASS: &[Key] = keys![
    "cutoff" => object([
        (
            "description",
            Value::from(
                "Frequency at which its gain is 1/sqrt(2), in Hz unless told; `proposed`: that with which noise and \
                 truncation have the smallest variance together.",
            ),
        ),
        ("anyOf", Value::from(vec![reference("quantity"), object([("enum", texts(["proposed"]))])])),
    ]),
    "order" => whole("Poles; 2 unless told.", 1, 24),
    "delay" => referenced(
        "quantity",
        "What is taken off its delay, in s unless told; without it the low-pass shifts no phase.",
    ),
];

/// Keys of what a low-pass takes away.
pub(crate) const TRUNCATION: &[Key] = keys![
    "bound" => referenced("quantity", "Its greatest size at any instant, in the unit of the answer unless told."),
    "from" => hertz("Frequency from which the spectrum falls at least with the power `decay`, in Hz unless told."),
    "decay" => described("number", "The power of the frequency.").with("exclusiveMinimum", 1),
];

/// Keys of the noise of a waveform.
pub(crate) const WAVEFORM_NOISE: &[Key] = keys![
    "standard_uncertainty" => referenced(
        "quantity",
        "Standard deviation of white noise, in the unit of the channel unless told.",
    ),
    "channel" => text_of("A channel without a signal."),
    "from" => referenced("quantity", "Instant at which a part without a signal begins, in s unless told."),
    "to" => referenced("quantity", "Instant at which it ends."),
    "colour" => described("string", "`measured`: its spectrum counts (unless told); `white`: its variance alone.")
        .with("enum", texts(["measured", "white"])),
];

/// Keys of a part of a record.
pub(crate) const BASELINE: &[Key] = keys![
    "from" => referenced("quantity", "Instant at which it begins, in s unless told."),
    "to" => referenced("quantity", "Instant at which it ends."),
];

/// Keys of a figure of a waveform; each has some of them.
const WAVEFORM_QUANTITY: &[Key] = keys![
    "quantity" => object([("enum", texts(WAVEFORM_QUANTITIES.map(|(name, _)| name)))]),
    "name" => referenced("name", "Its name in the answer; that of the quantity unless told."),
    "level" => described("number", "Level of a duration, of the greatest value.")
        .with("exclusiveMinimum", 0)
        .with("exclusiveMaximum", 1),
    "from" => referenced("quantity", "Instant at which an integral begins, in s unless told."),
    "to" => referenced("quantity", "Instant at which it ends."),
    "channel" => text_of("The channel whose greatest value a ratio is to."),
];

fn waveform_quantity() -> Value {
    let names = object([("enum", texts(WAVEFORM_QUANTITIES.map(|(name, _)| name)))]);
    let whole = closed("A figure with its parameters.", WAVEFORM_QUANTITY, &["quantity"]);
    object([("anyOf", Value::from(vec![names, whole]))])
}

/// One of some words, or an object.
fn one_way(about: &str, words: &[&str], whole: Value) -> Value {
    let words = object([("enum", texts(words.iter().copied()))]);
    object([("description", Value::from(about)), ("anyOf", Value::from(vec![words, whole]))])
}

/// Keys of the response of a waveform.
pub(crate) const RESPONSE: &[Key] = keys![
    "x" => referenced("points", "The frequencies of a calibration, exact."),
    "y" => referenced("complex-points", "The response at these."),
    "correlation" => described(
        "number",
        "Correlation coefficient of the errors of any two points; 0 unless told.",
    )
    .with("minimum", 0)
    .with("maximum", 1),
    "shared" => described(
        "string",
        "Whether all lines of the spectrum about a point have its error (`points`, unless told), or each line one of \
         its own (`lines`).",
    )
    .with("enum", texts(["points", "lines"])),
    "below" => beyond("below the first frequency"),
    "above" => beyond("above the last frequency"),
    "model" => referenced("file", "A model file with the fit, in place of points."),
    "fit" => text_of("The fit of a complex y in that file."),
];

fn beyond(side: &str) -> Value {
    let about = format!("What is done {side}: the point is held, or the signal has nothing there.");
    described("string", &about).with("enum", texts(["hold", "cut"]))
}

fn response() -> Value {
    let points =
        described("array", "For `correct`: points of the response that the signal is divided by.")
            .with("items", point())
            .with("minItems", 1);
    let whole = closed("For `waveform`: points with their uncertainties, or a fit.", RESPONSE, &[]);
    object([("anyOf", Value::from(vec![points, whole]))])
}

/// Keys of a recipe that have a meaning for oscillations only.
pub(crate) const OF_OSCILLATIONS: [&str; 7] =
    ["reference", "frequency", "components", "harmonics", "method", "amplitude", "phase_unit"];

/// The figures of a waveform, and their keys beside `quantity` and `name`.
pub(crate) const WAVEFORM_QUANTITIES: [(&str, &[&str]); 8] = [
    ("maximum", &[]),
    ("minimum", &[]),
    ("maximum-time", &[]),
    ("minimum-time", &[]),
    ("duration", &["level"]),
    ("integral", &["from", "to"]),
    ("squared-integral", &["from", "to"]),
    ("ratio", &["channel"]),
];

fn step() -> Value {
    let whole = closed("A step with its parameters.", STEP, &["step"]);
    object([
        (
            "description",
            Value::from("A step: its name, or an object with its name and parameters."),
        ),
        ("anyOf", Value::from(vec![step_name(), whole])),
    ])
}

fn number() -> Value {
    object([("type", Value::from("number"))])
}

/// Keys of a row of a recipe.
pub(crate) const RECIPE_ROW: &[Key] = keys![
    "files" => named("The file of each recording.", referenced("file", "The file.")),
    "frequency" => frequencies("The frequency of this row."),
    "conditions" => named("Values of the conditions, in their units.", number()),
    "from" => referenced("quantity", "Instant at which the used part begins, in s unless told."),
    "to" => referenced("quantity", "Instant at which it ends."),
];

fn row() -> Value {
    closed("A row of a recipe.", RECIPE_ROW, &[])
}

/// A number, numbers, or an object.
fn frequencies(about: &str) -> Value {
    let number = object([("type", Value::from("number")), ("exclusiveMinimum", Value::from(0))]);
    let several = object([
        ("type", Value::from("array")),
        ("items", number.clone()),
        ("minItems", Value::from(1)),
    ]);
    object([
        ("description", Value::from(about)),
        ("anyOf", Value::from(vec![number, several, reference("recipe-frequency")])),
    ])
}

/// Keys of a frequency.
pub(crate) const FREQUENCY: &[Key] = keys![
    "value" => described("number", "The value, or a first guess.").with("exclusiveMinimum", 0),
    "values" => referenced("numbers", "Several."),
    "unit" => referenced("unit", "Unit; Hz unless told."),
    "standard_uncertainty" => described("number", "Standard uncertainty, in that unit.").with("minimum", 0),
    "estimate" => described("boolean", "Estimate it from the recording (four-parameter fit)."),
    "name" => referenced("name", "Name of the column; f unless told."),
];

fn frequency() -> Value {
    closed("A frequency.", FREQUENCY, &[])
}

/// Keys of a condition of recordings.
pub(crate) const RECIPE_CONDITION: &[Key] = keys![
    "unit" => referenced("unit", "Its unit."),
    "value" => described("number", "Its value, where it is the same in all rows."),
    "about" => text_of("What it is."),
];

fn condition() -> Value {
    closed("A condition of recordings.", RECIPE_CONDITION, &[])
}

/// Keys of a quantity.
pub(crate) const QUANTITY: &[Key] = keys![
    "value" => described("number", "The value."),
    "unit" => referenced("unit", "Its unit."),
    "standard_uncertainty" => described("number", "Standard uncertainty, in that unit.").with("minimum", 0),
];

fn quantity() -> Value {
    let whole = closed("A value with its unit.", QUANTITY, &["value"]);
    let number = object([("type", Value::from("number"))]);
    object([
        ("description", Value::from("A number, or a value with unit and standard uncertainty.")),
        ("anyOf", Value::from(vec![number, whole])),
    ])
}

fn column() -> Value {
    let number = whole("Its number, from 1.", 1, 100_000);
    object([
        ("description", Value::from("A column, by its name in the header or by its number.")),
        ("anyOf", Value::from(vec![text_of("Its name."), number])),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// What a step takes is described, and what is described some step takes.
    #[test]
    fn keys_of_steps() {
        let taken = STEPS.iter().flat_map(|(_, keys)| keys.iter().copied());
        let taken: BTreeSet<&str> = taken.chain(["step"]).collect();
        let described: BTreeSet<&str> = STEP.iter().map(|key| key.name).collect();
        assert_eq!(taken, described);
    }
}
