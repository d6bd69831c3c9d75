//! The measurements of `models/examples/published/`: what documents print and what other programs
//! compute, beside what comes out. `GUMPTION_UPDATE=1 cargo test --test all published` writes their
//! page anew.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use crate::support::{command, root};

/// Trials where a value comes from them: the tolerances of those values are for so many.
const TRIALS: &str = "200000";

/// What is expected of a measurement.
struct Measurement {
    source: String,
    published: Vec<Expected>,
    recomputed: Vec<Expected>,
    notes: String,
}

struct Expected {
    /// `None` for a path from the root of the answer.
    output: Option<String>,
    path: String,
    /// `None` for what is infinite.
    value: Option<f64>,
    tolerance: f64,
    why: String,
}

fn folder() -> PathBuf {
    root().join("models/examples/published")
}

/// What `recompute.py` of the folder printed, in its order.
fn expected() -> Vec<(String, Measurement)> {
    let text = fs::read_to_string(folder().join("expected.json")).expect("expected.json");
    let all: Value = serde_json::from_str(&text).expect("JSON");
    let all = all.as_object().expect("measurements");
    all.iter().map(|(name, value)| (name.clone(), measurement(value))).collect()
}

fn measurement(of: &Value) -> Measurement {
    let text = |of: &Value, key: &str| of[key].as_str().expect("a text").to_owned();
    let one = |of: &Value| Expected {
        output: of["output"].as_str().map(str::to_owned),
        path: text(of, "path"),
        value: of["value"].as_f64(),
        tolerance: of["tolerance"].as_f64().expect("a tolerance"),
        why: text(of, "why"),
    };
    let list = |key: &str| of[key].as_array().expect("a list").iter().map(one).collect();
    Measurement {
        source: text(of, "source"),
        published: list("published"),
        recomputed: list("recomputed"),
        notes: text(of, "notes"),
    }
}

/// Standard output of the program in a folder.
fn told(folder: &std::path::Path, arguments: &[&str]) -> String {
    let mut command = command();
    let said = command.args(arguments).arg("--quiet").current_dir(folder).output().expect("run");
    let error = String::from_utf8_lossy(&said.stderr);
    assert!(said.status.success(), "{arguments:?}: {error}");
    String::from_utf8(said.stdout).expect("UTF-8")
}

/// A copy of the files, in which a result can be saved.
fn copied() -> tempfile::TempDir {
    let copy = tempfile::tempdir().expect("a folder");
    for entry in fs::read_dir(folder()).expect("the folder") {
        let path = entry.expect("an entry").path();
        fs::copy(&path, copy.path().join(path.file_name().expect("a name"))).expect("copied");
    }
    let save =
        ["run", "reflection-saved.json", "--trials", TRIALS, "--save", "reflection.result.json"];
    told(copy.path(), &save);
    copy
}

fn answer(folder: &std::path::Path, name: &str, of: &Measurement) -> Value {
    let model = format!("{name}.json");
    let text = if folder.join(&model).exists() {
        let needs_trials = |e: &Expected| e.path.contains("monte_carlo");
        let any = of.published.iter().chain(&of.recomputed).any(needs_trials);
        let trials = if any { TRIALS } else { "0" };
        told(folder, &["run", &model, "--format", "json", "--trials", trials])
    } else {
        told(folder, &["compare", &format!("{name}.csv"), "--format", "json"])
    };
    serde_json::from_str(&text).expect("an answer")
}

/// The number at a place of the answer; outside `None` if there is no such place, inside if it is
/// `null`.
fn found(answer: &Value, of: &Expected) -> Option<Option<f64>> {
    let root = match &of.output {
        Some(output) => answer.get("outputs")?.get(output)?,
        None => answer,
    };
    let mut steps = of.path.split(['.', '[', ']']).filter(|step| !step.is_empty());
    let value = steps.try_fold(root, |value, step| match value {
        Value::Array(list) => list.get(step.parse::<usize>().ok()?),
        other => other.get(step),
    })?;
    if value.is_null() { Some(None) } else { Some(Some(value.as_f64()?)) }
}

