//! The accelerations of a sensor on an oscillating table, from the angle that an encoder records.
//!
//! Source: Chiominto et al. (2024), equations (2) and (3), with the derivative of (3) carried out:
//! for an angle theta_0 cos(2 pi f t + phi) the tangential acceleration is
//! -r (2 pi f)^2 theta_0 cos(2 pi f t + phi) and the radial one, towards the axis,
//! r w_0^2 (1 - cos(2 (2 pi f t + phi))) / 2 with w_0 = 2 pi f theta_0. theta_0 is half of the
//! angle from end to end. All amplitudes are peak values.

use std::f64::consts::{PI, TAU};

use crate::derivative::Derivative;
use crate::{Changed, Ends, Measured, Signal, Unsuitable, measured, wrapped};

/// Where the sensor sits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Distance of the sensitive element from the axis, in metres.
    pub radius: Measured,
    /// Frequency of the oscillation, in hertz.
    pub frequency: Measured,
}

/// A component with amplitude and phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// Peak amplitude, in m/s^2.
    pub amplitude: Measured,
    /// Phase at the instant at which the angle's phase is, in radians, in (-pi, pi].
    pub phase: Measured,
}

/// The accelerations' components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accelerations {
    /// Tangential, at the frequency of the oscillation.
    pub tangential: Oscillation,
    /// Radial, at twice the frequency: r w_0^2 / 2.
    pub radial: Oscillation,
    /// Mean of the radial acceleration, in m/s^2: the same value as the amplitude.
    pub radial_mean: Measured,
    /// Coefficient of correlation of the tangential and the radial amplitude, which share radius,
    /// angle and frequency; zero where nothing is uncertain.
    pub correlation: f64,
}

impl Rotation {
    /// The accelerations of a sinusoidal oscillation with a peak amplitude theta_0 in radians and a
    /// phase in radians, by the law of propagation: relative variances of radius, of the angle (once
    /// for the tangential, twice for the radial amplitude) and of the frequency (twice) add up.
    pub fn accelerations(&self, angle: Measured, phase: Measured) -> Accelerations {
        let pulsation = TAU * self.frequency.value;
        let speed = pulsation * angle.value;
        let relative = |known: Measured| {
            let whole = if known.value == 0.0 { 1.0 } else { known.value };
            (known.standard_uncertainty / whole).abs()
        };
        let [r, a, f] = [self.radius, angle, self.frequency].map(relative);
        let amplitude = |value: f64, powers: [f64; 3]| {
            measured::of_parts(
                value,
                &[
                    (value.abs() * powers[0] * r, self.radius.degrees_of_freedom),
                    (value.abs() * powers[1] * a, angle.degrees_of_freedom),
                    (value.abs() * powers[2] * f, self.frequency.degrees_of_freedom),
                ],
            )
        };
        let radial = amplitude(self.radius.value * speed * speed / 2.0, [1.0, 2.0, 2.0]);
        let shared = r * r + 2.0 * a * a + 4.0 * f * f;
        let variances = (r * r + a * a + 4.0 * f * f) * (r * r + 4.0 * a * a + 4.0 * f * f);
        Accelerations {
            tangential: Oscillation {
                amplitude: amplitude(self.radius.value * pulsation * speed, [1.0, 1.0, 2.0]),
                phase: Measured { value: wrapped(phase.value + PI), ..phase },
            },
            radial: Oscillation {
                amplitude: radial,
                phase: Measured {
                    value: wrapped(2.0 * phase.value + PI),
                    standard_uncertainty: 2.0 * phase.standard_uncertainty,
                    ..phase
                },
            },
            radial_mean: radial,
            correlation: if variances > 0.0 { shared / variances.sqrt() } else { 0.0 },
        }
    }

    /// Tangential and radial acceleration, in m/s^2, of a recorded angle in radians of any course.
    /// What lies above `highest` hertz in the angle is left out. Harmonics of the angle are in both;
    /// the radial acceleration is a square, so noise of the velocity with variance s^2 adds r s^2 to
    /// its mean.
    ///
    /// # Errors
    /// As [`Derivative::apply`].
    pub fn signals(
        &self,
        angle: &Signal,
        highest: f64,
        ends: Ends,
    ) -> Result<[Changed; 2], Unsuitable> {
        let derivative = |order| Derivative { order, highest, ends }.apply(angle);
        let (mut radial, mut tangential) = (derivative(1)?, derivative(2)?);
        for value in &mut radial.signal.values {
            *value = self.radius.value * (*value * *value);
        }
        for value in &mut tangential.signal.values {
            *value *= self.radius.value;
        }
        Ok([tangential, radial])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Noises, Setting, study};
    use crate::{Harmonics, Periodic};

    fn measured(value: f64, standard_uncertainty: f64) -> Measured {
        Measured { value, standard_uncertainty, degrees_of_freedom: f64::INFINITY }
    }

