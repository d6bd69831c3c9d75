//! The size of a unit in coherent SI units, kept exact as long as possible.

use std::f64::consts::PI;

use super::exponent::Exponent;

/// Numerators and denominators above this limit are converted to floating point; the limit leaves
/// room for the long division in [`quotient`].
const LARGEST: u128 = 10_u128.pow(37);

/// The largest decimal exponent that is kept, in absolute value. It is far beyond the range of
/// `f64`, so that products of very large and very small factors stay correct.
const LARGEST_EXPONENT: i64 = 20_000;

/// Parts of pi as an integer and a power of ten, the longer part first.
const PI_DIGITS: [(u128, i64); 2] =
    [(314_159_265_358_979_323_846_264_338_327, -29), (3_141_592_653_589_793_238_463, -21)];

/// The square of pi, likewise.
const PI_SQUARED_DIGITS: [(u128, i64); 2] =
    [(986_960_440_108_935_861_883_449_099_988, -29), (9_869_604_401_089_358_618_834, -21)];

/// A positive number `numerator / denominator * 10^decimal * pi^pi * rest`.
///
/// `rest` is 1 unless a root or an overflow forced the exact parts into floating point. Every
/// operation returns `None` if the result is too large or too small to be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    numerator: u128,
    denominator: u128,
    decimal: i64,
    pi: i64,
    rest: f64,
}

impl Scale {
    /// The number 1.
    pub(super) const ONE: Self =
        Self { numerator: 1, denominator: 1, decimal: 0, pi: 0, rest: 1.0 };

    /// `numerator / denominator * 10^decimal * pi^pi`; numerator and denominator are not zero.
    pub(crate) fn new(numerator: u64, denominator: u64, decimal: i32, pi: i8) -> Self {
        Self {
            numerator: u128::from(numerator),
            denominator: u128::from(denominator),
            decimal: i64::from(decimal),
            pi: i64::from(pi),
            rest: 1.0,
        }
        .reduced()
    }

    /// The power of ten `10^decimal`.
    pub(super) fn power_of_ten(decimal: i32) -> Self {
        Self { decimal: i64::from(decimal), ..Self::ONE }
    }

