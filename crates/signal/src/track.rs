//! A recording of a recipe.

use super::recipe::{ChannelRateSearch, TimeBase};

/// A recording with the channels that it holds.
#[derive(Debug)]
pub struct ChannelRecording<P> {
    /// The values, in the units of their channels.
    pub passes: P,
    /// Their instants.
    pub base: TimeBase,
    /// The channels that it holds, by their places in the recipe.
    pub channels: Vec<usize>,
    /// How the sampling rate is found in it, where it is.
    pub search: Option<ChannelRateSearch>,
}
