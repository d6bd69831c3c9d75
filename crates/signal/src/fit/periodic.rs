//! The periodic part of a signal: an offset and harmonics of a known frequency by least squares.
//!
//! It is the fit of [`ToneDesign`] with tones at multiples of one frequency, for signals in memory, with
//! what steps need of it: the model's values, each harmonic multiplied by a gain, and what is left of
//! the signal. Phases are those at the middle of the signal.

use crate::dirichlet::sum_of_cosines;
use crate::phasor;
use crate::phasor::Phasor;
use crate::quantization::{amplitude_error, quantization_variance};
use crate::residuals::KEPT;
use crate::sine_fit::{NoFit, Tone, ToneDesign};
use crate::spurious;
use crate::unsuitable::within;
use crate::{Measured, Signal, Unsuitable, measured};
use gumption_engine::number::elementary;

/// Turns over a signal within which what is left beside a harmonic is its own.
const OF_HARMONIC: f64 = 2.0;

/// What is sought in a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonics {
    /// The frequency of the first, in hertz; above zero.
    pub frequency: f64,
    /// How many, at once, twice, ... the frequency; at least one, all below half the rate.
    pub count: usize,
}

impl Harmonics {
    /// The design of their fit to so many samples.
    pub(crate) fn design(self, rate: f64, samples: usize) -> Result<ToneDesign, NoFit> {
        let turns = self.frequency / rate;
        let tone = |multiple: u32| Tone {
            cycles: turns * f64::from(multiple),
            fundamental: 0,
            multiple,
            beside: false,
        };
        let tones = (1..=self.count.max(1) as u32).map(tone).collect();
        ToneDesign::new(tones, samples as u64)
    }

    /// The first harmonic's phasor about the middle of so many values, and the variances of its real
    /// and imaginary part with white noise of variance 1.
    pub(crate) fn first_of(
        self,
        values: &[f64],
        rate: f64,
    ) -> Result<(Phasor, [f64; 2]), Unsuitable> {
        let samples = values.len();
        let design = self
            .design(rate, samples)
            .map_err(|_| Unsuitable::TooShort { samples, needed: samples + 1 })?;
        let fit = design.fit_values(values);
        let phasor = Phasor::new(fit.cosines[0], -fit.sines[0]);
        Ok((phasor, [design.even[(1, 1)], design.odd[(0, 0)]]))
    }
}

/// One harmonic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Its frequency, in hertz.
    pub frequency: f64,
    /// Its complex amplitude (peak) at the middle of the signal, in the signal's unit.
    pub phasor: Phasor,
    /// Standard uncertainties of the phasor's real and imaginary part from white noise.
    pub standard_uncertainty: [f64; 2],
    /// Degrees of freedom of both.
    pub degrees_of_freedom: f64,
    /// Standard uncertainty of the amplitude from what rounding to a resolution leaves in phase with
    /// the sine; zero as long as [`Periodic::rounded_to`] is not told of one.
    pub rounding: f64,
    /// Standard uncertainty of the phasor's real and imaginary part from oscillations that are not
    /// fitted; zero as long as [`Periodic::leaking`] has not looked for any.
    pub leakage: f64,
}

impl Harmonic {
    /// The peak amplitude, in the signal's unit.
    pub fn amplitude(&self) -> Measured {
        let (value, [x, y]) = (phasor::modulus(self.phasor), self.standard_uncertainty);
        let along = elementary::hypot(self.phasor.re * x, self.phasor.im * y);
        let of_noise = if value > 0.0 { along / value } else { x.max(y) };
        measured::of_parts(
            value,
            &[
                (of_noise, self.degrees_of_freedom),
                (self.rounding, f64::INFINITY),
                (self.leakage, f64::INFINITY),
            ],
        )
    }

