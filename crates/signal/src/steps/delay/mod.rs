//! The delay between two signals: by the maximum of their cross-correlation, by the phase of their
//! cross-spectrum, and whether the two agree.
//!
//! A delay is positive where the channel comes later than the reference. The phase of the channel
//! less that of the reference is then negative: phase = -2 pi f delay.

mod agreement;
mod correlation;
mod cross_spectrum;

#[cfg(test)]
mod tests;

pub(crate) use agreement::of_one_recording;
pub use agreement::{DelayAgreement, agreement};
pub(crate) use correlation::of_harmonics;
pub use correlation::{CrossCorrelation, Delay};
pub use cross_spectrum::{CrossPhase, CrossSpectrum};
