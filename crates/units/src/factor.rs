//! The factors of a unit: what its text says, free of how it is spelled.

use std::fmt;

use super::exponent::Exponent;
use super::names::{self, Prefix, Symbol};

/// A factor of a unit: a named unit or a number, to an exponent.
///
/// `mV/(m/s^2)` has the factors mV, m to the exponent -1, and s to the exponent 2. Exponents are
/// exact; products, quotients, parentheses, powers and roots are resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Factor {
    /// What is raised.
    pub base: FactorBase,
    /// The exponent; -2 for the second in `m/s^2`, 1/2 for the hertz in `√Hz`.
    pub exponent: Exponent,
}

/// The base of a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum FactorBase {
    /// A named unit.
    Named {
        /// Its prefix. The kilogram is the gram with a prefix.
        prefix: Option<&'static Prefix>,
        /// Its symbol.
        symbol: &'static Symbol,
    },
    /// A unit that a file defines: `HBW`.
    Defined(&'static str),
    /// A positive number other than 1: 0.5 in `0.5*m`. A power of ten is the number 10 with an
    /// exponent, whether it was written `1e-6` or `10^-6`.
    Number(f64),
}

impl Factor {
    /// An unmodified base.
    pub(super) const fn of(base: FactorBase) -> Self {
        Self { base, exponent: Exponent::ONE }
    }

    /// The factor with this name and exponent.
    pub(super) fn named(name: &str, exponent: Exponent) -> Option<Self> {
        let (prefix, symbol) = names::read(name)?;
        Some(Self { base: FactorBase::Named { prefix, symbol }, exponent })
    }
}

impl fmt::Display for FactorBase {
    /// The symbol behind its prefix, or the number, as [`Unit::parse`](super::Unit::parse) reads it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Named { prefix, symbol } => {
                write!(f, "{}{}", prefix.map_or("", Prefix::symbol), symbol.name())
            }
            Self::Defined(name) => f.write_str(name),
            Self::Number(number) if (1e-4..1e6).contains(&number) => write!(f, "{number}"),
            Self::Number(number) => write!(f, "{number:e}"),
        }
    }
}

/// Factors as one text, the same for every spelling: first the factors that multiply, in order,
/// then those that divide. Numbers keep their exponents.
pub(super) fn normal_text(factors: &[Factor]) -> String {
    let divides = |factor: &Factor| {
        factor.exponent.numerator() < 0 && !matches!(factor.base, FactorBase::Number(_))
    };
    let part = |below: bool| -> Vec<String> {
        let part = factors.iter().filter(|factor| divides(factor) == below);
        part.map(|factor| power(factor, below)).collect()
    };
    let (above, below) = (part(false), part(true));
    let numerator = if above.is_empty() { "1".to_owned() } else { above.join("·") };
    match below.as_slice() {
        [] => numerator,
        [one] => format!("{numerator}/{one}"),
        _ => format!("{numerator}/({})", below.join("·")),
    }
}

/// A factor, or its reciprocal.
fn power(factor: &Factor, reciprocal: bool) -> String {
    let Factor { base, exponent } = factor;
    let sign = if reciprocal { -1 } else { 1 };
    let (numerator, denominator) = (i32::from(exponent.numerator()) * sign, exponent.denominator());
    match (numerator, denominator) {
        (1, 1) => base.to_string(),
        (_, 1) => format!("{base}^{numerator}"),
        _ => format!("{base}^({numerator}/{denominator})"),
    }
}
