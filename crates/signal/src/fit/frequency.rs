//! The frequency of an oscillation from its recording: the four-parameter sine fit of IEEE Std 1057,
//! with harmonics.
//!
//! A search over the phases of short parts of the record comes within a small part of a period of
//! the right frequency; Gauss-Newton steps, from which the constant and the amplitudes are projected
//! out, end at the least-squares solution.

use crate::passes::{BLOCK, SampleSource};
use crate::residuals;
use crate::residuals::Residuals;
use crate::sine_fit::{NoFit, Tone, ToneCoefficients, ToneDesign};
use crate::turns::{Turns, oscillation};
use crate::{Phasor, fft};

/// Parts whose phases the search follows.
const PARTS: usize = 512;

/// Samples in which an oscillation of unknown frequency is looked for.
const LOOKED_AT: usize = 1 << 18;

/// Gauss-Newton steps at most.
const MOST_STEPS: usize = 30;

/// Why no frequency was found.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NoFrequency<E> {
    /// The recording cannot be read.
    Unreadable(E),
    /// The tones cannot be fitted at the frequency that was tried.
    NoFit(NoFit),
    /// There is no oscillation near the frequency that was asked for, or nothing but noise.
    NotFound,
}

/// A fit whose cycles were estimated.
#[derive(Clone, Debug)]
pub(crate) struct EstimatedCycles {
    /// Cycles in a sample interval of the fundamental.
    pub(crate) cycles: f64,
    /// Their variance for residuals of variance 1.
    pub(crate) variance: f64,
}

/// Estimates the cycles in a sample interval of one oscillation and its `multiples` on the first
/// channel, from a first guess, or from nothing.
pub(crate) fn estimate<E>(
    passes: &mut dyn SampleSource<Error = E>,
    guess: Option<f64>,
    multiples: &[u32],
) -> Result<EstimatedCycles, NoFrequency<E>> {
    let samples = passes.frames();
    let start = match guess {
        Some(cycles) => cycles,
        None => strongest(passes).map_err(NoFrequency::Unreadable)?.ok_or(NoFrequency::NotFound)?,
    };
    let mut cycles = searched(passes, start).map_err(NoFrequency::Unreadable)?;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (_, residuals) = fitted(passes, cycles, multiples, samples)?;
        let (step, variance) = residuals.cycles[0];
        if !variance.is_finite() {
            return Err(NoFrequency::NotFound);
        }
        // within a quarter of a period over the record the steps converge
        let step = step.clamp(-0.25 / samples as f64, 0.25 / samples as f64);
        cycles += step;
        let size = step.abs() * samples as f64;
        // rounding of a phase in double precision, or no further progress near it
        if size < 1e-14 || (size < 1e-10 && size >= last) {
            return Ok(EstimatedCycles { cycles, variance });
        }
        last = size;
    }
    Err(NoFrequency::NotFound)
}

fn fitted<E>(
    passes: &mut dyn SampleSource<Error = E>,
    cycles: f64,
    multiples: &[u32],
    samples: u64,
) -> Result<(ToneCoefficients, Residuals), NoFrequency<E>> {
    let tone = |multiple: &u32| Tone {
        cycles: cycles * f64::from(*multiple),
        fundamental: 0,
        multiple: *multiple,
        beside: false,
    };
    let design = ToneDesign::new(multiples.iter().map(tone).collect(), samples);
    let design = design.map_err(NoFrequency::NoFit)?;
    let mut fits = design.fit(passes).map_err(NoFrequency::Unreadable)?;
    fits.truncate(1);
    let mut left = residuals::of(&design, passes, &mut fits).map_err(NoFrequency::Unreadable)?;
    match (fits.pop(), left.pop()) {
        (Some(fit), Some(left)) => Ok((fit, left)),
        _ => Err(NoFrequency::NotFound),
    }
}

/// The cycles in a sample interval of the strongest oscillation of the first channel.
fn strongest<E>(passes: &mut dyn SampleSource<Error = E>) -> Result<Option<f64>, E> {
    let mut values: Vec<f64> = Vec::new();
    passes.pass(&mut |_, channels| {
        let room = LOOKED_AT.saturating_sub(values.len());
        if let Some(channel) = channels.first() {
            values.extend(channel.iter().take(room));
        }
    })?;
    let spectrum = windowed(&values);
    let highest = spectrum.iter().enumerate().skip(1).max_by(|a, b| a.1.total_cmp(b.1));
    Ok(highest
        .filter(|(_, size)| **size > 0.0)
        .map(|(bin, _)| between(&spectrum, bin) / values.len() as f64))
}

