//! Very large and very deep files: answered, or refused with a message that names the limit, in at
//! most 1 GiB of memory.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::process::Command;
use crate::support::command;

/// Kilobytes of address space: memory that is only reserved counts as well, so less than this is
/// used.
const LIMIT: u32 = 1 << 20;

/// The program, killed by the system if it asks for more memory than allowed (on Linux).
fn limited(folder: &Path, arguments: &[&str]) -> Output {
    let program = command();
    let mut limited = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        let script = format!("ulimit -v {LIMIT} && exec \"$0\" \"$@\"");
        shell.args(["-c", &script]).arg(program.get_program());
        shell
    } else {
        program
    };
    // arenas of the allocator reserve address space for each thread
    limited.env("MALLOC_ARENA_MAX", "2").current_dir(folder);
    limited.args(arguments).args(["--threads", "2"]).output().expect("the program runs")
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.path().join(name);
        fs::write(&path, text).unwrap();
        path
    }

    /// What `run` says of a model file: its exit code, standard output and standard error.
    fn run(&self, text: &str, options: &[&str]) -> (i32, String, String) {
        self.write("m.json", text);
        let arguments: Vec<&str> = ["run", "m.json"].iter().chain(options).copied().collect();
        let output = limited(self.0.path(), &arguments);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (out, err) = (text(&output.stdout), text(&output.stderr));
        let code = output.status.code();
        (code.unwrap_or_else(|| panic!("killed: {}", cut(&err))), out, err)
    }

    fn refused(&self, text: &str, options: &[&str], reason: &str) {
        let (code, out, err) = self.run(text, options);
        assert_eq!(code, 2, "{reason}: {}", cut(&err));
        assert!(out.is_empty(), "{reason}");
        assert!(err.contains(reason) && err.contains(".json:1:"), "{reason}: {}", cut(&err));
        assert!(err.len() < 5000, "{reason}: {} bytes", err.len());
    }

    fn answered(&self, text: &str, options: &[&str]) -> String {
        let (code, out, err) = self.run(text, options);
        assert_eq!(code, 0, "{}", cut(&err));
        out
    }
}

fn cut(text: &str) -> &str {
    text.char_indices().nth(500).map_or(text, |(end, _)| &text[..end])
}

/// A model of one input with this formula.
fn formula(text: &str) -> String {
    format!(
        r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 1, "std": 0.01}}}},
        "equations": {{"y": "{text}"}}, "outputs": {{"y": {{}}}}}}"#
    )
    .replace('\n', "")
}

