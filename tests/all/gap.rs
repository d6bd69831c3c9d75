//! `gumption gap` as a user runs it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{gumption, numbers};

/// A scale whose gain error grows with the load, and two effects that it may have.
const CASE: &str = r#"{
  "title": "A scale over its loads",
  "inputs": {"zero": {"unit": "g", "distribution": "normal", "mean": 0, "std": 0.02}},
  "conditions": {"load": {"unit": "g"}},
  "equations": {"shown": "load + zero"},
  "outputs": {"shown": {"unit": "g"}},
  "observations": {
    "file": "data.csv",
    "columns": {"shown": {"value": "shown", "standard_uncertainty": "u"}}
  },
  "effects": {
    "gain": {
      "parameters": {"k": {"unit": "%", "distribution": "normal", "mean": 0, "std": 0.5}},
      "overrides": {"shown": "shown*(1 + k)"}
    },
    "shift": {
      "parameters": {"d": {"unit": "g", "distribution": "normal", "mean": 0, "std": 0.5}},
      "overrides": {"shown": "shown + d"}
    }
  }
}"#;

/// The case with its data in a folder of its own: 0.3 % too much, and a fixed pattern for noise.
fn case(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let mut data = "load,shown,u\n".to_owned();
    for row in 0..16_u32 {
        let load = 12.5 * f64::from(row);
        let noise = 0.02 * (f64::from(row * 7 % 16) - 7.5) / 4.6;
        writeln!(data, "{load},{:.5},0.02", 1.003 * load + noise).unwrap();
    }
    std::fs::write(folder.path().join("data.csv"), data).unwrap();
    let path = folder.path().join("case.json");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

/// Standard output and standard error of a diagnosis that must succeed.
fn diagnosed(path: &Path, arguments: &[&str]) -> (String, String) {
    let assert = gumption().arg("gap").arg(path).args(arguments).assert().success();
    let ended = assert.get_output();
    [&ended.stdout, &ended.stderr].map(|bytes| String::from_utf8(bytes.clone()).unwrap()).into()
}

#[test]
fn every_format_says_the_same() {
    let (_folder, path) = case(CASE);
    let (json, _) = diagnosed(&path, &["--format", "json"]);
    let answer: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(answer["verdict"]["kind"], "explained");
    assert_eq!(answer["verdict"]["effects"], serde_json::json!(["gain"]));
    let probability = answer["verdict"]["probability"].as_f64().unwrap();
    let sentence = format!("There is a gap, and gain explains it (probability {probability:.3}).");
    let (page, said) = diagnosed(&path, &[]);
    assert!(page.contains(&sentence), "{page}");
    assert!(page.lines().all(|line| line.chars().count() <= 100), "{page}");
    assert_eq!(said, "", "the page has the notes itself");
    let (html, _) = diagnosed(&path, &["--format", "html"]);
    assert!(html.contains(&sentence) && html.contains("</html>"), "{html}");
    // all of them state what the sim computes
    assert_eq!(answer["sim"]["equations"]["shown"], "load + zero");
    let (markdown, _) = diagnosed(&path, &["--format", "markdown"]);
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(markdown.contains("load + zero") && words.contains("shown load + zero"), "{page}");
    assert!(html.contains(">Model</h2>"), "{html}");
    let (csv, _) = diagnosed(&path, &["--format", "csv"]);
    let first: Vec<&str> = csv.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(first[..2], ["explained", "gain"]);
    assert_eq!(first[3].parse::<f64>().unwrap(), probability);
    assert_eq!(csv.lines().count(), 1 + answer["hypotheses"].as_array().unwrap().len());
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let (folder, path) = case(CASE);
    let at = folder.path().join("at.csv");
    std::fs::write(&at, "load\n5\n500\n").unwrap();
    for format in ["json", "table", "html", "csv"] {
        let run = |threads: &str| {
            let at = at.to_str().unwrap();
            diagnosed(&path, &["--format", format, "--threads", threads, "--predict", at]).0
        };
        assert_eq!(run("1"), run("2"), "{format}");
    }
}

/// Standard error of a diagnosis that is refused.
fn refused(path: &Path, arguments: &[&str]) -> String {
    let assert = gumption().arg("gap").arg(path).args(arguments).assert().code(2);
    String::from_utf8(assert.get_output().stderr.clone()).unwrap()
}

/// Where the sim is a column of the data, the rows to predict at need it as well.
#[test]
fn predictions_of_a_column_need_that_column() {
    let text = CASE
        .replace("\"equations\": {\"shown\": \"load + zero\"},\n", "")
        .replace("\"value\": \"shown\",", "\"value\": \"shown\", \"sim\": \"said\",");
    let (folder, path) = case(&text);
    let data = folder.path().join("data.csv");
    let rows: Vec<String> = std::fs::read_to_string(&data)
        .unwrap()
        .lines()
        .map(|line| format!("{line},{}", line.split(',').next().unwrap()))
        .collect();
    std::fs::write(&data, rows.join("\n").replace("load,shown,u,load", "load,shown,u,said"))
        .unwrap();
    let at = folder.path().join("at.csv");
    std::fs::write(&at, "load,said\n5,5\n500,500\n").unwrap();
    diagnosed(&path, &["--predict", at.to_str().unwrap()]);
    std::fs::write(&at, "load\n5\n500\n").unwrap();
    let error = refused(&path, &["--predict", at.to_str().unwrap()]);
    assert!(error.contains("for the simulation of `shown`"), "{error}");
    assert!(error.contains("has no column `said`"), "{error}");
}

/// Three effects that must act together are not to be had of two.
#[test]
fn priors_of_impossible_hypotheses_are_refused() {
    let prior =
        r#""prior": {"none": 0, "one": 0, "two": 0, "three": 1, "unexplained": 0}, "effects""#;
    let (_folder, path) = case(&CASE.replace("\"effects\"", prior));
    let error = refused(&path, &[]);
    assert!(error.contains("case.json") && error.contains("no hypothesis has a prior"), "{error}");
}

#[test]
fn the_file_is_what_would_be_printed() {
    let (folder, path) = case(CASE);
    for format in ["table", "html"] {
        let file = folder.path().join(format);
        let (printed, _) = diagnosed(&path, &["--format", format]);
        let name = file.to_str().unwrap();
        let (nothing, _) = diagnosed(&path, &["--format", format, "--output", name]);
        assert_eq!(nothing, "");
        assert_eq!(std::fs::read_to_string(&file).unwrap(), printed);
    }
    let names = std::fs::read_dir(folder.path()).unwrap();
    assert_eq!(names.count(), 4, "nothing else is left in the folder");
}

#[test]
fn the_page_says_what_it_rests_on() {
    use sha2::{Digest, Sha256};

    let (folder, path) = case(CASE);
    let at = folder.path().join("at.csv");
    std::fs::write(&at, "load\n5\n500\n").unwrap();
    let arguments = ["--format", "html", "--seed", "77", "--predict", at.to_str().unwrap()];
    let (html, _) = diagnosed(&path, &arguments);
    for file in [&path, &folder.path().join("data.csv"), &at] {
        let digest = Sha256::digest(std::fs::read(file).unwrap());
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert!(html.contains(&digest), "{}", file.display());
    }
    assert!(html.contains("seed 77"), "{html}");
    assert!(html.contains("Corrected prediction"), "{html}");
}

#[test]
fn warnings_go_to_standard_error_unless_quiet() {
    let (_folder, path) = case(&CASE.replace("shown + d", "shown + 12*d/(load + 1)"));
    let (_, said) = diagnosed(&path, &["--format", "csv"]);
    assert!(said.starts_with("note: effect `shift`"), "{said}");
    let (_, said) = diagnosed(&path, &["--format", "csv", "--quiet"]);
    assert_eq!(said, "");
}

#[test]
fn a_wrong_case_writes_nothing() {
    let (folder, path) = case(&CASE.replace("shown*(1 + k)", "shwon*(1 + k)"));
    let file = folder.path().join("answer.html");
    let arguments = ["--format", "html", "--output", file.to_str().unwrap()];
    let assert = gumption().arg("gap").arg(&path).args(arguments).assert().code(2);
    let said = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(said.contains("shwon"), "{said}");
    assert!(!file.exists());
}

/// Many effects, so that the diagnosis takes a while, and a warning when it has begun.
#[cfg(unix)]
fn long_case() -> String {
    let mut effects = String::new();
    for number in 0..60 {
        let parameters = r#"{"p": {"unit": "", "distribution": "normal", "mean": 0, "std": 1},
            "q": {"unit": "", "distribution": "log-uniform", "lower": 1, "upper": 1000}}"#;
        let override_ = format!("shown + p*sin(load/q + {number})");
        let effect = format!(
            "{{\"parameters\": {parameters}, \"overrides\": {{\"shown\": \"{override_}\"}}}}"
        );
        write!(effects, "\"wave-{number}\": {effect},").unwrap();
    }
    CASE.replace("\"effects\": {", &format!("\"effects\": {{{effects}"))
}

