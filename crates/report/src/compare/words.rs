//! The sentences of a comparison.

use super::Compare;
use super::sheets::probability;
use crate::number::{rounded, with_uncertainty};
use crate::plain;
use gumption_analysis::compare::laboratories::ReferenceValue;
use gumption_analysis::compare::{Comparison, FACTOR};

pub(super) const PAIRS: &str = "En is the modulus of the difference over its expanded uncertainty U \
    (k = 2; results stated with other factors are brought to that); results are compatible where it \
    is at most 1. Zeta is the same over the standard uncertainty. The probability is that of two \
    results of one value that differ by as much or more.";

pub(super) const ROUNDING: &str = "En by the digits: what values and uncertainties that print alike \
    allow.";

pub(super) const LABORATORIES: &str = "The reference value is the mean weighted by the inverse \
    covariance matrix (Cox 2002, procedure A); it is consistent if the probability of chi-squared is \
    at least 5 %. U of a difference (k = 2) takes into account that the reference value is made from \
    the results. Where all are not consistent, it is made from the largest consistent subset (Cox \
    2007).";

pub(super) fn title(compare: &Compare) -> String {
    match compare {
        Compare::Pairs { .. } => "Normalized errors".to_owned(),
        Compare::Laboratories(_) => "Comparison of laboratories".to_owned(),
    }
}

/// What came out.
pub(super) fn verdict(compare: &Compare) -> Vec<String> {
    match compare {
        Compare::Pairs { compared, .. } => {
            let all = compared.len();
            let not: Vec<String> = compared
                .iter()
                .filter(|row| !row.is_compatible())
                .map(|row| plain(&row.label))
                .collect();
            vec![if not.is_empty() {
                format!("All {all} pairs are compatible.")
            } else {
                format!("{} of {all} pairs are not compatible: {}.", not.len(), not.join(", "))
            }]
        }
        Compare::Laboratories(comparison) => of_laboratories(comparison),
    }
}

fn of_laboratories(comparison: &Comparison) -> Vec<String> {
    let chi = |of: &ReferenceValue| {
        format!(
            "chi-squared {} with {} degrees of freedom, probability {}",
            rounded(of.chi_squared, -2),
            of.dof,
            probability(of.p_value)
        )
    };
    let value = |of: &ReferenceValue| {
        let (y, u) = with_uncertainty(of.value, FACTOR * of.standard_uncertainty, 2);
        format!("{y} with U = {u} (k = 2)")
    };
    let (all, reference) = (&comparison.all, &comparison.reference);
    let Some(search) = comparison.search else {
        return vec![
            format!("The {} laboratories are consistent: {}.", all.members.len(), chi(all)),
            format!("ReferenceValue value {}.", value(all)),
        ];
    };
    let out: Vec<String> =
        comparison.rows.iter().filter(|row| !row.member).map(|row| plain(&row.label)).collect();
    vec![
        format!("The {} laboratories are not consistent: {}.", all.members.len(), chi(all)),
        format!(
            "ReferenceValue value {} from the largest consistent subset, {} laboratories without {} \
             ({}; sought among {}).",
            value(reference),
            reference.members.len(),
            out.join(", "),
            chi(reference),
            match search.name() {
                "all subsets" => "all subsets",
                _ => "the subsets with one laboratory fewer at a time",
            }
        ),
    ]
}
