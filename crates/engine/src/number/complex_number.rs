//! Numbers that may be complex, for formulas: real numbers stay real, with the same operations.

use std::sync::Arc;

use super::{Binary, Number, Routine, Unary, number_operators};
use crate::model::typed::Complex;

/// A real number, or a complex one as a pair of numbers.
///
/// Sums, products, quotients, powers and the elementary functions of complex numbers are computed
/// with their principal values; every other operation with a complex operand gives NaN.
#[derive(Clone, Copy, Debug)]
pub struct ComplexNumber<T> {
    /// The real part.
    pub re: T,
    /// The imaginary part; `None` for a real number.
    pub im: Option<T>,
}

impl<T: Number> ComplexNumber<T> {
    /// A real number.
    pub fn real(re: T) -> Self {
        Self { re, im: None }
    }

    /// A complex number with these parts.
    pub fn new(re: T, im: T) -> Self {
        Self { re, im: Some(im) }
    }

    /// A complex number with this modulus, and this phase in radians.
    pub fn polar(modulus: T, phase: T) -> Self {
        Complex::polar(modulus, phase).into()
    }

    /// Distance from zero, also for a real number.
    pub fn modulus(self) -> T {
        match self.im {
            None => self.re.abs(),
            Some(im) => self.re.hypot(im),
        }
    }

    /// Angle from the real axis in radians, from -pi to pi.
    pub fn phase(self) -> T {
        self.im.unwrap_or_else(|| T::constant(0.0)).atan2(self.re)
    }

    fn pair(self) -> Complex<T> {
        Complex { re: self.re, im: self.im.unwrap_or_else(|| T::constant(0.0)) }
    }
}

impl<T: Number> From<Complex<T>> for ComplexNumber<T> {
    fn from(Complex { re, im }: Complex<T>) -> Self {
        Self::new(re, im)
    }
}

impl<T: Number> Number for ComplexNumber<T> {
    fn constant(value: f64) -> Self {
        Self::real(T::constant(value))
    }

    fn unary(self, operation: Unary) -> Self {
        if self.im.is_none() {
            return Self::real(self.re.unary(operation));
        }
        let z = self.pair();
        match operation {
            Unary::Negate => Self::new(-z.re, -z.im),
            Unary::Abs => Self::real(self.modulus()),
            Unary::Sqrt => z.sqrt().into(),
            Unary::Exp => z.exp().into(),
            Unary::Ln => z.ln().into(),
            Unary::Log10 => (z.ln() * T::constant(std::f64::consts::LOG10_E)).into(),
            Unary::Sin => z.sin().into(),
            Unary::Cos => z.cos().into(),
            Unary::Tan => (z.sin() / z.cos()).into(),
            Unary::Sinh => z.sinh().into(),
            Unary::Cosh => z.cosh().into(),
            Unary::Tanh => (z.sinh() / z.cosh()).into(),
            _ => Self::constant(f64::NAN),
        }
    }

    fn binary(self, operation: Binary, other: Self) -> Self {
        if self.im.is_none() && other.im.is_none() {
            return Self::real(self.re.binary(operation, other.re));
        }
        let (x, y) = (self.pair(), other.pair());
        match (operation, self.im, other.im) {
            (Binary::Add, ..) => (x + y).into(),
            (Binary::Subtract, ..) => (x - y).into(),
            // a real factor needs two products instead of four
            (Binary::Multiply, None, _) => (y * x.re).into(),
            (Binary::Multiply, _, None) => (x * y.re).into(),
            (Binary::Multiply, ..) => (x * y).into(),
            (Binary::Divide, _, None) => Self::new(x.re / y.re, x.im / y.re),
            (Binary::Divide, ..) => (x / y).into(),
            (Binary::Power, _, None) => {
                let modulus = x.modulus().pow(y.re);
                Complex::polar(modulus, x.phase() * y.re).into()
            }
            (Binary::Power, ..) => (x.ln() * y).exp().into(),
            // a choice by a real condition
            (Binary::When | Binary::Unless, None, _) => {
                Self::new(x.re.binary(operation, y.re), x.re.binary(operation, y.im))
            }
            _ => Self::constant(f64::NAN),
        }
    }

    /// Of real numbers alone.
    fn routine(routine: &Arc<dyn Routine>, operands: &[Self]) -> Self {
        if operands.iter().any(|operand| operand.im.is_some()) {
            return Self::constant(f64::NAN);
        }
        let operands: Vec<T> = operands.iter().map(|operand| operand.re).collect();
        Self::real(T::routine(routine, &operands))
    }

    fn complex(re: Self, im: Self) -> Self {
        Self::new(re.re, im.re)
    }

    fn real_part(self) -> Self {
        Self::real(self.re)
    }

    fn imaginary_part(self) -> Self {
        Self::real(self.im.unwrap_or_else(|| T::constant(0.0)))
    }

    fn conjugate(self) -> Self {
        Self { re: self.re, im: self.im.map(|im| -im) }
    }

    fn argument(self) -> Self {
        Self::real(self.phase())
    }
}

number_operators!([T: Number] ComplexNumber<T>);

#[cfg(test)]
mod tests {
    use super::*;

    /// Identities of the elementary functions; a few roundings of numbers of about 1.
    #[test]
    fn functions_of_complex_numbers() {
        let z = ComplexNumber::new(0.3, -0.7);
        let near = |a: ComplexNumber<f64>, re: f64, im: f64| {
            let found = a.im.unwrap_or(0.0);
            assert!((a.re - re).abs() < 1e-14 && (found - im).abs() < 1e-14, "{a:?}");
        };
        let root = z.sqrt();
        near(root * root, 0.3, -0.7);
        near(z.ln().exp(), 0.3, -0.7);
        near(z.sin().square() + z.cos().square(), 1.0, 0.0);
        near(z.cosh().square() - z.sinh().square(), 1.0, 0.0);
        near(z.tan() * z.cos() - z.sin(), 0.0, 0.0);
        near(z / z, 1.0, 0.0);
        near(z * z.conjugate(), 0.58, 0.0);
        near(z.pow(ComplexNumber::constant(2.5)) / z.square() / root, 1.0, 0.0);
        // exp(i pi/6)
        let turn = ComplexNumber::new(0.0, std::f64::consts::FRAC_PI_6);
        near(turn.exp(), 0.75_f64.sqrt(), 0.5);
        near(turn.exp().argument(), std::f64::consts::FRAC_PI_6, 0.0);
        near(z.abs() - ComplexNumber::real(0.58_f64.sqrt()), 0.0, 0.0);
        let i = ComplexNumber::new(0.0, 1.0);
        near(i.pow(i), libm::exp(-std::f64::consts::FRAC_PI_2), 0.0);
    }

    #[test]
    fn what_is_real_stays_real() {
        let x = ComplexNumber::real(2.0);
        assert!((x * x + x.sqrt().ln()).im.is_none());
        assert!(x.imaginary_part().re == 0.0 && x.argument().re == 0.0);
        assert!(ComplexNumber::new(1.0, 1.0).binary(Binary::Less, x).re.is_nan());
    }
}
