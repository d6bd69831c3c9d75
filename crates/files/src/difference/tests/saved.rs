use std::fmt::Write;
use std::path::Path;

use super::super::difference;
use crate::result::seal;
use gumption_engine::propagate::Control;

use crate::{ModelOrResult, read_result, read_text};
use gumption_analysis::diff::{ChangeCause, Difference, OutputDifference};
use gumption_engine::special::student::two_sided_factor;
use gumption_text::DiagnosticKind;

/// An input: file hash, name, estimate, standard uncertainty, degrees of freedom (0 for infinite).
type Input<'a> = (&'a str, &'a str, f64, f64, f64);

/// A result file of the model `m` with one output `y` in mV.
struct Made<'a> {
    inputs: &'a [Input<'a>],
    sensitivities: &'a [f64],
    correlations: &'a str,
    /// u, k and degrees of freedom (0 for infinite).
    figures: [f64; 3],
    probability: f64,
}

impl Made<'_> {
    fn result(&self) -> ModelOrResult {
        let dof = |dof: f64| if dof == 0.0 { "null".to_owned() } else { dof.to_string() };
        let mut inputs = String::new();
        for (index, (model, name, estimate, u, input_dof)) in self.inputs.iter().enumerate() {
            let comma = if index > 0 { "," } else { "" };
            let dof = dof(*input_dof);
            write!(
                inputs,
                r#"{comma}{{"model_sha256": "{model}", "name": "{name}", "unit": "V",
                "distribution": "normal", "estimate": {estimate}, "standard_uncertainty": {u},
                "dof": {dof}}}"#
            )
            .unwrap();
        }
        let [u, k, output_dof] = self.figures;
        let (dof, sensitivities) = (dof(output_dof), self.sensitivities);
        let (p, correlations) = (self.probability, self.correlations);
        let text = format!(
            r#"{{"format": 1, "result": true, "coverage_probability": {p}, "outputs": {{"y": {{
            "unit": "mV", "estimate": 0, "standard_uncertainty": {u}, "standard_deviation": {u},
            "dof": {dof}, "coverage_factor": {k}, "sensitivities": {sensitivities:?},
            "quantiles": [-1, 0, 1]}}}}, "scores": {{"from": -1, "step": 1, "count": 3}},
            "inputs": [{inputs}], "input_correlations": [{correlations}],
            "provenance": {{"model_sha256": "m"}}}}"#
        );
        // with its digest the figures need not be consistent
        let mut file: serde_json::Map<String, serde_json::Value> =
            serde_json::from_str(&text).unwrap();
        let digest = seal::digest(&file);
        file.insert(seal::DIGEST.to_owned(), digest.into());
        let text = serde_json::Value::Object(file).to_string();
        ModelOrResult::Result(read_result("r.json", &text).unwrap())
    }
}

fn compared(first: &Made<'_>, second: &Made<'_>) -> Difference {
    difference(&first.result(), &second.result(), &Control::default()).unwrap()
}

fn only(difference: &Difference) -> &OutputDifference {
    assert_eq!(difference.rows.len(), 1);
    &difference.rows[0].outputs[0]
}

fn share(output: &OutputDifference, due: &ChangeCause) -> f64 {
    output.parts.iter().find(|part| part.due == *due).unwrap().share.unwrap()
}

fn input(name: &str) -> ChangeCause {
    ChangeCause::Input(name.to_owned())
}

/// The parts sum to the change of U, the shares to 1.
fn assert_complete(output: &OutputDifference) {
    let [Some(before), Some(after)] = output.expanded else { panic!("{output:?}") };
    let changes: f64 = output.parts.iter().map(|part| part.change.unwrap()).sum();
    assert!((changes - (after - before)).abs() < 1e-13 * before.max(after), "{output:?}");
    let shares: f64 = output.parts.iter().map(|part| part.share.unwrap()).sum();
    assert!((shares - 1.0).abs() < 1e-12, "{output:?}");
}

