//! The sentences of a comparison.

use super::sheets::{in_unit, probability};
use super::{Compare, proficiency};
use crate::document::sentence;
use crate::number::{degrees_of_freedom, rounded, significant, with_uncertainty};
use crate::plain;
use gumption_analysis::compare::laboratories::ReferenceValue;
use gumption_analysis::compare::{Comparison, Estimator, FACTOR, consensus};

pub(super) const PAIRS: &str = "En is the modulus of the difference over its expanded uncertainty U \
    (k = 2; results stated with other factors are brought to that); results are compatible where it \
    is at most 1. Zeta is the same over the standard uncertainty. The probability is that of two \
    results of one value that differ by as much or more.";

pub(super) const ROUNDING: &str = "En by the digits: what values and uncertainties that print alike \
    allow.";

/// A sentence about the results of laboratories.
pub(super) fn laboratories(comparison: &Comparison) -> String {
    let made = match comparison.estimator {
        Estimator::WeightedMean => {
            "The reference value is the mean of all results, weighted by the inverse covariance matrix \
             (Cox 2002, procedure A)."
        }
        Estimator::LargestConsistentSubset => {
            "The reference value is the mean of the largest consistent subset (Cox 2007), weighted by \
             the inverse covariance matrix."
        }
        Estimator::Birge | Estimator::DerSimonianLaird | Estimator::MandelPaule => {
            "The reference value is that of the estimator that was asked for, from all results, with \
             what it adds to their uncertainties."
        }
    };
    format!(
        "{made} Results are consistent if the probability of chi-squared of their mean weighted by the \
         stated uncertainties is at least 5 %. U of a difference (k = 2) takes into account that the \
         reference value is made from the results; results are compatible where En is at most 1, the \
         probability is that of a normal distribution."
    )
}

pub(super) const ESTIMATORS: &str = "Birge multiplies all stated uncertainties by one factor; \
    DerSimonian-Laird and Mandel-Paule add one standard deviation tau between laboratories to each. \
    Hartung and Knapp take the uncertainty of such a mean from the observed dispersion, with the t \
    factor for as many degrees of freedom as there are other laboratories (95.45 %): state that U of \
    the random-effects models where there are few laboratories. --estimator NAME gives degrees of \
    equivalence from the reference value of that name.";

/// Which one to take.
pub(super) fn recommended(comparison: &Comparison) -> String {
    sentence(consensus::recommended(&comparison.all).1)
}

/// The increase of the stated uncertainties.
fn added(comparison: &Comparison, unit: &str) -> Option<String> {
    let own = comparison.estimators.iter().find(|of| of.estimator == comparison.estimator)?;
    match own.estimator {
        Estimator::WeightedMean | Estimator::LargestConsistentSubset => None,
        Estimator::Birge => {
            let ratio = rounded(own.birge_ratio?, -2);
            Some(format!("Birge: stated uncertainties multiplied by {ratio}"))
        }
        Estimator::DerSimonianLaird | Estimator::MandelPaule => {
            let name = match own.estimator {
                Estimator::DerSimonianLaird => "DerSimonian-Laird",
                _ => "Mandel-Paule",
            };
            let (tau, of) = (in_unit(&significant(own.tau?, 2), unit), own.hartung_knapp?);
            Some(format!(
                "{name}: a standard deviation of {tau} between laboratories; by Hartung and Knapp U = \
                 {} (k = {}, {})",
                in_unit(&significant(of.expanded(), 2), unit),
                rounded(of.coverage_factor, -2),
                degrees_of_freedom(&of.dof.to_string())
            ))
        }
    }
}

pub(super) fn title(compare: &Compare) -> String {
    match compare {
        Compare::Pairs { .. } => "Normalized errors".to_owned(),
        Compare::Laboratories { .. } => "Comparison of laboratories".to_owned(),
        Compare::Proficiency { .. } => "Proficiency test".to_owned(),
    }
}

/// The result.
pub(super) fn verdict(compare: &Compare) -> Vec<String> {
    match compare {
        Compare::Pairs { compared, .. } => {
            let all = compared.len();
            let not: Vec<String> = compared
                .iter()
                .filter(|row| !row.is_compatible())
                .map(|row| plain(&row.label))
                .collect();
            vec![match (not.as_slice(), all) {
                ([], 1) => "The pair is compatible.".to_owned(),
                ([], _) => format!("All {all} pairs are compatible."),
                ([_], 1) => "The pair is not compatible.".to_owned(),
                ([only], _) => format!("1 of {all} pairs is not compatible: {only}."),
                _ => {
                    format!("{} of {all} pairs are not compatible: {}.", not.len(), not.join(", "))
                }
            }]
        }
        Compare::Laboratories { comparison, unit } => of_laboratories(comparison, unit),
        Compare::Proficiency { test, unit } => proficiency::verdict(test, unit),
    }
}

