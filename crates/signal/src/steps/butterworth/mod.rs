//! Butterworth filters as a signal meets them: run forward, or forward and backward.
//!
//! The digital filter is the bilinear transform of the analogue one with its corner frequencies
//! kept in place (prewarped), the same transfer function that scipy's `butter` and MATLAB's
//! `butter` give. Each second-order part runs as two trapezoidal integrators (a state-variable
//! filter) instead of a difference equation of the output: coefficients of the latter lose digits
//! with the square of corner over rate, those of the former lose none, so that 0.1 Hz at 50 kHz is
//! as exact as 40 Hz at 1612 Hz.

mod design;
mod section;

#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use section::FilterSection;

use crate::unsuitable::within;
use crate::{Changed, Measured, NoiseGain, Phasor, Signal, Unsuitable, phasor};
use gumption_engine::number::elementary;

/// What passes; frequencies in hertz, at which the gain of one run is 1/sqrt(2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Band {
    /// Everything below.
    LowPass(f64),
    /// Everything above.
    HighPass(f64),
    /// Everything between.
    BandPass(f64, f64),
}

/// A Butterworth filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Butterworth {
    /// What passes.
    pub band: Band,
    /// Number of poles, 1 to 24; even for a band-pass filter, of which each edge has half of them.
    /// Chiominto et al. (2024), section 3.4.2: low-pass, 40 Hz, six poles; section 3.3.2:
    /// band-pass of 10 % width, two poles.
    pub poles: usize,
    /// Run forward and then backward: the gain is squared and the phase is zero.
    pub both_ways: bool,
}

/// A Butterworth filter at a sampling rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Filter {
    sections: Vec<FilterSection>,
    /// What the sections' product is multiplied by.
    scale: f64,
    both_ways: bool,
    rate: f64,
}

/// How a filter passes a component of one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// Amplitude after the filter over the amplitude before.
    pub gain: Measured,
    /// Phase after the filter less the phase before, in radians, in (-pi, pi].
    pub phase: Measured,
}

impl Butterworth {
    /// The filter at a sampling rate in hertz.
    ///
    /// # Errors
    /// A corner frequency that does not lie between zero and half the rate, corners in the wrong
    /// order, no poles or more than 24, an odd number of them for a band-pass filter.
    pub fn at(&self, rate: f64) -> Result<Filter, Unsuitable> {
        within("the sampling rate (Hz)", rate, [0.0, f64::INFINITY])?;
        within("the number of poles", self.poles as f64, [0.0, 25.0])?;
        let warped = |corner: f64| {
            let corner = within("the corner frequency (Hz)", corner, [0.0, rate / 2.0])?;
            Ok(elementary::tan(PI * corner / rate))
        };
        let (sections, scale) = match self.band {
            Band::LowPass(corner) => (design::low_pass(self.poles, warped(corner)?), 1.0),
            Band::HighPass(corner) => (design::high_pass(self.poles, warped(corner)?), 1.0),
            Band::BandPass(low, high) => {
                let edges = [warped(low)?, warped(high)?];
                within("the lower corner frequency (Hz)", low, [0.0, high])?;
                if !self.poles.is_multiple_of(2) {
                    return Err(Unsuitable::OddPoles { poles: self.poles });
                }
                design::band_pass(self.poles / 2, edges)
            }
        };
        Ok(Filter { sections, scale, both_ways: self.both_ways, rate })
    }
}

impl Filter {
    /// The complex gain at a frequency in hertz, below half the rate: what the phasor of a
    /// component is multiplied by.
    pub fn response(&self, frequency: f64) -> Phasor {
        let once = self.once(frequency);
        if self.both_ways { Phasor::new(once.norm_sqr(), 0.0) } else { once }
    }

    fn once(&self, frequency: f64) -> Phasor {
        let s = Phasor::new(0.0, elementary::tan(PI * frequency / self.rate));
        self.sections.iter().fold(Phasor::new(self.scale, 0.0), |h, part| h * part.response(s))
    }

