//! Which inputs of saved results are one quantity: those of one model file, name, data and row.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::process::Command;
use crate::support::command;

fn run(folder: &Path, arguments: &[&str]) -> Value {
    let mut command: Command = command();
    let all = command.current_dir(folder).arg("run").args(arguments);
    let output = all.args(["--trials", "10000", "--quiet", "--format", "json"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A later model of the difference of an output of each of two saved results.
fn difference(folder: &Path, [first, second]: [(&str, &str); 2]) -> Value {
    let input = |(file, output): (&str, &str)| {
        format!(r#"{{"distribution": "result", "file": "{file}", "output": "{output}"}}"#)
    };
    let text = format!(
        r#"{{"inputs": {{"x": {}, "z": {}}}, "equations": {{"d": "x - z"}},
            "outputs": {{"d": {{"unit": "V"}}}}}}"#,
        input(first),
        input(second)
    );
    fs::write(folder.join("difference.json"), text).unwrap();
    run(folder, &["difference.json"])
}

fn u(answer: &Value) -> f64 {
    answer["outputs"]["d"]["gum"]["standard_uncertainty"].as_f64().unwrap()
}

fn has_note(answer: &Value, code: &str, of: &str) -> bool {
    let notes = answer["warnings"].as_array().cloned().unwrap_or_default();
    notes.iter().any(|note| note["code"] == code && note["text"].as_str().unwrap().contains(of))
}

/// The u of the difference of `y` of two runs of one file, and whether a note with these words says
/// that they are apart.
fn of_two(folder: &Path, words: &str) -> (f64, bool) {
    let found = difference(folder, [("r1.json", "y"), ("r2.json", "y")]);
    (u(&found), has_note(&found, "result-inputs-differ", words))
}

/// Readings of a file that others replaced: both means have u = 0.01/sqrt(2) V = 0.007071 V (s of 2.28
/// to 2.32 in steps of 0.01 is 0.0158, over sqrt(5)), so that their difference has 0.01 V; to the
/// rounding of sums. Other readings of the same figures are no other data for all that is known, but a
/// file of other content; the same file is the same readings.
#[test]
fn readings_that_were_replaced_are_others() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = r#"{"inputs": {"r": {"unit": "V", "distribution": "readings", "file": "data.txt"}},
        "equations": {"y": "r"}, "outputs": {"y": {"unit": "V"}}}"#;
    fs::write(folder.join("m.json"), model).unwrap();
    let save = |data: &str, result: &str| {
        fs::write(folder.join("data.txt"), data).unwrap();
        run(folder, &["m.json", "--save", result]);
    };
    save("2.28\n2.29\n2.30\n2.31\n2.32\n", "r1.json");
    save("2.38\n2.39\n2.40\n2.41\n2.42\n", "r2.json");
    let (apart, told) = of_two(folder, "another estimate");
    assert!((apart / 0.01 - 1.0).abs() < 1e-9 && told, "{apart} {told}");
    // in another order: the same mean and scatter
    save("2.32\n2.31\n2.30\n2.29\n2.28\n", "r2.json");
    let (apart, told) = of_two(folder, "the same values, but from files of different content");
    assert!((apart / 0.01 - 1.0).abs() < 1e-9 && told, "{apart} {told}");
    save("2.28\n2.29\n2.30\n2.31\n2.32\n", "r2.json");
    assert_eq!(of_two(folder, ""), (0.0, false));
}