#[cfg(unix)]
#[test]
fn an_interrupt_hands_back_a_whole_page() {
    use std::process::Stdio;

    let (folder, path) = case(&long_case());
    let file = folder.path().join("answer.html");
    let mut child = crate::support::command()
        .arg("gap")
        .arg(&path)
        .args(["--format", "html", "--output", file.to_str().unwrap()])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // the first warning is said when the case has been read and the diagnosis is about to begin
    let (said, _rest) = crate::process::first_line(child.stderr.take().unwrap());
    assert!(said.starts_with("note: effect"), "{said}");
    let id = child.id().to_string();
    let killed = crate::process::Command::new("kill").args(["-INT", &id]).status();
    assert!(killed.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let names = std::fs::read_dir(folder.path()).unwrap();
    assert_eq!(names.count(), 3, "the case, its data and the answer are all there is");
    let page = std::fs::read_to_string(file).unwrap();
    assert!(page.ends_with("</html>\n") || page.ends_with("</html>"), "the page is whole");
    assert!(page.contains("The diagnosis was interrupted"), "and says what it is");
}

/// Correlated inputs, whether all rows share their values or each row has its own, and coefficients of 1:
/// the chi-square of residuals d is then d'inv(V)d with V = u^2 I + (2 - 2r) s^2 (ones or identity), for
/// y = x + a - b. 1e-9 is rounding.
#[test]
fn correlations_of_inputs_count() {
    let residuals = [0.4, -0.1, 0.9, 0.3, -0.6, 0.5];
    let (u, s) = (0.3_f64, 0.5_f64);
    let folder = tempfile::tempdir().unwrap();
    let mut data = "x,y,u\n".to_owned();
    for (row, d) in residuals.into_iter().enumerate() {
        writeln!(data, "{row},{},{u}", row as f64 + d).unwrap();
    }
    std::fs::write(folder.path().join("data.csv"), data).unwrap();
    let path = folder.path().join("case.json");
    for per in ["", r#""per": "row", "#, r#""per": "x", "#] {
        for r in [0.0, 0.5, 0.99, 1.0] {
            let input = format!(r#"{{{per}"distribution": "normal", "mean": 0, "std": {s}}}"#);
            let text = format!(
                r#"{{"inputs": {{"a": {input}, "b": {input}}}, "correlations": [["a", "b", {r}]],
                "conditions": {{"x": {{}}}}, "equations": {{"y": "x + a - b"}}, "outputs": {{"y": {{}}}},
                "observations": {{"file": "data.csv",
                    "columns": {{"y": {{"value": "y", "standard_uncertainty": "u"}}}}}},
                "effects": {{"gain": {{
                    "parameters": {{"k": {{"distribution": "normal", "mean": 0, "std": 0.1}}}},
                    "overrides": {{"y": "y*(1 + k)"}}}}}}}}"#
            );
            std::fs::write(&path, text).unwrap();
            let (json, _) = diagnosed(&path, &["--format", "json"]);
            let answer: Value = serde_json::from_str(&json).unwrap();
            let joint = (2.0 - 2.0 * r) * s * s;
            let squares: f64 = residuals.iter().map(|d| d * d).sum();
            let sum: f64 = residuals.iter().sum();
            let expected = match per {
                "" => (squares - joint * sum * sum / (u * u + 6.0 * joint)) / (u * u),
                _ => squares / (u * u + joint),
            };
            let found = answer["gap"]["chi2"].as_f64().unwrap();
            assert!(
                (found - expected).abs() < 1e-9 * expected,
                "{per} {r}: {found} for {expected}"
            );
        }
    }
}

