//! Oscillations that a fit does not have: found in the spectrum of its residuals.

use std::f64::consts::PI;

use crate::frequency::{between, windowed};
use gumption_engine::number::elementary::sin;
use gumption_engine::number::{largest_first, median};

/// The power of a bin over the median that noise alone exceeds in less than one record in a
/// thousand: of 2^15 exponential bins the largest is above ln 2 x 25 times the median with a
/// probability of 2^15 exp(-17.3) = 0.001.
const OVER_MEDIAN: f64 = 25.0;

/// Oscillations that are named at most.
pub(crate) const MOST: usize = 5;

/// Bins on each side of one that its background is taken from: from the third, which its own flanks
/// do not reach, to this one; and how many there must be.
const BACKGROUND: usize = 16;
const LEAST_BACKGROUND: usize = 6;

/// An oscillation in residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spurious {
    /// Cycles in a sample interval.
    pub cycles: f64,
    /// Its amplitude, in the channel's unit.
    pub amplitude: f64,
    /// Whether it is fitted with the frequencies that the recipe names.
    pub fitted: bool,
}

/// The standard deviation of what oscillations that are not fitted do to the cosine's and to the
/// sine's factor of a tone over so many samples, for unknown phases: of each the envelope of the
/// Dirichlet kernel at the two frequencies' difference and sum.
pub(crate) fn leakage(of: &[Spurious], cycles: f64, samples: f64) -> f64 {
    let envelope = |apart: f64| {
        let size = sin(PI * apart).abs() * samples;
        if size > 1.0 { 1.0 / size } else { 1.0 }
    };
    let square = |oscillation: &Spurious| {
        let (near, far) =
            (envelope(oscillation.cycles - cycles), envelope(oscillation.cycles + cycles));
        oscillation.amplitude * oscillation.amplitude * (near * near + far * far) / 4.0
    };
    of.iter().map(square).sum::<f64>().sqrt()
}

/// The oscillations that stand out of the spectrum of residuals, strongest first.
pub(crate) fn found(residuals: &[f64]) -> Vec<Spurious> {
    let count = residuals.len();
    if count < 64 {
        return Vec::new();
    }
    let power = windowed(residuals);
    let median = median(power.clone()).unwrap_or(0.0);
    let at = |bin: usize| power.get(bin).copied().unwrap_or(0.0);
    let mut peaks: Vec<Spurious> = (2..power.len())
        .filter(|bin| at(*bin) > OVER_MEDIAN * median)
        .filter(|bin| at(*bin) >= at(bin - 1) && at(*bin) > at(bin + 1))
        .map(|bin| {
            // the Hann window's gain is 1/2, and its peak and neighbours hold 3/2 of the peak's power
            let energy = at(bin - 1) + at(bin) + at(bin + 1);
            let amplitude = 4.0 * (energy / 1.5).sqrt() / count as f64;
            Spurious { cycles: bin as f64 / count as f64, amplitude, fitted: false }
        })
        .collect();
    largest_first(&mut peaks, |a| a.amplitude);
    peaks.truncate(MOST);
    peaks
}

/// The last bin of a level that wanders. The first one is not looked at: it has what the constant takes
/// of an oscillation.
const OF_LEVEL: usize = 4;

/// Whether there are oscillations among `of` that are not fitted, and beside them nothing at the lower
/// end of the spectrum: residuals that an oscillation correlates, and no level that wanders.
pub(crate) fn is_level_still(residuals: &[f64], of: &[Spurious]) -> bool {
    let count = residuals.len() as f64;
    let apart = |oscillation: &Spurious, bin: usize| oscillation.cycles * count - bin as f64;
    let tones =
        of.iter().filter(|oscillation| !oscillation.fitted && apart(oscillation, OF_LEVEL) > 0.5);
    let tones: Vec<&Spurious> = tones.collect();
    if tones.is_empty() {
        return false;
    }
    let power = windowed(residuals);
    let median = median(power.clone()).unwrap_or(0.0);
    (2..=OF_LEVEL).all(|bin| {
        // of a tone the Hann window leaks less than the inverse sixth power of the bins between
        let leaks = |oscillation: &&Spurious| {
            (oscillation.amplitude * count / 4.0).powi(2) / apart(oscillation, bin).powi(6)
        };
        let leaked: f64 = tones.iter().map(leaks).sum();
        power.get(bin).is_none_or(|power| *power < OVER_MEDIAN * median + leaked)
    })
}

