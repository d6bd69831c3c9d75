//! Plain numbers: the arithmetic of an estimate, and the definition of every operation's bits.

use std::sync::Arc;

use super::{Binary, Number, Routine, Unary, elementary};

/// One operation on one number; columns of trials apply the same code to every element.
#[inline(always)]
pub(super) fn unary(operation: Unary, x: f64) -> f64 {
    match operation {
        Unary::Negate => -x,
        Unary::Abs => x.abs(),
        Unary::Sqrt => x.sqrt(),
        Unary::Cbrt => elementary::cbrt(x),
        Unary::Exp => elementary::exp(x),
        Unary::Ln => elementary::ln(x),
        Unary::Log10 => elementary::log10(x),
        Unary::Sin => elementary::sin(x),
        Unary::Cos => elementary::cos(x),
        Unary::Tan => elementary::tan(x),
        Unary::Asin => elementary::asin(x),
        Unary::Acos => elementary::acos(x),
        Unary::Atan => elementary::atan(x),
        Unary::Sinh => elementary::sinh(x),
        Unary::Cosh => elementary::cosh(x),
        Unary::Tanh => elementary::tanh(x),
        Unary::Asinh => elementary::asinh(x),
        Unary::Acosh => elementary::acosh(x),
        Unary::Atanh => elementary::atanh(x),
        Unary::ExpMinusOne => elementary::expm1(x),
        Unary::LnOnePlus => elementary::log1p(x),
        Unary::Floor => x.floor(),
        Unary::Ceil => x.ceil(),
        Unary::Round => x.round(),
        Unary::Erf => elementary::erf(x),
        Unary::Gamma => elementary::gamma(x),
    }
}

/// One operation on two numbers.
#[inline(always)]
pub(super) fn binary(operation: Binary, x: f64, y: f64) -> f64 {
    let truth = |holds: bool| if holds { 1.0 } else { 0.0 };
    match operation {
        Binary::Add => x + y,
        Binary::Subtract => x - y,
        Binary::Multiply => x * y,
        Binary::Divide => x / y,
        Binary::Power => elementary::pow(x, y),
        Binary::Atan2 => elementary::atan2(x, y),
        Binary::Hypot => hypot(x, y),
        // a comparison with NaN must not hide it
        Binary::Min => {
            if y < x || y.is_nan() {
                y
            } else {
                x
            }
        }
        Binary::Max => {
            if y > x || y.is_nan() {
                y
            } else {
                x
            }
        }
        Binary::Less => truth(x < y),
        Binary::LessOrEqual => truth(x <= y),
        Binary::Equal => truth(x == y),
        Binary::NotEqual => truth(x != y),
        Binary::Modulo => modulo(x, y),
        // a NaN condition is no decision
        Binary::When | Binary::Unless if x.is_nan() => f64::NAN,
        Binary::When => {
            if x == 0.0 {
                0.0
            } else {
                y
            }
        }
        Binary::Unless => {
            if x == 0.0 {
                y
            } else {
                0.0
            }
        }
    }
}

/// `x - y floor(x/y)`, exact apart from one rounding if the signs differ; NaN for y = 0.
fn modulo(x: f64, y: f64) -> f64 {
    let rest = libm::fmod(x, y);
    if rest.is_nan() {
        f64::NAN
    } else if rest != 0.0 && (rest < 0.0) != (y < 0.0) {
        rest + y
    } else {
        rest
    }
}

/// The larger modulus is factored out first, so that neither square overflows; within 2 ulp.
#[inline(always)]
fn hypot(x: f64, y: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    let larger = if x > y { x } else { y };
    let smaller = if x > y { y } else { x };
    let ratio = smaller / larger;
    let length = larger * (1.0 + ratio * ratio).sqrt();
    // 0/0 for two zeros; a NaN operand compares false everywhere and stays
    if larger == 0.0 && smaller == 0.0 { 0.0 } else { length }
}

impl Number for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn unary(self, operation: Unary) -> Self {
        unary(operation, self)
    }

    #[inline(always)]
    fn binary(self, operation: Binary, other: Self) -> Self {
        binary(operation, self, other)
    }

    fn routine(routine: &Arc<dyn Routine>, operands: &[Self]) -> Self {
        routine.value(operands)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn length_of_a_pair_neither_overflows_nor_vanishes() {
        assert_eq!(hypot(3.0, 4.0), 5.0);
        assert_eq!(hypot(0.0, 0.0), 0.0);
        assert_eq!(hypot(-0.0, 2.5), 2.5);
        // 3e200 and 4e200 have no square in double precision
        assert!((hypot(3e200, 4e200) / 5e200 - 1.0).abs() < 4e-16);
        assert!((hypot(3e-200, 4e-200) / 5e-200 - 1.0).abs() < 4e-16);
        assert!(hypot(f64::NAN, 1.0).is_nan());
        assert!(hypot(1.0, f64::NAN).is_nan());
    }

    #[test]
    fn integer_powers_by_multiplication() {
        assert_eq!(Number::powi(3.0, 5), 243.0);
        assert_eq!(Number::powi(2.0, -3), 0.125);
        assert_eq!(Number::powi(7.0, 0), 1.0);
    }

    #[test]
    fn comparisons_do_not_hide_a_number_that_is_none() {
        for operation in [Binary::Min, Binary::Max] {
            assert!(binary(operation, f64::NAN, 1.0).is_nan());
            assert!(binary(operation, 1.0, f64::NAN).is_nan());
        }
    }
}
