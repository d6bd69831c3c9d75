//! Saved results that were changed, by hand or by a flipped digit.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::support::{command, root};

const MODEL: &str = r#"{"title": "v", "inputs": {
    "x": {"unit": "m", "distribution": "normal", "mean": 10, "std": 0.1, "dof": 9},
    "t": {"unit": "s", "distribution": "rectangular", "mean": 2, "half_width": 0.05}},
    "equations": {"v": "x/t", "w": "x*t"},
    "outputs": {"v": {"unit": "m/s"}, "w": {"unit": "m*s"}},
    "monte_carlo": {"trials": 20000}}"#;

const USE: &str = r#"{"inputs": {"v": {"distribution": "result", "file": "r.json", "output": "v"}},
    "equations": {"y": "2*v"}, "outputs": {"y": {"unit": "m/s"}},
    "monte_carlo": {"trials": 20000}}"#;

/// Exit code and standard error.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = command().current_dir(folder).args(arguments).output().expect("it runs");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn saved(folder: &Path) -> Value {
    fs::write(folder.join("m.json"), MODEL).unwrap();
    fs::write(folder.join("use.json"), USE).unwrap();
    let (code, said) = run(folder, &["run", "m.json", "--save", "r.json", "--quiet"]);
    assert_eq!(code, Some(0), "{said}");
    serde_json::from_str(&fs::read_to_string(folder.join("r.json")).unwrap()).unwrap()
}

/// Each change is refused with its place; without the digest those that cannot be true are.
#[test]
fn every_change_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let whole = saved(folder);
    let (code, said) = run(folder, &["run", "use.json"]);
    assert_eq!((code, said.contains("r.json")), (Some(0), false), "{said}");
    let (code, said) = run(folder, &["check", "r.json"]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    let moved: Vec<Value> = whole["outputs"]["v"]["quantiles"]
        .as_array()
        .unwrap()
        .iter()
        .map(|value| json!(value.as_f64().unwrap() + 10.0))
        .collect();
    let u = whole["outputs"]["v"]["standard_uncertainty"].as_f64().unwrap();
    let correlation = whole["output_correlations"][0][2].as_f64().unwrap();
    // what is changed, to what, and whether other figures speak against it
    for (part, value, impossible) in [
        ("outputs/v/estimate", json!(9.9), true),
        ("outputs/v/estimate", json!(4.967), true),
        ("outputs/v/standard_uncertainty", json!(0.1 * u), true),
        ("outputs/v/standard_deviation", json!(0.01 * u), true),
        ("outputs/v/quantiles", json!(moved), true),
        ("outputs/v/interval", json!([5.2, 4.8]), true),
        ("outputs/v/symmetric_interval", json!([100.0, 200.0]), true),
        ("outputs/v/shortest_interval", json!([5.1, 4.9]), true),
        ("outputs/v/dof", json!(null), true),
        ("outputs/v/dof_status", json!("infinite"), true),
        ("outputs/v/dof", json!(1.0), false),
        ("outputs/v/expanded_uncertainty", json!(1.0), true),
        ("outputs/v/coverage_factor", json!(3.0), true),
        ("outputs/v/sensitivities", json!([100.0, 0.0]), true),
        ("outputs/v/unit", json!("km/s"), false),
        ("output_correlations", json!([["v", "w", -correlation]]), false),
        ("title", json!("w"), false),
        ("gumption", json!("99.0"), false),
        ("provenance", json!({"model_sha256": "0".repeat(64), "seed": 1, "trials": 20000}), false),
        ("scores", json!({"from": 0, "step": 1, "count": 3}), true),
        ("inputs/0", whole["inputs"][1].clone(), true),
    ] {
        let mut changed = whole.clone();
        *changed.pointer_mut(&format!("/{part}")).expect(part) = value;
        let write = |file: &Value| {
            fs::write(folder.join("r.json"), serde_json::to_string_pretty(file).unwrap()).unwrap();
        };
        write(&changed);
        for arguments in
            [&["run", "use.json"][..], &["check", "use.json"], &["diff", "r.json", "m.json"]]
        {
            let (code, said) = run(folder, arguments);
            assert_eq!(code, Some(2), "{part}: {said}");
            assert!(said.contains(&format!("`{part}` was changed")), "{part}: {said}");
            assert!(said.contains("--accept-changed"), "{said}");
        }
        let accepted = run(folder, &["run", "use.json", "--accept-changed"]);
        changed.as_object_mut().unwrap().remove("sha256");
        write(&changed);
        let without = run(folder, &["run", "use.json"]);
        let notes = ["was changed since it was saved", "has no digest"];
        for ((code, said), note) in [accepted, without].into_iter().zip(notes) {
            if impossible {
                assert_eq!(code, Some(2), "{part}: {said}");
            } else {
                assert_eq!(code, Some(0), "{part}: {said}");
                assert!(said.contains(note), "{part}: {said}");
            }
        }
    }
}

/// Another layout or order of keys is no change; the digest itself is one.
#[test]
fn what_the_file_says_counts() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let whole = saved(folder);
    let members = whole.as_object().unwrap().iter().rev();
    let turned: serde_json::Map<String, Value> =
        members.map(|(key, value)| (key.clone(), value.clone())).collect();
    for text in [whole.to_string(), Value::Object(turned).to_string()] {
        fs::write(folder.join("r.json"), text).unwrap();
        let (code, said) = run(folder, &["run", "use.json"]);
        assert_eq!((code, said.contains("r.json")), (Some(0), false), "{said}");
    }
    let mut other = whole.clone();
    other["sha256"] = json!("0".repeat(64));
    fs::write(folder.join("r.json"), other.to_string()).unwrap();
    let (code, said) = run(folder, &["run", "use.json"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("not in a part that can be named"), "{said}");
}

/// What the program writes is consistent: without its digest, too, a result of every ready model is
/// taken.
#[test]
fn results_of_the_ready_models_are_consistent() {
    let folder = tempfile::tempdir().unwrap();
    let mut count = 0;
    for path in crate::support::model_files() {
        let saved = folder.path().join("r.json");
        let save = saved.to_str().unwrap();
        let model = path.to_str().unwrap();
        let (code, said) =
            run(root(), &["run", model, "--trials", "20000", "--save", save, "--quiet"]);
        if code != Some(0) {
            // several rows of conditions
            assert!(said.contains("`--save`"), "{model}: {said}");
            continue;
        }
        let mut file: Value = serde_json::from_str(&fs::read_to_string(&saved).unwrap()).unwrap();
        file.as_object_mut().unwrap().remove("sha256");
        fs::write(&saved, file.to_string()).unwrap();
        let (code, said) = run(root(), &["diff", save, save]);
        assert_eq!(code, Some(0), "{model}: {said}");
        assert!(said.contains("has no digest"), "{said}");
        count += 1;
    }
    assert!(count >= 10, "{count}");
}
