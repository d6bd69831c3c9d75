//! The formats of `run` as the command gives them: what goes where, and what is refused.

use std::fs;

use crate::support::{gumption, output};

const MODEL: &str = "models/inclined_plane.json";
const SWEEP: &str = "models/measuring_chain_frequencies.json";

/// Standard output of `run`, as bytes.
fn bytes(arguments: &[&str]) -> Vec<u8> {
    let assert = gumption().arg("run").args(arguments).arg("--quiet").assert().success();
    assert!(assert.get_output().stderr.is_empty());
    assert.get_output().stdout.clone()
}

/// Exit code and standard error of a `run` that gives no answer.
fn refused(arguments: &[&str]) -> String {
    let assert = gumption().arg("run").args(arguments).assert().code(2);
    assert!(assert.get_output().stdout.is_empty());
    String::from_utf8(assert.get_output().stderr.clone()).expect("UTF-8")
}

#[test]
fn every_format_is_the_same_bytes_on_any_number_of_threads() {
    let beginnings: [(&str, &[u8]); 4] = [
        ("markdown", b"# Accelerations on"),
        ("latex", b"\\documentclass"),
        ("html", b"<!DOCTYPE html>"),
        ("xlsx", b"PK\x03\x04"),
    ];
    for (format, beginning) in beginnings {
        let with = |threads| {
            bytes(&[MODEL, "--format", format, "--trials", "50000", "--threads", threads])
        };
        let answer = with("1");
        assert!(answer.starts_with(beginning), "{format}");
        assert!(answer == with("3"), "{format}");
    }
}

#[test]
fn an_output_file_has_what_standard_output_has() {
    let folder = tempfile::tempdir().expect("a folder");
    // pages of the other formats have figures in a file alone
    for format in ["html", "xlsx", "json", "csv"] {
        for model in [MODEL, SWEEP] {
            let path = folder.path().join("answer");
            let name = path.to_str().expect("a path");
            let arguments = [model, "--format", format, "--trials", "2000"];
            let shown = bytes(&arguments);
            assert!(bytes(&[&arguments[..], &["--output", name]].concat()).is_empty());
            let written = fs::read(&path).expect("the answer");
            assert!(written == shown, "{format}, {model}");
        }
    }
    let missing = folder.path().join("missing/answer.xlsx");
    let arguments = ["run", MODEL, "--format", "xlsx", "--trials", "0", "--output"];
    gumption().args(arguments).arg(&missing).assert().code(2);
}

/// No page says where or when it was made.
#[test]
fn pages_have_no_path_and_no_date() {
    let root = env!("CARGO_MANIFEST_DIR");
    let model = format!("{root}/{MODEL}");
    for format in ["markdown", "latex", "html"] {
        let page = output(&["run", &model, "--format", format, "--trials", "2000", "--quiet"]);
        assert!(!page.contains(root), "{format}");
        // the only address is the name of the drawings' language
        let addresses = page.matches("http:").count() + page.matches("https:").count();
        assert_eq!(addresses, page.matches("http://www.w3.org/2000/svg").count());
    }
}

#[test]
fn what_the_command_line_replaces_is_on_the_page() {
    let page = output(&[
        "run",
        MODEL,
        "--format",
        "markdown",
        "--trials",
        "0",
        "--set",
        "tilt=36 deg",
        "--quiet",
    ]);
    assert!(page.contains("| replaced ") && page.contains("tilt=36 deg"), "{page}");
}

#[test]
fn histograms_stand_in_the_sections_of_their_outputs() {
    let with = |more: &[&str]| {
        let arguments = ["run", MODEL, "--trials", "20000", "--quiet"];
        output(&[&arguments[..], more].concat())
    };
    let (plain, drawn) = (with(&[]), with(&["--histogram"]));
    // the same page with more between its lines
    let mut lines = drawn.lines();
    assert!(plain.lines().all(|line| lines.any(|other| other == line)), "{drawn}");
    assert_eq!(drawn.matches("MC, symmetric").count(), 3);
    assert!(drawn.contains('█') && drawn.lines().all(|line| line.chars().count() <= 100));
    let rows = output(&["run", SWEEP, "--trials", "2000", "--quiet", "--histogram"]);
    assert_eq!(rows.matches("MC, symmetric").count(), 18);
    assert_eq!(rows.matches("at frequency = ").count(), 18);
}

#[test]
fn histograms_that_cannot_be_drawn_are_refused() {
    let said = refused(&[MODEL, "--histogram", "--format", "json"]);
    assert!(said.contains("`--histogram` goes with `--format table`"), "{said}");
    let said = refused(&[MODEL, "--histogram", "--trials", "0"]);
    assert!(said.contains("needs Monte Carlo trials"), "{said}");
}

/// In every row of a sweep the shares of the inputs, of correlations and of all others add up to 100 %,
/// each rounded to a tenth.
#[test]
fn shares_of_a_sweep_add_up() {
    let tutorial = fs::read_to_string(crate::support::root().join("docs/tutorial.md")).unwrap();
    let (_, model) = tutorial.split_once("```json file=transducer.json\n").expect("the model");
    let (model, _) = model.split_once("\n```").expect("its end");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("transducer.json");
    fs::write(&path, model).unwrap();
    let page = output(&[
        "run",
        path.to_str().unwrap(),
        "--trials",
        "2000",
        "--format",
        "markdown",
        "--quiet",
    ]);
    let (_, table) = page.split_once("Shares of the variance in %:\n\n").expect("the shares");
    let lines: Vec<Vec<&str>> = table
        .lines()
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert!(lines[0].iter().any(|header| header.starts_with("r(")), "{:?}", lines[0]);
    // the first column is the condition, below the headers and a rule
    assert_eq!(lines.len(), 2 + 5);
    for line in &lines[2..] {
        let number = |cell: &&str| cell.replace('\u{2212}', "-").parse::<f64>().expect("a number");
        let sum: f64 = line[1..].iter().map(number).sum();
        assert!((sum - 100.0).abs() < 0.06 * line.len() as f64, "{line:?}: {sum}");
    }
}

/// Limits beyond a histogram are arrows with their numbers, not ends.
#[test]
fn limits_beyond_a_histogram_are_arrows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    let model = r#"{"inputs": {"a": {"unit": "ohm", "distribution": "normal", "mean": 100.01, "std": 0.003}},
        "equations": {"R": "a"}, "outputs": {"R": {"unit": "ohm", "tolerance": {"lower": 99, "upper": 101}}}}"#;
    fs::write(&path, model).unwrap();
    let page =
        output(&["run", path.to_str().unwrap(), "--histogram", "--quiet", "--trials", "20000"]);
    let line = page.lines().find(|line| line.trim_start().starts_with("tolerance  ←"));
    let line = line.unwrap_or_else(|| panic!("{page}"));
    assert!(line.contains("← 99 ─") && line.ends_with("─ 101 →"), "{line}");
    assert!(!line.contains('├') && !line.contains('┤'), "{line}");
}
