use std::path::Path;

use super::super::of_models;
use crate::{ModelFile, read_text};
use gumption_analysis::diff::{ChangeCause, Difference, OutputDifference};
use gumption_engine::propagate::Control;

fn compare(first: &ModelFile, second: &ModelFile) -> Difference {
    of_models(first, second, &Control::default())
}

fn read(text: &str) -> ModelFile {
    read_text("x", text, Path::new(""), &[]).unwrap()
}

/// A file with these inputs, equations and other members.
fn model(inputs: &str, equation: &str, more: &str) -> ModelFile {
    read(&format!(
        r#"{{"inputs": {{{inputs}}}, "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{}}}},
        "monte_carlo": {{"trials": 0}}{more}}}"#
    ))
}

fn normal(name: &str, mean: f64, std: f64) -> String {
    format!(r#""{name}": {{"distribution": "normal", "mean": {mean}, "std": {std}}}"#)
}

fn inputs(list: &[(&str, f64, f64)]) -> String {
    list.iter().map(|(n, m, s)| normal(n, *m, *s)).collect::<Vec<_>>().join(",")
}

fn only(difference: &Difference) -> &OutputDifference {
    assert_eq!(difference.rows.len(), 1);
    &difference.rows[0].outputs[0]
}

fn share(output: &OutputDifference, name: &str) -> f64 {
    let due = ChangeCause::Input(name.to_owned());
    output.parts.iter().find(|part| part.due == due).unwrap().share.unwrap()
}

/// The sum of all shares is 1, that of all changes the change of U.
fn assert_complete(output: &OutputDifference) {
    let [Some(before), Some(after)] = output.expanded else { panic!("{output:?}") };
    let changes: f64 = output.parts.iter().map(|part| part.change.unwrap()).sum();
    let scale = before.max(after);
    assert!((changes - (after - before)).abs() < 1e-12 * scale, "{output:?}");
    if before != after {
        let shares: f64 = output.parts.iter().map(|part| part.share.unwrap()).sum();
        assert!((shares - 1.0).abs() < 1e-9, "{output:?}");
    }
}

/// y = a + b + c; u(a) from 3 to 4, u(b) from 4 to 2: u^2 moves by 7 and by -12, so the shares are
/// -7/5 and 12/5.
#[test]
fn standard_uncertainties_of_a_sum() {
    let first = model(&inputs(&[("a", 1.0, 3.0), ("b", 1.0, 4.0), ("c", 1.0, 1.0)]), "a+b+c", "");
    let second = model(&inputs(&[("a", 1.0, 4.0), ("b", 1.0, 2.0), ("c", 1.0, 1.0)]), "a+b+c", "");
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    assert!((share(output, "a") + 7.0 / 5.0).abs() < 1e-12);
    assert!((share(output, "b") - 12.0 / 5.0).abs() < 1e-12);
    assert_eq!(share(output, "c"), 0.0);
    assert!(difference.changes.is_empty());
    assert_eq!(output.parts.iter().filter(|part| part.is_changed()).count(), 2);
}

/// y = a b with u = 0.1 and 0.2 at (2, 3): u^2 = (3 * 0.1)^2 + (2 * 0.2)^2. A moved estimate of a
/// changes the coefficient of b, so all of the change is a's.
#[test]
fn a_moved_estimate_acts_through_the_coefficients_of_others() {
    let first = model(&inputs(&[("a", 2.0, 0.1), ("b", 3.0, 0.2)]), "a*b", "");
    let second = model(&inputs(&[("a", 4.0, 0.1), ("b", 3.0, 0.2)]), "a*b", "");
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(share(output, "a"), 1.0);
    assert_eq!(share(output, "b"), 0.0);
    // a from 2 to 4 and u(b) from 0.2 to 0.3: a^2 u(b)^2 from 0.16 to 1.44. Alone, a brings
    // 0.48 or 1.08, u(b) 0.2 or 0.8; the averages are 0.78 and 0.5 of 1.28
    let second = model(&inputs(&[("a", 4.0, 0.1), ("b", 3.0, 0.3)]), "a*b", "");
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    assert!((share(output, "a") - 0.78 / 1.28).abs() < 1e-12, "{output:?}");
    assert!((share(output, "b") - 0.50 / 1.28).abs() < 1e-12, "{output:?}");
}

/// The order of the inputs in the files does not matter, and going back is the same with the
/// opposite sign.
#[test]
fn the_order_of_inputs_does_not_matter() {
    let values = |scale: f64| {
        [("a", 2.0 * scale, 0.1), ("b", 3.0, 0.2 * scale), ("c", 1.5 * scale, 0.05 * scale)]
    };
    let turned = |list: [(&'static str, f64, f64); 3]| [list[2], list[0], list[1]];
    let equation = "a*b*c + exp(c)*b";
    let (first, second) =
        (model(&inputs(&values(1.0)), equation, ""), model(&inputs(&values(1.3)), equation, ""));
    let other = model(&inputs(&turned(values(1.3))), equation, "");
    let [straight, mixed, back] =
        [compare(&first, &second), compare(&first, &other), compare(&second, &first)];
    let [straight, mixed, back] = [&straight, &mixed, &back].map(only);
    assert_complete(straight);
    for name in ["a", "b", "c"] {
        assert!((share(straight, name) - share(mixed, name)).abs() < 1e-12, "{name}");
        assert!((share(straight, name) - share(back, name)).abs() < 1e-12, "{name}");
    }
}

/// More inputs than subsets can be taken of; u^2 stays additive, so the shares are exact.
#[test]
fn many_inputs() {
    let names: Vec<String> = (0..40).map(|i| format!("x_{i}")).collect();
    let list = |step: f64| -> Vec<(&str, f64, f64)> {
        names.iter().enumerate().map(|(i, n)| (n.as_str(), 1.0, 1.0 + step * i as f64)).collect()
    };
    let equation = names.join("+");
    let first = model(&inputs(&list(0.0)), &equation, "");
    let second = model(&inputs(&list(0.5)), &equation, "");
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    let total: f64 = (0..40).map(|i| (1.0 + 0.5 * f64::from(i)).powi(2) - 1.0).sum();
    for (i, name) in names.iter().enumerate() {
        let expected = ((1.0 + 0.5 * i as f64).powi(2) - 1.0) / total;
        assert!((share(output, name) - expected).abs() < 1e-12, "{name}");
    }
}

/// An input that comes with a new term of the equation explains what it brings; the rest of the
/// equation's change is the model's.
#[test]
fn added_and_removed_inputs() {
    let first = model(&inputs(&[("a", 1.0, 3.0)]), "a", "");
    let second = model(&inputs(&[("a", 1.0, 3.0), ("b", 0.0, 4.0)]), "a+b", "");
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(share(output, "b"), 1.0);
    assert_eq!(output.parts.len(), 2);
    assert_eq!(output.parts[1].states[0], None);
    assert_eq!(difference.changes, ["equation `y`: from \"a\" to \"a+b\""]);
    let back = compare(&second, &first);
    assert_eq!(share(only(&back), "b"), 1.0);

    // twice a: u^2 from 9 to 36 by the model, to 36 + 16 by b
    let second = model(&inputs(&[("a", 1.0, 3.0), ("b", 0.0, 4.0)]), "2*a+b", "");
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    assert!((share(output, "b") - 16.0 / 43.0).abs() < 1e-12);
    let model = output.parts.last().unwrap();
    assert_eq!(model.due, ChangeCause::Model);
    assert!((model.share.unwrap() - 27.0 / 43.0).abs() < 1e-12);
}

/// u^2 = 9 + 16 + 2 * 12 r: the coefficient has a part of its own.
#[test]
fn correlations_and_coverage() {
    let given = inputs(&[("a", 1.0, 3.0), ("b", 1.0, 4.0)]);
    let first = model(&given, "a+b", "");
    let second = model(&given, "a+b", r#", "correlations": [["b", "a", 0.5]]"#);
    let difference = compare(&first, &second);
    let output = only(&difference);
    assert_complete(output);
    let part = output.parts.last().unwrap();
    assert_eq!((part.due.clone(), part.share), (ChangeCause::Correlations, Some(1.0)));
    assert_eq!(difference.changes, ["`correlations` added: (b, a, 0.5)"]);

    let second = model(&given, "a+b", r#", "coverage_probability": 0.99"#);
    let difference = compare(&first, &second);
    let part = only(&difference).parts.last().unwrap();
    assert_eq!((part.due.clone(), part.share), (ChangeCause::Coverage, Some(1.0)));
}

/// Degrees of freedom change U by way of k.
#[test]
fn degrees_of_freedom() {
    let with = |dof: u32| {
        let a = format!(r#""a": {{"distribution": "normal", "mean": 1, "std": 3, "dof": {dof}}}"#);
        model(&format!("{a}, {}", normal("b", 1.0, 1.0)), "a+b", "")
    };
    let difference = compare(&with(5), &with(50));
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(share(output, "a"), 1.0);
    assert!(output.expanded[1] < output.expanded[0]);
}

/// Units of inputs and outputs may change; figures are in the first file's unit.
#[test]
fn units_are_converted() {
    let file = |unit: &str, mean: f64, std: f64, output: &str| {
        read(&format!(
            r#"{{"inputs": {{"a": {{"unit": "{unit}", "distribution": "normal", "mean": {mean},
            "std": {std}}}, "b": {{"unit": "m", "distribution": "normal", "mean": 1, "std": 0.01}}}},
            "equations": {{"y": "a*b"}}, "outputs": {{"y": {{"unit": "{output}"}}}}}}"#
        ))
    };
    let difference = compare(&file("mm", 1.0, 0.1, "mm^2"), &file("m", 0.001, 0.0002, "m^2"));
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(output.unit, "mm^2");
    assert!((share(output, "a") - 1.0).abs() < 1e-12, "{output:?}");
    assert_eq!(output.parts.len(), 2, "{output:?}");
    let expanded = output.expanded.map(|u| (u.unwrap() * 1e3).round());
    // 2 sqrt((1000 * 0.1)^2 + (1 * 10)^2) = 200.998; with 200: 400.50 mm^2
    assert_eq!(expanded, [200_998.0, 400_500.0]);
}

