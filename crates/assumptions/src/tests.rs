//! Moves, indices and allowed widths against closed forms. Statistical ones compare within four
//! numerical standard errors of the answer itself: each fails by chance once in 16 000 seeds, and the
//! seed is fixed.

use super::{Audit, InputAudit, Kept, OutputAudit, Question, audit};
use gumption_engine::propagate::Control;
use gumption_files::{ModelFile, read_text};

fn model(inputs: &str, equation: &str, more: &str) -> ModelFile {
    let text = format!(
        r#"{{"inputs": {{{inputs}}}, "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{}}}}{more}}}"#
    );
    read_text("m.json", &text, std::path::Path::new(""), &[]).unwrap()
}

fn audited(file: &ModelFile, trials: u64) -> Audit {
    let question = Question { trials, allowed: 0.05 };
    let control = Control::default().with_threads(2);
    audit(&file.task, &file.evidence, question, &control).unwrap().unwrap()
}

fn output(audit: &Audit) -> &OutputAudit {
    &audit.rows[0].outputs[0]
}

const RECTANGLE: &str = r#""x": {"distribution": "rectangular", "mean": 3, "half_width": 2}"#;

/// One rectangular quantity of half-width a: its interval has half the length 0.95 a, those of the
/// other shapes follow from their quantiles.
#[test]
fn other_shapes_of_a_rectangle() {
    let mut file = model(RECTANGLE, "x", "");
    file.task.settings.coverage = 0.95.into();
    let found = audited(&file, 200_000);
    let input = &output(&found).inputs[0];
    let z = 1.959_963_984_540_054;
    let arcsine = (0.475 * std::f64::consts::PI).sin();
    // of a trapezoid with beta = 1/2 the flanks hold 1/6 each: F = 1/40 at the way t into the flank
    // with t^2/6 = 1/40, which is half of the half-width wide
    let trapezoid = 1.0 - 0.5 * (6.0f64 / 40.0).sqrt();
    let std = 1.0 / 3f64.sqrt();
    for other in &input.alternatives {
        let (shape, of_limits) = match other.distribution.name() {
            "normal" => (z, 0.5),
            "triangular" => ((1.0 - 0.05f64.sqrt()) * 6f64.sqrt(), 1.0 / 6f64.sqrt()),
            "arcsine" => (arcsine * 2f64.sqrt(), 1.0 / 2f64.sqrt()),
            "trapezoidal" => (trapezoid * (6.0f64 / 1.25).sqrt(), (1.25f64 / 6.0).sqrt()),
            name => panic!("{name}"),
        };
        let width = if other.kept == Kept::Limits { of_limits } else { std };
        let expected = shape * width / 0.95 - 1.0;
        let (change, error) = (other.moved.change.unwrap(), other.moved.error.unwrap());
        assert!(error > 0.0 && error < 0.005, "{error}");
        let name = other.distribution.name();
        assert!((change - expected).abs() < 4.0 * error, "{name} {change} {expected} {error}");
        // standard uncertainty of 200 000 trials, to 4 times 0.2 %
        let u = other.moved.figures.unwrap().standard_uncertainty.unwrap();
        assert!((u / (2.0 * width) - 1.0).abs() < 0.008, "{name} {u}");
    }
    assert_eq!(input.alternatives.len(), 8);
    // widths are exact: the same random numbers
    let [halved, doubled] = [input.halved, input.doubled].map(|m| m.unwrap().change.unwrap());
    assert!((halved + 0.5).abs() < 1e-12 && (doubled - 1.0).abs() < 1e-12);
    let [low, high] = input.allowed.unwrap();
    // the search ends within 1e-4
    assert!((low + 0.05).abs() < 2e-4 && (high - 0.05).abs() < 2e-4, "{low} {high}");
}

