//! What every answer has to be.

use std::path::Path;
use std::sync::OnceLock;

use gumption::diff;
use gumption::file::{Diagnostics, ModelFile, read_text};
use gumption::propagate::gum::Gum;
use gumption::propagate::monte_carlo::MonteCarlo;
use gumption::propagate::{Control, evaluate, warnings};
use gumption::report;
use gumption::task::Trials;
use serde_json::Value;

use super::folder::Folder;
use crate::process::Command;
use crate::support::command;

/// Reads the text, evaluates it if it is right, and checks what comes out. Whether it was right.
pub(super) fn of(text: &str, folder: &Path) -> bool {
    match read_text("case", text, folder, &[]) {
        Ok(file) => {
            in_schema(text);
            answered(file);
            true
        }
        Err(problems) => {
            explained(&problems);
            false
        }
    }
}

/// A file that is right is right by the schema as well.
fn in_schema(text: &str) {
    static SCHEMA: OnceLock<jsonschema::Validator> = OnceLock::new();
    let schema = SCHEMA.get_or_init(|| {
        let schema = serde_json::from_str(&gumption::schema::text()).expect("JSON");
        jsonschema::validator_for(&schema).expect("a schema")
    });
    let file = serde_json::from_str(text).expect("JSON");
    // what gap cases have beside is read by `gap`
    let of_gaps = ["/effects", "/prior", "/observations", "/catalogue"];
    let errors: Vec<String> = schema
        .iter_errors(&file)
        .filter(|error| {
            let path = error.instance_path().to_string();
            !of_gaps.iter().any(|key| path.starts_with(key))
        })
        .map(|error| format!("{} at {}", error, error.instance_path()))
        .collect();
    assert!(errors.is_empty(), "against the schema: {errors:?}");
}

/// Mistakes have places inside their text and a sentence of a reasonable length.
pub(super) fn explained(diagnostics: &Diagnostics) {
    assert!(!diagnostics.0.is_empty(), "refused without a reason");
    for diagnostic in &diagnostics.0 {
        let (line, column) = diagnostic.position();
        assert!(line > 0 && column > 0);
        assert!(diagnostic.span.start <= diagnostic.span.end, "{diagnostic}");
        assert!(diagnostic.source.text.get(diagnostic.span.clone()).is_some(), "{diagnostic}");
        assert!(!diagnostic.source.name.is_empty());
        let message = diagnostic.message();
        assert!(!message.trim().is_empty());
        assert!(message.len() < 10_000, "a message without end: {message}");
    }
}

/// Evaluates with few trials and writes every report.
fn answered(mut file: ModelFile) {
    file.task.rows.truncate(3);
    file.task.settings.trials = match file.task.settings.trials {
        Trials::Fixed(trials) => Trials::Fixed(trials.min(300)),
        Trials::Adaptive => Trials::Adaptive,
    };
    file.task.settings.max_trials = file.task.settings.max_trials.min(20_000);
    let control = Control::default().with_threads(1);
    let evaluation = match evaluate(&file.task, &control) {
        Ok(evaluation) => evaluation,
        Err(error) => {
            let said = error.to_string();
            return assert!(!said.is_empty() && said.len() < 20_000, "{said}");
        }
    };
    for output in evaluation.rows.iter().flat_map(|row| &row.outputs) {
        if let Some(gum) = &output.gum {
            linear(gum);
        }
        if let Some(figures) = &output.monte_carlo {
            drawn(figures);
        }
    }
    for row in &evaluation.rows {
        let pairs = row.outputs.len() * (row.outputs.len() - 1) / 2;
        assert_eq!(row.correlations.len(), pairs);
        assert!(row.correlations.iter().all(|r| r.is_nan() || (-1.0..=1.0).contains(r)));
    }
    let warnings = warnings(&file.task, &evaluation);
    let provenance = report::Provenance { model_sha256: String::new(), files: Vec::new() };
    let report = report::EvaluationReport {
        task: &file.task,
        evaluation: &evaluation,
        warnings: &warnings,
        provenance: &provenance,
    };
    let columns = report::BudgetColumn::ALL.to_vec();
    for columns in [Vec::new(), columns] {
        let shown = report::Shown { columns: &columns, ..report::Shown::default() };
        let page = report::table(&report, &shown);
        assert!(!page.is_empty());
        let shown = |c: char| c == '\n' || !c.is_control();
        assert!(page.chars().all(shown), "{page:?}");
        let is_number = |word: &str| !["NaN", "inf", "-inf", "nan"].contains(&word);
        assert!(page.split_whitespace().all(is_number), "{page}");
    }
    let csv = report::csv(&report);
    assert!(csv.split([',', '\n']).all(|cell| !["NaN", "inf", "-inf"].contains(&cell)), "{csv}");
    let json = report::json(&report);
    assert!(serde_json::from_str::<Value>(&json).is_ok(), "the answer is no JSON: {json}");
    let difference = diff::compare(&file.task, &file.task);
    assert!(difference.changes.is_empty(), "{:?}", difference.changes);
}

