//! Recordings with known truth.

use std::f64::consts::PI;

use crate::{
    Amplitude, Channel, ChannelRecording, ChannelStep, Frequency, InMemorySamples, Measured,
    Method, Observation, PhaseUnit, RecipeSettings, TimeBase, observe,
};
use gumption_engine::distribution::{BLOCK, StreamKey};
use gumption_engine::special::normal;
use gumption_units::Unit;

/// Normal numbers, a function of the seed and the name.
pub(crate) fn normals(seed: u64, name: &str, count: usize) -> Vec<f64> {
    numbers(seed, name, count, normal::quantile)
}

/// Numbers whose distribution has this quantile, a function of the seed and the name.
fn numbers(seed: u64, name: &str, count: usize, quantile: fn(f64) -> f64) -> Vec<f64> {
    let key = StreamKey::new(seed, name);
    let mut numbers = Vec::with_capacity(count + BLOCK);
    for block in 0..count.div_ceil(BLOCK) {
        let mut uniform = [0.0; BLOCK];
        key.block(block as u64).uniform(&mut uniform);
        numbers.extend(uniform.map(quantile));
    }
    numbers.truncate(count);
    numbers
}

/// How recordings are made and evaluated.
#[derive(Clone, Debug)]
pub(super) struct Bench {
    pub(super) rate: f64,
    pub(super) hertz: f64,
    pub(super) samples: usize,
    /// Amplitudes and phases (radians, at instant 0) of the multiples 1, 2, ... of each channel.
    pub(super) channels: Vec<Vec<(f64, f64)>>,
    pub(super) offset: f64,
    pub(super) noise: f64,
    /// The quantile of its distribution, whose variance is 1.
    pub(super) shape: fn(f64) -> f64,
    /// Each value of noise is this much of the one before, and as much more new; at 1 a random walk
    /// from zero, whose steps have the standard deviation `noise`.
    pub(super) memory: f64,
    /// The correlation of the noise of every further channel with that of the first.
    pub(super) common: f64,
    pub(super) resolution: f64,
    /// The recipe does not know of the resolution.
    pub(super) hidden: bool,
    /// What is done with every channel.
    pub(super) steps: Vec<ChannelStep>,
    pub(super) jitter: f64,
    /// An oscillation that the recipe does not name: by so many hertz above it, of this amplitude in
    /// every channel, with a phase of its own in each.
    pub(super) beside: Option<(f64, f64)>,
    /// Standard uncertainties of frequency and rate, and what they really are off by, in units of
    /// that.
    pub(super) frequency_uncertainty: f64,
    pub(super) rate_uncertainty: f64,
    pub(super) estimate: bool,
    pub(super) method: Method,
    pub(super) trials: u64,
}

impl Default for Bench {
    fn default() -> Self {
        Self {
            rate: 1000.0,
            hertz: 10.3,
            samples: 2000,
            channels: vec![vec![(1.0, 0.3), (0.02, 1.0)], vec![(0.5, -1.2), (0.01, 0.4)]],
            offset: 0.7,
            noise: 0.01,
            shape: normal::quantile,
            memory: 0.0,
            common: 0.0,
            resolution: 0.0,
            hidden: false,
            steps: Vec::new(),
            jitter: 0.0,
            beside: None,
            frequency_uncertainty: 0.0,
            rate_uncertainty: 0.0,
            estimate: false,
            method: Method::SineFit,
            trials: 0,
        }
    }
}

impl Bench {
    pub(super) fn settings(&self) -> RecipeSettings {
        let channel = |number: usize| Channel {
            name: ["a", "b", "c"][number].into(),
            unit: Unit::one(),
            scale_uncertainty: 0.0,
            resolution: if self.hidden { 0.0 } else { self.resolution },
            // the reference has none of its own
            steps: self
                .steps
                .iter()
                .filter(|step| number > 0 || !step.needs_reference())
                .cloned()
                .collect(),
        };
        RecipeSettings {
            channels: (0..self.channels.len()).map(channel).collect(),
            reference: Some(0),
            components: vec![1, 2],
            harmonics: 3,
            method: self.method,
            amplitude: Amplitude::Peak,
            phase: PhaseUnit::Radian,
            trials: self.trials,
            seed: 1,
        }
    }

    /// The values of recording `seed`.
    pub(super) fn values(&self, seed: u64) -> InMemorySamples {
        let errors = normals(seed, "errors", 2);
        let hertz = self.hertz + self.frequency_uncertainty * errors[0];
        let rate = self.rate + self.rate_uncertainty * errors[1];
        let own = self.channels.iter().enumerate().map(|(number, _)| {
            // one value more: the state before the first sample
            numbers(seed, ["a", "b", "c"][number], self.samples + 1, self.shape)
        });
        let own: Vec<Vec<f64>> = own.collect();
        let channels = self.channels.iter().enumerate().map(|(number, tones)| {
            let name = ["a", "b", "c"][number];
            let share = if number == 0 { 0.0 } else { self.common };
            let rest = (1.0 - share * share).sqrt();
            let noise: Vec<f64> = own[number]
                .iter()
                .zip(&own[0])
                .map(|(own, first)| rest * own + share * first)
                .collect();
            let jitter = normals(seed, &format!("jitter {name}"), self.samples);
            let turn = normals(seed, &format!("beside {name}"), 1)[0];
            let beside = |t: f64| {
                let (hertz, amplitude) = self.beside.unwrap_or_default();
                amplitude * (2.0 * PI * ((self.hertz + hertz) * t + 5.0 * turn)).cos()
            };
            let walks = self.memory == 1.0;
            let mut last = if walks { 0.0 } else { noise[self.samples] };
            let grown = if walks { 1.0 } else { (1.0 - self.memory * self.memory).sqrt() };
            let value = |i: usize| {
                let t = i as f64 / rate + self.jitter * jitter[i];
                last = self.memory * last + grown * noise[i];
                let waves = tones.iter().enumerate().map(|(n, (amplitude, phase))| {
                    amplitude * (2.0 * PI * hertz * (n + 1) as f64 * t + phase).cos()
                });
                let value = self.offset + waves.sum::<f64>() + beside(t) + self.noise * last;
                if self.resolution > 0.0 {
                    (value / self.resolution).round() * self.resolution
                } else {
                    value
                }
            };
            (0..self.samples).map(value).collect()
        });
        InMemorySamples { channels: channels.collect() }
    }

    pub(super) fn observe(&self, held: InMemorySamples) -> Observation {
        let rate = Measured {
            value: self.rate,
            standard_uncertainty: self.rate_uncertainty,
            degrees_of_freedom: f64::INFINITY,
        };
        let base = TimeBase {
            rate,
            start: 0.0,
            jitter: self.jitter,
            beside_frequency: None,
            of_middle: None,
        };
        let channels = (0..held.channels.len()).collect();
        let frequency = Frequency {
            hertz: Some(self.hertz),
            standard_uncertainty: self.frequency_uncertainty,
            estimate: self.estimate,
        };
        let mut tracks = [ChannelRecording { passes: held, base, channels, search: None }];
        observe(&self.settings(), &[frequency], &mut tracks).unwrap()
    }
}