/// Of two equal normal quantities: u grows to sqrt(1 + s^2)/sqrt(2) with the width s of one.
#[test]
fn widths_of_a_sum() {
    let two = r#""a": {"distribution": "normal", "mean": 0, "std": 1},
                 "b": {"distribution": "normal", "mean": 0, "std": 1},
                 "c": {"distribution": "rectangular", "mean": 0, "half_width": 0.01}"#;
    let found = audited(&model(two, "a + b + c", ""), 400_000);
    let [a, _, c] = &output(&found).inputs[..] else { panic!() };
    let halved = a.halved.unwrap();
    let expected = (1.25f64 / 2.0).sqrt() - 1.0;
    assert!((halved.change.unwrap() - expected).abs() < 4.0 * halved.error.unwrap());
    let high = (2.0f64 * 1.05 * 1.05 - 1.0).sqrt() - 1.0;
    let low = (2.0f64 * 0.95 * 0.95 - 1.0).sqrt() - 1.0;
    let allowed = a.allowed.unwrap();
    // 65 536 trials tell the ratio of two lengths to some 0.3 %, and the width reaches it by half
    assert!((allowed[0] - low).abs() < 0.02 && (allowed[1] - high).abs() < 0.02, "{allowed:?}");
    // all of it may be wrong
    assert_eq!(c.allowed.unwrap()[0], -1.0);
    assert!(c.alternatives.iter().all(|other| !other.moved.is_seen()), "{c:?}");
    assert!(c.most_different().is_none());
}

/// The function of Ishigami and Homma with a = 7, b = 0.1, whose indices have closed forms
/// (Saltelli et al., Sensitivity Analysis, Wiley 2000).
#[test]
fn indices_of_the_ishigami_function() {
    let of = |name: &str| {
        format!(
            r#""{name}": {{"distribution": "rectangular", "mean": 0, "half_width": 3.141592653589793}}"#
        )
    };
    let inputs = [of("a"), of("b"), of("c")].join(",");
    let found = audited(&model(&inputs, "sin(a) + 7*sin(b)^2 + 0.1*c^4*sin(a)", ""), 200_000);
    let pi4 = std::f64::consts::PI.powi(4);
    let (a, b) = (7.0f64, 0.1f64);
    let of_a = 0.5 * (1.0 + b * pi4 / 5.0).powi(2);
    let of_b = a * a / 8.0;
    let of_a_and_c = b * b * pi4 * pi4 * (1.0 / 18.0 - 1.0 / 50.0);
    let variance = of_a + of_b + of_a_and_c;
    let expected = [[of_a, of_a + of_a_and_c], [of_b, of_b], [0.0, of_a_and_c]];
    for (input, [first, total]) in output(&found).inputs.iter().zip(expected) {
        let sobol = input.sobol.unwrap();
        let [error, error_total] = sobol.standard_error;
        assert!(error < 0.01 && error_total < 0.01, "{sobol:?}");
        assert!((sobol.first - first / variance).abs() < 4.0 * error, "{sobol:?}");
        assert!((sobol.total - total / variance).abs() < 4.0 * error_total, "{sobol:?}");
    }
}

/// Of a linear model the indices are the shares of the variance; correlated quantities have one
/// index: (1 + 4 + 2 x 0.5 x 2)/(7 + 9) for a and b.
#[test]
fn indices_of_a_linear_model() {
    let inputs = r#""a": {"distribution": "normal", "mean": 5, "std": 1},
                    "b": {"distribution": "rectangular", "mean": 5, "half_width": 1.7320508075688772},
                    "c": {"distribution": "normal", "mean": 5, "std": 3},
                    "d": {"distribution": "constant", "value": 5}"#;
    let more = r#", "correlations": [["a", "b", 0.5]]"#;
    let found = audited(&model(inputs, "a + 2*b + c + d", more), 100_000);
    let of = output(&found);
    let (set, index) = &of.sets[0];
    assert_eq!((of.sets.len(), set), (1, &vec![0, 1]));
    let close = |value: f64, expected: f64, error: f64| {
        assert!(
            (value - expected).abs() < 4.0 * error && error < 0.01,
            "{value} {expected} {error}"
        );
    };
    let index = index.unwrap();
    close(index.first, 7.0 / 16.0, index.standard_error[0]);
    close(index.total, 7.0 / 16.0, index.standard_error[1]);
    let [a, b, c, d] = &of.inputs[..] else { panic!() };
    assert!(a.sobol.is_none() && b.sobol.is_none());
    let alone = c.sobol.unwrap();
    close(alone.first, 9.0 / 16.0, alone.standard_error[0]);
    close(c.share.unwrap(), 9.0 / 16.0, 1e-12);
    assert_eq!((d.sobol.unwrap().total, d.alternatives.len()), (0.0, 0));
    assert_eq!(found.warnings.iter().filter(|w| w.code() == "drawn-together").count(), 1);
    // with the dependence of the ranks kept, a normal b has nearly the same interval
    assert!(!b.alternatives.is_empty() && b.halved.is_some());
}

