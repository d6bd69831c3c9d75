//! A signal's spectrum multiplied by a complex gain, and what is done about the signal's ends.

use std::f64::consts::PI;

use crate::periodic::{Harmonics, Periodic};
use crate::unsuitable::within;
use crate::{Changed, Phasor, Signal, Unsuitable, transform};
use gumption_engine::number::elementary;

/// What is done about leakage: the transform takes a signal for one period of an endless one, and a
/// step between its end and its start spreads over all frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    /// Nothing: the signal is known to be a whole number of periods.
    WholePeriods,
    /// Offset and harmonics are fitted, taken out, multiplied by the gain at their own frequencies
    /// and put back; only what is left goes through the transform. Any number of periods from one.
    Periodic(Harmonics),
    /// The signal less its mean rises and falls by half a period of a cosine over this part of its
    /// length at each end (above 0, at most 0.5); so many values feel the ends.
    Tapered(f64),
}

/// Multiplies a signal's spectrum by `gain`, a function of the frequency in hertz from zero to half
/// the rate; the gain at negative frequencies is its conjugate.
pub(crate) fn multiplied(
    signal: &Signal,
    ends: Ends,
    gain: impl Fn(f64) -> Phasor,
) -> Result<Changed, Unsuitable> {
    let n = signal.values.len();
    if n < 2 {
        return Err(Unsuitable::TooShort { samples: n, needed: 2 });
    }
    if let Some(sample) = signal.values.iter().position(|value| !value.is_finite()) {
        return Err(Unsuitable::NotFinite { sample });
    }
    let (mut left, mean, mut model, feels) = match ends {
        Ends::WholePeriods => {
            let mean = signal.values.iter().sum::<f64>() / n as f64;
            (signal.values.iter().map(|x| x - mean).collect(), mean, vec![0.0; n], 0)
        }
        Ends::Periodic(harmonics) => {
            let fitted = Periodic::fit(signal, harmonics)?;
            (fitted.without(signal), fitted.offset.value, fitted.values(&gain), 0)
        }
        Ends::Tapered(part) => {
            within("the tapered part", part, [0.0, 0.5 + f64::EPSILON])?;
            let mean = signal.values.iter().sum::<f64>() / n as f64;
            let rise = ((part * n as f64).round() as usize).max(1);
            let mut left: Vec<f64> = signal.values.iter().map(|x| x - mean).collect();
            for i in 0..rise {
                let weight = 0.5 - 0.5 * elementary::cos(PI * (i as f64 + 0.5) / rise as f64);
                left[i] *= weight;
                left[n - 1 - i] *= weight;
            }
            (left, mean, vec![0.0; n], rise)
        }
    };
    let mut spectrum = transform::forward(&left);
    for (j, bin) in spectrum.iter_mut().enumerate().take(n / 2 + 1) {
        *bin *= gain(j as f64 * signal.rate / n as f64);
    }
    left = transform::inverse(spectrum);
    let level = mean * gain(0.0).re;
    for (value, rest) in model.iter_mut().zip(&left) {
        *value += rest + level;
    }
    Ok(Changed { signal: Signal { values: model, ..*signal }, settling: feels, unsettling: feels })
}
