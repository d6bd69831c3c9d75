//! The noise of a record, from a part of it in which nothing happens, or from a record without a signal.

use std::f64::consts::TAU;

use super::spectrum::Lines;
use crate::{Signal, transform};
use gumption_engine::number::elementary;

/// Segments whose periodograms are averaged, each overlapping the next by half.
const SEGMENTS: usize = 8;

/// The fewest values of a segment.
const FEWEST: usize = 8;

/// What colour the noise is taken to have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NoiseColour {
    /// The spectral density is measured.
    #[default]
    Measured,
    /// It is the same at all frequencies.
    White,
}

/// What is known of the noise of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum QuietPart {
    /// White noise with this standard deviation, in the unit of the record.
    Stated(f64),
    /// That of the record between two instants, in seconds.
    Between {
        /// The first instant.
        from: f64,
        /// The last.
        to: f64,
        /// Its colour.
        colour: NoiseColour,
    },
    /// That of another record of the same channel, taken without a signal.
    Record {
        /// The record.
        signal: Signal,
        /// Its colour.
        colour: NoiseColour,
    },
}

impl QuietPart {
    /// The spectral density of the noise at each line, as the variance of the white noise that has it everywhere.
    ///
    /// # Errors
    /// A sentence on why it cannot be known.
    pub(super) fn densities(&self, signal: &Signal, lines: &Lines) -> Result<Vec<f64>, String> {
        let (quiet, colour) = match self {
            Self::Stated(deviation) => return Ok(vec![deviation * deviation; lines.count()]),
            Self::Between { from, to, colour } => (part(signal, *from, *to)?, *colour),
            Self::Record { signal: quiet, colour } => {
                if quiet.rate != signal.rate {
                    return Err(format!(
                        "the record of the noise has a sampling rate of {} Hz, and the signal one of {} Hz; record \
                         both at the same rate",
                        quiet.rate, signal.rate
                    ));
                }
                (quiet.values.as_slice(), *colour)
            }
        };
        match colour {
            NoiseColour::White => {
                let variance = variance(quiet)?;
                Ok(vec![variance; lines.count()])
            }
            NoiseColour::Measured => {
                let densities = averaged_periodogram(quiet)?;
                let bin = signal.rate / (2 * (densities.len() - 1)) as f64;
                Ok((0..lines.count())
                    .map(|line| between(&densities, lines.hertz(line) / bin))
                    .collect())
            }
        }
    }
}

/// The values between two instants.
pub(super) fn part(signal: &Signal, from: f64, to: f64) -> Result<&[f64], String> {
    let index = |instant: f64| ((instant - signal.start) * signal.rate).round();
    let [first, last] = [index(from), index(to)];
    let end = signal.values.len() as f64;
    if !(first >= 0.0 && last > first && last < end) {
        return Err(format!(
            "the part without a signal, from {from} s to {to} s, does not lie within the record, which goes from {} s \
             to {} s",
            signal.start,
            signal.instant(end - 1.0)
        ));
    }
    Ok(signal.values.get(first as usize..=last as usize).unwrap_or(&[]))
}

/// The variance about the mean.
fn variance(values: &[f64]) -> Result<f64, String> {
    if values.len() < 2 {
        return Err("the noise needs at least two values".to_owned());
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    Ok(squares / (values.len() - 1) as f64)
}

/// The mean of the periodograms of overlapping segments under a Hann window (Welch 1967, IEEE Transactions on Audio
/// and Electroacoustics 15, 70), from zero to half the rate. Zero has the density of its neighbour: the mean is taken
/// off.
fn averaged_periodogram(values: &[f64]) -> Result<Vec<f64>, String> {
    let half = values.len() / (SEGMENTS + 1);
    let length = 2 * half;
    if length < FEWEST {
        return Err(format!(
            "{} values are too few for a spectrum of the noise; take a longer part, or write `\"colour\": \"white\"`",
            values.len()
        ));
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let window: Vec<f64> =
        (0..length).map(|i| 0.5 - 0.5 * elementary::cos(TAU * i as f64 / length as f64)).collect();
    let power: f64 = window.iter().map(|w| w * w).sum();
    let mut densities = vec![0.0; half + 1];
    let mut taken = 0.0_f64;
    for segment in values.windows(length).step_by(half) {
        let windowed: Vec<f64> =
            segment.iter().zip(&window).map(|(value, w)| (value - mean) * w).collect();
        for (density, bin) in densities.iter_mut().zip(transform::forward(&windowed)) {
            *density += bin.norm_sqr() / power;
        }
        taken += 1.0;
    }
    densities.iter_mut().for_each(|density| *density /= taken);
    densities[0] = densities[1];
    Ok(densities)
}

/// Linear between entries; `place` is at most the last one's.
fn between(values: &[f64], place: f64) -> f64 {
    let first = (place.floor() as usize).min(values.len() - 2);
    let share = place - first as f64;
    values[first] * (1.0 - share) + values[first + 1] * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::simulated::normals;

    /// White noise has its variance at all frequencies: the mean over 500 bins of a mean of 8 periodograms scatters by
    /// 1/sqrt(500*8*0.8) = 2 %; three of these. The density of a first difference is 4 sin^2(pi f/rate) times it, so
    /// that the half below a quarter of the rate has (1 - 2/pi)/2 of twice its variance.
    #[test]
    fn densities_of_noise() {
        let white = normals(3, "quiet", 9000);
        let signal = |values: Vec<f64>| Signal { values, rate: 100.0, start: 0.0 };
        let lines = Lines { samples: 1000, spacing: 0.1 };
        let mean = |densities: &[f64]| densities.iter().sum::<f64>() / densities.len() as f64;
        let colour = NoiseColour::Measured;
        let part = QuietPart::Between { from: 0.0, to: 89.99, colour };
        let found = part.densities(&signal(white.clone()), &lines).unwrap();
        assert!((mean(&found) - 1.0).abs() < 0.06, "{}", mean(&found));
        let differences: Vec<f64> = white.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let record = QuietPart::Record { signal: signal(differences), colour };
        let found = record.densities(&signal(white.clone()), &lines).unwrap();
        let below = mean(&found[..250]);
        let expected = 2.0 - 4.0 / std::f64::consts::PI;
        assert!((below / expected - 1.0).abs() < 0.1, "{below} {expected}");
        let stated = QuietPart::Stated(2.0).densities(&signal(white), &lines).unwrap();
        assert_eq!((stated.len(), stated[0]), (501, 4.0));
    }

    #[test]
    fn parts_outside_the_record_are_refused() {
        let signal = Signal { values: vec![0.0; 100], rate: 10.0, start: 5.0 };
        let lines = Lines::of(&signal);
        for (from, to) in [(4.0, 6.0), (6.0, 6.0), (7.0, 15.1), (f64::NAN, 6.0)] {
            let part = QuietPart::Between { from, to, colour: NoiseColour::White };
            assert!(part.densities(&signal, &lines).is_err(), "{from} {to}");
        }
    }
}
