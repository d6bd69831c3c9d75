//! The fit of a channel with what surrounds it.

use std::f64::consts::PI;
use std::rc::Rc;

use super::Measured;
use super::beside::{Besides, amplitude};
use super::drift;
use super::effects::Effects;
use super::known_noise::KnownNoise;
use super::quantization::quantization_variance;
use super::recipe::{RecipeSettings, TimeBase};
use super::residuals::Residuals;
use super::rounding::{Rounding, noise_before};
use super::sine_fit::{ToneCoefficients, ToneDesign};
use super::spurious::Spurious;
use super::trace::RecordTrace;
use gumption_engine::number::elementary::{exp, hypot, sinh};

/// Instants at which the range of a drift is looked for.
const DRIFT_PLACES: u32 = 256;

/// A frequency in a recording.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fundamental {
    /// Cycles in a sample interval that are fitted.
    pub(super) cycles: f64,
    /// Cycles in a sample interval by which phases go on from the middle of the record: the same, but
    /// for a cut at whole samples.
    pub(super) turning: f64,
    /// In hertz.
    pub(super) hertz: Measured,
    /// Whether the frequency is stated, and not found in the recording.
    pub(super) is_stated: bool,
    /// The standard uncertainty of the cycles from a stated frequency.
    pub(super) of_stated: f64,
    /// The same from noise, where the cycles are the recording's own.
    pub(super) of_estimate: f64,
    /// The same from the sampling rate, for a stated frequency.
    pub(super) of_rate: f64,
    /// The same from cutting at whole samples.
    pub(super) of_cut: f64,
}

impl Fundamental {
    /// Takes the cycles that the recording itself tells, with their variance for residuals of variance
    /// 1. Bins stay where they are.
    pub(super) fn move_to(&mut self, cycles: f64, variance: f64) {
        self.turning = cycles;
        if self.of_cut > 0.0 {
            self.of_cut = (cycles - self.cycles).abs();
        } else {
            self.cycles = cycles;
        }
        (self.of_stated, self.of_rate, self.of_estimate) = (0.0, 0.0, variance.sqrt());
    }
}

/// A channel's fit with what surrounds it.
#[derive(Clone, Debug)]
pub(super) struct Analysed {
    pub(super) channel: usize,
    /// Which analysis it comes from: channels of one share their estimated frequency.
    pub(super) track: usize,
    /// Which clock: channels of one share the error of the sampling rate.
    pub(super) clock: usize,
    pub(super) base: TimeBase,
    pub(super) design: Rc<ToneDesign>,
    pub(super) fit: ToneCoefficients,
    pub(super) residuals: Residuals,
    pub(super) fundamentals: Vec<Fundamental>,
    /// Oscillations in what the fit leaves.
    pub(super) spurious: Vec<Spurious>,
    /// Oscillations that nobody named and that are fitted.
    pub(super) besides: Besides,
    /// The resolution of the values, stated or seen; 0 where it is not known.
    pub(super) resolution: f64,
    /// What rounding to it does, where noise does not blur it.
    pub(super) rounding: Option<Rounding>,
    /// What the channel's steps did.
    pub(super) effects: Rc<Effects>,
    /// What figures show of it, where they were asked for.
    pub(super) trace: Option<RecordTrace>,
}

impl Analysed {
    /// Takes what rounding does into account.
    pub(super) fn rounded(mut self) -> Self {
        if self.resolution > 0.0 && self.residuals.known.is_none() {
            let before = self.noise_before_rounding();
            self.rounding = Rounding::of(&self.design, &self.fit, self.resolution, before);
        }
        self
    }

    /// The standard deviation of the noise before rounding.
    pub(super) fn noise_before_rounding(&self) -> f64 {
        let residuals = &self.residuals;
        let left = residuals.variance;
        noise_before(&self.design, &self.fit, self.resolution, left, &residuals.first)
    }

    /// The oscillations that nobody named: cycles in a sample interval and peak amplitude.
    pub(super) fn fitted_besides(&self) -> impl Iterator<Item = Spurious> {
        let tones = self.design.tones.iter().enumerate().filter(|(_, tone)| tone.beside);
        tones.map(|(place, tone)| Spurious {
            cycles: tone.cycles,
            amplitude: amplitude(&self.fit, place),
            fitted: true,
        })
    }

    /// How far the level drifts over the record, in the channel's unit: greatest less least.
    pub(super) fn drift_range(&self) -> f64 {
        let last = self.design.samples.saturating_sub(1) as f64;
        let places =
            (0..=DRIFT_PLACES).map(|place| last * f64::from(place) / f64::from(DRIFT_PLACES));
        let levels = places.map(|at| drift::at(&self.fit.drift, self.design.samples, at));
        let (least, greatest) = levels
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), level| (a.min(level), b.max(level)));
        greatest - least
    }

    /// The mean square of the drift over the record.
    pub(super) fn drift_power(&self) -> f64 {
        let degrees = self.fit.drift.iter().zip(1_u32..);
        degrees.map(|(factor, degree)| factor * factor / f64::from(2 * degree + 1)).sum()
    }

    /// The peak amplitude of the strongest tone.
    pub(super) fn strongest(&self) -> f64 {
        let tones = self.fit.cosines.iter().zip(&self.fit.sines);
        tones.map(|(a, b)| hypot(*a, *b)).fold(0.0, f64::max)
    }
}

/// Shares of the residuals' variance that are known to be quantization and jitter.
pub(super) fn shares(analysed: &Analysed) -> [f64; 2] {
    if let Some(known) = &analysed.residuals.known {
        return known.shares;
    }
    let variance = analysed.residuals.variance;
    if variance <= 0.0 {
        return [0.0, 0.0];
    }
    let quantization = (quantization_variance(analysed.resolution) / variance).min(1.0);
    let jitter: f64 = (0..analysed.design.tones.len())
        .map(|tone| {
            let speed = speed(analysed, tone) * analysed.base.jitter;
            let (a, b) = (analysed.fit.cosines[tone], analysed.fit.sines[tone]);
            // half the square of the amplitude before the jitter blurred it, times what it lost
            let half = speed * speed / 2.0;
            exp(half) * sinh(half) * (a * a + b * b)
        })
        .sum();
    [quantization, (jitter / variance).min(1.0 - quantization)]
}

/// The angular frequency of a tone, in radians a second.
pub(super) fn speed(analysed: &Analysed, tone: usize) -> f64 {
    2.0 * PI * analysed.design.tones[tone].cycles * analysed.base.rate.value
}

/// The variances of the cosine's and the sine's factor of a tone over those that white noise of the
/// same variance gives, where the residuals are not white and the record tells; else 1.
pub(super) fn local(residuals: &Residuals, tone: usize) -> [f64; 2] {
    if let Some(KnownNoise { factors: Some(factors), .. }) = &residuals.known {
        return factors.get(tone).copied().unwrap_or([1.0; 2]);
    }
    match &residuals.local {
        Some(local) if residuals.correlated => local.get(tone).copied().unwrap_or([1.0; 2]),
        _ => [1.0; 2],
    }
}

/// The unit of a channel's values before its steps have none of their own, with a blank before it.
pub(super) fn unit_text(settings: &RecipeSettings, of: &Analysed) -> String {
    let channel = &settings.channels[of.channel];
    let unit = channel.unit.text();
    if unit.is_empty() || unit == "1" || !channel.steps.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}