    /// A decimal literal such as `0.5`, `10` or `1e-6`: digits, at most one point, and an optional
    /// exponent. `None` if it is zero, malformed, or out of range.
    pub(super) fn literal(text: &str) -> Option<Self> {
        let (digits, exponent) = match text.split_once(['e', 'E']) {
            Some((digits, exponent)) => (digits, exponent.parse::<i64>().ok()?),
            None => (text, 0),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let decimal = exponent.checked_sub(i64::try_from(fraction.len()).ok()?)?;
        let joined = format!("{whole}{fraction}");
        match joined.parse::<u128>() {
            Ok(0) => None,
            Ok(numerator) if numerator <= LARGEST => {
                Self { numerator, decimal, ..Self::ONE }.reduced().checked()
            }
            _ => Self { rest: text.parse().ok()?, ..Self::ONE }.checked(),
        }
    }

    /// A literal as a number and a power of ten: for a power of ten the number is 1, for any other
    /// literal that fits in an `f64` the power is 0.
    pub(super) fn number_and_power(self) -> (f64, i64) {
        if self.numerator == 1 && self.rest == 1.0 {
            (1.0, self.decimal)
        } else if self.in_range() {
            (self.value(), 0)
        } else {
            (Self { decimal: 0, ..self }.value(), self.decimal)
        }
    }

    /// The product.
    pub(super) fn times(self, other: Self) -> Option<Self> {
        let cross = gcd(self.numerator, other.denominator);
        let other_cross = gcd(other.numerator, self.denominator);
        let numerator = product(self.numerator / cross, other.numerator / other_cross);
        let denominator = product(self.denominator / other_cross, other.denominator / cross);
        let (decimal, pi) = (self.decimal + other.decimal, self.pi.checked_add(other.pi)?);
        let rest = self.rest * other.rest;
        match (numerator, denominator) {
            (Some(numerator), Some(denominator)) => {
                Self { numerator, denominator, decimal, pi, rest }.reduced().checked()
            }
            _ => {
                let rest = rest * quotient(other.numerator, other.denominator, 0);
                Self { decimal, pi, rest, ..self }.checked()
            }
        }
    }

    /// The reciprocal.
    pub(super) fn inverse(self) -> Option<Self> {
        Self {
            numerator: self.denominator,
            denominator: self.numerator,
            decimal: -self.decimal,
            pi: -self.pi,
            rest: 1.0 / self.rest,
        }
        .checked()
    }

    /// The rational power.
    pub(super) fn power(self, exponent: Exponent) -> Option<Self> {
        let base = if exponent.numerator() < 0 { self.inverse()? } else { self };
        let mut result = Self::ONE;
        for _ in 0..exponent.numerator().unsigned_abs() {
            result = result.times(base)?;
        }
        match u32::try_from(exponent.denominator()).ok()? {
            1 => Some(result),
            n => result.root(n),
        }
    }

    /// The `n`-th root for `n >= 2`: exact if every part has an exact root.
    fn root(self, n: u32) -> Option<Self> {
        let degree = i64::from(n);
        if self.rest == 1.0
            && self.decimal % degree == 0
            && self.pi % degree == 0
            && let Some(numerator) = exact_root(self.numerator, n)
            && let Some(denominator) = exact_root(self.denominator, n)
        {
            let (decimal, pi) = (self.decimal / degree, self.pi / degree);
            return Self { numerator, denominator, decimal, pi, ..self }.checked();
        }
        let decimal = self.decimal.div_euclid(degree);
        let inner = Self { decimal: self.decimal.rem_euclid(degree), ..self }.value();
        let rest = match n {
            2 => inner.sqrt(),
            3 => libm::cbrt(inner),
            _ => libm::pow(inner, 1.0 / f64::from(n)),
        };
        Self { decimal, rest, ..Self::ONE }.checked()
    }

    /// The nearest `f64`: correctly rounded without pi and `rest`, within one or two units in the
    /// last place with them. May be infinite or zero; see [`Scale::in_range`].
    pub(super) fn value(self) -> f64 {
        let (scale, extra) = self.with_pi();
        quotient(scale.numerator, scale.denominator, scale.decimal) * extra * scale.rest
    }

    /// Whether [`Scale::value`] is a normal positive number.
    pub(super) fn in_range(self) -> bool {
        let value = self.value();
        value.is_normal() && value > 0.0
    }

    /// Two integers, exact as `f64`, whose quotient is the number; `None` if there are none.
    pub(super) fn fraction(self) -> Option<(f64, f64)> {
        if self.pi != 0 || self.rest != 1.0 {
            return None;
        }
        let power = 10_u128.checked_pow(u32::try_from(self.decimal.unsigned_abs()).ok()?)?;
        let (up, down) = if self.decimal < 0 { (1, power) } else { (power, 1) };
        let numerator = self.numerator.checked_mul(up)?;
        let denominator = self.denominator.checked_mul(down)?;
        let common = gcd(numerator, denominator);
        Some((exact(numerator / common)?, exact(denominator / common)?))
    }

    /// The same number with pi multiplied into the integers, and the remaining factor.
    fn with_pi(self) -> (Self, f64) {
        let digits = match self.pi {
            0 => return (self, 1.0),
            1 | -1 => PI_DIGITS,
            2 | -2 => PI_SQUARED_DIGITS,
            _ => [(0, 0); 2],
        };
        for (integer, shift) in digits.into_iter().filter(|(integer, _)| *integer != 0) {
            if self.pi > 0 {
                if let Some(numerator) = product(self.numerator, integer) {
                    return (Self { numerator, decimal: self.decimal + shift, ..self }, 1.0);
                }
            } else if let Some(denominator) = product(self.denominator, integer) {
                return (Self { denominator, decimal: self.decimal - shift, ..self }, 1.0);
            }
        }
        (self, libm::pow(PI, self.pi as f64))
    }

    /// The same number in lowest terms, with the tens taken out of the integers.
    fn reduced(mut self) -> Self {
        let common = gcd(self.numerator, self.denominator).max(1);
        self.numerator /= common;
        self.denominator /= common;
        while self.numerator != 0 && self.numerator.is_multiple_of(10) {
            self.numerator /= 10;
            self.decimal += 1;
        }
        while self.denominator != 0 && self.denominator.is_multiple_of(10) {
            self.denominator /= 10;
            self.decimal -= 1;
        }
        self
    }

    /// The number itself if its parts are within the limits.
    fn checked(self) -> Option<Self> {
        let fits = self.decimal.abs() <= LARGEST_EXPONENT
            && self.pi.abs() <= LARGEST_EXPONENT
            && self.rest.is_normal()
            && self.rest > 0.0;
        fits.then_some(self)
    }
}

/// `numerator / denominator * 10^decimal` by long division to forty digits and a marker for what
/// follows, rounded once by the standard library's decimal reader.
fn quotient(numerator: u128, denominator: u128, decimal: i64) -> f64 {
    let denominator = denominator.max(1);
    let mut digits = (numerator / denominator).to_string();
    let mut remainder = numerator % denominator;
    let mut decimal = decimal;
    for _ in 0..80 {
        if remainder == 0 {
            break;
        }
        remainder *= 10;
        digits.push_str(&(remainder / denominator).to_string());
        remainder %= denominator;
        decimal -= 1;
    }
    if remainder != 0 {
        digits.push('1');
        decimal -= 1;
    }
    #[expect(clippy::expect_used, reason = "digits and an exponent are a number")]
    format!("{digits}e{decimal}").parse().expect("a number in decimal digits")
}

/// The product, if it is within [`LARGEST`].
fn product(a: u128, b: u128) -> Option<u128> {
    a.checked_mul(b).filter(|c| *c <= LARGEST)
}

/// The integer as `f64`, if that is exact.
fn exact(value: u128) -> Option<f64> {
    let float = value as f64;
    (float as u128 == value).then_some(float)
}

/// The integer `n`-th root, if there is one.
fn exact_root(value: u128, n: u32) -> Option<u128> {
    let guess = libm::pow(value as f64, 1.0 / f64::from(n)).round() as u128;
    (guess.saturating_sub(1)..=guess.saturating_add(1))
        .find(|root| root.checked_pow(n) == Some(value))
}

/// The greatest common divisor; zero only if both are.
fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a } else { gcd(b, a % b) }
}