fn of_laboratories(comparison: &Comparison, unit: &str) -> Vec<String> {
    let chi = |of: &ReferenceValue| {
        format!(
            "chi-squared {} with {}, probability {}",
            rounded(of.chi_squared, -2),
            degrees_of_freedom(&of.dof.to_string()),
            probability(of.p_value)
        )
    };
    let value = |of: &ReferenceValue| {
        let (y, u) = with_uncertainty(of.value, FACTOR * of.standard_uncertainty, 2);
        format!("{} with U = {} (k = 2)", in_unit(&y, unit), in_unit(&u, unit))
    };
    let (all, reference) = (&comparison.all, &comparison.reference);
    let are = if all.is_consistent() { "are" } else { "are not" };
    let consistency =
        format!("The {} laboratories {are} consistent: {}.", all.members.len(), chi(all));
    let search = comparison.search;
    let Some(search) =
        search.filter(|_| comparison.estimator == Estimator::LargestConsistentSubset)
    else {
        let how = added(comparison, unit).map_or_else(String::new, |said| format!(" ({said})"));
        return vec![consistency, format!("Reference value {}{how}.", value(reference))];
    };
    let out: Vec<String> =
        comparison.rows.iter().filter(|row| !row.member).map(|row| plain(&row.label)).collect();
    if let [only] = reference.members[..] {
        let name = comparison.rows.get(only).map_or_else(String::new, |row| plain(&row.label));
        return vec![
            consistency,
            format!(
                "No two of the results agree, so that there is no consistent subset: the reference \
                 value {} is the result of {name} alone, and that of any other laboratory would do \
                 as well. Find the reason of the disagreement, or choose `{}`, which takes all of \
                 them with a common additional uncertainty.",
                value(reference),
                Estimator::MandelPaule.name()
            ),
        ];
    }
    vec![
        consistency,
        format!(
            "Reference value {} from the largest consistent subset, {} laboratories without {} \
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
        ties(comparison),
        advice(comparison),
    ]
    .into_iter()
    .filter(|said| !said.is_empty())
    .collect()
}

/// A sentence that other subsets are equally good, and that the order of the rows decided; empty if
/// there are none.
fn ties(comparison: &Comparison) -> String {
    let ties = &comparison.ties;
    if ties.count == 0 {
        return String::new();
    }
    let order = "which one is taken follows from the order of the rows alone";
    if ties.subsets.is_empty() {
        return format!(
            "Taking out one laboratory at a time, {} would have lowered chi-squared as much: {order}.",
            if ties.count == 1 { "another one" } else { "others" }
        );
    }
    let label = |place: &usize| comparison.rows.get(*place).map(|row| plain(&row.label));
    let without = |members: &Vec<usize>| {
        let out: Vec<usize> =
            (0..comparison.rows.len()).filter(|place| !members.contains(place)).collect();
        format!("without {}", out.iter().filter_map(label).collect::<Vec<_>>().join(", "))
    };
    let mut named: Vec<String> = ties.subsets.iter().map(without).collect();
    if ties.count > named.len() {
        named.push(format!("{} more", ties.count - named.len()));
    }
    let (are, do_so) = if ties.count == 1 { ("is", "does") } else { ("are", "do") };
    format!(
        "There {are} {} of the same size with the same chi-squared ({}), which {do_so} as well: \
         {order}. Give it only with a technical reason.",
        if ties.count == 1 {
            "another subset".to_owned()
        } else {
            format!("{} other subsets", ties.count)
        },
        named.join("; ")
    )
}

/// A recommendation of another estimator, and the option for it; empty if the recommended one is
/// used.
fn advice(comparison: &Comparison) -> String {
    let (advised, _) = consensus::recommended(&comparison.all);
    if advised == comparison.estimator {
        return String::new();
    }
    let name = advised.name();
    format!(
        "Degrees of equivalence and En are from this subset, which is right only where a technical \
         reason speaks against the laboratories that are left out. Without one take Mandel-Paule: \
         `--estimator {name}` (see below)."
    )
}
