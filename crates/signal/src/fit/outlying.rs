//! Samples far beyond the rest: spikes, and numbers that stand for a missing value.

use gumption_engine::number::{largest_first, median};

/// Residuals that are kept at most.
const KEPT: usize = 32;

/// Robust standard deviations beyond which a sample is named, and how many may be there: more of them
/// are noise with long tails. Of normal noise one sample in 8e14 is beyond, so that of records of a
/// million samples one in 8e8 has such a note without a cause.
const FAR: f64 = 8.0;
const FEW: usize = 8;

/// The same where there are more: a number for a missing value, many times in a record.
const VERY_FAR: f64 = 50.0;

/// Residuals that a robust standard deviation is taken from at least.
const LEAST: usize = 64;

/// The standard deviation of normal noise over the median of its magnitude.
const NORMAL: f64 = 1.482_602_218_505_602;

/// Beside the largest value less is rounding of the fit.
const ROUNDING: f64 = 1e-9;

/// A sample, what the fit leaves of it, and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outlying {
    pub(crate) sample: u64,
    pub(crate) residual: f64,
    pub(crate) value: f64,
}

/// The residuals of a record that are farthest from zero.
#[derive(Clone, Debug, Default)]
pub(crate) struct Farthest {
    kept: Vec<Outlying>,
    /// What a residual must be beyond to be kept.
    least: f64,
}

impl Farthest {
    /// Looks at the next residuals; `first` is the number of their first sample.
    pub(crate) fn add(&mut self, first: u64, values: &[f64], residuals: &[f64]) {
        for ((sample, value), residual) in (first..).zip(values).zip(residuals) {
            if residual.abs() > self.least {
                self.kept.push(Outlying { sample, residual: *residual, value: *value });
                if self.kept.len() >= 2 * KEPT {
                    self.sort();
                    self.least = self.kept.last().map_or(0.0, |outlying| outlying.residual.abs());
                }
            }
        }
    }

    fn sort(&mut self) {
        largest_first(&mut self.kept, |a| a.residual.abs());
        self.kept.truncate(KEPT);
    }

    /// The few samples that are far beyond the rest, the farthest first, and the robust standard
    /// deviation of the residuals (from the median of the magnitude of the `first` of them), or the
    /// `resolution` where that is more. None where there are many, as long-tailed noise has them.
    pub(crate) fn few(&self, first: &[f64], resolution: f64) -> Option<(Vec<Outlying>, f64)> {
        if first.len() < LEAST {
            return None;
        }
        let median = median(first.iter().map(|residual| residual.abs()).collect())?;
        let mut sorted = self.clone();
        sorted.sort();
        let largest = sorted.kept.iter().map(|outlying| outlying.value.abs()).fold(0.0, f64::max);
        let deviation = (NORMAL * median).max(resolution).max(ROUNDING * largest);
        let beyond = |far: f64| {
            sorted
                .kept
                .iter()
                .take_while(|outlying| outlying.residual.abs() > far * deviation)
                .count()
        };
        let (far, very_far) = (beyond(FAR), beyond(VERY_FAR));
        let count = if far <= FEW { far } else { very_far };
        if count == 0 || count >= KEPT {
            return None;
        }
        sorted.kept.truncate(count);
        Some((sorted.kept, deviation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::simulated::normals;

    fn few(residuals: &[f64], resolution: f64) -> Option<(Vec<Outlying>, f64)> {
        let mut farthest = Farthest::default();
        for (block, values) in residuals.chunks(1000).enumerate() {
            farthest.add(block as u64 * 1000, values, values);
        }
        farthest.few(residuals, resolution)
    }

    #[test]
    fn spikes_are_found_and_noise_has_none() {
        let plain = normals(1, "spikes", 50_000);
        assert!(few(&plain, 0.0).is_none());
        let mut spiked = plain.clone();
        (spiked[4321], spiked[31]) = (-20.0, 9.0);
        let (found, deviation) = few(&spiked, 0.0).unwrap();
        assert!((deviation - 1.0).abs() < 0.02, "{deviation}");
        let samples: Vec<u64> = found.iter().map(|of| of.sample).collect();
        assert_eq!(samples, [4321, 31]);
        // within three steps of a coarse resolution nothing is far
        assert!(few(&spiked, 7.0).is_none());
        assert!(few(&spiked[..60], 0.0).is_none());
    }

    #[test]
    fn long_tails_are_no_spikes_but_missing_values_are() {
        // -ln of even numbers with a sign: beyond 8 x 1.48 x ln 2 = 8.2 lies exp(-8.2), 14 of 50 000
        let even = |i: usize| (i * 7919 % 50_021) as f64 / 50_021.0 + 1e-5;
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let laplace: Vec<f64> = (0..50_000).map(|i| -sign(i) * even(i).ln()).collect();
        assert!(few(&laplace, 0.0).is_none());
        let mut missing = normals(1, "missing", 50_000);
        (0..20).for_each(|i| missing[i * 1777] = 9999.0);
        assert_eq!(few(&missing, 0.0).unwrap().0.len(), 20);
    }
}
