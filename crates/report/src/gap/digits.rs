//! How many digits the numbers of a diagnosis get, the same on every page.

use crate::number;
use crate::number::{exact, rounded, significant};
use gumption_engine::decimal::{to_digits, to_position};

/// Digits of standard uncertainties.
pub(super) const UNCERTAINTY: u32 = 2;

/// Smaller probabilities of a test are not told apart.
const LEAST: f64 = 1e-300;

/// Digits of the values of conditions; those of data seldom have more.
const CONDITION_DIGITS: u32 = 6;

/// A probability of a hypothesis: three decimals, or the leading digit of a very small one.
pub(super) fn probability(value: f64) -> String {
    if value >= 0.0005 { rounded(value, -3) } else { significant(value, 1) }
}

/// A probability of a test.
pub(super) fn p_value(value: f64) -> String {
    if value < LEAST { format!("<{LEAST:e}") } else { significant(value, UNCERTAINTY) }
}

/// `p = 0.012`.
pub(super) fn p_equals(value: f64) -> String {
    if value < LEAST { format!("p < {LEAST:e}") } else { format!("p = {}", p_value(value)) }
}

/// A share or a fraction.
pub(super) fn share(value: f64) -> String {
    rounded(value, -3)
}

/// A mean of normalized residuals, a chi-square or a gain of logarithms.
pub(super) fn tenths(value: f64) -> String {
    rounded(value, -1)
}

/// Root mean squares beside the noise floor that they are compared with: to its third digit.
pub(super) fn beside(value: f64, floor: f64) -> String {
    match number::position(floor, 3) {
        Some(position) => rounded(value, position),
        None => significant(value, 3),
    }
}

/// The value of a condition.
pub(super) fn condition(value: f64) -> String {
    exact(to_digits(value, CONDITION_DIGITS))
}

/// A coverage probability in per cent.
pub(super) fn percent(probability: f64) -> String {
    format!("{} %", exact(to_position(100.0 * probability, -4)))
}

/// A share in whole per cent.
pub(super) fn percent_of(share: f64) -> String {
    format!("{} %", rounded(100.0 * share, 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_probabilities_keep_a_digit() {
        assert_eq!(probability(0.87778), "0.878");
        assert_eq!(probability(0.99996), "1.000");
        assert_eq!(probability(3.75e-54), "4e-54");
        assert_eq!(probability(0.0), "0");
        assert_eq!(p_equals(0.0), "p < 1e-300");
        assert_eq!(p_equals(8.836e-47), "p = 8.8e-47");
    }

    #[test]
    fn conditions_have_no_binary_digits() {
        assert_eq!(condition(0.1 + 0.2), "0.3");
        assert_eq!(condition(1.120_599_393_182_059_5), "1.1206");
        assert_eq!(condition(1_050_000.0), "1050000");
        assert_eq!(percent(0.95), "95 %");
        assert_eq!(percent(0.9973), "99.73 %");
    }
}
