//! Simulated recordings, and whether a step's standard uncertainties are right over many of them.
//!
//! A study runs a step on independent recordings whose truth is known and asks two questions: how
//! many errors are beyond 3 u, and how the standard deviation of the errors compares with u. Over
//! 1,000 recordings of a right u with many degrees of freedom, more than 1 % of errors beyond 3 u
//! have a probability below 2e-4 (Poisson, 2.7 expected), a ratio off by more than 10 % one of 8e-6
//! (its standard deviation is 2.2 %). Over 200, the limits of the quick forms: more than 5 errors,
//! 2e-5 (0.54 expected); 18 %, 3e-4. Seeds are fixed, so a test that passes once passes always.

use std::f64::consts::TAU;

use super::{Measured, Signal};
use gumption_engine::distribution::{Normal, StreamKey};
use gumption_engine::number::{COLUMN, Column, elementary};

/// What a recording is like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    pub(super) rate: f64,
    /// Of the wanted sine, in hertz.
    pub(super) frequency: f64,
    pub(super) periods: f64,
    /// Power of a sine of amplitude one over that of the noise, in decibels.
    pub(super) snr: f64,
    /// Of the converter, whose range is from -1.25 to 1.25 about the offset, within 10 %.
    pub(super) bits: i32,
}

/// SNR, periods and bits as the studies have them: the corners, and the seeds' settings. Where
/// rounding counts, a period must not be a simple number of samples, or rounding errors repeat
/// instead of averaging out: 201.618 samples here, 201.5 would make u 10 % to 20 % too small.
pub(super) const SETTINGS: [Setting; 7] = [
    setting(5.0, 3.3, 20.0, 16),
    setting(8.0, 400.0, 20.0, 24),
    setting(10.0, 37.5, 40.0, 12),
    setting(5.0, 200.0, 60.0, 16),
    setting(8.0, 3.0, 100.0, 24),
    setting(10.0, 400.0, 100.0, 24),
    Setting { rate: 1612.944, ..setting(8.0, 21.7, 50.0, 8) },
];

/// Noise far below a step of the converter: what rounding leaves is not noise but harmonics.
pub(super) const COARSE: Setting = Setting { rate: 1612.944, ..setting(8.0, 200.7, 100.0, 8) };

const fn setting(frequency: f64, periods: f64, snr: f64, bits: i32) -> Setting {
    Setting { rate: 1612.0, frequency, periods, snr, bits }
}

impl Setting {
    pub(super) fn samples(self) -> usize {
        (self.periods * self.rate / self.frequency).round() as usize
    }

    pub(super) fn sigma(self) -> f64 {
        (0.5 * elementary::pow(10.0, -self.snr / 10.0)).sqrt()
    }

    /// The converter's step.
    pub(super) fn step(self) -> f64 {
        2.5 / 2f64.powi(self.bits)
    }

    /// What the signal is, at the instants of the recording, with the setting's noise, rounded by
    /// the converter, about an offset of 0.3.
    pub(super) fn record(self, noise: &mut Noises, wave: impl Fn(f64) -> f64) -> Signal {
        // so that where the sine's ends lie within a step differs from recording to recording
        let step = self.step() * (0.9 + 0.2 * noise.uniform());
        let sigma = self.sigma();
        let values = (0..self.samples())
            .map(|k| {
                let value = 0.3 + wave(k as f64 / self.rate) + sigma * noise.next();
                (value / step).round() * step
            })
            .collect();
        Signal { values, rate: self.rate, start: 0.0 }
    }

    /// A sine A cos(2 pi f t + phase) of amplitude one.
    pub(super) fn sine(self, phase: f64) -> impl Fn(f64) -> f64 {
        move |t| elementary::cos(TAU * (self.frequency * t % 1.0) + phase)
    }
}

/// Standard normal numbers, one after the other.
pub(super) struct Noises {
    stream: gumption_engine::distribution::Stream,
    column: Column,
    next: usize,
}

impl Noises {
    pub(crate) fn new(name: &str, seed: u64) -> Self {
        let stream = StreamKey::new(seed, name).block(0);
        Self { stream, column: Column([0.0; COLUMN]), next: COLUMN }
    }

    pub(super) fn next(&mut self) -> f64 {
        if self.next == COLUMN {
            Normal::standard_draw(&mut self.stream, &mut self.column);
            self.next = 0;
        }
        self.next += 1;
        self.column.0[self.next - 1]
    }

    /// A number between 0 and 1.
    pub(crate) fn uniform(&mut self) -> f64 {
        let mut out = [0.0; 8];
        self.stream.uniform(&mut out);
        out[0]
    }
}

/// Errors of one figure over many recordings, beside the standard uncertainties stated for it.
#[derive(Debug, Default)]
pub(super) struct Errors {
    errors: Vec<f64>,
    stated: Vec<f64>,
}

/// Runs a step on recordings; it gets random numbers and gives what it found and the truth.
pub(super) fn study(
    name: &str,
    recordings: usize,
    step: impl Fn(&mut Noises) -> (Measured, f64),
) -> Errors {
    let mut errors = Errors::default();
    for i in 0..recordings {
        let (found, truth) = step(&mut Noises::new(name, i as u64));
        errors.add(found, truth);
    }
    errors
}

impl Errors {
    pub(super) fn add(&mut self, found: Measured, truth: f64) {
        self.errors.push(found.value - truth);
        self.stated.push(found.standard_uncertainty);
    }

    /// The root mean square of the errors over their standard uncertainties.
    pub(super) fn score(&self) -> f64 {
        let squares = self.errors.iter().zip(&self.stated).map(|(error, u)| {
            let score = error / u;
            score * score
        });
        (squares.sum::<f64>() / self.errors.len() as f64).sqrt()
    }

    fn mean_uncertainty(&self) -> f64 {
        self.stated.iter().sum::<f64>() / self.stated.len() as f64
    }

    /// The root mean square of the errors over the mean standard uncertainty.
    pub(super) fn ratio(&self) -> f64 {
        let squares: f64 = self.errors.iter().map(|error| error * error).sum();
        (squares / self.errors.len() as f64).sqrt() / self.mean_uncertainty()
    }

    /// Passes, or says what it found; prints it for a whole study. With little noise in a
    /// converter's step, u may be too large: the distortion that rounding leaves is in the residuals,
    /// but hardly pulls a phase or a rate.
    pub(super) fn is_right(&self, what: &str, setting: Option<Setting>) {
        let n = self.errors.len();
        let inside = |(error, u): &(&f64, &f64)| error.abs() < 3.0 * **u;
        let beyond = n - self.errors.iter().zip(&self.stated).filter(inside).count();
        let (mean, ratio) = (self.mean_uncertainty(), self.ratio());
        println!("{what}, {setting:?}: {beyond} of {n} beyond 3 u, ratio {ratio:.3}, u {mean:.3e}");
        let (most, off) = if n < 1000 { (n / 40, 0.18) } else { (n / 100, 0.1) };
        let coarse = setting.is_some_and(|s| s.bits == 8 && s.sigma() < 0.1 * s.step());
        let least = if coarse { 0.0 } else { 1.0 - off };
        assert!(beyond <= most, "{what}, {setting:?}: {beyond} of {n} beyond 3 u");
        assert!((least..=1.0 + off).contains(&ratio), "{what}, {setting:?}: ratio {ratio}");
    }
}