    /// The phase at the middle of the signal, in radians, in (-pi, pi].
    pub fn phase(&self) -> Measured {
        let value = phasor::angle(self.phasor);
        if self.phasor.norm_sqr() == 0.0 {
            return Measured {
                value,
                standard_uncertainty: std::f64::consts::PI / 3f64.sqrt(),
                degrees_of_freedom: self.degrees_of_freedom,
            };
        }
        let of_noise = (self.of_phase(self.standard_uncertainty), self.degrees_of_freedom);
        let of_leakage = self.leakage / phasor::modulus(self.phasor);
        measured::of_parts(value, &[of_noise, (of_leakage, f64::INFINITY)])
    }

    /// What standard deviations of the phasor's real and imaginary part make of its phase, in radians.
    pub(crate) fn of_phase(&self, [x, y]: [f64; 2]) -> f64 {
        let across = elementary::hypot(self.phasor.im * x, self.phasor.re * y);
        across / self.phasor.norm_sqr()
    }
}

/// The noise near the harmonics of a signal, where it is not white.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HarmonicNoise {
    /// The variances of the cosine's and the sine's factor of each harmonic over those that white noise
    /// of the residuals' variance gives.
    pub(crate) factors: Vec<[f64; 2]>,
    /// Degrees of freedom of these.
    pub(crate) freedom: f64,
    /// Degrees of freedom of the residuals' variance.
    pub(crate) of_residuals: f64,
}

/// An offset and harmonics.
#[derive(Clone, Debug, PartialEq)]
pub struct Periodic {
    /// The mean, in the signal's unit, with white noise's standard uncertainty.
    pub offset: Measured,
    /// The harmonics, by rising frequency.
    pub parts: Vec<Harmonic>,
    /// The instant of the middle of the signal, in seconds, at which the phases are.
    pub middle: f64,
    /// Standard deviation of what is left of the signal, in its unit.
    pub residual: f64,
    /// Number of values and sampling rate of the signal.
    samples: usize,
    rate: f64,
}

impl Periodic {
    /// The harmonics of a signal by least squares.
    ///
    /// Source: IEEE Std 1057-2017, Annex A (three-parameter fit), ISO 16063-11:1999, 8.3.
    ///
    /// # Errors
    /// Less than one period, fewer values than parameters, a harmonic at or above half the rate,
    /// values that are not finite.
    pub fn fit(signal: &Signal, harmonics: Harmonics) -> Result<Self, Unsuitable> {
        let (count, samples) = (harmonics.count.max(1), signal.values.len());
        if let Some(sample) = signal.values.iter().position(|value| !value.is_finite()) {
            return Err(Unsuitable::NotFinite { sample });
        }
        let highest = signal.rate / 2.0 / count as f64;
        within("the frequency (Hz)", harmonics.frequency, [0.0, highest])?;
        let turns = harmonics.frequency / signal.rate; // a sample
        // a float above the largest count saturates, which is a recording too short as well
        let needed = (2 * count + 2).max((1.0 / turns).ceil() as usize);
        if samples < needed {
            return Err(Unsuitable::TooShort { samples, needed });
        }
        let design = harmonics
            .design(signal.rate, samples)
            .map_err(|_| Unsuitable::TooShort { samples, needed: samples + needed })?;
        let fit = design.fit_values(&signal.values);
        let freedom = (samples - 2 * count - 1) as f64;
        let mut periodic = Self {
            offset: Measured {
                value: fit.offset,
                standard_uncertainty: 0.0,
                degrees_of_freedom: freedom,
            },
            parts: (1..=count)
                .map(|h| Harmonic {
                    frequency: harmonics.frequency * h as f64,
                    phasor: Phasor::new(fit.cosines[h - 1], -fit.sines[h - 1]),
                    standard_uncertainty: [0.0; 2],
                    degrees_of_freedom: freedom,
                    rounding: 0.0,
                    leakage: 0.0,
                })
                .collect(),
            middle: signal.instant((samples - 1) as f64 / 2.0),
            residual: 0.0,
            samples,
            rate: signal.rate,
        };
        let left: f64 = periodic.without(signal).iter().map(|e| e * e).sum();
        periodic.residual = (left / freedom).sqrt();
        let u = |variance: f64| periodic.residual * variance.max(0.0).sqrt();
        periodic.offset.standard_uncertainty = u(design.even[(0, 0)]);
        let us: Vec<_> =
            (1..=count).map(|h| [u(design.even[(h, h)]), u(design.odd[(h - 1, h - 1)])]).collect();
        for (part, u) in periodic.parts.iter_mut().zip(us) {
            part.standard_uncertainty = u;
        }
        Ok(periodic)
    }

