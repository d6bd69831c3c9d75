//! Moments of the trials from their sums.

use super::plan::Reference;
use super::products::Products;
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
    pub(crate) shape_errors: Option<[f64; 2]>,
    /// Share of the trials within the tolerance limits.
    pub(crate) inside: f64,
}

impl Moments {
    /// The moments of all `parts` together, with the errors that their scatter gives, and the sums
    /// of all parts.
    pub(crate) fn of_parts<'s>(
        parts: impl Iterator<Item = (u64, &'s Sums)> + Clone,
        reference: Reference,
    ) -> (Self, Sums) {
        let mut total = Sums::default();
        let mut trials = 0;
        for (count, sums) in parts.clone() {
            trials += count;
            total.merge(sums);
        }
        let shape_errors = shape_errors(parts, reference);
        (Self { shape_errors, ..Self::new(trials, reference, &total) }, total)
    }

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
            shape_errors: None,
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

/// Numerical standard errors of skewness and excess kurtosis: their scatter between parts of the
/// trials, brought to all trials by the square-root law. They would need moments up to the eighth
/// otherwise. `None` with fewer than four parts of comparable size.
pub(crate) fn shape_errors<'s>(
    parts: impl Iterator<Item = (u64, &'s Sums)> + Clone,
    reference: Reference,
) -> Option<[f64; 2]> {
    let total: u64 = parts.clone().map(|(trials, _)| trials).sum();
    let largest = parts.clone().map(|(trials, _)| trials).max()?;
    let shapes: Vec<[f64; 2]> = parts
        .filter(|(trials, _)| 2 * trials > largest)
        .map(|(trials, sums)| {
            let moments = Moments::new(trials, reference, sums);
            [moments.skewness, moments.excess_kurtosis]
        })
        .collect();
    let n = shapes.len() as f64;
    let law = (largest as f64 / total as f64).sqrt();
    let error = |which: usize| {
        let mean = shapes.iter().map(|s| s[which]).sum::<f64>() / n;
        law * (shapes.iter().map(|s| (s[which] - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt()
    };
    (shapes.len() >= 4).then(|| [error(0), error(1)])
}

/// The correlation coefficients of all outputs i < j from their sums and the sums of products.
pub(super) fn correlations(trials: u64, totals: &[&Sums], products: &Products) -> Vec<f64> {
    let pairs = totals.iter().enumerate().flat_map(|(i, a)| {
        let others = totals[i + 1..].iter().zip(products.of(i));
        others.map(move |(b, &product)| correlation(trials, a, b, product))
    });
    pairs.collect()
}

/// The correlation coefficient of two outputs from their sums and the sum of their products.
fn correlation(trials: u64, a: &Sums, b: &Sums, product: f64) -> f64 {
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
