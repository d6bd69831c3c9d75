//! The sensitivity of one axis of an analogue sensor.

use super::Projection45;
use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Sensitivity of one axis of a sensor on the inclined plate of
    /// [`Projection45`](super::Projection45): output voltage over the reference acceleration along
    /// that axis.
    ///
    /// The three outputs are the sensitivity if the voltage is that of x, of y, of z: ask for the
    /// one whose voltage it is. The budget is that of the source's Table 2: positioning angles,
    /// transverse sensitivities, repeatability, reproducibility, reference. The two axes across
    /// contribute to the voltage, V = S (a_axis + transverse_1 a_1 + transverse_2 a_2), so with
    /// transverse sensitivities relative to the main one
    /// S = V / |a_axis + transverse_1 a_1 + transverse_2 a_2|, a_1 and a_2 being the accelerations
    /// along the next axes in the cyclic order x, y, z. They are neglected in the estimate (0) and
    /// have their limits of 5 % in the budget. Repeatability and reproducibility are factors of
    /// expectation 1. Voltage and acceleration are both peak or both RMS values; the modulus is for
    /// an axis whose acceleration has the opposite phase, as y has.
    pub AxisSensitivity as "axis-sensitivity"
        from "D'Emilia, Gaspari, Natale (2019), equation (4) and Table 2";
    inputs {
        /// Output voltage of the axis at the frequency of the excitation.
        voltage: "V",
        /// Reference acceleration along the slide.
        a_ref: "m/s^2",
        /// Angle of the plate against the horizontal.
        inclination: "deg" or 45.0,
        /// Angle by which the sensor is turned on the plate.
        rotation: "deg" or 45.0,
        /// Transverse sensitivity to the next axis, relative to the main sensitivity.
        transverse_1: "%" or 0.0,
        /// Transverse sensitivity to the axis after the next, relative to the main sensitivity.
        transverse_2: "%" or 0.0,
        /// Factor for what changes between repetitions.
        repeatability: "1" or 1.0,
        /// Factor for what changes between mountings and days.
        reproducibility: "1" or 1.0,
    }
    outputs AxisSensitivities {
        /// Sensitivity of the x axis.
        s_xx: "V/(m/s^2)" = "voltage*repeatability*reproducibility/abs(a_x + transverse_1*a_y + \
            transverse_2*a_z) with a_x = a_ref*cos(inclination)*cos(rotation)",
        /// Sensitivity of the y axis.
        s_yy: "V/(m/s^2)" = "voltage*repeatability*reproducibility/abs(a_y + transverse_1*a_z + \
            transverse_2*a_x) with a_y = -a_ref*cos(inclination)*sin(rotation)",
        /// Sensitivity of the z axis.
        s_zz: "V/(m/s^2)" = "voltage*repeatability*reproducibility/abs(a_z + transverse_1*a_x + \
            transverse_2*a_y) with a_z = a_ref*sin(inclination)",
    }
}

impl<T: Number> Equations<T> for AxisSensitivity<T> {
    type Outputs = AxisSensitivities<T>;

    fn equations(self) -> Self::Outputs {
        let Self { a_ref, inclination, rotation, .. } = self;
        let a = Projection45 { a_ref, inclination, rotation }.equations();
        let voltage = self.voltage * self.repeatability * self.reproducibility;
        let sensitivity = |main: T, next: T, after_next: T| {
            voltage / (main + self.transverse_1 * next + self.transverse_2 * after_next).abs()
        };
        AxisSensitivities {
            s_xx: sensitivity(a.a_x, a.a_y, a.a_z),
            s_yy: sensitivity(a.a_y, a.a_z, a.a_x),
            s_zz: sensitivity(a.a_z, a.a_x, a.a_y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::model::typed::Typed;

    #[test]
    fn voltage_over_projected_acceleration() {
        let angle = std::f64::consts::FRAC_PI_4;
        let result = AxisSensitivity {
            voltage: 0.05,
            a_ref: 10.0,
            inclination: angle,
            rotation: angle,
            transverse_1: 0.0,
            transverse_2: 0.0,
            repeatability: 1.0,
            reproducibility: 1.0,
        }
        .equations();
        assert!((result.s_xx - 0.01).abs() < 1e-16);
        assert!((result.s_yy - 0.01).abs() < 1e-16);
        assert!((result.s_zz - 0.005 * 2f64.sqrt()).abs() < 1e-16);
    }

    /// Limits of 5 % with a triangular distribution are a standard uncertainty of 2.04 %, the
    /// source's "order of 2 %" (a rectangular one would be 2.9 %). Along x the transverse axis y
    /// has the same acceleration as x, so it contributes 2.04 % of the sensitivity; z has sqrt(2)
    /// times as much.
    #[test]
    fn transverse_contributions() {
        let model = Typed::of::<AxisSensitivity<()>>().model().unwrap();
        let (values, gradients) =
            model.program.gradients(&[0.05, 10.0, 45.0, 45.0, 0.0, 0.0, 1.0, 1.0]);
        let triangular = 5.0 / 6f64.sqrt();
        assert!((triangular - 2.041).abs() < 1e-3);
        let relative = |i: usize| 100.0 * (gradients[0][i] * triangular / values[0]).abs();
        assert!((relative(4) - 2.041).abs() < 1e-3, "{}", relative(4));
        assert!((relative(5) - 2.887).abs() < 1e-3, "{}", relative(5));
    }
}
