//! The results of each output: values for the headline, and the parts of the report's page.

use gumption_engine::decimal::significant;
use gumption_engine::model::Output;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::{ConformityLevel, Evaluation, OutputEvaluation};
use gumption_engine::task::{Settings, Task};
use gumption_report::number::with_uncertainty;
use gumption_report::{OutputParts, PageParts, ResultStatement, plain};
use serde_json::{Value as Json, json};

/// One entry for each output in a row of conditions.
pub(crate) fn results(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    parts: &PageParts,
) -> Vec<Json> {
    let Some(row) = evaluation.rows.get(row) else { return Vec::new() };
    let all = task.model.outputs.iter().zip(&row.outputs).zip(&parts.outputs);
    all.map(|((output, found), parts)| result(&evaluation.settings, output, found, parts)).collect()
}

fn result(
    settings: &Settings,
    output: &Output,
    found: &OutputEvaluation,
    parts: &OutputParts,
) -> Json {
    let statement = match ResultStatement::of(settings, found) {
        ResultStatement::Expanded { estimate, expanded, factor } => {
            json!({ "kind": "expanded", "estimate": estimate, "expanded": expanded, "factor": factor })
        }
        ResultStatement::Interval { estimate, low, high, shortest } => json!({
            "kind": "interval", "estimate": estimate, "low": low, "high": high, "shortest": shortest,
            "uncertainty": drawn_uncertainty(settings, found),
        }),
        ResultStatement::Standard { estimate, uncertainty } => {
            json!({ "kind": "standard", "estimate": estimate, "uncertainty": uncertainty })
        }
        _ => json!({ "kind": "undefined" }),
    };
    let gum = found.gum.as_ref().map(|gum| {
        json!({
            "estimate": gum.estimate,
            "standard_uncertainty": gum.standard_uncertainty,
            "coverage_factor": gum.coverage_factor,
            "expanded_uncertainty": gum.expanded_uncertainty(),
            "dof": match gum.dof { Dof::Finite(dof) => Some(dof), _ => None },
        })
    });
    let clause_8 = found.validation.map(|validation| {
        json!({
            "valid": validation.gum_valid,
            "digits": validation.digits,
            "tolerance": significant(validation.tolerance, 1),
            "d_low": significant(validation.d_low, 2),
            "d_high": significant(validation.d_high, 2),
        })
    });
    let conformity = found.conformity.as_ref().map(|conformity| {
        json!({
            "conforms": conformity.conforms,
            "statement": conformity.level.map(ConformityLevel::name),
            "probability": conformity.probability,
        })
    });
    json!({
        "name": plain(&output.quantity.name),
        "unit": plain(output.quantity.unit.text()),
        "about": plain(&output.quantity.about),
        "title": parts.title,
        "statement": statement,
        "gum": gum,
        "clause_8": clause_8,
        "conformity": conformity,
        "html": {
            "verdict": parts.verdict,
            "budget": parts.budget,
            "conclusions": parts.conclusions,
            "comparison": parts.comparison,
            "distribution": parts.distribution,
        },
    })
}

/// The standard uncertainty of the trials, as a text; `None` where their distribution has none.
fn drawn_uncertainty(settings: &Settings, found: &OutputEvaluation) -> Option<String> {
    let figures = found.monte_carlo.as_deref()?;
    let u = figures.standard_uncertainty?;
    Some(with_uncertainty(figures.median, u, settings.digits_on_pages()).1)
}
