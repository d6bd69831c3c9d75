//! Which of the two methods gives the stated U: the law of propagation where the trials agree with
//! it apart from few degrees of freedom, the trials elsewhere.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::Path;

use gumption_engine::propagate::{
    Basis, Control, DifferenceCause, Evaluation, OutputEvaluation, Stated, evaluate,
};
use gumption_engine::special::student;
use gumption_engine::task::{StatementMethod, Task, Trials};
use gumption_files as file;

const P: f64 = 0.9545;

/// A model of one output `y` of these inputs.
fn task(inputs: &str, beside: &str, formula: &str) -> Task {
    let text = format!(
        r#"{{"inputs": {{{inputs}}}, {beside} "equations": {{"y": "{formula}"}},
            "outputs": {{"y": {{"unit": "1"}}}}}}"#
    );
    file::read_text("m.json", &text, Path::new(""), &[]).unwrap().task
}

fn run(task: &mut Task, seed: u64, trials: u64) -> Evaluation {
    task.settings.seed = seed;
    task.settings.trials = Trials::Fixed(trials);
    evaluate(task, &Control::default()).unwrap()
}

fn first(found: &Evaluation) -> &OutputEvaluation {
    &found.rows[0].outputs[0]
}

fn cause(task: &Task, found: &OutputEvaluation) -> Option<DifferenceCause> {
    Some(found.agreement?.cause(task.settings.statement_tolerance))
}

/// The gauge: three readings 1 mbar apart, a resolution of 1 mbar and a reference with U = 1.2,
/// k = 2. u² = 1/3 + 1/12 + 0.36, ν_eff = 2 u⁴ 9 = 10.8, k is that of t at 10.
///
/// EA-4/02 states k u = 2.28 x 0.881 = 2.0; the trials' interval has a half-length of 2.9.
#[test]
fn few_readings_are_stated_by_the_law_of_propagation() {
    let inputs = r#""ind": {"mean": 6.7, "components": [
            {"name": "r", "distribution": "readings", "values": [-1, 0, 1]},
            {"name": "d", "distribution": "rectangular", "half_width": 0.5}]},
        "ref": {"distribution": "normal", "mean": 0, "expanded": 1.2, "k": 2}"#;
    let mut task = task(inputs, "", "ind - ref");
    let u = (1.0 / 3.0 + 1.0 / 12.0 + 0.36_f64).sqrt();
    let expanded = u * student::two_sided_factor(P, 10.0);
    for seed in 1..=5 {
        let found = run(&mut task, seed, 200_000);
        let output = first(&found);
        assert_eq!(output.validation.unwrap().gum_valid, Some(false));
        assert_eq!(cause(&task, output), Some(DifferenceCause::DegreesOfFreedom));
        let stated = Stated::of(output, &task.settings).unwrap();
        assert_eq!(stated.basis, Basis::Student);
        assert!((stated.expanded_uncertainty / expanded - 1.0).abs() < 1e-9);
    }
    task.settings.statement = StatementMethod::MonteCarlo;
    let found = run(&mut task, 1, 200_000);
    let stated = Stated::of(first(&found), &task.settings).unwrap();
    assert_eq!(stated.basis, Basis::Shortest);
    // 1.65 of the law of propagation is 0.88; half the length of the trials' interval is 2.9
    assert!((stated.expanded_uncertainty - 2.9).abs() < 0.1, "{}", stated.expanded_uncertainty);
}

