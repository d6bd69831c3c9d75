//! What the steps of a channel did to its oscillations and to its noise: the gains that amplitudes
//! and phases are divided by, the contributions to their uncertainty, and the spectral density of
//! noise whose density before the steps is known.

use std::f64::consts::PI;

use super::budget::UncertaintySource;
use super::dirichlet::sum_of_cosines;
use super::{Correction, Derivative, Filter, Measured, Phasor, phasor};
use gumption_engine::number::elementary;

/// Frequencies at which a spectral density is looked at; longer records have them evenly spaced on a
/// logarithmic scale.
const NODES: usize = 1 << 14;

/// Bins about a tone that are all looked at.
const NEAR: usize = 256;

/// What one step did.
#[derive(Clone, Debug, PartialEq)]
pub enum StepEffect {
    /// A filter ran over the signal.
    Filtered {
        /// The filter.
        filter: Filter,
        /// Whether amplitudes and phases are divided by its gain.
        correct: bool,
    },
    /// Derivatives or integrals, times a factor.
    Derived {
        /// The derivative.
        derivative: Derivative,
        /// The factor: the radius, or one unit in another.
        factor: f64,
        /// The relative standard uncertainty of the factor: that of the radius.
        of_radius: f64,
    },
    /// The square of the angular velocity, times a factor: a radial acceleration.
    Squared {
        /// The derivative that makes the velocity.
        derivative: Derivative,
        /// The factor: the radius, in the unit of the answer.
        factor: f64,
        /// The relative standard uncertainty of the radius.
        of_radius: f64,
        /// Peak angular velocity.
        speed: f64,
        /// Frequency of the velocity, in hertz.
        frequency: f64,
    },
    /// The signal was divided by a known response.
    Corrected {
        /// The correction.
        correction: Correction,
        /// The relative standard uncertainty of the response's gain.
        of_gain: f64,
        /// The standard uncertainty of its phase, in radians.
        of_phase: f64,
        /// The standard uncertainty of its delay, in seconds.
        of_delay: f64,
    },
}

/// All that the steps of a channel did, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Effects(pub(super) Vec<StepEffect>);

/// What is left of noise after the steps.
#[derive(Clone, Debug)]
pub(super) struct Coloured {
    /// Its variance.
    pub(super) power: f64,
    /// The degrees of freedom of that: as many as white noise has that fills the same band.
    pub(super) freedom: f64,
    /// For each frequency that was asked for, the variance of the white noise that a fit there
    /// would take it for.
    pub(super) densities: Vec<f64>,
}

impl Effects {
    /// What the phasor of a tone at a frequency in hertz is still to be divided by.
    pub(super) fn left(&self, frequency: f64) -> Phasor {
        let one = Phasor::new(1.0, 0.0);
        self.0.iter().fold(one, |gain, effect| match effect {
            StepEffect::Filtered { filter, correct: true } => gain * filter.response(frequency),
            _ => gain,
        })
    }

    /// Contributions to a tone: source, relative to the amplitude, and to the phase in radians.
    /// `frequency` is the tone's in hertz, `rate` the relative standard uncertainty of the sampling
    /// rate.
    pub(super) fn contributions(
        &self,
        frequency: Measured,
        rate: f64,
    ) -> Vec<(UncertaintySource, f64, f64)> {
        let relative = frequency.standard_uncertainty / frequency.value;
        let mut found = Vec::new();
        for effect in &self.0 {
            match effect {
                StepEffect::Filtered { filter, .. } => {
                    let passage = filter.passage(frequency, rate);
                    let gain = passage.gain;
                    let of_gain =
                        if gain.value > 0.0 { gain.standard_uncertainty / gain.value } else { 0.0 };
                    found.push((
                        UncertaintySource::Filter,
                        of_gain,
                        passage.phase.standard_uncertainty,
                    ));
                }
                StepEffect::Derived { derivative, of_radius, .. } => {
                    let times = f64::from(derivative.order).abs();
                    found.push((UncertaintySource::Derivative, times * relative, 0.0));
                    found.push((UncertaintySource::Radius, *of_radius, 0.0));
                }
                StepEffect::Squared { derivative, of_radius, .. } => {
                    let times = 2.0 * f64::from(derivative.order).abs();
                    found.push((UncertaintySource::Derivative, times * relative, 0.0));
                    found.push((UncertaintySource::Radius, *of_radius, 0.0));
                }
                StepEffect::Corrected { of_gain, of_phase, of_delay, .. } => {
                    let turned = 2.0 * PI * frequency.value * of_delay;
                    found.push((
                        UncertaintySource::Correction,
                        *of_gain,
                        elementary::hypot(*of_phase, turned),
                    ));
                }
            }
        }
        found
    }

    /// The power of the channel's scale that amplitudes have: 2 after a square.
    pub(super) fn power_of_scale(&self) -> f64 {
        let squares = self.0.iter().filter(|effect| matches!(effect, StepEffect::Squared { .. }));
        2f64.powi(squares.count() as i32)
    }

