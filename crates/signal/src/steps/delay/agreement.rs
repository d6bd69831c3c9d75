//! Whether two determinations of one delay or phase agree.

use std::f64::consts::TAU;

use super::correlation::HarmonicDelay;
use crate::{CrossPhase, CrossSpectrum, Measured, Signal, Unsuitable};
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

/// Compares the two delays of one pair of signals. Both come from the same values, so that nearly all
/// of their errors are one and the same. By the law of propagation their difference has what is left:
///
/// - the phases of the harmonics, as far as they pull the two differently;
/// - what the fits of the segments, of which the values after the last one are no part, scatter more
///   than the fit of all values, which has the least variance: the difference of both variances;
/// - the product of the noise of both signals, which the cross-spectrum has from each segment;
/// - leakage, as if that of all values and that of the segments were independent.
///
/// The coverage factor is that of 95.45 % for the degrees of freedom of the noise.
///
/// # Errors
/// As [`CrossSpectrum::of`].
pub(crate) fn of_one_recording(
    signals: [&Signal; 2],
    spectrum: CrossSpectrum,
    correlated: &HarmonicDelay,
    crossed: &CrossPhase,
) -> Result<DelayAgreement, Unsuitable> {
    let harmonics = spectrum.harmonics;
    let period = 1.0 / harmonics.frequency;
    let near_zero = |delay: f64| delay - period * (delay / period).round();
    let count = spectrum.segments as f64;
    let square = |value: f64| value * value;
    // variances of the phase of the first harmonic, in radians squared, but for those of all phases
    let (mut own, mut product) = (0.0, 2.0 / count);
    for (signal, fit) in signals.into_iter().zip(&correlated.fits) {
        let first = &fit.parts[0];
        let segments = spectrum.cut(signal)?;
        let (_, of_whole) = harmonics.first_of(&signal.values, signal.rate)?;
        let of_noise = square(first.of_phase(first.standard_uncertainty));
        let white = square(first.of_phase(of_whole.map(f64::sqrt))) * first.phasor.norm_sqr();
        let in_segment = of_noise * segments.of_phase / white;
        own += (in_segment / count - of_noise).max(0.0);
        let share = signal.values.len() as f64 / segments.used as f64;
        own += square(first.leakage) / first.phasor.norm_sqr() * (1.0 + share * share);
        product *= in_segment;
    }
    let seconds = period / TAU; // a radian
    let mut variance = seconds * seconds * (own + product);
    for (place, pull) in correlated.pulls.iter().enumerate() {
        let apart = if place == 0 { pull - seconds } else { *pull };
        for fit in &correlated.fits {
            let u = apart * fit.parts[place].phase().standard_uncertainty;
            variance += u * u;
        }
    }
    let Measured { value, degrees_of_freedom, .. } = correlated.delay.delay;
    let difference = near_zero(value - crossed.delay.value);
    // delays that differ by the rounding of double precision are equal
    let rounding = 1e-12 * period;
    let expanded = student::two_sided_factor(0.9545, degrees_of_freedom) * variance.sqrt();
    let normalized_error =
        if difference.abs() <= rounding { 0.0 } else { difference.abs() / expanded.max(rounding) };
    Ok(DelayAgreement { difference, normalized_error })
}
