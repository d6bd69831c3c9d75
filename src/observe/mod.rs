//! Recordings to observations: amplitudes, phases and delays of sampled signals, each with its
//! standard uncertainty.
//!
//! Every step is a function from signals to signals or to [`Measured`] values; a recipe names which
//! of them run on which channel.

mod butterworth;
mod changed;
mod correction;
mod delay;
mod derivative;
mod measured;
mod noise;
mod periodic;
mod phasor;
mod quantization;
mod resimulation;
mod rms;
mod rotation;
mod sampling_rate;
mod signal;
mod spectral;
#[cfg(test)]
mod study;
mod transform;
mod unsuitable;

pub use butterworth::{Band, Butterworth, Filter, Passage};
pub use changed::Changed;
pub use correction::{Correction, Response, ResponsePoint, corrected};
pub use delay::{Agreement, CrossCorrelation, CrossPhase, CrossSpectrum, Delay, agreement};
pub use derivative::Derivative;
pub use measured::Measured;
pub use noise::{Noise, NoiseGain, jitter_variance, quantization_variance};
pub use periodic::{Harmonics, Part, Periodic};
pub use phasor::{Phasor, wrapped};
pub use quantization::amplitude_error;
pub use resimulation::{Colour, Resimulation, Scatter};
pub use rms::{Improvement, Rms, RmsOf, improvement};
pub use rotation::{Accelerations, Oscillation, Rotation};
pub use sampling_rate::{Rate, RateSearch, sampling_rate};
pub use signal::Signal;
pub use spectral::Ends;
pub use unsuitable::Unsuitable;
