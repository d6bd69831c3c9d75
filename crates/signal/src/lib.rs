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
//! oscillations and noise; `through`: what the noise is after them; `found`: what they find beside it; `search`: sampling rates), fits what
//! comes out (`asked`: whether that can be; `analysis`, `sine_fit`, `frequency`, `residuals`, `spurious`; `trace`: what figures show of it), and makes values with
//! budgets of it (`polar`, `trials`, `values`, `observation`). `butterworth`, `derivative`,
//! `rotation`, `correction`, `delay`, `rms` and `sampling_rate` are steps as functions of signals.
//! The one fit is `sine_fit`: any tones of a recording that streams in blocks, or of a signal in
//! memory; `periodic` is its form for steps that take harmonics out of a signal and put them back.

// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod analysed;
mod analysis;
mod asked;
mod beside;
mod budget;
mod channel_step;
mod effects;
mod fft;
mod fit;
mod found;
mod known_noise;
mod measured;
mod near_noise;
mod normals;
mod note;
mod observation;
mod passes;
mod phasor;
mod recipe;
mod refused;
mod run;
mod search;
mod signal;
mod step;
mod steps;
mod surroundings;
mod through;
mod trace;
mod track;
mod trials;
mod unexplained;
mod unsuitable;
mod values;
mod waveform;

use fit::{
    coloured, common_noise, dirichlet, drift, frequency, lattice, outlying, periodic, polar,
    quantization, residuals, rounding, sine_fit, spurious, turns, whole_periods,
};
use steps::{
    butterworth, changed, correction, delay, derivative, noise, resimulation, rms, rotation,
    sampling_rate, spectral, transform,
};

pub use budget::{BudgetedValue, UncertaintySource};
pub use butterworth::{Band, Butterworth, Filter, Passage};
pub use changed::Changed;
pub use channel_step::ChannelStep;
pub use correction::{Correction, Response, ResponsePoint, corrected};
pub use delay::{CrossCorrelation, CrossPhase, CrossSpectrum, Delay, DelayAgreement, agreement};
pub use derivative::Derivative;
pub use effects::StepEffect;
pub use measured::Measured;
pub use noise::{Noise, NoiseGain, jitter_variance};
pub use note::ChannelNote;
pub use observation::{ChannelObservation, Observation, ToneComponent};
pub use passes::{BLOCK, BlockVisitor, InMemorySamples, SampleSource, in_blocks};
pub use periodic::{Harmonic, Harmonics, Periodic};
pub use phasor::{Phasor, wrapped};
pub use quantization::{amplitude_error, quantization_variance};
pub use recipe::{
    Amplitude, Channel, ChannelRateSearch, Frequency, Method, PhaseUnit, RecipeSettings, TimeBase,
};
pub use refused::{MOST_HELD, Refused};
pub use resimulation::{Colour, ResimulatedScatter, Resimulation};
pub use rms::{Rms, RmsOf, RmsReduction, improvement};
pub use rotation::{Accelerations, Oscillation, Rotation};
pub use run::{observe, observe_with_traces};
pub use sampling_rate::{Rate, RateSearch, sampling_rate};
pub use signal::Signal;
pub use sine_fit::{NoFit, Tone, ToneCoefficients, ToneDesign};
pub use spectral::Ends;
pub use spurious::Spurious;
pub use step::Stepped;
pub use surroundings::{Finding, Surroundings};
pub use trace::{RecordTrace, SampleRanges, SpectrumColumn, TRACE_COLUMNS, TraceTone};
pub use track::ChannelRecording;
pub use unsuitable::Unsuitable;
pub use waveform::{
    Beyond, CalibratedResponse, Coordinates, Cutoff, Errors, LineResponse, LowPass,
    ModelledResponse, NoiseColour, PointError, QuantityFound, QuietPart, ResponseModel, Truncation,
    Waveform, WaveformChannel, WaveformQuantity, WaveformSource, WaveformStep, WaveformTrials,
    corrected as corrected_waveform, notes as waveform_notes, waveforms,
};
pub use whole_periods::{WholePeriods, whole_periods};

#[cfg(test)]
mod study;
#[cfg(test)]
mod tests;