/// The factor of 95 % at infinite degrees of freedom.
const K: f64 = 1.959_963_984_540_054;

/// y = a + b + c with contributions 3, 4, 1, then 4, 2, 1: u^2 moves by 7 and by -12, so the shares
/// are -7/5 and 12/5. That the second comes from a sensitivity coefficient is said.
#[test]
fn contributions_of_a_sum() {
    let given =
        |a: f64| [("m", "a", 1.0, a, 0.0), ("m", "b", 1.0, 4.0, 0.0), ("m", "c", 0.0, 1.0, 0.0)];
    let made = |inputs, sensitivities, u: f64| Made {
        inputs,
        sensitivities,
        correlations: "",
        figures: [u, K, 0.0],
        probability: 0.95,
    };
    let (before, after) = (given(3.0), given(4.0));
    let first = made(&before, &[1.0, 1.0, 1.0], 26f64.sqrt());
    let second = made(&after, &[1.0, 0.5, 1.0], 21f64.sqrt());
    let difference = compared(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    assert!((share(output, &input("a")) + 7.0 / 5.0).abs() < 1e-12);
    assert!((share(output, &input("b")) - 12.0 / 5.0).abs() < 1e-12);
    assert_eq!(share(output, &input("c")), 0.0);
    assert_eq!(output.parts.iter().filter(|part| part.is_changed()).count(), 2);
    assert_eq!(difference.changes.len(), 1, "{:?}", difference.changes);
    assert!(difference.changes[0].contains("coefficients to `b`;"), "{:?}", difference.changes);
}

/// Degrees of freedom: u = 5 from 3 and 4, of which 4 has 5, then 20 of them. nu_eff = 25^2/(16^2/5)
/// = 12.2, then 48.8; t at 12 and at 48. All of the change is that input's.
#[test]
fn degrees_of_freedom_act_through_the_factor() {
    let given = |dof: f64| [("m", "a", 1.0, 3.0, 0.0), ("m", "b", 1.0, 4.0, dof)];
    let (before, after) = (given(5.0), given(20.0));
    let made = |inputs, dof: f64| Made {
        inputs,
        sensitivities: &[1.0, -1.0],
        correlations: "",
        figures: [5.0, two_sided_factor(0.95, dof.floor()), dof],
        probability: 0.95,
    };
    let of = |dof: f64| 625.0 / (256.0 / dof);
    let difference = compared(&made(&before, of(5.0)), &made(&after, of(20.0)));
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(share(output, &input("b")), 1.0);
    assert_eq!(output.parts.len(), 2);
}

/// Paired readings are correlated inputs with degrees of freedom: u^2 = 9 + 16 + 2 * 12 r with four
/// of them as a whole. Where only the coefficient moves, it explains all.
#[test]
fn paired_readings_are_one_term() {
    let inputs = [("m", "a", 1.0, 3.0, 4.0), ("m", "b", 1.0, 4.0, 4.0)];
    let made = |correlations, r: f64| Made {
        inputs: &inputs,
        sensitivities: &[1.0, 1.0],
        correlations,
        figures: [(25.0 + 24.0 * r).sqrt(), two_sided_factor(0.95, 4.0), 4.0],
        probability: 0.95,
    };
    let difference = compared(&made("[0, 1, 0.5]", 0.5), &made("[1, 0, 0.25]", 0.25));
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(share(output, &ChangeCause::Correlations), 1.0);
    assert_eq!(difference.changes, ["correlation of `a` and `b`: from 0.5 to 0.25"]);
}

/// The coverage probability has a part of its own, and so has what a file's figures hold beyond what
/// its inputs give: here u is 6, though its only contribution is 5.
#[test]
fn coverage_and_what_is_not_told() {
    let inputs = [("m", "a", 1.0, 5.0, 0.0)];
    let made = |figures, probability| Made {
        inputs: &inputs,
        sensitivities: &[1.0],
        correlations: "",
        figures,
        probability,
    };
    let wider = two_sided_factor(0.99, f64::INFINITY);
    let difference = compared(&made([5.0, K, 0.0], 0.95), &made([5.0, wider, 0.0], 0.99));
    assert_complete(only(&difference));
    assert_eq!(share(only(&difference), &ChangeCause::Coverage), 1.0);
    assert_eq!(difference.changes, ["`coverage_probability`: from 0.95 to 0.99"]);
    let difference = compared(&made([5.0, K, 0.0], 0.95), &made([6.0, K, 0.0], 0.95));
    assert_complete(only(&difference));
    assert_eq!(share(only(&difference), &ChangeCause::Rest), 1.0);
}

/// An input behind another result is the same by file and name, and where that file is another one,
/// by name; names that several have are told apart by the hash.
#[test]
fn inputs_behind_results() {
    let before = [
        ("m", "a", 1.0, 3.0, 0.0),
        ("0123456789", "a", 1.0, 2.0, 0.0),
        ("2022", "gain", 1.0, 1.0, 0.0),
    ];
    let after = [
        ("m", "a", 1.0, 3.0, 0.0),
        ("2023", "gain", 1.0, 2.0, 0.0),
        ("0123456789", "a", 1.0, 2.0, 0.0),
    ];
    let made = |inputs, u: f64| Made {
        inputs,
        sensitivities: &[1.0, 1.0, 1.0],
        correlations: "",
        figures: [u, K, 0.0],
        probability: 0.95,
    };
    let difference = compared(&made(&before, 14f64.sqrt()), &made(&after, 17f64.sqrt()));
    let output = only(&difference);
    assert_complete(output);
    let names: Vec<&ChangeCause> = output.parts.iter().map(|part| &part.due).collect();
    assert_eq!(names, [&input("a"), &input("a (01234567)"), &input("gain")]);
    assert_eq!(share(output, &input("gain")), 1.0);
}

/// A model file is evaluated: y = a^2 at 2 with u = 0.1 is 0.4 V, against 3 mV once from `a` and
/// once from an input that left.
#[test]
fn a_model_file_and_a_result() {
    let inputs = [("m", "a", 2.0, 0.001, 0.0), ("m", "gone", 0.0, 0.001, 0.0)];
    let first = Made {
        inputs: &inputs,
        sensitivities: &[3000.0, 3000.0],
        correlations: "",
        figures: [18f64.sqrt(), K, 0.0],
        probability: 0.95,
    };
    let model = |more: &str| {
        let text = format!(
            r#"{{{more} "check_units": false, "inputs": {{"a": {{"unit": "V",
            "distribution": "normal", "mean": 2, "std": 0.1}}}}, "equations": {{"y": "a^2"}},
            "outputs": {{"y": {{"unit": "V"}}}}}}"#
        );
        ModelOrResult::Model(Box::new(read_text("m.json", &text, Path::new(""), &[]).unwrap()))
    };
    let (first, second) = (first.result(), model(r#""coverage_probability": 0.95,"#));
    let compared = difference(&first, &second, &Control::default()).unwrap();
    let output = only(&compared);
    assert_complete(output);
    // in mV: u^2 from 9 + 9 to 400^2
    let total = 160_000.0 - 18.0;
    assert!((share(output, &input("a")) - (160_000.0 - 9.0) / total).abs() < 1e-12);
    assert!((share(output, &input("gone")) + 9.0 / total).abs() < 1e-12);
    assert_eq!(output.parts[1].states[1], None);

    let swept = model(r#""conditions": {"f": {"values": [1, 2]}},"#);
    let diagnostics = difference(&swept, &first, &Control::default()).unwrap_err();
    assert_eq!(diagnostics.0[0].kind, DiagnosticKind::SeveralRows { rows: 2 });
    assert_eq!(diagnostics.0[0].position(), (1, 2));
}
