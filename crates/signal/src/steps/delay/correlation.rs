//! The delay at which the cross-correlation of two signals is greatest, between samples.

use std::f64::consts::{PI, TAU};

use crate::noise::density;
use crate::periodic::{Harmonic, HarmonicNoise, Harmonics, Periodic};
use crate::rms::together;
use crate::unsuitable::within;
use crate::{Measured, Phasor, Signal, Unsuitable, phasor, transform};
use gumption_engine::number::elementary;

/// Frequencies from which the score's density is taken: 64 degrees of freedom.
const NEAR_ZERO: usize = 32;

/// Part of the overlap that rises and falls at each end.
const TAPERED: f64 = 0.1;

/// How two signals are correlated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CrossCorrelation {
    /// Periodic signals: the correlation over one period of their least-squares harmonics. Nothing
    /// leaks, whatever the number of periods; the delay is that nearest to zero and may be a whole
    /// number of periods more or less.
    Periodic(Harmonics),
    /// Signals that do not repeat: the correlation of what overlaps, by the transform, of the
    /// frequencies in a band. A sine is not such a signal: its ends would pull the maximum.
    Band {
        /// The greatest delay either way that comes into question, in seconds.
        longest: f64,
        /// The frequencies that count, in hertz, the limits included: those of the signal, as others
        /// bring noise only.
        between: [f64; 2],
    },
}

/// A delay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// The channel's delay, in seconds; positive where it comes later than the reference.
    pub delay: Measured,
    /// The coefficient of correlation of the signals at the maximum, -1 to 1: their normalized
    /// cross-correlation, about their offsets and with what is noise in them; of
    /// [`CrossCorrelation::Band`], of what they have in the band.
    pub correlation: f64,
    /// The period in seconds of which any number may be added to the delay; none where the delay
    /// is the only one within the search.
    pub period: Option<f64>,
}

impl CrossCorrelation {
    /// The delay of a channel against a reference, both sampled together.
    ///
    /// To first order in the noise of both signals. Of periodic signals it is the law of
    /// propagation from the harmonics' phases, with white noise, independent in the two signals, and
    /// the leakage of oscillations that are not fitted. Otherwise the variance of the sum
    /// whose zero is the maximum is taken from the spectral density of its terms, which holds for
    /// noise of any colour; 64 degrees of freedom. It lacks what the ends of the window cost, some
    /// 1e-5 of a sample over a few thousand values, which counts above about 70 dB.
    ///
    /// # Errors
    /// Signals of different lengths or rates or with values that are not finite, a search longer
    /// than half the signal, a maximum at its end, harmonics that cannot be fitted, silence.
    pub fn of(&self, reference: &Signal, channel: &Signal) -> Result<Delay, Unsuitable> {
        together(reference, channel)?;
        let late = channel.start - reference.start;
        let mut found = match *self {
            Self::Periodic(harmonics) => {
                return Ok(of_harmonics(reference, channel, harmonics, [None, None])?.delay);
            }
            Self::Band { longest, between } => {
                let mut found = in_band(reference, channel, longest, between)?;
                found.delay.value += late;
                found
            }
        };
        found.correlation = found.correlation.clamp(-1.0, 1.0);
        Ok(found)
    }
}

/// The delay of one periodic signal against another, and what it comes from.
#[derive(Clone, Debug)]
pub(crate) struct HarmonicDelay {
    pub(crate) delay: Delay,
    /// The fits of the two, in the noise that is known of them.
    pub(super) fits: [Periodic; 2],
    /// How far the delay moves with the phase of each harmonic of either, in seconds for a radian.
    pub(super) pulls: Vec<f64>,
}

/// The delay of one periodic signal against another in the noise that is known of the two: the law of
/// propagation from the harmonics' phases.
pub(crate) fn of_harmonics(
    reference: &Signal,
    channel: &Signal,
    harmonics: Harmonics,
    known: [Option<&HarmonicNoise>; 2],
) -> Result<HarmonicDelay, Unsuitable> {
    together(reference, channel)?;
    let late = channel.start - reference.start;
    let [x, y] = [Periodic::fit(reference, harmonics)?, Periodic::fit(channel, harmonics)?];
    let [of_x, of_y] = known;
    let fits = [x.in_known(of_x).leaking(reference), y.in_known(of_y).leaking(channel)];
    let mut found = periodic([reference, channel], fits, harmonics, late)?;
    found.delay.correlation = found.delay.correlation.clamp(-1.0, 1.0);
    Ok(found)
}

/// Value, first and second derivative of the sum of Re(`c` exp(2 pi i f t)) at a time.
fn at(terms: &[(f64, Phasor)], time: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for &(f, c) in terms {
        let (w, turned) = (TAU * f, c * phasor::at_turns(f * time));
        sums[0] += turned.re;
        sums[1] -= w * turned.im;
        sums[2] -= w * w * turned.re;
    }
    sums
}