    /// The same in the noise that is known of the signal otherwise.
    pub(crate) fn in_known(mut self, noise: Option<&HarmonicNoise>) -> Self {
        let Some(noise) = noise else { return self };
        for (part, factors) in self.parts.iter_mut().zip(&noise.factors) {
            for (u, factor) in part.standard_uncertainty.iter_mut().zip(factors) {
                *u *= factor.sqrt();
            }
            part.degrees_of_freedom = noise.freedom;
        }
        self
    }

    /// The values of the model, without the offset, each harmonic multiplied by a complex number:
    /// `gain` of its frequency in hertz.
    pub fn values(&self, gain: impl Fn(f64) -> Phasor) -> Vec<f64> {
        let mut values = vec![0.0; self.samples];
        for part in &self.parts {
            add_turning(
                &mut values,
                part.phasor * gain(part.frequency),
                part.frequency / self.rate,
            );
        }
        values
    }

    /// What is left of the signal that was fitted.
    pub fn without(&self, signal: &Signal) -> Vec<f64> {
        let mut values = self.values(|_| Phasor::new(1.0, 0.0));
        for (value, x) in values.iter_mut().zip(&signal.values) {
            *value = x - self.offset.value - *value;
        }
        values
    }

    /// The same, with what rounding to steps of `resolution`, in the signal's unit, does to the first
    /// harmonic's amplitude beyond noise: where the noise is small against a step, rounding distorts
    /// the sine, in phase with it, in the same way in every period, so that it does not average out.
    ///
    /// This holds where the samples fall on ever other places of the period. If a few periods are a
    /// whole number of samples and the noise is below a third of a step, the same rounding errors
    /// come again and again, and the white noise's part of amplitude and phase is too small as well:
    /// by 10 % to 20 % at 201.5 samples a period, 21.7 periods and a noise of 0.23 steps.
    pub fn rounded_to(mut self, resolution: f64) -> Self {
        if resolution > 0.0 {
            let noise = self.residual * self.residual - quantization_variance(resolution);
            let part = &mut self.parts[0];
            let amplitude = phasor::modulus(part.phasor);
            part.rounding = amplitude_error(resolution, amplitude, noise.max(0.0).sqrt());
        }
        self
    }

    /// The same, with what oscillations that are not fitted do to the harmonics: those that stand out
    /// of the spectrum of what is left, two turns over the signal or more from each harmonic. What is
    /// nearer is left of the harmonic itself where the frequency is a little off.
    pub fn leaking(mut self, signal: &Signal) -> Self {
        let mut left = self.without(signal);
        left.truncate(KEPT);
        let mut beside = spurious::found(&left);
        beside.retain(|oscillation| {
            let turns = |part: &Harmonic| part.frequency / self.rate * left.len() as f64;
            let at = oscillation.cycles * left.len() as f64;
            self.parts.iter().all(|part| (turns(part) - at).abs() >= OF_HARMONIC)
        });
        for part in &mut self.parts {
            part.leakage =
                spurious::leakage(&beside, part.frequency / self.rate, self.samples as f64);
        }
        self
    }

    /// The same, with the standard uncertainties of all harmonics multiplied by a factor of their
    /// frequency in hertz: the square root of the noise's spectral density there over that of
    /// white noise with the same standard deviation.
    pub fn in_noise(mut self, factor: impl Fn(f64) -> f64, degrees_of_freedom: f64) -> Self {
        for part in &mut self.parts {
            part.standard_uncertainty =
                part.standard_uncertainty.map(|u| u * factor(part.frequency));
            part.degrees_of_freedom = degrees_of_freedom;
        }
        self
    }
}

