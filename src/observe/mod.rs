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

mod analysis;
mod dirichlet;
mod frequency;
mod measured;
mod observation;
mod passes;
mod polar;

mod recipe;
mod residuals;
mod rounding;
mod run;
mod signal;
mod sine_fit;
mod spurious;
mod step;
mod trials;
mod turns;
mod values;
mod whole_periods;

pub use analysis::{MOST_HELD, Refused};
pub use measured::Measured;
pub use observation::{ChannelObservation, Component, Observation, Source, Value};
pub use passes::{BLOCK, Each, Held, Passes, in_blocks};
pub use recipe::{Amplitude, Channel, Frequency, Method, PhaseUnit, Settings, TimeBase};
pub use rounding::amplitude_error;
pub use run::{Track, observe};
pub use signal::Signal;
pub use sine_fit::{Coefficients, Design, NoFit, Tone};
pub use spurious::Spurious;
pub use step::{Finding, Step, Stepped, Surroundings};
pub use whole_periods::{WholePeriods, whole_periods};

#[cfg(test)]
mod tests;
