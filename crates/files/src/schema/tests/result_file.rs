//! The schema of result files is that of the files which are written, and of those which are read.

use std::path::Path;

use serde_json::{Value, json};

use super::{schema, validator};
use crate as file;
use crate::read_result;
use crate::result::seal;
use gumption_engine::distribution::Scores;
use gumption_engine::propagate::{Control, evaluate, linear, origins, quantiles_and_ranks};
use gumption_report::{EvaluationReport, Provenance, saved};

/// What is written for outputs of all kinds: with degrees of freedom, without sensitivities, known
/// exactly, without a variance.
fn written() -> Value {
    let text = r#"{"inputs": {
        "a": {"unit": "V", "distribution": "readings", "values": [1, 2, 3.5, 2, 1.5], "paired": true},
        "b": {"unit": "V", "distribution": "readings", "values": [1, 2.5, 3, 2, 2], "paired": true},
        "c": {"distribution": "rectangular", "mean": 0, "half_width": 1},
        "k": {"distribution": "constant", "value": 2},
        "t": {"distribution": "t", "mean": 0, "scale": 1, "dof": 2}},
        "equations": {"x": "a - b", "square": "c^2", "fixed": "k", "wide": "t"},
        "outputs": {"x": {"unit": "mV"}, "square": {}, "fixed": {}, "wide": {}},
        "monte_carlo": {"trials": 5000}}"#;
    let file = file::read_text("m.json", text, Path::new(""), &[]).unwrap();
    let task = &file.task;
    let control = Control::default();
    let evaluation = evaluate(task, &control).unwrap();
    let scores: Vec<f64> = Scores::WRITTEN.values().collect();
    let found = quantiles_and_ranks(task, &evaluation, 0, &scores, &control);
    let (quantiles, ranks) = found.unwrap().unwrap();
    let gums: Vec<_> = evaluation.rows[0].outputs.iter().map(linear).collect();
    let origins = origins(task, &task.rows[0], &gums, "m");
    let files = vec![("x.csv".to_owned(), "0".to_owned())];
    let provenance = Provenance { model_sha256: "m".to_owned(), files };
    let report =
        EvaluationReport { task, evaluation: &evaluation, warnings: &[], provenance: &provenance };
    serde_json::from_str(&saved(&report, &origins, &quantiles, &ranks)).unwrap()
}

/// The text of a file with the digest of what it says now, where it has one.
fn sealed(file: &Value) -> String {
    let mut file = file.clone();
    if let Value::Object(content) = &mut file
        && content.get(seal::DIGEST).is_some_and(Value::is_string)
    {
        let digest = seal::digest(content);
        content.insert(seal::DIGEST.to_owned(), digest.into());
    }
    file.to_string()
}

/// The places of the objects of a definition in a file.
fn objects(definition: &str, file: &Value) -> Vec<String> {
    let count = |list: &Value| list.as_array().map_or(0, Vec::len);
    match definition {
        "result" => vec![String::new()],
        "result-scores" => vec!["/scores".to_owned()],
        "result-provenance" => vec!["/provenance".to_owned()],
        "result-input" => (0..count(&file["inputs"])).map(|i| format!("/inputs/{i}")).collect(),
        _ => file["outputs"].as_object().unwrap().keys().map(|k| format!("/outputs/{k}")).collect(),
    }
}

const DEFINITIONS: [&str; 5] =
    ["result", "result-output", "result-scores", "result-input", "result-provenance"];

/// Keys that stand in some inputs or outputs only.
const OF_SOME: [&str; 6] =
    ["data_sha256", "certified", "row", "follows_conditions", "replaced", "effective_trials"];

fn properties(definition: &str) -> Vec<String> {
    let schema = schema();
    schema["$defs"][definition]["properties"].as_object().unwrap().keys().cloned().collect()
}