/// A diagnosis as JSON of a case in a folder of its own with these data.
fn answered(text: &str, data: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("data.csv"), data).unwrap();
    let path = folder.path().join("case.json");
    std::fs::write(&path, text).unwrap();
    let (json, _) = diagnosed(&path, &["--format", "json", "--quiet"]);
    serde_json::from_str(&json).unwrap()
}

fn codes(answer: &Value) -> Vec<&str> {
    answer["notes"].as_array().unwrap().iter().map(|note| note["code"].as_str().unwrap()).collect()
}

/// A force that is inclined by 4 deg where 0 +- 3 deg are known of it, without any effect. The cosine
/// has no slope at 0, so that by the law of propagation the angle counts for nothing, and the departure
/// of 0.24 % would be 24 standard uncertainties.
#[test]
fn an_input_without_a_slope_at_its_estimate_explains_its_part() {
    let text = r#"{"inputs": {"al": {"unit": "deg", "distribution": "normal", "mean": 0, "std": 3}},
      "conditions": {"F": {"unit": "N"}}, "equations": {"y": "F*cos(al)"},
      "outputs": {"y": {"unit": "N"}},
      "observations": {"file": "data.csv",
        "columns": {"y": {"value": "y", "standard_uncertainty": "u"}}},
      "effects": {"offset": {"parameters": {"z": {"unit": "N", "distribution": "normal", "mean": 0,
          "std": 0.01}}, "overrides": {"y": "y + z"}},
        "stiffness": {"parameters": {"c": {"unit": "", "distribution": "normal", "mean": 0,
          "std": 0.01}}, "overrides": {"y": "y*(1 + c*F/(10 [N]))"}}}}"#;
    let mut data = "F,y,u\n".to_owned();
    for row in 1..=10_u32 {
        let (force, pattern) = (f64::from(row), f64::from(row * 3 % 11) - 5.0);
        let y = force * 4_f64.to_radians().cos() * (1.0 + 3e-5 * pattern);
        writeln!(data, "{force},{y:.6},{}", 1e-4 * force).unwrap();
    }
    let answer = answered(text, &data);
    assert_eq!(answer["verdict"]["kind"], "none", "{}", answer["verdict"]);
    assert!(codes(&answer).contains(&"curved-sim") && !codes(&answer).contains(&"scatter"));
}

