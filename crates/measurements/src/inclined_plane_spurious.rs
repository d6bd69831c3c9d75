//! A sensor on an inclined plane whose shaker also moves sideways, as the source prints it.

use gumption_engine::measurement;
use gumption_engine::model::typed::{Complex, Equations};
use gumption_engine::number::Number;

measurement! {
    /// Accelerations along the axes of a sensor on an inclined plane, with spurious components of
    /// the motion along the three axes of the shaker; the printed form.
    ///
    /// The printed form takes the modulus of every term before it adds the phasors. Signs of the
    /// projection are lost by that, so in general it differs from the vector sum of
    /// [`InclinedPlaneSpuriousVector`](super::InclinedPlaneSpuriousVector). With non-negative
    /// amplitudes and a tilt between 0 and 90 deg the two agree for a_y where sin(rotation) and
    /// cos(rotation) have the same sign, for a_x where they have opposite signs, and for a_z only
    /// without a component along x'.
    ///
    /// Accelerations are RMS values in the source; peak amplitudes in give peak amplitudes out.
    /// x', y', z' are the axes of the shaker (z' vertical), x, y, z those of the sensor. Phases are
    /// relative to the reference acceleration. Tilt and rotation are alpha and omega in the source.
    pub InclinedPlaneSpurious as "inclined-plane-spurious"
        from "Prato, Mazzoleni, Schiavi (2020), equations (8)-(10) as printed";
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
    outputs InclinedPlaneSpuriousAccelerations {
        /// Acceleration along the sensor's x axis, RMS.
        a_x: "m/s^2" = "| |a_ref sin(tilt) cos(rotation)| + |a_x_syst cos(tilt) cos(rotation)| \
            e^(i phase_x_syst) + |a_y_syst sin(rotation)| e^(i phase_y_syst) + |a_z_syst sin(tilt) \
            cos(rotation)| e^(i phase_z_syst) |",
        /// Acceleration along the sensor's y axis, RMS.
        a_y: "m/s^2" = "| |a_ref sin(tilt) sin(rotation)| + |a_x_syst cos(tilt) sin(rotation)| \
            e^(i phase_x_syst) + |a_y_syst cos(rotation)| e^(i phase_y_syst) + |a_z_syst sin(tilt) \
            sin(rotation)| e^(i phase_z_syst) |",
        /// Acceleration along the sensor's z axis, RMS.
        a_z: "m/s^2" = "| |a_ref cos(tilt)| + |a_x_syst sin(tilt)| e^(i phase_x_syst) + |a_z_syst \
            cos(tilt)| e^(i phase_z_syst) |",
    }
}

impl<T: Number> Equations<T> for InclinedPlaneSpurious<T> {
    type Outputs = InclinedPlaneSpuriousAccelerations<T>;

    fn equations(self) -> Self::Outputs {
        let (sin_tilt, cos_tilt) = (self.tilt.sin(), self.tilt.cos());
        let (sin_rot, cos_rot) = (self.rotation.sin(), self.rotation.cos());
        let (x, y, z) = (self.a_x_syst, self.a_y_syst, self.a_z_syst);
        let along_x = |projected: T| Complex::polar(projected.abs(), self.phase_x_syst);
        let along_y = |projected: T| Complex::polar(projected.abs(), self.phase_y_syst);
        let along_z = |projected: T| Complex::polar(projected.abs(), self.phase_z_syst);
        let reference = |projected: T| Complex::real(projected.abs());

        let a_x = reference(self.a_ref * sin_tilt * cos_rot)
            + along_x(x * cos_tilt * cos_rot)
            + along_y(y * sin_rot)
            + along_z(z * sin_tilt * cos_rot);
        let a_y = reference(self.a_ref * sin_tilt * sin_rot)
            + along_x(x * cos_tilt * sin_rot)
            + along_y(y * cos_rot)
            + along_z(z * sin_tilt * sin_rot);
        let a_z = reference(self.a_ref * cos_tilt) + along_x(x * sin_tilt) + along_z(z * cos_tilt);
        InclinedPlaneSpuriousAccelerations {
            a_x: a_x.modulus(),
            a_y: a_y.modulus(),
            a_z: a_z.modulus(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{InclinedPlane, InclinedPlaneSpuriousVector};
    use super::*;

    fn at(rotation: f64) -> InclinedPlaneSpurious<f64> {
        InclinedPlaneSpurious {
            a_ref: 10.0,
            tilt: 35f64.to_radians(),
            rotation: rotation.to_radians(),
            a_x_syst: 0.3,
            a_y_syst: 0.2,
            a_z_syst: 0.1,
            phase_x_syst: 120f64.to_radians(),
            phase_y_syst: (-60f64).to_radians(),
            phase_z_syst: 5f64.to_radians(),
        }
    }

    fn signed(printed: InclinedPlaneSpurious<f64>) -> InclinedPlaneSpuriousVector<f64> {
        let InclinedPlaneSpurious { a_ref, tilt, rotation, a_x_syst, a_y_syst, a_z_syst, .. } =
            printed;
        let InclinedPlaneSpurious { phase_x_syst, phase_y_syst, phase_z_syst, .. } = printed;
        InclinedPlaneSpuriousVector {
            a_ref,
            tilt,
            rotation,
            a_x_syst,
            a_y_syst,
            a_z_syst,
            phase_x_syst,
            phase_y_syst,
            phase_z_syst,
        }
    }

    /// Evaluated with 40 digits from the printed equations at a rotation of 210 deg; 1e-13 leaves
    /// room for two dozen roundings.
    #[test]
    fn third_quadrant() {
        let result = at(210.0).equations();
        assert!((result.a_x - 4.961_440_168_510_467).abs() < 1e-13);
        assert!((result.a_y - 2.921_906_935_233_948).abs() < 1e-13);
        assert!((result.a_z - 8.188_576_606_653_069).abs() < 1e-13);
    }

    #[test]
    fn without_spurious_motion_it_is_the_plane_alone() {
        let result =
            InclinedPlaneSpurious { a_x_syst: 0.0, a_y_syst: 0.0, a_z_syst: 0.0, ..at(120.0) }
                .equations();
        let InclinedPlaneSpurious { a_ref, tilt, rotation, .. } = at(120.0);
        let plane = InclinedPlane { a_ref, tilt, rotation }.equations();
        assert_eq!([result.a_x, result.a_y, result.a_z], [plane.a_x, plane.a_y, plane.a_z]);
    }

    /// Where the printed and the signed form agree, and where they part: by axis and quadrant.
    #[test]
    fn printed_and_signed_form_by_quadrant() {
        for (rotation, x_agrees, y_agrees) in
            [(30.0, false, true), (120.0, true, false), (210.0, false, true), (300.0, true, false)]
        {
            let (printed, vector) = (at(rotation).equations(), signed(at(rotation)).equations());
            let agree = |a: f64, b: f64| {
                let difference = (a - b).abs();
                // rounding, or a good part of the spurious amplitudes of 0.1 to 0.3 m/s^2
                assert!(!(1e-14..0.05).contains(&difference), "{rotation}: {difference}");
                difference < 1e-14
            };
            assert_eq!(agree(printed.a_x, vector.a_x), x_agrees, "a_x at {rotation} deg");
            assert_eq!(agree(printed.a_y, vector.a_y), y_agrees, "a_y at {rotation} deg");
            assert!(!agree(printed.a_z, vector.a_z), "a_z at {rotation} deg");

            let no_x = InclinedPlaneSpurious { a_x_syst: 0.0, ..at(rotation) };
            assert!(agree(no_x.equations().a_z, signed(no_x).equations().a_z));
        }
    }
}
