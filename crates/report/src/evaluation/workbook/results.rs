//! The worksheet of the results: a line for each output in each row of conditions.

use rust_xlsxwriter::XlsxError;

use super::budget::Totals;
use crate::number::{place_of_ends, position};
use crate::workbook::{Cached, Leaf, Look};
use crate::{EvaluationReport, plain, table};
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::Dof;

const HEADERS: [&str; 20] = [
    "output",
    "unit",
    "estimate",
    "standard uncertainty",
    "dof",
    "coverage factor",
    "expanded uncertainty",
    "GUM interval, from",
    "GUM interval, to",
    "Monte Carlo trials",
    "Monte Carlo estimate",
    "Monte Carlo standard uncertainty",
    "median",
    "symmetric interval, from",
    "symmetric interval, to",
    "shortest interval, from",
    "shortest interval, to",
    "clause 8: GUM interval",
    "probability of conformity",
    "numerical standard error of it",
];

/// Writes the results; GUM figures as formulas where `totals` has their cells.
pub(super) fn write(
    leaf: &mut Leaf,
    report: &EvaluationReport<'_>,
    totals: &[Totals],
) -> Result<(), XlsxError> {
    let EvaluationReport { task, evaluation, .. } = *report;
    leaf.title(0, &plain(&task.title))?;
    leaf.line(1, &table::settings_text(evaluation))?;
    let conditions: Vec<String> = task
        .model
        .conditions
        .iter()
        .filter(|_| task.swept)
        .map(|condition| format!("{} in {}", plain(&condition.name), plain(condition.unit.text())))
        .collect();
    leaf.headers(3, conditions.iter().map(String::as_str).chain(HEADERS))?;
    let first = conditions.len() as u16;
    let mut at = 4;
    for (number, row) in evaluation.rows.iter().enumerate() {
        for (output, (declared, found)) in task.model.outputs.iter().zip(&row.outputs).enumerate() {
            if task.swept {
                for (column, &value) in (0..first).zip(&row.conditions) {
                    leaf.number((at, column), value, None, Look::Plain)?;
                }
            }
            leaf.text(at, first, &plain(&declared.quantity.name))?;
            leaf.text(at, first + 1, &plain(declared.quantity.unit.text()))?;
            let cells = totals.get(output).and_then(|rows| rows.get(number)?.as_ref());
            figures(leaf, (at, first + 2), found, evaluation.settings.digits, cells)?;
            at += 1;
        }
    }
    if !totals.is_empty() {
        leaf.line(
            at + 1,
            "Figures of the GUM follow what is changed under Inputs; those of the Monte Carlo \
             method are of the inputs as evaluated.",
        )?;
    } else {
        leaf.line(
            at + 1,
            "There are too many budgets for a workbook; all of them: --format json.",
        )?;
    }
    leaf.freeze(4)
}

fn figures(
    leaf: &mut Leaf,
    (at, first): (u32, u16),
    found: &OutputEvaluation,
    digits: u32,
    cells: Option<&[String; 7]>,
) -> Result<(), XlsxError> {
    if let Some(gum) = &found.gum {
        let own = position(gum.standard_uncertainty, digits);
        let expanded = gum.expanded_uncertainty();
        let interval = gum.interval();
        let dof = match gum.dof {
            Dof::Finite(dof) => Cached::Number(dof),
            Dof::Infinite => Cached::Text("∞".to_owned()),
            Dof::Undefined => Cached::Text("undefined".to_owned()),
        };
        let number = |value: Option<f64>| Cached::Number(value.unwrap_or(f64::NAN));
        let values = [
            (number(Some(gum.estimate)), own),
            (number(Some(gum.standard_uncertainty)), own),
            (dof, None),
            (number(gum.coverage_factor), Some(-2)),
            (number(expanded), expanded.and_then(|expanded| position(expanded, digits))),
            (number(interval.map(|ends| ends[0])), own),
            (number(interval.map(|ends| ends[1])), own),
        ];
        for (figure, (column, (value, shown))) in (first..).zip(values).enumerate() {
            let cell = cells.and_then(|cells| cells.get(figure));
            match (cell, value) {
                (Some(cell), value) => {
                    leaf.formula((at, column), cell, &value, shown, Look::Plain)?;
                }
                (None, Cached::Number(value)) => {
                    leaf.number((at, column), value, shown, Look::Plain)?;
                }
                (None, Cached::Text(text)) => leaf.word((at, column), &text, Look::Plain)?,
            }
        }
    }
    let Some(figures) = &found.monte_carlo else { return Ok(()) };
    let own = figures.standard_uncertainty.and_then(|u| position(u, digits));
    let ends = place_of_ends(figures, figures.standard_uncertainty, digits);
    let values = [
        (Some(figures.trials as f64), Some(0)),
        (figures.estimate, own),
        (figures.standard_uncertainty, own),
        (Some(figures.median), ends),
        (Some(figures.symmetric_interval[0]), ends),
        (Some(figures.symmetric_interval[1]), ends),
        (Some(figures.shortest_interval[0]), ends),
        (Some(figures.shortest_interval[1]), ends),
    ];
    for (column, (value, shown)) in (first + 7..).zip(values) {
        leaf.number((at, column), value.unwrap_or(f64::NAN), shown, Look::Plain)?;
    }
    let verdict = match found.validation.map(|validation| validation.gum_valid) {
        Some(Some(true)) => "valid",
        Some(Some(false)) => "not valid",
        Some(None) => "undecided",
        None => "-",
    };
    leaf.text(at, first + 15, verdict)?;
    if let Some(conformity) = &found.conformity {
        leaf.number((at, first + 16), conformity.probability, Some(-6), Look::Plain)?;
        let error = conformity.numerical_standard_error;
        leaf.number((at, first + 17), error, position(error, 1), Look::Plain)?;
    }
    Ok(())
}
