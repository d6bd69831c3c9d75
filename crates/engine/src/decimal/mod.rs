//! Rounding, defined in one place: the decimal digits of a number, and which of them are kept.
//!
//! Pages, workbooks and certificates print decimal numbers, so the rule for a tie must be based on
//! decimal digits too. The digits of a number are those of the shortest text that reads back as the
//! same binary64: 2.675 is a tie at its second decimal, although its binary64 is slightly smaller.
//! A half rounds away from zero, so that no uncertainty is rounded down at a tie (JCGM 100, 7.2.6
//! rounds up if in doubt).
//!
//! # Noise
//!
//! A computed result has errors in its last bits: k u may be 0.124 999 999 999 999 99 where 0.125
//! is meant. A number is therefore first rounded to twelve digits, or to two more than are kept if
//! that is more. Twelve, because a sum of squares over thousands of contributions has a relative
//! error of about 1e-13, and no uncertainty is known to twelve digits. Two more than are kept,
//! because a frequency with a relative uncertainty of 1e-15 has digits after the twelfth, and then
//! changes by at most 0.005 units of the last kept digit.

mod text;

pub use text::{MISSING, exact, rounded, significant};

use std::cmp::Ordering;

/// Minimum number of significant digits that a computed number is assumed to have.
const HELD_DIGITS: i32 = 12;

/// Additional digits after the kept ones that decide their rounding.
const GUARD_DIGITS: i32 = 2;

/// The most digits of a [`Decimal`]; 17 distinguish any two binary64.
const MOST_DIGITS: i32 = 18;

/// All digits of any binary64 are well between this power of ten and its inverse.
const BEYOND: i32 = 400;

/// A finite number in decimal digits: an integer of at most 18 digits times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimal {
    negative: bool,
    coefficient: u64,
    /// The power of ten of the last digit.
    position: i32,
}

/// The direction of rounding for a number between two with fewer digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// To the nearest, a half away from zero.
    Nearest,
    /// Away from minus infinity.
    Up,
    /// Towards minus infinity.
    Down,
}

impl Decimal {
    /// An integer of at most 18 digits times a power of ten.
    ///
    /// ```
    /// assert_eq!(gumption_engine::decimal::Decimal::new(5, -3).value(), 0.005);
    /// ```
    pub const fn new(coefficient: u64, position: i32) -> Self {
        Self { negative: false, coefficient, position }
    }

    /// The digits of the shortest text that reads back as this number; `None` for infinity and NaN.
    ///
    /// ```
    /// use gumption_engine::decimal::Decimal;
    ///
    /// let sum = Decimal::shortest(0.1 + 0.2).unwrap();
    /// assert_eq!((sum.position(), sum.leading()), (-17, Some(-1)));
    /// ```
    #[expect(clippy::expect_used, reason = "the format of `{:e}` is fixed: 1.25e-7")]
    pub fn shortest(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let text = format!("{:e}", value.abs());
        let (mantissa, exponent) = text.split_once('e').expect("an exponent is always written");
        let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = format!("{whole}{decimals}");
        let exponent: i32 = exponent.parse().expect("an exponent has three digits at most");
        Some(Self {
            negative: value < 0.0,
            coefficient: digits.parse().expect("a shortest text has 17 digits at most"),
            position: exponent - decimals.len() as i32,
        })
    }

    /// The power of ten of the last digit.
    pub fn position(self) -> i32 {
        self.position
    }

    /// The power of ten of the first digit that is not zero; `None` for zero.
    pub fn leading(self) -> Option<i32> {
        Some(self.position + self.coefficient.checked_ilog10()? as i32)
    }

    /// Whether it is below zero.
    pub fn is_negative(self) -> bool {
        self.negative
    }

    /// Rounded to a position, the power of ten of the last kept digit. No binary64 has more than
    /// eighteen digits, so the number ends there.
    ///
    /// ```
    /// use gumption_engine::decimal::{Decimal, Direction};
    ///
    /// let to = |value, position, direction| {
    ///     Decimal::shortest(value).unwrap().round(position, direction).value()
    /// };
    /// assert_eq!(to(0.125, -2, Direction::Nearest), 0.13);
    /// // 0.121 is more than 0.12; 0.4 * 0.3 is so by its last bit only
    /// assert_eq!(to(0.121, -2, Direction::Up), 0.13);
    /// assert_eq!(to(0.4 * 0.3, -2, Direction::Up), 0.12);
    /// ```
    #[must_use]
    pub fn round(self, position: i32, direction: Direction) -> Self {
        let position = position.clamp(-BEYOND, BEYOND);
        let Some(leading) = self.leading() else { return Self { position, ..self } };
        let position = position.max(leading - MOST_DIGITS + 1);
        let kept = leading - position + 1;
        let held = HELD_DIGITS.max(kept + GUARD_DIGITS);
        let noiseless = self.cut((leading - held + 1).max(self.position), Direction::Nearest);
        noiseless.cut(position, direction)
    }

