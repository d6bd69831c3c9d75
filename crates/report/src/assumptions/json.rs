//! The answer for programs.

use super::AuditReport;
use crate::answer::{list, object, pretty};
use gumption_assumptions::{
    EvidenceOffset, EvidenceTest, InputAudit, OutputAudit, RowAudit, Sobol, VariantChange,
    VariantFigures,
};
use serde_json::Value;

type Entries = Vec<(&'static str, Value)>;

/// The audit as JSON, keys in a fixed order; `null` stands for what is infinite or not defined. It
/// ends in a newline.
pub fn json(report: &AuditReport<'_>) -> String {
    let AuditReport { task, audit, .. } = report;
    let mut entries = vec![
        ("gumption", Value::from(env!("CARGO_PKG_VERSION"))),
        ("title", task.title.as_str().into()),
        ("coverage_probability", audit.coverage_probability.into()),
        ("allowed", audit.question.allowed.into()),
    ];
    if task.swept {
        let names = || task.model.conditions.iter().map(|condition| condition.name.as_str());
        let rows = audit.rows.iter().map(|row| {
            let values = row.conditions.iter().map(|value| Value::from(*value));
            object([("conditions", object(names().zip(values))), ("outputs", outputs(report, row))])
        });
        entries.push(("rows", list(rows)));
    } else {
        entries.extend(audit.rows.iter().map(|row| ("outputs", outputs(report, row))));
    }
    entries.push(("evidence", list(audit.evidence.iter().map(|of| agreement(report, of)))));
    entries.push(("warnings", crate::words::listed(report.warnings)));
    let files = report.provenance.files.iter();
    let files = files.map(|(name, digest)| (name.as_str(), Value::from(digest.as_str())));
    let provenance = object([
        ("model_sha256", Value::from(report.provenance.model_sha256.as_str())),
        ("seed", task.settings.seed.into()),
        ("trials", audit.question.trials.into()),
        ("files", object(files)),
    ]);
    entries.push(("provenance", provenance));
    pretty(&object(entries))
}

fn outputs(report: &AuditReport<'_>, row: &RowAudit) -> Value {
    let outputs = report.task.model.outputs.iter().zip(&row.outputs);
    object(outputs.map(|(output, of)| {
        let unit = output.quantity.unit.text();
        (output.quantity.name.as_str(), output_tree(report, unit, of))
    }))
}

fn output_tree(report: &AuditReport<'_>, unit: &str, output: &OutputAudit) -> Value {
    let mut entries = vec![
        ("unit", Value::from(unit)),
        ("baseline", object(figures(Some(&output.baseline)))),
        ("inputs", list(output.inputs.iter().map(|input| input_tree(report, input)))),
    ];
    if !output.sets.is_empty() {
        let sets = output.sets.iter().map(|(set, sobol)| {
            let names = set.iter().map(|&variable| report.name(variable));
            let mut entries = vec![("inputs", list(names))];
            entries.extend(indices(sobol.as_ref()));
            object(entries)
        });
        entries.push(("drawn_together", list(sets)));
    }
    object(entries)
}

fn figures(of: Option<&VariantFigures>) -> Entries {
    vec![
        ("standard_uncertainty", of.and_then(|of| of.standard_uncertainty).into()),
        ("symmetric_interval", of.map(|of| of.symmetric_interval).into()),
    ]
}

fn moved(of: &VariantChange) -> Entries {
    let mut entries = figures(of.figures.as_ref());
    entries.push(("change_of_half_length", of.change.into()));
    entries.push(("numerical_standard_error", of.error.into()));
    entries
}

/// The larger of both standard errors, then both.
fn indices(sobol: Option<&Sobol>) -> Entries {
    let errors = sobol.map(|sobol| sobol.standard_error);
    vec![
        ("sobol_first", sobol.map(|sobol| sobol.first).into()),
        ("sobol_total", sobol.map(|sobol| sobol.total).into()),
        ("sobol_standard_error", errors.map(|[first, total]| first.max(total)).into()),
        ("sobol_standard_errors", errors.into()),
    ]
}

fn input_tree(report: &AuditReport<'_>, input: &InputAudit) -> Value {
    let variable = report.task.variables.get(input.variable);
    let alternatives = input.alternatives.iter().map(|other| {
        let mut entries = vec![
            ("distribution", Value::from(other.distribution.name())),
            ("kept", other.kept.name().into()),
        ];
        entries.extend(moved(&other.moved));
        object(entries)
    });
    let mut entries = vec![
        ("input", Value::from(report.name(input.variable))),
        ("distribution", input.distribution.name().into()),
        ("type", variable.map_or("B", |variable| variable.evaluation.letter()).into()),
        ("share", input.share.into()),
    ];
    entries.extend(indices(input.sobol.as_ref()));
    entries.push(("alternatives", list(alternatives)));
    let widths =
        [("removed", &input.removed), ("halved", &input.halved), ("doubled", &input.doubled)];
    for (key, width) in widths {
        entries.push((key, width.as_ref().map_or(Value::Null, |of| object(moved(of)))));
    }
    entries.push(("allowed_change", input.allowed.into()));
    object(entries)
}

fn offset(of: &EvidenceOffset) -> Value {
    object([
        ("mean", Value::from(of.mean)),
        ("stated", of.stated.into()),
        ("difference", of.difference().into()),
        ("standard_deviation", of.standard_deviation.into()),
        ("standard_error", of.standard_error.into()),
        ("level", EvidenceOffset::LEVEL.into()),
    ])
}

fn agreement(report: &AuditReport<'_>, of: &EvidenceTest) -> Value {
    let unit = report.task.variables.get(of.variable).map_or("", |v| v.unit.text());
    let supported = object([
        ("parameter", Value::from(of.supported.parameter)),
        ("stated", of.supported.stated.into()),
        ("estimate", of.supported.estimate.into()),
        ("interval", of.supported.interval.into()),
    ]);
    object([
        ("input", Value::from(report.name(of.variable))),
        ("unit", unit.into()),
        ("readings", (of.readings as u64).into()),
        ("outside", (of.outside as u64).into()),
        ("p_value", of.p_value.into()),
        ("supported", supported),
        ("verdict", of.verdict.words().into()),
        ("offset", of.offset.as_ref().map_or(Value::Null, offset)),
    ])
}
