//! Reference values for inconsistent results of laboratories: stated uncertainties are increased
//! until the dispersion of the results is explained.
//!
//! - Birge (R. T. Birge, Phys. Rev. 40 (1932) 207) multiplies all stated uncertainties by one
//!   factor.
//! - A random-effects model adds one variance tau^2 ("dark uncertainty") to each:
//!   DerSimonian-Laird (Contr. Clin. Trials 7 (1986) 177) in one step, Mandel-Paule (R. C. Paule and
//!   J. Mandel, J. Res. NBS 87 (1982) 377) so that chi-squared becomes its expectation n - 1.
//! - Hartung and Knapp (Statist. Med. 20 (2001) 1771) derive the uncertainty of such a mean from
//!   the observed dispersion, with n - 1 degrees of freedom.
//!
//! For correlated results the same equations hold with their full covariance matrix V instead of a
//! diagonal one: the weights follow from (V + tau^2 I)^-1.

use nalgebra::DMatrix;

use super::laboratories::{CorrelatedResults, Impossible, ReferenceValue};
use gumption_engine::linalg::DenseRoot;
use gumption_engine::special;

/// How the reference value of a comparison is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimator {
    /// The mean weighted by the inverse of the stated covariance matrix.
    WeightedMean,
    /// The weighted mean of the largest consistent subset.
    LargestConsistentSubset,
    /// The weighted mean with all stated uncertainties multiplied by the Birge ratio, if that is
    /// above 1.
    Birge,
    /// Random effects with the variance between laboratories of DerSimonian and Laird.
    DerSimonianLaird,
    /// Random effects with the variance between laboratories of Mandel and Paule.
    MandelPaule,
}

impl Estimator {
    /// All estimators, in the order in which pages list them.
    pub const ALL: [Self; 5] = [
        Self::WeightedMean,
        Self::LargestConsistentSubset,
        Self::Birge,
        Self::DerSimonianLaird,
        Self::MandelPaule,
    ];

    /// The name in the command line and in answers.
    pub fn name(self) -> &'static str {
        match self {
            Self::WeightedMean => "weighted-mean",
            Self::LargestConsistentSubset => "largest-consistent-subset",
            Self::Birge => "birge",
            Self::DerSimonianLaird => "dersimonian-laird",
            Self::MandelPaule => "mandel-paule",
        }
    }
}

/// The standard uncertainty of a mean from the observed dispersion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HartungKnapp {
    /// Standard uncertainty.
    pub standard_uncertainty: f64,
    /// Its degrees of freedom, one fewer than there are laboratories.
    pub dof: usize,
    /// The coverage factor of the t distribution for 95.45 %, the probability of k = 2.
    pub coverage_factor: f64,
}

impl HartungKnapp {
    /// Expanded uncertainty for 95.45 %.
    pub fn expanded(&self) -> f64 {
        self.coverage_factor * self.standard_uncertainty
    }
}

/// The reference value of one estimator.
#[derive(Clone, Debug, PartialEq)]
pub struct ConsensusValue {
    /// The estimator.
    pub estimator: Estimator,
    /// The value and its consistency with the uncertainties that the estimator uses.
    pub reference: ReferenceValue,
    /// Birge's factor for the stated uncertainties: the Birge ratio, at least 1.
    pub birge_ratio: Option<f64>,
    /// The standard deviation tau between laboratories of a random-effects model; at least 0.
    pub tau: Option<f64>,
    /// For the random-effects models; `None` for others.
    pub hartung_knapp: Option<HartungKnapp>,
}

impl ConsensusValue {
    /// A value without anything added.
    pub(super) fn plain(estimator: Estimator, reference: ReferenceValue) -> Self {
        Self { estimator, reference, birge_ratio: None, tau: None, hartung_knapp: None }
    }
}

/// The coverage probability of k = 2 for a normal distribution, for Hartung and Knapp's factor.
const PROBABILITY: f64 = 0.954_499_736_103_641_6;

