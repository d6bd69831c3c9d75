//! A transient signal corrected for the response of what it came through, with the standard
//! uncertainty of each of its values.
//!
//! The spectrum of the record is divided by the response H at each line, and multiplied by a low-pass
//! G, without which the noise at high frequencies would drown the signal: X = Y G/H. The law of
//! propagation then is linear in a few kinds of errors: noise (lines independent of each other), errors of
//! the response (one of them changes many lines together: a point of a calibration all lines up to its
//! neighbours, a parameter of a model all lines), delay and scale (all lines). The low-pass takes part of the
//! signal away; a bound on the signal's spectrum bounds that (Eichstädt and Wilkens 2017, Journal of the
//! Acoustical Society of America 141, 4155).
//!
//! The square of an error's effect over the record is a product of spectra. So the variances at all instants cost
//! O(N log N) for N samples, however many points the response has.
//!
//! Values are in the unit of the answer, instants in seconds, frequencies in hertz. The record is taken as one
//! period.

mod corrected;
mod errors;
mod low_pass;
mod notes;
mod quantity;
mod quiet;
mod response;
mod row;
mod spectrum;
mod trials;
mod truncation;

pub use corrected::{Waveform, WaveformSource, WaveformStep, corrected};
pub use low_pass::{Cutoff, LowPass};
pub use notes::notes;
pub use quantity::{QuantityFound, WaveformQuantity};
pub use quiet::{NoiseColour, QuietPart};
pub use response::{
    Beyond, CalibratedResponse, Coordinates, Errors, LineResponse, ModelledResponse, PointError,
    ResponseModel,
};
pub use row::{WaveformChannel, waveforms};
pub use trials::WaveformTrials;
pub use truncation::Truncation;

#[cfg(test)]
mod tests;