/// Figures of the law of propagation.
fn linear(gum: &Gum) {
    assert!(gum.estimate.is_finite());
    assert!(gum.standard_uncertainty >= 0.0, "u = {}", gum.standard_uncertainty);
    let lines: Vec<_> = gum.budget().collect();
    let coefficients: Vec<_> = gum.correlations().collect();
    let shares = lines.iter().map(|line| line.share);
    let joint = coefficients.iter().map(|line| line.share);
    let largest = shares.clone().chain(joint.clone()).map(f64::abs).fold(0.0, f64::max);
    let sum: f64 = shares.chain(joint).sum();
    if gum.standard_uncertainty > 0.0 && gum.standard_uncertainty.is_finite() {
        // rounding of as many shares, of which negative ones may be large
        let rounding = 1e-12 * (1.0 + largest) * (lines.len() + coefficients.len()) as f64;
        assert!((sum - 1.0).abs() < rounding, "shares add up to {sum}");
    } else {
        assert_eq!(largest, 0.0, "u = {}", gum.standard_uncertainty);
    }
    for line in &lines {
        let contribution = (line.sensitivity * line.standard_uncertainty).abs();
        assert_eq!(line.contribution, contribution);
    }
    if let Some([low, high]) = gum.interval() {
        assert!(low <= high || !low.is_finite() || !high.is_finite(), "{low}, {high}");
    }
    // below the smallest doubles a probability has the factor 0
    assert!(gum.coverage_factor.is_none_or(|k| k >= 0.0), "{:?}", gum.coverage_factor);
}

/// Figures of the trials.
fn drawn(figures: &MonteCarlo) {
    let MonteCarlo { median, symmetric_interval: [low, high], .. } = *figures;
    let [shortest_low, shortest_high] = figures.shortest_interval;
    assert!(figures.trials > 0);
    assert!([low, high, median, shortest_low, shortest_high].iter().all(|x| x.is_finite()));
    assert!(low <= high && shortest_low <= shortest_high, "{figures:?}");
    assert!(shortest_high - shortest_low <= high - low, "{figures:?}");
    assert!(figures.standard_uncertainty.is_none_or(|u| u >= 0.0), "{figures:?}");
    assert!((0.0..=1.0).contains(&figures.inside), "{figures:?}");
}

/// The program, in an address space of 1 GiB: it ends with 0 or 2, and says where a mistake is.
pub(super) fn of_program(text: &str, folder: &Folder) {
    folder.write("m.json", text);
    let program = command();
    let mut limited = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        shell.args(["-c", "ulimit -v 1048576 && exec \"$0\" \"$@\""]).arg(program.get_program());
        shell
    } else {
        program
    };
    limited.env("MALLOC_ARENA_MAX", "2").current_dir(folder.path());
    limited.args(["run", "m.json", "--trials", "300", "--threads", "2", "--format", "json"]);
    let output = limited.output().expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => {
            let parsed = serde_json::from_slice::<Value>(&output.stdout);
            assert!(parsed.is_ok(), "{}", String::from_utf8_lossy(&output.stdout));
        }
        Some(2) => {
            let files = ["m.json:", "t.csv:", "s.txt:", "r.result:", "good.csv:", "good.txt:"];
            let first = said.lines().next().unwrap_or("");
            assert!(files.iter().any(|file| first.starts_with(file)), "{said}");
        }
        code => panic!("ends with {code:?}: {said}"),
    }
}