/// The value of an estimator that uses all laboratories, and the results with the covariance matrix
/// of that estimator.
pub(super) fn estimated(
    results: &CorrelatedResults,
    estimator: Estimator,
) -> Result<(ConsensusValue, CorrelatedResults), Impossible> {
    let n = results.values.len();
    let everybody: Vec<usize> = (0..n).collect();
    let stated = results.reference(&everybody).ok_or(Impossible::NotDefinite)?;
    let dof = (n - 1) as f64;
    let (mut birge_ratio, mut tau) = (None, None);
    let covariance = match estimator {
        Estimator::WeightedMean | Estimator::LargestConsistentSubset => results.covariance.clone(),
        Estimator::Birge => {
            let ratio = (stated.chi_squared / dof).sqrt().max(1.0);
            birge_ratio = Some(ratio);
            &results.covariance * (ratio * ratio)
        }
        Estimator::DerSimonianLaird => {
            let squared = moment(results, stated.chi_squared).ok_or(Impossible::NotDefinite)?;
            tau = Some(squared.sqrt());
            widened(results, squared)
        }
        Estimator::MandelPaule => {
            let squared = iterated(results, &everybody).ok_or(Impossible::NotDefinite)?;
            tau = Some(squared.sqrt());
            widened(results, squared)
        }
    };
    let taken = CorrelatedResults { values: results.values.clone(), covariance };
    let reference = taken.reference(&everybody).ok_or(Impossible::NotDefinite)?;
    let hartung_knapp = tau.map(|_| HartungKnapp {
        standard_uncertainty: reference.standard_uncertainty * (reference.chi_squared / dof).sqrt(),
        dof: n - 1,
        coverage_factor: special::student::two_sided_factor(PROBABILITY, dof),
    });
    Ok((ConsensusValue { estimator, reference, birge_ratio, tau, hartung_knapp }, taken))
}

/// V + tau^2 I.
fn widened(results: &CorrelatedResults, squared: f64) -> DMatrix<f64> {
    let n = results.values.len();
    &results.covariance + DMatrix::from_diagonal_element(n, n, squared)
}

/// tau^2 of DerSimonian and Laird: chi-squared is compared with its expectation
/// n - 1 + tau^2 (tr W - 1' W W 1 / 1' W 1), where W is the inverse of V.
fn moment(results: &CorrelatedResults, chi_squared: f64) -> Option<f64> {
    let n = results.values.len();
    let inverse = DenseRoot::of(results.covariance.clone())?.inverse();
    let sums = inverse.column_sum();
    let slope = inverse.trace() - sums.dot(&sums) / sums.sum();
    let squared = (chi_squared - (n - 1) as f64) / slope;
    squared.is_finite().then_some(squared.max(0.0))
}

/// tau^2 of Mandel and Paule, at which chi-squared is n - 1; chi-squared decreases with tau. 0 if
/// chi-squared is not above n - 1 as stated.
fn iterated(results: &CorrelatedResults, everybody: &[usize]) -> Option<f64> {
    let expected = (results.values.len() - 1) as f64;
    let excess = |squared: f64| -> Option<f64> {
        let covariance = widened(results, squared);
        let taken = CorrelatedResults { values: results.values.clone(), covariance };
        Some(taken.reference(everybody)?.chi_squared - expected)
    };
    if excess(0.0)? <= 0.0 {
        return Some(0.0);
    }
    // with the squared range of the values as variance, chi-squared is below (n - 1)/2
    let [low, high] = results
        .values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)]);
    let (mut below, mut above) = (0.0, (high - low).powi(2));
    loop {
        let middle = 0.5 * below + 0.5 * above;
        if middle <= below || middle >= above {
            return Some(middle);
        }
        if excess(middle)? > 0.0 {
            below = middle;
        } else {
            above = middle;
        }
    }
}

