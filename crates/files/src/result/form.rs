//! The form of the file. Its objects may have further keys, as a later version may write more.
//!
//! The comment of a field is what the schema says of its key.

use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

use super::named;
use crate::keys::node::{With, object, reference, texts};

/// The version of the form that is written.
pub(super) const FORMAT: u32 = 1;

/// At most so many quantiles of an output.
pub(super) const MOST_QUANTILES: usize = 1_000_001;

/// At most so many ranks of an output.
pub(super) const MOST_RANKS: usize = 1_000_000;

/// At most so many trials behind a result.
pub(super) const MOST_TRIALS: u64 = 1_000_000_000_000;

/// Objects of the file: each as a type with a field for every key, and as a definition of the schema.
macro_rules! objects {
    ($(
        #[doc = $about:literal]
        $name:ident as $definition:literal needs $needed:tt {
            $(
                $(#[doc = $text:literal])+
                $(#[serde $serde:tt])?
                $key:ident: $kind:ty => $schema:expr,
            )+
        }
    )+) => {
        $(
            #[doc = $about]
            #[derive(Clone, Debug, Serialize, Deserialize)]
            pub struct $name {
                $(
                    $(#[doc = $text])+
                    $(#[serde $serde])?
                    pub $key: $kind,
                )+
            }
        )+

        /// The definitions of the schema.
        pub(crate) fn definitions() -> Vec<(String, Value)> {
            let mut all = Vec::new();
            $(
                let properties = [$((
                    stringify!($key),
                    described(concat!($($text),+).trim_start(), $schema),
                )),+];
                let node = described($about.trim_start(), kind("object"))
                    .with("properties", object(properties))
                    .with("required", texts($needed));
                all.push(($definition.to_owned(), node));
            )+
            all
        }
    };
}

objects! {
    /// A result file, as `gumption run --save` writes it.
    ResultForm as "result" needs ["format", "result", "outputs", "scores", "inputs", "provenance"] {
        /// Version of the file's form.
        format: u32 => object([("const", Value::from(FORMAT))]),
        /// What tells a result file: true.
        result: bool => object([("const", Value::from(true))]),
        /// Version of the program that wrote the file.
        #[serde(default)]
        gumption: String => kind("string"),
        /// Title of the model that was evaluated.
        #[serde(default)]
        title: String => kind("string"),
        /// That of all intervals of the file.
        #[serde(default, deserialize_with = "given")]
        coverage_probability: Option<f64> => reference("probability"),
        /// The results.
        #[serde(with = "named")]
        outputs: Vec<(String, OutputForm)> => kind("object")
            .with("propertyNames", reference("name"))
            .with("additionalProperties", reference("result-output")),
        /// Correlation coefficients between outputs, from the trials; null where there is none.
        #[serde(default)]
        output_correlations: Vec<(String, String, Option<f64>)> => coefficients(
            &described("Name of an output.", kind("string")),
            texts(["number", "null"]),
        ),
        /// The standard normal scores of the quantiles.
        scores: ScoresForm => reference("result-scores"),
        /// The inputs that the outputs go back to: those of the model file, and in place of a saved
        /// result that it took, that result's own. Those of a saved result that are correlated with
        /// one of them stand there as well, with sensitivity coefficients of 0. What is known exactly
        /// is not among them.
        inputs: Vec<InputForm> => list(reference("result-input")),
        /// Correlation coefficients between `inputs` that are not 0.
        #[serde(default)]
        input_correlations: Vec<(usize, usize, f64)> => coefficients(
            &described("Place in `inputs`, counted from 0.", kind("integer")).with("minimum", 0),
            Value::from("number"),
        ),
        /// Where the result comes from.
        provenance: ProvenanceForm => reference("result-provenance"),
        /// The first digits of the SHA-256 of each part, by the keys that lead to it with `/` between
        /// them, to tell what was changed.
        #[serde(default, with = "named", skip_serializing_if = "Vec::is_empty")]
        sha256_of_parts: Vec<(String, String)> => digests(),
        /// SHA-256 of all else in the file, in hexadecimal: of its JSON without blanks, the keys in
        /// order, a comma after each member, numbers as whole ones or as d.ddde-d.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        sha256: Option<String> => kind("string"),
    }

    /// What was found for an output, in its unit.
    OutputForm as "result-output"
    needs ["unit", "estimate", "standard_uncertainty", "sensitivities", "quantiles"] {
        /// A unit: SI units with prefixes, products, quotients and powers, and those of laboratories; `1`
        /// for a number.
        unit: String => reference("unit"),
        /// The estimate.
        estimate: f64 => kind("number"),
        /// Standard uncertainty by the law of propagation, or that of the trials where there is none.
        standard_uncertainty: f64 => kind("number").with("minimum", 0),
        /// Effective degrees of freedom; null: see `dof_status`.
        dof: Option<f64> => or_null("number").with("exclusiveMinimum", 0),
        /// What `dof` null means.
        #[serde(default, deserialize_with = "given")]
        dof_status: Option<DofStatus> => object([
            ("enum", texts(["finite", "infinite", "undefined"])),
        ]),
        /// Coverage factor k.
        coverage_factor: Option<f64> => or_null("number").with("exclusiveMinimum", 0),
        /// Expanded uncertainty U = k u.
        expanded_uncertainty: Option<f64> => or_null("number"),
        /// Coverage interval of the law of propagation.
        interval: Option<[f64; 2]> => ends(or_null("array")),
        /// Standard deviation of the trials; null where there is none.
        standard_deviation: Option<f64> => or_null("number"),
        /// The fewest degrees of freedom of a t distribution that the trials depend on; null for none.
        drawn_dof: Option<f64> => or_null("number").with("exclusiveMinimum", 0),
        /// Number of trials that the figures are worth, where that is below the number of trials:
        /// where saved results of limited trials went in.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        effective_trials: Option<f64> => reference("positive"),
        /// Symmetric coverage interval of the trials.
        #[serde(default, deserialize_with = "given")]
        symmetric_interval: Option<[f64; 2]> => ends(kind("array")),
        /// Shortest coverage interval of the trials.
        #[serde(default, deserialize_with = "given")]
        shortest_interval: Option<[f64; 2]> => ends(kind("array")),
        /// Sensitivity coefficients to `inputs`, in order, in output unit per input unit; null where
        /// they do not say how the output varies.
        #[serde(deserialize_with = "Option::deserialize")]
        sensitivities: Option<Vec<f64>> => or_null("array").with("items", kind("number")),
        /// Quantiles of the trials: entry k, counted from 0, belongs to the probability
        /// Phi(from + k step) of `scores`.
        quantiles: Vec<f64> => list(kind("number")).with("minItems", 2),
        /// Ranks of the output, from 1, in a few of the trials that stand for all; entry i of all
        /// outputs is of the same trial. So outputs of one file are drawn together. Not where there is
        /// one output alone, nor of one that does not vary.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        ranks: Option<Vec<u32>> =>
            list(described("A rank.", kind("integer")).with("minimum", 1))
                .with("minItems", 2)
                .with("maxItems", MOST_RANKS)
                .with("uniqueItems", true),
    }

    /// The standard normal scores of the quantiles.
    ScoresForm as "result-scores" needs ["from", "step", "count"] {
        /// The first score.
        from: f64 => kind("number"),
        /// The distance of two scores.
        step: f64 => reference("positive"),
        /// How many there are.
        count: usize => kind("integer").with("minimum", 2).with("maximum", MOST_QUANTILES),
    }

    /// An input of a model file, as it was when the result was saved.
    InputForm as "result-input" needs ["model_sha256", "name", "estimate", "standard_uncertainty"] {
        /// SHA-256 of the model file that names it, in hexadecimal.
        model_sha256: String => kind("string"),
        /// Its name there: `input` or `input/component`.
        name: String => kind("string"),
        /// Its unit.
        #[serde(default)]
        unit: String => kind("string"),
        /// Name of its distribution.
        #[serde(default)]
        distribution: String => kind("string"),
        /// Its estimate.
        estimate: f64 => kind("number"),
        /// Its standard uncertainty.
        standard_uncertainty: f64 => reference("positive"),
        /// Standard deviation of the drawn values; null where there is none.
        standard_deviation: Option<f64> => or_null("number").with("exclusiveMinimum", 0),
        /// Degrees of freedom; null for infinite.
        dof: Option<f64> => or_null("number").with("exclusiveMinimum", 0),
        /// SHA-256 of the file that it was read from, or of those of several; with others it is another
        /// quantity.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        data_sha256: Option<String> => kind("string"),
        /// Of a value of a digital calibration certificate, whose SHA-256 is `data_sha256`, its place
        /// there: it is then the same quantity in every model that takes it from there.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        certified: Option<String> => kind("string"),
        /// The conditions that it has a value of its own for.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        row: Option<String> => kind("string"),
        /// Whether its figures follow the conditions: it is then the same quantity also with others,
        /// which elsewhere tell another one.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        follows_conditions: bool => kind("boolean"),
        /// What was put in place of values of the file for it then.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        replaced: Option<String> => kind("string"),
    }

    /// Where the result comes from.
    ProvenanceForm as "result-provenance" needs ["model_sha256"] {
        /// SHA-256 of the model file that was evaluated, in hexadecimal.
        model_sha256: String => kind("string"),
        /// Seed of the random streams.
        #[serde(default, deserialize_with = "given")]
        seed: Option<u64> => kind("integer").with("minimum", 0).with("maximum", u64::MAX),
        /// Number of trials.
        #[serde(default, deserialize_with = "given")]
        trials: Option<u64> => kind("integer").with("minimum", 0).with("maximum", MOST_TRIALS),
        /// SHA-256 of every other file that was read, by its name.
        #[serde(default, with = "named")]
        files: Vec<(String, String)> => digests(),
    }
}

/// What is known of degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DofStatus {
    /// They are a number.
    Finite,
    /// They are infinite.
    Infinite,
    /// There are none.
    Undefined,
}

/// A value that may be left out, but is not null.
fn given<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

/// What the schema says of a value, behind a description.
fn described(about: &str, of: Value) -> Value {
    let mut node = object([("description", Value::from(about))]);
    if let (Value::Object(node), Value::Object(of)) = (&mut node, of) {
        node.extend(of);
    }
    node
}

/// A type.
fn kind(of: &str) -> Value {
    object([("type", Value::from(of))])
}

/// A type, or null.
fn or_null(of: &str) -> Value {
    object([("type", texts([of, "null"]))])
}

fn list(items: Value) -> Value {
    kind("array").with("items", items)
}

/// Two ends of an interval.
fn ends(of: Value) -> Value {
    of.with("items", kind("number")).with("minItems", 2).with("maxItems", 2)
}

fn digests() -> Value {
    kind("object").with("additionalProperties", kind("string"))
}

/// Entries of two of a kind and a coefficient.
fn coefficients(of: &Value, kinds: Value) -> Value {
    let coefficient = object([("description", Value::from("The coefficient.")), ("type", kinds)])
        .with("minimum", -1)
        .with("maximum", 1);
    let entry = described("Two of them and their coefficient.", kind("array"))
        .with("prefixItems", vec![of.clone(), of.clone(), coefficient])
        .with("items", false)
        .with("minItems", 3);
    list(entry)
}
