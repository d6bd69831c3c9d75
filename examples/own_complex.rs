//! A measurement of complex quantities: the impedance of a device from voltage and current.
//!
//! Run with `cargo run --release --example own_complex`.
#![allow(clippy::print_stdout)]

use gumption::distribution::Input;
use gumption::model::typed::{Complex, Equations};
use gumption::number::Number;
use gumption::propagate::{Control, evaluate};
use gumption::task::{Settings, Task};

gumption::measurement! {
    /// Impedance of a device, behind a cable whose propagation is known.
    pub Impedance as "impedance" from "Ohm's law of phasors";
    inputs {
        /// Voltage in phase with the generator.
        v_re: "V",
        /// Voltage in quadrature.
        v_im: "V",
        /// Current in phase with the generator.
        c_re: "mA",
        /// Current in quadrature.
        c_im: "mA",
        /// Attenuation of the cable.
        loss: "1",
        /// Phase of the cable.
        turn: "rad",
    }
    outputs Resistance {
        /// Resistance.
        r: "ohm" = "re(v/c exp(loss + i turn))",
        /// Reactance.
        x: "ohm" = "im(v/c exp(loss + i turn))",
    }
}

impl<T: Number> Equations<T> for Impedance<T> {
    type Outputs = Resistance<T>;

    fn equations(self) -> Resistance<T> {
        let voltage = Complex { re: self.v_re, im: self.v_im };
        let current = Complex { re: self.c_re, im: self.c_im };
        let cable = Complex { re: self.loss, im: self.turn }.exp();
        let z = voltage / current * cable;
        Resistance { r: z.re, x: z.im }
    }
}

/// The measurement with its inputs.
///
/// # Errors
/// Those of inputs that are none.
pub(crate) fn task(settings: Settings) -> Result<Task, Box<dyn std::error::Error>> {
    let impedance = Impedance {
        v_re: Input::normal(4.999, 0.0032, "V")?,
        v_im: Input::normal(0.31, 0.004, "V")?,
        c_re: Input::normal(19.661, 0.0095, "mA")?,
        c_im: Input::normal(-1.2, 0.02, "mA")?,
        loss: Input::rectangular(0.01, 0.002, "1")?,
        turn: Input::normal(0.05, 0.003, "rad")?,
    };
    Ok(Task::of(impedance, settings)?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let result = evaluate(&task(Settings::default())?, &Control::default())?;
    for (name, output) in ["resistance", "reactance"].into_iter().zip(&result.rows[0].outputs) {
        let gum = output.gum.as_ref().ok_or("no result")?;
        println!("{name} {:.2} ohm, u {:.2} ohm", gum.estimate, gum.standard_uncertainty);
    }
    Ok(())
}