/// The maximum of such a sum between two times with a single one: Newton's steps where they stay
/// inside and bisections of the slope's sign where they do not.
fn maximum(terms: &[(f64, Phasor)], mut low: f64, mut high: f64) -> f64 {
    let scale = high - low;
    let mut time = f64::midpoint(low, high);
    for _ in 0..100 {
        let [_, slope, bend] = at(terms, time);
        if slope > 0.0 {
            low = time;
        } else {
            high = time;
        }
        let step = time - slope / bend;
        let next =
            if bend < 0.0 && step > low && step < high { step } else { f64::midpoint(low, high) };
        let moved = (next - time).abs();
        time = next;
        if moved < 1e-14 * scale {
            break;
        }
    }
    time
}

fn periodic(
    signals: [&Signal; 2],
    [x, y]: [Periodic; 2],
    harmonics: Harmonics,
    late: f64,
) -> Result<HarmonicDelay, Unsuitable> {
    let turned =
        |part: &Harmonic| (part.frequency, part.phasor * phasor::at_turns(-part.frequency * late));
    let terms: Vec<(f64, Phasor)> = x
        .parts
        .iter()
        .zip(y.parts.iter().map(turned))
        .map(|(x, (f, y))| (f, x.phasor.conj() * y))
        .collect();
    let period = 1.0 / harmonics.frequency;
    let steps = 32 * terms.len();
    let times: Vec<f64> = (0..steps).map(|i| period * (i as f64 / steps as f64 - 0.5)).collect();
    let values: Vec<f64> = times.iter().map(|&time| at(&terms, time)[0]).collect();
    let best = (0..steps).fold(0, |best, i| if values[i] > values[best] { i } else { best });
    let step = period / steps as f64;
    let time = maximum(&terms, times[best] - step, times[best] + step);
    let [value, _, bend] = at(&terms, time);
    let power = |all: &Periodic| all.parts.iter().map(|p| p.phasor.norm_sqr()).sum::<f64>();
    if power(&x) * power(&y) == 0.0 || bend >= 0.0 {
        return Err(Unsuitable::Silent { frequency: harmonics.frequency });
    }
    let pairs = || x.parts.iter().zip(&y.parts);
    let pulls: Vec<f64> = pairs()
        .map(|(x, y)| {
            let sizes = phasor::modulus(x.phasor) * phasor::modulus(y.phasor);
            TAU * x.frequency * sizes / -bend
        })
        .collect();
    let variance: f64 = pairs()
        .zip(&pulls)
        .flat_map(|((x, y), pull)| [x, y].map(|part| pull * part.phase().standard_uncertainty))
        .map(|u| u * u)
        .sum();
    let freedom = x.parts[0].degrees_of_freedom.min(y.parts[0].degrees_of_freedom);
    let delay = Delay {
        delay: Measured {
            value: time - period * (time / period).round(),
            standard_uncertainty: variance.sqrt(),
            degrees_of_freedom: freedom,
        },
        correlation: with_noise(signals, [&x, &y], value, time - late),
        period: Some(period),
    };
    Ok(HarmonicDelay { delay, fits: [x, y], pulls })
}

/// The coefficient of correlation of two signals where `value` is the sum of the products of their
/// harmonics' amplitudes. What is left of them counts at the nearest whole sample.
fn with_noise(signals: [&Signal; 2], fits: [&Periodic; 2], value: f64, delay: f64) -> f64 {
    let [x, y] = [0, 1].map(|i| fits[i].without(signals[i]));
    let lag = (delay * signals[0].rate).round();
    let (of_x, of_y) = ((-lag).max(0.0) as usize, lag.max(0.0) as usize);
    let [early, late] = [x.get(of_x..).unwrap_or(&[]), y.get(of_y..).unwrap_or(&[])];
    let n = x.len() as f64;
    let left = early.iter().zip(late).map(|(x, y)| x * y).sum::<f64>() / n;
    let power = |fit: &Periodic, left: &[f64]| {
        let harmonics = fit.parts.iter().map(|part| part.phasor.norm_sqr()).sum::<f64>();
        harmonics / 2.0 + left.iter().map(|e| e * e).sum::<f64>() / n
    };
    (value / 2.0 + left) / (power(fits[0], &x) * power(fits[1], &y)).sqrt()
}