    const TABLE: Rotation = Rotation {
        radius: Measured {
            value: 0.17,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        },
        frequency: Measured {
            value: 8.0,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        },
    };

    /// By hand, an oscillation of 6.5 deg at 8 Hz at a radius of 0.17 m: r theta w^2 and r (theta w)^2/2.
    /// The printed values of the source are with the model of the table.
    #[test]
    fn amplitudes_of_an_oscillation() {
        let found = TABLE.accelerations(measured(f64::to_radians(6.5), 0.0), measured(0.3, 0.0));
        assert!((found.tangential.amplitude.value - 48.728_086_374_017_86).abs() < 1e-12);
        assert!((found.radial.amplitude.value - 2.764_013_022_624_089).abs() < 1e-12);
    }

    /// Components of the accelerations' signals are those of the formulas, phases included.
    #[test]
    fn components_of_the_signals_are_the_formulas() {
        let theta = f64::to_radians(6.5);
        let values = (0..3000)
            .map(|k| theta * (TAU * 8.0 * f64::from(k) / 1000.0 + 0.4).cos() + 0.01)
            .collect();
        let angle = Signal { values, rate: 1000.0, start: 0.0 };
        let ends = Ends::Periodic(Harmonics { frequency: 8.0, count: 1 });
        let signals = TABLE.signals(&angle, 100.0, ends).unwrap();
        let of = |signal: &Signal| {
            let harmonics = Harmonics { frequency: 8.0, count: 2 };
            Periodic::fit(signal, harmonics).unwrap()
        };
        let at_middle = of(&angle).parts[0].phase();
        let expected = TABLE.accelerations(measured(theta, 0.0), at_middle);
        let tangential = of(&signals[0].signal).parts[0];
        let radial = of(&signals[1].signal);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
        close(tangential.amplitude().value, expected.tangential.amplitude.value);
        close(tangential.phase().value, expected.tangential.phase.value);
        close(radial.parts[1].amplitude().value, expected.radial.amplitude.value);
        close(radial.parts[1].phase().value, expected.radial.phase.value);
        close(radial.offset.value, expected.radial_mean.value);
    }

    /// Variances and correlation against 20 000 draws: a standard deviation has 0.5 %, a correlation
    /// 0.7 % at most; four of them.
    #[test]
    fn propagation_against_draws() {
        let (radius, theta, frequency) =
            (measured(0.17, 0.17 * 0.003), measured(0.1, 0.1 * 0.004), measured(8.0, 8.0 * 0.001));
        let found = Rotation { radius, frequency }.accelerations(theta, measured(0.0, 0.0));
        let mut noise = Noises::new("rotation", 1);
        let draws: Vec<[f64; 2]> = (0..20_000)
            .map(|_| {
                let mut draw = |m: Measured| m.value + m.standard_uncertainty * noise.next();
                let (r, t, w) = (draw(radius), draw(theta), TAU * draw(frequency));
                [
                    r * w * w * t - found.tangential.amplitude.value,
                    r * w * w * t * t / 2.0 - found.radial.amplitude.value,
                ]
            })
            .collect();
        let mean =
            |of: &dyn Fn(&[f64; 2]) -> f64| draws.iter().map(of).sum::<f64>() / draws.len() as f64;
        let (t, r) = (mean(&|d| d[0] * d[0]).sqrt(), mean(&|d| d[1] * d[1]).sqrt());
        assert!((t / found.tangential.amplitude.standard_uncertainty - 1.0).abs() < 0.02);
        assert!((r / found.radial.amplitude.standard_uncertainty - 1.0).abs() < 0.02);
        let correlation = mean(&|d| d[0] * d[1]) / (t * r);
        assert!((correlation - found.correlation).abs() < 0.02, "{correlation} {found:?}");
    }

    fn judge(setting: Setting, recordings: usize) {
        let harmonics = Harmonics { frequency: setting.frequency, count: 1 };
        let table = Rotation { frequency: measured(setting.frequency, 0.0), ..TABLE };
        let truth = table.accelerations(measured(1.0, 0.0), measured(0.0, 0.0));
        for radial in [false, true] {
            study("rotation", recordings, |noise| {
                let signal = setting.record(noise, setting.sine(1.0));
                let fitted = Periodic::fit(&signal, harmonics).unwrap();
                let part = fitted.rounded_to(setting.step()).parts[0];
                let found = table.accelerations(part.amplitude(), part.phase());
                if radial {
                    (found.radial.amplitude, truth.radial.amplitude.value)
                } else {
                    (found.tangential.amplitude, truth.tangential.amplitude.value)
                }
            })
            .is_right(&format!("rotating table, radial {radial}"), Some(setting));
        }
    }

    #[test]
    fn uncertainty_is_right_quick() {
        judge(crate::study::SETTINGS[0], 200);
    }

    #[test]
    #[ignore = "heavy: run by .ci/extra"]
    fn uncertainty_is_right() {
        for setting in crate::study::SETTINGS {
            judge(setting, 1000);
        }
    }
}
