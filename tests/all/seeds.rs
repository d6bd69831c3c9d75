//! The seed reaches every random number: of each command that draws, from the command line and from
//! the file.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{gumption, output, root};

const CERTIFICATE: &str = "models/certificates/three_axis_accelerometer.json";

/// An answer without the keys that name the seed and the file's hash, wherever they stand.
fn without_seed(text: &str) -> Value {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(members) => {
                members.retain(|key, _| key != "seed" && !key.ends_with("_sha256"));
                members.values_mut().for_each(strip);
            }
            Value::Array(values) => values.iter_mut().for_each(strip),
            _ => {}
        }
    }
    let mut value = serde_json::from_str(text).expect("JSON");
    strip(&mut value);
    value
}

/// The numbers that two answers have at the same place and that differ.
fn differing(a: &Value, b: &Value) -> usize {
    match (a, b) {
        (Value::Object(a), Value::Object(b)) => {
            a.iter().filter_map(|(key, a)| b.get(key).map(|b| differing(a, b))).sum()
        }
        (Value::Array(a), Value::Array(b)) => a.iter().zip(b).map(|(a, b)| differing(a, b)).sum(),
        _ => usize::from(a != b),
    }
}

/// Answers of a command with no seed, with 1 and with 2.
fn answers(arguments: &[&str]) -> [Value; 3] {
    [&[][..], &["--seed", "1"], &["--seed", "2"]].map(|seed| {
        let all = [arguments, &["--format", "json", "--quiet"], seed].concat();
        without_seed(&output(&all))
    })
}

#[test]
fn the_seed_of_the_command_line_reaches_every_command() {
    let commands: [(&[&str], usize); 6] = [
        (&["run", "models/inclined_plane.json", "--trials", "20000"], 10),
        // evidence, posterior, cross-validation, the next measurement
        (&["gap", "models/gap/ac_coupling/case.json"], 50),
        (&["gap-check", "models/gap/ac_coupling/case.json", "--draws", "2"], 3),
        (&["observe", "models/recordings/spurious_components/recipe.json"], 20),
        (&["assumptions", "models/spurious_component.json", "--trials", "20000"], 50),
        (&["certificate", CERTIFICATE, "--trials", "20000"], 1),
    ];
    for (arguments, least) in commands {
        let [unsaid, first, second] = answers(arguments);
        assert!(unsaid == first, "{arguments:?}: the seed is 1 unless told");
        let count = differing(&first, &second);
        assert!(count >= least, "{arguments:?}: {count} numbers differ");
    }
}

/// A file with `"seed": 2` answers as with `--seed 2`, and the command line beats it.
#[test]
fn the_seed_of_a_file_is_that_of_the_command_line() {
    let with_seed = |folder: &Path, file: &str| {
        let text = fs::read_to_string(folder.join(file)).expect("the file");
        let mut value: Value = serde_json::from_str(&text).expect("JSON");
        if file == "recipe.json" {
            value["seed"] = 2.into();
        } else {
            value["monte_carlo"]["seed"] = 2.into();
        }
        let copy = tempfile::tempdir().expect("a folder");
        for entry in fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("entry")) {
            if entry.path().is_file() {
                fs::copy(entry.path(), copy.path().join(entry.file_name())).expect("a copy");
            }
        }
        fs::write(copy.path().join(file), value.to_string()).expect("written");
        copy
    };
    for (command, folder, file) in [
        ("run", "models", "inclined_plane.json"),
        ("gap", "models/gap/ac_coupling", "case.json"),
        ("observe", "models/recordings/spurious_components", "recipe.json"),
        ("assumptions", "models", "spurious_component.json"),
    ] {
        let folder = root().join(folder);
        let copy = with_seed(&folder, file);
        let of = |folder: &Path, more: &[&str]| {
            let path = folder.join(file);
            let mut run = gumption();
            run.arg(command).arg(path).args(["--format", "json", "--quiet"]).args(more);
            if command == "assumptions" {
                run.args(["--trials", "20000"]);
            }
            let assert = run.assert().success();
            without_seed(&String::from_utf8(assert.get_output().stdout.clone()).expect("UTF-8"))
        };
        assert!(of(copy.path(), &[]) == of(&folder, &["--seed", "2"]), "{command}");
        assert!(of(copy.path(), &["--seed", "1"]) == of(&folder, &[]), "{command}");
    }
}