/// A temperature in degC in one file and in K in the other is taken over with the zero of the scale:
/// 293.15 K is 20 degC in the first model, so that the input explains the whole change.
#[test]
fn celsius_against_kelvin() {
    let file = |unit: &str, mean: f64, std: f64, formula: &str| {
        read(&format!(
            r#"{{"inputs": {{"t": {{"unit": "{unit}", "distribution": "normal", "mean": {mean},
            "std": {std}}}, "p": {{"unit": "K", "distribution": "normal", "mean": 300, "std": 0.1}}}},
            "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
        ))
    };
    let celsius = file("degC", 20.0, 0.1, "p/kelvin(t)");
    for [first, second] in
        [[&celsius, &file("K", 293.15, 0.2, "p/t")], [&file("K", 293.15, 0.2, "p/t"), &celsius]]
    {
        let difference = compare(first, second);
        let output = only(&difference);
        assert_complete(output);
        assert!((share(output, "t") - 1.0).abs() < 1e-9, "{output:?}");
    }
}

#[test]
fn rows_of_conditions_are_paired() {
    let file = |values: &str, std: f64| {
        read(&format!(
            r#"{{"inputs": {{"a": {{"distribution": "normal", "mean": "f", "std": {std}}}}},
            "conditions": {{"f": {{"values": [{values}]}}}},
            "equations": {{"y": "a^2"}}, "outputs": {{"y": {{}}}}}}"#
        ))
    };
    let difference = compare(&file("1, 2, 3", 0.1), &file("2, 3, 4", 0.2));
    let values: Vec<f64> = difference.rows.iter().map(|row| row.conditions[0].1).collect();
    assert_eq!(values, [2.0, 3.0]);
    for row in &difference.rows {
        assert_complete(&row.outputs[0]);
        assert_eq!(share(&row.outputs[0], "a"), 1.0);
    }
    assert_eq!(difference.changes.len(), 2, "{:?}", difference.changes);
}

