//! The answer to a model that is being edited: its errors, or its results.

use gumption_report::{plain, words};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption_engine::model::formula::Formula;
use gumption_engine::propagate::{
    Control, Evaluation, convergence, evaluate, histograms, warnings,
};
use gumption_engine::task::{MethodChoice, StatementMethod, Task, Trials};
use gumption_files::{CaseFile, FileReader, ModelFile, TextKind};
use gumption_foreign::{ComparisonOptions, read_comparison_text};
use gumption_report::{EvaluationReport, FigureSize, PageChoice, Provenance, Shown, page_parts};
use gumption_text::{Diagnostics, FileSource};
use jsonc_parser::ast::Value;
use serde::Deserialize;
use serde_json::{Value as Json, json};
use std::path::Path;

use crate::edit::Edit;
use crate::quantity::edited;
use crate::tree::{self, path_of};
use crate::{LiveError, certificate, diagnostics, inputs, limited, open, outputs, table};
use gumption_report::words::Language;

/// Maximum number of trials over all rows, up to which the page refines in the background. The
/// command line makes as many as a file requests.
const MOST_TRIALS: u64 = 100_000_000;

/// Rows of conditions that the page evaluates, at most.
const MOST_ROWS: usize = 10_000;

/// A request of the call `answer`.
#[derive(Debug, Deserialize)]
pub(crate) struct AnswerRequest {
    text: String,
    /// Changes that are applied to the text first; the answer contains the changed text.
    #[serde(default)]
    edits: Vec<Edit>,
    #[serde(default)]
    name: String,
    /// The number of trials over all rows, if fewer are made than the file requests.
    #[serde(default)]
    trials: Option<u64>,
    /// Whether the number of trials in the file is used.
    #[serde(default)]
    full: bool,
    /// Whether figures are drawn for a narrow column.
    #[serde(default)]
    narrow: bool,
    /// The output, counted from 0, whose parts of the page are wanted. All outputs if it is not
    /// given, the first one if it does not exist.
    #[serde(default)]
    output: Option<usize>,
    /// The row of conditions, counted from 0, for the parts; the first one if it does not exist.
    #[serde(default)]
    row: usize,
    /// What the last full answer stated of the outputs, `gum` or `monte-carlo`: until this one is full
    /// it states the same.
    #[serde(default)]
    stated: Option<String>,
    /// The language of messages: `de`, else English.
    #[serde(default)]
    lang: Language,
}

/// The contents of a text and its results.
pub(crate) fn answer(
    files: FileReader<'_>,
    folder: &dyn FileSource,
    asked: &AnswerRequest,
    stop: &Arc<AtomicBool>,
) -> Result<Json, LiveError> {
    let changed = match asked.edits.as_slice() {
        [] => None,
        edits => Some(edited(limited(&asked.text)?, edits).map_err(LiveError::Request)?),
    };
    let text = limited(changed.as_deref().unwrap_or(&asked.text))?;
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let name = if asked.name.is_empty() { "the model" } else { &asked.name };
    let kind = TextKind::of(text);
    let mut answer = json!({ "kind": kind.name(), "diagnostics": [] });
    if let Some(changed) = &changed {
        answer["text"] = json!(changed);
    }
    let root = tree::parse(bare).ok();
    let read = match kind {
        TextKind::Model => files.model_text(name, text, Path::new(""), &[]),
        // their pages evaluate them and report errors that only the evaluation finds
        other => {
            let found = checked(files, other, name, text);
            if let Err(found) = &found {
                answer["diagnostics"] = diagnostics::list(text, found);
            }
            answer["content"] = root.as_ref().map_or(Json::Null, |root| tree::content(bare, root));
            match (other, &root) {
                (TextKind::Certificate, Some(root)) => {
                    answer["models"] = certificate::models(files, root);
                    let lacking = certificate::lacking(root, &mut answer["diagnostics"]);
                    answer["lacking"] = json!(lacking);
                }
                // the model of a case has the fields of any model
                (TextKind::Case, Some(root)) => {
                    let case = found.as_ref().ok().and_then(Option::as_ref);
                    fields(&mut answer, bare, root, case.map(|file| &file.case.task));
                    answer["data"] = table::of_case(bare, root, folder);
                    // `data` shows the first ones; the page needs no million of them
                    let values = answer["content"].pointer_mut("/observations/values");
                    let values = values.and_then(Json::as_object_mut);
                    values
                        .into_iter()
                        .flat_map(|of| of.values_mut())
                        .for_each(|of| *of = Json::Null);
                }
                _ => {}
            }
            return Ok(answer);
        }
    };
    let file = match &read {
        Ok(file) => Some(file),
        Err(found) => {
            answer["diagnostics"] = diagnostics::list(text, found);
            None
        }
    };
    if let Some(root) = &root {
        fields(&mut answer, bare, root, file.map(|file| &file.task));
    }
    if let Some(file) = file {
        match results(file, asked, stop) {
            Ok(found) => merge(&mut answer, found),
            Err(found) => answer["diagnostics"] = diagnostics::list(text, &found),
        }
    }
    Ok(answer)
}

