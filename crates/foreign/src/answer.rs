//! The JSON answer of `gumption run`, from which results are taken for a comparison.

use std::path::Path;

use serde_json::{Map, Value};

use gumption_analysis::compare::StatedResult;
use gumption_engine::number::Shortest;
use gumption_files::open::{FileKind, no_table};
use gumption_text::{Collector, DiagnosticKind, Place, SourceText, bytes};
use gumption_units::listed;

/// An answer: its rows of conditions with their outputs.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) name: String,
    /// The units of the conditions, by their names; answers of earlier versions do not say them.
    units: Map<String, Value>,
    rows: Vec<(Map<String, Value>, Map<String, Value>)>,
}

/// Conditions agree to this share.
const SAME: f64 = 1e-9;

/// Reads an answer; mistakes are reported.
pub(super) fn read(log: &Collector, path: &Path) -> Option<Answer> {
    let name = path.display().to_string();
    let report = |text: &str, diagnostic: DiagnosticKind| {
        log.report_at(
            Place { source: SourceText::new(name.clone(), text), span: 0..0 },
            diagnostic,
        );
    };
    let bytes = bytes::of_file(path, bytes::MOST)
        .map_err(|message| report("", DiagnosticKind::Unreadable { message }))
        .ok()?;
    let answer: Value = serde_json::from_slice(&bytes)
        .map_err(|error| report("", DiagnosticKind::NotJson { message: error.to_string() }))
        .ok()?;
    if let Some((place, kind)) = of_another_kind(&name, &bytes) {
        log.report_at(place, kind);
        return None;
    }
    let object = |value: Option<&Value>| value.and_then(Value::as_object).cloned();
    let rows = match answer.get("rows").and_then(Value::as_array) {
        Some(rows) => rows
            .iter()
            .map(|row| Some((object(row.get("conditions"))?, object(row.get("outputs"))?)))
            .collect(),
        None => object(answer.get("outputs")).map(|outputs| vec![(Map::new(), outputs)]),
    };
    if rows.is_none() {
        let of_certificate = ["gumption", "rows", "correlations"];
        let what = match of_certificate.iter().all(|key| answer.get(*key).is_some()) {
            true => "this is the JSON answer of a certificate, and not",
            false => "this is not",
        };
        let reason = format!("{what} that of an evaluation (`gumption run --format json`)");
        report("", DiagnosticKind::Table { reason });
    }
    let units = object(answer.get("condition_units")).unwrap_or_default();
    Some(Answer { name, units, rows: rows? })
}

/// What a JSON file is that is no answer of a run, where its keys tell.
fn of_another_kind(name: &str, bytes: &[u8]) -> Option<(Place, DiagnosticKind)> {
    let source = SourceText::new(name, &bytes::text(bytes).ok()?);
    let (span, kind) = no_table(&source)?;
    let is_answer = kind == FileKind::Answer.described();
    // a file of an unknown kind is told as such below
    let is_known = matches!(kind, DiagnosticKind::WrongFile { .. });
    (is_known && !is_answer).then(|| (Place { source: source.clone(), span }, kind))
}

impl Answer {
    /// The names of the conditions.
    pub(super) fn conditions(&self) -> Vec<&str> {
        let first = self.rows.first();
        first
            .map(|(conditions, _)| conditions.keys().map(String::as_str).collect())
            .unwrap_or_default()
    }

    /// The unit of a condition, where the answer says it.
    pub(super) fn unit_of(&self, condition: &str) -> Option<&str> {
        self.units.get(condition)?.as_str()
    }

    /// Values of conditions in the units of the run.
    fn shown(&self, at: &[(&str, f64)]) -> String {
        let shown = |(name, value): &(&str, f64)| {
            let unit = self.unit_of(name).filter(|unit| !matches!(*unit, "" | "1"));
            let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
            format!("{name} = {}{unit}", Shortest(*value))
        };
        match at {
            [] => "results".to_owned(),
            at => listed(&at.iter().map(shown).collect::<Vec<_>>(), " and "),
        }
    }

    /// The result of an output at some conditions, with its unit: that of the GUM, or that of the trials
    /// where it has none.
    pub(super) fn result(
        &self,
        output: &str,
        at: &[(&str, f64)],
    ) -> Result<(StatedResult, &str), String> {
        let near = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
        let mut rows = self.rows.iter().filter(|(conditions, _)| {
            at.iter().all(|(name, value)| {
                conditions.get(*name).and_then(Value::as_f64).is_some_and(|own| near(own, *value))
            })
        });
        let name = &self.name;
        let outputs = match (rows.next(), rows.next()) {
            (Some((_, outputs)), None) => outputs,
            (None, _) => return Err(format!("no row of `{name}` has {}", self.shown(at))),
            (Some(_), Some(_)) => {
                return Err(format!(
                    "several rows of `{name}` have these conditions; the table needs a column for each \
                     condition, one of {}",
                    self.conditions().join(", ")
                ));
            }
        };
        let Some(found) = outputs.get(output) else {
            let known: Vec<&str> = outputs.keys().map(String::as_str).collect();
            return Err(format!(
                "`{name}` has no output `{output}`; the label names the output, one of {}",
                known.join(", ")
            ));
        };
        let unit = found.get("unit").and_then(Value::as_str).unwrap_or("1");
        of_gum(found)
            .or_else(|| of_trials(found))
            .map(|stated| (stated, unit))
            .filter(|(stated, _)| {
                stated.value.is_finite() && stated.expanded >= 0.0 && stated.factor > 0.0
            })
            .ok_or_else(|| format!("the output `{output}` of `{name}` has no expanded uncertainty"))
    }
}

fn of_gum(output: &Value) -> Option<StatedResult> {
    let number = |key: &str| output.get("gum")?.get(key)?.as_f64();
    let (value, expanded) = (number("estimate")?, number("expanded_uncertainty")?);
    Some(StatedResult::new(value, expanded, number("coverage_factor")?))
}

/// The factor is 2: expanded is 2 u.
fn of_trials(output: &Value) -> Option<StatedResult> {
    let number = |key: &str| output.get("monte_carlo")?.get(key)?.as_f64();
    let (value, u) = (number("estimate")?, number("standard_uncertainty")?);
    Some(StatedResult::new(value, 2.0 * u, 2.0))
}
