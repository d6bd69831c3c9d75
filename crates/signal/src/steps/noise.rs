//! The noise of a recording: how strong it is near a frequency, and what is known of it beforehand.

use crate::periodic::{Periodic, rotated_sum};
use crate::{Phasor, Signal, phasor};

/// What the standard uncertainty of a fitted component is taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Noise {
    /// All residuals: the noise is white. Degrees of freedom: values less parameters.
    White,
    /// The residuals' spectral density near the component, from so many frequencies (at least one)
    /// on each side of it, one part of the signal's length apart, the nearest left out. For noise
    /// of any colour that is even over these frequencies. Degrees of freedom: two a frequency.
    Near(usize),
}

impl Noise {
    /// The harmonics of a signal with their uncertainties in this noise.
    pub fn of(self, periodic: Periodic, signal: &Signal) -> Periodic {
        match self {
            Self::White => periodic,
            Self::Near(count) => {
                let residuals = periodic.without(signal);
                let white = periodic.residual;
                let mut freedom = f64::INFINITY;
                let mut factors = Vec::new();
                for part in &periodic.parts {
                    let near = density(&residuals, part.frequency / signal.rate, count.max(1));
                    freedom = freedom.min(near.degrees_of_freedom);
                    let factor = if white > 0.0 { near.variance.sqrt() / white } else { 1.0 };
                    factors.push((part.frequency, factor));
                }
                let factor =
                    |f: f64| factors.iter().find(|known| known.0 == f).map_or(1.0, |known| known.1);
                periodic.in_noise(factor, freedom)
            }
        }
    }
}

/// The spectral density of noise at a frequency, as the variance of the white noise that has it
/// everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NoiseDensity {
    pub(crate) variance: f64,
    pub(crate) degrees_of_freedom: f64,
}

/// The density near `turns` a value: the mean of the periodogram at `count` frequencies on each
/// side, as far as they lie between zero and half the rate.
pub(crate) fn density(residuals: &[f64], turns: f64, count: usize) -> NoiseDensity {
    let n = residuals.len() as f64;
    let (mut sum, mut taken) = (0.0, 0.0);
    for i in 0..count {
        let away = (i as f64 + 1.5) / n;
        for near in [turns - away, turns + away] {
            if near > 0.75 / n && near < 0.5 - 0.75 / n {
                let at: Phasor = rotated_sum(residuals, near);
                sum += at.norm_sqr() / n;
                taken += 1.0;
            }
        }
    }
    if taken == 0.0 {
        let variance = residuals.iter().map(|e| e * e).sum::<f64>() / n;
        return NoiseDensity { variance, degrees_of_freedom: 1.0 };
    }
    NoiseDensity { variance: sum / taken, degrees_of_freedom: 2.0 * taken }
}

/// The variance that sampling instants with a standard deviation of `jitter` seconds, independent
/// of each other, add to a sine of peak amplitude `amplitude` and `frequency` hertz:
/// (2 pi f A jitter)^2 / 2. To first order; the amplitude falls by
/// (2 pi f jitter)^2 / 2, relatively.
pub fn jitter_variance(amplitude: f64, frequency: f64, jitter: f64) -> f64 {
    let slope = std::f64::consts::TAU * frequency * amplitude * jitter;
    slope * slope / 2.0
}

/// What a linear step makes of white noise.
///
/// After the step the noise is not white any more, and a fit that takes it for white states a wrong
/// standard uncertainty. The right one is the stated one times [`NoiseGain::factor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseGain {
    /// Variance after the step over the variance before: the mean of the squared gain over all
    /// frequencies.
    pub power: f64,
    /// The mean of the gain's fourth power.
    pub fourth: f64,
    /// The squared gain at zero.
    pub level: f64,
}

impl NoiseGain {
    /// The square root of the noise's spectral density at a frequency over the density of white
    /// noise of the same variance, `response` being the step's complex gain there. The standard
    /// uncertainties of amplitude (before the gain is corrected for) and phase that a sine fit to
    /// many values after the step takes from its residuals are to be multiplied by it: above one
    /// within a filter's band, as the filter takes the noise elsewhere out of the residuals but
    /// not out of the amplitude.
    pub fn factor(self, response: Phasor) -> f64 {
        phasor::modulus(response) / self.power.sqrt()
    }

    /// The same for a three-parameter fit to so many values, and the degrees of freedom of the
    /// product. The noise has as many as white noise has that fills the step's band, n times the
    /// squared mean over the mean of the squares of its density, and the fit takes its share of the
    /// noise at zero and at the frequency out of the residuals, which counts where the band is
    /// narrow. At least one degree of freedom.
    pub fn of_fit(self, response: Phasor, samples: usize) -> (f64, f64) {
        let n = samples as f64;
        let density = response.norm_sqr();
        let left = n * self.power - 2.0 * density - self.level;
        let freedom = (n * self.power * self.power / self.fourth - 3.0).max(1.0);
        let least = n * self.power / (n * self.power * self.power / self.fourth).max(1.0);
        ((density * (n - 3.0).max(1.0) / left.max(least)).sqrt(), freedom)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::quantization_variance;
    use crate::study::Noises;

    /// White noise has its variance everywhere: 400 degrees of freedom are 7 %; four of them. An
    /// autoregressive process x' = 0.8 x + e has 1 / |1 - 0.8 exp(-i w)|^2.
    #[test]
    fn density_near_a_frequency() {
        let mut noise = Noises::new("density", 0);
        let white: Vec<f64> = (0..20_000).map(|_| noise.next()).collect();
        let found = density(&white, 0.1, 100);
        assert_eq!(found.degrees_of_freedom, 400.0);
        assert!((found.variance - 1.0).abs() < 0.28, "{found:?}");
        let mut x = 0.0;
        let red: Vec<f64> = white
            .iter()
            .map(|e| {
                x = 0.8 * x + e;
                x
            })
            .collect();
        for turns in [0.02f64, 0.1, 0.4] {
            let expected = 1.0 / (1.0 + 0.64 - 1.6 * (TAU * turns).cos());
            let ratio = density(&red, turns, 100).variance / expected;
            assert!((ratio - 1.0).abs() < 0.28, "{turns}: {ratio}");
        }
        // at the end of the spectrum only one side is there
        assert_eq!(density(&white, 0.0, 10).degrees_of_freedom, 20.0);
        assert_eq!(density(&white[..2], 0.1, 3).degrees_of_freedom, 1.0);
    }

    /// Rounding to steps of 0.1 and jitter of 0.1 ms at 5 Hz, against 20 000 values: 1 % each, four
    /// of them.
    #[test]
    fn quantization_and_jitter_add_their_variances() {
        let mut noise = Noises::new("jitter", 0);
        let (mut rounding, mut jitter) = (0.0, 0.0);
        for k in 0..20_000 {
            let t = f64::from(k) * 0.001_234;
            let value = (TAU * 5.0 * t).cos() + noise.next();
            rounding += ((value / 0.1).round() * 0.1 - value).powi(2) / 20_000.0;
            let moved = (TAU * 5.0 * (t + 1e-4 * noise.next())).cos() - (TAU * 5.0 * t).cos();
            jitter += (2.0 * moved).powi(2) / 20_000.0;
        }
        assert!((rounding / quantization_variance(0.1) - 1.0).abs() < 0.04);
        assert!((jitter / jitter_variance(2.0, 5.0, 1e-4) - 1.0).abs() < 0.06);
    }
}
