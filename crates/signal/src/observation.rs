//! What was found in recordings.

use super::Measured;
use super::budget::BudgetedValue;
use super::note::ChannelNote;
use super::spurious::Spurious;
use super::surroundings::Finding;

/// An oscillation of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ToneComponent {
    /// Which multiple of the frequency it is.
    pub multiple: u32,
    /// Its frequency, in hertz.
    pub frequency: Measured,
    /// The amplitude, peak or RMS as the recipe says, in the channel's unit.
    pub amplitude: BudgetedValue,
    /// The phase phi of A cos(2 pi f t + phi), less `multiple` times the phase of the reference where
    /// there is one, otherwise at the recording's instant 0; above -180 to 180 degrees, in the
    /// recipe's unit.
    pub phase: BudgetedValue,
    /// The delay against the reference, -phase/(2 pi f), in seconds: positive for a channel that
    /// comes later. None without a reference, and for multiples other than 1.
    pub delay: Option<BudgetedValue>,
}

/// What was found in one channel at one frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelObservation {
    /// The channel, by its place among those of the recipe.
    pub channel: usize,
    /// The frequency of the excitation in this recording, in hertz.
    pub frequency: Measured,
    /// The multiples of it that the recipe asks for.
    pub components: Vec<ToneComponent>,
    /// The constant part, in the channel's unit.
    pub offset: BudgetedValue,
    /// Total harmonic distortion: the root of the sum of squares of the amplitudes of the multiples
    /// 2 and up, over the first's; a number. None if none of them is below half the sampling rate.
    pub distortion: Option<BudgetedValue>,
    /// Signal-to-noise ratio: power of the first multiple over that of the residuals, in decibels.
    pub signal_to_noise: BudgetedValue,
    /// Signal to noise and distortion: power of the first multiple over that of the residuals and of
    /// the multiples 2 and up, in decibels.
    pub sinad: BudgetedValue,
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
    /// What to bear in mind.
    pub notes: Vec<ChannelNote>,
}