/// A noise of each row is another one in another row, and the same in the same; 0.1 V sqrt(2). An offset
/// of all rows is one quantity, also where its width follows the condition: 0.2 V - 0.1 V = 0.1 V.
#[test]
fn rows_have_their_own_values() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let save = |n: &str| {
        let model = format!(
            r#"{{"conditions": {{"f": {{"unit": "Hz", "values": [1, 2]}}}},
                "inputs": {{"n": {{"unit": "V", "distribution": "normal", "mean": 0, {n}}}}},
                "equations": {{"y": "1 [V] + n"}}, "outputs": {{"y": {{"unit": "V"}}}}}}"#
        );
        fs::write(folder.join("m.json"), model).unwrap();
        run(folder, &["m.json", "--set", "f=1", "--save", "r1.json"]);
        run(folder, &["m.json", "--set", "f=2", "--save", "r2.json"]);
        run(folder, &["m.json", "--set", "f=1", "--seed", "2", "--save", "again.json"]);
    };
    for per in ["row", "f"] {
        save(&format!(r#""std": 0.1, "per": "{per}""#));
        let (apart, told) = of_two(folder, "of different rows");
        // to the rounding of the saved numbers
        assert!((apart / 0.02_f64.sqrt() - 1.0).abs() < 1e-9 && told, "{apart} {told}");
        assert!(u(&difference(folder, [("r1.json", "y"), ("again.json", "y")])) < 1e-9);
    }
    save(r#""std": 0.1"#);
    assert_eq!(of_two(folder, ""), (0.0, false));
    save(r#""std": "0.1 [V/Hz]*f""#);
    let (apart, told) = of_two(folder, "");
    assert!((apart - 0.1).abs() < 1e-9 && !told, "{apart} {told}");
}

/// A value that the command line sets is another quantity's: 0.1 V sqrt(2). What is not set stays in
/// common, 0.05 V of an offset.
#[test]
fn values_that_are_set_are_others() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = r#"{"inputs": {"v": {"unit": "V", "distribution": "normal", "mean": 1, "std": 0.1},
        "o": {"unit": "V", "distribution": "normal", "mean": 0, "std": 0.05}},
        "equations": {"y": "v + o"}, "outputs": {"y": {"unit": "V"}}}"#;
    fs::write(folder.join("m.json"), model).unwrap();
    run(folder, &["m.json", "--save", "r1.json"]);
    run(folder, &["m.json", "--set", "v=1.2", "--save", "r2.json"]);
    let (apart, told) = of_two(folder, "`v` of `x` and `z` (with another estimate");
    assert!((apart / 0.02_f64.sqrt() - 1.0).abs() < 1e-9 && told, "{apart} {told}");
    // through a later result, which carries the inputs on
    let later = r#"{"inputs": {"p": {"distribution": "result", "file": "r2.json", "output": "y"}},
        "equations": {"y": "2*p"}, "outputs": {"y": {"unit": "V"}}}"#;
    fs::write(folder.join("later.json"), later).unwrap();
    run(folder, &["later.json", "--save", "later.result.json"]);
    let found = u(&difference(folder, [("r1.json", "y"), ("later.result.json", "y")]));
    // v + o - 2 v' - 2 o
    let by_hand = (5.0 * 0.01 + 0.0025_f64).sqrt();
    assert!((found / by_hand - 1.0).abs() < 1e-9, "{found} {by_hand}");
    let found = u(&difference(folder, [("r2.json", "y"), ("later.result.json", "y")]));
    assert!((found / 0.0125_f64.sqrt() - 1.0).abs() < 1e-9, "{found}");
}

/// A line through points of a file: with points whose y scatter otherwise, its value at 2 is another
/// quantity. By hand, of the four points (1, 2, 3, 4) at 2 with u = 0.1 V each: u^2 = 0.01 V^2 (1/4 +
/// 0.25/5) = 0.003 V^2, twice.
#[test]
fn fits_of_other_points_are_others() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = r#"{"fits": {"line": {"form": "polynomial", "degree": 1,
          "x": {"file": "points.csv", "column": "x"},
          "y": {"unit": "V", "file": "points.csv", "column": "y", "standard_uncertainty": 0.1}}},
        "equations": {"y": "line(2)"}, "outputs": {"y": {"unit": "V"}}}"#;
    fs::write(folder.join("m.json"), model).unwrap();
    let save = |points: &str, result: &str| {
        fs::write(folder.join("points.csv"), format!("x,y\n{points}\n")).unwrap();
        run(folder, &["m.json", "--save", result]);
    };
    save("1,1.1\n2,2.0\n3,3.0\n4,4.1", "r1.json");
    save("1,1.0\n2,2.1\n3,3.1\n4,4.0", "r2.json");
    let (apart, told) = of_two(folder, "");
    assert!((apart / 0.006_f64.sqrt() - 1.0).abs() < 1e-9 && told, "{apart} {told}");
    save("1,1.1\n2,2.0\n3,3.0\n4,4.1", "r2.json");
    let (apart, told) = of_two(folder, "");
    // what the cancellation of the two coefficients leaves
    assert!(apart < 1e-8 && !told, "{apart} {told}");
}