    /// Gain and phase at a frequency that is known with an uncertainty, of a filter that was
    /// designed for the sampling rate that it was given while the true rate is known relatively
    /// to within `rate_uncertainty` (standard uncertainty; the corners move with the rate).
    ///
    /// To first order: the derivative of the logarithm of the gain by the ratio of frequency and
    /// rate is exact, and its real and imaginary part carry the uncertainty to gain and phase.
    pub fn passage(&self, frequency: Measured, rate_uncertainty: f64) -> Passage {
        let warped = elementary::tan(PI * frequency.value / self.rate);
        let s = Phasor::new(0.0, warped);
        let slope: Phasor = self.sections.iter().map(|part| part.logarithmic_slope(s)).sum();
        // d s / d ln(frequency)
        let stretch = Phasor::new(0.0, PI * frequency.value / self.rate * (1.0 + warped * warped));
        let slope = slope * stretch;
        let relative =
            elementary::hypot(frequency.standard_uncertainty / frequency.value, rate_uncertainty);
        let response = self.response(frequency.value);
        let (gain, times) = (phasor::modulus(response), if self.both_ways { 2.0 } else { 1.0 });
        let measured = |value, standard_uncertainty| Measured {
            value,
            standard_uncertainty,
            degrees_of_freedom: frequency.degrees_of_freedom,
        };
        Passage {
            gain: measured(gain, gain * times * (slope.re * relative).abs()),
            phase: if self.both_ways {
                measured(0.0, 0.0)
            } else {
                measured(phasor::angle(response), (slope.im * relative).abs())
            },
        }
    }

    /// Filters a signal. The filter starts as if the signal's mean had been there for ever, so
    /// that an offset such as gravity causes no transient.
    ///
    /// `tolerance` (above zero) says when the start counts as forgotten: when no more than this
    /// part of the signal's greatest distance from its mean can be left of it.
    pub fn apply(&self, signal: &Signal, tolerance: f64) -> Changed {
        let mean = signal.values.iter().sum::<f64>() / signal.values.len().max(1) as f64;
        let mut values = signal.values.clone();
        self.run(&mut values, mean);
        let settling = self.settling(tolerance);
        if self.both_ways {
            let level = self.response(0.0).re.sqrt() * mean;
            values.reverse();
            self.run(&mut values, level);
            values.reverse();
        }
        Changed {
            signal: Signal { values, ..*signal },
            settling,
            unsettling: if self.both_ways { settling } else { 0 },
        }
    }

    fn run(&self, values: &mut [f64], level: f64) {
        let mut level = level;
        for (i, part) in self.sections.iter().enumerate() {
            let scale = if i == 0 { self.scale } else { 1.0 };
            level = part.run(values, level, scale);
        }
    }

    /// The number of values after which at most `tolerance` of the start is left: the first n for
    /// which the absolute values of the impulse response from n on add up to no more.
    pub fn settling(&self, tolerance: f64) -> usize {
        let mut response = self.impulse_response();
        let mut left = 0.0;
        while let Some(value) = response.pop() {
            left += value.abs();
            if left > tolerance {
                return response.len() + 1;
            }
        }
        0
    }

    /// How the filter changes white noise.
    pub fn noise(&self) -> NoiseGain {
        // the response of a run forward and one backward is the autocorrelation of the first, and
        // the sum of its squares the mean of the gain's fourth power (Parseval)
        let mut response = self.impulse_response();
        let mut means = vec![energy(&response)];
        for _ in 0..3 {
            self.run_back(&mut response);
            means.push(energy(&response));
        }
        let level = self.response(0.0).norm_sqr();
        let [power, fourth] =
            if self.both_ways { [means[1], means[3]] } else { [means[0], means[1]] };
        NoiseGain { power, fourth, level }
    }

    /// Turns values round, with room for what a run now adds at their end, and runs over them.
    fn run_back(&self, values: &mut Vec<f64>) {
        values.reverse();
        values.resize(values.len() + self.impulse_length(), 0.0);
        self.run(values, 0.0);
    }

    /// The response of one run to a one, until less than 1e-16 of the slowest part is left.
    fn impulse_response(&self) -> Vec<f64> {
        let mut values = vec![0.0; self.impulse_length()];
        values[0] = 1.0;
        self.run(&mut values, 0.0);
        values
    }

    fn impulse_length(&self) -> usize {
        let slowest = self.sections.iter().map(FilterSection::decay).fold(0.0, f64::max);
        // poles side by side decay with a power of time before the exponential wins: twice as long
        let length = (2.0 * -37.0 / elementary::ln(slowest)).ceil().clamp(64.0, 5e7);
        length as usize
    }
}

fn energy(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum()
}
