//! Exact rational constants, for the exponents of quantities with a dimension.

use super::syntax::{NodeKind, Operator, Tree};
use gumption_units::Exponent;

/// A rational number in lowest terms with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fraction {
    numerator: i64,
    denominator: i64,
}

impl Fraction {
    /// `None` if the denominator is zero or the reduced fraction does not fit.
    fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let (mut a, mut b) = (numerator.unsigned_abs(), denominator.unsigned_abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let common = i128::try_from(a).ok()? * denominator.signum();
        Some(Self {
            numerator: i64::try_from(numerator / common).ok()?,
            denominator: i64::try_from(denominator / common).ok()?,
        })
    }

    /// A decimal number as written in a formula, exactly; `None` if it has very many digits.
    fn of_decimal(text: &str) -> Option<Self> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => {
                (mantissa, exponent.replace('−', "-").parse::<i32>().ok()?)
            }
            None => (text, 0),
        };
        let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let decimals = decimals.trim_end_matches('0');
        let digits = format!("0{whole}{decimals}").parse::<i64>().ok()?;
        let exponent = exponent.checked_sub(i32::try_from(decimals.len()).ok()?)?;
        let power = 10_i128.checked_pow(exponent.unsigned_abs()).filter(|p| *p <= 1 << 60)?;
        if exponent < 0 {
            Self::new(i128::from(digits), power)
        } else {
            Self::new(i128::from(digits) * power, 1)
        }
    }

    fn negate(self) -> Option<Self> {
        Self::new(-i128::from(self.numerator), i128::from(self.denominator))
    }

    fn add(self, other: Self) -> Option<Self> {
        let (a, b) = (i128::from(self.numerator), i128::from(self.denominator));
        let (c, d) = (i128::from(other.numerator), i128::from(other.denominator));
        Self::new((a * d).checked_add(c * b)?, b * d)
    }

    fn multiply(self, other: Self) -> Option<Self> {
        Self::new(
            i128::from(self.numerator) * i128::from(other.numerator),
            i128::from(self.denominator) * i128::from(other.denominator),
        )
    }

    fn invert(self) -> Option<Self> {
        Self::new(i128::from(self.denominator), i128::from(self.numerator))
    }

    /// To a whole power of moderate size.
    fn power(self, exponent: Self) -> Option<Self> {
        if exponent.denominator != 1 || exponent.numerator.unsigned_abs() > 64 {
            return None;
        }
        let one = Self { numerator: 1, denominator: 1 };
        let power = (0..exponent.numerator.unsigned_abs()).try_fold(one, |p, _| p.multiply(self));
        if exponent.numerator < 0 { power?.invert() } else { power }
    }

    /// The same as an exponent of a dimension; `None` if it does not fit.
    pub(super) fn exponent(self) -> Option<Exponent> {
        Exponent::new(i32::try_from(self.numerator).ok()?, i32::try_from(self.denominator).ok()?)
    }
}

/// For every node its value, if it is a rational number written out with `+ - * / ^`.
pub(super) fn fractions(text: &str, tree: &Tree) -> Vec<Option<Fraction>> {
    let mut found: Vec<Option<Fraction>> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        let at = |index: usize| found.get(index).copied().flatten();
        let fraction = match &node.kind {
            NodeKind::Number(_) => text.get(node.span.clone()).and_then(Fraction::of_decimal),
            NodeKind::Negate(x) => at(*x).and_then(Fraction::negate),
            NodeKind::Infix { operator, left, right, .. } => {
                at(*left).zip(at(*right)).and_then(|(x, y)| match operator {
                    Operator::Add => x.add(y),
                    Operator::Subtract => x.add(y.negate()?),
                    Operator::Multiply => x.multiply(y),
                    Operator::Divide => x.multiply(y.invert()?),
                    Operator::Power => x.power(y),
                    _ => None,
                })
            }
            NodeKind::Pi
            | NodeKind::Name
            | NodeKind::Unit(_)
            | NodeKind::Constant(_)
            | NodeKind::InUnit { .. }
            | NodeKind::Table { .. }
            | NodeKind::Solve { .. }
            | NodeKind::Joined { .. }
            | NodeKind::Not { .. }
            | NodeKind::Curve { .. }
            | NodeKind::Call { .. } => None,
        };
        found.push(fraction);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::parser::parse;
    use super::*;

    #[test]
    fn constants_written_out() {
        let of = |text: &str| {
            let fraction = fractions(text, &parse(text).unwrap()).pop().unwrap();
            fraction.map(|f| (f.numerator, f.denominator))
        };
        assert_eq!(of("2"), Some((2, 1)));
        assert_eq!(of("-0.50"), Some((-1, 2)));
        assert_eq!(of("1/3 + 1/6"), Some((1, 2)));
        assert_eq!(of("2.e1"), Some((20, 1)));
        assert_eq!(of("25e−2"), Some((1, 4)));
        assert_eq!(of("1/1.8"), Some((5, 9)));
        assert_eq!(of("2^-3"), Some((1, 8)));
        assert_eq!(of("1/0"), None);
        assert_eq!(of("0^-1"), None);
        assert_eq!(of("pi/pi"), None);
        assert_eq!(of("9223372036854775807"), Some((i64::MAX, 1)));
        assert_eq!(of("9223372036854775807*2"), None);
        assert_eq!(of("123456789012345678901234567890"), None);
        assert_eq!(of("1e300"), None);
    }
}