    /// What white noise of variance 1, or a tone of amplitude 1, has of power after the steps at a
    /// frequency in hertz.
    pub(super) fn power_gain(&self, frequency: f64) -> f64 {
        density(&self.0, &|_| 1.0, frequency)
    }

    /// Noise after the steps, in a record of so many values at `rate` hertz; `before` is the spectral
    /// density before them at a frequency in hertz, as the variance of the white noise that has it
    /// everywhere.
    pub(super) fn coloured(
        &self,
        before: &dyn Fn(f64) -> f64,
        samples: u64,
        rate: f64,
        frequencies: &[f64],
    ) -> Coloured {
        let half = samples / 2;
        let n = samples as f64;
        let bin = rate / n;
        // (bin, how many it stands for)
        let nodes: Vec<(f64, f64)> = if half as usize <= NODES {
            (1..=half).map(|j| (j as f64, if 2 * j == samples { 0.5 } else { 1.0 })).collect()
        } else {
            let step = elementary::ln(half as f64) / NODES as f64;
            let at = |i: f64| elementary::exp(step * i).min(half as f64);
            (0..=NODES)
                .map(|i| {
                    let i = i as f64;
                    (at(i), at(i + 0.5) - if i > 0.0 { at(i - 0.5) } else { 0.5 })
                })
                .collect()
        };
        let densities: Vec<f64> =
            nodes.iter().map(|(j, _)| density(&self.0, before, j * bin)).collect();
        let all = || nodes.iter().zip(&densities);
        let power: f64 = all().map(|((_, many), d)| 2.0 * many * d / n).sum();
        let fourth: f64 = all().map(|((_, many), d)| 2.0 * many * d * d / n).sum();
        let kernel = |apart: f64| {
            let part = sum_of_cosines(apart / n, samples) / n;
            part * part
        };
        let at = |frequency: f64| {
            if frequency == 0.0 {
                // the mean over a record: a sixth of the kernel about zero is beyond its main lobe
                let sides = all().map(|((j, many), d)| {
                    let size = n * phasor::at_turns(j / 2.0 / n).im;
                    many * d / (size * size)
                });
                return density(&self.0, before, 0.0) * 5.0 / 6.0 + sides.sum::<f64>();
            }
            let place = frequency / bin;
            let middle = place.round();
            let sin = phasor::at_turns((place / 2.0).fract()).im;
            let envelope = |apart: f64| {
                let size = n * phasor::at_turns(apart / 2.0 / n).im;
                sin * sin / (size * size)
            };
            let exact = half as usize <= NODES;
            let far: f64 = all()
                .map(|((j, many), d)| {
                    if exact {
                        many * d * (kernel(j - place) + kernel(j + place))
                    } else if (j - middle).abs() > NEAR as f64 {
                        many * d * (envelope(j - place) + envelope(j + place))
                    } else {
                        0.0
                    }
                })
                .sum();
            let near = |j: f64| {
                density(&self.0, before, j * bin) * (kernel(j - place) + kernel(j + place))
            };
            let least = (middle - NEAR as f64).max(1.0) as u64;
            let most = (middle + NEAR as f64) as u64;
            far + if exact { 0.0 } else { (least..=most).map(|j| near(j as f64)).sum() }
        };
        Coloured {
            power,
            freedom: if fourth > 0.0 { n * power * power / fourth } else { n },
            densities: frequencies.iter().map(|f| at(*f)).collect(),
        }
    }
}

/// The spectral density at a frequency in hertz after steps, of noise with the density `source` before
/// them. A gain of zero lets nothing pass, be it of a walk, whose density has no limit at zero.
fn density(effects: &[StepEffect], source: &dyn Fn(f64) -> f64, frequency: f64) -> f64 {
    let Some((last, before)) = effects.split_last() else { return source(frequency) };
    let through = |gain: f64, f: f64| {
        if gain > 0.0 { gain * density(before, source, f) } else { 0.0 }
    };
    match last {
        StepEffect::Filtered { filter, .. } => {
            through(filter.response(frequency).norm_sqr(), frequency)
        }
        StepEffect::Derived { derivative, factor, .. } => {
            through(derivative.response(frequency).norm_sqr() * factor * factor, frequency)
        }
        StepEffect::Squared { derivative, factor, speed, frequency: of_speed, .. } => {
            // 2 r w(t) n(t): the noise of both frequencies that differ from it by that of w
            let side = |f: f64| through(derivative.response(f).norm_sqr(), f);
            let size = factor * speed;
            size * size * (side((frequency - of_speed).abs()) + side(frequency + of_speed))
        }
        StepEffect::Corrected { correction, .. } => {
            through(correction.gain(frequency).norm_sqr(), frequency)
        }
    }
}
