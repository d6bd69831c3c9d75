//! The sensitivity of a digital sensor.

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Sensitivity of a digital accelerometer in digits per acceleration, and its inverse, the
    /// scale factor that data sheets give.
    ///
    /// Output and reference acceleration are both RMS or both peak values. An output of one digit
    /// for a reference acceleration equal to the scale factor turns a data sheet's figure into a
    /// sensitivity: 0.244 mg/LSB is 418 D/(m/s^2).
    pub Sensitivity as "sensitivity"
        from "Chiominto et al. (2024), section 3.1: ratio of digital output and reference \
            acceleration";
    inputs {
        /// Digital output of the sensor at the frequency of the excitation.
        output: "D",
        /// Reference acceleration along the sensor's axis.
        a_ref: "m/s^2",
    }
    outputs SensitivityRatio {
        /// Sensitivity.
        sensitivity: "D/(m/s^2)" = "output/a_ref",
        /// Scale factor, the inverse of the sensitivity, in thousandths of standard gravity.
        scale_factor: "mg_n/LSB" = "a_ref/output",
    }
}

impl<T: Number> Equations<T> for Sensitivity<T> {
    type Outputs = SensitivityRatio<T>;

    fn equations(self) -> Self::Outputs {
        SensitivityRatio {
            sensitivity: self.output / self.a_ref,
            scale_factor: self.a_ref / self.output,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Section 3.1 of the source: 0.244 mg/LSB, 2.39e-3 (m/s^2)/D and 418 D/(m/s^2); the printed
    /// 0.224 mg/LSB would be 455 D/(m/s^2).
    #[test]
    fn data_sheet() {
        let mg = 9.806_65e-3;
        let result = Sensitivity { output: 1.0, a_ref: 0.244 * mg }.equations();
        assert!((result.sensitivity - 418.0).abs() < 0.5, "{}", result.sensitivity);
        assert!((result.scale_factor - 2.39e-3).abs() < 0.005e-3);
        assert!((result.scale_factor / mg - 0.244).abs() < 1e-15);
        let slip = Sensitivity { output: 1.0, a_ref: 0.224 * mg }.equations();
        assert!((slip.sensitivity - 455.2).abs() < 0.05);
    }
}
