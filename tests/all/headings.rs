//! Headings of tables with a unit: the name stands before it.

use std::fs;

use serde_json::Value;

use crate::support::command;

/// Conditions in kHz and degC, with decimal commas between tabs, and observations of the same table
/// that are named without their unit.
#[test]
fn names_of_columns_have_their_units() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("d.csv"), "f [kHz]\tt / degC\ty (mV)\n1,5\t20\t3,1\n2,5\t25\t5\n")
        .expect("a file");
    let inputs = r#""inputs": {"V": {"unit": "mV", "distribution": "normal", "mean": 2, "std": 0.1}},
        "equations": {"y": "V*f/[kHz] + 0 [V/degC]*(t - t)"}, "outputs": {"y": {"unit": "mV"}}"#;
    let model =
        format!(r#"{{{inputs}, "conditions": {{"file": "d.csv", "columns": ["f", "t"]}}}}"#);
    fs::write(at("m.json"), model).expect("a file");
    let said = command()
        .args(["run", "m.json", "--format", "json", "--quiet", "--trials", "0"])
        .current_dir(folder.path())
        .output()
        .expect("the program runs");
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let answer: Value = serde_json::from_slice(&said.stdout).expect("JSON");
    let rows = answer["outputs"]["y"].to_string() + &answer["rows"].to_string();
    assert!(rows.contains("3.0") && rows.contains("5.0"), "{answer}");
    let case = format!(
        r#"{{{inputs}, "conditions": {{"f": {{"unit": "kHz"}}, "t": {{"unit": "degC"}}}},
        "observations": {{"file": "d.csv", "columns": {{"y": {{"value": "y"}}}}}},
        "effects": {{}}}}"#
    );
    fs::write(at("c.json"), case.clone()).expect("a file");
    let check = |name: &str| {
        let said = command().args(["check", name]).current_dir(folder.path()).output();
        String::from_utf8(said.expect("the program runs").stderr).expect("UTF-8")
    };
    assert_eq!(check("c.json"), "");
    // in another unit than the heading says
    fs::write(at("c.json"), case.replace("\"kHz\"", "\"Hz\"")).expect("a file");
    let said = check("c.json");
    assert!(said.contains("f [kHz]") && said.contains("`Hz`"), "{said}");
}
