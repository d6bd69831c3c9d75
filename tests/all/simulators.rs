//! The cases of `models/simulators/`: their data are what their program makes, and the diagnosis with the
//! programs finds what made them, or says that the list lacks it.
#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::process::Command;
use crate::support::{command, root};

#[path = "../../examples/own_simulator.rs"]
mod program;

fn folder(name: &str) -> PathBuf {
    root().join("models/simulators").join(name)
}

/// The answer for a case with the program in its folder, and how many runs it took.
fn diagnosed(name: &str, case: &str) -> (Value, usize) {
    let kept = tempfile::tempdir().unwrap();
    let program = format!("python3 {name}.py");
    let mut gap = command();
    gap.current_dir(folder(name)).args(["gap", case, "--simulator", &program, "--simulator-lines"]);
    gap.args(["--runs", "300", "--format", "json", "--quiet", "--keep"]).arg(kept.path());
    let found = gap.output().unwrap();
    assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
    let runs = fs::read_to_string(kept.path().join("runs.jsonl")).unwrap();
    // the first line is the heading
    (serde_json::from_slice(&found.stdout).unwrap(), runs.lines().count() - 1)
}

/// The verdict is this effect, at most 300 runs were made, and intervals of 95 % hold the true values, as one
/// draw of the noise has them; they are fixed by the seeds of the data.
fn is_found(name: &str, effect: &str, truth: &[(&str, f64)]) -> Value {
    let (answer, runs) = diagnosed(name, "case.json");
    assert_eq!(answer["verdict"]["effects"], json!([effect]), "{}", answer["verdict"]);
    assert!(answer["verdict"]["probability"].as_f64().unwrap() > 0.8, "{}", answer["verdict"]);
    assert!((1..=300).contains(&runs), "{runs} runs");
    for (parameter, value) in truth {
        let found = &answer["hypotheses"][0]["parameters"][format!("{effect}/{parameter}")];
        let end = |place: usize| found["interval"][place].as_f64().unwrap();
        assert!(end(0) < *value && *value < end(1), "{parameter} = {value}: {found}");
    }
    answer
}

fn is_refused(name: &str) {
    let (answer, runs) = diagnosed(name, "withheld.json");
    assert_eq!(answer["verdict"]["kind"], "unexplained", "{}", answer["verdict"]);
    assert!((1..=300).contains(&runs), "{runs} runs");
}

/// Of seven digits the last one may be another with other elementary functions.
fn is_made_anew(file: &str, made: &Path) {
    let [made, committed] = [made.join(file), folder(file)].map(|path| {
        let text = fs::read_to_string(path).unwrap();
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    });
    let (made, committed): (Vec<Vec<String>>, Vec<Vec<String>>) = (made, committed);
    assert_eq!(made.len(), committed.len(), "{file}");
    for (made, committed) in made.iter().flatten().zip(committed.iter().flatten()) {
        let equal = match (made.parse::<f64>(), committed.parse::<f64>()) {
            (Ok(made), Ok(committed)) => {
                (made - committed).abs() <= 2e-6 * committed.abs().max(1e-3)
            }
            _ => made == committed,
        };
        assert!(equal, "{file}: {made} for {committed}");
    }
}

#[test]
fn the_data_are_what_the_program_makes() {
    let made = tempfile::tempdir().unwrap();
    let mut make = Command::new("python3");
    make.arg("-B").arg(folder("make.py")).arg(made.path());
    let said = make.output().unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    for file in ["pendulum/data.csv", "chain/data.csv", "chain/withheld.csv", "shaker/data.csv"] {
        is_made_anew(file, made.path());
    }
}

/// The same pendulum in Rust gives the same answer. Elementary functions of Python differ in their last bits, and
/// probabilities then by less than their numerical errors of 0.01.
#[test]
fn dry_friction_of_a_pendulum_is_found() {
    let answer = is_found("pendulum", "coulomb-friction", &[("coulomb", 0.06)]);
    let found = program::diagnosed().unwrap().diagnosis.most_probable;
    assert_eq!(found.effects, ["coulomb-friction"]);
    let probability = answer["verdict"]["probability"].as_f64().unwrap();
    assert!((found.probability - probability).abs() < 0.02, "{found:?} {probability}");
}

#[test]
fn a_high_pass_filter_in_two_recordings_is_found() {
    is_found("chain", "ac-coupling", &[("coupling", 0.5)]);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn an_amplifier_that_is_not_on_the_list_is_refused() {
    is_refused("chain");
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn a_lateral_mode_of_a_shaker_is_found() {
    is_found("shaker", "lateral-mode", &[("lean", 0.03), ("mode", 80.0), ("q", 6.0)]);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn a_lateral_mode_that_is_not_on_the_list_is_refused() {
    is_refused("shaker");
}

/// What the chapter shows of a program is what the program says.
#[test]
fn the_chapter_shows_the_programs() {
    let chapter = fs::read_to_string(root().join("docs/simulators.md")).unwrap();
    let mut shown = 0;
    for (begin, program) in [
        ("def swing", "pendulum/pendulum.py"),
        ("for line in sys.stdin", "pendulum/pendulum.py"),
        ("for end in range", "chain/chain.py"),
    ] {
        let program = fs::read_to_string(folder(program)).unwrap();
        let lines: Vec<&str> = program.lines().map(str::trim).collect();
        let blocks = chapter.split("```python\n").skip(1).filter_map(|of| of.split("```").next());
        for line in blocks.filter(|block| block.contains(begin)).flat_map(str::lines) {
            assert!(lines.contains(&line.trim()), "{line}");
            shown += 1;
        }
    }
    assert!(shown > 25, "{shown} lines");
}
