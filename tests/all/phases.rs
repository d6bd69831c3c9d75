//! Phases whose trials lie on both sides of the cut of a phase.

use std::fs;

use serde_json::Value;

use crate::support::output;

fn answer(periodic: &str, re: &str) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("phase.json");
    let text = format!(
        r#"{{"inputs": {{"re": {{"distribution": "normal", "mean": {re}, "std": 0.05}},
                       "im": {{"distribution": "normal", "mean": 0.001, "std": 0.05}}}},
            "equations": {{"phi": "atan2(im, re)"}},
            "outputs": {{"phi": {{"unit": "deg"{periodic}}}}}}}"#
    );
    fs::write(&path, text).expect("the model is written");
    let path = path.to_str().expect("UTF-8");
    let run = output(&["run", path, "--format", "json", "--quiet", "--trials", "200000"]);
    serde_json::from_str(&run).expect("JSON")
}

fn notes(answer: &Value) -> Vec<&str> {
    let warnings = answer["warnings"].as_array().expect("warnings");
    warnings.iter().filter_map(|warning| warning["code"].as_str()).collect()
}

/// Half of the trials of a phase of 179.94 deg with a standard uncertainty of 2.9 deg are near
/// -180 deg; `periodic` brings them together.
#[test]
fn a_phase_that_jumps_by_a_turn_is_noticed() {
    let jumps = answer("", "-1");
    let found = jumps["warnings"].as_array().expect("warnings");
    let note = found.iter().find(|warning| warning["code"] == "phase-jumps").expect("the note");
    let text = note["text"].as_str().expect("text");
    assert!(text.contains("`\"periodic\": 360`"), "{text}");
    // u is that of two lumps a turn apart
    let u = |answer: &Value| {
        answer["outputs"]["phi"]["monte_carlo"]["standard_uncertainty"].as_f64().expect("u")
    };
    assert!(u(&jumps) > 100.0);

    let whole = answer(r#", "periodic": 360"#, "-1");
    assert!(!notes(&whole).contains(&"phase-jumps"));
    // 0.05 rad, to some standard errors of 200 000 trials and the curvature of the arctangent
    assert!((u(&whole) - 2.865).abs() < 0.03, "{}", u(&whole));
    // far from the cut there is nothing to say
    assert!(!notes(&answer("", "1")).contains(&"phase-jumps"));
}