/// Results as older versions saved them say no more than figures: the same inputs stay in common, and
/// inputs of other figures are others.
#[test]
fn results_of_older_versions_are_told_apart_by_their_figures() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = r#"{"conditions": {"f": {"unit": "Hz", "values": [1, 2]}},
        "inputs": {"n": {"unit": "V", "distribution": "normal", "mean": 0, "std": 0.1, "per": "row"}},
        "equations": {"y": "1 [V] + n"}, "outputs": {"y": {"unit": "V"}}}"#;
    fs::write(folder.join("m.json"), model).unwrap();
    let older = |name: &str| {
        let path = folder.join(name);
        let text = fs::read_to_string(&path).unwrap();
        let mut content: serde_json::Map<String, Value> = serde_json::from_str(&text).unwrap();
        content.remove("sha256");
        content.remove("sha256_of_parts");
        assert!(content["inputs"][0].as_object_mut().unwrap().remove("row").is_some());
        fs::write(path, serde_json::to_string(&content).unwrap()).unwrap();
    };
    run(folder, &["m.json", "--set", "f=1", "--save", "r1.json"]);
    run(folder, &["m.json", "--set", "f=1", "--seed", "2", "--save", "r2.json"]);
    older("r1.json");
    let (apart, told) = of_two(folder, "older version");
    assert!((apart / 0.02_f64.sqrt() - 1.0).abs() < 1e-9 && told, "{apart} {told}");
    older("r2.json");
    let (apart, told) = of_two(folder, "");
    assert!(apart < 1e-9 && !told, "{apart} {told}");
}

