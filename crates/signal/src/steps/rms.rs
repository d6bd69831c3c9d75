//! Root mean squares, and how much smaller the difference of two signals is after a correction.

use crate::noise::{Noise, density};
use crate::periodic::{HarmonicNoise, Harmonics, Periodic};
use crate::residuals::{kurtosis, variance_of_power};
use crate::{Measured, Signal, Unsuitable, measured};

/// Frequencies from which the density of squares at zero is taken: 64 degrees of freedom.
const NEAR_ZERO: usize = 32;

/// Root mean squares of a signal, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rms {
    /// Of all that is not the mean: periodic part and noise.
    pub alternating: Measured,
    /// Of the periodic part alone: sqrt of the sum of the squared peak amplitudes over two, without
    /// what noise adds to the squares. None where no harmonics were asked for.
    pub periodic: Option<Measured>,
    /// The mean, in the signal's unit.
    pub mean: f64,
}

/// What is known of a signal whose root mean square is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RmsOf {
    /// The harmonics of a periodic signal; none where it is all noise.
    pub harmonics: Option<Harmonics>,
    /// What the uncertainty of the harmonics is taken from.
    pub noise: Noise,
    /// The step that the values are rounded to, in the signal's unit; zero where it does not matter.
    pub resolution: f64,
}

impl RmsOf {
    /// The root mean square of a signal about its mean.
    ///
    /// With harmonics the signal is a periodic part, whose mean square is that of whole periods
    /// whatever the length, and noise. Their uncertainties: those of the amplitudes, and of the
    /// noise's variance (kurtosis - 1) sigma^4 over its degrees of freedom in white noise, or the squared
    /// residuals' spectral density at zero over the number of values. Without harmonics the signal
    /// is taken for noise and the uncertainty is of the latter kind; of a sine it then lacks the
    /// effect of a partial period, up to 1 / (4 pi) of the mean square over the number of periods.
    ///
    /// # Errors
    /// Fewer than 4 values, values that are not finite, harmonics that cannot be fitted.
    pub fn rms(self, signal: &Signal) -> Result<Rms, Unsuitable> {
        self.rms_in(signal, None)
    }

    /// The same in the noise that is known of the signal otherwise.
    pub(crate) fn rms_in(
        self,
        signal: &Signal,
        known: Option<&HarmonicNoise>,
    ) -> Result<Rms, Unsuitable> {
        rms(signal, self, known)
    }
}

fn rms(
    signal: &Signal,
    RmsOf { harmonics, noise, resolution }: RmsOf,
    known: Option<&HarmonicNoise>,
) -> Result<Rms, Unsuitable> {
    let n = signal.values.len();
    if n < 4 {
        return Err(Unsuitable::TooShort { samples: n, needed: 4 });
    }
    if let Some(sample) = signal.values.iter().position(|value| !value.is_finite()) {
        return Err(Unsuitable::NotFinite { sample });
    }
    let Some(harmonics) = harmonics else {
        let mean = signal.values.iter().sum::<f64>() / n as f64;
        let left: Vec<f64> = signal.values.iter().map(|x| x - mean).collect();
        let square = mean_of_squares(&left, (n - 1) as f64, Noise::Near(NEAR_ZERO));
        return Ok(Rms { alternating: root(square), periodic: None, mean });
    };
    let fitted = noise.of(Periodic::fit(signal, harmonics)?, signal).in_known(known);
    let fitted = fitted.rounded_to(resolution);
    let left = fitted.without(signal);
    let freedom = (n - 1 - 2 * fitted.parts.len()) as f64;
    let mut rest = mean_of_squares(&left, freedom, noise);
    if let Some(known) = known {
        let relative = variance_of_power(kurtosis(&left), known.of_residuals);
        rest.standard_uncertainty = rest.value * relative.sqrt();
        rest.degrees_of_freedom = known.of_residuals;
    }
    let mut square = 0.0;
    let mut parts = Vec::new();
    for part in &fitted.parts {
        let [x, y] = part.standard_uncertainty;
        square += (part.phasor.norm_sqr() - x * x - y * y) / 2.0;
        let amplitude = part.amplitude();
        let u = amplitude.value * amplitude.standard_uncertainty;
        parts.push((u, amplitude.degrees_of_freedom));
    }
    let periodic = measured::of_parts(square.max(0.0), &parts);
    parts.push((rest.standard_uncertainty, rest.degrees_of_freedom));
    let all = measured::of_parts(square.max(0.0) + rest.value, &parts);
    let mean = fitted.offset.value;
    Ok(Rms { alternating: root(all), periodic: Some(root(periodic)), mean })
}