/// Inputs `x0`, `x1`, ...
fn inputs(count: usize) -> String {
    let input = |i| format!(r#""x{i}": {{"distribution": "normal", "mean": {i}, "std": 0.1}}"#);
    (0..count).map(input).collect::<Vec<_>>().join(", ")
}

/// Equations that add up inputs, a thousand in each.
fn sums(count: usize) -> String {
    let part = |first: usize| {
        let terms: Vec<String> =
            (first..count.min(first + 1000)).map(|i| format!("x{i}")).collect();
        format!(r#""p{first}": "{}""#, terms.join(" + "))
    };
    let firsts = || (0..count).step_by(1000);
    let names: Vec<String> = firsts().map(|first| format!("p{first}")).collect();
    let parts: Vec<String> = firsts().map(part).collect();
    format!(r#"{}, "y": "{}""#, parts.join(", "), names.join(" + "))
}

fn model(inputs: &str, equations: &str, rest: &str) -> String {
    format!(
        r#"{{"inputs": {{{inputs}}}, "equations": {{{equations}}}, {rest}, "outputs": {{"y": {{}}}}}}"#
    )
}

const FEW: &str = r#""monte_carlo": {"trials": 1000}"#;

#[test]
fn deep_texts_are_refused() {
    let folder = Folder::new();
    for (open, close) in [("[", "]"), ("{\"a\":", "}")] {
        let deep = format!("{}1{}", open.repeat(100_000), close.repeat(100_000));
        folder.refused(&deep, &[], "more than 127 lists and objects are nested");
    }
    let inside = "parentheses, functions, signs or powers inside each other";
    for (open, close) in [("(", ")"), ("sin(", ")"), ("-", ""), ("x^", "")] {
        folder.refused(
            &formula(&format!("{}x{}", open.repeat(5000), close.repeat(5000))),
            &[],
            inside,
        );
    }
    // 100 powers of powers are fine
    folder.answered(&formula(&format!("{}x", "x^".repeat(100))), &["--trials", "1000"]);
}

#[test]
fn numbers_of_many_digits_are_read_or_refused() {
    let folder = Folder::new();
    let digits = "1".repeat(99_000);
    let with_mean =
        |mean: &str| formula("x").replace(r#""mean": 1"#, &format!(r#""mean": {mean}"#));
    let too_large = "this number is larger than any in double precision";
    folder.refused(&with_mean(&digits), &[], too_large);
    folder.refused(&with_mean(&format!("1e{digits}")), &[], too_large);
    folder.answered(&with_mean(&format!("0.{digits}")), &["--trials", "1000"]);
    folder.answered(&with_mean(&format!("1e-{digits}")), &["--trials", "1000"]);
    folder.refused(&formula(&format!("x + {digits}")), &[], "");
    let width = with_mean("1").replace(r#""std": 0.01"#, &format!(r#""std": "{digits} V""#));
    folder.refused(&width, &[], "the width");
    let unit = with_mean("1").replace(r#""mean""#, &format!(r#""unit": "m^{digits}", "mean""#));
    folder.refused(&unit, &[], "the unit");
}

#[test]
fn long_formulas_are_refused() {
    let folder = Folder::new();
    let limit = "is too long for a formula; at most 100000 are allowed";
    for text in ["x + ".repeat(250_000) + "x", "x".repeat(1_000_000), "@".repeat(1_000_000)] {
        folder.refused(&formula(&text), &[], limit);
    }
    // 24,999 operations, and a name of 1 MB
    folder.answered(&formula(&("x + ".repeat(24_999) + "x")), &["--trials", "1000"]);
    let long = "a".repeat(1_000_000);
    let text = formula("x").replace("\"y\"", &format!("\"{long}\""));
    assert_eq!(folder.run(&text.replace(&format!("\"{long}\": \"x\""), "\"b\": \"x\""), &[]).0, 2);
}

#[test]
fn results_that_refer_to_each_other_are_refused() {
    let folder = Folder::new();
    let model = |file: &str| {
        format!(
            r#"{{"format": 1, "inputs": {{"x": {{"distribution": "result", "file": "{file}",
            "output": "y"}}}}, "equations": {{"y": "x"}}, "outputs": {{"y": {{}}}}}}"#
        )
        .replace('\n', "")
    };
    folder.refused(&model("m.json"), &[], "is not a saved result");
    folder.write("other.json", &model("m.json"));
    folder.refused(&model("other.json"), &[], "is not a saved result");
    folder.refused(&model("."), &[], "`.`: it is a folder; name a file in it");
    // a result computed from a result, saved over it: it goes back to the first model's inputs
    let first = folder.0.path().join("r.json");
    let first = first.to_str().unwrap();
    folder.answered(&formula("2*x"), &["--trials", "1000", "--save", first]);
    for _ in 0..3 {
        let next = folder.0.path().join("next.json");
        let save = ["--trials", "1000", "--save", next.to_str().unwrap()];
        folder.answered(&model("r.json"), &save);
        fs::rename(&next, first).unwrap();
    }
    assert!(fs::metadata(first).unwrap().len() < 100_000);
}

