//! A measurement for the tests of the engine.

use super::Equations;
use crate::number::Number;

crate::measurement! {
    /// The projections of an acceleration onto the axes of a tilted and rotated sensor.
    pub Projection as "projection" from "a test";
    inputs {
        /// Acceleration along the vertical.
        a_ref: "m/s^2",
        /// Tilt against the horizontal.
        tilt: "deg",
        /// Rotation on the plane.
        rotation: "deg",
    }
    outputs Projections {
        /// Along x.
        a_x: "m/s^2" = "|a_ref sin(tilt) cos(rotation)|",
        /// Along y.
        a_y: "m/s^2" = "|a_ref sin(tilt) sin(rotation)|",
        /// Along z.
        a_z: "m/s^2" = "|a_ref cos(tilt)|",
    }
}

impl<T: Number> Equations<T> for Projection<T> {
    type Outputs = Projections<T>;

    fn equations(self) -> Self::Outputs {
        let Self { a_ref, tilt, rotation } = self;
        Projections {
            a_x: (a_ref * tilt.sin() * rotation.cos()).abs(),
            a_y: (a_ref * tilt.sin() * rotation.sin()).abs(),
            a_z: (a_ref * tilt.cos()).abs(),
        }
    }
}
