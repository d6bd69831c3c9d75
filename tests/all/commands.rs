//! The commands: what goes in, what comes out, and how they end.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Output, Stdio};

use serde_json::Value;

use crate::process::{Child, Command};
use crate::support::{command, model_files, root};

const SMALL: &str = r#"{
  "inputs": {
    "x": {"unit": "m", "distribution": "rectangular", "mean": 1, "half_width": 0.1},
    "t": {"unit": "s", "distribution": "normal", "mean": 2, "std": 0.01}
  },
  "equations": {"v": "x / t"},
  "outputs": {"v": {"unit": "mm/s"}},
  "monte_carlo": {"trials": 300000}
}"#;

/// A model that clause 8 refutes: a square at zero.
const REFUTED: &str = r#"{
  "inputs": {"x": {"distribution": "normal", "mean": 0.1, "std": 1}},
  "equations": {"y": "x^2"},
  "outputs": {"y": {}},
  "monte_carlo": {"trials": 20000}
}"#;

fn run(arguments: &[&str], input: &str) -> Output {
    let mut child = start(arguments);
    let mut pipe = child.stdin.take().expect("a pipe");
    // a program that ends without reading closes the pipe
    let _ = pipe.write_all(input.as_bytes());
    drop(pipe);
    child.wait_with_output().expect("an answer")
}

fn start(arguments: &[&str]) -> Child {
    command()
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// Exit code, standard output, standard error.
fn ended(arguments: &[&str], input: &str) -> (i32, String, String) {
    let output = run(arguments, input);
    (output.status.code().expect("an exit code"), text(&output.stdout), text(&output.stderr))
}

fn json(arguments: &[&str], input: &str) -> Value {
    let (code, answer, message) = ended(arguments, input);
    assert_eq!(code, 0, "{message}");
    serde_json::from_str(&answer).expect("JSON")
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn entries(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into()).collect()
}

#[test]
fn standard_input_is_a_model_file() {
    let (code, answer, message) = ended(&["run", "-"], SMALL);
    assert_eq!((code, message.as_str()), (0, ""));
    assert!(answer.contains("mm/s"));
    let (code, _, message) = ended(&["run", "-"], "{");
    assert_eq!(code, 2);
    assert!(message.starts_with("<stdin>:1:"), "{message}");
    assert_eq!(run(&["check", "-"], SMALL).status.code(), Some(0));
    let mut child = start(&["check", "-"]);
    child.stdin.take().expect("a pipe").write_all(b"\xff\xfe").expect("written");
    assert_eq!(child.wait().expect("an end").code(), Some(2));
}

#[test]
fn answers_in_every_format() {
    let (code, table, _) = ended(&["run", "-"], SMALL);
    assert_eq!(code, 0);
    assert!(table.contains('v') && table.lines().count() > 10);
    let answer = json(&["run", "-", "--format", "json"], SMALL);
    let gum = &answer["outputs"]["v"]["gum"];
    // u/y = sqrt((0.1/sqrt(3))^2 + 0.005^2) = 0.0579510; y = 500 mm/s
    assert_eq!(gum["estimate"], 500.0);
    let u = gum["standard_uncertainty"].as_f64().expect("a number");
    assert!((u - 28.9755).abs() < 1e-3, "{u}");
    let (code, csv, _) = ended(&["run", "-", "--format", "csv"], SMALL);
    assert_eq!(code, 0);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 2, "{csv}");
    assert_eq!(lines[0].split(',').count(), lines[1].split(',').count(), "{csv}");
    assert_eq!(ended(&["run", "-", "--format", "pdf"], SMALL).0, 2);
}

/// A run whose warnings and notes exist: few trials.
#[test]
fn notes_go_to_standard_error_and_quiet_silences_them() {
    for format in ["json", "csv"] {
        let arguments = ["run", "-", "--format", format, "--trials", "500"];
        let (code, answer, message) = ended(&arguments, SMALL);
        assert_eq!(code, 0);
        assert!(message.contains("note: "), "{message}");
        assert!(!answer.contains("note: "), "{answer}");
        let (code, quiet, message) = ended(&[&arguments[..], &["--quiet"]].concat(), SMALL);
        assert_eq!((code, message.as_str()), (0, ""));
        assert_eq!(quiet, answer);
    }
    let answer = json(&["run", "-", "--format", "json", "--trials", "500"], SMALL);
    assert!(!answer["warnings"].as_array().expect("a list").is_empty());
    // an error is told all the same
    let (code, answer, message) = ended(&["run", "-", "--quiet"], "{}");
    assert_eq!((code, answer.as_str()), (2, ""));
    assert!(message.contains("`inputs`"));
}