/// The recommended estimator, and the reason in a sentence. If the results are consistent, nothing
/// needs to be added. If not, only evidence from the laboratories themselves can tell which of them
/// is wrong.
pub fn recommended(all: &ReferenceValue) -> (Estimator, &'static str) {
    if all.is_consistent() {
        let why = "use the weighted mean: the stated uncertainties explain the differences \
                   between the results, so nothing needs to be added to them";
        return (Estimator::WeightedMean, why);
    }
    if all.members.len() < 3 {
        let why = "use Mandel-Paule with care: two results cannot show which of them is wrong, \
                   and a variance from two results is very uncertain";
        return (Estimator::MandelPaule, why);
    }
    let why = "use Mandel-Paule: the stated uncertainties do not explain the differences and no \
               result is known to be wrong, so one variance between laboratories is added to all. \
               Use the largest consistent subset only if a technical reason excludes the others, \
               and Birge's ratio only if all uncertainties are too small by one factor. \
               DerSimonian-Laird is the first step towards Mandel-Paule";
    (Estimator::MandelPaule, why)
}

#[cfg(test)]
mod tests {
    use super::super::laboratories::{Laboratory, compare_by};
    use super::super::pair::StatedResult;
    use super::*;

    fn laboratories(results: &[(f64, f64)]) -> Vec<Laboratory> {
        let of = |(number, &(value, u)): (usize, &(f64, f64))| Laboratory {
            label: number.to_string(),
            result: StatedResult::new(value, 2.0 * u, 2.0),
        };
        results.iter().enumerate().map(of).collect()
    }

    fn value(results: &[(f64, f64)], estimator: Estimator) -> ConsensusValue {
        let found = compare_by(&laboratories(results), &[], Some(estimator)).unwrap();
        found.estimators.into_iter().find(|value| value.estimator == estimator).unwrap()
    }

    fn near(found: f64, expected: f64, tolerance: f64) {
        assert!((found - expected).abs() <= tolerance, "{found} and {expected}");
    }

    /// The CLASP trials of R. DerSimonian and R. Kacker, Contemp. Clin. Trials 28 (2007) 105,
    /// tables 3 and 4: logarithms of odds ratios from counts, so that the input has all digits. The
    /// tolerance is half a unit of the last printed digit.
    #[test]
    fn published_random_effects() {
        let (n1, n2) = (
            [156.0, 303.0, 565.0, 1570.0, 103.0, 4659.0],
            [74.0, 303.0, 477.0, 1565.0, 105.0, 4650.0],
        );
        let (a, c) = ([5.0, 5.0, 12.0, 69.0, 9.0, 313.0], [8.0, 17.0, 9.0, 94.0, 11.0, 352.0]);
        let results: Vec<(f64, f64)> = (0..6)
            .map(|i| {
                let [b, d] = [n1[i] - a[i], n2[i] - c[i]];
                let variance: f64 = 1.0 / a[i] + 1.0 / b + 1.0 / c[i] + 1.0 / d;
                (libm::log(a[i] * d / (b * c[i])), variance.sqrt())
            })
            .collect();
        for (estimator, tau, mean, u) in [
            (Estimator::MandelPaule, 0.3681, -0.3811, 0.2060),
            (Estimator::DerSimonianLaird, 0.2323, -0.3240, 0.1540),
        ] {
            let found = value(&results, estimator);
            near(found.tau.unwrap(), tau, 5e-5);
            near(found.reference.value, mean, 5e-5);
            near(found.reference.standard_uncertainty, u, 5e-5);
        }
    }

