//! The frequency response of a seismic sensor.

// S0 is the symbol of the standard
#![allow(non_snake_case)]

use std::f64::consts::TAU;

use gumption_engine::measurement;
use gumption_engine::model::typed::{Complex, Equations};
use gumption_engine::number::Number;

measurement! {
    /// Modulus and phase of the sensitivity of an accelerometer: a mass on a damped spring, with a
    /// delay of the output.
    ///
    /// S(f) = S0 exp(-i 2 pi f delay) / (1 - (f/f0)^2 + 2 i damping f/f0). S0 is the sensitivity at
    /// low frequencies, in any unit, f0 the frequency without damping, and damping the ratio to the
    /// critical one. A positive delay is an output that comes later: the phase falls.
    pub SeismicResponse as "seismic-response"
        from "ISO 16063-43:2015, the mass-spring-damper system";
    inputs {
        /// Sensitivity at low frequencies.
        S0: "1",
        /// Resonance frequency without damping.
        f0: "Hz",
        /// Damping ratio.
        damping: "1",
        /// Delay of the output.
        delay: "s" or 0.0,
        /// Frequency of the vibration.
        f: "Hz",
    }
    outputs SeismicSensitivity {
        /// Modulus of the sensitivity, in the unit of S0.
        modulus: "1" = "S0/|1 - (f/f0)^2 + 2 i damping f/f0|",
        /// Phase of the output relative to the acceleration.
        phase: "deg" = "-arg(1 - (f/f0)^2 + 2 i damping f/f0) - 2 pi f delay" periodic 360.0,
    }
}

impl<T: Number> Equations<T> for SeismicResponse<T> {
    type Outputs = SeismicSensitivity<T>;

    fn equations(self) -> Self::Outputs {
        let ratio = self.f / self.f0;
        let below = Complex { re: -ratio.square() + 1.0, im: self.damping * ratio * 2.0 };
        let delayed = Complex::polar(self.S0, -(self.f * self.delay * TAU));
        let response = delayed / below;
        SeismicSensitivity { modulus: response.modulus(), phase: response.phase() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn response(f: f64, delay: f64) -> SeismicSensitivity<f64> {
        SeismicResponse { S0: 0.2275, f0: 50e3, damping: 0.08, delay, f }.equations()
    }

    /// At 0 Hz S0, at f0 S0/(2 damping) and -90 deg, and far above -(f0/f)^2 S0.
    #[test]
    fn limits_of_the_resonance() {
        let still = response(0.0, 1e-5);
        assert_eq!((still.modulus, still.phase), (0.2275, 0.0));
        let top = response(50e3, 0.0);
        assert!((top.modulus - 0.2275 / 0.16).abs() < 1e-14);
        assert!((top.phase.to_degrees() + 90.0).abs() < 1e-12);
        let above = response(50e6, 0.0);
        // relative: (f0/f)^2 (1 - 2 damping^2) = 1e-6 of the modulus
        assert!((above.modulus / 0.2275e-6 - 1.0).abs() < 2e-6);
        // 2 damping f0/f = 1.6e-4 rad before half a turn
        assert!((above.phase + std::f64::consts::PI - 1.6e-4).abs() < 1e-9);
    }

    /// A delay of 1 us at 10 kHz is 3.6 deg later, and changes no modulus.
    #[test]
    fn a_delay_turns_the_phase() {
        let (with, without) = (response(10e3, 1e-6), response(10e3, 0.0));
        assert!((with.modulus / without.modulus - 1.0).abs() < 1e-14);
        assert!((with.phase - without.phase + 3.6_f64.to_radians()).abs() < 1e-14);
    }
}
