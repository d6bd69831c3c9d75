//! Complex quantities as a Rust function and as formulas are one measurement.

use std::path::Path;

use gumption::file;
use gumption::propagate::{Control, Evaluation, evaluate};
use gumption::task::Settings;

#[allow(dead_code, reason = "its main function is the example's")]
#[path = "../../examples/own_complex.rs"]
mod program;

/// The same inputs by name, so that trials draw the same numbers.
const FORMULAS: &str = r#"{"inputs": {
    "v_re": {"unit": "V", "distribution": "normal", "mean": 4.999, "std": 0.0032},
    "v_im": {"unit": "V", "distribution": "normal", "mean": 0.31, "std": 0.004},
    "c_re": {"unit": "mA", "distribution": "normal", "mean": 19.661, "std": 0.0095},
    "c_im": {"unit": "mA", "distribution": "normal", "mean": -1.2, "std": 0.02},
    "loss": {"distribution": "rectangular", "mean": 0.01, "half_width": 0.002},
    "turn": {"unit": "rad", "distribution": "normal", "mean": 0.05, "std": 0.003}},
  "equations": {"z": "(v_re + i*v_im)/(c_re + i*c_im)*exp(loss + i*turn)"},
  "outputs": {"z": {"unit": "ohm", "complex": "re-im"}}}"#;

/// Estimates, standard uncertainties and ends of intervals by both methods, as bits.
fn bits(evaluation: &Evaluation) -> Vec<u64> {
    let outputs = &evaluation.rows[0].outputs;
    let of = |output: &gumption::propagate::OutputEvaluation| {
        let gum = output.gum.as_ref().expect("a result");
        let trials = output.monte_carlo.as_deref().expect("trials");
        let [low, high] = trials.symmetric_interval;
        [gum.estimate, gum.standard_uncertainty, trials.estimate.unwrap_or(f64::NAN), low, high]
            .map(f64::to_bits)
    };
    outputs.iter().flat_map(of).collect()
}

#[test]
fn a_typed_model_and_formulas_of_complex_quantities_have_the_same_bits() {
    let file = file::read_text("z.json", FORMULAS, Path::new("."), &[]).expect("a model");
    let settings: Settings = file.task.settings;
    let formulas = evaluate(&file.task, &Control::default()).expect("a result");
    let typed = program::task(settings).expect("a task");
    let typed = evaluate(&typed, &Control::default()).expect("a result");
    assert_eq!(bits(&typed), bits(&formulas));
    // (4.999 + 0.31 i) V over (19.661 - 1.2 i) mA times exp(0.01 + 0.05 i), by hand in polar form:
    // 5.00860 V / 19.69759 mA * 1.01005 = 256.830 ohm at 0.06193 + 0.06096 + 0.05 rad
    let [r, x] = [0, 1].map(|k| typed.rows[0].outputs[k].gum.as_ref().expect("one").estimate);
    assert!((r.hypot(x) - 256.830).abs() < 0.01, "{r} {x}");
    assert!(((x / r).atan() - 0.17289).abs() < 1e-4, "{r} {x}");
}

/// A part may be a text, as an input may; a wrong one is one mistake.
#[test]
fn parts_are_written_as_texts() {
    let of = |re: &str| {
        format!(
            r#"{{"inputs": {{"S": {{"complex": {{"re": "{re}", "im": "0.02(1)", "correlation": 0.5}}}}}},
            "equations": {{"y": "abs(S)"}}, "outputs": {{"y": {{}}}}}}"#
        )
    };
    let file = file::read_text("s.json", &of("0.012(5)"), Path::new("."), &[]).expect("a model");
    let parts = &file.task.rows[0].distributions;
    let found = parts.iter().map(|part| (part.mean(), part.standard_uncertainty()));
    assert_eq!(found.collect::<Vec<_>>(), [(0.012, 0.005), (0.02, 0.01)]);
    let faults = file::read_text("s.json", &of("0.012(x)"), Path::new("."), &[]).unwrap_err();
    assert_eq!(faults.0.len(), 1, "{faults}");
}
