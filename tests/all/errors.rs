//! The smallest file for each mistake, and what is said about it.
//!
//! The files lie in `tests/errors`, the messages in `tests/errors/snapshots`. A new mistake is a new
//! file; `INSTA_UPDATE=always cargo test errors` writes its message.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use crate::support::{command, file_name, root};

/// Mistakes that `check` does not see, with the command that does.
const COMMANDS: [(&str, &[&str]); 27] = [
    ("wrong_kind_of_file", &["certificate", "wrong_kind_of_file.json"]),
    ("several_rows", &["diff", "good.result", "several_rows.json"]),
    ("run_undefined", &["run", "--trials", "1000", "run_undefined.json"]),
    ("certificate_undefined", &["certificate", "--trials", "1000", "certificate_undefined.json"]),
    (
        "certificate_dcc_incomplete",
        &["certificate", "--format", "dcc", "certificate_dcc_incomplete.json"],
    ),
    ("recipe_above_nyquist", &["observe", "recipe_above_nyquist.json"]),
    ("recipe_waveform_beyond_points", &["observe", "recipe_waveform_beyond_points.json"]),
    ("recipe_waveform_integral", &["observe", "recipe_waveform_integral.json"]),
    ("recipe_less_than_one_period", &["observe", "recipe_less_than_one_period.json"]),
    ("recipe_step_not_possible", &["observe", "recipe_step_not_possible.json"]),
    ("recipe_filter_above_nyquist", &["observe", "recipe_filter_above_nyquist.json"]),
    ("recipe_filter_too_long", &["observe", "recipe_filter_too_long.json"]),
    ("recipe_filter_takes_it_out", &["observe", "recipe_filter_takes_it_out.json"]),
    ("recipe_search_without_maximum", &["observe", "recipe_search_without_maximum.json"]),
    ("recipe_search_of_estimate", &["observe", "recipe_search_of_estimate.json"]),
    ("recipe_frequencies_too_near", &["observe", "recipe_frequencies_too_near.json"]),
    ("set_unknown_input", &["run", "--set", "y=2", "set_unknown_input.json"]),
    (
        "readings_unknown_input",
        &["run", "--readings", "readings_unknown_input.csv", "readings_unknown_input.json"],
    ),
    (
        "readings_not_of_readings",
        &["run", "--readings", "readings_not_of_readings.csv", "readings_not_of_readings.json"],
    ),
    (
        "readings_other_unit",
        &["run", "--readings", "readings_other_unit.csv", "readings_other_unit.json"],
    ),
    ("readings_gap", &["run", "--readings", "readings_gap.csv", "readings_gap.json"]),
    ("readings_one", &["run", "--readings", "readings_one.csv", "readings_one.json"]),
    (
        "readings_no_point",
        &["run", "--readings", "readings_no_point.csv", "readings_no_point.json"],
    ),
    (
        "readings_point_missing",
        &["run", "--readings", "readings_point_missing.csv", "readings_point_missing.json"],
    ),
    ("readings_set", &["run", "--set", "V.values=5.01, x", "readings_set.json"]),
    (
        "readings_twice",
        &[
            "run",
            "--readings",
            "readings_twice.csv",
            "--set",
            "V.values=5,6",
            "readings_twice.json",
        ],
    ),
    (
        "readings_of_two_models",
        &["certificate", "--readings", "readings_of_two_models.csv", "readings_of_two_models.json"],
    ),
];

/// Mistakes that no file of a reasonable size and no command shows.
const WITHOUT_EXAMPLE: [&str; 1] = ["more-mistakes"];

fn folder() -> PathBuf {
    root().join("tests/errors")
}

fn names() -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder())
        .expect("the folder of mistakes")
        .map(|entry| file_name(&entry.expect("an entry").path()))
        .filter_map(|name| name.strip_suffix(".json").map(str::to_owned))
        .collect();
    names.sort();
    names
}

#[test]
fn every_mistake_is_explained() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(folder().join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for name in names() {
            let file = format!("{name}.json");
            let special = COMMANDS.iter().find(|(of, _)| *of == name);
            let arguments = special.map_or(vec!["check", &file], |(_, words)| words.to_vec());
            let said = command().current_dir(folder()).args(&arguments).output();
            let said = said.expect("the program runs");
            assert_eq!(said.status.code(), Some(2), "{name}");
            assert!(said.stdout.is_empty(), "{name}");
            insta::assert_snapshot!(name, String::from_utf8_lossy(&said.stderr));
        }
    });
}

/// The codes that `check --format json` gives, and that of each special command by its message.
fn shown_codes() -> BTreeSet<String> {
    let mut codes: BTreeSet<String> =
        ["evaluation", "bad-override", "several-rows", "wrong-file"].map(str::to_owned).into();
    for name in names() {
        if COMMANDS.iter().any(|(special, _)| *special == name) {
            continue;
        }
        let arguments = ["check", &format!("{name}.json"), "--format", "json", "--quiet"];
        let answer = command().current_dir(folder()).args(arguments).output();
        let answer: Value =
            serde_json::from_slice(&answer.expect("the program runs").stdout).expect("JSON");
        assert_eq!(answer["ok"], false, "{name}");
        for error in answer["errors"].as_array().expect("a list of errors") {
            codes.insert(error["code"].as_str().expect("a code").to_owned());
        }
    }
    codes
}

/// The codes in the text of `DiagnosticKind::code`: the quoted words after `=> "`.
fn all_codes() -> BTreeSet<String> {
    let source =
        fs::read_to_string(root().join("crates/text/src/diagnostic_kind.rs")).expect("the source");
    let body = source.split("fn code(").nth(1).expect("the function `code`");
    let body = body.split("pub fn").next().expect("its body");
    let codes: BTreeSet<String> = body
        .split("=> \"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .map(str::to_owned)
        .collect();
    assert!(codes.len() > 40, "only {} codes found", codes.len());
    codes
}

#[test]
fn every_kind_of_mistake_has_an_example() {
    let (all, shown) = (all_codes(), shown_codes());
    let missing: Vec<&String> =
        all.difference(&shown).filter(|code| !WITHOUT_EXAMPLE.contains(&code.as_str())).collect();
    assert!(missing.is_empty(), "no example in tests/errors: {missing:?}");
    let invented: Vec<&String> = shown.difference(&all).collect();
    assert!(invented.is_empty(), "codes that `DiagnosticKind::code` does not have: {invented:?}");
}

#[test]
fn all_mistakes_of_a_file_come_at_once() {
    let answer = command()
        .current_dir(folder())
        .args(["check", "ten_mistakes.json", "--format", "json", "--quiet"])
        .output()
        .expect("the program runs");
    let answer: Value = serde_json::from_slice(&answer.stdout).expect("JSON");
    let errors = answer["errors"].as_array().expect("a list of errors");
    let codes: BTreeSet<&str> = errors.iter().filter_map(|error| error["code"].as_str()).collect();
    assert!(codes.len() >= 10, "{codes:?}");
    let places: Vec<u64> = errors.iter().filter_map(|error| error["line"].as_u64()).collect();
    assert_eq!(places.len(), errors.len());
    assert!(places.is_sorted());
    assert!(errors.iter().all(|error| error["column"].as_u64().is_some_and(|column| column > 0)));
}
