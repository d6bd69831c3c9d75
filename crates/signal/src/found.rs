//! What steps find in a signal beside what they hand on: root mean squares, delays, and how much
//! nearer to the reference a correction brings it.

use super::delay::{of_harmonics, of_one_recording};
use super::rms::improvement_in;
use super::surroundings::{Finding, Surroundings};
use super::through::{Through, noise_of};
use super::{CrossSpectrum, Delay, Measured, Noise, RmsOf, Signal, Unsuitable};

/// The root mean square about the mean, and that of the oscillation and its multiples.
pub(super) fn rms(
    signal: &Signal,
    surroundings: Surroundings<'_>,
    through: Option<&Through>,
) -> Result<Vec<Finding>, String> {
    let noise = noise_of(signal, surroundings.harmonics(signal), through);
    let of = of(signal, surroundings).rms_in(signal, noise.as_ref());
    let of = of.map_err(|error| error.to_string())?;
    let mut findings = vec![Finding::of("RMS", "", of.alternating)];
    findings.extend(of.periodic.map(|value| Finding::of("RMS of the multiples", "", value)));
    Ok(findings)
}

fn of(signal: &Signal, surroundings: Surroundings<'_>) -> RmsOf {
    RmsOf {
        harmonics: Some(surroundings.harmonics(signal)),
        noise: Noise::White,
        resolution: surroundings.resolution,
    }
}

/// The RMS difference from the reference before and after a correction, where the two were sampled
/// together.
pub(super) fn nearer(
    reference: &Signal,
    before: &Signal,
    after: &Signal,
    surroundings: Surroundings<'_>,
) -> Vec<Finding> {
    let common = |signal: &Signal| common(reference, signal);
    let found = match (common(before), common(after)) {
        (Ok([reference, before]), Ok([_, after])) => {
            let of = RmsOf { resolution: 0.0, ..of(&before, surroundings) };
            let noise = |left: &Signal| noise_of(left, surroundings.harmonics(left), None);
            improvement_in(&reference, &before, &after, of, noise)
        }
        _ => return Vec::new(),
    };
    let Ok(found) = found else { return Vec::new() };
    vec![
        Finding::of("RMS difference before correction", "", found.before),
        Finding::of("RMS difference after correction", "", found.after),
        Finding::of("reduction of RMS difference", "1", found.reduction),
    ]
}

/// The delay against the reference by cross-correlation, phase and delay by the cross-spectrum, and
/// the normalized error of the two delays.
pub(super) fn delay(
    reference: &Signal,
    signal: &Signal,
    surroundings: Surroundings<'_>,
    segments: Option<usize>,
    through: [Option<&Through>; 2],
) -> Result<Vec<Finding>, String> {
    let said = |error: Unsuitable| error.to_string();
    let [reference, signal] = common(reference, signal).map_err(said)?;
    let harmonics = surroundings.harmonics(&signal);
    let [of_reference, of_signal] = [(&reference, through[0]), (&signal, through[1])]
        .map(|(signal, through)| noise_of(signal, harmonics, through));
    let noises = [of_reference.as_ref(), of_signal.as_ref()];
    let correlated = of_harmonics(&reference, &signal, harmonics, noises).map_err(said)?;
    let spectrum = match segments {
        Some(segments) => CrossSpectrum { harmonics, segments },
        None => CrossSpectrum::of_signal(harmonics, &signal).map_err(said)?,
    };
    let crossed = spectrum.of(&reference, &signal).map_err(said)?;
    let agreed =
        of_one_recording([&reference, &signal], spectrum, &correlated, &crossed).map_err(said)?;
    let Delay { delay, correlation, .. } = correlated.delay;
    let degrees = 180.0 / std::f64::consts::PI;
    let phase = Measured {
        value: crossed.phase.value * degrees,
        standard_uncertainty: crossed.phase.standard_uncertainty * degrees,
        ..crossed.phase
    };
    Ok(vec![
        Finding::of("delay by cross-correlation", "s", delay),
        Finding::number("coefficient of correlation", "1", correlation),
        Finding::of("phase by cross-spectrum", "deg", phase),
        Finding::of("delay by cross-spectrum", "s", crossed.delay),
        Finding::of("coherence", "1", crossed.coherence),
        Finding::number("normalized error of the delays", "1", agreed.normalized_error),
    ])
}

/// The parts of two signals of one clock that were taken at the same instants.
fn common(a: &Signal, b: &Signal) -> Result<[Signal; 2], Unsuitable> {
    let apart = (b.start - a.start) * a.rate;
    // the rounding of instants after an hour at 1 MHz
    if a.rate != b.rate || (apart - apart.round()).abs() > 1e-3 {
        return Err(Unsuitable::NotTogether {
            samples: [a.values.len(), b.values.len()],
            rates: [a.rate, b.rate],
        });
    }
    let apart = apart.round();
    let (of_a, of_b) = (apart.max(0.0) as usize, (-apart).max(0.0) as usize);
    let [left_a, left_b] =
        [a.values.len().saturating_sub(of_a), b.values.len().saturating_sub(of_b)];
    let length = left_a.min(left_b);
    let part = |signal: &Signal, first: usize| Signal {
        values: signal.values.get(first..first + length).unwrap_or(&[]).to_vec(),
        rate: signal.rate,
        start: 0.0,
    };
    Ok([part(a, of_a), part(b, of_b)])
}