/// A rectangular quantity of half-width a beside a normal one that is small: the symmetric interval is
/// that of the rectangle, 0.9545 a, while the law of propagation has 2 a/√3 = 1.155 a: 17 % of U. So it
/// is also where its width has degrees of freedom, or where a mean of few readings that contributes
/// next to nothing stands beside it.
#[test]
fn a_shape_is_stated_by_the_trials() {
    let rectangular = r#""x": {"distribution": "rectangular", "mean": 0, "half_width": 1}"#;
    let few = r#""r": {"distribution": "readings", "values": [-0.001, 0, 0.001]}"#;
    let inexact = r#""x": {"distribution": "rectangular", "mean": 0, "half_width": 1, "dof": 50}"#;
    for (inputs, formula, at_infinite_dof) in [
        (rectangular.to_owned(), "x", false),
        (format!("{rectangular}, {few}"), "x + r", true),
        (inexact.to_owned(), "x", true),
    ] {
        let mut task = task(&inputs, "", formula);
        let found = run(&mut task, 1, 400_000);
        let output = first(&found);
        let agreement = output.agreement.unwrap();
        assert_eq!(agreement.at_infinite_dof, at_infinite_dof, "{formula}");
        // (2/√3 - 0.9545)/(2/√3); the end of a rectangle has a numerical standard error of
        // 2 sqrt(p q/M) = 5e-4 at most, six of which are seen once in 10^8
        let wanted = 1.0 - 0.5 * P * 3f64.sqrt();
        assert!((agreement.difference - wanted).abs() < 3e-3, "{}", agreement.difference);
        assert_eq!(cause(&task, output), Some(DifferenceCause::Shape));
        let stated = Stated::of(output, &task.settings).unwrap();
        assert_eq!(stated.basis, Basis::Shortest);
        // what a laboratory allows is its decision
        task.settings.statement_tolerance = 0.2;
        let stated = Stated::of(output, &task.settings).unwrap();
        assert_ne!(stated.basis, Basis::Shortest);
        task.settings.statement_tolerance = 0.05;
        task.settings.statement = StatementMethod::Gum;
        let stated = Stated::of(output, &task.settings).unwrap();
        assert!(matches!(stated.basis, Basis::Normal | Basis::Student));
    }
}

/// The exponential of a normal quantity of standard deviation 0.5 with few readings: not linear, so
/// that infinite degrees of freedom do not make the intervals agree.
#[test]
fn a_model_that_bends_is_stated_by_the_trials() {
    let inputs = r#""x": {"distribution": "readings", "values": [-1.2, 0.1, 0.8, 0.3]}"#;
    let mut task = task(inputs, "", "exp(x)");
    let found = run(&mut task, 1, 200_000);
    let output = first(&found);
    assert!(output.agreement.unwrap().at_infinite_dof);
    assert_eq!(cause(&task, output), Some(DifferenceCause::Shape));
    let stated = Stated::of(output, &task.settings).unwrap();
    assert_eq!(stated.basis, Basis::Shortest);
}

/// Paired readings, a fitted line, a fitted curve that is not linear in its parameters (each trial a
/// fit of its own) and a correlated t: linear in what is drawn, so that only the degrees of freedom
/// are between the two methods, and the difference at infinite ones is the scatter of the trials.
#[test]
fn quantities_that_are_drawn_together_keep_their_correlation_at_infinite_dof() {
    let paired = r#""a": {"distribution": "readings", "values": [1.0, 1.2, 0.9, 1.1, 1.3, 1.05], "paired": true},
        "b": {"distribution": "readings", "values": [2.1, 2.4, 1.8, 2.2, 2.5, 2.0], "paired": true}"#;
    let line = r#""fits": {"line": {"form": "straight-line", "x": {"values": [1, 2, 3, 4, 5]},
        "y": {"values": [1.1, 1.9, 3.05, 4.1, 4.9]}}},"#;
    let curve = r#""fits": {"line": {"form": "a + b*exp(x/c)", "start": {"a": 0, "b": 1, "c": 3},
        "x": {"values": [1, 2, 3, 4, 5, 6]}, "y": {"values": [1.401, 1.952, 2.716, 3.800, 5.289, 7.392]}}},"#;
    let correlated = r#""a": {"distribution": "t", "mean": 1, "scale": 0.1, "dof": 4},
        "b": {"distribution": "t", "mean": 1, "scale": 0.1, "dof": 4}"#;
    let cases = [
        (paired, "", "a - 0.4*b"),
        (r#""z": {"distribution": "constant", "value": 2.5}"#, line, "line(z)"),
        (r#""z": {"distribution": "constant", "value": 3.5}"#, curve, "line(z)"),
        (correlated, r#""correlations": [["a", "b", 0.8]],"#, "a - b"),
    ];
    for (inputs, beside, formula) in cases {
        let mut task = task(inputs, beside, formula);
        let found = run(&mut task, 3, 200_000);
        let output = first(&found);
        let Some(agreement) = output.agreement else {
            // no degrees of freedom are defined for correlated t quantities
            assert!(output.validation.is_none(), "{formula}");
            continue;
        };
        assert!(agreement.at_infinite_dof, "{formula}");
        // six numerical standard errors of 131 072 trials, 0.4 % each, and what the curve bends
        assert!(agreement.difference < 0.03, "{formula}: {}", agreement.difference);
        assert_eq!(cause(&task, output), Some(DifferenceCause::DegreesOfFreedom), "{formula}");
    }
}
