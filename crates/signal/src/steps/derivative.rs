//! Derivatives and integrals of a signal by its spectrum: velocity to acceleration (D'Emilia et al.,
//! 2019, section 2.1), angle to angular velocity and acceleration (Chiominto et al., 2024,
//! equations 2 and 3).

use std::f64::consts::TAU;

use crate::dirichlet::sum_of_cosines;
use crate::spectral::{Ends, multiplied};
use crate::unsuitable::within;
use crate::{Changed, Measured, NoiseGain, Phasor, Signal, Unsuitable, measured};

/// A derivative, an integral or two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivative {
    /// How many derivatives, from -4 to 4; integrals are negative.
    pub order: i32,
    /// The highest frequency that is kept, in hertz. A derivative makes noise grow with the
    /// frequency: a few times the highest frequency of interest is enough. Infinite: all are kept.
    pub highest: f64,
    /// What is done about leakage.
    pub ends: Ends,
}

impl Derivative {
    /// The complex gain at a frequency in hertz: (2 pi i f)^order, in the unit s^-order. Zero above
    /// the highest frequency and, as an integral's constant is not known, at zero.
    pub fn response(&self, frequency: f64) -> Phasor {
        if self.order == 0 && frequency <= self.highest {
            Phasor::new(1.0, 0.0)
        } else if frequency > 0.0 && frequency <= self.highest {
            let modulus = powered(TAU * frequency, self.order);
            match self.order.rem_euclid(4) {
                0 => Phasor::new(modulus, 0.0),
                1 => Phasor::new(0.0, modulus),
                2 => Phasor::new(-modulus, 0.0),
                _ => Phasor::new(0.0, -modulus),
            }
        } else {
            Phasor::new(0.0, 0.0)
        }
    }

    /// The derivative of a signal, in its unit times s^-order, with a mean of zero.
    ///
    /// # Errors
    /// An order beyond 4, what [`Ends`] does not fit the signal, values that are not finite.
    pub fn apply(&self, signal: &Signal) -> Result<Changed, Unsuitable> {
        within("the number of derivatives", f64::from(self.order), [-5.0, 5.0])?;
        multiplied(signal, self.ends, |f| self.response(f))
    }

    /// What the derivative of a signal of so many values at `rate` hertz makes of white noise.
    ///
    /// The standard uncertainty of the value at an instant is the square root of the power times
    /// the noise's standard deviation.
    pub fn noise(&self, samples: usize, rate: f64) -> NoiseGain {
        let n = samples as f64;
        let (mut power, mut fourth) = (0.0, 0.0);
        for j in 1..=samples / 2 {
            let twice = if 2 * j == samples { 1.0 } else { 2.0 };
            let square = self.response(j as f64 * rate / n).norm_sqr();
            power += twice * square / n;
            fourth += twice * square * square / n;
        }
        NoiseGain { power, fourth, level: self.response(0.0).norm_sqr() }
    }

    /// What the standard uncertainties of a sine fit to the derivative of so many values are to be
    /// multiplied by, for white noise before the step. Noise far from the component is so much
    /// stronger after a derivative (or, below it, after an integral) that what leaks of it into a fit
    /// over a partial period counts: this is the mean of the squared gain over Dirichlet's kernel
    /// about the frequency, in hertz, over the mean over all frequencies. The fit is better when it
    /// comes before the step, and [`Derivative::amplitude`] after it.
    pub fn noise_factor(&self, samples: usize, rate: f64, frequency: f64) -> f64 {
        let n = samples as f64;
        let sum: f64 = (1..=samples / 2)
            .map(|j| {
                let f = j as f64 * rate / n;
                let kernel = |away: f64| {
                    let part = sum_of_cosines(away / rate, samples as u64) / n;
                    part * part
                };
                self.response(f).norm_sqr() * (kernel(f - frequency) + kernel(f + frequency))
            })
            .sum();
        (sum / self.noise(samples, rate).power).sqrt()
    }

    /// The amplitude of the derivative of a component, by the law of propagation:
    /// A' = (2 pi f)^order A, and the relative variances u(A)^2 / A^2 and order^2 u(f)^2 / f^2 add
    /// up. Amplitude and frequency are independent, as they are in a sine fit. The phase rises by
    /// a quarter turn an order, without uncertainty.
    pub fn amplitude(&self, amplitude: Measured, frequency: Measured) -> Measured {
        let gain = powered(TAU * frequency.value, self.order);
        let of_frequency = f64::from(self.order) * gain * amplitude.value / frequency.value
            * frequency.standard_uncertainty;
        measured::of_parts(
            gain * amplitude.value,
            &[
                (gain * amplitude.standard_uncertainty, amplitude.degrees_of_freedom),
                (of_frequency.abs(), frequency.degrees_of_freedom),
            ],
        )
    }
}

