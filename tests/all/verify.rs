//! `gumption verify` as a user runs it.

use serde_json::Value;

use crate::support::{gumption, output};

/// The filed page is what this version prints. It is renewed by
/// `gumption verify --format markdown --output reports/conformance.md`.
#[test]
fn the_filed_page_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/reports/conformance.md");
    let filed = std::fs::read_to_string(path).unwrap();
    let printed = output(&["verify", "--format", "markdown", "--quiet"]);
    for (number, (filed, printed)) in filed.lines().zip(printed.lines()).enumerate() {
        assert_eq!(filed, printed, "line {}", number + 1);
    }
    assert_eq!(filed.len(), printed.len());
}

#[test]
fn formats_say_the_same() {
    let answer: Value =
        serde_json::from_str(&output(&["verify", "--format", "json", "--quiet"])).unwrap();
    let rows = answer["rows"].as_array().unwrap();
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    assert_eq!(answer["pass"], count("PASS"));
    assert_eq!(answer["diff"], count("DIFF"));
    assert_eq!(count("PASS") + count("DIFF"), rows.len());
    for row in rows {
        let [published, tolerance] = ["published", "tolerance"].map(|k| row[k].as_f64().unwrap());
        // what has no recomputed value differs
        let got = row["got"].as_f64().unwrap_or(f64::INFINITY);
        assert_eq!((got - published).abs() <= tolerance, row["verdict"] == "PASS", "{row}");
    }

    let csv = output(&["verify", "--format", "csv", "--quiet", "--threads", "1"]);
    let mut lines = csv.lines();
    let header = "example,output,quantity,published,tolerance,got,verdict";
    assert_eq!(lines.next(), Some(header));
    assert_eq!(lines.count(), rows.len());

    let table = output(&["verify", "--quiet"]);
    assert!(table.lines().all(|line| line.chars().count() <= 100));
    assert_eq!(table.lines().filter(|line| line.ends_with("PASS")).count(), count("PASS"));
    let summary = table.lines().last().unwrap();
    assert!(summary.contains(&format!("{} published values", rows.len())), "{summary}");
    assert!(summary.contains(env!("CARGO_PKG_VERSION")), "{summary}");
}

/// With `--fail` a difference is the answer "no".
#[test]
fn fail_gives_an_exit_code() {
    let answer: Value =
        serde_json::from_str(&output(&["verify", "--format", "json", "--quiet"])).unwrap();
    let expected = if answer["diff"] == 0 { 0 } else { 3 };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("verify.json");
    let run = gumption()
        .args(["verify", "--fail", "--quiet", "--format", "json", "--output"])
        .arg(&file)
        .assert()
        .code(expected);
    assert!(run.get_output().stdout.is_empty());
    let written: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    assert_eq!(written, answer);
}

#[test]
fn paths_are_compared_as_before() {
    let model = "models/inclined_plane.json";
    let text =
        output(&["verify", "--paths", "--model", model, "--trials", "10000", "--threads", "2"]);
    assert!(text.ends_with("10000 trials: the same bits on every path\n"), "{text}");
    // options of the comparison mean nothing without it
    gumption().args(["verify", "--model", model]).assert().code(2);
    gumption().args(["verify", "--trials", "10"]).assert().code(2);
    gumption().args(["verify", "--paths", "--format", "json"]).assert().code(2);
}
