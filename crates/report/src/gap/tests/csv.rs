//! Lines for programs.

use super::super::csv;
use super::{bare, diagnosis, json};

#[test]
fn full_precision_and_all_hypotheses() {
    let diagnosis = diagnosis();
    let text = csv(&diagnosis);
    let answer = json(&diagnosis);
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0][..4], ["kind", "effects", "prior", "probability"]);
    assert_eq!(lines.len(), 1 + diagnosis.hypotheses.len());
    let kinds: Vec<&str> = lines[1..].iter().map(|line| line[0]).collect();
    assert_eq!(kinds, ["explained", "explained", "unexplained", "none", "explained"]);
    assert_eq!(lines[2][1], "low-pass + delay");
    for (line, own) in lines[1..].iter().zip(answer["hypotheses"].as_array().unwrap()) {
        let keys = ["prior", "probability", "log_evidence", "standard_error", "ess"];
        for (cell, key) in line[2..].iter().zip(keys) {
            assert_eq!(cell.parse::<f64>().ok(), own[key].as_f64(), "{key}");
        }
    }
}

#[test]
fn what_is_not_finite_is_empty() {
    assert_eq!(csv(&bare()).lines().nth(1), Some("none,,1,1,,,0"));
}