const BLOCK: usize = 64;

/// exp(2 pi i `turns` j) for the places j of a block.
fn block_of(turns: f64) -> [Phasor; BLOCK] {
    std::array::from_fn(|j| phasor::at_turns(turns * j as f64))
}

/// The sum of `x_k` exp(-2 pi i `turns` k), k counted from the middle.
pub(crate) fn rotated_sum(values: &[f64], turns: f64) -> Phasor {
    let middle = (values.len() as f64 - 1.0) / 2.0;
    let table = block_of(-turns);
    let mut sum = Phasor::new(0.0, 0.0);
    for (b, block) in values.chunks(BLOCK).enumerate() {
        let (mut re, mut im) = (0.0, 0.0);
        for (x, e) in block.iter().zip(&table) {
            re += x * e.re;
            im += x * e.im;
        }
        let start = phasor::at_turns(-turns * ((b * BLOCK) as f64 - middle));
        sum += Phasor::new(re, im) * start;
    }
    sum
}

/// Adds the real part of `p` exp(2 pi i `turns` k), k counted from the middle.
fn add_turning(values: &mut [f64], p: Phasor, turns: f64) {
    let middle = (values.len() as f64 - 1.0) / 2.0;
    let table = block_of(turns);
    for (b, block) in values.chunks_mut(BLOCK).enumerate() {
        let start = p * phasor::at_turns(turns * ((b * BLOCK) as f64 - middle));
        for (x, e) in block.iter_mut().zip(&table) {
            *x += start.re * e.re - start.im * e.im;
        }
    }
}

/// The sum of squares that an offset and a sine of `turns` a value take out of values, beyond what
/// their mean does; zero where the fit is singular.
pub(crate) fn explained(centred: &[f64], turns: f64) -> f64 {
    let sum = rotated_sum(centred, turns);
    let n = centred.len() as u64;
    let (once, twice) = (sum_of_cosines(turns, n), sum_of_cosines(2.0 * turns, n));
    let n = n as f64;
    let cosines = f64::midpoint(n, twice) - once * once / n;
    let sines = (n - twice) / 2.0;
    if cosines > 0.0 && sines > 0.0 {
        sum.re * sum.re / cosines + sum.im * sum.im / sines
    } else {
        0.0
    }
}

