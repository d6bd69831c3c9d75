//! Probabilities that are stated in percent.

/// The probability of which `found` is probably the value in percent: 0.95 for 95. `None` if the
/// number is not above 1 and below 100.
///
/// ```
/// use gumption_engine::number::of_percent;
///
/// assert_eq!(of_percent(95.45), Some(0.9545));
/// assert_eq!(of_percent(0.95), None);
/// ```
pub fn of_percent(found: f64) -> Option<f64> {
    // as a decimal, without the rounding of a quotient
    let is_percent = found > 1.0 && found < 100.0;
    is_percent.then(|| format!("{found}e-2").parse().ok()).flatten()
}