#[test]
fn fail_makes_a_refuted_interval_exit_code_3() {
    assert_eq!(ended(&["run", "-"], REFUTED).0, 0);
    let (code, answer, _) = ended(&["run", "-", "--fail"], REFUTED);
    assert_eq!(code, 3);
    assert!(answer.contains('y'));
    // a gate that checks nothing is none, and one that cannot tell does not let pass
    let (code, answer, message) = ended(&["run", "-", "--fail", "--trials", "0"], REFUTED);
    assert_eq!((code, answer.as_str()), (2, ""));
    assert!(message.contains("needs Monte Carlo trials or a tolerance"), "{message}");
    let undecided = r#"{"inputs": {"x": {"distribution": "normal", "mean": 0, "std": 1}},
        "equations": {"y": "x"}, "outputs": {"y": {}}}"#;
    let arguments = ["run", "-", "--trials", "1000", "--digits", "3", "--fail"];
    let (code, _, message) = ended(&arguments, undecided);
    assert_eq!(code, 3);
    assert!(
        message.contains("`y`: is the GUM interval validated (clause 8): undecided"),
        "{message}"
    );
    // readings of one degree of freedom that are correlated have no GUM interval
    let without = r#"{"inputs": {
        "a": {"distribution": "normal", "mean": 0, "std": 1, "dof": 5},
        "b": {"distribution": "normal", "mean": 0, "std": 1, "dof": 5}},
        "correlations": [["a", "b", 0.5]],
        "equations": {"y": "a + b"}, "outputs": {"y": {}}}"#;
    let (code, answer, message) = ended(&["run", "-", "--trials", "20000", "--fail"], without);
    assert_eq!(code, 2, "{message}");
    assert!(answer.contains('y') && message.contains("nothing to check"), "{message}");
}

#[test]
fn the_command_line_beats_the_file() {
    let with = |arguments: &[&str]| {
        json(&[&["run", "-", "--format", "json", "--quiet"], arguments].concat(), SMALL)
    };
    let base = with(&[]);
    let figure = |answer: &Value| answer["outputs"]["v"]["monte_carlo"]["estimate"].as_f64();
    assert_eq!(base["outputs"]["v"]["monte_carlo"]["trials"], 300_000);
    assert_eq!(with(&["--trials", "3000"])["outputs"]["v"]["monte_carlo"]["trials"], 3000);
    assert_eq!(with(&["--trials", "1e4"])["outputs"]["v"]["monte_carlo"]["trials"], 10_000);
    assert_ne!(figure(&base), figure(&with(&["--seed", "2"])));
    assert_eq!(with(&["--seed", "2"])["provenance"]["seed"], 2);
    assert_eq!(with(&["--coverage", "0.99"])["coverage_probability"], 0.99);
    let tripled = with(&["--k", "3"]);
    assert_eq!(tripled["outputs"]["v"]["gum"]["coverage_factor"], 3.0);
    assert!((tripled["coverage_probability"].as_f64().unwrap_or(0.0) - 0.9973).abs() < 1e-5);
    assert_eq!(with(&["--digits", "1"])["outputs"]["v"]["validation"]["digits"], 1);
}

