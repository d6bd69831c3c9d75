//! A command that there is not, and a file of another command: what is near is told.

use std::fs;

use crate::support::{command, root};

/// What is said on standard error to arguments that are wrong.
fn said(arguments: &[&str]) -> String {
    let output = command().current_dir(root()).args(arguments).output().expect("the program runs");
    let text = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    text
}

#[test]
fn misspelt_commands_and_models() {
    for (arguments, wanted) in [
        (&["rn", "m.json"][..], "there is no command `rn`; did you mean `run`?"),
        (&["modles"], "did you mean `models`?"),
        (&["uncertainty"], "the commands are run, merge, assumptions, certificate"),
        (&["models/inclined_plane.json"], "such as `gumption run models/inclined_plane.json`"),
        (&["models", "inclined-plan"], "did you mean `inclined-plane`"),
        (
            &["models", "inclined"],
            "`inclined-plane`, `inclined-plane-spurious` or `inclined-plane-spurious-vector`?",
        ),
        (&["models", "nothing"], "`gumption models` lists"),
    ] {
        let text = said(arguments);
        assert!(text.contains(wanted), "{arguments:?}: {text}");
        assert!(text.starts_with("gumption: "), "{text}");
    }
}

#[test]
fn files_of_other_commands() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("a path").to_owned();
    let [saved, json, table] = ["saved.result", "answer.json", "table.csv"].map(path);
    let model = "models/inclined_plane.json";
    let run = ["run", model, "--trials", "10000", "--quiet", "--save", &saved, "--format", "json"];
    let run = command().current_dir(root()).args(run).args(["--output", &json]).output();
    assert!(run.expect("the program runs").status.success());
    fs::write(&table, "label,x1,U1,x2,U2\nb,1,.1,1,.1\n").expect("a table");
    let certificate = "models/certificates/three_axis_accelerometer.json";
    let case = "models/gap/radius/case.json";
    let recipe = "models/recordings/rotating_table/recipe.json";
    let files = [
        (model, "a model file, which `gumption run` reads"),
        (certificate, "the file of a certificate, which `gumption certificate` reads"),
        (recipe, "a recipe of recordings, which `gumption observe` reads"),
        (&saved, "a saved result, which `gumption diff` reads"),
        (&json, "the answer of a run, which `gumption compare --against` reads"),
        (&table, "a table of results, which `gumption compare` reads"),
    ];
    let takes: [(&[&str], &[&str]); 10] = [
        (&["run"], &[model]),
        (&["check"], &[model, certificate, recipe, &saved]),
        (&["assumptions"], &[model]),
        (&["certificate"], &[certificate]),
        (&["compare"], &[&table]),
        (&["observe"], &[recipe]),
        (&["plan", "--target", "U(a_z) <= 1 m/s^2"], &[model]),
        (&["diff", model], &[model, &saved]),
        // any table may be a budget
        (&["import"], &[&table]),
        // a model file lacks the observations only
        (&["gap"], &[model]),
    ];
    for (command, own) in takes {
        for (file, wanted) in files.iter().filter(|(file, _)| !own.contains(file)) {
            let text = said(&[command, &[file]].concat());
            assert!(text.contains(wanted), "{command:?} {file}: {text}");
            assert_eq!(text.matches(": this is ").count(), 1, "{command:?} {file}: {text}");
        }
    }
    let text = said(&["gap", model]);
    assert!(text.contains("a model file without them is for `gumption run`"), "{text}");
    let text = said(&["compare", case]);
    assert!(text.contains("a model file, which"), "{text}");
}

/// The coverage of the command line where U is compared, and of the intervals of a diagnosis.
#[test]
fn coverage_of_diff_and_gap() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, std: f64| {
        let path = folder.path().join(name);
        let text = format!(
            r#"{{"inputs": {{"a": {{"unit": "m", "distribution": "normal", "mean": 1, "std": {std}}}}},
            "equations": {{"y": "a"}}, "outputs": {{"y": {{"unit": "m"}}}}}}"#
        );
        fs::write(&path, text).expect("a file");
        path.to_str().expect("a path").to_owned()
    };
    let (a, b) = (write("a.json", 0.1), write("b.json", 0.2));
    let told = |arguments: &[&str]| {
        let output = command().args(["diff", &a, &b, "--format", "json"]).args(arguments).output();
        let output = output.expect("the program runs");
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let expanded = &answer["outputs"]["y"]["U"];
        [0, 1].map(|side| expanded[side].as_f64().expect("a number"))
    };
    for (arguments, k) in [
        (&[][..], 2.0),
        (&["--k", "3"], 3.0),
        // the quantile 0.975 of the normal distribution
        (&["--coverage", "0.95"], 1.959_963_984_540_054),
    ] {
        let [first, second] = told(arguments);
        assert!((first - 0.1 * k).abs() < 1e-12 && (second - 0.2 * k).abs() < 1e-12, "{k}");
    }
    let saved = folder.path().join("a.result").to_str().expect("a path").to_owned();
    let run =
        command().args(["run", &a, "--trials", "10000", "--quiet", "--save", &saved]).output();
    assert!(run.expect("the program runs").status.success());
    let text = said(&["diff", &saved, &b, "--k", "3"]);
    assert!(text.contains("whose coverage was fixed when it was saved"), "{text}");
    let text = said(&["gap", "--k", "3", "--coverage", "0.9", "models/gap/radius/case.json"]);
    assert!(text.contains("cannot be used with"), "{text}");
}
