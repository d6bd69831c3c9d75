//! Phase, gain and coherence of two signals at one frequency by the cross-spectrum.

use std::f64::consts::{PI, TAU};

use crate::periodic::{Harmonics, Periodic};
use crate::rms::together;
use crate::unsuitable::within;
use crate::{Measured, Phasor, Signal, Unsuitable, measured, phasor};
use gumption_engine::special::student;

/// Segments at most, where nobody says how many.
const MOST: usize = 32;

/// The part of a number of periods by which the rounding of a frequency may put it off a whole one.
const WHOLE: f64 = 1e-12;

/// A cross-spectrum at one frequency, averaged over segments of a whole number of periods.
///
/// Each segment's complex amplitudes are those of a least-squares fit of all harmonics with an
/// offset: harmonics that are fitted do not leak into the first one, and those that are not hardly
/// do, as a segment is whole periods to the last sample. Values after the last segment do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossSpectrum {
    /// The oscillation: the spectrum is that at the first harmonic, the others are fitted beside it.
    pub harmonics: Harmonics,
    /// Number of segments, at least 2: one alone has a coherence of 1, whatever the noise. They give
    /// the coherence 2 (n - 1) degrees of freedom: 10 segments or more are to be preferred.
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
    pub coherence: Measured,
    /// The delay that the phase stands for, in seconds; whole periods may be added to it.
    pub delay: Measured,
}

impl CrossSpectrum {
    /// With the number of segments, 2 to 32, that makes the expanded uncertainty of noise smallest:
    /// many segments have many degrees of freedom, few leave fewer periods over.
    ///
    /// # Errors
    /// Fewer periods than 2 segments need, a frequency at or above half the rate.
    pub fn of_signal(harmonics: Harmonics, signal: &Signal) -> Result<Self, Unsuitable> {
        let least = least_periods(harmonics, signal)?;
        let periods = periods(harmonics, signal);
        let square = |segments: usize| {
            let k = student::two_sided_factor(0.9545, freedom(segments));
            k * k / (segments * (periods / segments)) as f64
        };
        let segments = (2..=MOST)
            .filter(|segments| periods / segments >= least)
            .min_by(|a, b| square(*a).total_cmp(&square(*b)));
        let refused = Unsuitable::Segments { segments: 2, periods, least };
        Ok(Self { harmonics, segments: segments.ok_or(refused)? })
    }

    /// The channel against the reference, both sampled together.
    ///
    /// With the coherence g of n segments the variance of phase and logarithmic gain from noise is
    /// (1 - g) / (2 (n - 1) g), with 2 (n - 1) degrees of freedom: the complex regression of the
    /// channel's segments on the reference's. To it comes the leakage of oscillations that stand out
    /// of what the harmonics leave of the whole signals.
    /// Source: J. S. Bendat, A. G. Piersol, Random Data, 4th ed., section 9.1.4 (with n for n - 1).
    ///
    /// The coherence of a periodic signal with noise in one of the two has the variance
    /// g (2 - g) (1 - g)^2 / (n - 1), by the law of propagation from the noise of the segments, and
    /// near 1 is too large by (1 - g) / (n - 1) on average; with both
    /// u(g)^2 = g (2 - g) (1 - g)^2 n / (n - 1)^2. It is that of random signals,
    /// 2 g (1 - g)^2 / n (ibid., table 9.6), where g is small, and half of it near 1, as the power of
    /// the signal does not scatter from segment to segment.
    ///
    /// # Errors
    /// Signals of different lengths or rates, fewer than 2 segments, more segments than there are
    /// whole periods, a frequency at or above half the rate, values that are not finite, no component.
    pub fn of(&self, reference: &Signal, channel: &Signal) -> Result<CrossPhase, Unsuitable> {
        together(reference, channel)?;
        let harmonics = self.harmonics;
        let (mut x_power, mut y_power) = (0.0, 0.0);
        let mut cross = Phasor::new(0.0, 0.0);
        let [of_reference, of_channel] = [self.cut(reference)?, self.cut(channel)?];
        for (x, y) in of_reference.phasors.iter().zip(&of_channel.phasors) {
            x_power += x.norm_sqr();
            y_power += y.norm_sqr();
            cross += x.conj() * *y;
        }
        let frequency = harmonics.frequency;
        if cross.norm_sqr() == 0.0 {
            return Err(Unsuitable::Silent { frequency });
        }
        // leakage of the whole signals, as that of the part that the segments are
        let share = reference.values.len() as f64 / of_reference.used as f64;
        let mut leaks = 0.0;
        for signal in [reference, channel] {
            let first = Periodic::fit(signal, harmonics)?.leaking(signal).parts[0];
            let leak = share * first.leakage;
            leaks += leak * leak / first.phasor.norm_sqr();
        }
        let n = self.segments as f64;
        let coherence = (cross.norm_sqr() / (x_power * y_power)).min(1.0);
        let freedom = freedom(self.segments);
        let of_noise = ((1.0 - coherence) / (freedom * coherence)).sqrt();
        let measured = |value: f64, factor: f64, most: f64| {
            let parts = [(of_noise, freedom), (leaks.sqrt(), f64::INFINITY)];
            let of = measured::of_parts(value, &parts);
            Measured { standard_uncertainty: of.standard_uncertainty.min(most) * factor, ..of }
        };
        // the channel may have been started later
        let pulsation = TAU * frequency;
        let phase = phasor::angle(cross) - pulsation * (channel.start - reference.start);
        let phase = crate::wrapped(phase);
        let gain = phasor::modulus(cross) / x_power;
        // a phase cannot be less known than evenly on the circle
        let even = PI / 3f64.sqrt();
        let of_coherence = (1.0 - coherence) * (coherence * (2.0 - coherence) * n).sqrt();
        Ok(CrossPhase {
            phase: measured(phase, 1.0, even),
            gain: measured(gain, gain, f64::INFINITY),
            coherence: Measured {
                value: coherence,
                standard_uncertainty: of_coherence / (n - 1.0),
                degrees_of_freedom: freedom,
            },
            delay: measured(-phase / pulsation, 1.0 / pulsation, even),
        })
    }