/// Digits on pages move no number of the answer; those of clause 8 stay.
#[test]
fn shown_digits_are_apart_from_those_of_clause_8() {
    let model = r#"{"inputs": {"x": {"distribution": "normal", "mean": 1.234567, "std": 0.123456}},
        "equations": {"y": "x"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 20000}}"#;
    let with = |arguments: &[&str], model: &str| {
        let (code, answer, message) = ended(&[&["run", "-"], arguments].concat(), model);
        assert_eq!(code, 0, "{message}");
        answer
    };
    let machine = ["--format", "json", "--quiet"];
    let shown = with(&[&machine[..], &["--shown-digits", "5"]].concat(), model);
    assert_eq!(shown, with(&machine, model));
    let validation =
        &serde_json::from_str::<Value>(&shown).expect("JSON")["outputs"]["y"]["validation"];
    assert_eq!(validation["digits"], 2);
    // k = 2: U is 0.246912
    assert!(with(&[], model).contains("y = (1.23 ± 0.25), k = 2.00,"));
    let page = with(&["--shown-digits", "5"], model);
    assert!(page.contains("y = (1.23457 ± 0.24691), k = 2.00,"), "{page}");
    let file = model.replacen('{', r#"{"shown_digits": 3, "#, 1);
    assert!(with(&[], &file).contains("y = (1.235 ± 0.247), k = 2.00,"));
    assert!(with(&["--shown-digits", "5"], &file).contains("y = (1.23457 ± 0.24691), k = 2.00,"));
    // as many as of clause 8, unless given
    assert!(with(&["--digits", "3"], model).contains("y = (1.235 ± 0.247), k = 2.00,"));
    let (code, _, message) = ended(&["run", "-", "--shown-digits", "0"], model);
    assert_eq!(code, 2);
    assert!(message.contains("a whole number from 1 to 15 is needed"), "{message}");
}

#[test]
fn no_trials_leave_the_law_of_propagation() {
    let answer = json(&["run", "-", "--format", "json", "--trials", "0"], SMALL);
    let output = &answer["outputs"]["v"];
    assert!(output["monte_carlo"].is_null() && output["validation"].is_null());
    assert_eq!(output["gum"]["estimate"], 500.0);
    assert_eq!(ended(&["run", "-", "--trials", "0"], SMALL).0, 0);
    assert_eq!(ended(&["run", "-", "--trials", "0", "--format", "csv"], SMALL).0, 0);
}

/// Trials without a finite result: the message names the three ways on, with what the law of
/// propagation gives, and each way leads on. sqrt(1 m^2) = 1 m, and u = 0.4 m^2/(2 x 1 m).
#[test]
fn trials_that_are_not_finite_have_three_ways_on() {
    let model = |more: &str, root: &str| {
        format!(
            r#"{{{root}"inputs": {{"x": {{"unit": "m^2", "distribution": "normal", "mean": 1, "std": 0.4{more}}}}},
              "equations": {{"y": "sqrt(x)"}}, "outputs": {{"y": {{"unit": "m"}}}},
              "monte_carlo": {{"trials": 10000}}}}"#
        )
    };
    let (code, _, said) = ended(&["run", "-"], &model("", ""));
    assert_eq!(code, 2, "{said}");
    let wanted = "the law of propagation gives y = 1.00 m with u = 0.20 m; state the `limits` of an \
                  input that cannot have such values, allow a share P of such trials, \
                  `\"allow_undefined\": P`, or take the law of propagation alone, `--trials 0`";
    assert!(said.contains(wanted), "{said}");
    let of_limits = model(r#", "limits": [0, 3]"#, "");
    let of_share = model("", r#""allow_undefined": 0.02, "#);
    for input in [of_limits, of_share] {
        let (code, _, said) = ended(&["run", "-"], &input);
        assert_eq!(code, 0, "{said}");
    }
    let (code, page, said) = ended(&["run", "-", "--trials", "0"], &model("", ""));
    assert!(code == 0 && page.contains("0.20"), "{page}{said}");
    // an estimate that is not finite leaves the trials alone
    let (code, _, said) =
        ended(&["run", "-"], &model("", "").replace("sqrt(x)", "sqrt(x - 1.1 [m^2])"));
    assert!(code == 2 && said.contains("`\"allow_undefined\": P`"), "{said}");
    assert!(!said.contains("law of propagation"), "{said}");
}

#[test]
fn set_replaces_estimates_and_fields() {
    let with = |settings: &[&str]| {
        let mut arguments = vec!["run", "-", "--format", "json", "--quiet", "--trials", "0"];
        arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
        let answer = json(&arguments, SMALL);
        let gum = &answer["outputs"]["v"]["gum"];
        let number = |key: &str| gum[key].as_f64().expect("a number");
        (number("estimate"), gum["budget"][0]["standard_uncertainty"].as_f64().expect("a number"))
    };
    let near = |(a, b): (f64, f64), (c, d): (f64, f64)| {
        assert!((a - c).abs() < 1e-9 && (b - d).abs() < 1e-12, "{a} {b}");
    };
    let u = 0.1 / 3f64.sqrt();
    near(with(&["x=3"]), (1500.0, u));
    near(with(&["x=300 cm"]), (1500.0, u));
    let twice = ["run", "-", "--set", "x=3", "--set", "x=4"];
    let (code, answer, message) = ended(&twice, SMALL);
    assert_eq!((code, answer.as_str()), (2, ""));
    assert!(message.contains("`x=4`: it and `x=3` replace the same"), "{message}");
    near(with(&["x.half_width=0.3"]), (500.0, 3.0 * u));
    near(with(&["x.half_width=10 %"]), (500.0, u));
    near(with(&["x=2", "x.half_width=10 %", "t=4"]), (500.0, 2.0 * u));
}

/// Conditions in the rows of a table are no inputs, and are changed there; those of a grid are set.
#[test]
fn set_of_a_condition_of_a_table_says_where_its_rows_are() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("press.csv"), "p_ref,t [K]\n1,300\n2,301\n").expect("a table");
    let model = r#"{"conditions": {"file": "press.csv", "units": {"p_ref": "bar"}},
        "inputs": {"x": {"unit": "bar", "distribution": "normal", "mean": "p_ref", "std": 0.1}},
        "equations": {"y": "x"}, "outputs": {"y": {"unit": "bar"}}}"#;
    let file = folder.path().join("press.json");
    fs::write(&file, model).expect("a model");
    let file = file.to_str().expect("a path");
    let said = |set: &str| {
        let (code, answer, message) = ended(&["run", file, "--set", set], "");
        assert_eq!((code, answer.as_str()), (2, ""));
        message
    };
    let message = said("p_ref=6");
    assert!(message.contains("press.json:1:48:"), "{message}");
    assert!(
        message.contains("`p_ref` is a condition, whose values stand in the rows of `press.csv`")
    );
    assert!(!message.contains("no input of that name"), "{message}");
    let message = said("t=6");
    assert!(
        message.contains("conditions are rows of `press.csv` and are changed there"),
        "{message}"
    );
}

