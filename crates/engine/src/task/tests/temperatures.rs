//! Celsius temperatures of typed measurements: nothing mixes them with temperatures in kelvin.

#![allow(unreachable_pub)] // what the macro declares

use super::*;
use crate::model::formula::ScaleMisfit;
use crate::model::typed::Equations;
use crate::number::Number;

crate::measurement! {
    /// The length of a gauge block at its reference temperature.
    pub Block as "block" from "EA-4/02, S4";
    inputs {
        /// Length.
        l: "mm",
        /// Temperature.
        t: "degC",
        /// A difference.
        d: "K" or 0.0,
        /// The reference temperature, 20 degC.
        t_ref: "degF" or 68.0,
    }
    outputs Blocks {
        /// Length at the reference temperature.
        l_ref: "mm" = "l*(1 - 1e-5*(t + d - t_ref))",
        /// The temperature, corrected.
        t_c: "degC" = "t + d",
        /// Its difference.
        dt: "K" = "t + d - t_ref",
    }
}

impl<T: Number> Equations<T> for Block<T> {
    type Outputs = Blocks<T>;

    fn equations(self) -> Blocks<T> {
        let t_c = self.t + self.d;
        let dt = t_c - self.t_ref;
        Blocks { l_ref: self.l * (dt * -1e-5 + 1.0), t_c, dt }
    }
}

fn block(t: f64, unit: &str) -> Block<Input> {
    let l = normal(50.0, 1e-4, "mm");
    let d = Input::constant(0.0, "K").unwrap();
    let t_ref = Input::constant(68.0, "degF").unwrap();
    Block { l, t: normal(t, 0.05, unit), d, t_ref }
}

fn estimate(task: TaskBuilder) -> f64 {
    gum(&task.trials(0).build().unwrap())[0][0]
}

/// 21.5 degC is 70.7 degF, and 1.5 K above the reference.
#[test]
fn degrees_arrive_as_degrees_celsius() {
    for (t, unit) in [(21.5, "degC"), (70.7, "degF")] {
        let of = |output: &str, unit_of: &str| {
            estimate(Task::measurement(block(t, unit)).output(output, unit_of))
        };
        // subtractions of numbers of some ten leave rounding
        assert!((of("l_ref", "mm") - 50.0 * (1.0 - 1.5e-5)).abs() < 1e-12);
        assert!((of("t_c", "degC") - 21.5).abs() < 1e-12);
        assert!((of("t_c", "degF") - 70.7).abs() < 1e-12);
        assert!((of("dt", "mK") - 1500.0).abs() < 1e-10);
    }
}

/// A temperature that is left out has its default on the scale that it is declared in.
#[test]
fn defaults_have_the_zero_of_their_unit() {
    let model = crate::model::typed::Typed::of::<Block<()>>();
    let recorder = crate::model::Recorder::default();
    let given = recorder.variable(0);
    let results = model.record_with(|name| (name != "t_ref" && name != "d").then_some(given));
    let program = recorder.program(1, &results[2..]);
    // the 20 degC that are 68 degF
    assert!((program.evaluate(&[21.0])[0] - 1.0).abs() < 1e-12);
}

#[test]
fn kelvin_and_degrees_are_not_mixed() {
    let misfit = |task: TaskBuilder| match task.trials(0).build() {
        Err(TaskError::WrongScale { of, unit, misfit }) => (of, unit, misfit),
        other => panic!("{other:?}"),
    };
    let kelvin = ScaleMisfit::CelsiusInKelvin;
    let celsius = ScaleMisfit::KelvinInCelsius { thermodynamic: false };
    let named = |of: &str, unit: &str, misfit| (of.to_owned(), unit.to_owned(), misfit);
    for unit in ["K", "mK"] {
        let found = misfit(Task::measurement(block(293.25, unit)));
        assert_eq!(found, named("t", unit, kelvin));
        let found = misfit(Task::measurement(block(20.1, "degC")).output("t_c", unit));
        assert_eq!(found, named("t_c", unit, kelvin));
    }
    let task = Task::measurement(block(20.1, "degC")).input("d", normal(0.1, 0.1, "degC"));
    assert_eq!(misfit(task), named("d", "degC", celsius));
    let task = Task::measurement(block(20.1, "degC")).output("dt", "degC");
    assert_eq!(misfit(task), named("dt", "degC", celsius));
    let constant = Block { t: Input::constant(0.0, "degC").unwrap(), ..block(20.1, "degC") };
    let task = Task::measurement(constant).conditions(&[("t", "K")], [[293.15]]);
    assert_eq!(misfit(task), named("t", "K", kelvin));
}
