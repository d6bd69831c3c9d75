//! The answer for programs.

use super::Compare;
use crate::tree::Tree;
use gumption_analysis::compare::laboratories::ReferenceValue;
use gumption_analysis::compare::{ComparedPair, Comparison, DegreeOfEquivalence, FACTOR};

/// The comparison as JSON, ending in a newline.
pub fn json(compare: &Compare) -> String {
    let version = ("gumption", Tree::from(env!("CARGO_PKG_VERSION")));
    match compare {
        Compare::Pairs { compared, rounding, .. } => {
            let rows = compared.iter().map(|row| pair(row, *rounding));
            Tree::object([version, ("rows", Tree::list(rows))]).json()
        }
        Compare::Laboratories(comparison) => {
            let mut entries = vec![version];
            entries.extend(laboratories(comparison));
            Tree::object(entries).json()
        }
    }
}

fn pair(row: &ComparedPair, rounding: bool) -> Tree {
    let mut entries = vec![
        ("label", Tree::from(row.label.as_str())),
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
    Tree::object(entries)
}

fn laboratories(comparison: &Comparison) -> Vec<(&'static str, Tree)> {
    let label = |&member: &usize| comparison.rows.get(member).map_or("", |row| row.label.as_str());
    let reference = |of: &ReferenceValue| {
        Tree::object([
            ("value", Tree::from(of.value)),
            ("standard_uncertainty", of.standard_uncertainty.into()),
            ("U", (FACTOR * of.standard_uncertainty).into()),
            ("laboratories", Tree::list(of.members.iter().map(label))),
            ("chi_squared", of.chi_squared.into()),
            ("dof", (of.dof as u64).into()),
            ("p_value", of.p_value.into()),
            ("consistent", of.is_consistent().into()),
        ])
    };
    let search = comparison.search.map_or(Tree::Null, |search| search.name().into());
    vec![
        ("reference", reference(&comparison.reference)),
        ("weighted_mean", reference(&comparison.all)),
        ("largest_consistent_subset", search),
        ("rows", Tree::list(comparison.rows.iter().map(row))),
    ]
}

fn row(row: &DegreeOfEquivalence) -> Tree {
    Tree::object([
        ("label", Tree::from(row.label.as_str())),
        ("x", row.value.into()),
        ("difference", row.difference.into()),
        ("U", row.expanded.into()),
        ("en", row.normalized_error.into()),
        ("zeta", row.zeta.into()),
        ("probability", row.probability.into()),
        ("compatible", (row.normalized_error <= 1.0).into()),
        ("in_reference", row.member.into()),
    ])
}