fn in_band(
    reference: &Signal,
    channel: &Signal,
    longest: f64,
    between: [f64; 2],
) -> Result<Delay, Unsuitable> {
    let (n, rate) = (reference.values.len(), reference.rate);
    for signal in [reference, channel] {
        if let Some(sample) = signal.values.iter().position(|value| !value.is_finite()) {
            return Err(Unsuitable::NotFinite { sample });
        }
    }
    if n < 64 {
        return Err(Unsuitable::TooShort { samples: n, needed: 64 });
    }
    within("the longest delay (s)", longest, [0.0, n as f64 / rate / 2.0])?;
    within("the lower end of the band (Hz)", between[0], [f64::NEG_INFINITY, between[1]])?;
    let silent = Unsuitable::Silent { frequency: between[0] };

    // whole samples: the linear correlation, with as many zeros as values
    let padded = |signal: &Signal| {
        let mean = signal.values.iter().sum::<f64>() / n as f64;
        let mut values: Vec<f64> = signal.values.iter().map(|x| x - mean).collect();
        values.resize(2 * n, 0.0);
        transform::forward(&values)
    };
    let (x, mut y) = (padded(reference), padded(channel));
    for (j, (y, x)) in y.iter_mut().zip(&x).enumerate().take(n + 1) {
        let f = j as f64 * rate / (2 * n) as f64;
        let counts = f >= between[0] && f <= between[1];
        *y = if counts { x.conj() * *y } else { Phasor::new(0.0, 0.0) };
    }
    let correlation = transform::inverse(y);
    let reach = ((longest * rate).floor() as usize).clamp(1, n / 2) as i64;
    let of = |lag: i64| correlation[lag.rem_euclid(2 * n as i64) as usize];
    let best =
        (-reach..=reach).fold(-reach, |best, lag| if of(lag) > of(best) { lag } else { best });
    if of(best) <= 0.0 {
        return Err(silent);
    }
    if best.abs() == reach {
        let end = best as f64 / rate;
        return Err(Unsuitable::AtTheEnd { what: "the delay (s)", end });
    }

    // what overlaps after that shift, both from the same window
    let shift = best.unsigned_abs() as usize;
    let (x_first, y_first) = if best > 0 { (0, shift) } else { (shift, 0) };
    let length = n - shift;
    let (x, y) = (
        windowed(&reference.values[x_first..x_first + length]),
        windowed(&channel.values[y_first..y_first + length]),
    );
    let (x, y) = (transform::forward(&x), transform::forward(&y));
    let bin = rate / length as f64;
    let counts = |j: usize| {
        let f = j as f64 * bin;
        j > 0 && 2 * j < length && f >= between[0] && f <= between[1]
    };
    let terms: Vec<(f64, Phasor)> = (0..length.div_ceil(2))
        .filter(|&j| counts(j))
        .map(|j| (j as f64 * bin, x[j].conj() * y[j]))
        .collect();
    let time = maximum(&terms, -1.5 / rate, 1.5 / rate);
    let [value, _, bend] = at(&terms, time);
    let power = |phasors: &[Phasor]| {
        (0..length.div_ceil(2)).filter(|&j| counts(j)).map(|j| phasors[j].norm_sqr()).sum::<f64>()
    };
    let (x_power, both) = (power(&x), (power(&x) * power(&y)).sqrt());
    if both == 0.0 || bend >= 0.0 {
        return Err(silent);
    }
    // the slope of the correlation is the sum of x'(t - delay) e(t), e being what the delayed and
    // scaled reference leaves of the channel
    let scale = value / x_power;
    let mut slope = vec![Phasor::new(0.0, 0.0); length];
    let mut rest = slope.clone();
    for j in (0..length.div_ceil(2)).filter(|&j| counts(j)) {
        let f = j as f64 * bin;
        let delayed = x[j] * phasor::at_turns(-f * time);
        slope[j] = delayed * Phasor::new(0.0, TAU * f);
        rest[j] = y[j] - delayed * scale;
    }
    let (slope, rest) = (transform::inverse(slope), transform::inverse(rest));
    let score: Vec<f64> = slope.iter().zip(&rest).map(|(d, e)| d * e).collect();
    let near = density(&score, 0.0, NEAR_ZERO);
    // the sum over all instants of x' x' is twice that over the frequencies above zero, over length
    let curvature = -bend * 2.0 / length as f64;
    Ok(Delay {
        delay: Measured {
            value: best as f64 / rate + time,
            standard_uncertainty: (near.variance * length as f64).sqrt() / curvature,
            degrees_of_freedom: near.degrees_of_freedom,
        },
        correlation: value / both,
        period: None,
    })
}

/// Values less their mean, rising and falling by half a period of a cosine at the ends.
fn windowed(values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let mean = values.iter().sum::<f64>() / n as f64;
    let rise = ((TAPERED * n as f64) as usize).max(1);
    let weight = |i: usize| {
        let place = i.min(n - 1 - i);
        if place < rise {
            0.5 - 0.5 * elementary::cos(PI * (place as f64 + 0.5) / rise as f64)
        } else {
            1.0
        }
    };
    values.iter().enumerate().map(|(i, x)| (x - mean) * weight(i)).collect()
}
