//! What rounding to a resolution does to a fit when there is too little noise to blur it.
//!
//! Rounding to steps q adds to a value x the sawtooth (q/pi) sum over k of (-1)^k/k sin(2 pi k x/q),
//! which noise of standard deviation s before rounding damps by exp(-2 (pi k s/q)^2) (B. Widrow,
//! I. Kollár, Quantization Noise, 2008). What is left is a function of the oscillation alone: it
//! repeats wherever the oscillation does, and a fit averages it over the different values that were
//! sampled, not over all samples. Here the fitted oscillation is rounded at the record's own instants,
//! and the variance of what that does to the fit is taken over the level within a step, which nobody
//! knows.

use std::f64::consts::PI;

use crate::passes::BLOCK;
use crate::phasor::at_turns;
use crate::quantization::quantization_variance;
use crate::sine_fit::{ToneCoefficients, ToneDesign, ToneSums, Waves};
use gumption_engine::number::elementary::{exp, hypot, sin_cos_turn};

/// Terms of the sawtooth at most, and samples times terms.
const MOST_TERMS: u32 = 10;
const MOST_WORK: u64 = 1 << 20;

/// Places of the samples on the oscillation that are averaged over.
const PLACES: u32 = 4;

/// The part of the rounding that must repeat for it to count.
const LEAST: f64 = 1e-3;

/// What rounding does to the coefficients of a fit.
#[derive(Clone, Debug)]
pub(crate) struct Rounding {
    /// The part of the rounding's variance, resolution^2/12, that is a function of the oscillation;
    /// the rest is noise.
    pub(crate) repeated: f64,
    /// The variance of the rounded values about what repeats: of the noise, and of the rounding that
    /// it scatters.
    pub(crate) scattered: f64,
    /// The variance of the constant from that part.
    pub(crate) offset: f64,
    /// For each tone the variance of the cosine's factor, the covariance of both, the variance of the
    /// sine's.
    pub(crate) tones: Vec<[f64; 3]>,
    /// Different phases of the oscillation that were sampled, where they are fewer than the samples.
    pub(crate) phases: Option<u64>,
}

impl Rounding {
    /// Of the fit of a record that was rounded to `resolution`, with `noise` the standard deviation
    /// before rounding. None where noise leaves nothing that repeats.
    pub(crate) fn of(
        design: &ToneDesign,
        fit: &ToneCoefficients,
        resolution: f64,
        noise: f64,
    ) -> Option<Self> {
        let spread = noise / resolution;
        // the variance of term k over that of the whole sawtooth
        let share = |k: u32| {
            let damped = 2.0 * PI * f64::from(k) * spread;
            6.0 / (PI * PI) * exp(-damped * damped) / f64::from(k * k)
        };
        let repeated: f64 = (1..=1000).map(share).sum();
        if repeated.is_nan() || repeated <= LEAST {
            return None;
        }
        let affordable = (MOST_WORK / design.samples).clamp(2, u64::from(MOST_TERMS)) as u32;
        let terms = (1..=affordable).take_while(|k| share(*k) > 1e-3 * repeated).count() as u32;
        let phases = phases(design, fit, resolution);
        let (cycles, size) = strongest(design, fit)?;
        // instants that are later by parts of the distance of two sampled phases, and a size that
        // is known to a part of a step: at the very values of the fit, which rounding pulls to
        // where the samples are symmetrical, too little would be left
        let between = 1.0 / (phases.unwrap_or(design.samples) as f64 * cycles);
        let beside = (0..PLACES).map(|place| {
            let place = f64::from(place) / f64::from(PLACES);
            let larger = 1.0 + (place - 0.375) * resolution / size.max(resolution);
            moved(design, fit, between * ((3.0 * place) % 1.0), larger)
        });
        let sums: Vec<Vec<[ToneSums; 2]>> =
            beside.map(|fit| Self::sums(design, &fit, resolution, terms)).collect();
        let summed: f64 = (1..=terms).map(share).sum();
        // terms that are left out turn so fast from one place to the next that they are as white as
        // noise, but over phases only that are different to them: it is these terms that act across a
        // sine that is sampled evenly
        let whole = quantization_variance(resolution);
        let different = self::phases(design, fit, resolution / f64::from(terms.max(1)));
        let again = design.samples as f64 / different.unwrap_or(design.samples) as f64;
        let rest = whole * (repeated - summed).max(0.0) * again;
        let mut offset = rest * design.even[(0, 0)];
        let of_rest =
            |k: usize| [rest * design.even[(k + 1, k + 1)], 0.0, rest * design.odd[(k, k)]];
        let mut tones: Vec<[f64; 3]> = (0..design.tones.len()).map(of_rest).collect();
        let each = sums.iter().flat_map(|sums| (1..=terms).zip(sums));
        for (k, [re, im]) in each {
            let size = whole * share(k) / f64::from(PLACES);
            let [re, im] = [design.solve(re), design.solve(im)];
            offset += size * (re.offset * re.offset + im.offset * im.offset);
            for (tone, sizes) in tones.iter_mut().enumerate() {
                let (a, b) =
                    ((re.cosines[tone], im.cosines[tone]), (re.sines[tone], im.sines[tone]));
                sizes[0] += size * (a.0 * a.0 + a.1 * a.1);
                sizes[1] += size * (a.0 * b.0 + a.1 * b.1);
                sizes[2] += size * (b.0 * b.0 + b.1 * b.1);
            }
        }
        let scattered = noise * noise + whole * (1.0 - repeated).max(0.0);
        Some(Self { repeated, scattered, offset, tones, phases })
    }

