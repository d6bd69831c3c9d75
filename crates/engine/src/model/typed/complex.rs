//! Complex quantities: phasors of sinusoidal motion and frequency responses.

use std::ops::{Add, Div, Mul, Sub};

use crate::number::Number;

/// A complex number as a pair in the arithmetic of the model.
///
/// ```
/// use gumption_engine::model::typed::Complex;
///
/// let sum = Complex::real(3.0) + Complex::polar(4.0, std::f64::consts::FRAC_PI_2);
/// assert!((sum.modulus() - 5.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex<T> {
    /// Real part: in phase with the reference.
    pub re: T,
    /// Imaginary part: a quarter of a turn ahead of the reference.
    pub im: T,
}

impl<T: Number> Complex<T> {
    /// A number without imaginary part.
    pub fn real(re: T) -> Self {
        Self { re, im: T::constant(0.0) }
    }

    /// The phasor of an amplitude and a phase in radians. A negative amplitude is a phasor of the
    /// opposite direction.
    pub fn polar(amplitude: T, phase: T) -> Self {
        Self { re: amplitude * phase.cos(), im: amplitude * phase.sin() }
    }

    /// Distance from zero. It has no derivative at zero.
    pub fn modulus(self) -> T {
        (self.re.square() + self.im.square()).sqrt()
    }

    /// Angle from the real axis in radians, from -pi to pi.
    pub fn phase(self) -> T {
        self.im.atan2(self.re)
    }

    /// The conjugate: the imaginary part changes its sign.
    #[must_use]
    pub fn conjugate(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// The square root of the right half plane.
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self::polar(self.modulus().sqrt(), self.phase() * 0.5)
    }

    /// The exponential function.
    #[must_use]
    pub fn exp(self) -> Self {
        Self::polar(self.re.exp(), self.im)
    }

    /// The natural logarithm, whose imaginary part is the phase.
    #[must_use]
    pub fn ln(self) -> Self {
        Self { re: self.modulus().ln(), im: self.phase() }
    }

    /// The sine.
    #[must_use]
    pub fn sin(self) -> Self {
        Self { re: self.re.sin() * self.im.cosh(), im: self.re.cos() * self.im.sinh() }
    }

    /// The cosine.
    #[must_use]
    pub fn cos(self) -> Self {
        Self { re: self.re.cos() * self.im.cosh(), im: -(self.re.sin() * self.im.sinh()) }
    }

    /// The hyperbolic sine.
    #[must_use]
    pub fn sinh(self) -> Self {
        Self { re: self.re.sinh() * self.im.cos(), im: self.re.cosh() * self.im.sin() }
    }

    /// The hyperbolic cosine.
    #[must_use]
    pub fn cosh(self) -> Self {
        Self { re: self.re.cosh() * self.im.cos(), im: self.re.sinh() * self.im.sin() }
    }
}

impl<T: Number> Div for Complex<T> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let size = other.re.square() + other.im.square();
        Self {
            re: (self.re * other.re + self.im * other.im) / size,
            im: (self.im * other.re - self.re * other.im) / size,
        }
    }
}

impl<T: Number> Add for Complex<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Number> Sub for Complex<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<T: Number> Mul for Complex<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl<T: Number> Mul<T> for Complex<T> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_multiply_moduli_and_add_phases() {
        let product = Complex::polar(2.0, 0.3) * Complex::polar(1.5, -1.1);
        // a handful of roundings
        assert!((product.modulus() - 3.0).abs() < 1e-15);
        assert!((product.phase() + 0.8).abs() < 1e-15);
        let doubled = Complex::polar(2.0, 0.3) * 2.0;
        assert_eq!(doubled - Complex::polar(2.0, 0.3), Complex::polar(2.0, 0.3));
    }
}
