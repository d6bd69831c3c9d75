//! The answer for programs.

use super::{Compare, gauge, proficiency};
use crate::answer::{list, object, pretty};
use gumption_analysis::compare::laboratories::ReferenceValue;
use gumption_analysis::compare::{
    ComparedPair, Comparison, DegreeOfEquivalence, FACTOR, HartungKnapp, consensus,
};
use gumption_engine::task::Warning;
use serde_json::Value;

/// The comparison as JSON, ending in a newline.
pub fn json(compare: &Compare, said: &[Warning]) -> String {
    let warnings = ("warnings", crate::words::listed(said));
    let version = ("gumption", Value::from(env!("CARGO_PKG_VERSION")));
    match compare {
        Compare::Pairs { compared, units, rounding, .. } => {
            let rows = compared.iter().zip(units).map(|(row, unit)| pair(row, unit, *rounding));
            pretty(&object([version, ("rows", list(rows)), warnings]))
        }
        Compare::Laboratories { comparison, unit } => {
            let mut entries = vec![version, ("unit", known(unit))];
            entries.extend(laboratories(comparison));
            entries.push(warnings);
            pretty(&object(entries))
        }
        Compare::Proficiency { test, unit } => proficiency::json(test, unit, said),
        Compare::Gauge { study, unit } => gauge::json(study, unit, said),
    }
}

/// A unit; null if it is unknown.
fn known(unit: &str) -> Value {
    if unit.is_empty() { Value::Null } else { unit.into() }
}

fn pair(row: &ComparedPair, unit: &str, rounding: bool) -> Value {
    let mut entries = vec![
        ("label", Value::from(row.label.as_str())),
        ("unit", known(unit)),
        ("difference", row.difference.into()),
        ("U", row.expanded.into()),
        ("en", row.normalized_error.into()),
        ("zeta", row.zeta.into()),
    ];
    if rounding {
        entries.push(("range", row.range.into()));
    }
    entries.push(("probability", row.probability.into()));
    entries.push(("compatible", row.is_compatible().into()));
    object(entries)
}

fn laboratories(comparison: &Comparison) -> Vec<(&'static str, Value)> {
    let label = |&member: &usize| comparison.rows.get(member).map_or("", |row| row.label.as_str());
    let reference = |of: &ReferenceValue| {
        object([
            ("value", Value::from(of.value)),
            ("standard_uncertainty", of.standard_uncertainty.into()),
            ("U", (FACTOR * of.standard_uncertainty).into()),
            ("laboratories", list(of.members.iter().map(label))),
            ("chi_squared", of.chi_squared.into()),
            ("dof", (of.dof as u64).into()),
            ("p_value", of.p_value.into()),
            ("consistent", of.is_consistent().into()),
        ])
    };
    let estimators = comparison.estimators.iter().map(|of| {
        object([
            ("estimator", Value::from(of.estimator.name())),
            ("value", of.reference.value.into()),
            ("standard_uncertainty", of.reference.standard_uncertainty.into()),
            ("U", (FACTOR * of.reference.standard_uncertainty).into()),
            ("birge_ratio", of.birge_ratio.into()),
            ("tau", of.tau.into()),
            ("hartung_knapp", of.hartung_knapp.as_ref().map(hartung_knapp).into()),
        ])
    });
    let (recommended, why) = consensus::recommended(&comparison.all);
    let search = comparison.search.map_or(Value::Null, |search| search.name().into());
    let ties = &comparison.ties;
    let subsets = ties.subsets.iter().map(|members| list(members.iter().map(label)));
    let subsets_as_good =
        object([("count", Value::from(ties.count as u64)), ("first", list(subsets))]);
    vec![
        ("reference", reference(&comparison.reference)),
        ("estimator", comparison.estimator.name().into()),
        ("estimators", list(estimators)),
        ("recommended", object([("estimator", recommended.name()), ("why", why)])),
        ("weighted_mean", reference(&comparison.all)),
        ("largest_consistent_subset", search),
        ("subsets_as_good", subsets_as_good),
        ("rows", list(comparison.rows.iter().map(row))),
    ]
}

fn hartung_knapp(of: &HartungKnapp) -> Value {
    object([
        ("standard_uncertainty", Value::from(of.standard_uncertainty)),
        ("dof", (of.dof as u64).into()),
        ("coverage_factor", of.coverage_factor.into()),
        ("U", of.expanded().into()),
    ])
}

fn row(row: &DegreeOfEquivalence) -> Value {
    object([
        ("label", Value::from(row.label.as_str())),
        ("x", row.value.into()),
        ("difference", row.difference.into()),
        ("U", row.expanded.into()),
        ("en", row.normalized_error.into()),
        ("zeta", row.zeta.into()),
        ("probability", row.probability.into()),
        ("compatible", row.is_compatible().into()),
        ("in_reference", row.member.into()),
    ])
}
