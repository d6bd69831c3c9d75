//! A sensor on a table that oscillates about a vertical axis: amplitudes and means.

use std::f64::consts::TAU;

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Accelerations of a sensor on a table that oscillates sinusoidally about its axis.
    ///
    /// The oscillation angle is given from end to end, as the source's test plan does; the
    /// amplitude theta_0 is half of it, and w_0 = 2 pi frequency theta_0. The tangential
    /// acceleration has the frequency of the oscillation. The radial acceleration
    /// r w_0^2 (1 - cos(2 pi 2 f t)) / 2 has a mean and a component of twice the frequency; the
    /// "radial amplitude" of the test plan is the sum of the two, the peak value r w_0^2. All are
    /// peak amplitudes, not RMS values.
    pub RotatingTable as "rotating-table"
        from "Chiominto et al. (2024), equations (2)-(3) and section 3.4.1";
    inputs {
        /// Distance of the sensitive element from the axis of rotation.
        radius: "mm",
        /// Frequency of the oscillation.
        frequency: "Hz",
        /// Oscillation angle from end to end.
        angle_pp: "deg",
        /// Relative correction of the oscillation angle (scale of the encoder).
        angle_correction: "%" or 0.0,
    }
    outputs RotatingTableAccelerations {
        /// Tangential acceleration at the frequency of the oscillation, peak.
        a_t: "m/s^2" = "2*pi*frequency*radius*w_0 with w_0 = 2*pi*frequency*angle_pp*(1 + \
            angle_correction)/2",
        /// Radial acceleration at twice the frequency of the oscillation, peak.
        a_r_2f: "m/s^2" = "radius*w_0^2/2",
        /// Mean radial acceleration.
        a_r_mean: "m/s^2" = "radius*w_0^2/2",
        /// Largest radial acceleration, the source's radial amplitude.
        a_r_peak: "m/s^2" = "radius*w_0^2",
    }
}

impl<T: Number> Equations<T> for RotatingTable<T> {
    type Outputs = RotatingTableAccelerations<T>;

    fn equations(self) -> Self::Outputs {
        let theta_0 = self.angle_pp * (self.angle_correction + 1.0) / 2.0;
        let pulsation = self.frequency * TAU;
        let w_0 = pulsation * theta_0;
        let a_r_peak = self.radius * w_0.square();
        RotatingTableAccelerations {
            a_t: pulsation * self.radius * w_0,
            a_r_2f: a_r_peak / 2.0,
            a_r_mean: a_r_peak / 2.0,
            a_r_peak,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(frequency: f64, degrees: f64) -> RotatingTableAccelerations<f64> {
        let angle_pp = degrees.to_radians();
        RotatingTable { radius: 0.17, frequency, angle_pp, angle_correction: 0.0 }.equations()
    }

    /// Section 3.4.1 of the source; half a unit of the last printed digit.
    #[test]
    fn test_plan_of_the_source() {
        for (frequency, angle, tangential, radial) in
            [(5.0, 34.0, None, 14.8), (8.0, 13.0, Some(48.7), 5.5), (10.0, 8.5, Some(49.8), 3.7)]
        {
            let result = at(frequency, angle);
            if let Some(tangential) = tangential {
                assert!((result.a_t - tangential).abs() <= 0.05, "{}", result.a_t);
            }
            assert!((result.a_r_peak - radial).abs() <= 0.05, "{}", result.a_r_peak);
            assert_eq!(result.a_r_2f * 2.0, result.a_r_peak);
        }
    }

    /// The source prints 48.8 m/s^2 at 5 Hz and 34 deg. The angle alone gives 49.78 m/s^2, and so
    /// does the printed radial amplitude: sqrt(14.8 / 0.17) * 2 pi 5 * 0.17 = 49.83.
    #[test]
    fn printed_tangential_amplitude_at_5_hz_does_not_follow() {
        let result = at(5.0, 34.0);
        assert!((result.a_t - 49.782_299_781_148_05).abs() < 1e-13);
        assert!((result.a_r_peak - 14.770_705_686_730_06).abs() < 1e-13);
    }

    #[test]
    fn a_correction_of_the_angle_enters_linearly_and_squared() {
        let angle_pp = 34f64.to_radians();
        let corrected =
            RotatingTable { radius: 0.17, frequency: 5.0, angle_pp, angle_correction: 0.01 }
                .equations();
        assert!((corrected.a_t / at(5.0, 34.0).a_t - 1.01).abs() < 1e-14);
        assert!((corrected.a_r_peak / at(5.0, 34.0).a_r_peak - 1.0201).abs() < 1e-14);
    }
}