/// Two results of one calibration, correlated 0.9, that go through two models with a noise of 0.01 V
/// each: u^2 = 2 (0.1 V)^2 (1 - 0.9) + 2 (0.01 V)^2 = 0.0022 V^2. So it is through one more model, and
/// of outputs without sensitivity coefficients, whose correlation is that of the trials: p = a^2 and
/// q = b^2 at 0 have r = 0.81 and a variance of 2 s^4 each. There the tolerance is 5 standard errors
/// of a coefficient of 100000 trials of heavy products, below 0.05 of r, 0.13 in the difference.
#[test]
fn correlated_results_stay_correlated_through_two_models() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let through = |name: &str, file: &str, output: &str| {
        let model = format!(
            r#"{{"inputs": {{"c": {{"distribution": "result", "file": "{file}", "output": "{output}"}},
                "n": {{"unit": "V", "distribution": "normal", "mean": 0, "std": 0.01}}}},
                "equations": {{"m": "c + n"}}, "outputs": {{"m": {{"unit": "V"}}}}}}"#
        );
        fs::write(folder.join(format!("{name}.json")), model).unwrap();
        run(folder, &[&format!("{name}.json"), "--save", &format!("{name}.result.json")]);
    };
    let calibration = |equations: &str, mean: [f64; 2]| {
        let input = |mean: f64| {
            format!(r#"{{"unit": "V", "distribution": "normal", "mean": {mean}, "std": 0.1}}"#)
        };
        let model = format!(
            r#"{{"inputs": {{"a": {}, "b": {}}}, "correlations": [["a", "b", 0.9]],
                "equations": {{{equations}}},
                "outputs": {{"p": {{"unit": "V"}}, "q": {{"unit": "V"}}}}}}"#,
            input(mean[0]),
            input(mean[1])
        );
        fs::write(folder.join("cal.json"), model).unwrap();
        run(folder, &["cal.json", "--save", "cal.result.json"]);
        through("m1", "cal.result.json", "p");
        through("m2", "cal.result.json", "q");
    };
    calibration(r#""p": "a", "q": "b""#, [1.0, 2.0]);
    let later = [("m1.result.json", "m"), ("m2.result.json", "m")];
    let found = difference(folder, later);
    assert!((u(&found) / 0.0022_f64.sqrt() - 1.0).abs() < 1e-9, "{found}");
    assert!(has_note(&found, "result-correlation", "`x` and `z`"));
    through("m3", "m1.result.json", "m");
    let found = u(&difference(folder, [("m3.result.json", "m"), ("m2.result.json", "m")]));
    assert!((found / 0.0023_f64.sqrt() - 1.0).abs() < 1e-9, "{found}");
    let found = u(&difference(folder, [("cal.result.json", "p"), ("m2.result.json", "m")]));
    assert!((found / 0.0021_f64.sqrt() - 1.0).abs() < 1e-9, "{found}");

    calibration(r#""p": "a^2/(1 [V])", "q": "b^2/(1 [V])""#, [0.0, 0.0]);
    let found = u(&difference(folder, later));
    let by_hand = (2.0 * 2e-4 * (1.0 - 0.81) + 2e-4_f64).sqrt();
    assert!((found / by_hand - 1.0).abs() < 0.13, "{found} {by_hand}");
}

/// y = a^2 at a = 0.2 V with u = 0.1 V: the law of propagation has 2 a u = 0.04 V, the trials
/// sqrt(0.0016 + 2e-4) V = 0.0424 V. What takes that result is told of its model and not of degrees of
/// freedom, of which there are none.
#[test]
fn a_result_of_a_model_that_is_not_linear_has_no_few_degrees_of_freedom() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = r#"{"inputs": {"a": {"unit": "V", "distribution": "normal", "mean": 0.2, "std": 0.1}},
        "equations": {"y": "a^2/(1 [V])"}, "outputs": {"y": {"unit": "V"}}}"#;
    fs::write(folder.join("m.json"), model).unwrap();
    run(folder, &["m.json", "--save", "r.json"]);
    let later = r#"{"inputs": {"x": {"distribution": "result", "file": "r.json", "output": "y"}},
        "equations": {"d": "2*x"}, "outputs": {"d": {"unit": "V"}}}"#;
    fs::write(folder.join("later.json"), later).unwrap();
    let found = run(folder, &["later.json"]);
    let notes = found["warnings"].as_array().unwrap();
    assert!(notes.iter().all(|note| note["code"] != "few-dof"), "{notes:?}");
    assert!(has_note(
        &found,
        "non-linear",
        "the trials of saved results have another standard deviation"
    ));
    let by_trials = found["outputs"]["d"]["monte_carlo"]["standard_uncertainty"].as_f64().unwrap();
    // 10000 trials of the result: 5 standard errors of a width, 0.0225 each for a kurtosis near 3.8
    assert!((by_trials / (2.0 * 0.0018_f64.sqrt()) - 1.0).abs() < 0.06, "{by_trials}");
}

/// A result of three readings, with 2 degrees of freedom, and one of twice their mean: of the difference
/// the mean itself is left, u = 0.152 753 V/3^(1/2) = 0.088 192 V (s of 1.0, 1.1 and 1.3 V) with 2 degrees
/// of freedom. The law of propagation does it; trials have no correlation coefficient to draw with, and
/// say so. Coefficients that contradict each other stay a mistake.
#[test]
fn results_without_a_variance_are_correlated_by_propagation() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = r#"{"inputs": {"r": {"unit": "V", "distribution": "readings", "values": [1.0, 1.1, 1.3]}},
        "equations": {"a": "r", "b": "2*r"}, "outputs": {"a": {"unit": "V"}, "b": {"unit": "V"}}}"#;
    fs::write(folder.join("m.json"), model).unwrap();
    run(folder, &["m.json", "--save", "r1.json"]);
    run(folder, &["m.json", "--save", "r2.json", "--seed", "2"]);
    let input = |file: &str, output: &str| {
        format!(r#"{{"distribution": "result", "file": "{file}", "output": "{output}"}}"#)
    };
    let evaluated = |text: &str, trials: &str| {
        fs::write(folder.join("n.json"), text).unwrap();
        let mut command: Command = command();
        let all = ["run", "n.json", "--trials", trials, "--quiet", "--format", "json"];
        command.current_dir(folder).args(all).output().unwrap()
    };
    let text = format!(
        r#"{{"inputs": {{"x": {}, "z": {}}}, "equations": {{"d": "z - x"}},
            "outputs": {{"d": {{"unit": "V"}}}}}}"#,
        input("r1.json", "a"),
        input("r2.json", "b")
    );
    let output = evaluated(&text, "0");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!((u(&found) / 0.088_191_710_368_819 - 1.0).abs() < 1e-9, "{found}");
    let dof = found["outputs"]["d"]["gum"]["dof"].as_f64().unwrap();
    assert!((dof - 2.0).abs() < 1e-9, "{found}");
    let output = evaluated(&text, "10000");
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("--trials 0") && said.contains("in one model"), "{said}");
    let readings = r#"{"unit": "V", "distribution": "readings", "values": [1.0, 1.1, 1.3]}"#;
    for (c, code) in [(0.9, 0), (-0.9, 2)] {
        let text = format!(
            r#"{{"inputs": {{"p": {readings}, "q": {readings}, "r": {readings}}},
                "correlations": [["p", "q", 0.9], ["q", "r", 0.9], ["p", "r", {c}]],
                "equations": {{"d": "p + q + r"}}, "outputs": {{"d": {{"unit": "V"}}}}}}"#
        );
        assert_eq!(evaluated(&text, "0").status.code(), Some(code), "{c}");
        assert_eq!(evaluated(&text, "1000").status.code(), Some(2), "{c}");
    }
}

