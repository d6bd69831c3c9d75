//! A sensor on an inclined plane that is fixed to a vertical shaker.

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Accelerations along the axes of a sensor on an inclined plane that moves vertically.
    ///
    /// All accelerations are RMS values in section 3 of the source; the projection is linear, so
    /// peak amplitudes in give peak amplitudes out. The tilt is called alpha in the source and
    /// theta in Chiominto et al. (2024), equation (1); the rotation omega and alpha.
    pub InclinedPlane as "inclined-plane"
        from "Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024), equation (1)";
    inputs {
        /// Reference acceleration along the vertical, RMS.
        a_ref: "m/s^2",
        /// Tilt angle of the plane against the horizontal.
        tilt: "deg",
        /// Rotation angle of the sensor on the plane.
        rotation: "deg",
    }
    outputs InclinedPlaneAccelerations {
        /// Acceleration along the sensor's x axis, RMS.
        a_x: "m/s^2" = "abs(a_ref*sin(tilt)*cos(rotation))",
        /// Acceleration along the sensor's y axis, RMS.
        a_y: "m/s^2" = "abs(a_ref*sin(tilt)*sin(rotation))",
        /// Acceleration along the sensor's z axis, RMS.
        a_z: "m/s^2" = "abs(a_ref*cos(tilt))",
    }
}

impl<T: Number> Equations<T> for InclinedPlane<T> {
    type Outputs = InclinedPlaneAccelerations<T>;

    fn equations(self) -> Self::Outputs {
        let Self { a_ref, tilt, rotation } = self;
        InclinedPlaneAccelerations {
            a_x: (a_ref * tilt.sin() * rotation.cos()).abs(),
            a_y: (a_ref * tilt.sin() * rotation.sin()).abs(),
            a_z: (a_ref * tilt.cos()).abs(),
        }
    }
}
