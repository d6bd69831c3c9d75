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

/// A file that cannot be read is named without a position and without the words of the system, by
/// every command.
#[test]
fn files_that_cannot_be_read() {
    let model = "models/examples/power.json";
    let plane = "models/inclined_plan.json";
    let near =
        "models/inclined_plan.json: there is no such file; did you mean `inclined_plane.json`?\n";
    for arguments in [
        &["run", plane][..],
        &["check", plane],
        &["assumptions", plane],
        &["certificate", plane],
        &["compare", plane],
        &["dcc", plane],
        &["diff", plane, model],
        &["diff", model, plane],
        &["gap", plane],
        &["gap-check", plane],
        &["import", plane],
        &["observe", plane],
        &["plan", plane, "--target", "U(a_x) <= 1 m/s^2"],
        &["readings", "--template", plane],
        &["run", model, "--readings", plane],
        &["plan", model, "--target", "U(power) <= 1 mW", "--cost", plane],
    ] {
        assert_eq!(said(arguments), near, "{arguments:?}");
    }
    for (arguments, wanted) in [
        (&["run", "models"][..], "models: it is a folder; name a file in it\n"),
        (&["run", "modles/power.json"], "there is no folder `modles`; did you mean `models`?"),
        (&["run", "tests/errors/latin1.csv"], "latin1.csv: it is not UTF-8 text: save it as UTF-8"),
        (&["merge", "modles"], "`modles`: there is no such folder; did you mean `models`?"),
        (
            &["run", model, "--output", "modles/power.txt"],
            "cannot write `modles/power.txt`: there is no folder `modles`; did you mean `models`?",
        ),
    ] {
        let text = said(arguments);
        assert!(text.contains(wanted) && !text.contains("os error"), "{arguments:?}: {text}");
    }
    // a file that another file names has the position of its name
    let folder = tempfile::tempdir().expect("a folder");
    let named = r#"{"inputs": {"x": {"unit": "m", "distribution": "samples", "file": "tabel.csv"}},
        "equations": {"y": "x"}, "outputs": {"y": {"unit": "m"}}}"#;
    fs::write(folder.path().join("m.json"), named).expect("written");
    fs::write(folder.path().join("table.csv"), "1\n2\n").expect("written");
    let path = folder.path().join("m.json");
    let text = said(&["run", path.to_str().expect("UTF-8")]);
    let wanted = "m.json:1:67: `tabel.csv`: there is no such file; did you mean `table.csv`?";
    assert!(text.contains(wanted), "{text}");
}

/// A probability in percent is recognized on the command line too.
#[test]
fn probabilities_in_percent() {
    for given in ["95", "95 %", "95%"] {
        let text = said(&["run", "models/examples/power.json", "--coverage", given]);
        let wanted = "a probability between 0 and 1 is needed; did you mean 0.95?";
        assert!(text.contains(wanted), "{given}: {text}");
    }
    let text = said(&["run", "models/examples/power.json", "--coverage", "0"]);
    assert!(text.contains("is needed, such as 0.95") && !text.contains("did you"), "{text}");
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
    assert!(text.contains("`gumption run` evaluates a model file without them"), "{text}");
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
