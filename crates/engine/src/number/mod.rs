//! The arithmetic of measurement models, and the numbers with which they run.
//!
//! A model is a function that is generic over [`Number`]. The same body runs with
//!
//! - `f64`: the estimate of the measurand;
//! - [`Dual`]: the estimate together with exact sensitivity coefficients;
//! - a recording number (`model::Traced`), which records the operations once, so that the Monte
//!   Carlo method can run them over whole [`Column`]s of trials.
//!
//! Every elementary function is gumption's own or comes from the `libm` crate, and no operations
//! are fused, so results have the same bits on every machine and at every vector width.

mod column;
mod complex_number;
pub(crate) mod derivative;
mod dual;
pub mod elementary;
mod operation;
mod path;
mod percent;
mod ranking;
mod routine;
mod scalar;
mod shortest;

pub use column::{COLUMN, Column};
pub(crate) use column::{Operand, apply_binary, apply_sin_cos, apply_unary};
pub use complex_number::ComplexNumber;
pub use dual::Dual;
pub use operation::{Binary, Unary};
pub(crate) use path::Instructions;
pub use path::{CodePath, Kernel, UnavailablePath};
pub use percent::of_percent;
pub use ranking::{ascending, at_rank, largest_first, median, smallest_first};
pub use routine::Routine;
pub use shortest::Shortest;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::Arc;

/// The numbers with which a measurement model computes.
///
/// Angles are in radians. Functions follow IEEE 754: outside a function's domain the result is NaN,
/// and the run stops with an error that names the operation.
///
/// ```
/// use gumption_engine::number::{Dual, Number};
///
/// fn projection<T: Number>(a: T, tilt: T) -> T {
///     a * tilt.sin()
/// }
///
/// assert_eq!(projection(10.0, 0.0), 0.0);
/// // the derivative of a sin(tilt) with respect to the tilt at 0 is a
/// let tilt = Dual::<1>::variable(0.0, 0);
/// assert_eq!(projection(Dual::constant(10.0), tilt).gradient[0], 10.0);
/// ```
pub trait Number:
    Copy
    + Debug
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// An exactly known number.
    fn constant(value: f64) -> Self;

    /// Applies an operation of one operand.
    fn unary(self, operation: Unary) -> Self;

    /// Applies an operation of two operands.
    fn binary(self, operation: Binary, other: Self) -> Self;

    /// Calls a function of several numbers.
    fn routine(routine: &Arc<dyn Routine>, operands: &[Self]) -> Self;

    /// Sine of an angle in radians.
    fn sin(self) -> Self {
        self.unary(Unary::Sin)
    }

    /// Cosine of an angle in radians.
    fn cos(self) -> Self {
        self.unary(Unary::Cos)
    }

    /// Tangent of an angle in radians.
    fn tan(self) -> Self {
        self.unary(Unary::Tan)
    }

    /// Inverse sine, in radians from -pi/2 to pi/2.
    fn asin(self) -> Self {
        self.unary(Unary::Asin)
    }

    /// Inverse cosine, in radians from 0 to pi.
    fn acos(self) -> Self {
        self.unary(Unary::Acos)
    }

    /// Inverse tangent, in radians from -pi/2 to pi/2.
    fn atan(self) -> Self {
        self.unary(Unary::Atan)
    }

    /// Angle of the point (`x`, `self`), in radians from -pi to pi.
    fn atan2(self, x: Self) -> Self {
        self.binary(Binary::Atan2, x)
    }

    /// Hyperbolic sine.
    fn sinh(self) -> Self {
        self.unary(Unary::Sinh)
    }

    /// Hyperbolic cosine.
    fn cosh(self) -> Self {
        self.unary(Unary::Cosh)
    }

    /// Hyperbolic tangent.
    fn tanh(self) -> Self {
        self.unary(Unary::Tanh)
    }

    /// Exponential function.
    fn exp(self) -> Self {
        self.unary(Unary::Exp)
    }

    /// Natural logarithm.
    fn ln(self) -> Self {
        self.unary(Unary::Ln)
    }

    /// Logarithm to base ten.
    fn log10(self) -> Self {
        self.unary(Unary::Log10)
    }

    /// Square root.
    fn sqrt(self) -> Self {
        self.unary(Unary::Sqrt)
    }

    /// Cube root.
    fn cbrt(self) -> Self {
        self.unary(Unary::Cbrt)
    }

    /// Modulus. Its derivative at 0 is taken as 0.
    fn abs(self) -> Self {
        self.unary(Unary::Abs)
    }

    /// The smaller of two; at a tie the derivative is that of `self`.
    fn min(self, other: Self) -> Self {
        self.binary(Binary::Min, other)
    }

    /// The larger of two; at a tie the derivative is that of `self`.
    fn max(self, other: Self) -> Self {
        self.binary(Binary::Max, other)
    }

    /// Square root of the sum of the squares of two numbers, without intermediate overflow.
    fn hypot(self, other: Self) -> Self {
        self.binary(Binary::Hypot, other)
    }

    /// `self` to the power `exponent`; a negative base needs a constant integer exponent
    /// ([`Number::powi`]).
    fn pow(self, exponent: Self) -> Self {
        self.binary(Binary::Power, exponent)
    }

    /// `self` to an integer power, by repeated multiplication.
    fn powi(self, exponent: i32) -> Self {
        let mut result: Option<Self> = None;
        let mut square = self;
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                result = Some(result.map_or(square, |r| r * square));
            }
            left >>= 1;
            if left > 0 {
                square = square * square;
            }
        }
        match result {
            None => Self::constant(1.0),
            Some(power) if exponent < 0 => Self::constant(1.0) / power,
            Some(power) => power,
        }
    }

    /// The complex number with these real parts; NaN where numbers are real.
    fn complex(_re: Self, _im: Self) -> Self {
        Self::constant(f64::NAN)
    }

    /// The real part: the number itself unless it is complex.
    fn real_part(self) -> Self {
        self
    }

    /// The imaginary part: 0 unless it is complex.
    fn imaginary_part(self) -> Self {
        Self::constant(0.0)
    }

    /// The conjugate: the number itself unless it is complex.
    fn conjugate(self) -> Self {
        self
    }

    /// The angle from the real axis, from -pi to pi in radians.
    fn argument(self) -> Self {
        Self::constant(0.0).atan2(self)
    }

    /// `self` times itself.
    fn square(self) -> Self {
        self * self
    }
}

/// Writes the operators of a number in terms of [`Number::unary`] and [`Number::binary`].
macro_rules! number_operators {
    ([$($generics:tt)*] $number:ty) => {
        impl<$($generics)*> std::ops::Neg for $number {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                $crate::number::Number::unary(self, $crate::number::Unary::Negate)
            }
        }
        $crate::number::number_operators!(@binary [$($generics)*] $number, Add, add, Add);
        $crate::number::number_operators!(@binary [$($generics)*] $number, Sub, sub, Subtract);
        $crate::number::number_operators!(@binary [$($generics)*] $number, Mul, mul, Multiply);
        $crate::number::number_operators!(@binary [$($generics)*] $number, Div, div, Divide);
    };
    (@binary [$($generics:tt)*] $number:ty, $trait:ident, $method:ident, $operation:ident) => {
        impl<$($generics)*> std::ops::$trait for $number {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                $crate::number::Number::binary(
                    self, $crate::number::Binary::$operation, other)
            }
        }
        impl<$($generics)*> std::ops::$trait<f64> for $number {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                std::ops::$trait::$method(
                    self, <Self as $crate::number::Number>::constant(other))
            }
        }
    };
}
pub(crate) use number_operators;