/// `x` to a small whole power, by multiplication.
fn powered(x: f64, order: i32) -> f64 {
    let power = (0..order.unsigned_abs()).fold(1.0, |power, _| power * x);
    if order < 0 { 1.0 / power } else { power }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Noises, SETTINGS, Setting, study};
    use crate::{Harmonics, Periodic};

    fn sine(setting: Setting, noise: &mut Noises) -> Signal {
        let phase = 6.0 * noise.uniform();
        setting.record(noise, setting.sine(phase))
    }

    /// The derivative of two harmonics about an offset, to rounding, at any number of periods; the
    /// second derivative by way of the transform alone at whole periods; back by integration.
    #[test]
    fn derivatives_of_sines_are_exact() {
        let (rate, f) = (1000.0, 5.0);
        let wave = |t: f64| 0.7 + (TAU * f * t).cos() + 0.1 * (TAU * 2.0 * f * t + 1.0).sin();
        let slope =
            |t: f64| TAU * f * (-(TAU * f * t).sin() + 0.2 * (TAU * 2.0 * f * t + 1.0).cos());
        let bend = |t: f64| {
            (TAU * f).powi(2) * (-(TAU * f * t).cos() - 0.4 * (TAU * 2.0 * f * t + 1.0).sin())
        };
        let signal = |n: usize, wave: &dyn Fn(f64) -> f64| Signal {
            values: (0..n).map(|k| wave(k as f64 / rate)).collect(),
            rate,
            start: 0.0,
        };
        let step = |order, ends| Derivative { order, highest: f64::INFINITY, ends };
        let apart = |found: &Changed, expected: Signal| {
            let differences = found.signal.values.iter().zip(&expected.values);
            differences.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let harmonics = Ends::Periodic(Harmonics { frequency: f, count: 2 });
        // rounding of 1e-15 grows by up to 2 pi 500 = 3e3 an order
        let found = step(1, harmonics).apply(&signal(777, &wave)).unwrap();
        assert!(apart(&found, signal(777, &slope)) < 1e-10);
        let found = step(2, Ends::WholePeriods).apply(&signal(1000, &wave)).unwrap();
        assert!(apart(&found, signal(1000, &bend)) < 1e-6);
        let found = step(2, harmonics).apply(&signal(1333, &wave)).unwrap();
        assert!(apart(&found, signal(1333, &bend)) < 1e-6);
        let found = step(-2, harmonics).apply(&signal(777, &bend)).unwrap();
        assert!(apart(&found, signal(777, &|t| wave(t) - 0.7)) < 1e-10);
        // tapered: good to a part of a thousand in the middle half of many periods
        let found = step(1, Ends::Tapered(0.25)).apply(&signal(10_030, &wave)).unwrap();
        let inner = found.settled().unwrap();
        assert_eq!(inner.values.len(), 10_030 - 2 * 2508);
        for (k, value) in inner.values.iter().enumerate() {
            assert!((value - slope(inner.start + k as f64 / rate)).abs() < 0.031, "{k}");
        }
    }

    fn judge(setting: Setting, order: i32, recordings: usize) {
        let f = setting.frequency;
        let frequency =
            Measured { value: f, standard_uncertainty: 0.0, degrees_of_freedom: f64::INFINITY };
        let harmonics = Harmonics { frequency: f, count: 1 };
        let truth = (TAU * f).powi(order);
        let step = Derivative { order, highest: 60.0, ends: Ends::Periodic(harmonics) };
        study("derivative", recordings, |noise| {
            let fitted = Periodic::fit(&sine(setting, noise), harmonics).unwrap();
            let fitted = fitted.rounded_to(setting.step());
            (step.amplitude(fitted.parts[0].amplitude(), frequency), truth)
        })
        .is_right(&format!("derivative {order} of the amplitude"), Some(setting));
        if order > 0 {
            let factor = step.noise_factor(setting.samples(), setting.rate, f);
            study("derivative", recordings, |noise| {
                let signal = sine(setting, noise);
                let before = Periodic::fit(&signal, harmonics).unwrap();
                let changed = step.apply(&signal).unwrap();
                let fitted = Periodic::fit(&changed.signal, harmonics).unwrap();
                let mut part = fitted.in_noise(|_| factor, f64::INFINITY).parts[0];
                part.rounding = before.rounded_to(setting.step()).parts[0].rounding * truth;
                (part.amplitude(), truth)
            })
            .is_right(&format!("amplitude of the derivative {order}"), Some(setting));
        }
    }

    #[test]
    fn uncertainty_is_right_quick() {
        judge(SETTINGS[2], 2, 200);
        judge(SETTINGS[0], -1, 200);
    }

    #[test]
    #[ignore = "heavy: run by .ci/extra"]
    fn uncertainty_is_right() {
        for setting in SETTINGS {
            for order in [-1, 1, 2] {
                judge(setting, order, 1000);
            }
        }
    }

    /// The frequency's part: twice its relative uncertainty for a second derivative.
    #[test]
    fn frequency_counts_once_an_order() {
        let exactly = |value| Measured {
            value,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        };
        let frequency =
            Measured { value: 5.0, standard_uncertainty: 0.005, degrees_of_freedom: 9.0 };
        let step = Derivative { order: 2, highest: f64::INFINITY, ends: Ends::WholePeriods };
        let found = step.amplitude(exactly(0.3), frequency);
        assert!((found.standard_uncertainty / found.value - 0.002).abs() < 1e-15);
        assert!((found.degrees_of_freedom - 9.0).abs() < 1e-9);
    }
}
