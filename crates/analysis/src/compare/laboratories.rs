//! Results of many laboratories: the weighted mean as reference value, a test of consistency, and
//! degrees of equivalence (M. G. Cox, Metrologia 39 (2002) 589, procedure A). For inconsistent
//! results the reference value is that of the largest consistent subset (M. G. Cox, Metrologia 44
//! (2007) 187).
//!
//! Correlated results are weighted by the inverse of their covariance matrix; for independent
//! results it is diagonal, and the formulas become Cox's.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use super::consensus::{self, ConsensusValue, Estimator};
use super::pair::StatedResult;
use super::subset::{self, FoundSubset, SubsetSearch, Ties};
use super::{FACTOR, agree, definite, probability};
use gumption_engine::linalg::{DenseRoot, principal_part};
use gumption_engine::special;

/// The result of a laboratory.
#[derive(Clone, Debug, PartialEq)]
pub struct Laboratory {
    /// Its name.
    pub label: String,
    /// Its result; the standard uncertainty is above 0.
    pub result: StatedResult,
}

/// The significance of the consistency test.
pub const SIGNIFICANCE: f64 = 0.05;

/// A weighted mean and its consistency.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceValue {
    /// The indices of the laboratories that contribute to it, in order.
    pub members: Vec<usize>,
    /// The value.
    pub value: f64,
    /// Its standard uncertainty.
    pub standard_uncertainty: f64,
    /// The observed chi-squared.
    pub chi_squared: f64,
    /// Its degrees of freedom, one fewer than there are members.
    pub dof: usize,
    /// The probability of such a chi-squared or a larger one for consistent results.
    pub p_value: f64,
}

impl ReferenceValue {
    /// Whether the members are consistent at 5 %.
    pub fn is_consistent(&self) -> bool {
        self.p_value >= SIGNIFICANCE
    }
}

/// A laboratory's degree of equivalence.
#[derive(Clone, Debug, PartialEq)]
pub struct DegreeOfEquivalence {
    /// The laboratory.
    pub label: String,
    /// Its value.
    pub value: f64,
    /// Its expanded uncertainty as stated.
    pub expanded_stated: f64,
    /// Its coverage factor.
    pub factor_stated: f64,
    /// Difference from the reference value.
    pub difference: f64,
    /// The expanded uncertainty of the difference, k = 2; the reference value depends on the
    /// results that contribute to it.
    pub expanded: f64,
    /// Normalized error |d|/U.
    pub normalized_error: f64,
    /// Zeta score |d|/u(d).
    pub zeta: f64,
    /// Probability of a difference at least this large.
    pub probability: f64,
    /// Whether it contributes to the reference value.
    pub member: bool,
    compatible: Option<bool>,
}

impl DegreeOfEquivalence {
    /// Whether the result is compatible with the reference value: the normalized error is at most
    /// 1, apart from rounding. `None` for a laboratory whose result is the reference value itself.
    pub fn is_compatible(&self) -> Option<bool> {
        self.compatible
    }
}

/// The comparison of many laboratories.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The weighted mean of all.
    pub all: ReferenceValue,
    /// The reference value: that of the chosen estimator, by default the weighted mean, or the mean
    /// of the largest consistent subset.
    pub reference: ReferenceValue,
    /// How the reference value was computed.
    pub estimator: Estimator,
    /// The values of all estimators, without the largest consistent subset if all results are
    /// consistent.
    pub estimators: Vec<ConsensusValue>,
    /// How the subset was found; `None` if all are consistent.
    pub search: Option<SubsetSearch>,
    /// Other subsets that are as good as the largest consistent one.
    pub ties: Ties,
    /// One entry for each laboratory.
    pub rows: Vec<DegreeOfEquivalence>,
}

