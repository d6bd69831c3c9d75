//! The page shows the figures of the audit.

use super::{AuditReport, json, table};
use crate::Provenance;
use crate::words::Language;
use gumption_assumptions::{Question, audit};
use gumption_engine::propagate::Control;
use gumption_files::read_text;

/// Every index and change of the page is that of the JSON answer, rounded once.
#[test]
fn a_page_and_its_figures() {
    let text = r#"{"title": "Two lengths", "inputs": {
        "a": {"unit": "mm", "distribution": "rectangular", "mean": 10, "half_width": 0.3,
              "evidence": {"values": [9.9, 10.1, 10.25, 9.8, 10.0, 10.4]}},
        "b": {"unit": "mm", "distribution": "normal", "mean": 5, "std": 0.02}},
        "equations": {"l": "a + b"}, "outputs": {"l": {"unit": "mm"}}}"#;
    let file = read_text("m.json", text, std::path::Path::new(""), &[]).unwrap();
    let question = Question { trials: 50_000, allowed: 0.05 };
    let found = audit(&file.task, &file.evidence, question, &Control::default()).unwrap().unwrap();
    let provenance = Provenance::default();
    let report = AuditReport {
        task: &file.task,
        audit: &found,
        warnings: &found.warnings,
        provenance: &provenance,
    };
    let page = table(&report);
    insta::assert_snapshot!(page);
    let answer: serde_json::Value = serde_json::from_str(&json(&report)).unwrap();
    let a = &answer["outputs"]["l"]["inputs"][0];
    let percent = |value: &serde_json::Value| 100.0 * value.as_f64().unwrap();
    let rows: Vec<Vec<&str>> = page.lines().map(|line| line.split_whitespace().collect()).collect();
    let row = rows.iter().find(|row| row.first() == Some(&"a")).unwrap();
    let shown = |place: usize| row[place].trim_start_matches('+').parse::<f64>().unwrap();
    assert!((shown(2) - percent(&a["share"])).abs() <= 0.05);
    assert!((shown(3) - a["sobol_first"].as_f64().unwrap()).abs() <= 0.005);
    assert!((shown(5) - percent(&a["halved"]["change_of_half_length"])).abs() <= 0.05);
    assert!(page.contains("too narrow") && page.contains("The shape of a matters"));
}

/// Readings that lie together off the centre are told beside the verdict: sum 0.1263, mean 0.02105,
/// squares of deviations 1750e-10 over 5, s = 1.87e-4, s/sqrt(6) = 7.6e-5.
#[test]
fn an_offset_is_named() {
    let text = r#"{"inputs": {"off": {"unit": "V", "distribution": "rectangular", "mean": 0,
        "half_width": 0.01, "evidence": {"values": [0.021, 0.0208, 0.0213, 0.0209, 0.0211, 0.0212]}}},
        "equations": {"y": "2*off"}, "outputs": {"y": {"unit": "V"}}}"#;
    let file = read_text("m.json", text, std::path::Path::new(""), &[]).unwrap();
    let question = Question { trials: 20_000, allowed: 0.05 };
    let found = audit(&file.task, &file.evidence, question, &Control::default()).unwrap().unwrap();
    let provenance = Provenance::default();
    let warnings = &found.warnings;
    let report = AuditReport { task: &file.task, audit: &found, warnings, provenance: &provenance };
    let said = "The 6 readings of off agree with each other, but not with the stated centre: their \
                mean is 0.021050 V, their standard deviation 0.00019 V. The mean differs from the \
                centre by 0.021050 V, more than their scatter explains (t test, 99 %). Correct this \
                offset (JCGM 100, 3.2.4), and state the remaining uncertainty.";
    let page = table(&report).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains(&format!("off is too narrow. {said}")), "{page}");
    assert!(super::markdown(&report).replace('\\', "").contains(said));
    assert!(super::fragment(&report, Language::English).contains(said));
    // the decimal mark of the language, in tables as well
    let german = super::fragment(&report, Language::German);
    assert!(german.contains(">0,0239<") && !german.contains(">0.0239<"), "{german}");
    let answer: serde_json::Value = serde_json::from_str(&json(&report)).unwrap();
    let evidence = &answer["evidence"][0];
    assert_eq!(evidence["verdict"], "too narrow");
    assert!((evidence["offset"]["difference"].as_f64().unwrap() - 0.02105).abs() < 1e-12);
}
