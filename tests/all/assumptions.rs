//! `gumption assumptions` from the outside.

use std::fs;

use serde_json::{Value, json};

use crate::support::{command, root};

fn answer(arguments: &[&str]) -> Value {
    let output = command().arg("assumptions").args(arguments).args(["--format", "json"]).output();
    let output = output.expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn input<'a>(answer: &'a Value, output: &str, name: &str) -> &'a Value {
    let inputs = answer["outputs"][output]["inputs"].as_array().expect("a list of inputs");
    inputs.iter().find(|input| input["input"] == name).expect("the input")
}

/// The largest move that another shape with the same limits makes.
fn largest(input: &Value) -> f64 {
    let all = input["alternatives"].as_array().expect("a list of alternatives");
    let changes = all.iter().filter_map(|other| other["change_of_half_length"].as_f64());
    changes.map(f64::abs).fold(0.0, f64::max)
}

/// The budget of the papers: of the rectangular limits that of the tilt matters on every axis, that of
/// the rotation on y alone, and not at all on z, whose equation does not have it.
#[test]
fn the_papers_budget_says_which_rectangles_matter() {
    let model = root().join("models/inclined_plane.json");
    let found = answer(&[model.to_str().expect("a path"), "--trials", "100000"]);
    for (axis, name, matters) in [
        ("a_x", "tilt", true),
        ("a_x", "rotation", false),
        ("a_y", "tilt", true),
        ("a_y", "rotation", true),
        ("a_z", "tilt", true),
        ("a_z", "rotation", false),
    ] {
        let change = largest(input(&found, axis, name));
        assert_eq!(change > 0.05, matters, "{axis} {name} {change}");
    }
    let z = input(&found, "a_z", "rotation");
    assert_eq!((&z["allowed_change"], &z["share"]), (&json!([-1.0, null]), &json!(0.0)));
    // with spurious motion: the limits of +-0.0025 m/s^2 matter nowhere
    let model = root().join("models/inclined_plane_spurious.json");
    let found = answer(&[model.to_str().expect("a path"), "--trials", "50000"]);
    for axis in ["a_x", "a_y", "a_z"] {
        for name in ["a_x_syst", "a_y_syst", "a_z_syst"] {
            let change = largest(input(&found, axis, name));
            assert!(change < 0.05, "{axis} {name} {change}");
        }
        let phase = input(&found, axis, "phase_x_syst");
        assert_eq!((&phase["type"], &phase["alternatives"]), (&json!("A"), &json!([])));
    }
}

const MODEL: &str = r#"{
  "inputs": {
    "tilt": {"unit": "deg", "distribution": "rectangular", "mean": 35, "half_width": 0.1,
             "evidence": {"file": "tilt.txt"}},
    "a": {"distribution": "normal", "mean": 10, "std": 0.01, "evidence": {"values": [10, 10.01, 9.99]}}
  },
  "equations": {"y": "a*cos(tilt)"},
  "outputs": {"y": {}}
}"#;

#[test]
fn readings_in_the_model_file_are_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.json");
    fs::write(&path, MODEL).expect("written");
    let values = ["35.02", "34.93", "35.06", "35.15", "34.96", "35.01"];
    fs::write(folder.path().join("tilt.txt"), values.join("\n")).expect("written");
    let model = path.to_str().expect("a path");
    let found = answer(&[model, "--trials", "20000"]);
    let evidence = found["evidence"].as_array().expect("a list");
    let named = |which: usize, key: &str| evidence[which][key].clone();
    assert_eq!((named(0, "input"), named(0, "readings")), (json!("tilt"), json!(6)));
    assert_eq!((named(0, "verdict"), named(0, "outside")), (json!("too narrow"), json!(1)));
    assert_eq!(evidence[0]["supported"]["parameter"], "half_width");
    let low = evidence[0]["supported"]["interval"][0].as_f64().expect("a number");
    assert!((low - 0.15).abs() < 1e-12, "{low}");
    assert_eq!(named(1, "verdict"), "too few readings to tell");
    assert!(found["provenance"]["files"]["tilt.txt"].is_string());
    // a table, a page and a list say the same
    for format in ["table", "html", "csv"] {
        let arguments = [model, "--trials", "20000", "--format", format, "--quiet"];
        let output = command().arg("assumptions").args(arguments).output().expect("it runs");
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        assert!(output.stderr.is_empty());
        match format {
            "csv" => {
                let mut reader = csv::Reader::from_reader(text.as_bytes());
                let records: Vec<csv::StringRecord> =
                    reader.records().map(|r| r.expect("a record")).collect();
                // baseline, and for each of two inputs eight shapes and two widths
                assert_eq!(records.len(), 1 + 2 * 10);
                let of = &found["outputs"]["y"]["baseline"]["symmetric_interval"][0];
                assert_eq!(records[0][6].parse::<f64>().ok(), of.as_f64());
            }
            "html" => {
                assert!(text.contains("<svg") && text.contains("The readings contradict"));
                assert!(!text.contains("<script") && !text.contains("src=\"http"));
            }
            _ => assert!(text.contains("too narrow") && text.contains("none "), "{text}"),
        }
    }
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let model = root().join("models/inclined_plane_campaign.json");
    let run = |threads: &str| {
        let model = model.to_str().expect("a path");
        let arguments = [model, "--trials", "20000", "--format", "json", "--threads", threads];
        command().arg("assumptions").args(arguments).output().expect("it runs").stdout
    };
    let one = run("1");
    assert!(one == run("3"));
    let found: Value = serde_json::from_slice(&one).expect("JSON");
    assert_eq!(found["rows"].as_array().map(Vec::len), Some(12));
    let keys: Vec<&String> =
        found["rows"][0]["conditions"].as_object().expect("an object").keys().collect();
    assert_eq!(keys.len(), 2);
}

#[test]
fn arguments_that_mean_nothing() {
    let model = root().join("models/inclined_plane.json");
    let model = model.to_str().expect("a path");
    for arguments in
        [["--allow", "0"], ["--allow", "x"], ["--trials", "100"], ["--trials", "adaptive"]]
    {
        let output =
            command().args(["assumptions", model]).args(arguments).output().expect("it runs");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty());
    }
}