/// A number with at most ten significant digits.
fn shown(value: Option<f64>) -> String {
    let Some(value) = value else { return "∞".to_owned() };
    let rounded: f64 = format!("{value:.9e}").parse().expect("a number");
    let plain = rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs());
    if plain { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// The page, and what does not agree.
fn page() -> (String, Vec<String>) {
    let copy = copied();
    let mut page = String::from(
        "# Published measurements\n\nEach file is a measurement as a document has it, or one of a \
         laboratory's daily work, beside what is known of it from elsewhere: *published* is what the \
         document prints (agreement within half a unit of its last digit, unless the last column says \
         otherwise), *recomputed* is what another program makes of the same inputs (`recompute.py`, \
         with GTC, numpy and scipy). What is said to be \"numbers of this file\" is an example of ours \
         for an equation of that document. The files are in `models/examples/published/`; \
         `gumption models --examples NAME` prints those that need no table. A test makes this page and \
         checks every line of it.\n",
    );
    let mut wrong = Vec::new();
    let mut titles = BTreeMap::new();
    for (name, of) in expected() {
        let answer = answer(copy.path(), &name, &of);
        let title =
            answer.get("title").and_then(Value::as_str).unwrap_or("Constant of gravitation");
        titles.insert(name.clone(), title.to_owned());
        let kind = if copy.path().join(format!("{name}.json")).exists() { "json" } else { "csv" };
        let _ = write!(page, "\n## {title}\n\n`{name}.{kind}`: {}.", of.source);
        if !of.notes.is_empty() {
            let _ = write!(page, " {}", of.notes);
        }
        page.push_str(
            "\n\n| value | published | recomputed | gumption | by |\n|---|---|---|---|---|\n",
        );
        let published = of.published.iter().map(|e| (e, true));
        for (e, published) in published.chain(of.recomputed.iter().map(|e| (e, false))) {
            let got = found(&answer, e);
            let agrees = match (got, e.value) {
                (Some(None), None) => true,
                (Some(Some(got)), Some(value)) => (got - value).abs() <= e.tolerance,
                _ => false,
            };
            let output = e.output.as_deref().map_or(String::new(), |output| format!("{output}: "));
            let place = format!("{output}{}", e.path.trim_start_matches("gum."));
            if !agrees {
                wrong
                    .push(format!("{name}: {place}: {got:?}, not {:?} ± {}", e.value, e.tolerance));
            }
            let value = shown(e.value);
            let (first, second) =
                if published { (value.as_str(), "") } else { ("", value.as_str()) };
            let _ = writeln!(
                page,
                "| `{place}` | {first} | {second} | {} | {} |",
                shown(got.flatten()),
                e.why
            );
        }
    }
    (page, wrong)
}

#[test]
fn measurements_agree_with_documents_and_other_programs() {
    let (page, wrong) = page();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for name in ["docs/published.md", "models/examples/published/README.md"] {
        let path = root().join(name);
        let text = if name.starts_with("docs") {
            page.clone()
        } else {
            page.replace("The files are in `models/examples/published/`; ", "")
        };
        if std::env::var_os("GUMPTION_UPDATE").is_some() {
            fs::write(&path, &text).expect("written");
        }
        let committed = fs::read_to_string(&path).expect("the page");
        assert!(committed == text, "{name} is of another version: GUMPTION_UPDATE=1");
    }
}

/// Every file of the folder is on the page, and every model runs with trials.
#[test]
fn every_file_is_expected_and_runs_with_trials() {
    let expected: Vec<String> = expected().into_iter().map(|(name, _)| name).collect();
    assert!(expected.len() >= 33, "{}", expected.len());
    let copy = copied();
    for entry in fs::read_dir(folder()).expect("the folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if path.extension().is_none_or(|of| of != "json") || name == "expected" {
            continue;
        }
        assert!(expected.contains(&name), "{name} is not in expected.json");
        let file = format!("{name}.json");
        told(copy.path(), &["run", &file, "--trials", "2000", "--format", "json"]);
    }
}
