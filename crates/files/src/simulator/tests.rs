//! Cases with a simulator as they are read, and what is asked for where they do not say enough.

use std::path::Path;

use serde_json::{Value, json};

use super::super::{CaseFile, FileReader};
use gumption_gap::ModelForm;

/// A pendulum whose losses a program knows, measured at four instants.
fn pendulum() -> Value {
    json!({
        "inputs": {"length": {"unit": "m", "distribution": "normal", "mean": 0.5, "std": 0.001}},
        "conditions": {"t": {"unit": "s"}},
        "simulator": {"outputs": {"angle": "mrad"}},
        "outputs": {"angle": {"unit": "rad"}},
        "observations": {"file": "data.csv", "columns": {
            "angle": {"value": "angle", "standard_uncertainty": 0.5}}},
        "effects": {
            "scale": {"overrides": {"angle": "angle*(1 + k)"}, "parameters": {
                "k": {"unit": "1", "distribution": "normal", "mean": 0, "std": 0.01}}},
            "air-drag": {"simulator": true, "parameters": {
                "drag": {"unit": "1/s", "distribution": "rectangular", "lower": 0, "upper": 0.2}}},
            "hysteresis": {"simulator": true, "neutral": {"height": "0 mm"}, "parameters": {
                "width": {"unit": "1", "distribution": "log-uniform", "lower": 1e-4, "upper": 0.01},
                "height": {"unit": "m", "distribution": "rectangular", "lower": 0, "upper": 1}}}
        }
    })
}

fn read(file: &Value) -> Result<CaseFile, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("data.csv"), "t,angle\n0,0.1\n1,0.2\n2,0.1\n3,0.05\n")
        .unwrap();
    let text = file.to_string();
    FileReader::default()
        .case_text("case.json", &text, folder.path())
        .map_err(|mistakes| mistakes.to_string())
}

#[test]
fn a_simulator_gets_inputs_and_the_parameters_of_its_effects() {
    let case = read(&pendulum()).unwrap().case;
    assert!(matches!(case.model.maker, ModelForm::Simulated));
    let effects: Vec<Option<usize>> = case.candidates.iter().map(|c| c.simulator).collect();
    assert_eq!(effects, [None, Some(0), Some(1)]);
    let space = case.simulator.as_ref().unwrap().space();
    assert_eq!(space.names(), ["length", "drag", "width", "height"]);
    assert!(!case.simulator.as_ref().unwrap().is_noisy());
    // the width is at the median of its logarithm where nothing names it neutral
    let values = space.values(&[], &[0.0]);
    assert_eq!([values[0], values[1], values[3]], [0.5, 0.0, 0.0]);
    assert!((values[2] - 1e-3).abs() < 1e-15);
    // until it is run its outputs are those that were measured, in its own unit, beside the row's number
    let row = &case.task.rows[3];
    assert_eq!(case.simulated, 2);
    assert_eq!((row.conditions[0], row.conditions[2]), (3.0, 3.0));
    assert!((row.conditions[1] - 50.0).abs() < 1e-12);
    // and formulas act on them, in the output's unit
    let scaled = case.program(&[0]).evaluate(&[0.5, 3.0, 50.0, 3.0, 0.1]);
    assert!((scaled[0] - 0.055).abs() < 1e-15, "{scaled:?}");
    assert_eq!(case.check(), Ok(()));
}

/// An angle of the whole turn makes no effect absent, so that the size alone is left.
#[test]
fn an_effect_with_a_size_and_a_direction_is_absent_without_its_size() {
    let mut file = pendulum();
    file["effects"]["eccentricity"] = json!({"simulator": true, "parameters": {
        "phase": {"unit": "deg", "distribution": "rectangular", "lower": 0, "upper": 360},
        "size": {"unit": "m", "distribution": "log-uniform", "lower": 1e-4, "upper": 1e-2}}});
    let case = read(&file).unwrap().case;
    let space = case.simulator.as_ref().unwrap().space();
    let values = space.values(&[], &[0.0]);
    assert_eq!(space.names()[4..], ["phase", "size"]);
    assert!((values[4] - 180.0).abs() < 1e-12 && values[5] == 0.0, "{values:?}");
    file["effects"]["eccentricity"]["parameters"]["phase"]["upper"] = json!(180);
    assert!(read(&file).unwrap_err().contains("has 2 parameters; say which of them"));
}

/// Changes the case at a pointer; `null` takes away what is there.
fn mistake(pointer: &str, key: &str, value: Value) -> String {
    let mut file = pendulum();
    let object = file.pointer_mut(pointer).unwrap().as_object_mut().unwrap();
    if value.is_null() {
        object.remove(key);
    } else {
        object.insert(key.to_owned(), value);
    }
    read(&file).unwrap_err()
}

#[test]
fn what_a_simulator_lacks_is_asked_for() {
    let own = |pointer: &str, key: &str, value: Value, said: &str| {
        let found = mistake(pointer, key, value);
        assert!(found.contains(said), "{found}");
    };
    let (hysteresis, drag) = ("/effects/hysteresis", "/effects/air-drag");
    own(hysteresis, "neutral", Value::Null, "has 2 parameters; say which of them make it absent");
    own(hysteresis, "neutral", json!({}), "names no parameter that makes it absent");
    own(hysteresis, "neutral", json!({"depth": 0}), "has no parameter `depth`");
    own(drag, "parameters", json!({}), "has no parameter, and the simulator can only do");
    own(drag, "overrides", json!({"angle": "angle"}), "take out `simulator` or `overrides`");
    own(drag, "simulator", json!(false), "overrides");
    own("/effects/scale", "neutral", json!({"k": 0}), "its formulas say when it is absent");
    let same = json!({"length": {"unit": "m", "distribution": "normal", "mean": 0, "std": 1}});
    own(drag, "parameters", same, "there are two of `length`");
    own("/simulator", "outputs", json!({"angle": "mm"}), "gives `angle` in mm");
    own("/simulator", "outputs", json!({"rate": "1"}), "does not give the output `angle`");
    own("", "equations", json!({"angle": "t"}), "take one of them out");
    own("", "simulator", Value::Null, "needs `equations`");
    let of_rows =
        json!({"unit": "m", "distribution": "normal", "mean": 0.5, "std": 0.1, "per": "row"});
    own("/inputs", "length", of_rows, "one value of each input for all rows");
}

#[test]
fn a_simulator_is_run_by_the_diagnosis_alone() {
    let text = pendulum().to_string();
    let file = FileReader::default().model_text("case.json", &text, Path::new(""), &[]);
    assert!(file.unwrap_err().to_string().contains("`gumption gap` alone"));
}

#[test]
fn a_simulator_may_be_noisy() {
    let mut file = pendulum();
    file["simulator"]["noisy"] = json!(true);
    assert!(read(&file).unwrap().case.simulator.unwrap().is_noisy());
    file["simulator"]["noisy"] = json!("yes");
    let wrong = read(&file).unwrap_err();
    assert!(wrong.contains("`noisy`") && wrong.contains("true or false"), "{wrong}");
    file["simulator"] = json!({"outputs": {"angle": "mrad"}, "noise": true});
    assert!(read(&file).unwrap_err().contains("`noise`"));
}
