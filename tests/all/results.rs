//! `gumption run --save` and `--samples` as a user calls them.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::command;

const MODEL: &str = r#"{"inputs": {
    "x": {"unit": "m", "distribution": "normal", "mean": 10, "std": 0.1},
    "t": {"unit": "s", "distribution": "rectangular", "mean": 2, "half_width": 0.05}},
    "equations": {"v": "x/t", "w": "x*t"},
    "outputs": {"v": {"unit": "m/s"}, "w": {"unit": "m*s"}},
    "monte_carlo": {"trials": 30001}}"#;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = command();
    command.current_dir(folder).arg("run").args(arguments).arg("--quiet");
    command.output().expect("the program runs")
}

fn answer(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

fn json(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    let mut all = arguments.to_vec();
    all.extend(["--format", "json"]);
    serde_json::from_str(&answer(folder, &all)).expect("JSON")
}

/// The written trials are the run's: both forms hold the same bits, and their order statistics of
/// ranks 750 and 29251 of 30001 (JCGM 101, 7.7.2) are the ends of the interval, bit by bit.
#[test]
fn samples_are_the_trials_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("m.json"), MODEL).unwrap();
    let said =
        answer(folder, &["m.json", "--samples", "t.csv", "--format", "json", "--coverage", "0.95"]);
    answer(folder, &["m.json", "--samples", "t.npy", "--threads", "1", "--memory", "1M"]);
    let text = fs::read_to_string(folder.join("t.csv")).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("v,w"));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 30_001);
    let bytes = fs::read(folder.join("t.npy")).unwrap();
    let data = &bytes[10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))..];
    assert_eq!(data.len(), 8 * 2 * 30_001);
    for (value, chunk) in rows.iter().flatten().zip(data.chunks_exact(8)) {
        assert_eq!(value.to_le_bytes(), chunk);
    }
    for output in 0..2 {
        let mut values: Vec<f64> = rows.iter().map(|row| row[output]).collect();
        values.sort_unstable_by(f64::total_cmp);
        let q = (0.95 * 30_001.0 + 0.5_f64).floor() as usize;
        let r = (30_001 - q).div_ceil(2);
        let ends: String =
            said.split("\"symmetric_interval\": [").nth(2 * output + 1).unwrap().into();
        let ends = ends.split(']').next().unwrap();
        let ends: Vec<f64> = ends.split(',').map(|end| end.trim().parse().unwrap()).collect();
        assert_eq!(ends, [values[r - 1], values[r + q - 1]]);
    }
}

/// A difference of two outputs has the U of the direct run, and so has one through two results of
/// the same model file; to 1e-9, the rounding of the saved numbers.
#[test]
fn saved_results_are_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = MODEL.replace(r#""w": "x*t"}"#, r#""w": "x*t", "d": "v - w/4"}"#);
    let text = text.replace(r#""outputs": {"#, r#""check_units": false, "outputs": {"d": {}, "#);
    fs::write(folder.join("m.json"), text).unwrap();
    let direct = json(folder, &["m.json", "--save", "one.json"]);
    answer(folder, &["m.json", "--save", "two.json", "--seed", "2"]);
    let again = fs::read(folder.join("one.json")).unwrap();
    answer(folder, &["m.json", "--save", "one.json", "--threads", "1"]);
    assert_eq!(again, fs::read(folder.join("one.json")).unwrap());
    for second in ["one.json", "two.json"] {
        let text = format!(
            r#"{{"check_units": false, "inputs": {{
                "v": {{"distribution": "result", "file": "one.json", "output": "v"}},
                "w": {{"distribution": "result", "file": "{second}", "output": "w"}}}},
                "equations": {{"d": "v - w/4"}}, "outputs": {{"d": {{}}}}}}"#
        );
        fs::write(folder.join("n.json"), text).unwrap();
        let answer = json(folder, &["n.json"]);
        let of = |answer: &serde_json::Value| {
            answer["outputs"]["d"]["gum"]["expanded_uncertainty"].as_f64().unwrap()
        };
        assert!((of(&answer) / of(&direct) - 1.0).abs() < 1e-9);
        assert!(answer["provenance"]["files"]["one.json"].is_string());
    }
}

/// p = v^2/r comes from a result, and i = p/v takes v once more: by hand i = v/r, u(i)/i =
/// sqrt(0.002^2 + 0.002887^2) = 0.003512; with v counted twice 0.0054. A stated correlation, another
/// value or another name is no such slip.
#[test]
fn an_input_beside_the_result_it_went_into_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let v = r#""v": {"unit": "V", "distribution": "normal", "mean": 5, "std": 0.01}"#;
    let first = format!(
        r#"{{"inputs": {{{v}, "r": {{"unit": "ohm", "distribution": "rectangular", "mean": 100, "half_width": 0.5}}}},
            "equations": {{"p": "v^2/r"}}, "outputs": {{"p": {{"unit": "W"}}}}}}"#
    );
    fs::write(folder.join("m.json"), first).unwrap();
    answer(folder, &["m.json", "--save", "p.json", "--trials", "10000"]);
    let notes = |v: &str, more: &str| {
        let text = format!(
            r#"{{"inputs": {{"p": {{"distribution": "result", "file": "p.json", "output": "p"}}, {v}}},
                {more} "equations": {{"i": "p/v"}}, "outputs": {{"i": {{"unit": "mA"}}}}}}"#
        );
        fs::write(folder.join("n.json"), text).unwrap();
        let found = json(folder, &["n.json", "--trials", "0"]);
        let notes = found["warnings"].as_array().cloned().unwrap_or_default();
        notes.iter().any(|note| note["code"] == "counted-twice")
    };
    assert!(notes(v, ""));
    assert!(!notes(v, r#""correlations": [["p", "v", 0.75]],"#));
    assert!(!notes(&v.replace("0.01", "0.02"), ""));
}

#[test]
fn what_cannot_be_written_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("m.json"), MODEL).unwrap();
    let refused = |arguments: &[&str], reason: &str| {
        let output = run(folder, arguments);
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(reason), "{said}");
    };
    refused(&["m.json", "--samples", "t.txt"], ".csv or .npy");
    refused(&["m.json", "--save", "r.json", "--trials", "0"], "trials");
    let swept =
        MODEL.replacen('{', r#"{"conditions": {"f": {"unit": "Hz", "values": [1, 2]}}, "#, 1);
    fs::write(folder.join("s.json"), swept).unwrap();
    refused(&["s.json", "--save", "r.json"], "conditions");
    assert!(!folder.join("r.json").exists());
}

/// A saved result that is a component counts with its deviation alone, which is told.
#[test]
fn a_result_as_a_component() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("m.json"), MODEL).unwrap();
    answer(folder, &["m.json", "--save", "r.json"]);
    let model = r#"{"inputs": {"a": {"unit": "m/s", "mean": 1, "components": [
        {"name": "x", "distribution": "result", "file": "r.json", "output": "v"}]}},
        "equations": {"y": "a"}, "outputs": {"y": {"unit": "m/s"}}}"#;
    fs::write(folder.join("n.json"), model).unwrap();
    let mut command = command();
    let said = command.current_dir(folder).args(["check", "n.json"]).output().unwrap();
    let said = String::from_utf8_lossy(&[said.stdout, said.stderr].concat()).into_owned();
    assert!(said.contains("of which only the deviation from it counts"), "{said}");
    let found = json(folder, &["n.json"]);
    let estimate = found["outputs"]["y"]["gum"]["estimate"].as_f64().unwrap();
    assert!((estimate - 1.0).abs() < 1e-9, "{estimate}");
}
