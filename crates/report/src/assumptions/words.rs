//! The sentences of an audit.

use super::AuditReport;
use crate::number::{coarser, position, rounded, significant, to};
use crate::table::in_unit;
use crate::{conditions_text, grouped, plain};
use gumption_assumptions::{
    EvidenceOffset, EvidenceTest, EvidenceVerdict, InputAudit, OutputAudit,
};
use gumption_engine::number::largest_first;

pub(super) const MOVES: &str = "Changes are those of half the length of the coverage interval, \
    relative to the stated assumptions, from the same random numbers; a change below 0.05 % or \
    within twice its numerical standard error is none seen. Allowed is how far the width may be wrong until that \
    length moves by more than the limit.";

pub(super) const SHAPES: &str = "Kept is the standard uncertainty u (of a t its scale) or the limits \
    (of a normal distribution or t two standard deviations about the mean).";

pub(super) const SOBOL: &str = "Sobol indices (Jansen's estimators) are shares of the variance: \
    first-order what an input does by itself, total with all that it does together with others. \
    Their numerical standard errors are some units of the last digit. Where they depart by more from \
    the share of the linear budget, the model is not linear, or few degrees of freedom make what is drawn for an input wider than its standard uncertainty.";

pub(super) const EVIDENCE: &str = "The p-value (Anderson-Darling) is that of the stated distribution \
    as it stands, centre and width. Supported is the width of that shape about the stated centre. \
    Too narrow: a reading outside the limits, or the whole 95 % interval above the stated width. Too \
    wide: the interval at 99 % below it. Wrong shape: a p-value below 0.01. Fewer than five readings \
    tell nothing.";

pub(super) fn title(report: &AuditReport<'_>) -> String {
    let title = plain(&report.task.title);
    if title.is_empty() { "Type B assumptions".to_owned() } else { title }
}

pub(super) fn settings(report: &AuditReport<'_>) -> String {
    let audit = report.audit;
    format!(
        "Type B assumptions; {} trials of each variant, seed {}, coverage probability {} %, limit \
         {} %",
        grouped(audit.question.trials),
        report.task.settings.seed,
        percent(audit.coverage_probability),
        percent(audit.question.allowed)
    )
}

pub(super) fn percent(share: f64) -> String {
    let text = rounded(100.0 * share, -2);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The output with its row of conditions.
pub(super) fn heading(report: &AuditReport<'_>, row: usize, output: usize) -> String {
    let name = report.task.model.outputs.get(output).map_or("", |o| o.quantity.name.as_str());
    let conditions = report.audit.rows.get(row).map_or(&[][..], |row| &row.conditions);
    if !report.task.swept {
        return plain(name);
    }
    format!("{} at {}", plain(name), conditions_text(&report.task.model.conditions, conditions))
}

/// The figures with everything as stated.
pub(super) fn baseline(report: &AuditReport<'_>, output: usize, of: &OutputAudit) -> String {
    let unit = report.task.model.outputs.get(output).map(|o| &o.quantity.unit);
    let with_unit = |value: &str| unit.map_or_else(|| value.to_owned(), |u| in_unit(value, u));
    let [low, high] = of.baseline.symmetric_interval;
    let u = of.baseline.standard_uncertainty;
    let digits = u.and_then(|u| position(u, 2)).or(coarser(position(high - low, 3), None));
    let p = percent(report.audit.coverage_probability);
    let high = with_unit(&to(high, digits));
    let interval = format!("{p} % interval {} to {high}", to(low, digits));
    match u {
        Some(u) => {
            let u = with_unit(&to(u, position(u, 2)));
            format!("As stated: u = {u}, {interval}.")
        }
        None => format!("As stated: no standard uncertainty, {interval}."),
    }
}

/// Which shapes matter.
pub(super) fn verdict(report: &AuditReport<'_>, of: &OutputAudit) -> String {
    let limit = report.audit.question.allowed;
    let mut matter: Vec<(&InputAudit, f64)> = of
        .inputs
        .iter()
        .filter_map(|input| Some((input, input.largest_change()?)))
        .filter(|(_, change)| change.abs() > limit)
        .collect();
    largest_first(&mut matter, |a| a.1.abs());
    let asked = of.inputs.iter().any(|input| !input.alternatives.is_empty());
    let limit = percent(limit);
    if !asked {
        return "No input has a shape that was assumed.".to_owned();
    }
    if matter.is_empty() {
        return format!(
            "No assumed shape matters: none moves the interval by more than {limit} %."
        );
    }
    let names: Vec<String> = matter
        .iter()
        .map(|(input, change)| {
            let name = plain(report.name(input.variable));
            let sign = if *change > 0.0 { "+" } else { "" };
            format!(
                "{name} ({}, {sign}{} %)",
                input.distribution.name(),
                rounded(100.0 * change, -1)
            )
        })
        .collect();
    format!("Shapes that matter, by more than {limit} %: {}.", names.join(", "))
}

/// The readings that speak against an assumption.
pub(super) fn contradicted(report: &AuditReport<'_>) -> Option<String> {
    let against =
        report.audit.evidence.iter().filter(|of| {
            !matches!(of.verdict, EvidenceVerdict::Consistent | EvidenceVerdict::TooFew)
        });
    let said: Vec<String> = against
        .map(|of| format!("{} is {}", plain(report.name(of.variable)), of.verdict.words()))
        .collect();
    (!said.is_empty()).then(|| format!("The readings contradict: {}.", said.join(", ")))
}

/// Where the readings lie together off the stated centre: a sentence for each input.
pub(super) fn offsets(report: &AuditReport<'_>) -> Vec<String> {
    let offsets = report.audit.evidence.iter();
    offsets.filter_map(|of| Some(offset(report, of, of.offset?))).collect()
}

fn offset(report: &AuditReport<'_>, of: &EvidenceTest, offset: EvidenceOffset) -> String {
    let variable = report.task.variables.get(of.variable);
    let unit = variable.map_or("", |variable| variable.unit.text());
    let unit = if matches!(unit, "" | "1") { String::new() } else { format!(" {}", plain(unit)) };
    let name = plain(report.name(of.variable));
    let digits = position(offset.standard_error, 2).or(position(offset.difference(), 3));
    let [mean, off] = [offset.mean, offset.difference().abs()].map(|value| to(value, digits));
    format!(
        "The {} readings of {name} lie together, off the stated centre: their mean is {mean}{unit}, \
         their standard deviation {}{unit}. The mean is off by {off}{unit}, more than their scatter \
         makes (t test, {} %). That is an offset to be corrected (JCGM 100, 3.2.4), no width and no \
         shape: correct it, and state what is left.",
        of.readings,
        significant(offset.standard_deviation, 2),
        percent(EvidenceOffset::LEVEL),
    )
}
