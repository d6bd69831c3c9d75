//! The derivatives of the operations, for dual numbers and for columns of rows alike.

use super::{Binary, Number, Unary, scalar};

/// The derivative of an operation at `x`, where its result is `y`. At a kink it follows JCGM use:
/// for a modulus at 0 it is 0.
#[inline(always)]
pub(crate) fn unary(operation: Unary, x: f64, y: f64) -> f64 {
    match operation {
        Unary::Negate => -1.0,
        Unary::Abs => {
            if x == 0.0 {
                0.0
            } else {
                x.signum()
            }
        }
        Unary::Sqrt => 0.5 / y,
        Unary::Cbrt => 1.0 / (3.0 * y * y),
        Unary::Exp => y,
        Unary::Ln => 1.0 / x,
        Unary::Log10 => std::f64::consts::LOG10_E / x,
        Unary::Sin => Number::cos(x),
        Unary::Cos => -Number::sin(x),
        Unary::Tan => 1.0 + y * y,
        Unary::Asin => 1.0 / ((1.0 - x) * (1.0 + x)).sqrt(),
        Unary::Acos => -1.0 / ((1.0 - x) * (1.0 + x)).sqrt(),
        Unary::Atan => 1.0 / (1.0 + x * x),
        Unary::Sinh => Number::cosh(x),
        Unary::Cosh => Number::sinh(x),
        // 1 - tanh^2 loses its digits where the hyperbolic tangent is near 1
        Unary::Tanh => {
            let c = Number::cosh(x);
            1.0 / (c * c)
        }
        Unary::Asinh => 1.0 / Number::hypot(1.0, x),
        Unary::Acosh => 1.0 / ((x - 1.0) * (x + 1.0)).sqrt(),
        Unary::Atanh => 1.0 / ((1.0 - x) * (1.0 + x)),
        Unary::ExpMinusOne => Number::exp(x),
        Unary::LnOnePlus => 1.0 / (1.0 + x),
        // between the steps; a continuous quantity is exactly on a step with probability 0
        Unary::Floor | Unary::Ceil | Unary::Round => 0.0,
        Unary::Erf => std::f64::consts::FRAC_2_SQRT_PI * Number::exp(-(x * x)),
        Unary::Gamma => y * crate::special::gamma::digamma(x),
    }
}

/// The derivatives of an operation with respect to its operands `x` and `y`, where its result is
/// `value`.
///
/// For `min`, `max` and choices they are 1 for the operand that is taken, at a tie the first one,
/// and 0 for the other; for a comparison 0.
#[inline(always)]
pub(crate) fn binary(operation: Binary, x: f64, y: f64, value: f64) -> [f64; 2] {
    match operation {
        Binary::Add => [1.0, 1.0],
        Binary::Subtract => [1.0, -1.0],
        Binary::Multiply => [y, x],
        Binary::Divide => [1.0 / y, -value / y],
        Binary::Power => {
            let by_base =
                if y == 0.0 { 0.0 } else { y * scalar::binary(Binary::Power, x, y - 1.0) };
            [by_base, value * Number::ln(x)]
        }
        Binary::Atan2 => {
            // for atan2(x, y): the point is (y, x); two divisions, so that the square of a small
            // radius does not underflow
            let radius = scalar::binary(Binary::Hypot, x, y);
            [y / radius / radius, -x / radius / radius]
        }
        Binary::Hypot => [x / value, y / value],
        // the operand that is taken; a comparison has zero slope
        Binary::Min if y < x => [0.0, 1.0],
        Binary::Max if y > x => [0.0, 1.0],
        Binary::Min | Binary::Max => [1.0, 0.0],
        Binary::Less | Binary::LessOrEqual | Binary::Equal | Binary::NotEqual => [0.0, 0.0],
        Binary::Modulo => [1.0, -(x / y).floor()],
        Binary::When => [0.0, if x == 0.0 { 0.0 } else { 1.0 }],
        Binary::Unless => [0.0, if x == 0.0 { 1.0 } else { 0.0 }],
    }
}

/// The gradient multiplied by the slope of an operation. A gradient of 0 stays 0 whatever the
/// slope, so that an infinite slope of a constant part has no effect. A zero result has no sign.
#[inline(always)]
pub(crate) fn chain(gradient: f64, slope: f64) -> f64 {
    if gradient == 0.0 { 0.0 } else { gradient * slope + 0.0 }
}