/// The mean square of noise.
fn mean_of_squares(left: &[f64], freedom: f64, noise: Noise) -> Measured {
    let n = left.len() as f64;
    let value = left.iter().map(|e| e * e).sum::<f64>() / freedom;
    match noise {
        Noise::White => Measured {
            value,
            standard_uncertainty: value * variance_of_power(kurtosis(left), freedom).sqrt(),
            degrees_of_freedom: freedom,
        },
        Noise::Near(_) => {
            let squares: Vec<f64> = left.iter().map(|e| e * e - value).collect();
            let near = density(&squares, 0.0, NEAR_ZERO);
            Measured {
                value,
                standard_uncertainty: (near.variance / n).sqrt(),
                degrees_of_freedom: near.degrees_of_freedom,
            }
        }
    }
}

/// The root of a square with u(x) = u(x^2) / (2 x); of zero, the root of u.
fn root(square: Measured) -> Measured {
    let value = square.value.sqrt();
    let u = square.standard_uncertainty;
    Measured {
        value,
        standard_uncertainty: if value > 0.0 { u / (2.0 * value) } else { u.sqrt() },
        degrees_of_freedom: square.degrees_of_freedom,
    }
}

/// A signal against a reference before and after a correction (D'Emilia et al., 2019, section 3.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RmsReduction {
    /// Root mean square of the difference from the reference before, about its mean.
    pub before: Measured,
    /// The same after.
    pub after: Measured,
    /// 1 - after / before; the uncertainty takes the two for independent, which overstates it where
    /// they have noise in common.
    pub reduction: Measured,
}

/// How much nearer a correction brings a signal to a reference, all three sampled together.
///
/// # Errors
/// Signals of different lengths or rates; as [`RmsOf::rms`].
pub fn improvement(
    reference: &Signal,
    before: &Signal,
    after: &Signal,
    of: RmsOf,
) -> Result<RmsReduction, Unsuitable> {
    improvement_in(reference, before, after, of, |_| None)
}

/// The same in the noise that is known of the differences.
pub(crate) fn improvement_in(
    reference: &Signal,
    before: &Signal,
    after: &Signal,
    of: RmsOf,
    known: impl Fn(&Signal) -> Option<HarmonicNoise>,
) -> Result<RmsReduction, Unsuitable> {
    let difference = |signal: &Signal| {
        together(reference, signal)?;
        let pairs = signal.values.iter().zip(&reference.values);
        let values = pairs.map(|(x, r)| x - r).collect();
        let left = Signal { values, ..*reference };
        Ok(of.rms_in(&left, known(&left).as_ref())?.alternating)
    };
    let (before, after) = (difference(before)?, difference(after)?);
    if before.value == 0.0 {
        return Err(Unsuitable::Silent { frequency: of.harmonics.map_or(0.0, |h| h.frequency) });
    }
    let ratio = after.value / before.value;
    let reduction = measured::of_parts(
        1.0 - ratio,
        &[
            (after.standard_uncertainty / before.value, after.degrees_of_freedom),
            (ratio * before.standard_uncertainty / before.value, before.degrees_of_freedom),
        ],
    );
    Ok(RmsReduction { before, after, reduction })
}

