//! Recordings to observations: amplitudes, phases and delays of sampled signals, each with its
//! standard uncertainty.
//!
//! Every step is a function from signals to signals or to [`Measured`] values; a recipe names which
//! of them run on which channel. [`observe`] runs one row of a recipe.
//!
//! # Conventions
//!
//! An oscillation is A cos(2 pi f t + phi). Amplitudes are peak values unless the recipe asks for RMS.
//! The phase of a component at n times the reference's frequency is phi - n phi_reference, above -180
//! to 180 degrees; the delay is -phi/(2 pi f), positive for a channel that comes later. Without a
//! reference a phase is that at the recording's instant 0.
//!
//! # Where things are
//!
//! [`observe`] (`run`) leads each channel through its steps (`step`, `effects`: what they did to
//! oscillations and noise; `found`: what they find beside it; `search`: sampling rates), fits what
//! comes out (`analysis`, `sine_fit`, `frequency`, `residuals`, `spurious`), and makes values with
//! budgets of it (`polar`, `trials`, `values`, `observation`). `butterworth`, `derivative`,
//! `rotation`, `correction`, `delay`, `rms` and `sampling_rate` are steps as functions of signals.
//! There are two fits: `sine_fit` takes any tones of a recording that streams in blocks, `periodic`
//! harmonics of one signal in memory, for steps that take them out and put them back.

#![allow(clippy::disallowed_methods)] // elementary functions of the platform, to be replaced

mod analysis;
mod effects;
mod fit;
mod found;
mod measured;
mod observation;
mod passes;
mod phasor;
mod recipe;
mod run;
mod search;
mod signal;
mod step;
mod steps;
mod trials;
mod unsuitable;
mod values;

use fit::{
    dirichlet, frequency, periodic, polar, quantization, residuals, sine_fit, spurious, turns,
    whole_periods,
};
use steps::{
    butterworth, changed, correction, delay, derivative, noise, resimulation, rms, rotation,
    sampling_rate, spectral, transform,
};

pub use analysis::{MOST_HELD, Refused};
pub use butterworth::{Band, Butterworth, Filter, Passage};
pub use changed::Changed;
pub use correction::{Correction, Response, ResponsePoint, corrected};
pub use delay::{Agreement, CrossCorrelation, CrossPhase, CrossSpectrum, Delay, agreement};
pub use derivative::Derivative;
pub use effects::Effect;
pub use measured::Measured;
pub use noise::{Noise, NoiseGain, jitter_variance, quantization_variance};
pub use observation::{ChannelObservation, Component, Observation, Source, Value};
pub use passes::{BLOCK, Each, Held, Passes, in_blocks};
pub use periodic::{Harmonics, Part, Periodic};
pub use phasor::{Phasor, wrapped};
pub use quantization::amplitude_error;
pub use recipe::{Amplitude, Channel, Frequency, Method, PhaseUnit, Search, Settings, TimeBase};
pub use resimulation::{Colour, Resimulation, Scatter};
pub use rms::{Improvement, Rms, RmsOf, improvement};
pub use rotation::{Accelerations, Oscillation, Rotation};
pub use run::{Track, observe};
pub use sampling_rate::{Rate, RateSearch, sampling_rate};
pub use signal::Signal;
pub use sine_fit::{Coefficients, Design, NoFit, Tone};
pub use spectral::Ends;
pub use spurious::Spurious;
pub use step::{Finding, Step, Stepped, Surroundings};
pub use unsuitable::Unsuitable;
pub use whole_periods::{WholePeriods, whole_periods};

#[cfg(test)]
mod study;
#[cfg(test)]
mod tests;