fn has_alternatives(input: &InputAudit) -> bool {
    !input.alternatives.is_empty() && input.halved.is_some() && input.allowed.is_some()
}

/// Type A has none, each component is an assumption of its own, and nothing that an output does not
/// depend on moves it.
#[test]
fn what_is_an_assumption() {
    let inputs = r#""r": {"distribution": "readings", "values": [1, 2, 3, 4, 5, 6]},
        "s": {"distribution": "normal", "mean": 1, "std": 1, "type": "A"},
        "q": {"mean": 2, "components": [
            {"name": "drift", "distribution": "rectangular", "half_width": 1},
            {"name": "again", "distribution": "readings", "values": [-1, 0, 1, 2, -2]}]},
        "unused": {"distribution": "arcsine", "mean": 1, "half_width": 1}"#;
    let file = model(inputs, "r + s + q", "");
    let found = audited(&file, 40_000);
    let name = |input: &InputAudit| file.task.variables[input.variable].name.clone();
    let inputs = &output(&found).inputs;
    let named: Vec<(String, bool)> =
        inputs.iter().map(|i| (name(i), has_alternatives(i))).collect();
    let expected =
        [("r", false), ("s", false), ("q/drift", true), ("q/again", false), ("unused", true)];
    assert_eq!(named, expected.map(|(name, has)| (name.to_owned(), has)));
    let unused = inputs.last().unwrap();
    assert!(unused.alternatives.iter().all(|other| other.moved.change == Some(0.0)));
    assert_eq!(unused.allowed.unwrap(), [-1.0, f64::INFINITY]);
    assert_eq!((unused.sobol.unwrap().first, unused.share), (0.0, Some(0.0)));
}

/// A variant whose trials are not finite has no figures and a note; one without a variance has an
/// interval alone.
#[test]
fn variants_without_figures() {
    let positive = r#""x": {"distribution": "rectangular", "mean": 1, "half_width": 0.9}"#;
    let found = audited(&model(positive, "sqrt(x)", ""), 40_000);
    let input = &output(&found).inputs[0];
    assert!(input.doubled.unwrap().figures.is_none() && input.doubled.unwrap().change.is_none());
    assert!(input.halved.unwrap().figures.is_some());
    assert!(found.warnings.iter().any(|warning| warning.code() == "variant-undefined"));
    let heavy = r#""x": {"distribution": "t", "mean": 1, "scale": 1, "dof": 1.5}"#;
    let found = audited(&model(heavy, "x", ""), 40_000);
    let of = output(&found);
    assert!(of.baseline.standard_uncertainty.is_none() && of.inputs[0].sobol.is_none());
    let normal = of.inputs[0].alternatives.iter().find(|o| o.distribution.name() == "normal");
    assert!(normal.unwrap().moved.figures.unwrap().standard_uncertainty.is_some());
}

/// VariantFigures do not depend on the number of threads, nor on how many variants are made at a time.
#[test]
fn figures_are_reproducible() {
    let file = model(RECTANGLE, "x^2", "");
    let question = Question { trials: 100_000, allowed: 0.05 };
    let run = |threads: usize, memory: usize| {
        let control = Control::default().with_threads(threads).with_memory(memory);
        format!("{:?}", audit(&file.task, &[], question, &control).unwrap().unwrap())
    };
    let one = run(1, 64 << 20);
    assert_eq!(one, run(3, 64 << 20));
    assert_eq!(one, run(2, 1));
}