/// Adds the contents of a model, what it still lacks, and names that its equations use but nothing
/// defines.
fn fields(answer: &mut Json, text: &str, root: &Value<'_>, task: Option<&Task>) {
    merge(answer, stated(text, root, task));
    // names without a meaning need no search if there are none
    let missing = if task.is_some() { Vec::new() } else { missing(root) };
    if let Some(diagnostics) = answer["diagnostics"].as_array_mut() {
        let points = open::points(text, root, &missing, diagnostics);
        answer["open"] = points;
    }
    answer["missing"] = json!(missing);
}

/// The errors of a text that is not a model; the case if it is one.
fn checked(
    files: FileReader<'_>,
    kind: TextKind,
    name: &str,
    text: &str,
) -> Result<Option<CaseFile>, Diagnostics> {
    let folder = Path::new("");
    match kind {
        TextKind::Case => return files.case_text(name, text, folder).map(Some),
        TextKind::Certificate => files.certificate_text(name, text, folder).map(drop),
        TextKind::Comparison => {
            read_comparison_text(name, text, ComparisonOptions::default()).map(drop)
        }
        TextKind::Recipe | TextKind::Costs => files.check_text(name, text, folder).map(drop),
        _ => Ok(()),
    }?;
    Ok(None)
}

fn merge(into: &mut Json, from: Json) {
    if let (Some(into), Json::Object(from)) = (into.as_object_mut(), from) {
        into.extend(from);
    }
}

/// The contents of the file, as fields of the page.
fn stated(text: &str, root: &Value<'_>, task: Option<&Task>) -> Json {
    let scalar = |keys: &[&str]| {
        let found = keys.iter().try_fold(root, |value, key| tree::get(value, key));
        found.map_or(Json::Null, |value| json!(tree::raw(text, value)))
    };
    let equations = tree::get(root, "equations").and_then(Value::as_object);
    let equations: Vec<Json> = equations
        .map(|object| {
            let one = |member: &jsonc_parser::ast::ObjectProp<'_>| {
                let name = member.name.as_str();
                json!({
                    "name": name,
                    "formula": tree::raw(text, &member.value),
                    "path": path_of(["equations", name]),
                })
            };
            object.properties.iter().map(one).collect()
        })
        .unwrap_or_default();
    json!({
        "title": scalar(&["title"]),
        "source": scalar(&["source"]),
        "model": scalar(&["model"]),
        "equations": equations,
        "statement": task.map(|task| &task.statement).map(|of| {
            let lines = of.equations.iter();
            lines.map(|(name, formula)| json!([name, formula])).collect::<Vec<_>>()
        }),
        "inputs": inputs::rows(text, root, task),
        "conditions": inputs::conditions(text, root, task),
        "outputs": inputs::outputs(text, root),
        "correlations": inputs::correlations(text, root),
        "settings": {
            "coverage_probability": scalar(&["coverage_probability"]),
            "coverage_factor": scalar(&["coverage_factor"]),
            "trials": scalar(&["monte_carlo", "trials"]),
            "seed": scalar(&["monte_carlo", "seed"]),
            "digits": scalar(&["monte_carlo", "digits"]),
        },
    })
}

/// Names that equations use but nothing defines, in the order in which they occur.
fn missing(root: &Value<'_>) -> Vec<String> {
    let names_of = |key: &str| -> Vec<String> {
        let object = tree::get(root, key).and_then(Value::as_object);
        let names = object.into_iter().flat_map(|object| &object.properties);
        names.map(|member| member.name.as_str().to_owned()).collect()
    };
    let mut known: Vec<String> =
        ["inputs", "conditions", "fits"].iter().flat_map(|key| names_of(key)).collect();
    // a table of conditions names its columns by their units
    if let Some(units) = tree::get(root, "conditions").and_then(|of| tree::get(of, "units")) {
        let columns = units.as_object().into_iter().flat_map(|object| &object.properties);
        known.extend(columns.map(|member| member.name.as_str().to_owned()));
    }
    let mut missing: Vec<String> = Vec::new();
    let equations = tree::get(root, "equations").and_then(Value::as_object);
    for member in equations.into_iter().flat_map(|object| &object.properties) {
        let formula =
            member.value.as_string_lit().and_then(|text| Formula::parse(&text.value).ok());
        for (name, _) in formula.iter().flat_map(Formula::names) {
            let is_known = known.iter().any(|of| of == name);
            let is_name = gumption_engine::model::formula::check_name(name).is_ok();
            if !is_known && is_name && !missing.iter().any(|of| of == name) {
                missing.push(name.to_owned());
            }
        }
        known.push(member.name.as_str().to_owned());
    }
    missing
}