/// A column that nothing names may hold remarks.
#[test]
fn columns_that_nothing_names_are_not_read() {
    let (_folder, path) = case(CASE);
    let (plain, _) = diagnosed(&path, &["--format", "json"]);
    let data = path.with_file_name("data.csv");
    let text = std::fs::read_to_string(&data).unwrap();
    let lines = text.lines().enumerate().map(|(n, line)| match n {
        0 => format!("{line},remark,\n"),
        3 => format!("{line},checked twice,\n"),
        _ => format!("{line},,\n"),
    });
    std::fs::write(&data, lines.collect::<String>()).unwrap();
    let (remarked, _) = diagnosed(&path, &["--format", "json"]);
    let hypotheses =
        |json: &str| serde_json::from_str::<Value>(json).unwrap()["hypotheses"].clone();
    assert_eq!(hypotheses(&plain), hypotheses(&remarked));
}

/// Phases of some turns: what is left out is predicted on the branch of what was measured, so that the
/// density rises by about the half of the squared normalized departures, 12 of them of 50 each and more.
#[test]
fn predictive_densities_of_phases_know_the_turn() {
    let text = r#"{"inputs": {"tau": {"unit": "us", "distribution": "normal", "mean": 1.2,
        "std": 0.002}},
      "conditions": {"f": {"unit": "kHz"}}, "equations": {"p": "-2*pi*f*tau"},
      "outputs": {"p": {"unit": "deg", "periodic": 360}},
      "observations": {"file": "data.csv",
        "columns": {"p": {"value": "p", "standard_uncertainty": "u"}}},
      "effects": {"extra-delay": {"parameters": {"td": {"unit": "us", "distribution": "normal",
          "mean": 0, "std": 0.5}}, "overrides": {"p": "p - 2*pi*f*td"}},
        "offset": {"parameters": {"d": {"unit": "deg", "distribution": "normal", "mean": 0,
          "std": 20}}, "overrides": {"p": "p + d"}}}}"#;
    let mut data = "f,p,u\n".to_owned();
    for row in 1..=24_u32 {
        let f = 50.0 * f64::from(row);
        let phase = -360.0 * f * 1e-3 * 1.35 + 0.1 * (f64::from(row * 5 % 13) - 6.0);
        let phase = phase - 360.0 * (phase / 360.0).round();
        writeln!(data, "{f},{phase:.3},0.3").unwrap();
    }
    let answer = answered(text, &data);
    assert_eq!(answer["verdict"]["effects"], serde_json::json!(["extra-delay"]));
    let gain = answer["shrinks"]["log_density_gain"].as_f64().unwrap();
    assert!(gain > 1000.0, "{gain}");
    assert!(!codes(&answer).contains(&"whole-turns"));
    let answer = answered(&text.replace(r#", "periodic": 360"#, ""), &data);
    let note = answer["notes"].as_array().unwrap().iter().find(|of| of["code"] == "whole-turns");
    let said = note.unwrap()["message"].as_str().unwrap();
    assert!(said.contains("of 24 values of p are more than half a turn from the sim"), "{said}");
    assert!(said.contains(r#"state `"periodic": 360`"#), "{said}");
}

/// Phases that an instrument gives within a turn and whose sim is zero: none is more than half a turn
/// from it, but they jump by a turn between two frequencies; a step of 200 deg is a step.
#[test]
fn phases_that_jump_by_a_turn_are_told() {
    let text = r#"{"inputs": {"p0": {"unit": "deg", "distribution": "normal", "mean": 0,
        "std": 0.2}},
      "conditions": {"f": {"unit": "kHz"}, "g": {"unit": "1"}}, "equations": {"p": "p0"},
      "outputs": {"p": {"unit": "deg"}},
      "observations": {"file": "data.csv",
        "columns": {"p": {"value": "p", "standard_uncertainty": "u"}}},
      "effects": {"delay": {"parameters": {"td": {"unit": "us", "distribution": "normal",
          "mean": 0, "std": 5}}, "overrides": {"p": "p - 2*pi*f*td"}}}}"#;
    let data = |phase: &dyn Fn(f64) -> f64| {
        let mut data = "f,g,p,u\n".to_owned();
        for (row, gain) in (1..=20_u32).flat_map(|row| [(row, 1), (row, 10)]) {
            let f = 50.0 * f64::from(row);
            let noise = 0.1 * (f64::from((row + gain) * 5 % 13) - 6.0);
            writeln!(data, "{f},{gain},{:.3},0.5", phase(f) + noise).unwrap();
        }
        data
    };
    let wrapped = |f: f64| if f > 550.0 { 360.0 - 0.324 * f } else { -0.324 * f };
    let answer = answered(text, &data(&wrapped));
    let note = answer["notes"].as_array().unwrap().iter().find(|of| of["code"] == "whole-turns");
    let said = note.unwrap()["message"].as_str().unwrap();
    assert!(
        said.contains("residuals of p jump by nearly a turn between neighbouring conditions"),
        "{said}"
    );
    let round = text.replace(r#""p": {"unit": "deg"}"#, r#""p": {"unit": "deg", "periodic": 360}"#);
    let answer = answered(&round, &data(&wrapped));
    assert_eq!(answer["verdict"]["effects"], serde_json::json!(["delay"]));
    assert!(!codes(&answer).contains(&"whole-turns"));
    let step = |f: f64| if f > 500.0 { 100.0 } else { -100.0 };
    assert!(!codes(&answered(text, &data(&step))).contains(&"whole-turns"));
}

/// Values in volts where the sim is in millivolts: the factor is told, and none of one that is as it is.
#[test]
fn units_that_were_mistaken_in_the_data_are_told() {
    let text = r#"{"inputs": {"s": {"unit": "mV/N", "distribution": "normal", "mean": 2, "std": 0.001}},
      "conditions": {"F": {"unit": "N"}}, "equations": {"v": "s*F"}, "outputs": {"v": {"unit": "mV"}},
      "observations": {"file": "data.csv",
        "columns": {"v": {"value": "v", "standard_uncertainty": "u"}}},
      "effects": {"gain": {"parameters": {"g": {"unit": "%", "distribution": "normal", "mean": 0,
          "std": 2}}, "overrides": {"v": "v*(1 + g)"}}}}"#;
    let data = |factor: f64| {
        let mut data = "F,v,u\n".to_owned();
        for row in 0..=12_u32 {
            let noise = 0.02 * (f64::from(row * 5 % 13) - 6.0) / 6.0;
            let value = factor * (20.0 * f64::from(row) + noise);
            writeln!(data, "{},{value:.6},{}", 10 * row, 0.01 * factor.abs()).unwrap();
        }
        data
    };
    for (factor, cause) in [(1e-3, "a prefix"), (-1.0, "a sign")] {
        let answer = answered(text, &data(factor));
        let note = answer["notes"].as_array().unwrap().iter().find(|of| of["code"] == "unit-slip");
        let said = note.unwrap()["message"].as_str().unwrap();
        assert!(said.contains("The values of v are about") && said.contains(cause), "{said}");
    }
    for factor in [1.0, 1.05, 1.3] {
        assert!(!codes(&answered(text, &data(factor))).contains(&"unit-slip"), "{factor}");
    }
}

