//! Main and transverse sensitivities of a sensor of three axes.

use super::triple::{solve, sum};
use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Main and transverse sensitivities of a sensor of three axes, from its outputs in three to
    /// six poses on inclined planes that move vertically.
    ///
    /// In pose k the acceleration in the sensor's axes is the signed projection
    /// a_k = a_ref_k (sin(tilt_k) cos(rotation_k), sin(tilt_k) sin(rotation_k), cos(tilt_k)), and
    /// the outputs are v_k = S a_k, signed: negative where an output is in antiphase to the
    /// vertical reference. With the poses as columns of A and V, S = V A^T (A A^T)^-1: the solution
    /// of three poses, the least squares solution of more. A pose that is left out has a reference
    /// acceleration and outputs of 0 and does not contribute. The poses must not all have their
    /// accelerations in one plane.
    ///
    /// Accelerations and outputs are all RMS or all peak values, with their signs.
    pub SensitivityMatrix as "sensitivity-matrix"
        from "Prato, Mazzoleni, Schiavi (2020), sections 2-3: main and transverse sensitivities by \
            equations (1)-(3) with their signs";
    inputs {
        /// Reference acceleration in pose 1.
        a_ref_1: "m/s^2",
        /// Tilt angle in pose 1.
        tilt_1: "deg",
        /// Rotation angle in pose 1.
        rotation_1: "deg",
        /// Output of the x axis in pose 1, signed.
        v_x_1: "D",
        /// Output of the y axis in pose 1, signed.
        v_y_1: "D",
        /// Output of the z axis in pose 1, signed.
        v_z_1: "D",
        /// Reference acceleration in pose 2.
        a_ref_2: "m/s^2",
        /// Tilt angle in pose 2.
        tilt_2: "deg",
        /// Rotation angle in pose 2.
        rotation_2: "deg",
        /// Output of the x axis in pose 2, signed.
        v_x_2: "D",
        /// Output of the y axis in pose 2, signed.
        v_y_2: "D",
        /// Output of the z axis in pose 2, signed.
        v_z_2: "D",
        /// Reference acceleration in pose 3.
        a_ref_3: "m/s^2",
        /// Tilt angle in pose 3.
        tilt_3: "deg",
        /// Rotation angle in pose 3.
        rotation_3: "deg",
        /// Output of the x axis in pose 3, signed.
        v_x_3: "D",
        /// Output of the y axis in pose 3, signed.
        v_y_3: "D",
        /// Output of the z axis in pose 3, signed.
        v_z_3: "D",
        /// Reference acceleration in pose 4.
        a_ref_4: "m/s^2" or 0.0,
        /// Tilt angle in pose 4.
        tilt_4: "deg" or 0.0,
        /// Rotation angle in pose 4.
        rotation_4: "deg" or 0.0,
        /// Output of the x axis in pose 4, signed.
        v_x_4: "D" or 0.0,
        /// Output of the y axis in pose 4, signed.
        v_y_4: "D" or 0.0,
        /// Output of the z axis in pose 4, signed.
        v_z_4: "D" or 0.0,
        /// Reference acceleration in pose 5.
        a_ref_5: "m/s^2" or 0.0,
        /// Tilt angle in pose 5.
        tilt_5: "deg" or 0.0,
        /// Rotation angle in pose 5.
        rotation_5: "deg" or 0.0,
        /// Output of the x axis in pose 5, signed.
        v_x_5: "D" or 0.0,
        /// Output of the y axis in pose 5, signed.
        v_y_5: "D" or 0.0,
        /// Output of the z axis in pose 5, signed.
        v_z_5: "D" or 0.0,
        /// Reference acceleration in pose 6.
        a_ref_6: "m/s^2" or 0.0,
        /// Tilt angle in pose 6.
        tilt_6: "deg" or 0.0,
        /// Rotation angle in pose 6.
        rotation_6: "deg" or 0.0,
        /// Output of the x axis in pose 6, signed.
        v_x_6: "D" or 0.0,
        /// Output of the y axis in pose 6, signed.
        v_y_6: "D" or 0.0,
        /// Output of the z axis in pose 6, signed.
        v_z_6: "D" or 0.0,
        /// Relative correction of all reference accelerations: what the reference transducer's
        /// calibration leaves open in all poses alike.
        a_ref_correction: "%" or 0.0,
    }
    outputs SensitivityMatrixElements {
        /// Main sensitivity of the x axis.
        s_xx: "D/(m/s^2)" = "row x, column x of V A^T (A A^T)^-1",
        /// Transverse sensitivity: output x for an acceleration along y.
        s_xy: "D/(m/s^2)" = "row x, column y",
        /// Transverse sensitivity: output x for an acceleration along z.
        s_xz: "D/(m/s^2)" = "row x, column z",
        /// Transverse sensitivity: output y for an acceleration along x.
        s_yx: "D/(m/s^2)" = "row y, column x",
        /// Main sensitivity of the y axis.
        s_yy: "D/(m/s^2)" = "row y, column y",
        /// Transverse sensitivity: output y for an acceleration along z.
        s_yz: "D/(m/s^2)" = "row y, column z",
        /// Transverse sensitivity: output z for an acceleration along x.
        s_zx: "D/(m/s^2)" = "row z, column x",
        /// Transverse sensitivity: output z for an acceleration along y.
        s_zy: "D/(m/s^2)" = "row z, column y",
        /// Main sensitivity of the z axis.
        s_zz: "D/(m/s^2)" = "row z, column z",
    }
}