/// Applies the settings of this answer; returns whether they are those of the file.
fn settle(task: &mut Task, asked: &AnswerRequest) -> bool {
    let rows = (task.rows.len() as u64).max(1);
    let each = |all: u64| (all / rows).max(1000);
    let settings = &mut task.settings;
    if asked.full {
        let most = each(MOST_TRIALS);
        let before = *settings;
        settings.max_trials = settings.max_trials.min(most);
        settings.decide_up_to = settings.decide_up_to.min(MOST_TRIALS);
        if let Trials::Fixed(count) = settings.trials {
            settings.trials = Trials::Fixed(count.min(most));
        }
        return settings.trials == before.trials;
    }
    let few = each(asked.trials.unwrap_or(100_000).min(MOST_TRIALS));
    let count = match settings.trials {
        Trials::Fixed(count) => count.min(few),
        Trials::Adaptive => few,
    };
    if settings.statement == StatementMethod::Auto {
        let method = asked.stated.as_deref().and_then(StatementMethod::named);
        settings.statement = method.unwrap_or(StatementMethod::Auto);
    }
    // results without noise are computed when typing pauses
    settings.method = settings.method.map(|_| MethodChoice::MonteCarlo);
    let is_whole = settings.trials == Trials::Fixed(count)
        && settings.decide_up_to == 0
        && settings.method.is_none();
    settings.trials = Trials::Fixed(count);
    settings.decide_up_to = 0;
    is_whole
}

/// The evaluation and the parts of its page, or the errors that only the evaluation finds.
fn results(
    file: &ModelFile,
    asked: &AnswerRequest,
    stop: &Arc<AtomicBool>,
) -> Result<Json, Diagnostics> {
    let mut task = file.task.clone();
    let all_rows = task.rows.len();
    task.rows.truncate(MOST_ROWS);
    let is_whole = settle(&mut task, asked);
    let control = Control::default().with_stop(stop);
    let failed = |error: gumption_engine::propagate::EvaluationError| {
        file.evaluation_failed(error.to_string())
    };
    let evaluation = evaluate(&task, &control).map_err(failed)?;
    let row = if asked.row < evaluation.rows.len() { asked.row } else { 0 };
    let mut counts = vec![Vec::new(); evaluation.rows.len()];
    if !evaluation.stopped
        && let Some(place) = counts.get_mut(row)
    {
        let found = histograms(&task, &evaluation, row, &control).map_err(failed)?;
        place.extend(found.into_iter().flatten());
    }
    // when typing pauses: it takes as long as the run
    let settled = match asked.full && !evaluation.stopped {
        true => convergence(&task, &evaluation, row, &control).map_err(failed)?,
        false => None,
    };
    let settled = settled.unwrap_or_default();
    let mut notes = file.warnings.clone();
    notes.extend(warnings(&task, &evaluation));
    let provenance = Provenance::default();
    let report = EvaluationReport {
        task: &task,
        evaluation: &evaluation,
        warnings: &notes,
        provenance: &provenance,
    };
    let language = asked.lang;
    let shown = Shown { histograms: &counts, convergence: &settled, language, ..Shown::default() };
    let size = if asked.narrow { FigureSize::Narrow } else { FigureSize::Page };
    let outputs = task.model.outputs.len();
    let output = asked.output.map(|wanted| if wanted < outputs { wanted } else { 0 });
    let parts = crate::language::parts(
        page_parts(&report, &shown, size, PageChoice { output, row }),
        language,
    );
    let note = |warning| plain(&words::note_on_page(warning, language));
    Ok(json!({
        "results": outputs::results(&task, &evaluation, row, &parts),
        "together": parts.together,
        "notes": notes.iter().map(note).collect::<Vec<_>>(),
        "row": row,
        "row_names": parts.rows,
        "rows": all_rows,
        "rows_shown": task.rows.len(),
        "trials": made(&evaluation),
        "whole": is_whole && all_rows == task.rows.len(),
        "full": asked.full,
        "stopped": evaluation.stopped,
        "seed": task.settings.seed,
        "coverage_probability": evaluation.coverage_probability,
    }))
}

/// The trials of a row.
fn made(evaluation: &Evaluation) -> u64 {
    let outputs = evaluation.rows.iter().flat_map(|row| &row.outputs);
    outputs
        .filter_map(|output| output.monte_carlo.as_deref())
        .map(|of| of.trials)
        .max()
        .unwrap_or(0)
}
