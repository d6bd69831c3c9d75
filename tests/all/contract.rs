//! Corners of the contract in which two of its sentences meet.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::command;

/// Standard output and error of a run of this file in a folder, with its exit code.
fn told(folder: &Path, model: &str, arguments: &[&str]) -> (String, String, Option<i32>) {
    fs::write(folder.join("m.json"), model).unwrap();
    let all = [&["run", "m.json"], arguments].concat();
    let said = command().args(all).current_dir(folder).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (text(said.stdout), text(said.stderr), said.status.code())
}

/// The estimate and the standard uncertainty of an output by the law of propagation.
fn found(folder: &Path, model: &str, output: &str, arguments: &[&str]) -> (f64, f64) {
    let arguments = [&["--trials", "0", "--format", "json"], arguments].concat();
    let (out, err, code) = told(folder, model, &arguments);
    assert_eq!(code, Some(0), "{err}");
    let answer: Value = serde_json::from_str(&out).unwrap();
    let gum = &answer["outputs"][output]["gum"];
    let number = |key: &str| gum[key].as_f64().unwrap();
    (number("estimate"), number("standard_uncertainty"))
}

/// A built-in model has units of its own: not checking them would take 35 deg for 35 rad.
#[test]
fn units_of_built_in_models_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    let model = r#"{"format": 2, "model": "inclined-plane", "check_units": false, "inputs": {
        "a_ref": "10.00(1) m/s^2", "tilt": "35.0(1) deg", "rotation": "30.0(1) deg"},
        "outputs": {"a_x": {"unit": "m/s^2"}}}"#;
    let (_, err, code) = told(folder.path(), model, &[]);
    assert!(code == Some(2) && err.contains("`check_units`") && err.contains("m.json:1:"), "{err}");
    let (estimate, _) = found(folder.path(), &model.replace("false", "true"), "a_x", &[]);
    // 10 sin(35 deg) cos(30 deg)
    let expected = 10.0 * 35_f64.to_radians().sin() * 30_f64.to_radians().cos();
    assert!((estimate - expected).abs() < 1e-9, "{estimate}");
}

/// Angle in each period times periods in each second is angle in each second, however it is written.
#[test]
fn periods_times_angle_are_no_periods() {
    let folder = tempfile::tempdir().unwrap();
    let model = |formula: &str, unit: &str| {
        format!(
            r#"{{"inputs": {{"f": "10.0(1) Hz", "turns": "1.00(1) rev", "n": "60.0(1) rpm"}},
            "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
        )
    };
    for formula in ["f*[rev]", "f*1[rev]", "f*360[deg]", "turns*f", "n/[rev]*1[rev]"] {
        let (_, err, code) = told(folder.path(), &model(formula, "Hz"), &[]);
        assert!(code == Some(2) && err.contains("counts angle"), "{formula}: {err}");
    }
    for (formula, unit, expected) in [
        ("turns*f", "rpm", 600.0),
        ("turns*f/[rev]", "Hz", 10.0),
        ("turns*f/(2*pi)", "Hz", 10.0),
        ("n/1[rev]", "Hz", 1.0),
        ("turns*f/[Hz]", "deg", 3600.0),
        ("-0.5*f*turns/(2 [Hz])", "rev", -2.5),
    ] {
        let (estimate, _) = found(folder.path(), &model(formula, unit), "y", &[]);
        assert!((estimate - expected).abs() < 1e-9, "{formula} {estimate}");
    }
}

/// A complex quantity is made of its phase in the phase's unit, whether units of formulas are checked or
/// not, and gives it back so; a current called `i` is told.
#[test]
fn phases_of_complex_quantities_have_their_unit() {
    let folder = tempfile::tempdir().unwrap();
    let model = |formula: &str, checked: bool| {
        format!(
            r#"{{"format": 2, "check_units": {checked}, "inputs": {{
            "z": {{"unit": "V", "complex": {{"modulus": {{"distribution": "normal", "mean": 5, "std": 0.1}},
                "phase": {{"unit": "deg", "distribution": "normal", "mean": 30, "std": 1}}}}}},
            "i": {{"distribution": "normal", "mean": 2, "std": 0.1}}}},
            "equations": {{"y": "{formula}"}},
            "outputs": {{"y": {{"unit": "V", "complex": "polar", "phase_unit": "deg"}}}}}}"#
        )
    };
    for checked in [true, false] {
        let (phase, u) = found(folder.path(), &model("z", checked), "y.arg", &[]);
        assert!((phase - 30.0).abs() < 1e-9 && (u - 1.0).abs() < 1e-9, "{checked} {phase} {u}");
    }
    let (_, err, _) = told(folder.path(), &model("z*i", true), &["--trials", "0"]);
    assert!(err.contains("`i` is the quantity of that name"), "{err}");
    let (_, err, _) = told(folder.path(), &model("z", true), &["--trials", "0"]);
    assert!(!err.contains("`i` is the quantity of that name"), "{err}");
}

/// A replaced estimate takes the limits with it: 5 between 4 and 6 at 10 is 10 between 9 and 11.
#[test]
fn limits_move_with_a_replaced_estimate() {
    let folder = tempfile::tempdir().unwrap();
    let model = |extra: &str| {
        format!(
            r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 5, "std": 1, "limits": [4, 6]}}}},
            "equations": {{"y": "x"}}, "outputs": {{"y": {{}}}}{extra}}}"#
        )
    };
    let (_, before) = found(folder.path(), &model(""), "y", &[]);
    let (estimate, u) = found(folder.path(), &model(""), "y", &["--set", "x=10"]);
    assert!((estimate - 10.0).abs() < 1e-12 && (u - before).abs() < 1e-12, "{estimate} {u}");
    let (_, err, code) = told(folder.path(), &model(""), &["--set", "x=10"]);
    assert!(code == Some(0) && err.contains("`limits` of `x` move along"), "{err}");
    // an agreed factor needs the factor
    let fixed = model(r#", "coverage_factor_fixed": true, "coverage_probability": 0.95"#);
    let (_, err, code) = told(folder.path(), &fixed, &[]);
    assert!(code == Some(2) && err.contains("needs the key `coverage_factor`"), "{err}");
    // a value with its uncertainty is a whole input, and no estimate
    let twice = model("").replace("\"mean\": 5", "\"mean\": \"5.0112(23)\"");
    let (_, err, code) = told(folder.path(), &twice, &[]);
    let whole = "the estimate alone; write `\"x\": \"5.0112(23)\"` instead of the object";
    assert!(code == Some(2) && err.contains(whole), "{err}");
}

/// The place of a mistake in a table is that of the table, as the model is called.
#[test]
fn tables_are_named_by_their_path() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("sub/c.csv"), "f\n1\nzwei\n").unwrap();
    let model = r#"{"inputs": {"x": "1.0(1)"}, "equations": {"y": "x*f"}, "outputs": {"y": {}},
        "conditions": {"file": "c.csv", "units": {"f": "1"}}}"#;
    fs::write(folder.path().join("sub/m.json"), model).unwrap();
    let run = command().args(["run", "sub/m.json"]).current_dir(folder.path()).output().unwrap();
    let err = String::from_utf8(run.stderr).unwrap().replace('\\', "/");
    assert!(run.status.code() == Some(2) && err.starts_with("sub/c.csv:3:1:"), "{err}");
}