/// Lines: oscillations that stand out of the spectrum of residuals on both sides, strongest first,
/// between the bins. Noise that is stronger at one end of the spectrum than at the other is none.
pub(crate) fn lines(residuals: &[f64]) -> Vec<Spurious> {
    let count = residuals.len();
    if count < 64 {
        return Vec::new();
    }
    let power = windowed(residuals);
    let at = |bin: usize| power.get(bin).copied().unwrap_or(0.0);
    let middle = |bins: std::ops::Range<usize>| {
        let near: Vec<f64> = bins.map(at).collect();
        if near.len() >= LEAST_BACKGROUND { median(near) } else { None }
    };
    let mut found: Vec<Spurious> = (2..power.len().saturating_sub(1))
        .filter(|bin| at(*bin) >= at(bin - 1) && at(*bin) > at(bin + 1))
        .filter(|bin| {
            let below = middle(bin.saturating_sub(BACKGROUND).max(1)..bin.saturating_sub(2).max(1));
            let above = middle((bin + 3).min(power.len())..(bin + BACKGROUND + 1).min(power.len()));
            match (below, above) {
                (Some(below), Some(above)) => at(*bin) > OVER_MEDIAN * below.max(above),
                _ => false,
            }
        })
        .map(|bin| {
            let energy = at(bin - 1) + at(bin) + at(bin + 1);
            let amplitude = 4.0 * (energy / 1.5).sqrt() / count as f64;
            let cycles = between(&power, bin) / count as f64;
            Spurious { cycles, amplitude, fitted: false }
        })
        .collect();
    largest_first(&mut found, |a| a.amplitude);
    found.truncate(MOST);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hum_is_found_with_its_amplitude() {
        let of = |i: u32| {
            let noise = (f64::from(i * 7919 % 1009) / 1009.0 - 0.5) * 0.2;
            0.3 * (2.0 * PI * 0.0503 * f64::from(i)).cos() + noise
        };
        let found = found(&(0..4096).map(of).collect::<Vec<f64>>());
        // the bin is within half of 1/4096; the scalloping of three bins below 3 %
        assert!((found[0].cycles - 0.0503).abs() < 1.3e-4, "{found:?}");
        assert!((found[0].amplitude - 0.3).abs() < 0.01, "{found:?}");
    }

    #[test]
    fn tones_are_no_wandering_level() {
        let noise = |i: u32| {
            let i = u64::from(i);
            ((i * i * 7919 % 10_007) as f64 / 10_007.0 - 0.5) * 0.02
        };
        let tone = |i: u32| (2.0 * PI * 0.0051 * f64::from(i)).cos() + noise(i);
        let still: Vec<f64> = (0..4096).map(tone).collect();
        assert!(is_level_still(&still, &found(&still)));
        // a drift of a tenth of its amplitude beside it
        let drifts: Vec<f64> = (0..4096).map(|i| tone(i) + f64::from(i) / 20_480.0).collect();
        assert!(!is_level_still(&drifts, &found(&drifts)));
        let mut level = 0.0;
        let walk = |i: u32| {
            level += noise(i);
            level
        };
        let walk: Vec<f64> = (0..4096).map(walk).collect();
        assert!(!is_level_still(&walk, &found(&walk)));
        let plain: Vec<f64> = (0..4096).map(noise).collect();
        assert!(!is_level_still(&plain, &found(&plain)));
    }
}
