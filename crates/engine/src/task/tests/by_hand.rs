//! Tasks whose fields were set by hand, and what a builder cannot make a task of.

use super::*;
use crate::distribution::{Constant, Normal};
use crate::model::{Capability, Tolerance};
use crate::propagate::{EvaluationError, Region};

fn sum() -> TaskBuilder {
    Task::builder("sum")
        .input("a", normal(1.0, 0.1, "m"))
        .input("b", normal(2.0, 0.2, "m"))
        .equation("y", "a + b")
        .output("y", "m")
        .trials(1000)
}

/// Why a task is not evaluated after a change.
fn refused(change: impl FnOnce(&mut Task)) -> TaskError {
    let mut task = sum().build().unwrap();
    change(&mut task);
    match evaluate(&task, &Control::default()) {
        Err(EvaluationError::Task(error)) => *error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn settings_are_checked_when_they_are_used() {
    let named = |change: fn(&mut Settings)| match refused(|task| change(&mut task.settings)) {
        TaskError::Setting { name, .. } => name,
        other => panic!("{other:?}"),
    };
    for coverage in [95.0, f64::NAN, 0.0, 1.0] {
        let error = refused(|task| task.settings.coverage = coverage.into());
        assert_eq!(error.to_string(), "the coverage must be a probability between 0 and 1");
    }
    let factor = Coverage::Factor { factor: 9.0, fixed: false };
    let error = sum().coverage(factor).build().unwrap_err();
    assert_eq!(error.to_string(), "the coverage must be a factor above 0 and at most 8");
    assert_eq!(named(|of| of.trials = Trials::Fixed(1)), "number of trials");
    let adaptive = |of: &mut Settings| (of.trials, of.max_trials) = (Trials::Adaptive, 0);
    assert_eq!(named(adaptive), "largest number of trials");
    assert_eq!(named(|of| of.digits = 0), "number of meaningful digits");
    let share = "share of trials that may be undefined";
    assert_eq!(named(|of| of.allowed_undefined = f64::NAN), share);
}

#[test]
fn tasks_that_do_not_hold_together() {
    let counted = |change: fn(&mut Task)| match refused(change) {
        TaskError::Count { found, expected, .. } => (found, expected),
        other => panic!("{other:?}"),
    };
    assert_eq!(counted(|task| drop(task.variables.pop())), (1, 2));
    assert_eq!(counted(|task| task.model.outputs.clear()), (1, 0));
    assert_eq!(counted(|task| task.rows[0].distributions = [].into()), (0, 2));
    let conditions = refused(|task| task.rows[0].conditions.push(1.0));
    assert_eq!(conditions, TaskError::Conditions { row: 0, expected: 0 });
    let of = |first, second, coefficient| Correlation { first, second, coefficient };
    let unknown = refused(|task| task.correlations = vec![of(0, 9, 0.5)]);
    assert_eq!(unknown, TaskError::Unknown { name: "9".to_owned(), kind: "variable" });
    for (second, coefficient) in [(1, f64::NAN), (1, 1.5), (0, 0.5)] {
        let error = refused(|task| task.correlations = vec![of(0, second, coefficient)]);
        assert!(matches!(error, TaskError::Coefficient { .. }));
    }
    let region = Region { outputs: vec![0, 3], probability: None };
    let unknown = refused(|task| task.regions = vec![region]);
    assert_eq!(unknown, TaskError::Unknown { name: "3".to_owned(), kind: "output" });
    let limits = Some(Tolerance { lower: Some(5.0), upper: Some(1.0) });
    let error = refused(|task| task.model.outputs[0].tolerance = limits);
    assert!(matches!(error, TaskError::Tolerance { .. }));
}

#[test]
fn tolerances_that_nothing_conforms_to() {
    let nan = f64::NAN;
    for (lower, upper) in
        [(Some(5.0), Some(1.0)), (None, None), (Some(nan), None), (None, Some(f64::INFINITY))]
    {
        let error = sum().tolerance("y", Tolerance { lower, upper }).build().unwrap_err();
        assert!(matches!(error, TaskError::Tolerance { ref of, .. } if of == "y"), "{error:?}");
    }
}

/// The last of two would be taken, and the first lost.
#[test]
fn what_is_given_twice() {
    let limits = Tolerance { lower: None, upper: Some(4.0) };
    let rows = [[1.0]];
    let given = |task: TaskBuilder| match task.build() {
        Err(TaskError::GivenTwice { what, of }) => (what, of),
        other => panic!("{other:?}"),
    };
    let of = |what, name: &str| (what, name.to_owned());
    assert_eq!(given(sum().output("y", "mm")), of("output", "y"));
    assert_eq!(given(sum().tolerance("y", limits).tolerance("y", limits)), of("tolerance", "y"));
    let twice = sum().conditions(&[("c", "m")], rows).conditions(&[("d", "m")], rows);
    assert_eq!(given(twice), of("conditions", "d"));
    let twice = sum().conditions(&[("c", "m")], rows).estimate("a", "c").estimate("a", "2*c");
    assert_eq!(given(twice).1, "a");
    assert_eq!(given(sum().per_row("a").per_row("a")).1, "a");
    let twice = sum().tolerance("y", limits).risk("y", 0.1).risk("y", 0.2);
    assert_eq!(given(twice), of("risk", "y"));
}

#[test]
fn a_typed_measurement_takes_no_equations() {
    let error = Task::measurement(projection()).equation("q", "2*a_x").build().unwrap_err();
    assert_eq!(error, TaskError::TypedEquations { name: "q".to_owned() });
}

/// u^2 = 0.1^2 + 0.05^2 + (0.3/2)^2 in K: deviations of a temperature in degC are given in K, and a
/// component in mm is one in m.
#[test]
fn components_in_units_of_the_same_kind() {
    let task = Task::builder("t")
        .input("t", normal(20.0, 0.1, "degC"))
        .component("t", "gradient", normal(0.0, 0.05, "K"))
        .component("t", "sensor", Input::expanded(250.0, 300.0, 2.0, "mK").unwrap())
        .equation("y", "t")
        .output("y", "degC")
        .trials(0)
        .build()
        .unwrap();
    assert_eq!(task.variables[2].unit.text(), "degC");
    let [found] = gum(&task).try_into().unwrap();
    let u = (0.01_f64 + 0.0025 + 0.0225).sqrt();
    assert!(near(found[0], 20.25) && near(found[1], u), "{found:?}");
    let rectangular = Input::rectangular(0.0, 3.0, "mm").unwrap();
    let longer = sum().component("a", "end", rectangular).trials(0).build().unwrap();
    // 0.1^2 + 0.2^2 + 0.003^2/3
    assert!(near(gum(&longer)[0][1], (0.05 + 3e-6_f64).sqrt()));
    for (unit, component) in [("K", "degC"), ("degF", "degC"), ("m", "kg"), ("rad/s", "Hz")] {
        let task = Task::builder("t")
            .input("x", normal(1.0, 0.1, unit))
            .component("x", "c", normal(0.0, 0.1, component))
            .equation("y", "x");
        assert!(matches!(task.build(), Err(TaskError::ComponentUnit { .. })), "{unit}");
    }
}

/// Every shape that changes its unit has the quantiles of the other unit.
#[test]
fn distributions_times_a_factor() {
    let all = [
        Input::constant(2.0, "m").unwrap(),
        normal(2.0, 0.3, "m"),
        Input::rectangular(2.0, 0.3, "m").unwrap(),
        Input::triangular(2.0, 0.3, "m").unwrap(),
        Input::t(2.0, 0.3, 4.0, "m").unwrap(),
        Input::new(crate::distribution::Arcsine::new(2.0, 0.3).unwrap(), "m").unwrap(),
    ];
    for of in all.map(|input| input.distribution) {
        let times = of.times(1000.0).unwrap();
        assert_eq!((times.name(), times.dof()), (of.name(), of.dof()));
        for p in [0.01, 0.3, 0.5, 0.9] {
            let (found, expected) = (times.quantile(p), 1000.0 * of.quantile(p));
            assert!((found - expected).abs() < 1e-10, "{} {found} {expected}", of.name());
        }
    }
    let readings = Input::readings(&[1.0, 2.0, 3.0], "mm").unwrap();
    let task = sum().component("a", "read", readings);
    assert!(matches!(task.build(), Err(TaskError::ComponentUnit { .. })));
}

/// A tolerance with a risk, a prior, a capability and a region are what the fields of the model hold.
#[test]
fn what_is_asked_of_outputs() {
    let limits = Tolerance { lower: Some(2.0), upper: Some(4.0) };
    let cmc = Capability { relative: 0.0, absolute: 1.0, floor: true };
    let task = sum()
        .equation("z", "a - b")
        .output("z", "m")
        .tolerance("y", limits)
        .risk("y", 0.02)
        .prior("y", Normal::new(3.0, 0.5).unwrap())
        .capability("y", cmc)
        .region(&["y", "z"])
        .build()
        .unwrap();
    let output = &task.model.outputs[0];
    assert_eq!((output.risk, output.capability), (Some(0.02), Some(cmc)));
    assert!(output.prior.is_some());
    assert_eq!(task.regions, [Region { outputs: vec![0, 1], probability: None }]);
    let row = &evaluated(&task).rows[0];
    let capability = row.outputs[0].capability.as_deref().unwrap();
    assert_eq!(capability.expanded_uncertainty, 1.0);
    assert!(capability.raised && row.outputs[0].conformity.is_some());
    // chi-squared of 2 degrees of freedom: k_p^2 = -2 ln(1 - p)
    let ellipsoid = row.regions[0].gum.as_ref().unwrap();
    let k = (-2.0 * (1.0 - row.regions[0].probability).ln()).sqrt();
    assert!((ellipsoid.ellipsoid_k.unwrap() - k).abs() < 1e-9);
    let wrong = |task: TaskBuilder| matches!(task.build(), Err(TaskError::Requirement { .. }));
    assert!(wrong(sum().risk("y", 0.1)) && wrong(sum().tolerance("y", limits).risk("y", 0.7)));
    let negative = Capability { absolute: -1.0, ..cmc };
    assert!(wrong(sum().capability("y", negative)));
    assert!(sum().region(&["y"]).build().is_err() && sum().region(&["y", "q"]).build().is_err());
    assert!(sum().prior("y", Constant::new(1.0).unwrap()).build().is_err());
}

#[test]
fn inputs_as_certificates_state_them() {
    let input = Input::expanded(10.0, 0.3, 3.0, "V").unwrap().group("standards").about("DMM");
    assert!(near(input.distribution.standard_uncertainty(), 0.1));
    assert_eq!(input.distribution.divisor(), Some(3.0));
    assert_eq!(input.group.as_deref(), Some("standards"));
    for (expanded, k) in [(-0.3, 2.0), (0.3, 0.0), (0.3, -2.0), (f64::NAN, 2.0)] {
        assert!(Input::expanded(10.0, expanded, k, "V").is_err());
    }
}
