//! The sentences of a plan.

use super::PlanReport;
use super::sheets::{DIGITS, at_most};
use crate::number::{exact, rounded, significant};
use crate::plain;
use crate::printed::grouped;
use crate::table::unit_text;
use crate::table::{conditions_text, in_unit, row_numbers};
use gumption_analysis::plan::{
    Costs, DriftLaw, Excess, Improvement, PlanCheck, PlanTarget, PlannedInterval,
};
use gumption_engine::decimal::to_digits;
use gumption_engine::model::Quantity;
use gumption_engine::task::Task;

pub(super) const EQUAL: &str = "Without a file of costs, halving any standard uncertainty costs \
    1. Readings are priced so that quadrupling them, which halves u, also costs 1.";

pub(super) const ALONE: &str = "Required uncertainty of each quantity while all others are \
    unchanged, by the law of propagation. -: target not reached even with u = 0. Limits are \
    rounded down.";

pub(super) fn title(report: &PlanReport<'_>) -> String {
    let title = plain(&report.task.title);
    if title.is_empty() { "Plan".to_owned() } else { format!("Plan: {title}") }
}

fn value(output: Option<&Quantity>, text: &str) -> String {
    output.map_or_else(|| text.to_owned(), |output| in_unit(text, &output.unit))
}

fn name(report: &PlanReport<'_>) -> String {
    let output = report.output().map_or("", |output| output.name.as_str());
    format!("{}({})", report.kind(), plain(output))
}

/// The target for the uncertainty of an output: `8 uV`, `0.5 % of the estimate + 2 uV`.
pub fn wanted(target: &PlanTarget, output: Option<&Quantity>) -> String {
    let mut terms = Vec::new();
    if target.share > 0.0 {
        let percent = exact(to_digits(100.0 * target.share, 12));
        terms.push(format!("{percent} % of the estimate"));
    }
    if target.most > 0.0 {
        terms.push(value(output, &exact(target.most)));
    }
    terms.join(" + ")
}

/// The target, and the present value.
pub(super) fn target(report: &PlanReport<'_>) -> String {
    let plan = report.plan;
    let wanted = if plan.target.share > 0.0 {
        let limit = value(report.output(), &significant(plan.limit, DIGITS));
        format!("{limit} ({})", wanted(&plan.target, report.output()))
    } else {
        wanted(&plan.target, report.output())
    };
    let now = value(report.output(), &significant(plan.figure, DIGITS));
    let name = name(report);
    let mut said = format!("target {name} <= {wanted}; now {name} = {now}");
    if let Some(k) = plan.now.coverage_factor.filter(|_| plan.target.expanded) {
        said += &format!(" (k = {})", rounded(k, -2));
    }
    if let Some(row) = report.task.rows.get(plan.row).filter(|_| report.task.swept) {
        let at = conditions_text(&report.task.model.conditions, &row.conditions);
        let worst = if plan.target.share > 0.0 { "farthest above it" } else { "largest" };
        said += &format!(", {worst} at {at}");
    }
    said
}

/// A sentence for each offer that is no better than the present input in some row.
pub fn worse_offers(task: &Task, costs: &Costs) -> Vec<String> {
    let Costs::Stated { improvements, .. } = costs else { return Vec::new() };
    let mut said = Vec::new();
    for (place, (variable, improvement)) in task.variables.iter().zip(improvements).enumerate() {
        let Some(Improvement::Offers(offers)) = improvement else { continue };
        let rows = task.rows.iter().filter_map(|row| row.distributions.get(place));
        let now = rows.map(|known| known.standard_uncertainty()).fold(0.0, f64::max);
        let name = plain(&variable.name);
        for offer in offers.iter().filter(|offer| offer.standard_uncertainty >= now) {
            let of = |value: f64| in_unit(&exact(to_digits(value, 4)), &variable.unit);
            let hint = if variable.unit.has_name() {
                format!(
                    " Numbers without a unit are in {unit}; write a number in another unit with \
                     its unit, as in `\"1.5 {unit}\"`.",
                    unit = unit_text(&variable.unit)
                )
            } else {
                String::new()
            };
            said.push(format!(
                "The offer of {} for {name} (cost {}) is not better than the present value, \
                 {}.{hint}",
                of(offer.standard_uncertainty),
                exact(offer.cost),
                of(now)
            ));
        }
    }
    said
}

