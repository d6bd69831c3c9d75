//! The program of `examples/own_program.rs`: a measurement of one's own on the whole command line.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;

use crate::process::Command;
use crate::support::root;

/// The example's program. A run of all tests has built it; a run of these alone may have not.
fn program() -> PathBuf {
    let own = std::env::current_exe().expect("this program");
    let profile = own.parent().and_then(Path::parent).expect("target/PROFILE/deps");
    let name = format!("own_program{}", std::env::consts::EXE_SUFFIX);
    let mut build = Command::new(env!("CARGO"));
    build.current_dir(root()).args(["build", "--quiet", "--example", "own_program"]);
    if profile.ends_with("release") {
        build.arg("--release");
    }
    assert!(build.status().expect("cargo").success());
    profile.join("examples").join(name)
}

fn run(folder: &Path, program: &Path, arguments: &[&str]) -> Output {
    Command::new(program).current_dir(folder).args(arguments).output().expect("it runs")
}

fn text(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

/// Falls from 0.5 m to 4.9 m with g = 9.80665 m/s^2, their durations shown by a clock that is 20 ms
/// late. The acceleration was measured as well, with a pattern for noise.
const DATA: &str = "height,duration,a,u_a\n\
    0.5,0.33933,9.813,0.01\n0.9,0.44843,9.796,0.01\n1.3,0.53490,9.810,0.01\n\
    1.7,0.60882,9.816,0.01\n2.1,0.67443,9.803,0.01\n2.5,0.73404,9.819,0.01\n\
    2.9,0.78905,9.799,0.01\n3.3,0.84037,9.808,0.01\n3.7,0.88867,9.794,0.01\n\
    4.1,0.93442,9.812,0.01\n4.5,0.97799,9.805,0.01\n4.9,1.01966,9.814,0.01\n";

/// The sim takes the durations as they are, but for a tenth of a millisecond.
const CASE: &str = r#"{
  "format": 1,
  "title": "A late clock",
  "model": "free-fall",
  "inputs": {"delay": {"unit": "ms", "distribution": "normal", "mean": 0, "std": 0.1}},
  "conditions": {"height": {"unit": "m"}, "duration": {"unit": "s"}},
  "outputs": {"a": {"unit": "m/s^2"}},
  "observations": {
    "file": "data.csv",
    "columns": {"a": {"value": "a", "standard_uncertainty": "u_a"}}
  },
  "effects": {
    "late-clock": {
      "parameters": {"late": {"unit": "ms", "distribution": "normal", "mean": 0, "std": 20}},
      "overrides": {"delay": "delay + late"}
    },
    "scale": {
      "parameters": {"k": {"unit": "%", "distribution": "normal", "mean": 0, "std": 5}},
      "overrides": {"a": "a*(1 + k)"}
    }
  }
}"#;

#[test]
fn a_measurement_of_ones_own_has_the_whole_command_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let (folder, program) = (folder.path(), program());

    // it is listed beside the built-in ones and described
    let listed = text(&run(folder, &program, &["models"]));
    assert!(listed.contains("free-fall") && listed.contains("inclined-plane"), "{listed}");
    let described = text(&run(folder, &program, &["models", "free-fall"]));
    assert!(described.contains("2 height / (duration - delay)^2"), "{described}");

    // its template is a model file that is right and can be run
    let template = text(&run(folder, &program, &["models", "free-fall", "--template"]));
    fs::write(folder.join("fall.json"), &template).expect("written");
    text(&run(folder, &program, &["check", "fall.json"]));
    let arguments = ["run", "fall.json", "--format", "json", "--trials", "0", "--quiet"];
    let answer: Value =
        serde_json::from_str(&text(&run(folder, &program, &arguments))).expect("JSON");
    let gum = &answer["outputs"]["a"]["gum"];
    let number = |key: &str| gum[key].as_f64().expect("a number");
    // a = 2 * 4.903325 m / (1 s)^2; u/a = sqrt((0.5 / 4903.325)^2 / 3 + (2 * 0.001)^2)
    assert!((number("estimate") - 9.80665).abs() < 1e-12, "{gum}");
    let relative = ((0.5 / 4903.325_f64).powi(2) / 3.0 + 4e-6).sqrt();
    assert!((number("standard_uncertainty") / 9.80665 / relative - 1.0).abs() < 1e-9, "{gum}");

    // mistakes are told with the names of the measurement
    fs::write(folder.join("wrong.json"), template.replace("\"duration\"", "\"durations\""))
        .expect("written");
    let wrong = run(folder, &program, &["check", "wrong.json"]);
    assert_eq!(wrong.status.code(), Some(2));
    let said = String::from_utf8_lossy(&wrong.stderr).into_owned();
    assert!(said.contains("did you mean `duration`?"), "{said}");
    // nothing of it is known to the program without it
    let said = crate::support::command()
        .current_dir(folder)
        .args(["check", "fall.json"])
        .output()
        .expect("it runs");
    assert!(String::from_utf8_lossy(&said.stderr).contains("free-fall"), "{said:?}");
    assert_eq!(said.status.code(), Some(2));
}

/// Its clock was late by 20 ms, which the sim leaves out: the diagnosis finds the delay.
#[test]
fn a_measurement_of_ones_own_is_diagnosed() {
    let folder = tempfile::tempdir().expect("a folder");
    let (folder, program) = (folder.path(), program());
    fs::write(folder.join("data.csv"), DATA).expect("written");
    fs::write(folder.join("case.json"), CASE).expect("written");
    let answer = text(&run(folder, &program, &["gap", "case.json", "--format", "json", "--quiet"]));
    let answer: Value = serde_json::from_str(&answer).expect("JSON");
    assert_eq!(answer["gap"]["present"], true);
    assert_eq!(
        answer["verdict"]["effects"],
        serde_json::json!(["late-clock"]),
        "{}",
        answer["verdict"]
    );
}
