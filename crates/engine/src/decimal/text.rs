//! Rounded numbers as text.

use std::fmt;

use super::{Decimal, Direction, position};

/// Printed if there is no number.
pub const MISSING: &str = "-";

/// Number of digits that a binary64 always holds; no more are printed.
pub(super) const MOST_DIGITS: u32 = 15;

/// Significant digits of an exactly known number; more would show binary rounding.
const EXACT_DIGITS: u32 = 12;

/// Numbers whose leading digit has one of these powers of ten are written without an exponent: up
/// to gigahertz in hertz and gigaohms in ohms, as certificates state them.
const PLAIN: std::ops::RangeInclusive<i32> = -5..=9;

/// A zero is written with this many decimals at most.
const ZERO_DECIMALS: i32 = 8;

/// A value rounded to a position, the power of ten of its last digit.
///
/// ```
/// use gumption_engine::decimal::rounded;
///
/// assert_eq!(rounded(8.191_52, -4), "8.1915");
/// assert_eq!(rounded(0.125, -2), "0.13");
/// assert_eq!(rounded(56_789.0, 2), "56800");
/// assert_eq!(rounded(1.234e-7, -10), "1.234e-7");
/// ```
pub fn rounded(value: f64, position: i32) -> String {
    let Some(decimal) = Decimal::shortest(value) else { return MISSING.to_owned() };
    let decimal = match decimal.leading() {
        Some(leading) if position <= leading - MOST_DIGITS as i32 + 1 => {
            decimal.round_to_digits(MOST_DIGITS, Direction::Nearest)
        }
        _ => decimal.round(position, Direction::Nearest),
    };
    decimal.to_string()
}

/// A value rounded to a number of significant digits, such as a standard uncertainty.
///
/// ```
/// use gumption_engine::decimal::significant;
///
/// assert_eq!(significant(0.003_456, 2), "0.0035");
/// assert_eq!(significant(1234.0, 2), "1200");
/// assert_eq!(significant(0.0, 2), "0");
/// ```
pub fn significant(value: f64, digits: u32) -> String {
    rounded(value, position(value, digits).unwrap_or(0))
}

/// An exactly known number: as many digits as it needs, up to twelve.
///
/// ```
/// assert_eq!(gumption_engine::decimal::exact(0.1 + 0.2), "0.3");
/// ```
pub fn exact(value: f64) -> String {
    let Some(decimal) = Decimal::shortest(value) else { return MISSING.to_owned() };
    let mut decimal = decimal.round_to_digits(EXACT_DIGITS, Direction::Nearest);
    while decimal.coefficient > 0 && decimal.coefficient.is_multiple_of(10) {
        decimal.coefficient /= 10;
        decimal.position += 1;
    }
    decimal.to_string()
}

/// All digits to the last one, in plain decimals where that is readable: `0.10`, `56800`,
/// `1.2e-7`.
impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { negative, coefficient, position } = *self;
        let Some(exponent) = self.leading() else {
            return if (-ZERO_DECIMALS..0).contains(&position) {
                write!(f, "0.{:0>1$}", "", position.unsigned_abs() as usize)
            } else {
                f.write_str("0")
            };
        };
        if negative {
            f.write_str("-")?;
        }
        let digits = coefficient.to_string();
        if !PLAIN.contains(&exponent) {
            let (first, rest) = digits.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            return write!(f, "{first}{point}{rest}e{exponent}");
        }
        if exponent < 0 {
            let zeros = exponent.unsigned_abs() as usize - 1;
            return write!(f, "0.{:0>zeros$}{digits}", "");
        }
        let whole = exponent as usize + 1;
        match digits.split_at_checked(whole) {
            Some((whole, decimals)) if !decimals.is_empty() => write!(f, "{whole}.{decimals}"),
            _ => write!(f, "{digits:0<whole$}"),
        }
    }
}
