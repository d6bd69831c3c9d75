//! The sentences of an audit.

use super::AuditReport;
use crate::number::{coarser, position, rounded, significant, to};
use crate::{conditions_text, grouped, plain};
use gumption_assumptions::{
    Alternative, EvidenceOffset, EvidenceTest, EvidenceVerdict, InputAudit, Kept, OutputAudit,
};
use gumption_engine::number::largest_first;

pub(super) const MOVES: &str = "Changes are relative changes of the half-length of the coverage \
    interval, with the same random numbers as for the stated assumptions. Changes below 0.05 % or \
    within twice their numerical standard error are shown as \"none\". \"Allowed\" is how wrong \
    the width may be before the half-length changes by more than the limit.";

pub(super) const SHAPES: &str = "Either the standard uncertainty u (for t, its scale) or the \
    limits are kept. The limits of a normal distribution or t are two standard deviations about \
    the mean.";

pub(super) const SOBOL: &str = "Sobol indices (Jansen's estimators) are shares of the variance: \
    the first-order index for an input alone, the total index with all its interactions. Their \
    numerical standard errors are some units of the last digit. If they differ by more from the \
    share of the linear budget, there are two possible causes: the model is not linear, or the t \
    distribution of an input is wider than its standard uncertainty.";

pub(super) const EVIDENCE: &str = "The p-value (Anderson-Darling) tests the stated distribution \
    with its centre and width. \"Supported\" is the width that the readings give for this shape \
    about the stated centre. Too narrow: a reading is outside the limits, or the whole 95 % \
    interval is above the stated width. Too wide: the 99 % interval is below it. Wrong shape: the \
    p-value is below 0.01. Fewer than five readings are too few for a test.";

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
    let unit = report.task.model.outputs.get(output).map_or("", |o| o.quantity.unit.text());
    let unit = if matches!(unit.trim(), "" | "1") { String::new() } else { format!(" {unit}") };
    let [low, high] = of.baseline.symmetric_interval;
    let u = of.baseline.standard_uncertainty;
    let digits = u.and_then(|u| position(u, 2)).or(coarser(position(high - low, 3), None));
    let p = percent(report.audit.coverage_probability);
    let interval = format!("{p} % interval {} to {}{unit}", to(low, digits), to(high, digits));
    match u {
        Some(u) => format!("As stated: u = {}{unit}, {interval}.", to(u, position(u, 2))),
        None => format!("As stated: no standard uncertainty, {interval}."),
    }
}

/// Which shapes matter.
pub(super) fn verdict(report: &AuditReport<'_>, of: &OutputAudit) -> String {
    let limit = report.audit.question.allowed;
    let change = |other: &Alternative| other.moved.change.unwrap_or(0.0);
    let mut matter: Vec<(&InputAudit, &Alternative)> = of
        .inputs
        .iter()
        .filter_map(|input| Some((input, input.most_different()?)))
        .filter(|(_, other)| change(other).abs() > limit)
        .collect();
    largest_first(&mut matter, |(_, other)| change(other).abs());
    let asked = of.inputs.iter().any(|input| !input.alternatives.is_empty());
    let limit = percent(limit);
    if !asked {
        return "No input has an assumed shape.".to_owned();
    }
    if matter.is_empty() {
        return format!("No assumed shape matters: none changes U by more than {limit} %.");
    }
    let sentence = |(input, other): &(&InputAudit, &Alternative)| {
        let sign = if change(other) > 0.0 { "+" } else { "" };
        let kept = match other.kept {
            Kept::StandardUncertainty => "u",
            Kept::Limits => "limits",
        };
        format!(
            "The shape of {} matters: another shape ({} with the same {kept}) changes U by \
             {sign}{} %.",
            plain(report.name(input.variable)),
            other.distribution.name(),
            rounded(100.0 * change(other), -1)
        )
    };
    matter.iter().map(sentence).collect::<Vec<_>>().join(" ")
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
        "The {} readings of {name} agree with each other, but not with the stated centre: their \
         mean is {mean}{unit}, their standard deviation {}{unit}. The mean differs from the \
         centre by {off}{unit}, more than their scatter explains (t test, {} %). Correct this \
         offset (JCGM 100, 3.2.4), and state the remaining uncertainty.",
        of.readings,
        significant(offset.standard_deviation, 2),
        percent(EvidenceOffset::LEVEL),
    )
}
