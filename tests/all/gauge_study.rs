//! Gauge studies and lines of a capability from the outside.

use std::fs;

use serde_json::{Value, json};

use crate::support::command;

fn compare(table: &str, more: &[&str]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("t.csv"), table).expect("written");
    let mut run = command();
    let run = run.current_dir(folder.path()).args(["compare", "t.csv", "--scheme", "gauge-rr"]);
    let output = run.args(more).output().expect("the program runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// The example of AIAG (Measurement Systems Analysis, 4th ed., tables III-B 8 and 9), as the manual has it.
#[test]
fn the_example_of_the_manual() {
    let table = include_str!("../../models/examples/gauge-study.csv");
    let (code, said, errors) =
        compare(table, &["--lower", "-4 mm", "--upper", "0.4 cm", "--format", "json", "--fail"]);
    assert_eq!(code, Some(0), "{errors}");
    let found: Value = serde_json::from_str(&said).expect("JSON");
    assert_eq!(
        (&found["ndc"], &found["interaction"], &found["unit"]),
        (&json!(4.0), &json!(false), &json!("mm"))
    );
    let gauge = &found["components"][2];
    assert!((gauge["standard_deviation"].as_f64().unwrap() - 0.302_373).abs() < 2e-6, "{gauge}");
    // 45 % of a tolerance of 4 mm
    let (code, page, _) = compare(table, &["--lower", "-2", "--upper", "2", "--fail"]);
    assert!(code == Some(3) && page.contains("not acceptable"), "{page}");
    assert!(page.contains("\"repeatability\"") && page.contains("0.1999 mm"), "{page}");
}

#[test]
fn tables_and_options_that_are_wrong() {
    let table = "part,operator,value\n1,A,1\n1,A,2\n2,A,3\n2,A,4\n1,B,1\n1,B,2\n2,B,3\n2,B,4.5\n";
    assert_eq!(compare(table, &[]).0, Some(0));
    for (table, options, expected) in [
        ("part,value\n1,2\n", &[][..], "`operator` is not there"),
        ("part,operator,value\n1,A,1\n2,A,2\n", &[], "at least two operators"),
        ("part,operator,value\n1,A,1 mm\n1,A,2 s\n", &[], "not in the unit of the others"),
        (table, &["--sigma", "1"], "`--sigma` is for `--scheme iso13528`"),
        (table, &["--upper", "1 mm"], "a plain number"),
        (table, &["--lower", "2", "--upper", "1"], "below `--upper`"),
    ] {
        let (code, _, errors) = compare(table, options);
        assert!(code != Some(0) && errors.contains(expected), "{errors}");
    }
}

/// U = 2 sqrt(0.05^2 + (0.002 L)^2) um at each L is Q[0.1; 0.004 L] um itself.
#[test]
fn a_line_over_a_sweep() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |line: Value| {
        json!({
            "inputs": {
                "z": {"unit": "um", "distribution": "normal", "mean": 0, "std": 0.05},
                "s": {"unit": "um/mm", "distribution": "normal", "mean": 0, "std": 0.002}},
            "conditions": {"L": {"unit": "mm", "values": [0, 10, 25, 50, 100]}},
            "equations": {"e": "z + s*L"}, "outputs": {"e": {"unit": "um", "cmc_line": line}},
            "coverage_factor": 2, "monte_carlo": {"trials": 0}})
    };
    let run = |line: Value, more: &[&str]| {
        fs::write(folder.path().join("m.json"), file(line).to_string()).expect("written");
        let mut run = command();
        let run = run.current_dir(folder.path()).args(["run", "m.json"]).args(more).output();
        let output = run.expect("the program runs");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (text(&output.stdout), text(&output.stderr))
    };
    let (said, errors) = run(json!({"over": "L", "form": "Q"}), &["--format", "json"]);
    let found: Value = serde_json::from_str(&said).unwrap_or_else(|_| panic!("{errors}"));
    let line = &found["cmc_lines"]["e"];
    assert_eq!((&line["a"], &line["b"]), (&json!(0.1), &json!(0.004)), "{line}");
    let (page, _) = run(json!({"over": "L", "form": "Q"}), &[]);
    assert!(page.contains("CMC line: Q[0.1; 0.004 L] um, L in mm."), "{page}");
    // of a convex U the sum goes through the ends: 0.1 and 0.412 311 at 100 mm, 0.003 123 a mm
    let (said, _) = run(json!({"over": "L", "form": "sum", "digits": 3}), &["--format", "json"]);
    let found: Value = serde_json::from_str(&said).expect("JSON");
    assert_eq!(found["cmc_lines"]["e"]["b"], json!(0.00313));
    for (line, expected) in [
        (json!({"over": "p", "form": "Q"}), "`L`"),
        (json!({"over": "L", "form": "q"}), "`sum`"),
        (json!({"over": "L", "form": "Q", "digits": 9}), "from 1 to 6"),
        (json!({"over": "L"}), "`form`"),
    ] {
        let (_, errors) = run(line, &[]);
        assert!(errors.contains(expected), "{errors}");
    }
}
