//! Tasks made step by step.

mod by_hand;
mod temperatures;

use super::*;
use crate::distribution::{CorrelationError, Rectangular};
use crate::model::Tolerance;
use crate::model::typed::example::Projection;
use crate::propagate::{Control, Evaluation as Evaluated, evaluate};

fn normal(mean: f64, std: f64, unit: &str) -> Input {
    Input::normal(mean, std, unit).unwrap()
}

fn line() -> TaskBuilder {
    bare_line().conditions(&[("dT", "K")], [[0.0], [10.0]])
}

fn bare_line() -> TaskBuilder {
    Task::builder("line")
        .input("a", normal(2.0, 0.01, "mV/K"))
        .input("b", normal(0.5, 0.02, "mV"))
        .equation("V", "a * dT + b")
        .trials(0)
}

fn projection() -> Projection<Input> {
    Projection {
        a_ref: normal(10.0, 0.01, "m/s^2"),
        tilt: Input::rectangular(35.0, 0.1, "deg").unwrap(),
        rotation: Input::constant(0.0, "deg").unwrap(),
    }
}

fn evaluated(task: &Task) -> Evaluated {
    evaluate(task, &Control { threads: 1, ..Control::default() }).unwrap()
}

/// Estimate and standard uncertainty of each row's first output.
fn gum(task: &Task) -> Vec<[f64; 2]> {
    let rows = evaluated(task).rows;
    let first = rows.iter().map(|row| row.outputs[0].gum.as_ref().unwrap());
    first.map(|gum| [gum.estimate, gum.standard_uncertainty]).collect()
}

/// A few roundings.
fn near(found: f64, expected: f64) -> bool {
    (found / expected - 1.0).abs() < 1e-14
}

/// u^2 = (dT u_a)^2 + u_b^2 + 2 r dT u_a u_b by hand; without an output of its own the last
/// equation is one, in its coherent unit.
#[test]
fn equations_conditions_and_coefficients() {
    let task = line().correlate("a", "b", -0.5).build().unwrap();
    assert_eq!(task.model.outputs[0].quantity.unit.factor(), 1.0);
    let [first, last] = gum(&task).try_into().unwrap();
    assert!(near(first[0], 0.5e-3) && near(first[1], 0.02e-3), "{first:?}");
    assert!(near(last[0], 20.5e-3) && near(last[1], 0.0084_f64.sqrt() * 1e-3), "{last:?}");
    let task = line().output("V", "mV").build().unwrap();
    assert!(near(gum(&task)[1][1], 0.0104_f64.sqrt()));
}

/// A typed measurement at three tilts: as a condition that is known, and as an input whose estimate
/// follows one. cos 60 deg = 1/2, and u(tilt) adds (10 sin 60 deg 0.1 deg / sqrt 3)^2.
#[test]
fn a_typed_measurement_is_swept() {
    let rows = || [[0.0], [35.0], [60.0]];
    let exact = Projection { tilt: Input::constant(0.0, "deg").unwrap(), ..projection() };
    let task = Task::measurement(exact)
        .output("a_z", "m/s^2")
        .conditions(&[("tilt", "deg")], rows())
        .trials(0)
        .build()
        .unwrap();
    assert_eq!(task.variables.len(), 2);
    let found = gum(&task);
    assert!(near(found[2][0], 5.0) && near(found[2][1], 0.005), "{found:?}");

    let task = Task::measurement(projection())
        .output("a_z", "cm/s^2")
        .conditions(&[("nominal", "deg")], rows())
        .estimate("tilt", "nominal")
        .trials(0)
        .build()
        .unwrap();
    let found = gum(&task)[2];
    let of_tilt = 10.0 * 0.75f64.sqrt() * 0.1f64.to_radians() / 3f64.sqrt();
    assert!(near(found[0], 500.0), "{found:?}");
    assert!(near(found[1], 100.0 * 0.005f64.hypot(of_tilt)), "{found:?}");
}

/// A width that grows with the condition, and a component: (0.1 dT)^2 / 3 + 0.02^2.
#[test]
fn widths_and_components() {
    let task = Task::builder("x")
        .input("x", Input::constant(1.0, "V").unwrap())
        .component("x", "drift", Input::rectangular(0.0, 1.0, "V").unwrap())
        .component("x", "noise", normal(0.0, 0.02, "V"))
        .equation("y", "2 * x")
        .conditions(&[("dT", "K")], [[1.0], [2.0]])
        .distribution("x/drift", |row| Rectangular::new(0.0, 0.1 * row[0]).map(Into::into))
        .per_row("x/noise")
        .per_condition("x/drift", "dT")
        .trials(0)
        .build()
        .unwrap();
    let shown: Vec<(&str, bool)> =
        task.variables.iter().map(|v| (v.name.as_str(), v.shown)).collect();
    assert_eq!(shown, [("x", false), ("x/drift", true), ("x/noise", true)]);
    assert_eq!(task.variables[2].sharing, Sharing::Row);
    assert_eq!(task.variables[1].sharing, Sharing::Condition(0));
    let found = gum(&task);
    assert!(near(found[1][1], 2.0 * (0.04f64 / 3.0 + 0.0004).sqrt()), "{found:?}");
}

