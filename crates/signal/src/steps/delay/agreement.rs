//! Whether two determinations of one delay or phase agree.

use crate::Measured;

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
