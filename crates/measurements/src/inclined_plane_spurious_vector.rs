//! A sensor on an inclined plane whose shaker also moves sideways, as a rotated vector.

use gumption_engine::measurement;
use gumption_engine::model::typed::{Complex, Equations};
use gumption_engine::number::Number;

measurement! {
    /// Accelerations along the axes of a sensor on an inclined plane, with spurious components of
    /// the motion along the three axes of the shaker; the signed vector form.
    ///
    /// The complex vector (a_x_syst e^(i phase_x_syst), a_y_syst e^(i phase_y_syst), a_ref +
    /// a_z_syst e^(i phase_z_syst)) is turned about y' by the tilt, then about the plane's normal
    /// by the rotation; moduli are taken last. What is right for the vector of an acceleration;
    /// [`InclinedPlaneSpurious`](super::InclinedPlaneSpurious) says where the printed form agrees.
    ///
    /// Accelerations are RMS values in the source; peak amplitudes in give peak amplitudes out.
    /// x', y', z' are the axes of the shaker (z' vertical), x, y, z those of the sensor.
    pub InclinedPlaneSpuriousVector as "inclined-plane-spurious-vector"
        from "Prato, Mazzoleni, Schiavi (2020), equations (8)-(10) with the signs of the \
            projection";
    inputs {
        /// Reference acceleration along the vertical, RMS.
        a_ref: "m/s^2",
        /// Tilt angle of the plane against the horizontal.
        tilt: "deg",
        /// Rotation angle of the sensor on the plane.
        rotation: "deg",
        /// Amplitude of the spurious component along x', RMS.
        a_x_syst: "m/s^2",
        /// Amplitude of the spurious component along y', RMS.
        a_y_syst: "m/s^2",
        /// Amplitude of the spurious component along z', RMS.
        a_z_syst: "m/s^2",
        /// Phase of the spurious component along x' relative to the reference.
        phase_x_syst: "deg",
        /// Phase of the spurious component along y' relative to the reference.
        phase_y_syst: "deg",
        /// Phase of the spurious component along z' relative to the reference.
        phase_z_syst: "deg",
    }
    outputs InclinedPlaneVectorAccelerations {
        /// Acceleration along the sensor's x axis, RMS.
        a_x: "m/s^2" = "|(z' sin(tilt) + x' cos(tilt)) cos(rotation) - y' sin(rotation)| with x' = \
            a_x_syst e^(i phase_x_syst), y' = a_y_syst e^(i phase_y_syst), z' = a_ref + a_z_syst \
            e^(i phase_z_syst)",
        /// Acceleration along the sensor's y axis, RMS.
        a_y: "m/s^2" = "|(z' sin(tilt) + x' cos(tilt)) sin(rotation) + y' cos(rotation)|",
        /// Acceleration along the sensor's z axis, RMS.
        a_z: "m/s^2" = "|z' cos(tilt) - x' sin(tilt)|",
    }
}

impl<T: Number> Equations<T> for InclinedPlaneSpuriousVector<T> {
    type Outputs = InclinedPlaneVectorAccelerations<T>;

    fn equations(self) -> Self::Outputs {
        let x = Complex::polar(self.a_x_syst, self.phase_x_syst);
        let y = Complex::polar(self.a_y_syst, self.phase_y_syst);
        let z = Complex::real(self.a_ref) + Complex::polar(self.a_z_syst, self.phase_z_syst);
        let (sin_tilt, cos_tilt) = (self.tilt.sin(), self.tilt.cos());
        let (sin_rot, cos_rot) = (self.rotation.sin(), self.rotation.cos());

        let down_the_plane = z * sin_tilt + x * cos_tilt;
        InclinedPlaneVectorAccelerations {
            a_x: (down_the_plane * cos_rot - y * sin_rot).modulus(),
            a_y: (down_the_plane * sin_rot + y * cos_rot).modulus(),
            a_z: (z * cos_tilt - x * sin_tilt).modulus(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Evaluated with 40 digits at a rotation of 210 deg; 1e-13 leaves room for two dozen
    /// roundings.
    #[test]
    fn third_quadrant() {
        let result = InclinedPlaneSpuriousVector {
            a_ref: 10.0,
            tilt: 35f64.to_radians(),
            rotation: 210f64.to_radians(),
            a_x_syst: 0.3,
            a_y_syst: 0.2,
            a_z_syst: 0.1,
            phase_x_syst: 120f64.to_radians(),
            phase_y_syst: (-60f64).to_radians(),
            phase_z_syst: 5f64.to_radians(),
        }
        .equations();
        assert!((result.a_x - 4.868_177_962_740_639).abs() < 1e-13);
        assert!((result.a_y - 2.921_906_935_233_948).abs() < 1e-13);
        assert!((result.a_z - 8.360_364_380_880_874).abs() < 1e-13);
    }

    /// A rotation of the frame leaves the length of the vector alone, whatever the angles.
    #[test]
    fn the_length_of_the_vector_is_kept() {
        for degrees in 0..360 {
            let angle = f64::from(degrees).to_radians();
            let result = InclinedPlaneSpuriousVector {
                a_ref: 10.0,
                tilt: 0.37 * angle,
                rotation: angle,
                a_x_syst: 0.7,
                a_y_syst: 0.4,
                a_z_syst: 0.9,
                phase_x_syst: 2.0 * angle,
                phase_y_syst: 1.3,
                phase_z_syst: -0.2,
            }
            .equations();
            let length = (result.a_x.powi(2) + result.a_y.powi(2) + result.a_z.powi(2)).sqrt();
            let vertical = (10.0 + 0.9 * 0.2f64.cos()).hypot(0.9 * 0.2f64.sin());
            let expected = (0.49 + 0.16 + vertical * vertical).sqrt();
            assert!((length - expected).abs() < 1e-13, "{degrees} deg: {length}");
        }
    }
}