#[test]
fn settings_and_tolerances_arrive() {
    let task = line()
        .seed(7)
        .trials(Trials::Adaptive)
        .coverage(0.99)
        .tolerance("V", Tolerance { lower: None, upper: Some(0.03) })
        .title("a line")
        .build()
        .unwrap();
    let Settings { seed, trials, coverage, .. } = task.settings;
    assert_eq!((seed, trials), (7, Trials::Adaptive));
    assert_eq!(coverage, Coverage::Probability(0.99));
    assert_eq!(task.model.outputs[0].tolerance.unwrap().upper, Some(0.03));
    assert_eq!((task.title.as_str(), task.swept), ("a line", true));
}

/// The draws of a task do not depend on how it was made.
#[test]
fn a_measurement_is_the_same_by_both_ways() {
    let settings = Settings { trials: Trials::Fixed(2000), ..Settings::default() };
    let short = evaluated(&Task::of(projection(), settings).unwrap());
    let long = evaluated(&Task::measurement(projection()).trials(2000).build().unwrap());
    for (a, b) in short.rows[0].outputs.iter().zip(&long.rows[0].outputs) {
        let [a, b] = [a, b].map(|output| output.monte_carlo.as_deref().unwrap().symmetric_interval);
        assert_eq!(a, b);
    }
}

/// Each mistake by its kind, and none of the sentences speaks of options or files.
#[test]
fn mistakes() {
    let cases: Vec<(TaskBuilder, &str)> = vec![
        (Task::builder("x"), "there is no model: neither equations nor a typed measurement"),
        (line().input("a", normal(0.0, 1.0, "V")), "there are two quantities `a`"),
        (line().input("2a", normal(0.0, 1.0, "V")), "a quantity cannot be called `2a`: "),
        (line().equation("z", "a + b"), "the formula of `z`: "),
        (line().equation("z", "q"), "the formula of `z`: "),
        (line().output("V", "K"), "`V` is in `K`, which cannot be converted to `kg m^2 s^-3 A^-1`"),
        (line().output("W", "V"), "there is no output `W`"),
        (line().output("V", "Vv"), "the unit of `V`: "),
        (line().correlate("a", "q", 0.5), "there is no input `q`"),
        (line().correlate("a", "b", 1.5), "the correlation coefficient of `a` and `b` must be "),
        (
            line().correlate("a", "a", 0.5),
            "the correlation coefficient of `a` and `a` is between a quantity and itself",
        ),
        (
            line().correlate("a", "b", 0.5).correlate("b", "a", 0.5),
            "the correlation coefficient of `b` and `a` is given twice",
        ),
        (
            line().correlate("a", "b", 0.5).per_row("a"),
            "the correlation coefficient of `a` and `b` would tie rows to each other",
        ),
        (line().per_condition("a", "b"), "there is no condition `b`"),
        (line().component("q", "x", normal(0.0, 1.0, "V")), "there is no input `q`"),
        (
            line().component("b", "x", normal(0.0, 1.0, "K")),
            "a component of `b` is in `K`, but must be in `mV`",
        ),
        (line().estimate("a", "b"), "the formula of `a`: "),
        (line().estimate("a", "dT"), "`a` is in `K`, which cannot be converted to `mV/K`"),
        (line().estimate("a", "dT/dT*1e300*1e300").without_unit_check(), "`a` in row 1: "),
        (
            bare_line().conditions(&[("dT", "K")], [[f64::NAN]]),
            "row 1 of the conditions must have 1 ",
        ),
        (
            bare_line().conditions(&[("dT", "K")], [[0.0, 1.0]]),
            "row 1 of the conditions must have 1 ",
        ),
        (bare_line().conditions(&[], [[1.0]]), "there are rows of values, but no conditions"),
        (line().trials(1), "the number of trials must be 0 or at least 2"),
        (line().coverage(1.0), "the coverage must be a probability between 0 and 1"),
        (
            Task::measurement(Projection { tilt: normal(1.0, 0.1, "m"), ..projection() }),
            "`tilt` is in `m`, which cannot be converted to `deg`",
        ),
        (
            Task::measurement(projection()).conditions(&[("tilt", "deg")], [[1.0]]),
            "there are two quantities `tilt`",
        ),
        (
            Task::measurement(projection()).input("q", normal(0.0, 1.0, "m")),
            "there is no input `q`",
        ),
        (Task::measurement(projection()).output("q", "m"), "there is no output `q`"),
    ];
    for (builder, expected) in cases {
        let found = builder.build().unwrap_err().to_string();
        assert!(found.starts_with(expected), "{found}\n{expected}");
        for word in ["--", "command", "file"] {
            assert!(!found.contains(word), "{found}");
        }
    }
    let third = line().input("c", normal(0.0, 1.0, "V")).equation("z", "c + b");
    let of = third.correlate("a", "b", 0.9).correlate("b", "c", 0.9).correlate("a", "c", -0.9);
    let error = of.build().unwrap_err();
    assert!(matches!(
        &error,
        TaskError::Correlation { error: CorrelationError::Contradiction { .. }, message }
            if message.contains("`a`, `b`, `c`")
    ));
}
