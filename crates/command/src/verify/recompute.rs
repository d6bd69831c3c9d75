//! The examples recomputed, value by value.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use serde_json::Value;

use super::examples::Example;
use gumption_analysis::verification::{PublishedValue, RecomputedExample, RecomputedValue};
use gumption_engine::propagate::{Control, evaluate};
use gumption_engine::task::Trials;
use gumption_files as file;
use gumption_files::Override;
use gumption_report as report;
use gumption_report::{EvaluationReport, Provenance};

/// Settings shared by all runs.
#[derive(Clone, Copy)]
pub(super) struct Machine<'a> {
    /// Number of threads; 0 for all.
    pub(super) threads: usize,
    pub(super) stop: &'a AtomicBool,
}

/// Whether a value comes from trials.
fn needs_trials(path: &str) -> bool {
    !path.starts_with("gum.")
}

/// Evaluates an example with the settings of its file, without trials if no published value needs
/// them.
pub(super) fn recompute(example: Example, machine: Machine<'_>) -> RecomputedExample {
    let mut trials = None;
    let (answer, failure) = match answer(&example, machine, &mut trials) {
        Ok(answer) => (answer, None),
        Err(message) => (Value::Null, Some(message)),
    };
    let Example { name, source, published, notes, .. } = example;
    let rows = published.into_iter().map(|published| judge(published, &answer)).collect();
    RecomputedExample { name, source, notes, trials, rows, failure }
}

/// The answer for programs, as `gumption run --format json` gives it.
fn answer(
    example: &Example,
    machine: Machine<'_>,
    trials: &mut Option<(Trials, u64)>,
) -> Result<Value, String> {
    let replacement = |text: &String| {
        Override::parse(text).ok_or_else(|| format!("`{text}` is not a replacement of an input"))
    };
    let overrides = example.set.iter().map(replacement).collect::<Result<Vec<_>, String>>()?;
    let file = file::read_text(&example.name, example.model, Path::new(""), &overrides)
        .map_err(|diagnostics| diagnostics.to_string())?;
    let mut task = file.task;
    if example.published.iter().any(|published| needs_trials(&published.path)) {
        *trials = Some((task.settings.trials, task.settings.seed));
    } else {
        task.settings.trials = Trials::Fixed(0);
    }
    let Machine { threads, stop } = machine;
    let control = Control::default().with_threads(threads).with_stop(stop);
    let evaluation = evaluate(&task, &control).map_err(|error| error.to_string())?;
    let provenance = Provenance::default();
    let report = EvaluationReport {
        task: &task,
        evaluation: &evaluation,
        warnings: &[],
        provenance: &provenance,
    };
    serde_json::from_str(&report::json(&report)).map_err(|error| error.to_string())
}

fn judge(published: PublishedValue, answer: &Value) -> RecomputedValue {
    let root = match &published.output {
        Some(output) => answer.get("outputs").and_then(|outputs| outputs.get(output)),
        None => Some(answer),
    };
    let got = root.and_then(|root| dig(root, &published.path)).and_then(Value::as_f64);
    let words = report::verification::words(&published.path, answer);
    RecomputedValue::new(published, words, got)
}

/// The value at a path such as `gum.interval[0]`.
fn dig<'v>(root: &'v Value, path: &str) -> Option<&'v Value> {
    path.split(['.', '[', ']']).filter(|step| !step.is_empty()).try_fold(root, |value, step| {
        match value {
            Value::Array(list) => list.get(step.parse::<usize>().ok()?),
            _ => value.get(step),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_analysis::verification::PublishedVerdict;

    fn published(path: &str, value: f64, tolerance: f64) -> PublishedValue {
        let (path, why) = (path.to_owned(), String::new());
        PublishedValue { output: Some("y".into()), path, value, tolerance, why }
    }

    #[test]
    fn verdicts() {
        let answer = serde_json::json!(
            {"outputs": {"y": {"gum": {"estimate": 1.25, "dof": null, "interval": [1.0, 1.5]}}}}
        );
        let verdict = |p: PublishedValue| judge(p, &answer).verdict;
        assert_eq!(verdict(published("gum.estimate", 1.0, 0.25)), PublishedVerdict::Pass);
        assert_eq!(verdict(published("gum.estimate", 1.0, 0.24)), PublishedVerdict::Diff);
        assert_eq!(verdict(published("gum.interval[1]", 1.5, 0.0)), PublishedVerdict::Pass);
        assert_eq!(verdict(published("gum.interval[2]", 1.5, 9.0)), PublishedVerdict::Diff);
        assert_eq!(verdict(published("gum.dof", 1.0, 9.0)), PublishedVerdict::Diff);
        assert_eq!(verdict(published("monte_carlo.estimate", 1.0, 9.0)), PublishedVerdict::Diff);
    }

    /// An example that this program cannot read is a difference with its reason, not a failure.
    #[test]
    fn what_cannot_be_evaluated_is_a_difference() {
        let example = Example {
            name: "x".into(),
            model: r#"{"inputs": {}, "outputs": {}}"#,
            set: Vec::new(),
            source: String::new(),
            published: vec![published("gum.estimate", 1.0, 1.0)],
            notes: String::new(),
        };
        let stop = AtomicBool::new(false);
        let found = recompute(example, Machine { threads: 1, stop: &stop });
        assert_eq!(found.rows[0].verdict, PublishedVerdict::Diff);
        assert_eq!(found.rows[0].got, None);
        assert!(found.failure.unwrap().contains("equations"));
    }
}