    /// Eleven values of the constant of gravitation in 1e-11 m^3 kg^-1 s^-2, against the formulas
    /// in sums over independent results, written in another language (agreement to 1e-9; the
    /// tolerance is that of the digits written here).
    #[test]
    fn values_of_the_constant_of_gravitation() {
        let results = [
            (6.67248, 0.00043),
            (6.6729, 0.0005),
            (6.67398, 0.00070),
            (6.674255, 0.000092),
            (6.67559, 0.00027),
            (6.67422, 0.00098),
            (6.67387, 0.00027),
            (6.67222, 0.00087),
            (6.67425, 0.00012),
            (6.67349, 0.00018),
            (6.67260, 0.00025),
        ];
        let birge = value(&results, Estimator::Birge);
        near(birge.birge_ratio.unwrap(), 3.272_947_23, 1e-7);
        near(birge.reference.value, 6.674_052_924_08, 1e-10);
        near(birge.reference.standard_uncertainty, 1.971_145_395_9e-4, 1e-12);
        let laird = value(&results, Estimator::DerSimonianLaird);
        near(laird.tau.unwrap(), 6.940_127_145e-4, 1e-11);
        near(laird.reference.value, 6.673_703_320_42, 1e-10);
        near(laird.reference.standard_uncertainty, 2.436_646_636e-4, 1e-12);
        let observed = laird.hartung_knapp.unwrap();
        near(observed.standard_uncertainty, 3.002_662_187e-4, 1e-12);
        assert_eq!(observed.dof, 10);
        // t for 95.45 % and 10 degrees of freedom (JCGM 100, table G.2)
        near(observed.coverage_factor, 2.28, 5e-3);
        let paule = value(&results, Estimator::MandelPaule);
        near(paule.tau.unwrap(), 8.981_807_203e-4, 1e-11);
        near(paule.reference.value, 6.673_677_537_69, 1e-10);
        near(paule.reference.standard_uncertainty, 3.016_245_755e-4, 1e-12);
        // chi-squared is n - 1, so that Hartung and Knapp's uncertainty is the same
        near(paule.hartung_knapp.unwrap().standard_uncertainty, 3.016_245_755e-4, 1e-12);
    }

    /// By hand: 0, 3, 6 with u = 1 have chi-squared 18, R = 3; tau^2 = (18 - 2)/(3 - 1) = 8, with
    /// which chi-squared is 18/9 = 2, so that both random-effects models agree.
    #[test]
    fn three_laboratories_by_hand() {
        let results = [(0.0, 1.0), (3.0, 1.0), (6.0, 1.0)];
        for estimator in [Estimator::Birge, Estimator::DerSimonianLaird, Estimator::MandelPaule] {
            let found = compare_by(&laboratories(&results), &[], Some(estimator)).unwrap();
            near(found.reference.value, 3.0, 1e-14);
            near(found.reference.standard_uncertainty, 3f64.sqrt(), 1e-14);
            // u(d)^2 = 9 - 3 with the widened uncertainty 3 of each
            near(found.rows[0].expanded, 2.0 * 6f64.sqrt(), 1e-13);
            assert!(found.rows.iter().all(|row| row.member));
        }
    }

    /// Results that agree better than stated get nothing, and correlated ones the same tau by both
    /// where all stated uncertainties are alike: with V = (1 - r) I + r 11' the common part moves
    /// the mean alone, chi-squared is 18/(1 - r), and (1 - r) + tau^2 = 9.
    #[test]
    fn nothing_is_added_to_consistent_results_and_correlations_count() {
        let close = [(0.0, 1.0), (0.3, 1.0), (0.6, 1.0)];
        assert_eq!(value(&close, Estimator::Birge).birge_ratio, Some(1.0));
        assert_eq!(value(&close, Estimator::DerSimonianLaird).tau, Some(0.0));
        assert_eq!(value(&close, Estimator::MandelPaule).tau, Some(0.0));
        let r = 0.4;
        let matrix: Vec<Vec<f64>> =
            (0..3).map(|i| (0..3).map(|j| if i == j { 1.0 } else { r }).collect()).collect();
        let apart = laboratories(&[(0.0, 1.0), (3.0, 1.0), (6.0, 1.0)]);
        for estimator in [Estimator::DerSimonianLaird, Estimator::MandelPaule] {
            let found = compare_by(&apart, &matrix, Some(estimator)).unwrap();
            let value = found.estimators.iter().find(|value| value.estimator == estimator);
            near(value.unwrap().tau.unwrap().powi(2), 8.4, 1e-12);
            // u^2 = (9 + 3 r)/3
            near(found.reference.standard_uncertainty, (3.0 + r).sqrt(), 1e-13);
        }
    }
}
