//! The answer for programs.

use super::PlanReport;
use crate::answer::{list, object, pretty};
use gumption_analysis::plan::{
    CheapestPlan, Costs, Excess, InputNeed, PlanCheck, PlannedInput, PlannedInterval,
};
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::task::Trials;
use serde_json::Value;

/// The plan as JSON, ending in a newline.
pub fn json(report: &PlanReport<'_>) -> String {
    let PlanReport { task, plan, costs, warnings, provenance, .. } = *report;
    let output = report.output();
    let needs = plan.inputs.iter().map(|need| input(report, need));
    let cheapest = plan.cheapest.iter().flat_map(|plan| &plan.inputs);
    let cheapest = list(cheapest.map(|of| planned(report, of)));
    let conditions = task.rows.get(plan.row).filter(|_| task.swept).map(|row| {
        let names = task.model.conditions.iter().map(|condition| condition.name.as_str());
        object(names.zip(row.conditions.iter().map(|&value| Value::from(value))))
    });
    let notes = warnings.iter().map(|warning| {
        object([
            ("code", warning.code()),
            ("where", warning.place.as_str()),
            ("text", &*Box::leak(crate::words::note(warning, crate::words::Language::English).into_boxed_str())),
        ])
    });
    let trials: Value = match task.settings.trials {
        Trials::Fixed(count) => count.into(),
        Trials::Adaptive => "adaptive".into(),
    };
    let files = provenance.files.iter().map(|(name, digest)| (name.as_str(), digest.as_str()));
    let origin = object([
        ("model_sha256", Value::from(provenance.model_sha256.as_str())),
        ("seed", task.settings.seed.into()),
        ("trials", trials),
        ("files", object(files)),
    ]);
    let rows = plan.missed_rows.iter().map(|&row| row as u64 + 1);
    pretty(&object([
        ("gumption", Value::from(env!("CARGO_PKG_VERSION"))),
        ("title", task.title.as_str().into()),
        ("output", output.map(|output| output.name.as_str()).into()),
        ("unit", output.map(|output| output.unit.text()).into()),
        ("quantity", report.kind().into()),
        ("target", plan.limit.into()),
        ("target_share", Some(plan.target.share).filter(|share| *share > 0.0).into()),
        ("now", plan.figure.into()),
        ("conditions", conditions.into()),
        ("current", figures(&plan.now)),
        ("inputs", list(needs)),
        ("cheapest", cheapest),
        ("cost", plan.cheapest.as_ref().map(|plan| plan.cost).into()),
        ("costs", if matches!(costs, Costs::Equal) { "equal" } else { "stated" }.into()),
        ("currency", Some(costs.currency()).filter(|currency| !currency.is_empty()).into()),
        ("planned", plan.cheapest.as_ref().map(|plan: &CheapestPlan| figures(&plan.gum)).into()),
        ("check", plan.check.as_ref().map(|found| check(report, found)).into()),
        ("interval", plan.interval.as_ref().map(|found| interval(report, found)).into()),
        ("missed_rows", list(rows)),
        ("warnings", list(notes)),
        ("provenance", origin),
    ]))
}

fn figures(gum: &Gum) -> Value {
    let dof = match gum.dof {
        Dof::Finite(dof) => Some(dof),
        Dof::Infinite | Dof::Undefined => None,
    };
    object([
        ("estimate", Value::from(gum.estimate)),
        ("standard_uncertainty", gum.standard_uncertainty.into()),
        ("dof", dof.into()),
        ("coverage_factor", gum.coverage_factor.into()),
        ("expanded_uncertainty", gum.expanded_uncertainty().into()),
    ])
}

fn input(report: &PlanReport<'_>, need: &InputNeed) -> Value {
    object([
        ("input", Value::from(report.name(need.variable))),
        ("unit", report.unit(need.variable).into()),
        ("standard_uncertainty", need.standard_uncertainty.into()),
        ("needed", need.needed.into()),
        ("readings", need.readings.into()),
        ("readings_needed", need.readings_needed.into()),
        ("why", need.fixed.into()),
    ])
}

fn planned(report: &PlanReport<'_>, of: &PlannedInput) -> Value {
    object([
        ("input", Value::from(report.name(of.variable))),
        ("unit", report.unit(of.variable).into()),
        ("from", of.from.into()),
        ("standard_uncertainty", of.to.into()),
        ("readings", of.readings.into()),
        ("offer", of.offer.as_deref().into()),
        ("cost", of.cost.into()),
    ])
}

fn check(report: &PlanReport<'_>, found: &PlanCheck) -> Value {
    object([
        ("trials", Value::from(found.trials)),
        (report.kind(), found.figure.into()),
        ("numerical_standard_error", found.numerical_standard_error.into()),
        ("holds", found.holds.into()),
        ("stood_in", list(found.stood_in.iter().map(|&variable| report.name(variable)))),
        ("excess", found.excess.map(|excess| of_excess(report, excess)).into()),
    ])
}

fn of_excess(report: &PlanReport<'_>, of: Excess) -> Value {
    object([
        ("input", Value::from(report.name(of.variable))),
        ("unit", report.unit(of.variable).into()),
        ("without", of.without.into()),
        ("needed", of.needed.into()),
    ])
}

fn interval(report: &PlanReport<'_>, found: &PlannedInterval) -> Value {
    object([
        ("input", Value::from(report.name(found.drift.variable))),
        ("law", found.drift.law.name().into()),
        ("stated", found.drift.stated.into()),
        ("longest", found.longest.into()),
        ("unit", report.time_unit.into()),
        ("standard_uncertainty", found.standard_uncertainty.into()),
    ])
}