#[test]
fn set_with_nonsense_is_explained() {
    let nonsense = [
        "x",
        "=",
        "=3",
        "x=",
        "x= ",
        "x=nan",
        "x=inf",
        "x=1e999",
        "x=3 s",
        "x=3 furlong",
        "y=3",
        "x=3 4",
        "x.=3",
        "x.halfwidth=3",
        "x.half_width=-1",
        "x.half_width=0",
        "x.half_width=nan",
        "x.distribution=bell",
        "x.half_width.y=3",
        "x=\u{0}",
        "x=\n",
        "x=\"3\"",
        ".=",
        "x..=1",
        "x.unit=s",
        "v=1",
        "inputs=1",
        "x.mean=",
        "x.mean=three",
        "x.mean=1e999",
    ];
    for setting in nonsense {
        if setting.contains('\0') {
            // the system does not pass such arguments
            continue;
        }
        let (code, answer, message) = ended(&["run", "-", "--set", setting], SMALL);
        assert_eq!((code, answer.as_str()), (2, ""), "--set {setting}: {message}");
        assert!(!message.trim().is_empty(), "--set {setting}");
    }
}

#[test]
fn wrong_arguments_end_with_2() {
    for arguments in [
        &["run"][..],
        &["walk"],
        &[],
        &["run", "-", "--no-such-option"],
        &["run", "-", "--trials", "-5"],
        &["run", "-", "--trials", "0.5"],
        &["run", "-", "--trials", "1"],
        &["run", "-", "--trials", "nan"],
        &["run", "-", "--trials", "1e13"],
        &["run", "-", "--threads", "0"],
        &["run", "-", "--threads", "many"],
        &["run", "-", "--coverage", "95"],
        &["run", "-", "--k", "0"],
        &["run", "-", "--k", "9"],
        &["run", "-", "--k", "2", "--coverage", "0.95"],
        &["run", "-", "--coverage", "nan"],
        &["run", "-", "--digits", "0"],
        &["run", "-", "--seed", "-1"],
        &["run", "-", "--memory", "1"],
        &["run", "-", "--memory", "99999999999G"],
        &["run", "no_such_file.json"],
        &["run", "models"],
        &["check", "no_such_file.json"],
        &["check", "-", "--format", "csv"],
        &["models", "no-such-model"],
        &["models", "--template"],
        &["verify", "--model", "models/inclined_plane.json"],
        &["verify", "--format", "walk"],
        &["diff", "-"],
        &["diff", "-", "no_such_file.json"],
        &["verify", "--paths", "--model", "no_such_file.json"],
    ] {
        let (code, answer, message) = ended(arguments, SMALL);
        assert_eq!((code, answer.as_str()), (2, ""), "{arguments:?}");
        assert!(!message.is_empty(), "{arguments:?}");
    }
    // a number below zero is a value, and the message says which ones are right
    for (option, needed) in [
        ("--seed", "a whole number from 0 to"),
        ("--trials", "a whole number (0, or from 2 to 1e12) or `adaptive` is needed"),
        ("--coverage", "a probability between 0 and 1 is needed"),
        ("--k", "a coverage factor above 0 and at most 8 is needed"),
        ("--memory", "a size such as 64M, 512MiB or 1G is needed"),
        ("--threads", "a whole number from 1 to 1024 is needed"),
        ("--digits", "a whole number from 1 to 15 is needed"),
    ] {
        let (code, _, message) = ended(&["run", "-", option, "-1"], SMALL);
        assert!(code == 2 && message.contains(needed), "{option}: {message}");
    }
    for arguments in [&["--help"][..], &["--version"], &["run", "--help"]] {
        let (code, answer, message) = ended(arguments, "");
        assert_eq!((code, message.as_str()), (0, ""), "{arguments:?}");
        assert!(!answer.is_empty());
    }
}