/// Why there is no comparison.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Impossible {
    /// Fewer than two laboratories.
    TooFew,
    /// A value, an expanded uncertainty or a coverage factor that is not valid.
    Result {
        /// The laboratory.
        label: String,
    },
    /// Correlation coefficients that do not form a correlation matrix.
    Coefficients {
        /// What is wrong.
        reason: &'static str,
    },
    /// The covariance matrix is not positive definite.
    NotDefinite,
    /// Two laboratories are correlated by 1 or -1, so that a combination of their results has no
    /// uncertainty.
    FullyCorrelated {
        /// Their names.
        laboratories: [String; 2],
        /// Their coefficient.
        coefficient: f64,
    },
    /// The coefficients of a laboratory and the previous ones belong to no joint distribution, or
    /// to one in which its result follows from theirs.
    Dependent {
        /// Its name.
        laboratory: String,
        /// The fraction of its variance that the others do not explain; 1 if it is independent of
        /// them.
        left: f64,
    },
}

impl fmt::Display for Impossible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => f.write_str("a comparison needs at least two laboratories"),
            Self::Result { label } => write!(
                f,
                "the result of `{label}` must be finite numbers, with an expanded uncertainty and a \
                 coverage factor above 0"
            ),
            Self::Coefficients { reason } => write!(f, "the correlation coefficients {reason}"),
            Self::NotDefinite => f.write_str(
                "the laboratories cannot be weighted: their uncertainties differ by more than double \
                 precision can square, or their correlation matrix is not positive definite",
            ),
            Self::FullyCorrelated { laboratories: [a, b], coefficient } => write!(
                f,
                "the laboratories cannot be weighted: `{a}` and `{b}` are correlated by \
                 {coefficient}, so that their results combined have no uncertainty and the correlation \
                 matrix has no inverse; state the coefficient that their common part gives, which is \
                 between -1 and 1"
            ),
            Self::Dependent { laboratory, left } if *left < -1e-9 => write!(
                f,
                "the laboratories cannot be weighted: their correlation matrix is not positive \
                 definite, because the coefficients of `{laboratory}` contradict those among the \
                 laboratories before it"
            ),
            Self::Dependent { laboratory, .. } => write!(
                f,
                "the laboratories cannot be weighted: with these coefficients the result of \
                 `{laboratory}` follows from the results of the laboratories before it, so the \
                 correlation matrix has no inverse"
            ),
        }
    }
}

impl std::error::Error for Impossible {}

/// Values with their covariance matrix.
#[derive(Clone, Debug)]
pub(super) struct CorrelatedResults {
    pub(super) values: Vec<f64>,
    pub(super) covariance: DMatrix<f64>,
}

impl CorrelatedResults {
    /// The root of the members' covariance matrix; `None` if the matrix is not positive definite.
    fn root(&self, members: &[usize]) -> Option<DenseRoot> {
        DenseRoot::of(principal_part(&self.covariance, members))
    }

    /// Weights of the mean of the members, and its standard uncertainty; `None` if they are not
    /// defined.
    fn weights(root: &DenseRoot, members: usize) -> Option<(DVector<f64>, f64)> {
        let solved = root.solve(&DVector::from_element(members, 1.0));
        let sum = solved.sum();
        (sum > 0.0 && sum.is_finite()).then(|| (solved / sum, 1.0 / sum.sqrt()))
    }

    /// The weighted mean of the members and its consistency.
    pub(super) fn reference(&self, members: &[usize]) -> Option<ReferenceValue> {
        let root = self.root(members)?;
        let (weights, u) = Self::weights(&root, members.len())?;
        // relative to one of the values, so that a large common part costs no digits
        let origin = *self.values.get(*members.first()?)?;
        let deviations = DVector::from_fn(members.len(), |i, _| self.values[members[i]] - origin);
        let mean = weights.dot(&deviations);
        let residuals = deviations.add_scalar(-mean);
        // a zero has no sign
        let chi_squared = residuals.dot(&root.solve(&residuals)).max(0.0) + 0.0;
        let dof = members.len() - 1;
        let p_value =
            if dof == 0 { 1.0 } else { special::gamma::sf(0.5 * chi_squared, 0.5 * dof as f64) };
        let (members, value) = (members.to_vec(), origin + mean);
        Some(ReferenceValue { members, value, standard_uncertainty: u, chi_squared, dof, p_value })
    }

