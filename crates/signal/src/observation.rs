//! What was found in recordings.

use super::Measured;
use super::spurious::Spurious;
use super::step::Finding;

/// A source of uncertainty of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Noise of the recording: what the fit leaves.
    Noise,
    /// Rounding to the resolution.
    Quantization,
    /// The instants of the samples scatter.
    Jitter,
    /// The frequency, stated or estimated.
    Frequency,
    /// The sampling rate.
    SamplingRate,
    /// Oscillations that are not fitted, and part periods.
    Leakage,
    /// The scale of the channel.
    Scale,
    /// The gain of a filter, by the frequency and the sampling rate.
    Filter,
    /// The gain of a derivative or an integral, by the frequency.
    Derivative,
    /// The radius of a rotation.
    Radius,
    /// The response that a signal was corrected for.
    Correction,
}

impl Source {
    /// The name in answers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::Quantization => "quantization",
            Self::Jitter => "jitter",
            Self::Frequency => "frequency",
            Self::SamplingRate => "sampling rate",
            Self::Leakage => "leakage",
            Self::Scale => "scale",
            Self::Filter => "filter",
            Self::Derivative => "derivative",
            Self::Radius => "radius",
            Self::Correction => "correction",
        }
    }
}

/// A value with what its uncertainty is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The value.
    pub measured: Measured,
    /// The standard uncertainty that each source contributes; they add as squares.
    pub contributions: Vec<(Source, f64)>,
    /// The standard uncertainty that trials over the recording's noise gave, where they were made.
    pub trials: Option<f64>,
    /// Whether the standard uncertainty is that of the trials, because the law of propagation does
    /// not hold (an amplitude near the noise).
    pub from_trials: bool,
}

impl Value {
    /// A value with its contributions, of which `noise_dof` are the degrees of freedom of the noise.
    pub fn new(value: f64, contributions: Vec<(Source, f64)>, noise_dof: f64) -> Self {
        let kept: Vec<(Source, f64)> =
            contributions.into_iter().filter(|(_, u)| *u > 0.0).collect();
        // a sum of nothing is -0
        let variance: f64 = kept.iter().map(|(_, u)| u * u).sum::<f64>() + 0.0;
        let noise: f64 =
            kept.iter().filter(|(source, _)| *source == Source::Noise).map(|(_, u)| u * u).sum();
        // a share of the noise below 1e-5 of the standard uncertainty is as good as none
        let negligible = noise <= 1e-10 * variance;
        let degrees_of_freedom = if negligible {
            f64::INFINITY
        } else {
            variance * variance / (noise * noise) * noise_dof
        };
        let measured =
            Measured { value, standard_uncertainty: variance.sqrt(), degrees_of_freedom };
        Self { measured, contributions: kept, trials: None, from_trials: false }
    }

    /// The same value with the unit's size taken out: everything times a positive factor.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.measured.value *= factor;
        self.measured.standard_uncertainty *= factor;
        for (_, u) in &mut self.contributions {
            *u *= factor;
        }
        self.trials = self.trials.map(|u| u * factor);
        self
    }

    /// Notes what trials gave; where it departs by more than a tenth, it is the standard
    /// uncertainty.
    pub(super) fn checked(mut self, by_trials: f64) -> Self {
        self.trials = Some(by_trials);
        let stated = self.measured.standard_uncertainty;
        if stated.is_nan() || (by_trials - stated).abs() > 0.1 * stated {
            self.measured.standard_uncertainty = by_trials;
            self.from_trials = true;
        }
        self
    }
}

/// An oscillation of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// Which multiple of the frequency it is.
    pub multiple: u32,
    /// Its frequency, in hertz.
    pub frequency: Measured,
    /// The amplitude, peak or RMS as the recipe says, in the channel's unit.
    pub amplitude: Value,
    /// The phase phi of A cos(2 pi f t + phi), less `multiple` times the phase of the reference where
    /// there is one, otherwise at the recording's instant 0; above -180 to 180 degrees, in the
    /// recipe's unit.
    pub phase: Value,
    /// The delay against the reference, -phase/(2 pi f), in seconds: positive for a channel that
    /// comes later. None without a reference, and for multiples other than 1.
    pub delay: Option<Value>,
}

/// What was found in one channel at one frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelObservation {
    /// The channel, by its place among those of the recipe.
    pub channel: usize,
    /// The frequency of the excitation in this recording, in hertz.
    pub frequency: Measured,
    /// The multiples of it that the recipe asks for.
    pub components: Vec<Component>,
    /// The constant part, in the channel's unit.
    pub offset: Value,
    /// Total harmonic distortion: the root of the sum of squares of the amplitudes of the multiples
    /// 2 and up, over the first's; a number. None if none of them is below half the sampling rate.
    pub distortion: Option<Value>,
    /// Signal-to-noise ratio: power of the first multiple over that of the residuals, in decibels.
    pub signal_to_noise: Value,
    /// Signal to noise and distortion: power of the first multiple over that of the residuals and of
    /// the multiples 2 and up, in decibels.
    pub sinad: Value,
    /// The number of periods.
    pub periods: Measured,
    /// Samples that were used.
    pub samples: u64,
    /// The sampling rate, in hertz.
    pub rate: Measured,
    /// The standard deviation of the residuals, in the channel's unit.
    pub noise: f64,
    /// The autocorrelation coefficient of the residuals at lag 1, and whether they are correlated.
    pub autocorrelation: (f64, bool),
    /// Oscillations that the fit does not have.
    pub spurious: Vec<Spurious>,
    /// What the channel's steps found.
    pub findings: Vec<Finding>,
}

/// What was found in one row of a recipe.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// For each frequency, the channels in their order.
    pub frequencies: Vec<Vec<ChannelObservation>>,
    /// What to bear in mind: a fixed short name, the channel, and the sentence.
    pub notes: Vec<(&'static str, usize, String)>,
}
