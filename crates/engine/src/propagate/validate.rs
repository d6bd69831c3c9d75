//! Validation of the GUM interval by the Monte Carlo one (JCGM 101, clause 8).

use super::gum::Gum;
use super::monte_carlo::MonteCarlo;
use crate::decimal::{self, Decimal};

/// The comparison of the two coverage intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validation {
    /// Significant digits of the standard uncertainty that are held meaningful.
    pub digits: u32,
    /// Numerical tolerance delta of the standard uncertainty (7.9.2).
    pub tolerance: f64,
    /// Modulus of the difference of the lower ends.
    pub d_low: f64,
    /// Modulus of the difference of the upper ends.
    pub d_high: f64,
    /// Whether both differences are within the tolerance; `None` where the trials do not decide it
    /// (a difference nearer to the tolerance than two numerical standard errors, or trials so few
    /// that an end of the interval is the extreme one).
    pub gum_valid: Option<bool>,
}

/// The numerical tolerance delta = 10^l / 2 of a value whose `digits` significant digits are held
/// meaningful: the value is first rounded to c x 10^l with c an integer of that many digits
/// (JCGM 101, 7.9.2). Zero for zero.
///
/// ```
/// use gumption_engine::propagate::validate::numerical_tolerance;
///
/// assert_eq!(numerical_tolerance(0.002_35, 2), 0.000_05);
/// // 0.0996 with two digits is 10 x 10^-2
/// assert_eq!(numerical_tolerance(0.0996, 2), 0.005);
/// ```
pub fn numerical_tolerance(value: f64, digits: u32) -> f64 {
    // read back from decimal text, so that the tolerance is the double nearest to 5 x 10^(l - 1)
    decimal::position(value, digits).map_or(0.0, |last| Decimal::new(5, last - 1).value())
}

/// Compares the GUM interval with the probabilistically symmetric Monte Carlo interval (8.1.3).
/// `None` where there is no GUM interval.
pub fn validate(gum: &Gum, monte_carlo: &MonteCarlo, digits: u32) -> Option<Validation> {
    let [low, high] = gum.interval()?;
    let tolerance = numerical_tolerance(gum.standard_uncertainty, digits);
    let [mc_low, mc_high] = monte_carlo.symmetric_interval;
    let [low_error, high_error] = monte_carlo.errors.symmetric_interval;
    let (d_low, d_high) = ((low - mc_low).abs(), (high - mc_high).abs());
    let verdicts = [(d_low, low_error), (d_high, high_error)].map(|(d, error)| {
        let open = (d - tolerance).abs() < 2.0 * error;
        (!open).then_some(d <= tolerance)
    });
    let gum_valid = match verdicts {
        // an end that is the extreme trial has no error, and such an interval decides nothing
        _ if low_error.is_nan() || high_error.is_nan() => None,
        [Some(false), _] | [_, Some(false)] => Some(false),
        [Some(true), Some(true)] => Some(true),
        _ => None,
    };
    Some(Validation { digits: digits.clamp(1, 15), tolerance, d_low, d_high, gum_valid })
}