    /// Sums of cosine and sine of 2 pi k x/q with the waves of the fit, for each k.
    fn sums(
        design: &ToneDesign,
        fit: &ToneCoefficients,
        resolution: f64,
        terms: u32,
    ) -> Vec<[ToneSums; 2]> {
        let plain = || [ToneSums::plain(design), ToneSums::plain(design)];
        let mut sums: Vec<[ToneSums; 2]> = (0..terms).map(|_| plain()).collect();
        each(design, fit, |values, waves| {
            let once: Vec<(f64, f64)> = values
                .iter()
                .map(|x| {
                    let turns = x / resolution;
                    sin_cos_turn(turns - turns.floor())
                })
                .collect();
            let (mut re, mut im) = (vec![1.0; values.len()], vec![0.0; values.len()]);
            for [of_re, of_im] in &mut sums {
                for ((re, im), (sin, cos)) in re.iter_mut().zip(&mut im).zip(&once) {
                    (*re, *im) = (*re * cos - *im * sin, *re * sin + *im * cos);
                }
                of_re.add(&re, waves);
                of_im.add(&im, waves);
            }
        });
        sums
    }
}

/// The standard deviation of the noise before rounding, of residuals of the variance `left`, of which
/// the first are at hand.
///
/// Rounding itself leaves resolution^2/12 on the average over many different values, but another
/// variance of few. Where the oscillation is sampled at the same phases again, it is the difference of
/// values that should be equal, or nearly so, that tells noise from rounding.
pub(crate) fn noise_before(
    design: &ToneDesign,
    fit: &ToneCoefficients,
    resolution: f64,
    left: f64,
    first: &[f64],
) -> f64 {
    let plain = left - quantization_variance(resolution);
    if plain > resolution * resolution / 4.0 {
        return plain.sqrt();
    }
    let Some((lag, drift)) = lag(design, fit, resolution, first.len() as u64 / 2) else {
        return plain.max(0.0).sqrt();
    };
    let pairs = first.iter().zip(first.get(lag..).unwrap_or(&[]));
    let count = pairs.len() as f64;
    let scatter: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / (2.0 * count);
    let scatter = scatter / (resolution * resolution);
    // half the mean square of such a difference, for noise of so many steps
    let expected = |noise: f64| {
        let mut sum = noise * noise + 1.0 / 12.0;
        for k in 1..=200 {
            let k = f64::from(k);
            let damped = 2.0 * PI * k * noise;
            let alike: f64 = (0..16)
                .map(|phase| at_turns(k * drift * at_turns((f64::from(phase) + 0.5) / 64.0).re).re)
                .sum();
            sum -= exp(-damped * damped) / (2.0 * PI * PI * k * k) * alike / 16.0;
        }
        sum
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..30 {
        let middle = f64::midpoint(low, high);
        if expected(middle) < scatter { low = middle } else { high = middle }
    }
    resolution * low
}

/// A fit whose oscillations are larger by a factor and come earlier by so many sample intervals.
fn moved(design: &ToneDesign, fit: &ToneCoefficients, by: f64, larger: f64) -> ToneCoefficients {
    let mut fit = fit.clone();
    let factors = fit.cosines.iter_mut().zip(&mut fit.sines);
    for (tone, (a, b)) in design.tones.iter().zip(factors) {
        let turned = at_turns(tone.cycles * by) * larger;
        (*a, *b) = (*a * turned.re + *b * turned.im, *b * turned.re - *a * turned.im);
    }
    fit
}

/// Goes through the values of a fit with the waves of its tones.
fn each(design: &ToneDesign, fit: &ToneCoefficients, mut with: impl FnMut(&[f64], &Waves)) {
    let at_first = design.at_first(fit);
    let mut waves = design.waves();
    for first in (0..design.samples).step_by(BLOCK) {
        let length = (design.samples - first).min(BLOCK as u64) as usize;
        design.fill(&mut waves, first, length);
        with(&waves.values(&at_first, length), &waves);
    }
}

/// The number of different phases of the strongest oscillation that were sampled: the samples after
/// which it is sampled at the same ones again, to within a step over the record; none where there are
/// none below half the record.
fn phases(design: &ToneDesign, fit: &ToneCoefficients, resolution: f64) -> Option<u64> {
    let (cycles, size) = strongest(design, fit)?;
    let most = (design.samples / 2).min(1 << 16);
    (1..=most).find(|count| {
        let times = (design.samples / count) as f64;
        apart(cycles, *count) * times * size < resolution
    })
}

/// The least number of samples, up to some, after which values of the oscillation are the same to
/// within a tenth of a step, and by how many steps they differ at most.
fn lag(
    design: &ToneDesign,
    fit: &ToneCoefficients,
    resolution: f64,
    most: u64,
) -> Option<(usize, f64)> {
    let (cycles, size) = strongest(design, fit)?;
    let drift = |count: u64| apart(cycles, count) * size / resolution;
    let count = (1..=most).find(|count| drift(*count) < 0.1)?;
    Some((count as usize, drift(count)))
}

/// How far, in radians, a phase is from where it was so many samples before.
fn apart(cycles: f64, count: u64) -> f64 {
    let turns = cycles * count as f64;
    2.0 * PI * (turns - turns.round()).abs()
}

/// Cycles in a sample interval and amplitude of the strongest oscillation.
fn strongest(design: &ToneDesign, fit: &ToneCoefficients) -> Option<(f64, f64)> {
    let sizes = fit.cosines.iter().zip(&fit.sines).map(|(a, b)| hypot(*a, *b));
    let tones = design.tones.iter().map(|tone| tone.cycles).zip(sizes);
    tones.max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sine_fit::Tone;

    /// The variances over the level within a step, the size to a step and the phase to the distance of
    /// two samples, by rounding at 600 of each, coherent and not.
    #[test]
    fn variances_are_those_over_levels() {
        for (cycles, samples, size) in
            [(0.008, 1000, 30.0), (0.0073, 3150, 7.5), (0.0731, 977, 3.2)]
        {
            let tone = |multiple: u32| Tone {
                cycles: cycles * f64::from(multiple),
                fundamental: 0,
                multiple,
                beside: false,
            };
            let design = ToneDesign::new(vec![tone(1), tone(2)], samples).unwrap();
            let values = |size: f64, turn: f64| -> Vec<f64> {
                let value = |i| size * at_turns(cycles * i as f64 + turn).re;
                (0..samples).map(value).collect()
            };
            let fit = design.fit_values(&values(size, 0.1));
            let found = Rounding::of(&design, &fit, 1.0, 0.0).unwrap();
            let mut squares = [0.0; 3];
            let places = 600;
            for place in 0..places {
                let even = |by: f64| (f64::from(place) * by).fract();
                let size = size - 0.5 + even(0.754_877_666_246_693);
                let exact = values(size, 0.1 + 0.01 * even(0.569_840_290_998_053));
                let level = (f64::from(place) + 0.5) / f64::from(places);
                let rounded: Vec<f64> =
                    exact.iter().map(|x| (x + level).round() - x - level).collect();
                let off = design.fit_values(&rounded);
                let size = |a: f64, b: f64| (a * a + b * b) / 2.0;
                let errors = [
                    off.offset * off.offset,
                    size(off.cosines[0], off.sines[0]),
                    size(off.cosines[1], off.sines[1]),
                ];
                for (sum, error) in squares.iter_mut().zip(errors) {
                    *sum += error / f64::from(places);
                }
            }
            let of = |tone: usize| f64::midpoint(found.tones[tone][0], found.tones[tone][2]);
            for (by_places, expected) in squares.iter().zip([found.offset, of(0), of(1)]) {
                // ten terms of the sawtooth at four places: a standard uncertainty to 15 %
                let ratio = (by_places / expected).sqrt();
                assert!((0.85..1.15).contains(&ratio), "{cycles}: {ratio}");
            }
            assert!((found.repeated - 1.0).abs() < 1e-3);
            let half = Rounding::of(&design, &fit, 1.0, 0.3).unwrap();
            assert!(half.repeated < 0.02 && half.offset < 0.1 * found.offset);
            assert!(Rounding::of(&design, &fit, 1.0, 0.5).is_none());
            if cycles == 0.008 {
                assert_eq!(found.phases, Some(125));
            }
        }
    }
}