    /// The members' precision matrix, which gives chi-squared without some of them.
    pub(super) fn precision(&self, members: &[usize]) -> Option<Precision> {
        let n = members.len();
        let inverse = self.root(members)?.inverse();
        let mean = self.reference(members)?.value;
        let of_ones = inverse.column_sum();
        let of_values = &inverse * DVector::from_fn(n, |i, _| self.values[members[i]] - mean);
        let squares = DVector::from_fn(n, |i, _| self.values[members[i]] - mean).dot(&of_values);
        Some(Precision {
            sums: [of_ones.sum(), of_values.sum(), squares],
            inverse,
            of_ones,
            of_values,
        })
    }

    /// The standard uncertainty of a laboratory's difference from the members' mean.
    fn of_difference(&self, laboratory: usize, members: &[usize]) -> Option<f64> {
        let (weights, u) = Self::weights(&self.root(members)?, members.len())?;
        let shared: f64 = members
            .iter()
            .zip(weights.iter())
            .map(|(&member, weight)| weight * self.covariance[(laboratory, member)])
            .sum();
        let own = self.covariance[(laboratory, laboratory)];
        Some((own + u * u - 2.0 * shared).max(0.0).sqrt())
    }
}

/// The inverse P of some laboratories' covariance matrix, with P 1 and P x, where x are their values
/// about their mean.
///
/// Removing laboratories needs no new inverse: each of the sums 1'P1, 1'Px and x'Px decreases by a'
/// Q^-1 b, where Q is the block of P of the removed laboratories and a, b are their entries of P 1
/// and P x (Schur complement). Chi-squared is x'Px - (1'Px)^2 / 1'P1.
#[derive(Debug)]
pub(super) struct Precision {
    inverse: DMatrix<f64>,
    of_ones: DVector<f64>,
    of_values: DVector<f64>,
    /// 1'P1, 1'Px and x'Px.
    sums: [f64; 3],
}

impl Precision {
    /// Chi-squared without the laboratories at the given indices; `None` if only rounding remains.
    pub(super) fn chi_squared_without(&self, out: &[usize]) -> Option<f64> {
        let k = out.len();
        let block = principal_part(&self.inverse, out);
        let block = DenseRoot::of(block)?;
        let [a, b] = [&self.of_ones, &self.of_values]
            .map(|values| DVector::from_fn(k, |i, _| values[out[i]]));
        let [of_a, of_b] = [&a, &b].map(|vector| block.solve(vector));
        let [ones, mixed, squares] = self.sums;
        let [ones, mixed] = [ones - a.dot(&of_a), mixed - a.dot(&of_b)];
        let found = squares - b.dot(&of_b) - mixed * mixed / ones;
        (ones > 0.0 && found.is_finite()).then_some(found)
    }
}

/// Why the coefficients are not a correlation matrix of `n` results; `None` if they are.
fn fault(correlations: &[Vec<f64>], n: usize) -> Option<&'static str> {
    if correlations.is_empty() {
        return None;
    }
    if correlations.len() != n || correlations.iter().any(|row| row.len() != n) {
        return Some("must have a row for each laboratory, with a coefficient for each");
    }
    let places = || (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    if places().any(|(i, j)| !(-1.0..=1.0).contains(&correlations[i][j])) {
        return Some("must be from -1 to 1");
    }
    if (0..n).any(|i| correlations[i][i] != 1.0) {
        return Some("must be 1 of every laboratory with itself");
    }
    // a NaN above the diagonal is not the number below it either
    places()
        .any(|(i, j)| correlations[i][j] != correlations[j][i])
        .then_some("must be the same above and below the diagonal")
}

/// Compares the results of laboratories; `correlations` has their coefficients, row by row as a whole
/// symmetric matrix with 1 on its diagonal, or is empty if they are independent.
///
/// # Errors
/// Fewer than two laboratories; invalid results; coefficients that do not form a correlation
/// matrix, or that no joint distribution has.
pub fn compare(
    laboratories: &[Laboratory],
    correlations: &[Vec<f64>],
) -> Result<Comparison, Impossible> {
    compare_by(laboratories, correlations, None)
}

