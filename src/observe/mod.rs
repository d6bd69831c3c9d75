//! Recordings to observations: amplitudes, phases and delays of sampled signals, each with its
//! standard uncertainty.
//!
//! Every step is a function from signals to signals or to [`Measured`] values; a recipe names which
//! of them run on which channel.

mod measured;
mod signal;

pub use measured::Measured;
pub use signal::Signal;
