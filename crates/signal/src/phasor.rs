//! Complex numbers as amplitude and phase, with the same bits on every machine.

use std::f64::consts::{PI, TAU};

use gumption_engine::number::elementary;

/// A complex amplitude: `A cos(2 pi f t + phi)` is the real part of `P exp(2 pi i f t)` with
/// `P = A exp(i phi)`.
pub type Phasor = nalgebra::Complex<f64>;

/// exp(2 pi i `turns`), with an absolute error of 2^-52 and that of the argument.
pub(super) fn at_turns(turns: f64) -> Phasor {
    let (sin, cos) = elementary::sin_cos_turn(turns - turns.floor());
    Phasor::new(cos, sin)
}

/// The modulus.
pub(super) fn modulus(z: Phasor) -> f64 {
    elementary::hypot(z.re, z.im)
}

/// The argument, in radians, in (-pi, pi].
pub(super) fn angle(z: Phasor) -> f64 {
    wrapped(elementary::atan2(z.im, z.re))
}

/// An angle in radians brought to (-pi, pi] by whole turns.
pub fn wrapped(angle: f64) -> f64 {
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quarter turns are exact; the ends of the interval are (-pi, pi].
    #[test]
    fn angles_are_wrapped_to_half_a_turn() {
        assert_eq!(at_turns(-0.75), Phasor::new(0.0, 1.0));
        assert_eq!(wrapped(-PI), PI);
        assert_eq!(wrapped(PI), PI);
        assert!((wrapped(7.0) - (7.0 - TAU)).abs() < 1e-15);
        assert_eq!(angle(Phasor::new(-1.0, -0.0)), PI);
    }
}