/// Components have parts of their own; the estimate that they belong to has one where it moved.
#[test]
fn components() {
    let file = |mean: f64, half_width: f64| {
        let a = format!(
            r#""a": {{"mean": {mean}, "components": [
            {{"name": "r", "distribution": "rectangular", "half_width": {half_width}}},
            {{"name": "c", "distribution": "normal", "std": 0.1}}]}}"#
        );
        model(&a, "a^2", "")
    };
    let difference = compare(&file(1.0, 0.1), &file(1.0, 0.2));
    let output = only(&difference);
    assert_eq!(output.parts.len(), 2);
    assert!((share(output, "a/r") - 1.0).abs() < 1e-12);
    let difference = compare(&file(1.0, 0.1), &file(2.0, 0.2));
    let output = only(&difference);
    assert_complete(output);
    assert_eq!(output.parts.len(), 3);
    assert!(share(output, "a") > 0.3 && share(output, "a/c") == 0.0);
}

#[test]
fn nothing_changed() {
    let file = model(&inputs(&[("a", 1.0, 3.0)]), "a", "");
    let difference = compare(&file, &file);
    let output = only(&difference);
    assert!(difference.changes.is_empty());
    assert_eq!(output.expanded[0], output.expanded[1]);
    assert_eq!((output.parts[0].change, output.parts[0].share), (Some(0.0), None));
}

