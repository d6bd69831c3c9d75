//! Noise that two channels of one recording have in common: from a shaker, a supply, a converter.

use std::f64::consts::TAU;

use crate::Phasor;
use crate::analysed::Analysed;
use crate::phasor::{angle, at_turns, modulus};
use crate::residuals::{LAGS, Residuals};
use crate::turns::{Turns, oscillation};
use gumption_engine::number::elementary::{exp, ln};

/// Parts of the record in which coloured noise is compared, at most and at least.
const MOST_PARTS: usize = 64;
const LEAST_PARTS: usize = 8;

/// The probability with which independent noise passes for common noise.
const BY_CHANCE: f64 = 1e-3;

/// By how much the noise that the phases of two channels have in common makes their difference
/// better known: the correlation of the two phases' errors near `cycles` in a sample interval, 0 for
/// independent noise. None where the channels were not sampled together, or nothing is seen.
pub(crate) fn correlation(a: &Analysed, b: &Analysed, cycles: f64) -> Option<f64> {
    let together = a.clock == b.clock
        && a.channel != b.channel
        && a.base.start == b.base.start
        && a.design.samples == b.design.samples;
    if !together {
        return None;
    }
    let common = common(a, b, cycles)?;
    let phase = |analysed: &Analysed| {
        let tone = analysed.design.tones.iter().position(|tone| tone.cycles == cycles)?;
        Some(angle(Phasor::new(analysed.fit.cosines[tone], -analysed.fit.sines[tone])))
    };
    let apart = phase(a)? - phase(b)?;
    Some((common * at_turns(-apart / TAU)).re)
}

/// The complex coherence of the residuals of two channels near a frequency, where it is more than
/// chance.
fn common(a: &Analysed, b: &Analysed, cycles: f64) -> Option<Phasor> {
    let (of_a, of_b) = (&a.residuals.first, &b.residuals.first);
    let count = of_a.len().min(of_b.len());
    let (of_a, of_b) = (&of_a[..count], &of_b[..count]);
    let white = !a.residuals.correlated && !b.residuals.correlated;
    let parts = ((cycles * count as f64) as usize).min(MOST_PARTS).min(count / 16);
    if white {
        by_lags(of_a, of_b, cycles)
    } else if parts < LEAST_PARTS {
        by_innovations(&a.residuals, of_a, &b.residuals, of_b, cycles)
    } else {
        by_parts(of_a, of_b, cycles, parts)
    }
}

/// The coherence of the innovations of two processes. Two records of noise with a memory have few
/// values that count, and correlate by chance: two walks nearly always do. Their innovations do not
/// (L. D. Haugh, J. Am. Stat. Assoc. 71 (1976) 378), and have the coherence of the processes but for
/// the phases of these.
fn by_innovations(
    a: &Residuals,
    of_a: &[f64],
    b: &Residuals,
    of_b: &[f64],
    cycles: f64,
) -> Option<Phasor> {
    let every = a.coloured.as_ref().or(b.coloured.as_ref())?.every;
    let cycles = cycles * every as f64;
    if cycles > 0.25 {
        return None;
    }
    let of = |residuals: &Residuals, values: &[f64]| {
        let means: Vec<f64> = values
            .chunks_exact(every as usize)
            .map(|part| part.iter().sum::<f64>() / every as f64)
            .collect();
        if !residuals.correlated {
            // as many as there are innovations
            return Some((means.get(1..)?.to_vec(), Phasor::new(1.0, 0.0)));
        }
        let coloured = residuals.coloured.as_ref()?;
        Some((coloured.innovations(&means), coloured.response(cycles)))
    };
    let ((of_a, a), (of_b, b)) = (of(a, of_a)?, of(b, of_b)?);
    let turned = a * b.conj();
    by_lags(&of_a, &of_b, cycles).map(|common| common * (turned / modulus(turned)))
}

/// The sum of the correlation coefficients that stand out, each turned by its lag.
fn by_lags(a: &[f64], b: &[f64], cycles: f64) -> Option<Phasor> {
    let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
    let (of_a, of_b) = (power(a), power(b));
    let both = (of_a * of_b).sqrt();
    // of values that are nearly white the coefficients of all lags scatter by the products of the
    // autocorrelations (M. S. Bartlett, J. R. Stat. Soc. Suppl. 8 (1946) 27)
    let own = |x: &[f64], power: f64, lag: usize| {
        let late = x.get(lag..).unwrap_or(&[]);
        late.iter().zip(x).map(|(x, y)| x * y).sum::<f64>() / power
    };
    let more: f64 = (1..=LAGS).map(|lag| own(a, of_a, lag) * own(b, of_b, lag)).sum();
    // 33 coefficients of four standard deviations: one in 500 of independent noise
    let least = 4.0 * ((1.0 + 2.0 * more).max(1.0) / a.len() as f64).sqrt();
    let mut found: Option<Phasor> = None;
    for lag in -(LAGS as i64)..=LAGS as i64 {
        let by = lag.unsigned_abs() as usize;
        let (late, early) = if lag >= 0 { (a, b) } else { (b, a) };
        let products = late.get(by..)?.iter().zip(early).map(|(x, y)| x * y);
        let coefficient = products.sum::<f64>() / both;
        if coefficient.abs() > least {
            let turned = at_turns(-cycles * lag as f64) * coefficient;
            *found.get_or_insert(Phasor::new(0.0, 0.0)) += turned;
        }
    }
    // more than all is estimation's error
    found.map(|sum| if modulus(sum) > 1.0 { sum / modulus(sum) } else { sum })
}

/// The coherence of the sums of parts of the record.
fn by_parts(a: &[f64], b: &[f64], cycles: f64, parts: usize) -> Option<Phasor> {
    let step = Turns::new(cycles)?;
    let length = a.len() / parts;
    let (mut cos, mut sin) = (vec![0.0; length], vec![0.0; length]);
    let (mut of_a, mut of_b, mut of_both) = (0.0, 0.0, Phasor::new(0.0, 0.0));
    for (part, (a, b)) in a.chunks_exact(length).zip(b.chunks_exact(length)).enumerate() {
        oscillation(step, (part * length) as u64, &mut cos, &mut sin);
        let sum = |values: &[f64]| {
            let waves = cos.iter().zip(&sin);
            let sum = |(re, im): (f64, f64), (x, (cos, sin)): (&f64, (&f64, &f64))| {
                (re + x * cos, im - x * sin)
            };
            let (re, im) = values.iter().zip(waves).fold((0.0, 0.0), sum);
            Phasor::new(re, im)
        };
        let (a, b) = (sum(a), sum(b));
        of_a += a.norm_sqr();
        of_b += b.norm_sqr();
        of_both += a * b.conj();
    }
    let coherence = of_both / (of_a * of_b).sqrt();
    // of independent noise the square is above x with the probability (1 - x)^(parts - 1)
    let least = 1.0 - exp(ln(BY_CHANCE) / (parts as f64 - 1.0));
    (coherence.norm_sqr() > least).then_some(coherence)
}