/// One value of a certificate, 5 V with u = 0.01 V, through two models that call it otherwise, take it in
/// other units and add 0.001 V each: what is left of the difference is 0.001 V sqrt(2), of independent
/// values 0.01 V sqrt(2). Another value of the certificate, another certificate and a value that was
/// replaced are others.
#[test]
fn a_value_of_a_certificate_is_one_quantity_in_all_models() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let value = |id: &str, more: &str| {
        format!(
            r#"<dcc:quantity id="{id}"><si:real><si:value>5</si:value><si:unit>\volt</si:unit>
<si:expandedUnc><si:uncertainty>0.02</si:uncertainty><si:coverageFactor>2</si:coverageFactor>
<si:coverageProbability>0.9545</si:coverageProbability></si:expandedUnc></si:real>{more}</dcc:quantity>"#
        )
    };
    let certificate = |name: &str, more: &str| {
        let text = format!(
            r#"<?xml version="1.0"?>
<dcc:digitalCalibrationCertificate xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si"
  schemaVersion="3.2.1"><dcc:measurementResults><dcc:measurementResult><dcc:results><dcc:result>
<dcc:data><dcc:list>{}{}</dcc:list></dcc:data></dcc:result></dcc:results>
</dcc:measurementResult></dcc:measurementResults>{more}</dcc:digitalCalibrationCertificate>"#,
            value("v", ""),
            value("w", "")
        );
        fs::write(folder.join(name), text).unwrap();
    };
    certificate("ref.xml", "");
    certificate("other.xml", "<!-- of another day -->");
    let save = |result: &str, (name, file, id, unit): (&str, &str, &str, &str), more: &[&str]| {
        let model = format!(
            r#"{{"inputs": {{"{name}": {{"distribution": "dcc", "file": "{file}", "id": "{id}", "unit": "{unit}"}},
                "n": {{"unit": "V", "distribution": "normal", "mean": 0, "std": 0.001}}}},
                "equations": {{"y": "{name} + n"}}, "outputs": {{"y": {{"unit": "V"}}}}}}"#
        );
        fs::write(folder.join("m.json"), model).unwrap();
        let mut all = vec!["m.json", "--save", result];
        all.extend(more);
        run(folder, &all);
    };
    save("r1.json", ("v", "ref.xml", "v", "V"), &[]);
    save("r2.json", ("reference", "ref.xml", "v", "mV"), &[]);
    let difference = || difference(folder, [("r1.json", "y"), ("r2.json", "y")]);
    let found = difference();
    assert!((u(&found) / 2e-6_f64.sqrt() - 1.0).abs() < 1e-6, "{found}");
    assert!(has_note(&found, "result-correlation", "`x` and `z` (0.990)"), "{found}");
    let apart = 2.02e-4_f64.sqrt();
    for (of, more) in [
        (("w", "ref.xml", "w", "V"), &[][..]),
        (("v", "other.xml", "v", "V"), &[]),
        (("reference", "ref.xml", "v", "mV"), &["--set", "reference=5001"]),
    ] {
        save("r2.json", of, more);
        let found = difference();
        assert!((u(&found) / apart - 1.0).abs() < 1e-9, "{of:?}: {found}");
    }
    // beside a result that it went into, it counts as another one, and is told by its place
    let model = r#"{"inputs": {"x": {"distribution": "result", "file": "r1.json", "output": "y"},
        "again": {"distribution": "dcc", "file": "ref.xml", "id": "v"}},
        "equations": {"d": "x - again"}, "outputs": {"d": {"unit": "V"}}}"#;
    fs::write(folder.join("n.json"), model).unwrap();
    let found = run(folder, &["n.json", "--save", "r3.json"]);
    assert!((u(&found) / 2.01e-4_f64.sqrt() - 1.0).abs() < 1e-9, "{found}");
    assert!(has_note(&found, "counted-twice", "`again` is a value of a certificate"), "{found}");
    // as it was evaluated, so it is saved
    let text = fs::read_to_string(folder.join("r3.json")).unwrap();
    let saved: Value = serde_json::from_str(&text).unwrap();
    let inputs = saved["inputs"].as_array().unwrap();
    assert_eq!(inputs.len(), 3, "{inputs:?}");
    let contribution = |(input, c): (&Value, &Value)| {
        (input["standard_uncertainty"].as_f64().unwrap() * c.as_f64().unwrap()).powi(2)
    };
    let coefficients = saved["outputs"]["d"]["sensitivities"].as_array().unwrap();
    let variance: f64 = inputs.iter().zip(coefficients).map(contribution).sum();
    assert!((variance / 2.01e-4 - 1.0).abs() < 1e-9, "{variance}");
}

