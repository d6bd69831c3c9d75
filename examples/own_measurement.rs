//! A measurement of one's own: declare its quantities, write its equation, evaluate it.
//!
//! Run with `cargo run --release --example own_measurement`.
#![allow(clippy::print_stdout)]

use gumption::distribution::Input;
use gumption::model::typed::Equations;
use gumption::number::Number;
use gumption::propagate::{Control, evaluate};
use gumption::task::{Settings, Task};

gumption::measurement! {
    /// Density of a cylinder from its mass and dimensions.
    pub CylinderDensity as "cylinder-density" from "mass over volume";
    inputs {
        /// Mass.
        mass: "g",
        /// Diameter.
        diameter: "mm",
        /// Height.
        height: "mm",
    }
    outputs Density {
        /// Density of the material.
        density: "kg/m^3" = "4 mass / (pi diameter^2 height)",
    }
}

impl<T: Number> Equations<T> for CylinderDensity<T> {
    type Outputs = Density<T>;
    fn equations(self) -> Density<T> {
        let area = self.diameter.square() * (std::f64::consts::PI / 4.0);
        Density { density: self.mass / (area * self.height) }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cylinder = CylinderDensity {
        mass: Input::normal(21.32, 0.01, "g")?,
        diameter: Input::readings(&[12.003, 12.005, 12.001, 12.004], "mm")?,
        height: Input::rectangular(24.0, 0.02, "mm")?,
    };
    let result = evaluate(&Task::of(cylinder, Settings::default())?, &Control::default())?;
    let density = &result.rows[0].outputs[0];
    let (gum, monte_carlo) = (density.gum.as_ref(), density.monte_carlo.as_deref());
    let (gum, monte_carlo) = gum.zip(monte_carlo).ok_or("no result")?;
    println!("density {:.1} kg/m^3, u {:.1} kg/m^3", gum.estimate, gum.standard_uncertainty);
    println!("95 % coverage interval by Monte Carlo {:.1?}", monte_carlo.symmetric_interval);
    Ok(())
}
