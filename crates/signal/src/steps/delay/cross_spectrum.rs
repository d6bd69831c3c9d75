//! Phase, gain and coherence of two signals at one frequency by the cross-spectrum.

use std::f64::consts::{PI, TAU};

use crate::periodic::{Harmonics, Periodic};
use crate::rms::together;
use crate::{Measured, Phasor, Signal, Unsuitable, phasor};

/// A cross-spectrum at one frequency, averaged over segments.
///
/// Each segment's complex amplitudes are those of a least-squares sine with an offset, so that
/// nothing leaks although a segment need not be a whole number of periods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossSpectrum {
    /// In hertz.
    pub frequency: f64,
    /// Number of segments of equal length, at least 2, each of one period at least. They give the
    /// coherence 2 (n - 1) degrees of freedom: 10 segments or more are to be preferred.
    pub segments: usize,
}

/// What a cross-spectrum says of two signals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossPhase {
    /// Phase of the channel less that of the reference, in radians, in (-pi, pi].
    pub phase: Measured,
    /// Amplitude of the channel over that of the reference. The reference's noise lowers it
    /// relatively by the noise's share of the reference's power at the frequency. What rounding to
    /// steps above three times the noise does to either amplitude
    /// ([`amplitude_error`](crate::amplitude_error)) is to be added.
    pub gain: Measured,
    /// Magnitude squared coherence of the segments, 0 to 1.
    pub coherence: f64,
    /// The delay that the phase stands for, in seconds; whole periods may be added to it.
    pub delay: Measured,
}

impl CrossSpectrum {
    /// The channel against the reference, both sampled together.
    ///
    /// With the coherence g of n segments the variance of phase and logarithmic gain is
    /// (1 - g) / (2 (n - 1) g), with 2 (n - 1) degrees of freedom: the complex regression of the
    /// channel's segments on the reference's.
    /// Source: J. S. Bendat, A. G. Piersol, Random Data, 4th ed., section 9.1.4 (with n for n - 1).
    ///
    /// # Errors
    /// Signals of different lengths or rates, fewer than 2 segments, segments of less than a
    /// period, a frequency at or above half the rate, values that are not finite, no component.
    pub fn of(&self, reference: &Signal, channel: &Signal) -> Result<CrossPhase, Unsuitable> {
        together(reference, channel)?;
        let samples = reference.values.len();
        if self.segments < 2 {
            return Err(Unsuitable::Outside {
                what: "the number of segments",
                found: self.segments as f64,
                between: [1.0, f64::INFINITY],
            });
        }
        let length = samples / self.segments;
        let harmonics = Harmonics { frequency: self.frequency, count: 1 };
        let (mut x_power, mut y_power) = (0.0, 0.0);
        let mut cross = Phasor::new(0.0, 0.0);
        for i in 0..self.segments {
            let of = |signal: &Signal| {
                let values = signal.values[i * length..(i + 1) * length].to_vec();
                let segment = Signal { values, rate: signal.rate, start: 0.0 };
                Ok(Periodic::fit(&segment, harmonics)?.parts[0].phasor)
            };
            let (x, y) = (of(reference)?, of(channel)?);
            x_power += x.norm_sqr();
            y_power += y.norm_sqr();
            cross += x.conj() * y;
        }
        if cross.norm_sqr() == 0.0 {
            return Err(Unsuitable::Silent { frequency: self.frequency });
        }
        let coherence = (cross.norm_sqr() / (x_power * y_power)).min(1.0);
        let freedom = 2.0 * (self.segments - 1) as f64;
        let relative = ((1.0 - coherence) / (freedom * coherence)).sqrt();
        let measured = |value: f64, standard_uncertainty: f64| Measured {
            value,
            standard_uncertainty,
            degrees_of_freedom: freedom,
        };
        // the channel may have been started later
        let late = TAU * self.frequency * (channel.start - reference.start);
        let phase = crate::wrapped(phasor::angle(cross) - late);
        let gain = phasor::modulus(cross) / x_power;
        // a phase cannot be less known than evenly on the circle
        let of_phase = relative.min(PI / 3f64.sqrt());
        let pulsation = TAU * self.frequency;
        Ok(CrossPhase {
            phase: measured(phase, of_phase),
            gain: measured(gain, gain * relative),
            coherence,
            delay: measured(-phase / pulsation, of_phase / pulsation),
        })
    }
}
