//! A sensor on a table that oscillates about a vertical axis: values at one time.

use std::f64::consts::TAU;

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Accelerations of a sensor on a sinusoidally oscillating table at a time t.
    ///
    /// The time is counted from an end of the oscillation: angle = theta_0 cos(2 pi f t), theta_0
    /// being half the oscillation angle. The angular velocity is its derivative, -w_0 sin(2 pi f t)
    /// with w_0 = 2 pi f theta_0, and the tangential acceleration r dw/dt that of the angular
    /// velocity, a cosine. The source prints a sine for it, with the right amplitude but a quarter
    /// of a period off; `a_t_printed` is that form. The radial acceleration is the same in both.
    pub RotatingTableInstant as "rotating-table-instant"
        from "Chiominto et al. (2024), equations (2)-(3) with the derivatives carried out, and \
            equation (3) as printed";
    inputs {
        /// Distance of the sensitive element from the axis of rotation.
        radius: "mm",
        /// Frequency of the oscillation.
        frequency: "Hz",
        /// Oscillation angle from end to end.
        angle_pp: "deg",
        /// Time since the table was at the positive end of its oscillation.
        time: "s",
    }
    outputs RotatingTableInstantMotion {
        /// Angular position.
        angle: "deg" = "theta_0*cos(2*pi*frequency*time) with theta_0 = angle_pp/2",
        /// Angular velocity.
        angular_velocity: "rad/s" = "-w_0*sin(2*pi*frequency*time) with w_0 = 2*pi*frequency*theta_0",
        /// Tangential acceleration.
        a_t: "m/s^2" = "-2*pi*frequency*radius*w_0*cos(2*pi*frequency*time)",
        /// Radial (centripetal) acceleration.
        a_r: "m/s^2" = "radius*(w_0*sin(2*pi*frequency*time))^2",
        /// Tangential acceleration by the printed equation (3).
        a_t_printed: "m/s^2" = "2*pi*frequency*radius*w_0*sin(2*pi*frequency*time)",
    }
}

impl<T: Number> Equations<T> for RotatingTableInstant<T> {
    type Outputs = RotatingTableInstantMotion<T>;

    fn equations(self) -> Self::Outputs {
        let pulsation = self.frequency * TAU;
        let (sin, cos) = ((pulsation * self.time).sin(), (pulsation * self.time).cos());
        let theta_0 = self.angle_pp / 2.0;
        let w_0 = pulsation * theta_0;
        let amplitude = pulsation * self.radius * w_0;
        RotatingTableInstantMotion {
            angle: theta_0 * cos,
            angular_velocity: -(w_0 * sin),
            a_t: -(amplitude * cos),
            a_r: self.radius * (w_0 * sin).square(),
            a_t_printed: amplitude * sin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(time: f64) -> RotatingTableInstantMotion<f64> {
        let angle_pp = 34f64.to_radians();
        RotatingTableInstant { radius: 0.17, frequency: 5.0, angle_pp, time }.equations()
    }

    /// Velocity and acceleration against central differences of the angle; the step of 1e-5 s
    /// leaves (2 pi 5 * 1e-5)^2 / 6 = 2e-8 of truncation.
    #[test]
    fn velocity_and_acceleration_are_derivatives() {
        let h = 1e-5;
        for i in 0..40 {
            let t = 0.005 * f64::from(i) + 0.0017;
            let (before, now, after) = (at(t - h), at(t), at(t + h));
            let velocity = (after.angle - before.angle) / (2.0 * h);
            assert!((velocity - now.angular_velocity).abs() < 1e-6);
            let acceleration = (after.angular_velocity - before.angular_velocity) / (2.0 * h);
            assert!((0.17 * acceleration - now.a_t).abs() < 1e-5);
            assert!((0.17 * now.angular_velocity.powi(2) - now.a_r).abs() < 1e-13);
        }
    }

    /// The printed form a quarter of a period later is the right form with the other sign of time:
    /// sin(x - pi/2) = -cos(x). 1e-12 m/s^2 is rounding of the angle.
    #[test]
    fn printed_form_is_a_quarter_of_a_period_off() {
        let quarter = 0.05;
        for i in 0..40 {
            let t = 0.005 * f64::from(i);
            assert!((at(t).a_t - at(t - quarter).a_t_printed).abs() < 1e-12);
        }
        // at the end of the oscillation the tangential acceleration is largest, the printed one 0
        assert!((at(0.0).a_t + 49.782_299_781_148_05).abs() < 1e-13);
        assert_eq!(at(0.0).a_t_printed, 0.0);
    }
}
