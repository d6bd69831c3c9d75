//! The sum of waves of one frequency.

use gumption_engine::measurement;
use gumption_engine::model::typed::{Complex, Equations};
use gumption_engine::number::Number;

measurement! {
    /// Amplitude of the sum of two to four waves of the same frequency.
    ///
    /// Amplitudes are all peak or all RMS values. Phases are relative to the first wave. A wave
    /// that is left out has the amplitude 0.
    pub WaveInterference as "wave-interference"
        from "Prato, Mazzoleni, Schiavi (2020), equation (4), the first of the two so numbered";
    inputs {
        /// Amplitude of the first wave, the reference.
        e_1: "m/s^2",
        /// Amplitude of the second wave.
        e_2: "m/s^2",
        /// Phase of the second wave relative to the first.
        phase_2: "deg",
        /// Amplitude of the third wave.
        e_3: "m/s^2" or 0.0,
        /// Phase of the third wave relative to the first.
        phase_3: "deg" or 0.0,
        /// Amplitude of the fourth wave.
        e_4: "m/s^2" or 0.0,
        /// Phase of the fourth wave relative to the first.
        phase_4: "deg" or 0.0,
    }
    outputs WaveInterferenceSum {
        /// Amplitude of the sum.
        e_tot: "m/s^2" = "|e_1 + e_2 e^(i phase_2) + e_3 e^(i phase_3) + e_4 e^(i phase_4)|",
        /// Phase of the sum relative to the first wave.
        phase_tot: "deg" = "arg(e_1 + e_2 e^(i phase_2) + e_3 e^(i phase_3) + e_4 e^(i phase_4))"
            periodic 360.0,
    }
}

impl<T: Number> Equations<T> for WaveInterference<T> {
    type Outputs = WaveInterferenceSum<T>;

    fn equations(self) -> Self::Outputs {
        let sum = Complex::real(self.e_1)
            + Complex::polar(self.e_2, self.phase_2)
            + Complex::polar(self.e_3, self.phase_3)
            + Complex::polar(self.e_4, self.phase_4);
        WaveInterferenceSum { e_tot: sum.modulus(), phase_tot: sum.phase() }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn waves(e: [f64; 4], phases: [f64; 3]) -> WaveInterferenceSum<f64> {
        let [e_1, e_2, e_3, e_4] = e;
        let [phase_2, phase_3, phase_4] = phases;
        WaveInterference { e_1, e_2, phase_2, e_3, phase_3, e_4, phase_4 }.equations()
    }

    #[test]
    fn two_waves() {
        assert!((waves([3.0, 4.0, 0.0, 0.0], [FRAC_PI_2, 0.0, 0.0]).e_tot - 5.0).abs() < 1e-15);
        assert_eq!(waves([3.0, 4.0, 0.0, 0.0], [0.0; 3]).e_tot, 7.0);
        // law of cosines
        let sum = waves([2.0, 1.5, 0.0, 0.0], [0.7, 0.0, 0.0]);
        let square = 4.0 + 2.25 + 6.0 * 0.7f64.cos();
        assert!((sum.e_tot - square.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn four_equal_waves_a_quarter_of_a_turn_apart_cancel() {
        let sum = waves([1.0; 4], [FRAC_PI_2, PI, -FRAC_PI_2]);
        assert!(sum.e_tot < 1e-15);
    }
}