#[test]
fn what_is_written_is_valid() {
    let (validator, file) = (validator(), written());
    let mistakes: Vec<String> = validator.iter_errors(&file).map(|e| e.to_string()).collect();
    assert!(mistakes.is_empty(), "{mistakes:?}");
    assert!(file["outputs"]["square"]["sensitivities"].is_null());
    assert!(file["outputs"]["wide"]["standard_deviation"].is_null());
    read_result("r.json", &file.to_string()).unwrap();
    // the keys that are written are those of the schema, and each has a description there
    for definition in DEFINITIONS {
        let known = properties(definition);
        for place in objects(definition, &file) {
            let object = file.pointer(&place).unwrap().as_object().unwrap();
            let written: Vec<String> = object.keys().cloned().collect();
            let mut known = known.clone();
            // what does not vary has no ranks
            known.retain(|key| key != "ranks" || place != "/outputs/fixed");
            // nor does each input come from a file, or follow conditions, nor each output from results
            known.retain(|key| !OF_SOME.contains(&&**key) || written.contains(key));
            assert_eq!(written, known, "{place}");
        }
    }
    // a file of a later version
    let mut later = file;
    later["outputs"]["x"]["more"] = json!(1);
    assert!(validator.is_valid(&later));
    read_result("r.json", &sealed(&later)).unwrap();
}

/// Every key of the schema is read: a value of the wrong type is refused by both, and what is
/// required is required by both.
#[test]
fn the_reader_reads_the_same_keys() {
    let (validator, file) = (validator(), written());
    let both = |text: &Value| (validator.is_valid(text), read_result("r", &sealed(text)).is_ok());
    for definition in DEFINITIONS {
        // the last output is `x`, by the order of names
        let place = objects(definition, &file).pop().unwrap();
        let required: Vec<String> =
            serde_json::from_value(schema()["$defs"][definition]["required"].clone()).unwrap();
        for key in properties(definition) {
            let mut wrong = file.clone();
            let object = wrong.pointer_mut(&place).unwrap().as_object_mut().unwrap();
            let is_object = object.get(&key).is_some_and(Value::is_object);
            let value = if is_object { json!(1) } else { json!({"wrong": 1}) };
            object.insert(key.clone(), value);
            assert_eq!(both(&wrong), (false, false), "{place}/{key}");
            let mut without = file.clone();
            let object = without.pointer_mut(&place).unwrap().as_object_mut().unwrap();
            object.remove(&key);
            let needed = required.contains(&key);
            // a file without `result` is taken for a model file
            assert_eq!(both(&without), (!needed, !needed), "{place} without {key}");
        }
    }
    let wrong = [
        ("/format", json!(2)),
        ("/result", json!(false)),
        ("/coverage_probability", json!(95)),
        ("/scores/step", json!(0)),
        ("/scores/count", json!(1)),
        ("/inputs/0/standard_uncertainty", json!(0)),
        ("/inputs/0/dof", json!(0)),
        ("/outputs/x/dof_status", json!("unknown")),
        ("/outputs/x/interval", json!([1])),
        ("/outputs/x/quantiles", json!([1])),
        ("/outputs/x/ranks", json!([1])),
        ("/outputs/x/ranks", json!([1, 1])),
        ("/outputs/x/ranks", json!([0, 1])),
        ("/outputs/x/standard_uncertainty", json!(-1)),
        ("/outputs/x/coverage_factor", json!(0)),
        ("/output_correlations", json!([["x", "square"]])),
        ("/output_correlations", json!([["x", "square", 1.5]])),
        ("/input_correlations", json!([[0, 1, 2]])),
        ("/input_correlations", json!([[0, -1, 0.5]])),
        ("/provenance/files", json!({"x.csv": 1})),
    ];
    for (place, value) in wrong {
        let mut file = file.clone();
        *file.pointer_mut(place).unwrap() = value.clone();
        assert_eq!(both(&file), (false, false), "{place}: {value}");
    }
}