    /// Rounded to a number of significant digits, 1 to 15. The position is decided after rounding:
    /// 9.96 with two digits is 10, so its last digit is that of the units. Zero is unchanged.
    #[must_use]
    pub fn round_to_digits(self, digits: u32, direction: Direction) -> Self {
        let Some(leading) = self.leading() else { return self };
        let position = leading - digits.clamp(1, text::MOST_DIGITS) as i32 + 1;
        let rounded = self.round(position, direction);
        match rounded.leading() {
            // a number rounded up to a new power of ten has one zero more than requested
            Some(carried) if carried > leading => rounded.cut(position + 1, Direction::Nearest),
            _ => rounded,
        }
    }

    /// The binary64 nearest to the digits.
    #[expect(clippy::expect_used, reason = "an integer and an exponent always read as a number")]
    pub fn value(self) -> f64 {
        let Self { negative, coefficient, position } = self;
        let modulus: f64 = format!("{coefficient}e{position}").parse().expect("a number");
        if negative { -modulus } else { modulus }
    }

    /// One step of rounding, on all digits; zeros are added at a position below the last digit.
    fn cut(self, position: i32, direction: Direction) -> Self {
        let Self { negative, coefficient, position: last } = self;
        let power = 10_u64.checked_pow(position.abs_diff(last));
        let coefficient = match (position.cmp(&last), power) {
            // `round` requests at most 18 digits, which fit
            (Ordering::Less | Ordering::Equal, power) => {
                power.map_or(coefficient, |power| coefficient.saturating_mul(power))
            }
            (Ordering::Greater, power) => {
                // a power that does not fit is more than twice as large as any coefficient
                let (kept, rest, half) = power.map_or((0, coefficient, u64::MAX), |power| {
                    (coefficient / power, coefficient % power, power / 2)
                });
                let away = match direction {
                    Direction::Nearest => rest >= half,
                    Direction::Up => rest > 0 && !negative,
                    Direction::Down => rest > 0 && negative,
                };
                kept + u64::from(away)
            }
        };
        Self { negative: negative && coefficient > 0, coefficient, position }
    }
}

/// The power of ten of the last of `digits` significant digits of a value, after rounding to them:
/// -3 for 0.0123 with two digits. `None` for zero and for values that are not finite.
///
/// ```
/// use gumption_engine::decimal::position;
///
/// assert_eq!(position(9.94, 2), Some(-1)); // 9.9
/// assert_eq!(position(9.96, 2), Some(0)); // 10
/// assert_eq!(position(1234.0, 2), Some(2)); // 1200
/// ```
pub fn position(value: f64, digits: u32) -> Option<i32> {
    let decimal = Decimal::shortest(value).filter(|decimal| decimal.coefficient > 0)?;
    Some(decimal.round_to_digits(digits, Direction::Nearest).position)
}

/// A value rounded to a position; values that are not finite are unchanged.
pub fn to_position(value: f64, position: i32) -> f64 {
    Decimal::shortest(value)
        .map_or(value, |decimal| decimal.round(position, Direction::Nearest).value())
}

/// A value rounded to a number of significant digits, 1 to 15; values that are not finite are
/// unchanged.
///
/// ```
/// assert_eq!(gumption_engine::decimal::to_digits(0.1 + 0.2, 12), 0.3);
/// ```
pub fn to_digits(value: f64, digits: u32) -> f64 {
    Decimal::shortest(value)
        .map_or(value, |decimal| decimal.round_to_digits(digits, Direction::Nearest).value())
}

/// A value without the digits due to binary rounding: rounded to fifteen significant digits, all of
/// which a binary64 holds; values that are not finite are unchanged.
///
/// ```
/// assert_eq!(gumption_engine::decimal::to_15_digits(100.0 * 0.07), 7.0);
/// ```
pub fn to_15_digits(value: f64) -> f64 {
    to_digits(value, text::MOST_DIGITS)
}

#[cfg(test)]
mod tests;
