//! What is done with signals before oscillations are fitted, and what is found on the way: filters,
//! derivatives, the accelerations of a rotating table, a sampling rate, delays, corrections, each
//! with its uncertainty. The functions know nothing of recipes; [`ChannelStep`](super::Step) calls them.

pub(super) mod butterworth;
pub(super) mod changed;
pub(super) mod correction;
pub(super) mod delay;
pub(super) mod derivative;
pub(super) mod noise;
pub(super) mod resimulation;
pub(super) mod rms;
pub(super) mod rotation;
pub(super) mod sampling_rate;
pub(super) mod spectral;
pub(super) mod transform;
