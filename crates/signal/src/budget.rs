//! Values with what their uncertainty is made of.

use super::Measured;

/// A source of uncertainty of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UncertaintySource {
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
    /// The drift of a level over the record, of which no level is the one.
    Drift,
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

impl UncertaintySource {
    /// The name in answers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::Quantization => "quantization",
            Self::Jitter => "jitter",
            Self::Frequency => "frequency",
            Self::SamplingRate => "sampling rate",
            Self::Leakage => "leakage",
            Self::Drift => "drift",
            Self::Scale => "scale",
            Self::Filter => "filter",
            Self::Derivative => "derivative",
            Self::Radius => "radius",
            Self::Correction => "correction",
        }
    }
}

/// The relative departure from which on the standard uncertainty of trials counts.
const LEAST_DEPARTURE: f64 = 0.1;

/// Standard deviations of the standard uncertainty of M trials, 1/sqrt(2 M) of it, that a departure
/// is more than. From 800 trials on they are below the least departure; of fewer, one right standard
/// uncertainty in 7,700 at most is replaced (chi-squared distribution of M degrees of freedom).
const SURE: f64 = 4.0;

/// A value with what its uncertainty is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct BudgetedValue {
    /// The value.
    pub measured: Measured,
    /// The standard uncertainty that each source contributes; they add as squares.
    pub contributions: Vec<(UncertaintySource, f64)>,
    /// The standard uncertainty that trials over the recording's noise gave, where they were made.
    /// That of M trials has a relative standard uncertainty of 1/sqrt(2 M) itself.
    pub trials: Option<f64>,
    /// Whether the standard uncertainty is that of the trials, because the law of propagation does
    /// not hold (an amplitude near the noise): they differ by more than a tenth, and by more than
    /// four times the scatter of the trials.
    pub from_trials: bool,
}

impl BudgetedValue {
    /// A value with its contributions, of which `noise_dof` are the degrees of freedom of the noise.
    pub fn new(value: f64, contributions: Vec<(UncertaintySource, f64)>, noise_dof: f64) -> Self {
        let kept: Vec<(UncertaintySource, f64)> =
            contributions.into_iter().filter(|(_, u)| *u > 0.0).collect();
        // a sum of nothing is -0
        let variance: f64 = kept.iter().map(|(_, u)| u * u).sum::<f64>() + 0.0;
        let noise: f64 = kept
            .iter()
            .filter(|(source, _)| *source == UncertaintySource::Noise)
            .map(|(_, u)| u * u)
            .sum();
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

    /// Notes what so many trials gave; where it departs by more than a tenth, and by more than
    /// trials scatter, it is the standard uncertainty.
    pub(super) fn checked(mut self, by_trials: f64, trials: u64) -> Self {
        self.trials = Some(by_trials);
        let stated = self.measured.standard_uncertainty;
        let least = LEAST_DEPARTURE.max(SURE * (0.5 / trials as f64).sqrt());
        if stated.is_nan() || (by_trials - stated).abs() > least * stated {
            self.measured.standard_uncertainty = by_trials;
            self.from_trials = true;
        }
        self
    }
}
