//! Whether two determinations of one delay or phase agree.

use std::f64::consts::TAU;

use crate::{
    CrossCorrelation, CrossPhase, Delay, Harmonics, Measured, Periodic, Signal, Unsuitable, phasor,
};
use gumption_engine::special::student;

/// The difference of two values of one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelayAgreement {
    /// The first less the second, in their unit, brought to half a period about zero.
    pub difference: f64,
    /// The normalized error: the modulus of the difference over the root of the sum of the squared
    /// expanded uncertainties, k = 2; they agree where it is at most 1 (ISO 13528:2022, 9.7). Zero
    /// where neither difference nor uncertainty is left. Two methods that evaluate the same
    /// recording share its noise, so the number then comes out smaller than for independent values:
    /// one above 1 is a contradiction, one below 1 little praise.
    pub normalized_error: f64,
}

/// Compares two values of a quantity that is known only up to whole periods: 2 pi for a phase in
/// radians, 1 / f for the delay of a periodic signal, none for that of any other.
pub fn agreement(first: Measured, second: Measured, period: Option<f64>) -> DelayAgreement {
    let apart = first.value - second.value;
    let difference = period.map_or(apart, |period| apart - period * (apart / period).round());
    let [u, v] = [first, second].map(|m| m.standard_uncertainty * m.standard_uncertainty);
    let expanded = 2.0 * (u + v).sqrt();
    let normalized_error = if difference == 0.0 { 0.0 } else { difference.abs() / expanded };
    DelayAgreement { difference, normalized_error }
}

/// Compares the two delays of one pair of signals. Both come from the same samples, so that nearly all
/// of their errors are one and the same: what their difference may be is its scatter over the segments
/// of the cross-spectrum, with the coverage factor of 95.45 % for one degree of freedom less than
/// there are segments.
///
/// # Errors
/// A segment in which one of the two cannot be found.
pub(crate) fn of_one_recording(
    [reference, signal]: [&Signal; 2],
    harmonics: Harmonics,
    segments: usize,
    (correlated, crossed): (&Delay, &CrossPhase),
) -> Result<DelayAgreement, Unsuitable> {
    let period = 1.0 / harmonics.frequency;
    let near_zero = |delay: f64| delay - period * (delay / period).round();
    let length = reference.values.len() / segments;
    let single = Harmonics { count: 1, ..harmonics };
    let differences = (0..segments).map(|segment| {
        let part = |signal: &Signal| {
            let values = signal.values[segment * length..(segment + 1) * length].to_vec();
            Signal { values, start: 0.0, ..*signal }
        };
        let (reference, signal) = (part(reference), part(signal));
        let by_correlation = CrossCorrelation::Periodic(harmonics).of(&reference, &signal)?;
        let [of_reference, of_signal] =
            [Periodic::fit(&reference, single)?, Periodic::fit(&signal, single)?];
        let turned = of_reference.parts[0].phasor.conj() * of_signal.parts[0].phasor;
        let by_phase = -phasor::angle(turned) / (TAU * harmonics.frequency);
        Ok(near_zero(by_correlation.delay.value - by_phase))
    });
    let differences = differences.collect::<Result<Vec<f64>, Unsuitable>>()?;
    let count = segments as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let squares: f64 = differences.iter().map(|d| (d - mean) * (d - mean)).sum();
    let u = (squares / (count * (count - 1.0))).sqrt();
    let difference = near_zero(correlated.delay.value - crossed.delay.value);
    // delays that differ by the rounding of double precision are equal
    let rounding = 1e-12 * period;
    let expanded = student::two_sided_factor(0.9545, count - 1.0) * u;
    let normalized_error =
        if difference.abs() <= rounding { 0.0 } else { difference.abs() / expanded.max(rounding) };
    Ok(DelayAgreement { difference, normalized_error })
}