/// Where between the bins the peak lies that has its highest bin at `bin`: the ratio of neighbours
/// under a Hann window (Grandke 1983).
pub(crate) fn between(spectrum: &[f64], bin: usize) -> f64 {
    let at = |bin: usize| spectrum.get(bin).copied().unwrap_or(0.0).sqrt();
    let (left, peak, right) = (at(bin - 1), at(bin), at(bin + 1));
    let (sign, ratio) = if right > left { (1.0, right / peak) } else { (-1.0, left / peak) };
    let shift = sign * ((2.0 * ratio - 1.0) / (ratio + 1.0)).clamp(0.0, 1.0);
    bin as f64 + shift
}

/// The power of each frequency of values, their mean taken off, under a Hann window; bins 0 to half
/// the number of values.
pub(crate) fn windowed(values: &[f64]) -> Vec<f64> {
    let count = values.len();
    let mean = values.iter().sum::<f64>() / count.max(1) as f64;
    let step = Turns::new(1.0 / count.max(2) as f64);
    let (mut cos, mut sin) = (vec![0.0; count], vec![0.0; count]);
    if let Some(step) = step {
        let places = cos.chunks_mut(BLOCK).zip(sin.chunks_mut(BLOCK)).enumerate();
        for (block, (cos, sin)) in places {
            oscillation(step, (block * BLOCK) as u64, cos, sin);
        }
    }
    let mut spectrum: Vec<Phasor> = values
        .iter()
        .zip(&cos)
        .map(|(value, cos)| Phasor::new((value - mean) * 0.5 * (1.0 - cos), 0.0))
        .collect();
    fft::forward(&mut spectrum);
    spectrum.iter().take(count / 2 + 1).map(Phasor::norm_sqr).collect()
}

/// The cycles at which the phases of the record's parts agree best, within half a period per part of
/// the guess.
fn searched<E>(passes: &mut dyn SampleSource<Error = E>, guess: f64) -> Result<f64, E> {
    let samples = passes.frames();
    let Some(step) = Turns::new(guess) else { return Ok(guess) };
    // parts of two periods at least: shorter ones see the mean and the negative frequency
    let periods = (guess * samples as f64 / 2.0) as usize;
    let parts = periods.clamp(1, PARTS);
    let length = samples.div_ceil(parts as u64).max(1);
    let mut phasors = vec![Phasor::new(0.0, 0.0); 8 * PARTS];
    let (mut cos, mut sin) = (Vec::new(), Vec::new());
    let mut means = vec![(0.0, Phasor::new(0.0, 0.0)); parts];
    passes.pass(&mut |first, channels| {
        let values = channels.first().copied().unwrap_or(&[]);
        cos.resize(values.len(), 0.0);
        sin.resize(values.len(), 0.0);
        oscillation(step, first, &mut cos, &mut sin);
        for (i, value) in values.iter().enumerate() {
            let part = ((first + i as u64) / length) as usize;
            let wave = Phasor::new(cos[i], -sin[i]);
            if let (Some(phasor), Some(mean)) = (phasors.get_mut(part), means.get_mut(part)) {
                *phasor += wave * *value;
                mean.0 += *value;
                mean.1 += wave;
            }
        }
    })?;
    let mean = means.iter().map(|(sum, _)| sum).sum::<f64>() / samples.max(1) as f64;
    for (phasor, (_, wave)) in phasors.iter_mut().zip(&means) {
        *phasor -= wave * mean;
    }
    let bins = phasors.len();
    fft::forward(&mut phasors);
    let best = (0..bins).max_by(|a, b| phasors[*a].norm_sqr().total_cmp(&phasors[*b].norm_sqr()));
    let best = best.unwrap_or(0);
    let signed = if best > bins / 2 { best as f64 - bins as f64 } else { best as f64 };
    let found = guess + signed / (bins as f64 * length as f64);
    Ok(if found > 0.0 && found < 0.5 { found } else { guess })
}
