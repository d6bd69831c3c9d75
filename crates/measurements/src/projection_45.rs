//! A sensor of three axes on a plate that is inclined on a horizontal slide.

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Reference accelerations along the axes of a sensor that is turned by 45 deg on a plate
    /// inclined by 45 deg, on a slide that moves horizontally.
    ///
    /// The source prints cos(45 deg) cos(45 deg), -cos(45 deg) cos(45 deg) and sin(45 deg). With
    /// the two positioning angles as quantities of their own, x is at the rotation angle and y at
    /// right angles to it, so the second factor of y is the sine of the rotation; at 45 deg that
    /// is the printed value, and a rotation error moves x and y in opposite directions.
    /// Amplitudes are peak or RMS values as given, with the sign of the projection.
    pub Projection45 as "projection-45"
        from "D'Emilia, Gaspari, Natale (2019), equations (1)-(3)";
    inputs {
        /// Reference acceleration along the slide.
        a_ref: "m/s^2",
        /// Angle of the plate against the horizontal.
        inclination: "deg" or 45.0,
        /// Angle by which the sensor is turned on the plate.
        rotation: "deg" or 45.0,
    }
    outputs Projection45Accelerations {
        /// Acceleration along the sensor's x axis.
        a_x: "m/s^2" = "a_ref*cos(inclination)*cos(rotation)",
        /// Acceleration along the sensor's y axis.
        a_y: "m/s^2" = "-a_ref*cos(inclination)*sin(rotation)",
        /// Acceleration along the sensor's z axis.
        a_z: "m/s^2" = "a_ref*sin(inclination)",
    }
}

impl<T: Number> Equations<T> for Projection45<T> {
    type Outputs = Projection45Accelerations<T>;

    fn equations(self) -> Self::Outputs {
        let Self { a_ref, inclination, rotation } = self;
        let along_the_plate = a_ref * inclination.cos();
        Projection45Accelerations {
            a_x: along_the_plate * rotation.cos(),
            a_y: -(along_the_plate * rotation.sin()),
            a_z: a_ref * inclination.sin(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

    #[test]
    fn at_45_degrees() {
        let result =
            Projection45 { a_ref: 10.0, inclination: FRAC_PI_4, rotation: FRAC_PI_4 }.equations();
        assert!((result.a_x - 5.0).abs() < 1e-14);
        assert!((result.a_y + 5.0).abs() < 1e-14);
        assert!((result.a_z - 10.0 * FRAC_1_SQRT_2).abs() < 1e-14);
    }

    #[test]
    fn the_length_of_the_vector_is_kept() {
        let result = Projection45 { a_ref: 10.0, inclination: 0.3, rotation: 1.1 }.equations();
        let length = (result.a_x.powi(2) + result.a_y.powi(2) + result.a_z.powi(2)).sqrt();
        assert!((length - 10.0).abs() < 1e-14);
    }
}