#[test]
fn output_files_are_there_whole_or_not_at_all() {
    let folder = folder();
    let file = folder.path().join("answer.json");
    let name = file.to_str().expect("UTF-8");
    let arguments = ["run", "-", "--format", "json", "--output", name];
    let (code, answer, _) = ended(&arguments, SMALL);
    assert_eq!((code, answer.as_str()), (0, ""));
    let first = fs::read_to_string(&file).expect("the answer");
    assert!(serde_json::from_str::<Value>(&first).is_ok());
    assert_eq!(first, ended(&arguments[..4], SMALL).1);
    // a model that is wrong, or wrong when it runs, leaves the old answer
    assert_eq!(ended(&arguments, "{}").0, 2);
    assert_eq!(ended(&arguments, &REFUTED.replace("x^2", "ln(x)")).0, 2);
    assert_eq!(fs::read_to_string(&file).expect("the answer"), first);
    // a new one replaces it
    assert_eq!(ended(&arguments, REFUTED).0, 0);
    assert_ne!(fs::read_to_string(&file).expect("the answer"), first);
    assert_eq!(entries(folder.path()), ["answer.json"]);
    // a folder that is not there is the argument's fault
    let nowhere = folder.path().join("no/such/folder.json");
    let (code, _, message) =
        ended(&["run", "-", "--output", nowhere.to_str().expect("UTF-8")], SMALL);
    assert_eq!(code, 2);
    assert!(message.contains("cannot write"), "{message}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_with_1() {
    let (code, _, message) = ended(&["run", "-", "--output", "/dev/full"], SMALL);
    assert_eq!(code, 1);
    assert!(message.contains("/dev/full"), "{message}");
    let full = fs::File::options().write(true).open("/dev/full").expect("/dev/full");
    let mut child = command();
    child.args(["models"]).stdout(full).stderr(Stdio::piped());
    let ended = child.output().expect("the program runs");
    assert_eq!(ended.status.code(), Some(1));
    assert!(text(&ended.stderr).contains("cannot write"));
}

#[test]
fn a_reader_that_has_had_enough_is_no_failure() {
    for arguments in [&["run", "models/inclined_plane.json"][..], &["models"], &["--help"]] {
        let mut child = start(arguments);
        drop(child.stdout.take());
        let ended = child.wait_with_output().expect("an end");
        assert_eq!(ended.status.code(), Some(0), "{arguments:?}: {}", text(&ended.stderr));
        assert_eq!(text(&ended.stderr), "", "{arguments:?}");
    }
}

/// Starts a run without end and interrupts it after a while.
#[cfg(unix)]
fn interrupted(arguments: &[&str], milliseconds: u64) -> Output {
    let mut child = start(&[&["run", "-", "--trials", "1e11"], arguments].concat());
    child.stdin.take().expect("a pipe").write_all(SMALL.as_bytes()).expect("written");
    std::thread::sleep(std::time::Duration::from_millis(milliseconds));
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(killed.expect("kill runs").success());
    child.wait_with_output().expect("an end")
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_there_is_where_it_was_asked_for() {
    let folder = folder();
    let file = folder.path().join("answer.txt");
    let name = file.to_str().expect("UTF-8");
    for format in ["table", "json"] {
        let arguments = ["--format", format, "--output", name];
        // on a busy machine the run may not have begun when the signal comes; then again, later
        let ended = [500, 2000, 10_000]
            .into_iter()
            .map(|wait| {
                let ended = interrupted(&arguments, wait);
                let answer = fs::read_to_string(&file).unwrap_or_default();
                (ended, answer)
            })
            .find(|(_, answer)| {
                !answer.is_empty()
                    && !answer.contains("\"monte_carlo\": null")
                    && !answer.contains("stopped after 0 trials")
            });
        let (ended, answer) = ended.expect("a run that was interrupted after it began");
        assert_eq!(ended.status.code(), Some(130), "{}", text(&ended.stderr));
        assert!(ended.stdout.is_empty());
        if format == "json" {
            let answer: Value = serde_json::from_str(&answer).expect("JSON");
            assert_eq!(answer["stopped"], true);
            let made = answer["outputs"]["v"]["monte_carlo"]["trials"].as_u64();
            assert!(made.is_some_and(|made| made > 0 && made < 100_000_000_000), "{made:?}");
        } else {
            assert!(answer.contains("stopped after"), "{answer}");
        }
        assert_eq!(entries(folder.path()).len(), 1);
    }
}

#[test]
fn tables_fit_100_columns() {
    for path in model_files() {
        let name = path.to_str().expect("UTF-8");
        let (code, answer, message) = ended(&["run", name, "--trials", "20000"], "");
        assert_eq!(code, 0, "{name}: {message}");
        // the results are whole lines, whatever the length of a name
        for line in answer.lines().skip_while(|line| line.contains(" = ")) {
            let width = line.chars().count();
            assert!(width <= 100, "{name}: {width} columns: {line}");
        }
        assert!(!answer.contains('\u{1b}'), "{name}: colours without a terminal");
    }
}

#[test]
fn every_typed_model_has_a_template_that_is_right_and_runs() {
    let (code, list, _) = ended(&["models"], "");
    assert_eq!(code, 0);
    // a name stands at the start of its line, wrapped text does not
    let names: Vec<&str> = list
        .lines()
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .filter(|line| line.starts_with(|c: char| c.is_ascii_lowercase()))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.len() >= 15, "{list}");
    for name in names {
        let (code, template, message) = ended(&["models", name, "--template"], "");
        assert_eq!(code, 0, "{name}: {message}");
        let (code, _, message) = ended(&["check", "-"], &template);
        assert_eq!(code, 0, "{name}: {message}");
        let (code, _, message) = ended(&["run", "-", "--trials", "2000", "--quiet"], &template);
        assert_eq!(code, 0, "{name}: {message}");
        let (code, description, _) = ended(&["models", name], "");
        assert_eq!(code, 0);
        assert!(description.contains("Source:"), "{description}");
        assert!(description.lines().all(|line| line.chars().count() <= 100), "{description}");
    }
}

#[test]
fn check_says_yes_or_lists_the_mistakes() {
    let (code, answer, message) = ended(&["check", "-"], SMALL);
    assert_eq!((code, message.as_str()), (0, ""));
    assert!(answer.contains("no errors"));
    let answer = json(&["check", "-", "--format", "json"], SMALL);
    assert_eq!(answer, serde_json::json!({"ok": true, "errors": []}));
    let (code, answer, message) = ended(&["check", "-"], "{}");
    assert_eq!((code, answer.as_str()), (2, ""));
    assert!(message.contains("<stdin>:1:1: "), "{message}");
    let wrong = SMALL.replace("half_width", "halfwidth");
    let (code, answer, message) = ended(&["check", "-", "--format", "json", "--quiet"], &wrong);
    assert_eq!((code, message.as_str()), (2, ""));
    let answer: Value = serde_json::from_str(&answer).expect("JSON");
    assert_eq!(answer["ok"], false);
    let error = &answer["errors"][0];
    assert_eq!(error["suggestion"], "half_width");
    assert_eq!((error["line"].as_u64(), error["file"].as_str()), (Some(3), Some("<stdin>")));
    assert_eq!(error["code"], "unknown-key");
}

#[test]
fn verify_runs_without_a_model() {
    let (code, answer, message) = ended(&["verify", "--paths", "--trials", "5000", "--fail"], "");
    assert_eq!((code, message.as_str()), (0, ""));
    assert!(answer.contains("baseline"), "{answer}");
    assert!(answer.contains("5000 trials: the same bits on every path"), "{answer}");
}

/// Files are found beside the model file, whatever the current folder.
#[test]
fn tables_are_found_beside_the_model_file() {
    let folder = folder();
    let write = |name: &str, content: &[u8]| {
        fs::write(folder.path().join(name), content).expect("a file is written");
    };
    write("model.json", sweep("rows.csv").as_bytes());
    let name = folder.path().join("model.json");
    let arguments = ["run", name.to_str().expect("UTF-8"), "--format", "json", "--quiet"];
    // byte-order mark, line ends of Windows, semicolons and decimal commas, quotes, comments
    for content in [
        "f,g\n1.5,2\n3,4\n",
        "\u{feff}f,g\r\n1.5,2\r\n3,4\r\n",
        "# comment\nf;g\n1,5;2\n3;4\n",
        "\"f\",\"g\"\n\"1.5\",2\n3,\"4\"\n",
        "f , g\n 1.5 ,\t2\n\n3,4",
        "f;g\n\"1,5\";2\n3;4\n# end",
    ] {
        write("rows.csv", content.as_bytes());
        let answer = json(&arguments, "");
        let rows = answer["rows"].as_array().expect("rows");
        assert_eq!(rows.len(), 2, "{content:?}");
        assert_eq!(rows[0]["conditions"], serde_json::json!({"f": 1.5, "g": 2.0}), "{content:?}");
        assert_eq!(rows[1]["outputs"]["y"]["gum"]["estimate"], 13.0, "{content:?}");
    }
    for content in
        ["f,g\r\n1", "f\t g\n1 2\n", "f,g\n1,2\"\n", "f,g\n\"1,2\n", "f,g\n1;2\n", "\u{0}"]
    {
        write("rows.csv", content.as_bytes());
        let (code, _, message) = ended(&arguments, "");
        assert_eq!(code, 2, "{content:?}: {message}");
    }
}

fn sweep(table: &str) -> String {
    format!(
        r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 1, "std": 0.1}}}},
            "conditions": {{"file": "{table}"}},
            "equations": {{"y": "x + f*g"}}, "outputs": {{"y": {{}}}},
            "monte_carlo": {{"trials": 1000}}}}"#
    )
}