impl<T: Number> Equations<T> for SensitivityMatrix<T> {
    type Outputs = SensitivityMatrixElements<T>;

    fn equations(self) -> Self::Outputs {
        let scale = self.a_ref_correction + 1.0;
        let poses = [
            (self.a_ref_1, self.tilt_1, self.rotation_1),
            (self.a_ref_2, self.tilt_2, self.rotation_2),
            (self.a_ref_3, self.tilt_3, self.rotation_3),
            (self.a_ref_4, self.tilt_4, self.rotation_4),
            (self.a_ref_5, self.tilt_5, self.rotation_5),
            (self.a_ref_6, self.tilt_6, self.rotation_6),
        ];
        let a = [
            poses.map(|(a_ref, tilt, rotation)| a_ref * scale * tilt.sin() * rotation.cos()),
            poses.map(|(a_ref, tilt, rotation)| a_ref * scale * tilt.sin() * rotation.sin()),
            poses.map(|(a_ref, tilt, _)| a_ref * scale * tilt.cos()),
        ];
        let v = [
            [self.v_x_1, self.v_x_2, self.v_x_3, self.v_x_4, self.v_x_5, self.v_x_6],
            [self.v_y_1, self.v_y_2, self.v_y_3, self.v_y_4, self.v_y_5, self.v_y_6],
            [self.v_z_1, self.v_z_2, self.v_z_3, self.v_z_4, self.v_z_5, self.v_z_6],
        ];
        let normal = a.map(|row| a.map(|other| sum(row, other)));
        let moments = v.map(|outputs| a.map(|row| sum(outputs, row)));
        let [[s_xx, s_xy, s_xz], [s_yx, s_yy, s_yz], [s_zx, s_zy, s_zz]] = solve(normal, moments);
        SensitivityMatrixElements { s_xx, s_xy, s_xz, s_yx, s_yy, s_yz, s_zx, s_zy, s_zz }
    }
}

#[cfg(test)]
mod tests {
    use super::super::triple::dot;
    use super::*;
    use gumption_engine::model::typed::Measurement;

    const S: [[f64; 3]; 3] = [[421.0, 4.2, -2.1], [-3.4, 419.0, 6.3], [1.7, -5.1, 423.0]];

    /// Inputs in SI units in the order of the declaration, with outputs that follow from `S`.
    fn inputs(poses: &[(f64, f64, f64)]) -> Vec<f64> {
        let mut inputs = Vec::new();
        for k in 0..6 {
            let &(a_ref, tilt, rotation) = poses.get(k).unwrap_or(&(0.0, 0.0, 0.0));
            let (tilt, rotation) = (tilt.to_radians(), rotation.to_radians());
            let a = [
                a_ref * tilt.sin() * rotation.cos(),
                a_ref * tilt.sin() * rotation.sin(),
                a_ref * tilt.cos(),
            ];
            inputs.extend([a_ref, tilt, rotation]);
            inputs.extend(S.map(|row| dot(row, a)));
        }
        inputs.push(0.0);
        inputs
    }

    /// Condition numbers of A A^T here are below 20, and two dozen operations of 1e-16 each leave
    /// 1e-11 of 421 as a comfortable bound.
    fn assert_recovered(inputs: &[f64]) {
        let found = SensitivityMatrix::<()>::compute(inputs);
        assert_eq!(found.len(), 9);
        for (found, expected) in found.into_iter().zip(S.into_iter().flatten()) {
            assert!((found - expected).abs() < 1e-11, "{found} {expected}");
        }
    }

    #[test]
    fn three_poses_along_the_axes() {
        assert_recovered(&inputs(&[(10.0, 90.0, 0.0), (10.0, 90.0, 90.0), (10.0, 0.0, 0.0)]));
    }

    #[test]
    fn poses_at_several_tilts() {
        let poses = [
            (10.0, 0.0, 0.0),
            (10.1, 90.0, 0.0),
            (9.9, 90.0, 90.0),
            (10.0, 35.0, 30.0),
            (10.0, 55.0, 120.0),
            (10.2, 75.0, 210.0),
        ];
        for used in 4..=6 {
            assert_recovered(&inputs(&poses[..used]));
        }
    }

    #[test]
    fn the_common_correction_scales_all() {
        let mut with = inputs(&[(10.0, 90.0, 0.0), (10.0, 90.0, 90.0), (10.0, 15.0, 20.0)]);
        with[36] = 0.01;
        let found = SensitivityMatrix::<()>::compute(&with);
        assert!((found[0] - 421.0 / 1.01).abs() < 1e-11);
    }
}