/// Two signals have the same number of values and the same rate.
pub(crate) fn together(a: &Signal, b: &Signal) -> Result<(), Unsuitable> {
    if a.values.len() == b.values.len() && a.rate == b.rate {
        Ok(())
    } else {
        Err(Unsuitable::NotTogether {
            samples: [a.values.len(), b.values.len()],
            rates: [a.rate, b.rate],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Noises, SETTINGS, Setting, study};

    fn of(harmonics: Option<Harmonics>, resolution: f64) -> RmsOf {
        RmsOf { harmonics, noise: Noise::White, resolution }
    }

    fn judge(setting: Setting, recordings: usize) {
        let harmonics = Harmonics { frequency: setting.frequency, count: 1 };
        let step = setting.step();
        let added = setting.sigma().powi(2) + step * step / 12.0;
        for periodic in [false, true] {
            study("rms", recordings, |noise| {
                let phase = 6.0 * noise.uniform();
                let signal = setting.record(noise, setting.sine(phase));
                let found = of(Some(harmonics), setting.step()).rms(&signal).unwrap();
                if periodic {
                    (found.periodic.unwrap(), 0.5f64.sqrt())
                } else {
                    (found.alternating, (0.5 + added).sqrt())
                }
            })
            .is_right(&format!("rms, periodic {periodic}"), Some(setting));
        }
    }

    /// Coloured noise without a sine: an autoregressive signal x' = 0.9 x + e, of variance
    /// 1 / (1 - 0.81).
    fn judge_noise(recordings: usize) {
        study("rms of noise", recordings, |noise| {
            let mut x = noise.next() / 0.19f64.sqrt();
            let values = (0..6000)
                .map(|_| {
                    x = 0.9 * x + noise.next();
                    x
                })
                .collect();
            let signal = Signal { values, rate: 1000.0, start: 0.0 };
            (of(None, 0.0).rms(&signal).unwrap().alternating, 1.0 / 0.19f64.sqrt())
        })
        .is_right("rms of coloured noise", None);
    }

    #[test]
    fn uncertainty_is_right_quick() {
        judge(SETTINGS[0], 200);
        judge_noise(200);
    }

    #[test]
    #[ignore = "heavy: run by .ci/extra"]
    fn uncertainty_is_right() {
        for setting in SETTINGS {
            judge(setting, 1000);
        }
        judge_noise(1000);
    }

    /// Of a sine of amplitude 2 and its third harmonic of 0.5 about 9.8, at 3.4 periods:
    /// sqrt((4 + 0.25) / 2), to rounding.
    #[test]
    fn partial_periods_do_not_count() {
        let values = (0..680)
            .map(|k| {
                let turn = std::f64::consts::TAU * 0.005 * f64::from(k);
                9.8 + 2.0 * turn.cos() + 0.5 * (3.0 * turn + 1.0).sin()
            })
            .collect();
        let signal = Signal { values, rate: 200.0, start: 0.0 };
        let harmonics = Some(Harmonics { frequency: 1.0, count: 3 });
        let found = of(harmonics, 0.0).rms(&signal).unwrap();
        assert!((found.alternating.value - 2.125f64.sqrt()).abs() < 1e-12);
        assert!((found.periodic.unwrap().value - 2.125f64.sqrt()).abs() < 1e-12);
        assert!((found.mean - 9.8).abs() < 1e-12);
    }

    /// A phase error phi of a sine of amplitude A leaves a difference of 2 A sin(phi / 2); after the
    /// correction only noise of sigma is left. 15 deg, as in D'Emilia et al. (2019).
    #[test]
    fn improvement_of_a_corrected_phase() {
        let phase = 15f64.to_radians();
        let wave = |shift: f64| {
            move |k: i32| (std::f64::consts::TAU * 0.5 * f64::from(k) / 100.0 - shift).cos()
        };
        let mut noise = Noises::new("improvement", 0);
        let noise: Vec<f64> = (0..2000).map(|_| 0.1 * noise.next()).collect();
        let signal = |shift: f64, with: f64| Signal {
            values: (0..2000).map(|k| wave(shift)(k) + with * noise[k as usize]).collect(),
            rate: 100.0,
            start: 0.0,
        };
        let harmonics = Some(Harmonics { frequency: 0.5, count: 1 });
        let found = improvement(
            &signal(0.0, 0.0),
            &signal(phase, 1.0),
            &signal(0.0, 1.0),
            of(harmonics, 0.0),
        )
        .unwrap();
        let before = (0.5 * (2.0 * (phase / 2.0).sin()).powi(2) + 0.01).sqrt();
        let off = |m: Measured, truth: f64| (m.value - truth).abs() / m.standard_uncertainty;
        assert!(off(found.before, before) < 4.0, "{found:?}");
        assert!(off(found.after, 0.1) < 4.0);
        assert!(off(found.reduction, 1.0 - 0.1 / before) < 4.0);
        let short = Signal { values: vec![0.0; 10], rate: 100.0, start: 0.0 };
        assert!(matches!(
            improvement(&signal(0.0, 0.0), &short, &short, of(None, 0.0)),
            Err(Unsuitable::NotTogether { .. })
        ));
    }
}
