//! The sentences of a comparison.

use super::sheets::{in_unit, probability};
use super::{Compare, gauge, proficiency};
use crate::document::sentence;
use crate::number::{degrees_of_freedom, rounded, significant, with_uncertainty};
use crate::plain;
use gumption_analysis::compare::laboratories::ReferenceValue;
use gumption_analysis::compare::{Comparison, Estimator, FACTOR, consensus};

pub(super) const PAIRS: &str = "En is the modulus of the difference divided by its expanded \
    uncertainty U (k = 2; results with other k are converted to k = 2). Results are compatible if \
    En is at most 1. Zeta is the modulus of the difference divided by its standard uncertainty. \
    The probability is for two results of one value to differ by at least this much.";

pub(super) const ROUNDING: &str = "En by the digits: range of En for all values and uncertainties \
    that round to the printed digits.";

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
            "The reference value is from the selected estimator and all results, with its \
             addition to their uncertainties."
        }
    };
    format!(
        "{made} Results are consistent if the probability of chi-squared is at least 5 % for \
         their mean weighted by the stated uncertainties. U of a difference (k = 2) includes the \
         correlation of the reference value with the results. Results are compatible if En is at \
         most 1. The probability is from a normal distribution."
    )
}

pub(super) const ESTIMATORS: &str = "Birge multiplies all stated uncertainties by one factor; \
    DerSimonian-Laird and Mandel-Paule add one standard deviation tau between laboratories to \
    each. Hartung and Knapp take the uncertainty of the mean from the observed dispersion, with a \
    t factor (95.45 %); its degrees of freedom are the number of other laboratories. State the U \
    of the random-effects models if there are few laboratories. --estimator NAME gives degrees of \
    equivalence from the reference value of this estimator.";

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
        Compare::Gauge { .. } => "Gauge repeatability and reproducibility".to_owned(),
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
        Compare::Gauge { study, unit } => gauge::verdict(study, unit),
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
                "No two results agree, so there is no consistent subset: the reference value {} \
                 is the result of {name} alone, and the result of any other laboratory would be \
                 equally good. Find the cause of the disagreement, or choose `{}`, which uses all \
                 results with a common additional uncertainty.",
                value(reference),
                Estimator::MandelPaule.name()
            ),
        ];
    }
    vec![
        consistency,
        format!(
            "Reference value {} from the largest consistent subset, {} laboratories without {} \
             ({}; searched among {}).",
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
    let order = "only the order of the rows decides which one is used";
    if ties.subsets.is_empty() {
        return format!(
            "Removing one laboratory at a time, {} would have lowered chi-squared as much: \
             {order}.",
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
    let are = if ties.count == 1 { "is" } else { "are" };
    format!(
        "There {are} {} of the same size with the same chi-squared ({}): {order}. State it only \
         with a technical reason.",
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
        "Degrees of equivalence and En are from this subset. Use it only if a technical reason \
         excludes the other laboratories; otherwise use Mandel-Paule: `--estimator {name}` (see \
         below)."
    )
}