/// A constant that two readings at one condition depart by: the effect of the list and the composed one
/// are the same, and take the same off the gap.
#[test]
fn composed_effects_and_those_of_the_list_are_held_against_the_same_rows() {
    let text = r#"{"inputs": {"x": {"unit": "mm", "distribution": "normal", "mean": 10, "std": 0.01}},
      "conditions": {"t": {"unit": "s"}}, "equations": {"y": "x"}, "outputs": {"y": {"unit": "mm"}},
      "observations": {"file": "data.csv",
        "columns": {"y": {"value": "y", "standard_uncertainty": "u"}}},
      "effects": {"offset": {"parameters": {"d": {"unit": "mm", "distribution": "normal", "mean": 0,
          "std": 0.02}}, "overrides": {"y": "y + d"}}}}"#;
    let answer = answered(text, "t,y,u\n1,10.2,0.01\n1,10.21,0.01\n");
    let composed = answer["composed"].as_array().unwrap();
    let removed = |of: &Value| of["shrinks"]["removed_fraction"].as_f64().unwrap();
    let largest = composed.iter().map(removed).fold(0.0, f64::max);
    // of a departure of 20 with the noise of one value: the other tells it to sqrt(2)
    assert!(largest > 0.95, "{composed:?}");
}

/// A bath whose temperature is off by 15 mK at each setting, with four currents in it: an error of the
/// settings, beside which the self-heating of 10 mK/mA^2 is seen; the page says what would say it.
#[test]
fn errors_of_settings_are_said_on_the_page() {
    let text = r#"{"inputs": {"R0": {"unit": "ohm", "distribution": "normal", "mean": 100,
        "std": 0.005}},
      "conditions": {"t": {"unit": "degC"}, "I": {"unit": "mA"}},
      "equations": {"te": "t/[degC]", "R": "R0*(1 + 3.9083e-3*te - 5.775e-7*te^2)"},
      "outputs": {"R": {"unit": "ohm"}},
      "observations": {"file": "data.csv",
        "columns": {"R": {"value": "R", "standard_uncertainty": "u"}}},
      "effects": {"self-heating": {"parameters": {"k": {"unit": "1/mA^2", "distribution": "normal",
          "mean": 0, "std": 0.02}}, "overrides": {"te": "te + k*I^2"}},
        "leads": {"parameters": {"r": {"unit": "ohm", "distribution": "normal", "mean": 0,
          "std": 0.03}}, "overrides": {"R": "R + r"}}}}"#;
    let mut data = "t,I,R,u\n".to_owned();
    for setting in 0..6_u32 {
        let bath = [0.017, -0.021, 0.004, 0.011, -0.009, -0.014][setting as usize];
        for (number, current) in [0.5, 1.0, 2.0, 3.0].into_iter().enumerate() {
            let scatter = f64::from((7 * setting + 5 * number as u32) % 9) - 4.0;
            let t = 50.0 * f64::from(setting);
            let te = t + bath + 0.01 * current * current;
            let r = 100.0 * (1.0 + 3.9083e-3 * te - 5.775e-7 * te * te) + 0.0007 * scatter;
            writeln!(data, "{t},{current},{r:.5},0.002").unwrap();
        }
    }
    let answer = answered(text, &data);
    assert_eq!(answer["verdict"]["effects"], serde_json::json!(["self-heating"]));
    let error = &answer["noise"]["R"]["setting_error"];
    assert_eq!(error["condition"], "t");
    assert!(error["probability"].as_f64().unwrap() > 0.9, "{error}");
    // the bath's root mean square of 13.9 mK is 5.3 mohm, 2.7 standard uncertainties
    let interval = [0, 1].map(|end| error["interval"][end].as_f64().unwrap());
    assert!(interval[0] < 2.7 && 2.7 < interval[1], "{error}");

    let (_folder, path) = case(text);
    std::fs::write(path.with_file_name("data.csv"), &data).unwrap();
    let (page, _) = diagnosed(&path, &[]);
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = "Readings of R at one setting of t share an error with a standard deviation of 0.00";
    assert!(page.contains(said), "{page}");
    assert!(page.contains(r#"an input with `"per": "t"` describes it."#), "{page}");
}

/// A standard uncertainty for all rows, or as a share of the measured values, says what a column does.
#[test]
fn uncertainties_may_be_stated_for_all_rows() {
    let text = |stated: &str| {
        format!(
            r#"{{"inputs": {{"s": {{"unit": "mV/N", "distribution": "normal", "mean": 2, "std": 0.001}}}},
      "conditions": {{"F": {{"unit": "N"}}}}, "equations": {{"v": "s*F"}}, "outputs": {{"v": {{"unit": "mV"}}}},
      "observations": {{"file": "data.csv",
        "columns": {{"v": {{"value": "v", "standard_uncertainty": {stated}}}}}}},
      "effects": {{"gain": {{"parameters": {{"g": {{"unit": "%", "distribution": "normal", "mean": 0,
          "std": 2}}}}, "overrides": {{"v": "v*(1 + g)"}}}}}}}}"#
        )
    };
    let mut data = "F,v,same,share\n".to_owned();
    for row in 0..=12_u32 {
        let value = 20.0 * f64::from(row) + 0.05 * (f64::from(row * 5 % 13) - 6.0);
        let share = 0.001 * value.abs() + 0.01;
        writeln!(data, "{},{value},0.03125,{share}", 10 * row).unwrap();
    }
    for (column, stated) in [
        ("same", vec!["0.03125", r#""0.03125 mV""#, r#""31.25 uV""#]),
        ("share", vec![r#""0.1 % + 0.01 mV""#, r#""0.1 % of reading + 10 uV""#]),
    ] {
        let by_column = answered(&text(&format!(r#""{column}""#)), &data);
        let wanted = &by_column["hypotheses"];
        for stated in stated {
            let found = &answered(&text(stated), &data)["hypotheses"];
            let pairs = numbers(wanted).into_iter().zip(numbers(found));
            for (a, b) in pairs {
                // what 31.25 uV and shares are in mV is rounded
                assert!((a - b).abs() <= 1e-6 * a.abs().max(1e-6), "{stated}: {a} {b}");
            }
        }
    }
    let text = text(r#""0.1 %""#);
    let data = "F,v\n0,0\n10,20.1\n20,39.9\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("data.csv"), data).unwrap();
    let path = folder.path().join("case.json");
    std::fs::write(&path, text).unwrap();
    let said = refused(&path, &[]);
    assert!(
        said.contains("the standard uncertainty in row 1 is 0, as a share of the value 0"),
        "{said}"
    );
}

/// E = S - D and u_val^2 = u_num^2 + u_input^2 + u_D^2 of ASME V&V 20-2009 for y = 2 x with u(2) = 0.01 and
/// u_D = 0.02, and for a column that states u_num = 0.01 x: E = 2 x - y and u_val = hypot(0.02, 0.01 x),
/// to the rounding of the differences. Of the five |E| only 0.07 at x = 1 is above 2 u_val = 0.045.
#[test]
fn comparison_errors_and_validation_uncertainties() {
    let case = |sim: &str, columns: &str| {
        format!(
            r#"{{{sim} "conditions": {{"x": {{}}}}, "outputs": {{"y": {{"unit": "1"}}}},
            "observations": {{"values": {{"x": [1, 2, 3, 4, 5], "s": [2, 4, 6, 8, 10], "us": [0.01, 0.02,
            0.03, 0.04, 0.05], "y": [2.07, 3.97, 6.02, 8.03, 10], "u": [0.02, 0.02, 0.02, 0.02, 0.02]}},
            "columns": {{"y": {{"value": "y", "standard_uncertainty": "u"{columns}}}}}}},
            "effects": {{"shift": {{"parameters": {{"d": {{"distribution": "normal", "mean": 0,
            "std": 0.1}}}}, "overrides": {{"y": "y + d"}}}}}}}}"#
        )
    };
    let model = r#""inputs": {"c": {"distribution": "normal", "mean": 2, "std": 0.01}},
        "equations": {"y": "c*x"},"#;
    let column = r#", "sim": "s", "sim_standard_uncertainty": "us""#;
    for text in [case(model, ""), case("", column)] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.json");
        std::fs::write(&path, text).unwrap();
        let answer: Value =
            serde_json::from_str(&diagnosed(&path, &["--format", "json"]).0).unwrap();
        let rows = answer["rows"].as_array().unwrap();
        assert_eq!(rows.len(), 5);
        for (row, y) in rows.iter().zip([2.07, 3.97, 6.02, 8.03, 10.0]) {
            let (x, of) = (row["conditions"]["x"].as_f64().unwrap(), &row["outputs"]["y"]);
            let near = |key: &str, expected: f64| {
                let found = of[key].as_f64().unwrap();
                assert!((found - expected).abs() < 1e-12, "{key}: {found}, not {expected}");
            };
            near("comparison_error", 2.0 * x - y);
            near("validation_uncertainty", 0.02_f64.hypot(0.01 * x));
        }
        let (page, _) = diagnosed(&path, &[]);
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(page.contains("|E| is at most 2 u_val for 4 of 5 values."), "{page}");
    }
}
