//! The effect of the Type B assumptions of a model.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gumption_assumptions::{Question, audit};
use gumption_engine::propagate::Control;
use gumption_files::{FileReader, TextKind};
use gumption_report::Provenance;
use gumption_report::assumptions::{AuditReport, fragment};
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::german::RowNames;
use crate::language;
use crate::{LiveError, diagnostics, limited};
use gumption_report::words::Language;

/// A request of the call `audit`.
#[derive(Debug, Deserialize)]
pub(crate) struct AuditRequest {
    text: String,
    #[serde(default)]
    name: String,
    /// As of the call `answer`.
    #[serde(default)]
    lang: Language,
}

/// Number of trials of each variant: a page that follows the typing shows which assumptions matter,
/// not the third digit.
const TRIALS: u64 = 20_000;

/// The allowed relative change of the expanded uncertainty.
const ALLOWED: f64 = 0.05;

/// Maximum number of variables and of rows for an automatic audit.
const MOST: usize = 60;

/// The audit as a part of the page; `null` if there is none.
pub(crate) fn audited(
    files: FileReader<'_>,
    asked: &AuditRequest,
    stop: &Arc<AtomicBool>,
) -> Result<Json, LiveError> {
    let text = limited(&asked.text)?;
    if TextKind::of(text) != TextKind::Model {
        return Ok(json!({ "html": null }));
    }
    let file = match files.model_text(&asked.name, text, Path::new(""), &[]) {
        Ok(file) => file,
        Err(found) => return Ok(json!({ "diagnostics": diagnostics::list(text, &found) })),
    };
    let task = &file.task;
    if task.variables.len().saturating_mul(task.rows.len()) > MOST {
        return Ok(json!({ "html": null, "large": true }));
    }
    let question = Question { trials: TRIALS, allowed: ALLOWED };
    let control = Control::default().with_stop(stop);
    let found = match audit(task, &file.evidence, question, &control) {
        Ok(found) => found.filter(|_| !stop.load(Ordering::Relaxed)),
        Err(error) => {
            let found = file.evaluation_failed(error.to_string());
            return Ok(json!({ "diagnostics": diagnostics::list(text, &found) }));
        }
    };
    let Some(found) = found else { return Ok(json!({ "html": null, "stopped": true })) };
    let provenance = Provenance::default();
    let report = AuditReport { task, audit: &found, warnings: &[], provenance: &provenance };
    Ok(
        json!({ "html": language::part(fragment(&report, asked.lang), RowNames::OfFile, asked.lang) }),
    )
}