/// Notes below the tables.
pub(super) fn notes(report: &PlanReport<'_>) -> Vec<String> {
    let plan = report.plan;
    let mut said = Vec::new();
    // the limit is only a fraction of the estimate
    if plan.target.share > 0.0
        && plan.target.most == 0.0
        && plan.figure * plan.target.share > plan.limit
    {
        said.push(
            "The estimate is smaller than its uncertainty there, so a share of it means little: \
             add a value to the target, `0.01 % + 2 uV`, or leave the row out."
                .to_owned(),
        );
    }
    if let Some(cheapest) = &plan.cheapest {
        let planned = if plan.target.expanded {
            cheapest.gum.expanded_uncertainty()
        } else {
            Some(cheapest.gum.standard_uncertainty)
        };
        if let Some(planned) = planned {
            let k = cheapest.gum.coverage_factor.filter(|_| plan.target.expanded);
            let k = k.map(|k| format!(" (k = {})", rounded(k, -2))).unwrap_or_default();
            let planned = value(report.output(), &significant(planned, DIGITS));
            said.push(format!("With this plan {} = {planned}{k}.", name(report)));
        }
        if matches!(report.costs, Costs::Equal) {
            said.push(EQUAL.to_owned());
        }
    }
    said.extend(worse_offers(report.task, report.costs));
    said.extend(plan.check.as_ref().and_then(|found| check(report, found)));
    if !plan.missed_rows.is_empty() {
        said.push(format!(
            "The plan is for the row farthest above its target. The target is missed in {} other \
             rows ({}): plan them with their own conditions.",
            plan.missed_rows.len(),
            row_numbers(&plan.missed_rows)
        ));
    }
    said
}

/// How much wider the drawn distribution with these degrees of freedom is than a normal one: the
/// ratio of standard deviations (JCGM 101, 6.4.9.4).
fn widening(dof: f64) -> f64 {
    if dof > 2.0 { (dof / (dof - 2.0)).sqrt() } else { f64::INFINITY }
}

/// The input because of which the trials miss a target that the law of propagation meets, and its
/// required uncertainty.
pub fn excess_text(excess: &Excess, task: &Task, target: PlanTarget) -> String {
    let variable = task.variables.get(excess.variable);
    let name = plain(variable.map_or("", |variable| variable.name.as_str()));
    let output = task.model.outputs.get(target.output).map(|output| &output.quantity);
    let without = value(output, &significant(excess.without, DIGITS));
    let mut said = format!(
        "`{name}` is the cause: the law of propagation does not include its whole effect, so it \
         cannot be planned. Without its uncertainty the trials give {without}"
    );
    if let Some((needed, variable)) = excess.needed.zip(variable) {
        let needed = in_unit(&at_most(needed), &variable.unit);
        said += &format!("; with u(`{name}`) = {needed} they reach the target");
    }
    said
}

/// The results of the trials.
fn check(report: &PlanReport<'_>, found: &PlanCheck) -> Option<String> {
    let figure = value(report.output(), &significant(found.figure?, DIGITS));
    let of_excess = found.excess.as_ref().map(|excess| {
        let said = excess_text(excess, report.task, report.plan.target);
        format!("the target is missed, and a lower target does not help: {said}")
    });
    let verdict = match found.holds {
        Some(false) if of_excess.is_some() => of_excess.as_deref().unwrap_or_default(),
        Some(true) => "the target is met",
        Some(false) if found.figure? <= report.plan.limit * widening(found.drawn_dof) => {
            "the target is missed, because some inputs have few degrees of freedom and therefore \
             wider t distributions; set a lower target"
        }
        Some(false) => {
            "the target is missed, because the model is not linear enough for this plan; set a \
             lower target"
        }
        None => "the target is met within the scatter of the trials",
    };
    let of = if report.plan.target.expanded {
        "half the length of the coverage interval"
    } else {
        "the standard uncertainty"
    };
    let mut said = format!(
        "Check by {} Monte Carlo trials of the plan: {of} is {figure}; {verdict}.",
        grouped(found.trials)
    );
    if !found.stood_in.is_empty() {
        let names: Vec<String> =
            found.stood_in.iter().map(|&variable| plain(report.name(variable))).collect();
        said += &format!(
            " Drawn as normal or t, because their shapes have no separate width: {}.",
            names.join(", ")
        );
    }
    Some(said)
}

/// The calibration interval.
pub(super) fn interval(report: &PlanReport<'_>, found: &PlannedInterval) -> String {
    let unit = plain(report.time_unit);
    let time = |value: String| if unit.is_empty() { value } else { format!("{value} {unit}") };
    let drift = found.drift;
    let law = match drift.law {
        DriftLaw::Linear => "in proportion to time",
        DriftLaw::RandomWalk => "with the square root of time",
    };
    let input = plain(report.name(drift.variable));
    let stated = time(exact(drift.stated));
    let grows = format!("`{input}` is the drift over {stated} and increases {law}");
    match found.longest {
        None => format!(
            "Calibration interval: {grows}; the target is met for every practical \
            interval."
        ),
        Some(0.0) => format!(
            "Calibration interval: {grows}; the target is missed even right after a calibration: \
             improve other inputs first."
        ),
        Some(longest) => {
            let u = found.standard_uncertainty.map_or_else(String::new, |u| {
                format!(
                    ", until u({input}) = {} {}",
                    at_most(u),
                    plain(report.unit(drift.variable))
                )
            });
            format!(
                "Calibration interval: {grows}; the target is met for {}{}.",
                time(at_most(longest)),
                u.trim_end()
            )
        }
    }
}
