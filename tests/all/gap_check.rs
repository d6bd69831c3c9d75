//! `gumption gap-check` as a user runs it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{gumption, numbers};

/// An oscillating table with one output, and two effects that it may have.
const CASE: &str = r#"{
  "title": "An oscillating table",
  "inputs": {
    "radius": {"unit": "mm", "distribution": "rectangular", "mean": 145, "half_width": 0.05},
    "angle": {"unit": "deg", "distribution": "normal", "mean": 17, "std": 0.02}
  },
  "conditions": {"frequency": {"unit": "Hz"}},
  "equations": {
    "pulsation": "2*pi*frequency",
    "r": "radius",
    "a_t": "pulsation^2*r*angle"
  },
  "outputs": {"a_t": {"unit": "m/s^2"}},
  "observations": {
    "file": "data.csv",
    "columns": {"a_t": {"value": "a_t", "standard_uncertainty": "u"}}
  },
  "effects": {
    "offset": {
      "parameters": {"d": {"unit": "mm", "distribution": "normal", "mean": 0, "std": 5}},
      "overrides": {"r": "r + d"}
    },
    "low-pass": {
      "parameters": {"fc": {"unit": "Hz", "distribution": "log-uniform", "lower": 20, "upper": 200}},
      "overrides": {"a_t": "a_t/sqrt(1 + (frequency/fc)^2)"}
    }
  }
}"#;

/// The case in a folder of its own. Of its data only the design counts.
fn case() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let mut data = "frequency,a_t,u\n".to_owned();
    for row in 0..12_u32 {
        let frequency = 1.0 + f64::from(row);
        let a_t = 1.7 * frequency * frequency;
        writeln!(data, "{frequency},{a_t:.5},{:.5}", 0.003 * a_t).unwrap();
    }
    std::fs::write(folder.path().join("data.csv"), data).unwrap();
    let path = folder.path().join("case.json");
    std::fs::write(&path, CASE).unwrap();
    (folder, path)
}

const DRAWS: usize = 6;

/// Standard output of a check that must succeed and has nothing to say on standard error.
fn checked(path: &Path, arguments: &[&str]) -> String {
    let draws = DRAWS.to_string();
    let mut command = gumption();
    command.arg("gap-check").arg(path).args(["--draws", &draws]).args(arguments);
    let assert = command.assert().success();
    let ended = assert.get_output();
    assert_eq!(String::from_utf8(ended.stderr.clone()).unwrap(), "");
    String::from_utf8(ended.stdout.clone()).unwrap()
}

fn diagnosed(path: &Path) -> Vec<u8> {
    let assert = gumption().arg("gap").arg(path).args(["--format", "json"]).assert().success();
    assert.get_output().stdout.clone()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn the_diagnosis_does_not_see_the_truth() {
    let (folder, path) = case();
    let kept = folder.path().join("kept");
    // with this seed there are truths without a gap, of the list, and with one of two effects taken out
    let keep = ["--seed", "3", "--keep", kept.to_str().unwrap()];
    let answer = checked(&path, &[["--format", "json"].as_slice(), &keep].concat());
    let answer: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!(answer["cases"].as_array().unwrap().len(), DRAWS);
    let cases: Vec<String> = (0..DRAWS).map(|number| format!("{number:05}")).collect();
    let mut expected = cases.clone();
    expected.push("sealed".to_owned());
    assert_eq!(names(&kept), expected);
    let truths: Vec<String> = cases.iter().map(|name| format!("{name}.json")).collect();
    assert_eq!(names(&kept.join("sealed")), truths);
    let mut kinds = std::collections::BTreeSet::new();
    for (name, scored) in cases.iter().zip(answer["cases"].as_array().unwrap()) {
        let own = kept.join(name);
        assert_eq!(names(&own), ["case.json", "data.csv"]);
        let sealed = std::fs::read(kept.join("sealed").join(format!("{name}.json"))).unwrap();
        let sealed: Value = serde_json::from_slice(&sealed).unwrap();
        kinds.insert(sealed["kind"].as_str().unwrap().to_owned());
        assert_eq!(sealed["effects"], scored["effects"]);
        // the case is the original one, or one that is shorter by the effect that was taken out
        let text = std::fs::read_to_string(own.join("case.json")).unwrap();
        match scored["withheld"].as_str() {
            None => assert_eq!(text, CASE),
            Some(effect) => assert!(CASE.contains(effect) && !text.contains(effect), "{text}"),
        }
        // the data are not what the truth makes without noise, nor do they have its parameters
        let data = std::fs::read_to_string(own.join("data.csv")).unwrap();
        let cells: Vec<f64> = data
            .lines()
            .skip(1)
            .flat_map(|line| line.split(','))
            .map(|c| c.parse().unwrap())
            .collect();
        let values = numbers(&sealed["values"]);
        assert_eq!(cells.len(), 3 * values.len());
        let secrets = [values, numbers(&sealed["parameters"]), numbers(&sealed["gap"])].concat();
        let secrets = secrets.into_iter().filter(|value| *value != 0.0);
        for secret in secrets {
            assert!(!cells.contains(&secret), "{secret} in {data}");
            assert!(!text.contains(&secret.to_string()), "{secret} in {text}");
        }
    }
    assert!(kinds.iter().eq(["beside", "catalogue", "none"]), "{kinds:?}");
    let before: Vec<Vec<u8>> =
        cases.iter().map(|name| diagnosed(&kept.join(name).join("case.json"))).collect();
    std::fs::remove_dir_all(kept.join("sealed")).unwrap();
    for (name, before) in cases.iter().zip(before) {
        assert_eq!(diagnosed(&kept.join(name).join("case.json")), before, "{name}");
    }
}

#[test]
fn every_format_says_the_same_on_any_number_of_threads() {
    let (folder, path) = case();
    let json = checked(&path, &["--format", "json", "--threads", "1"]);
    assert_eq!(json, checked(&path, &["--format", "json", "--threads", "2"]));
    let answer: Value = serde_json::from_str(&json).unwrap();
    let right = answer["cases"].as_array().unwrap().iter().filter(|one| one["right"] == true);
    let sentence = format!("The verdict was right in {} of {DRAWS} draws", right.count());
    let page = checked(&path, &["--threads", "2"]);
    assert!(page.contains(&sentence), "{page}");
    assert!(page.lines().all(|line| line.chars().count() <= 100), "{page}");
    let file = folder.path().join("check.html");
    let output = ["--format", "html", "--output", file.to_str().unwrap()];
    assert_eq!(checked(&path, &output), "");
    let html = std::fs::read_to_string(&file).unwrap();
    assert!(html.contains(&sentence) && html.ends_with("</html>\n"), "{html}");
    assert_eq!(names(folder.path()), ["case.json", "check.html", "data.csv"]);
}

#[test]
fn warnings_go_to_standard_error_unless_quiet() {
    let (_folder, path) = case();
    std::fs::write(&path, CASE.replace("r + d", "r + d*frequency")).unwrap();
    let said = |arguments: &[&str]| {
        let mut command = gumption();
        command.arg("gap-check").arg(&path).args(["--draws", "1"]).args(arguments);
        String::from_utf8(command.assert().success().get_output().stderr.clone()).unwrap()
    };
    assert!(said(&[]).starts_with("note: effect `offset`"));
    assert_eq!(said(&["--quiet"]), "");
}
