//! Long chains of equations in a small stack: a file's length is its author's choice, so nothing
//! that a file says may be followed by recursion.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Output;

use crate::process::Command;
use crate::support::{command, root};

/// Kilobytes of the first thread's stack, a sixteenth of what most systems give and half of the least. What
/// reads the arguments is not optimized and takes 300 of them.
const STACK: u32 = 512;

/// The program in a stack of that size (on Unix).
fn small(folder: &Path, arguments: &[&str]) -> Output {
    let program = command();
    let mut shell = if cfg!(unix) {
        let mut shell = Command::new("sh");
        let script = format!("ulimit -s {STACK} && exec \"$0\" \"$@\"");
        shell.args(["-c", &script]).arg(program.get_program());
        shell
    } else {
        program
    };
    // the threads of a pool have stacks of their own, as small
    shell.env("RUST_MIN_STACK", (STACK * 1024).to_string()).current_dir(folder);
    shell.args(arguments).output().expect("the program runs")
}

fn answered(folder: &Path, arguments: &[&str]) -> String {
    let output = small(folder, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The equations `q0 = first`, `q1 = q0 NEXT`, ...
fn chain(count: usize, first: &str, next: &str) -> String {
    let mut equations = format!(r#""q0": "{first}""#);
    for number in 1..count {
        let _ = write!(equations, r#", "q{number}": "q{} {next}""#, number - 1);
    }
    equations
}

/// A hundred thousand equations, each of the one before: y = 100000 a. Looking each up among all
/// others would take minutes.
#[test]
fn a_hundred_thousand_chained_equations() {
    let folder = tempfile::tempdir().unwrap();
    let count = 100_000;
    let text = format!(
        r#"{{"inputs": {{"a": {{"distribution": "normal", "mean": 1, "std": 0.125}}}},
        "equations": {{{}}}, "outputs": {{"q{}": {{}}}}}}"#,
        chain(count, "a", "+ a"),
        count - 1
    );
    fs::write(folder.path().join("m.json"), text).unwrap();
    answered(folder.path(), &["check", "m.json"]);
    let answer = answered(
        folder.path(),
        &["run", "m.json", "--trials", "1024", "--format", "json", "--quiet"],
    );
    let answer: serde_json::Value = serde_json::from_str(&answer).unwrap();
    let gum = &answer["outputs"][format!("q{}", count - 1)]["gum"];
    // both are exact in doubles
    assert_eq!(gum["estimate"], 100_000.0);
    assert_eq!(gum["standard_uncertainty"], 12_500.0);
}

/// Equations that stand in the wrong order need each other in a circle, and the circle may be long.
#[test]
fn a_long_circle_is_a_mistake() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        r#"{{"inputs": {{"a": {{"distribution": "normal", "mean": 1, "std": 0.1}}}},
        "equations": {{{}, "z": "q0 + z"}}, "outputs": {{"z": {{}}}}}}"#,
        chain(5000, "z", "+ a"),
    );
    fs::write(folder.path().join("m.json"), text).unwrap();
    assert_eq!(small(folder.path(), &["check", "m.json"]).status.code(), Some(2));
}

/// A folder with a gap case of so many chained equations.
fn gap_case(count: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let source = root().join("models/gap/radius");
    let case = fs::read_to_string(source.join("case.json")).unwrap();
    let mut case: serde_json::Value = serde_json::from_str(&case).unwrap();
    fs::copy(source.join("data.csv"), folder.path().join("data.csv")).unwrap();
    case["catalogue"] = serde_json::json!(["radius-offset"]);
    let own = case["equations"].as_object().unwrap().clone();
    let text = format!("{{{}}}", chain(count, "radius", "* 1"));
    let mut equations: serde_json::Map<_, _> = serde_json::from_str(&text).unwrap();
    equations.extend(own);
    equations["r"] = format!("q{} + radius_error", count - 1).into();
    case["equations"] = equations.into();
    fs::write(folder.path().join("case.json"), case.to_string()).unwrap();
    folder
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn a_gap_case_of_a_hundred_thousand_chained_equations_is_checked() {
    answered(gap_case(100_000).path(), &["check", "case.json"]);
}

/// The cases of the gap diagnosis record the model anew for each effect, on threads of a pool.
#[test]
fn a_gap_case_of_chained_equations() {
    let folder = gap_case(5_000);
    let answer = answered(folder.path(), &["gap", "case.json", "--format", "json", "--quiet"]);
    assert!(answer.contains("radius-offset"));
}

/// Every command within the small stack, on files of the usual size.
#[test]
fn every_command_needs_little_stack() {
    for arguments in [
        &["run", "models/inclined_plane.json", "--trials", "1000", "--format", "html"][..],
        &["run", "models/inclined_plane.json", "--trials", "1000", "--format", "latex"],
        &["certificate", "models/certificates/three_axis_accelerometer.json", "--trials", "0"],
        &["diff", "models/inclined_plane.json", "models/inclined_plane.json"],
        &["observe", "models/recordings/rotating_table/recipe.json"],
        &["models", "inclined-plane"],
        &["schema"],
    ] {
        answered(root(), arguments);
    }
}