    /// The fits of a signal's segments. These lie side by side and begin at the first sample of their
    /// period, so that their lengths differ by one sample where a period is no whole number of them.
    pub(super) fn cut(&self, signal: &Signal) -> Result<Segments, Unsuitable> {
        let (segments, least) = (self.segments, least_periods(self.harmonics, signal)?);
        let periods = periods(self.harmonics, signal);
        let each = periods / segments.max(1);
        if segments < 2 || each < least {
            return Err(Unsuitable::Segments { segments, periods, least });
        }
        let samples = each as f64 * signal.rate / self.harmonics.frequency;
        let first = |place: usize| {
            let first = place as f64 * samples * (1.0 + WHOLE);
            (first as usize).min(signal.values.len())
        };
        let mut cut = Segments { phasors: Vec::new(), of_phase: 0.0, used: first(segments) };
        for place in 0..segments {
            let values = &signal.values[first(place)..first(place + 1)];
            let (phasor, [re, im]) = self.harmonics.first_of(values, signal.rate)?;
            cut.phasors.push(phasor);
            let across = phasor.im * phasor.im * re + phasor.re * phasor.re * im;
            cut.of_phase += across / phasor.norm_sqr() / segments as f64;
        }
        Ok(cut)
    }
}

/// The fits of the segments of a signal.
pub(super) struct Segments {
    /// The first harmonic of each, about its middle.
    pub(super) phasors: Vec<Phasor>,
    /// The mean variance of a phasor across itself, of white noise of variance 1.
    pub(super) of_phase: f64,
    /// The samples that they have together.
    pub(super) used: usize,
}

/// Degrees of freedom of the coherence.
fn freedom(segments: usize) -> f64 {
    2.0 * (segments - 1) as f64
}

/// The whole periods that a signal has.
fn periods(harmonics: Harmonics, signal: &Signal) -> usize {
    let periods = signal.values.len() as f64 * harmonics.frequency / signal.rate;
    (periods * (1.0 + WHOLE)) as usize
}

/// The whole periods that a segment has at least: twice as many values as parameters are fitted, and
/// one turn between the highest harmonic and its image above half the rate.
fn least_periods(harmonics: Harmonics, signal: &Signal) -> Result<usize, Unsuitable> {
    let count = harmonics.count.max(1) as f64;
    let highest = signal.rate / 2.0 / count;
    let frequency = within("the frequency (Hz)", harmonics.frequency, [0.0, highest])?;
    let turns = frequency / signal.rate; // a sample
    let of_image = turns / (1.0 - 2.0 * count * turns);
    Ok((2.0 * (2.0 * count + 1.0) * turns).max(of_image).ceil() as usize)
}
