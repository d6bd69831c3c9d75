//! A command line of one's own: all of `gumption`, and files may name a measurement of this program.
//!
//! ```sh
//! cargo run --example own_program -- models free-fall --template > fall.json
//! cargo run --example own_program -- run fall.json
//! ```

use std::process::ExitCode;

use gumption::model::typed::Equations;
use gumption::number::Number;

gumption::measurement! {
    /// Acceleration of a body that falls from rest.
    pub FreeFall as "free-fall" from "kinematics, s = a t^2 / 2";
    inputs {
        /// Height of the fall.
        height: "m",
        /// Duration of the fall.
        duration: "s",
        /// What the clock is late by.
        delay: "ms" or 0.0,
    }
    outputs FreeFallResult {
        /// Acceleration.
        a: "m/s^2" = "2 height / (duration - delay)^2",
    }
}

impl<T: Number> Equations<T> for FreeFall<T> {
    type Outputs = FreeFallResult<T>;
    fn equations(self) -> FreeFallResult<T> {
        FreeFallResult { a: self.height * 2.0 / (self.duration - self.delay).square() }
    }
}

/// A model file to start from.
const TEMPLATE: &str = r#"{
  "format": 1,
  "title": "Acceleration of a falling body",
  "model": "free-fall",
  "inputs": {
    "height": {"unit": "mm", "distribution": "rectangular", "mean": 4903.325, "half_width": 0.5},
    "duration": {"unit": "s", "distribution": "normal", "mean": 1, "std": 0.001}
  },
  "outputs": {"a": {"unit": "m/s^2"}}
}
"#;

fn main() -> ExitCode {
    gumption::Application::new().measurement::<FreeFall<()>>(TEMPLATE).main()
}