/// The derivative of a fitted sine's values by its frequency in turns a value, at the fitted
/// frequency.
pub(crate) fn by_turns(periodic: &Periodic) -> Vec<f64> {
    let mut values = periodic.values(|_| Phasor::new(0.0, std::f64::consts::TAU));
    let middle = (values.len() as f64 - 1.0) / 2.0;
    for (k, value) in values.iter_mut().enumerate() {
        *value *= k as f64 - middle;
    }
    values
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::study::{COARSE, Noises, SETTINGS, Setting, study};

    /// Estimates, their covariance and the residuals against a least-squares solution by singular
    /// values of the written-out matrix, at lengths that are no whole number of periods; 1e-10.
    #[test]
    fn fit_is_least_squares() {
        let mut noise = Noises::new("least squares", 0);
        for (samples, f, count) in [(333, 3.7, 3), (1000, 1.1, 1), (64, 20.0, 2)] {
            let (rate, n) = (100.0, samples as f64);
            let values: Vec<f64> = (0..samples)
                .map(|k| 9.8 + (TAU * f * k as f64 / rate).cos() + 0.1 * noise.next())
                .collect();
            let signal = Signal { values: values.clone(), rate, start: 2.0 };
            let harmonics = Harmonics { frequency: f, count };
            let found = Periodic::fit(&signal, harmonics).unwrap();
            let matrix = DMatrix::from_fn(samples, 2 * count + 1, |k, j| {
                let angle = TAU * f * (k as f64 - (n - 1.0) / 2.0) / rate * j.div_ceil(2) as f64;
                if j % 2 == 0 { angle.cos() } else { -angle.sin() }
            });
            // columns: 1, then -sin and cos of each harmonic
            let solved = matrix.clone().svd(true, true);
            let expected = solved.solve(&DVector::from_vec(values), 1e-12).unwrap();
            let cofactor = (matrix.transpose() * &matrix).try_inverse().unwrap();
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-10, "{a} {b}");
            close(found.offset.value, expected[0]);
            for (h, part) in found.parts.iter().enumerate() {
                close(part.phasor.im, expected[2 * h + 1]);
                close(part.phasor.re, expected[2 * h + 2]);
                let u = |j: usize| found.residual * cofactor[(j, j)].sqrt();
                close(part.standard_uncertainty[1], u(2 * h + 1));
                close(part.standard_uncertainty[0], u(2 * h + 2));
            }
            close(found.middle, 2.0 + (n - 1.0) / 200.0);
        }
    }

    /// The sum that the search for a rate maximises is what the fit takes out.
    #[test]
    fn explained_is_what_the_fit_takes_out() {
        let mut noise = Noises::new("explained", 0);
        let signal = SETTINGS[0].record(&mut noise, SETTINGS[0].sine(1.0));
        let mean = signal.values.iter().sum::<f64>() / signal.values.len() as f64;
        let centred: Vec<f64> = signal.values.iter().map(|x| x - mean).collect();
        for f in [3.0, 5.0, 7.7] {
            let fit = Periodic::fit(&signal, Harmonics { frequency: f, count: 1 }).unwrap();
            let square = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>();
            let taken = square(&centred) - square(&fit.without(&signal));
            // sums of a thousand squares of about one
            assert!((explained(&centred, f / signal.rate) - taken).abs() < 1e-9);
        }
    }

    fn judge(setting: Setting, recordings: usize) {
        let harmonics = Harmonics { frequency: setting.frequency, count: 2 };
        for of_phase in [false, true] {
            // rounding's part alone is no normal error: 98.4 % of amplitudes are within 3 u
            if !of_phase && setting.sigma() < 0.1 * setting.step() && setting.bits < 16 {
                continue;
            }
            study("periodic", recordings, |noise| {
                let phase = 6.0 * noise.uniform();
                let signal = setting.record(noise, setting.sine(phase));
                let fit = Periodic::fit(&signal, harmonics).unwrap().rounded_to(setting.step());
                if of_phase {
                    let found = fit.parts[0].phase();
                    let truth = TAU * setting.frequency * fit.middle + phase;
                    (Measured { value: crate::wrapped(found.value - truth), ..found }, 0.0)
                } else {
                    (fit.parts[0].amplitude(), 1.0)
                }
            })
            .is_right(&format!("harmonics, phase {of_phase}"), Some(setting));
        }
    }

    #[test]
    fn uncertainty_is_right_quick() {
        judge(SETTINGS[0], 200);
        judge(SETTINGS[6], 200);
    }

    #[test]
    #[ignore = "heavy: run by .ci/extra"]
    fn uncertainty_is_right() {
        for setting in SETTINGS {
            judge(setting, 1000);
        }
        judge(COARSE, 1000); // phases
    }

    #[test]
    fn unfit_signals_are_refused() {
        let fit = |values: Vec<f64>, frequency| {
            let signal = Signal { values, rate: 100.0, start: 0.0 };
            Periodic::fit(&signal, Harmonics { frequency, count: 1 }).unwrap_err()
        };
        assert_eq!(fit(vec![0.0; 99], 1.0), Unsuitable::TooShort { samples: 99, needed: 100 });
        assert_eq!(
            fit(vec![0.0; 99], 50.0).to_string(),
            "the frequency (Hz) is 50, and must lie between 0 and 50"
        );
        assert_eq!(fit(vec![0.0, f64::NAN], 9.0), Unsuitable::NotFinite { sample: 1 });
        assert!(matches!(fit(Vec::new(), 9.0), Unsuitable::TooShort { .. }));
    }
}
