//! What is known of the noise of a channel after its steps.

use super::coloured::Memory;
use super::spurious::Spurious;

/// Where the noise near the tones is known from after steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoiseSource {
    /// It was white before them.
    White,
    /// It is measured after them, as that of a plain channel.
    Measured,
    /// It was that of a process of first order before them.
    Process,
    /// Nothing tells: it is taken as even over what they let pass.
    Even,
}

/// What is known of the noise after the steps from the signal before them.
#[derive(Clone, Debug)]
pub(super) struct KnownNoise {
    pub(super) source: NoiseSource,
    /// The variances of the cosine's and the sine's factor of each tone over those that white noise of
    /// the residuals' variance gives; none where they are taken from the residuals after the steps.
    pub(super) factors: Option<Vec<[f64; 2]>>,
    /// Degrees of freedom of these.
    pub(super) freedom: f64,
    /// The variance of the constant.
    pub(super) level: f64,
    /// Degrees of freedom of that; none: those of the noise near the tones.
    pub(super) of_level: Option<f64>,
    /// Degrees of freedom of the variance of the residuals.
    pub(super) of_residuals: f64,
    /// Shares of quantization and jitter in the variance near the tones.
    pub(super) shares: [f64; 2],
    /// What rounding does to the amplitude of each tone.
    pub(super) rounding: Vec<f64>,
    /// Oscillations that are not fitted, as the steps leave them.
    pub(super) unfitted: Vec<Spurious>,
    /// What was seen of the noise before the steps.
    pub(super) before: SeenBefore,
}

/// What was seen of the noise before the steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenBefore {
    /// What a short record tells of a memory.
    pub(super) memory: Memory,
    /// The autocorrelation coefficient at lag 1.
    pub(super) coefficient: f64,
    /// Whether the level wanders, and is not taken out.
    pub(super) wanders: bool,
    /// Whether the noise grows towards the lowest frequencies as 1/f noise does, and these are not taken
    /// out.
    pub(super) flickers: bool,
}
