//! Moments of the trials from their sums.

use super::plan::Reference;
use super::sums::Sums;

/// Mean, standard deviation and shape of one output's trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moments {
    pub(crate) trials: f64,
    pub(crate) mean: f64,
    /// Standard deviation with divisor M - 1 (JCGM 101, 7.6).
    pub(crate) std: f64,
    pub(crate) skewness: f64,
    pub(crate) excess_kurtosis: f64,
    /// Numerical standard errors of the two.
    pub(crate) shape_errors: [Option<f64>; 2],
    /// Share of the trials within the tolerance limits.
    pub(crate) inside: f64,
}

impl Moments {
    /// The moments of `trials` many values with these sums.
    pub(crate) fn new(trials: u64, reference: Reference, sums: &Sums) -> Self {
        let n = trials as f64;
        let [s1, s2, s3, s4] = sums.powers.map(|s| s / n);
        let m2 = f64::max(s2 - s1 * s1, 0.0);
        let m3 = s3 - 3.0 * s1 * s2 + 2.0 * s1 * s1 * s1;
        let m4 = s4 - 4.0 * s1 * s3 + 6.0 * s1 * s1 * s2 - 3.0 * (s1 * s1) * (s1 * s1);
        Self {
            trials: n,
            mean: reference.middle + reference.scale * s1,
            std: reference.scale * (m2 * n / (n - 1.0)).sqrt(),
            skewness: m3 / (m2 * m2.sqrt()),
            excess_kurtosis: m4 / (m2 * m2) - 3.0,
            shape_errors: [None; 2],
            inside: sums.inside as f64 / n,
        }
    }

    /// Numerical standard error of the mean (JCGM 101, 5.9.6 note).
    pub(crate) fn mean_error(&self) -> f64 {
        self.std / self.trials.sqrt()
    }

    /// Numerical standard error of the standard deviation: the variance of s^2 is
    /// (m4 - m2^2)/M to first order, and u = sqrt(s^2).
    pub(crate) fn std_error(&self) -> f64 {
        self.std * (f64::max(self.excess_kurtosis + 2.0, 0.0) / self.trials).sqrt() / 2.0
    }
}

/// The numerical standard error of a figure of all trials: its scatter between groups of them,
/// brought to all trials by the square-root law. `None` with fewer than four groups of comparable
/// size, and where the figure of all trials is more than that away from the mean of the groups: so it
/// is where few trials of a long tail carry it, which most groups have not seen, and all groups are
/// off together.
pub(super) fn group_error(groups: &[(u64, f64)], pooled: f64) -> Option<f64> {
    let total: u64 = groups.iter().map(|(trials, _)| trials).sum();
    let largest = groups.iter().map(|(trials, _)| *trials).max()?;
    let large = groups.iter().filter(|(trials, _)| 2 * trials > largest);
    let figures: Vec<f64> = large.map(|(_, figure)| *figure).collect();
    if figures.len() < 4 {
        return None;
    }
    let n = figures.len() as f64;
    let mean = figures.iter().sum::<f64>() / n;
    let variance = figures.iter().map(|figure| (figure - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let error = (largest as f64 / total as f64 * variance).sqrt();
    // figures that are the same but for rounding are known
    let rounding = 1e-12 * pooled.abs();
    ((pooled - mean).abs() <= error.max(rounding)).then_some(error)
}

/// The correlation coefficient of two outputs from their sums and the sum of their products.
pub(super) fn correlation(trials: u64, a: &Sums, b: &Sums, product: f64) -> f64 {
    let n = trials as f64;
    let (a1, b1) = (a.powers[0] / n, b.powers[0] / n);
    let (a2, b2) = (a.powers[1] / n - a1 * a1, b.powers[1] / n - b1 * b1);
    ((product / n - a1 * b1) / (a2 * b2).sqrt()).clamp(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::CodePath;

    /// Moments of the numbers 1 to 1000 about a middle far off, against their closed forms:
    /// variance (n^2 - 1)/12 with divisor n, excess kurtosis -6/5 (n^2 + 1)/(n^2 - 1).
    #[test]
    fn moments_of_consecutive_numbers() {
        let values: Vec<f64> = (1..=1000).map(f64::from).collect();
        let reference = Reference { middle: 480.0, scale: 300.0, limits: [11.0, 20.0] };
        let mut sums = Sums::default();
        sums.add(CodePath::BASELINE, &values[..617], reference);
        let mut rest = Sums::default();
        rest.add(CodePath::BASELINE, &values[617..], reference);
        sums.merge(&rest);
        let m = Moments::new(1000, reference, &sums);
        assert!((m.mean - 500.5).abs() < 1e-10);
        let variance: f64 = (1e6 - 1.0) / 12.0 * 1000.0 / 999.0;
        assert!((m.std - variance.sqrt()).abs() < 1e-10);
        assert_eq!(m.inside, 0.01);
        assert!(m.skewness.abs() < 1e-12);
        let kurtosis = -1.2 * (1e6 + 1.0) / (1e6 - 1.0);
        assert!((m.excess_kurtosis - kurtosis).abs() < 1e-12);
    }
}