/// Evidence changes no number, and is named where it comes, goes or changes.
#[test]
fn changed_evidence_is_named() {
    let with = |evidence: &str| {
        let input = format!(r#""a": {{"distribution": "normal", "mean": 1, "std": 1{evidence}}}"#);
        model(&input, "a", "")
    };
    let plain = with("");
    let stated = with(r#", "evidence": {"values": [1.1, 0.9, 1.2, 0.8]}"#);
    let changed = with(r#", "evidence": {"values": [1.1, 0.9, 1.2, 0.7]}"#);
    assert!(compare(&stated, &stated).changes.is_empty());
    let said = |a, b| compare(a, b).changes.join("; ");
    assert!(
        said(&stated, &plain).starts_with("evidence of `a` removed"),
        "{}",
        said(&stated, &plain)
    );
    assert!(said(&plain, &stated).starts_with("evidence of `a` added"));
    assert!(said(&stated, &changed).starts_with("evidence of `a`: from"));
}

/// Keys of an output are named one by one, in words.
#[test]
fn changed_keys_of_an_output_are_in_words() {
    let with = |output: &str| {
        read(&format!(
            r#"{{"inputs": {{"a": {{"distribution": "normal", "mean": 1, "std": 0.1, "unit": "V"}}}},
                "equations": {{"R": "2*a"}}, "outputs": {{"R": {{"unit": "V"{output}}}}}}}"#
        ))
    };
    let limits = with(r#", "tolerance": {"lower": 99, "upper": 101}"#);
    let other = with(r#", "tolerance": {"upper": "1 kV", "risk": 0.05}, "about": "sum""#);
    assert_eq!(
        compare(&with(""), &limits).changes,
        ["output `R`: tolerance added: from 99 to 101 V"]
    );
    assert_eq!(
        compare(&limits, &other).changes,
        [
            "output `R`: tolerance changed: from 99 to 101 V; now at most 1 kV, risk 0.05",
            "output `R`: about added: \"sum\""
        ]
    );
}