/// A limit of the size of files is a fault of the system that is told (setrlimit(2)).
#[cfg(target_os = "linux")]
#[test]
fn a_file_beyond_the_limit_of_files_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let (model, page) = (folder.path().join("m.json"), folder.path().join("x.html"));
    fs::write(&model, SMALL).unwrap();
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -f 2; exec \"$0\" run \"$1\" --format html --output \"$2\""]);
    command.arg(env!("CARGO_BIN_EXE_gumption")).args([&model, &page]);
    let ended = command.output().unwrap();
    let message = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert_eq!(ended.status.code(), Some(1), "{message}");
    assert!(message.contains("File too large"), "{message}");
    assert!(!page.exists());
}

/// A `-` is standard output wherever `--output` is, as it is standard input of a model, and no file of
/// any other option.
#[test]
fn a_dash_is_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let model = r#"{"inputs": {"x": {"distribution": "normal", "mean": 1, "std": 1}},
        "equations": {"y": "x"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 0}}"#;
    fs::write(folder.path().join("m.json"), model).unwrap();
    let run =
        |arguments: &[&str]| command().current_dir(folder.path()).args(arguments).output().unwrap();
    for asked in [&["run", "m.json", "--format", "json"][..], &["schema"], &["models"]] {
        let [plain, dashed] =
            [&[][..], &["--output", "-"]].map(|more| run(&[asked, more].concat()));
        assert!(dashed.status.success(), "{dashed:?}");
        assert!(!plain.stdout.is_empty() && plain.stdout == dashed.stdout, "{asked:?}");
    }
    let refused = run(&["run", "m.json", "--trials", "1000", "--save", "-"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("`--save -`"), "{refused:?}");
    assert!(!folder.path().join("-").exists());
}
