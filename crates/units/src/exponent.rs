//! Exact small rational exponents, so that a square root of a unit is still a unit.

use std::fmt;

/// The exponent of a base unit in a dimension: an exact rational number such as `-2` or `1/2`.
///
/// Numerator and denominator fit in sixteen bits; every operation that would leave that range
/// returns `None` instead of wrapping or panicking. Always in lowest terms, denominator positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Exponent {
    numerator: i16,
    denominator: i16,
}

impl Exponent {
    /// The exponent 0.
    pub const ZERO: Self = Self::integer(0);
    /// The exponent 1.
    pub const ONE: Self = Self::integer(1);

    /// The exponent 1/2, for a square root.
    pub const HALF: Self = Self { numerator: 1, denominator: 2 };

    /// A whole exponent.
    pub const fn integer(value: i8) -> Self {
        Self { numerator: value as i16, denominator: 1 }
    }

    /// The exponent `numerator / denominator` in lowest terms; `None` if the denominator is zero
    /// or the reduced fraction does not fit in sixteen bits.
    pub fn new(numerator: i32, denominator: i32) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let (n, d) = (i64::from(numerator), i64::from(denominator));
        let common = gcd(n.unsigned_abs(), d.unsigned_abs()) as i64 * d.signum();
        Some(Self {
            numerator: i16::try_from(n / common).ok()?,
            denominator: i16::try_from(d / common).ok()?,
        })
    }

    /// The numerator, carrying the sign.
    pub const fn numerator(self) -> i16 {
        self.numerator
    }

    /// The denominator, at least 1.
    pub const fn denominator(self) -> i16 {
        self.denominator
    }

    /// Whether the exponent is 0.
    pub const fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// Whether the exponent is a whole number.
    pub const fn is_integer(self) -> bool {
        self.denominator == 1
    }

    /// The exponent as a floating-point number.
    pub fn to_f64(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }

    /// The sum; `None` if it does not fit.
    pub fn checked_add(self, other: Self) -> Option<Self> {
        let (a, b) = (i32::from(self.numerator), i32::from(self.denominator));
        let (c, d) = (i32::from(other.numerator), i32::from(other.denominator));
        Self::new((a * d).checked_add(c * b)?, b * d)
    }

    /// The exponent with the opposite sign; `None` if it does not fit.
    pub fn checked_neg(self) -> Option<Self> {
        Self::new(-i32::from(self.numerator), i32::from(self.denominator))
    }

    /// The product; `None` if it does not fit.
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        Self::new(
            i32::from(self.numerator) * i32::from(other.numerator),
            i32::from(self.denominator) * i32::from(other.denominator),
        )
    }
}

impl fmt::Display for Exponent {
    /// `-2`, or `1/2` without parentheses.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_integer() {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}

/// The greatest common divisor; not zero unless both are.
fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}