/// The same with the reference value of an estimator, and degrees of equivalence with respect to
/// it. Birge's ratio and the random-effects models use the increased uncertainties.
///
/// # Errors
/// As [`compare`].
pub fn compare_by(
    laboratories: &[Laboratory],
    correlations: &[Vec<f64>],
    wanted: Option<Estimator>,
) -> Result<Comparison, Impossible> {
    if laboratories.len() < 2 {
        return Err(Impossible::TooFew);
    }
    let is_result = |laboratory: &Laboratory| {
        laboratory.result.is_possible() && laboratory.result.expanded > 0.0
    };
    if let Some(wrong) = laboratories.iter().find(|laboratory| !is_result(laboratory)) {
        return Err(Impossible::Result { label: wrong.label.clone() });
    }
    if let Some(reason) = fault(correlations, laboratories.len()) {
        return Err(Impossible::Coefficients { reason });
    }
    let u: Vec<f64> = laboratories.iter().map(|l| l.result.standard_uncertainty()).collect();
    let n = laboratories.len();
    let coefficient = |i: usize, j: usize| {
        let given = correlations.get(i).and_then(|row| row.get(j)).copied();
        given.unwrap_or(if i == j { 1.0 } else { 0.0 })
    };
    if !correlations.is_empty() {
        definite::check(laboratories, coefficient)?;
    }
    let results = CorrelatedResults {
        values: laboratories.iter().map(|l| l.result.value).collect(),
        covariance: DMatrix::from_fn(n, n, |i, j| coefficient(i, j) * u[i] * u[j]),
    };
    let everybody: Vec<usize> = (0..n).collect();
    let all = results.reference(&everybody).ok_or(Impossible::NotDefinite)?;
    let subset = if all.is_consistent() {
        None
    } else {
        Some(subset::largest(&results, n).ok_or(Impossible::NotDefinite)?)
    };
    let (subset, (search, ties)) = match subset {
        Some(FoundSubset { reference, search, ties }) => (Some(reference), (Some(search), ties)),
        None => (None, (None, Ties::default())),
    };
    let estimator = match wanted {
        Some(Estimator::LargestConsistentSubset) | None if subset.is_some() => {
            Estimator::LargestConsistentSubset
        }
        Some(Estimator::LargestConsistentSubset) | None => Estimator::WeightedMean,
        Some(wanted) => wanted,
    };
    let mut estimators = Vec::new();
    // the results with the uncertainties that the reference value was computed with
    let mut taken = None;
    for candidate in Estimator::ALL {
        let (value, results) = match (candidate, &subset) {
            (Estimator::LargestConsistentSubset, None) => continue,
            (Estimator::LargestConsistentSubset, Some(found)) => {
                (ConsensusValue::plain(candidate, found.clone()), results.clone())
            }
            _ => consensus::estimated(&results, candidate)?,
        };
        if candidate == estimator {
            taken = Some((value.reference.clone(), results));
        }
        estimators.push(value);
    }
    let (reference, results) = taken.ok_or(Impossible::NotDefinite)?;
    let rows = laboratories.iter().enumerate().map(|(number, laboratory)| {
        let difference = laboratory.result.value - reference.value;
        let u = match reference.members[..] {
            // the difference of a result from itself carries no information
            [only] if only == number => 0.0,
            _ => results.of_difference(number, &reference.members)?,
        };
        let expanded = FACTOR * u;
        let normalized_error = difference.abs() / expanded;
        let is_compared = !normalized_error.is_nan();
        let values = [laboratory.result.value, reference.value];
        Some(DegreeOfEquivalence {
            label: laboratory.label.clone(),
            value: laboratory.result.value,
            expanded_stated: laboratory.result.expanded,
            factor_stated: laboratory.result.factor,
            difference,
            expanded,
            normalized_error,
            zeta: difference.abs() / u,
            probability: probability(difference, u),
            member: reference.members.contains(&number),
            compatible: is_compared.then(|| agree(values, expanded)),
        })
    });
    let rows = rows.collect::<Option<Vec<DegreeOfEquivalence>>>().ok_or(Impossible::NotDefinite)?;
    Ok(Comparison { all, reference, estimator, estimators, search, ties, rows })
}

#[cfg(test)]
mod tests;