/// p = a + b and q = a^3 at 0 with u = 0.1 V of both have a covariance of 3 u^4 = 3e-4 V^2, and q has no
/// sensitivity coefficients; its variance is 15 u^6 = 1.5e-5 V^2. Through a model each, with 1e-4 V of
/// noise: u^2(p - 20 q) = 0.02 + 400 15e-6 - 40 3e-4 = 0.014 V^2 and 4e-6 V^2 of noise; of independent
/// ones 0.026 V^2. The coefficient is that of 10000 trials of heavy products: 2 % in u, five times.
#[test]
fn a_result_without_sensitivities_stays_correlated_with_its_siblings() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let normal = |std: &str| {
        format!(r#"{{"unit": "V", "distribution": "normal", "mean": 0, "std": {std}}}"#)
    };
    let model = format!(
        r#"{{"inputs": {{"a": {0}, "b": {0}}}, "equations": {{"p": "a + b", "q": "a^3/(1 [V^2])"}},
            "outputs": {{"p": {{"unit": "V"}}, "q": {{"unit": "V"}}}}}}"#,
        normal("0.1")
    );
    fs::write(folder.join("cal.json"), model).unwrap();
    run(folder, &["cal.json", "--save", "cal.result.json"]);
    for (name, output) in [("m1", "p"), ("m2", "20*q")] {
        let own = output.trim_start_matches("20*");
        let model = format!(
            r#"{{"inputs": {{"{own}": {{"distribution": "result", "file": "cal.result.json", "output": "{own}"}},
                "n": {}}}, "equations": {{"m": "{output} + n"}}, "outputs": {{"m": {{"unit": "V"}}}}}}"#,
            normal("0.0001")
        );
        fs::write(folder.join(format!("{name}.json")), model).unwrap();
        run(folder, &[&format!("{name}.json"), "--save", &format!("{name}.result.json")]);
    }
    let found = difference(folder, [("m1.result.json", "m"), ("m2.result.json", "m")]);
    assert!((u(&found) / 0.014_f64.sqrt() - 1.0).abs() < 0.1, "{found}");
    assert!(has_note(&found, "result-correlation", "`x` and `z`"), "{found}");
    // one of them directly
    let found = difference(folder, [("cal.result.json", "p"), ("m2.result.json", "m")]);
    assert!((u(&found) / 0.014_f64.sqrt() - 1.0).abs() < 0.1, "{found}");
}