#[test]
fn files_without_an_end_are_refused() {
    if !cfg!(target_os = "linux") {
        return;
    }
    let folder = Folder::new();
    let output = limited(folder.0.path(), &["run", "/dev/zero"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("larger than 50 MB"), "{said}");
    let samples = formula("x")
        .replace(r#""normal", "mean": 1, "std": 0.01"#, r#""samples", "file": "/dev/zero""#);
    folder.refused(&samples, &["--allow-path", "/dev"], "larger than 200 MB");
}

#[test]
fn a_million_inputs_are_refused() {
    let folder = Folder::new();
    let (code, _, err) = folder.run(&model(&inputs(1_000_000), r#""y": "x0""#, FEW), &[]);
    assert_eq!((code, err.contains("larger than 50 MB")), (2, true), "{}", cut(&err));
    let short = (0..1_000_000).map(|i| format!("\"x{i}\":{{}}")).collect::<Vec<_>>().join(",");
    folder.refused(&model(&short, r#""y": "x0""#, FEW), &[], "there are 1000000 inputs");
    let component = r#"{"name": "a", "distribution": "normal", "std": 1}"#;
    let many =
        format!(r#""x": {{"mean": 0, "components": [{}]}}"#, [component; 100_001].join(", "));
    folder.refused(&model(&many, r#""y": "x""#, FEW), &[], "there are 100001 components");
}

#[test]
fn twenty_thousand_inputs_are_served() {
    let folder = Folder::new();
    // 0.1 sqrt(20 000) = 14.1
    let page = folder.answered(&model(&inputs(20_000), &sums(20_000), FEW), &["--full"]);
    assert!(page.contains("combined standard uncertainty  14"), "{}", cut(&page));
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn a_hundred_thousand_inputs_are_served() {
    let folder = Folder::new();
    let json = ["--format", "json"];
    let answer = folder.answered(&model(&inputs(100_000), &sums(100_000), FEW), &json);
    let answer: serde_json::Value = serde_json::from_str(&answer).expect("JSON");
    let found = answer["outputs"]["y"]["gum"]["standard_uncertainty"].as_f64();
    // the sum of 100 000 equal squares is right to 1e-11 whatever their order
    let expected = 0.1 * 100_000f64.sqrt();
    assert!(found.is_some_and(|u| (u - expected).abs() < 1e-9), "{found:?}");
}

#[test]
fn a_thousand_correlated_inputs_are_served() {
    let folder = Folder::new();
    let names: Vec<String> = (0..1000).map(|i| format!("\"x{i}\"")).collect();
    let matrix = |odd: &str| {
        let cell = |i: usize, j: usize| match (i.min(j), i.max(j)) {
            (0, 1) => odd.to_owned(),
            _ if i == j => "1".to_owned(),
            _ => "0.3".to_owned(),
        };
        let row = |i| format!("[{}]", (0..1000).map(|j| cell(i, j)).collect::<Vec<_>>().join(","));
        let rows = (0..1000).map(row).collect::<Vec<_>>().join(",\n");
        let (names, rest) = (names.join(","), FEW);
        let correlated =
            format!(r#""correlation_matrix": {{"names": [{names}], "values": [{rows}]}}, {rest}"#);
        model(&inputs(1000), &sums(1000), &correlated)
    };
    let page = folder.answered(&matrix("0.3"), &["--full"]);
    // 0.1 sqrt(1000 + 1000 999 0.3) = 54.8, and a share of 299.7 / 300.7 of the variance
    let found = page.lines().find(|line| line.starts_with("combined standard uncertainty"));
    assert!(found.is_some_and(|line| line.trim_end().ends_with(" 55")), "{}", cut(&page));
    let line = page.lines().find(|line| line.contains("499 500")).expect("the coefficients");
    assert!(line.trim_end().ends_with("99.7"), "{line}");
    let (code, _, err) = folder.run(&matrix("-0.9"), &[]);
    assert_eq!(code, 2, "{}", cut(&err));
    assert!(err.contains("`x0`, `x1`, `x999` contradict each other"), "{}", cut(&err));
    let pairs = (0..2000).map(|i| format!("[\"x{i}\", \"x{}\", 0.1]", i + 1)).collect::<Vec<_>>();
    let chain = format!("\"correlations\": [{}], {FEW}", pairs.join(", "));
    folder.refused(
        &model(&inputs(2001), &sums(2001), &chain),
        &[],
        "2001 quantities are correlated with each other; this version takes 2000 at most",
    );
}

#[test]
fn many_outputs_are_served_or_refused() {
    let folder = Folder::new();
    let with = |outputs: usize, inputs_wanted: usize| {
        let equations: Vec<String> =
            (0..outputs).map(|i| format!("\"y{i}\": \"{}*x0 + x1\"", i + 1)).collect();
        let outputs: Vec<String> = (0..outputs).map(|i| format!("\"y{i}\": {{}}")).collect();
        let text = model(&inputs(inputs_wanted), &equations.join(", "), FEW);
        text.replace(r#""outputs": {"y": {}}"#, &format!("\"outputs\": {{{}}}", outputs.join(", ")))
    };
    let page = folder.answered(&with(1000, 3), &["--full"]);
    assert!(page.contains("499 500 correlation coefficients of the outputs: --format json"));
    folder.refused(&with(3001, 2), &[], "there are 3001 outputs");
    folder.refused(&with(2500, 5000), &[], "there are 12500000 lines of budgets");
}

/// Three inputs at a thousand conditions f and so many conditions g.
fn rows(second: usize, rest: &str) -> String {
    let values = |count: usize| {
        let values: Vec<String> = (1..=count).map(|value| value.to_string()).collect();
        values.join(", ")
    };
    let (f, g) = (values(1000), values(second));
    let conditions =
        format!(r#""conditions": {{"f": {{"values": [{f}]}}, "g": {{"values": [{g}]}}}}, {rest}"#);
    model(&inputs(3), r#""y": "x0*f + x1*g + x2""#, &conditions)
}

/// As many times a thousand rows by the law of propagation.
fn thousands_of_rows_are_served(count: usize) {
    let table =
        Folder::new().answered(&rows(count, r#""monte_carlo": {"trials": 0}"#), &["--full"]);
    // one header for each thousand lines, of the answer and of the shares
    assert_eq!(table.lines().filter(|line| line.starts_with("1000")).count(), 2 * count);
    assert_eq!(table.matches("expanded").count(), count);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn a_million_rows_are_served() {
    thousands_of_rows_are_served(1000);
}

/// As many times a thousand rows with trials.
fn thousands_of_rows_have_trials(count: usize) {
    let rows = rows(count, r#""monte_carlo": {"trials": 100}"#);
    let csv = Folder::new().answered(&rows, &["--format", "csv", "--quiet"]);
    assert_eq!(csv.lines().count(), 1000 * count + 1);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn a_hundred_thousand_rows_have_trials() {
    thousands_of_rows_have_trials(100);
}

/// Twenty thousand rows, without and with trials; a million is the most.
#[test]
fn many_rows_are_served_or_refused() {
    thousands_of_rows_are_served(20);
    thousands_of_rows_have_trials(20);
    let folder = Folder::new();
    folder.write("m.json", &rows(1000, r#""monte_carlo": {"trials": 0}"#));
    let checked = command().current_dir(folder.0.path()).args(["check", "m.json"]).status();
    assert!(checked.expect("the program runs").success());
    folder.refused(&rows(1001, FEW), &[], "there are 1001000 rows of conditions");
    let two = rows(600, FEW).replace(r#""y": {}"#, r#""y": {}, "x0": {}"#);
    folder.refused(&two, &[], "there are 1200000 results");
}

/// Each equation uses the one before twice: 2^60 paths lead from the last one to the inputs.
#[test]
fn shared_sums_are_taken_apart() {
    let equation = |i: usize| match i {
        0 => r#""e0": "x0 + x1""#.to_owned(),
        _ => format!(r#""e{i}": "0.5*e{0} + 0.25*e{0} + 0.25*e{0}""#, i - 1),
    };
    let equations: Vec<String> = (0..=60).map(equation).collect();
    let text = model(&inputs(2), &format!(r#"{}, "y": "e60""#, equations.join(", ")), FEW);
    let options = ["--method", "exact", "--format", "json"];
    let answer: serde_json::Value =
        serde_json::from_str(&Folder::new().answered(&text, &options)).expect("JSON");
    let u = answer["outputs"]["y"]["exact"]["standard_uncertainty"].as_f64();
    assert!(u.is_some_and(|u| (u - 0.02_f64.sqrt()).abs() < 1e-9), "{u:?}");
}

/// Every input's standard uncertainty is doubled, so that each has the same share of the change.
#[test]
fn saved_results_of_a_thousand_inputs_are_compared() {
    let folder = Folder::new();
    let first = model(&inputs(1000), &sums(1000), FEW);
    let second = first.replace(r#""std": 0.1"#, r#""std": 0.2"#);
    for (text, name) in [(first, "a.json"), (second, "b.json")] {
        let path = folder.0.path().join(name);
        folder.answered(&text, &["--save", path.to_str().unwrap()]);
    }
    let output = command()
        .current_dir(folder.0.path())
        .args(["diff", "a.json", "b.json", "--format", "json"])
        .output()
        .unwrap();
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let inputs = answer["outputs"]["y"]["inputs"].as_array().expect("inputs");
    let share = |input: &serde_json::Value| input["share_of_change"].as_f64().unwrap();
    assert_eq!(inputs.len(), 1000);
    assert!(inputs.iter().all(|input| (share(input) - 1e-3).abs() < 1e-9));
}

#[test]
fn mistakes_without_end_are_cut_off() {
    let folder = Folder::new();
    let broken: Vec<String> =
        (0..100_000).map(|i| format!(r#""x{i}": {{"distribution": "normall"}}"#)).collect();
    let text = model(&broken.join(", "), r#""y": "1""#, FEW);
    let (code, _, err) = folder.run(&text, &[]);
    assert_eq!((code, err.contains("and 801 more")), (2, true), "{}", cut(&err));
    folder.write("m.json", &text);
    let output = command()
        .current_dir(folder.0.path())
        .args(["check", "m.json", "--format", "json", "--quiet"])
        .output()
        .unwrap();
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(answer["errors"].as_array().unwrap().len(), 1001);
    assert_eq!(answer["errors"][1000]["code"], "more-mistakes");
    // a table of nothing but faults
    folder.write("t.csv", &("f,g\n".to_owned() + &"x,1\n".repeat(1_000_000)));
    let table = model(
        &inputs(2),
        r#""y": "x0*f""#,
        &format!(r#""conditions": {{"file": "t.csv"}}, {FEW}"#),
    );
    let (code, _, err) = folder.run(&table, &[]);
    assert_eq!((code, err.contains("t.csv:2:1: ")), (2, true), "{}", cut(&err));
    folder.write("t.csv", &("f,g\n".to_owned() + &"1,2\n".repeat(1_000_001)));
    let (code, _, err) = folder.run(&table, &[]);
    assert!(code == 2 && err.contains("there are 1000001 rows of a table"), "{}", cut(&err));
}
