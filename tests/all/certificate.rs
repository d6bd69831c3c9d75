//! `gumption certificate`: what is stated, in every format, and how rows vary together.

use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use calamine::{Data, Reader, Xlsx};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::support::{gumption, output, root};

const WORKED_DAY: &str = "models/certificates/three_axis_accelerometer.json";

/// A folder with these files.
pub(crate) fn folder(files: &[(&str, Value)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in files {
        fs::write(folder.path().join(name), content.to_string()).expect("a file");
    }
    folder
}

pub(crate) fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().expect("a path").to_owned()
}

/// The certificate of these files, whose first is the certificate file.
fn answer(files: &[(&str, Value)], options: &[&str]) -> Value {
    let folder = folder(files);
    let name = path(folder.path(), files[0].0);
    let said = output(&[&["certificate", &name, "--format", "json", "--quiet"], options].concat());
    serde_json::from_str(&said).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Standard uncertainty of a difference from two rows and their coefficient.
fn of_difference(answer: &Value, i: usize, j: usize) -> f64 {
    let u = |row: usize| number(&answer["rows"][row]["standard_uncertainty"]);
    let r = number(&answer["correlations"][i][j]);
    (u(i) * u(i) + u(j) * u(j) - 2.0 * r * u(i) * u(j)).sqrt()
}

/// Standard uncertainty by a run of a model of its own.
fn of_run(model: &Value) -> f64 {
    let folder = folder(&[("m.json", model.clone())]);
    let name = path(folder.path(), "m.json");
    let said = output(&["run", &name, "--trials", "0", "--format", "json", "--quiet"]);
    let answer: Value = serde_json::from_str(&said).expect("JSON");
    let (_, output) = answer["outputs"].as_object().and_then(|all| all.iter().next()).expect("one");
    number(&output["gum"]["standard_uncertainty"])
}

fn normal(mean: f64, std: f64) -> Value {
    json!({"distribution": "normal", "mean": mean, "std": std})
}

/// The difference of two rows has the uncertainty that a model of the difference gives: both are
/// the law of propagation, so that they agree but for rounding of doubles.
#[test]
fn the_difference_of_two_rows_has_its_right_uncertainty() {
    let inputs = json!({"a": normal(2.0, 0.01), "b": normal(0.5, 0.02), "x": normal(1.0, 0.005),
        "c": normal(0.0, 0.004)});
    let model = json!({"inputs": inputs, "correlations": [["b", "c", 0.6]],
        "equations": {"y": "a*x^2 + b + c"}, "outputs": {"y": {}}});
    let rows = json!([{"model": "m.json", "output": "y"},
        {"model": "m.json", "output": "y", "set": {"x": 3}}]);
    let certificate = |more: Value| {
        let mut file = json!({"rows": rows, "monte_carlo": {"trials": 0}});
        for (key, value) in more.as_object().expect("an object") {
            file[key] = value.clone();
        }
        answer(&[("c.json", file), ("m.json", model.clone())], &[])
    };
    // one deviation of x in both rows
    let shared = json!({"inputs": {"a": normal(2.0, 0.01), "e": normal(0.0, 0.005)},
        "equations": {"d": "a*(3 + e)^2 - a*(1 + e)^2"}, "outputs": {"d": {}}});
    let found = of_difference(&certificate(json!({})), 0, 1);
    assert!((found / of_run(&shared) - 1.0).abs() < 1e-9, "{found}");
    // deviations of their own
    let own = json!({"inputs": {"a": normal(2.0, 0.01), "x_1": normal(1.0, 0.005),
        "x_2": normal(3.0, 0.005)}, "equations": {"d": "a*x_2^2 - a*x_1^2"}, "outputs": {"d": {}}});
    let found = of_difference(&certificate(json!({"separate_inputs": ["x"]})), 0, 1);
    assert!((found / of_run(&own) - 1.0).abs() < 1e-9, "{found}");
    // b of a row of its own stays correlated with the c that both rows have: d = ... + b_2 - b_1,
    // where u(d)^2 has 2 u(b)^2 more, and the terms of b and c cancel
    let found = of_difference(&certificate(json!({"separate_inputs": ["b"]})), 0, 1);
    let expected = (of_run(&shared).powi(2) + 2.0 * 0.02_f64.powi(2)).sqrt();
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// The same for a typed model, its outputs, and its rows of conditions.
#[test]
fn rows_of_a_typed_model_share_its_inputs() {
    let tolerance = |mean: Value| {
        json!({"unit": "deg", "distribution": "rectangular",
        "mean": mean, "half_width": 0.1})
    };
    let a_ref = json!({"unit": "m/s^2", "distribution": "normal", "mean": 10, "std": 0.01});
    let model = |per: &str| {
        let mut tilt = tolerance(json!("t"));
        if !per.is_empty() {
            tilt["per"] = json!(per);
        }
        json!({"model": "inclined-plane",
            "inputs": {"a_ref": a_ref, "tilt": tilt, "rotation": tolerance(json!(30))},
            "conditions": {"t": {"unit": "deg", "values": [15, 75]}},
            "outputs": {"a_x": {"unit": "m/s^2"}, "a_z": {"unit": "m/s^2"}}})
    };
    let file = json!({"monte_carlo": {"trials": 0}, "rows": [
        {"model": "m.json", "output": "a_x"}, {"model": "m.json", "output": "a_z"}]});
    // rows: a_x at 15 and 75 deg, a_z at 15 and 75 deg
    let of = |per: &str| answer(&[("c.json", file.clone()), ("m.json", model(per))], &[]);
    let direct = |tilts: &[(&str, Value)], equation: &str| {
        let mut inputs = json!({"a_ref": a_ref, "rotation": tolerance(json!(30))});
        for (name, tilt) in tilts {
            inputs[*name] = tilt.clone();
        }
        of_run(&json!({"inputs": inputs, "equations": {"d": equation},
            "outputs": {"d": {"unit": "m/s^2"}}}))
    };
    let zero = tolerance(json!(0));
    let shared =
        direct(&[("e", zero)], "a_ref*cos(rotation)*(sin(75*pi/180 + e) - sin(15*pi/180 + e))");
    let found = of_difference(&of(""), 0, 1);
    assert!((found / shared - 1.0).abs() < 1e-9, "{found} {shared}");
    let planes = [("p", tolerance(json!(15))), ("q", tolerance(json!(75)))];
    let own = direct(&planes, "a_ref*cos(rotation)*(sin(q) - sin(p))");
    let found = of_difference(&of("row"), 0, 1);
    assert!((found / own - 1.0).abs() < 1e-9, "{found} {own}");
    // two outputs of one row have its tilt in common even then
    let outputs = direct(&planes, "a_ref*(sin(p)*cos(rotation) - cos(p))");
    let found = of_difference(&of("row"), 0, 2);
    assert!((found / outputs - 1.0).abs() < 1e-9, "{found} {outputs}");
}

/// Inputs of the same name in two model files are two quantities unless the certificate says
/// otherwise.
#[test]
fn inputs_of_two_files_are_shared_only_where_the_certificate_says_so() {
    let model = |std: f64| {
        json!({"inputs": {"x": normal(1.0, std), "z": normal(0.0, std)},
        "equations": {"y": "x + z"}, "outputs": {"y": {}}})
    };
    let rows = json!([{"model": "m.json", "output": "y"}, {"model": "n.json", "output": "y"}]);
    let of = |file: Value| {
        answer(&[("c.json", file), ("m.json", model(0.1)), ("n.json", model(0.2))], &[])
    };
    let apart = of(json!({"rows": rows, "monte_carlo": {"trials": 0}}));
    assert_eq!(apart["correlations"], json!([[1.0, 0.0], [0.0, 1.0]]));
    let together = of(json!({"rows": rows, "shared_inputs": "x", "monte_carlo": {"trials": 0}}));
    // x is half of each variance
    assert!((number(&together["correlations"][0][1]) - 0.5).abs() < 1e-12);
}

/// A certificate takes the coverage of its models where it states none, and the command line beats
/// both.
#[test]
fn the_coverage_of_the_models() {
    let model = |coverage: Value| {
        let mut model = json!({"inputs": {"n": normal(10.0, 0.1)}, "equations": {"a": "n"},
            "outputs": {"a": {}}});
        if let (Some(model), Value::Object(coverage)) = (model.as_object_mut(), coverage) {
            model.extend(coverage);
        }
        model
    };
    let rows = json!([{"model": "m.json", "output": "a"}, {"model": "n.json", "output": "a"}]);
    let factors = |own: Value, more: &[&str]| {
        let mut file = json!({"rows": rows});
        if let (Some(file), Value::Object(own)) = (file.as_object_mut(), own) {
            file.extend(own);
        }
        let models = [model(json!({"coverage_probability": 0.95})), model(json!({}))];
        let [m, n] = models;
        let arguments = [&["--trials", "0"], more].concat();
        let found = answer(&[("c.json", file), ("m.json", m), ("n.json", n)], &arguments);
        [0, 1].map(|row| found["rows"][row]["stated"]["coverage_factor"].to_string())
    };
    let quoted = |factors: [&str; 2]| factors.map(|factor| format!("\"{factor}\""));
    assert_eq!(factors(json!({}), &[]), quoted(["1.96", "2.00"]));
    assert_eq!(factors(json!({"coverage_factor": 3}), &[]), quoted(["3.00", "3.00"]));
    assert_eq!(factors(json!({"coverage_factor": 3}), &["--k", "2"]), quoted(["2.00", "2.00"]));
}

/// Each basis with its factor: a rectangular distribution has k = 0.9545 sqrt(3) = 1.653 at 95.45 %
/// (EA-4/02, S9.14 has 1.65 at 95 %), a t distribution with 4 degrees of freedom 2.87 (EA-4/02,
/// table E.1).
#[test]
fn the_statement_follows_the_distribution() {
    let model = json!({"inputs": {
            "n": normal(10.0, 0.1),
            "r": {"distribution": "rectangular", "mean": 5, "half_width": 0.3},
            "t": {"distribution": "normal", "mean": 3, "std": 0.1, "dof": 4}},
        "equations": {"a": "n", "b": "r", "c": "t"}, "outputs": {"a": {}, "b": {}, "c": {}}});
    let rows = json!([{"model": "m.json", "output": "a"}, {"model": "m.json", "output": "b"},
        {"model": "m.json", "output": "c"}]);
    let file = json!({"rows": rows, "language": ["en", "de"]});
    let files = [("c.json", file), ("m.json", model)];
    let found = answer(&files, &[]);
    let row = |place: usize| &found["rows"][place];
    let basis = |place: usize| row(place)["basis"].as_str().expect("a text").to_owned();
    assert_eq!([basis(0), basis(1), basis(2)], ["normal", "monte-carlo", "t"]);
    assert_eq!(row(0)["stated"]["coverage_factor"], "2.00");
    assert_eq!(row(0)["stated"]["expanded_uncertainty"], "0.20");
    assert_eq!(row(2)["stated"]["coverage_factor"], "2.87");
    assert_eq!(row(2)["dof"], 4.0);
    // all intervals of a rectangle are as short; the symmetric one of a million trials has ends with
    // a standard error of 0.6 sqrt(0.02275 0.97725 / 1e6) = 9e-5, of which 6 are allowed
    let (k, u) = (number(&row(1)["coverage_factor"]), number(&row(1)["expanded_uncertainty"]));
    assert!((u - 0.9545 * 0.3).abs() < 6e-4 && (k - 1.6532).abs() < 4e-3, "{u} {k}");
    let [low, high] = [0, 1].map(|end| number(&row(1)["interval"][end]));
    assert!((low - 5.0 + 0.9545 * 0.3).abs() < 6e-4, "{low}");
    assert!((high - 5.0 - 0.9545 * 0.3).abs() < 6e-4, "{high}");
    let value = number(&row(1)["value"]);
    assert!(value - u <= low + 1e-12 && high <= value + u + 1e-12);
    let said = |language: &str| found["statements"][language].to_string();
    for words in ["k = 2.00", "approximately 95 %", "Row 1: ", "shortest", "ν_eff"] {
        assert!(said("en").contains(words), "{words}: {}", said("en"));
    }
    for words in ["Erweiterungsfaktor k = 2.00", "annähernd 95 %", "Zeile 2: ", "kürzeste"] {
        assert!(said("de").contains(words), "{words}: {}", said("de"));
    }
    // without trials nothing is known but the law of propagation
    let found = answer(&files, &["--trials", "0"]);
    assert_eq!(found["rows"][1]["basis"], "normal");
    // a factor that is kept states no probability where it has none
    let mut fixed = files.clone();
    fixed[0].1["coverage_factor"] = json!(2);
    fixed[0].1["coverage_factor_fixed"] = json!(true);
    let found = answer(&fixed, &["--trials", "0"]);
    assert_eq!(found["rows"][2]["basis"], "fixed-factor");
    assert_eq!(found["rows"][2]["coverage_probability"], Value::Null);
    assert_eq!(found["rows"][0]["coverage_probability"], 0.9545);
}

/// Values go to the place of the rounded uncertainty: 9.96, 99.6, 999.9, left of the point, 0, and the
/// 5 % of EA-4/02.
/// A rectangular contribution of 92 % of the variance: U prints alike to one digit with k = 1.75 and
/// with k = 2, but the result is not normally distributed.
#[test]
fn one_digit_makes_no_rectangle_normal() {
    let model = json!({"inputs": {"a": normal(100.013, 0.002),
            "d": {"distribution": "rectangular", "mean": 0, "half_width": 0.012}},
        "equations": {"y": "a + d"}, "outputs": {"y": {}}});
    let certificate = json!({"title": "t", "digits": 1, "rounding": "ea",
        "rows": [{"model": "m.json", "output": "y"}]});
    let found = answer(&[("c.json", certificate), ("m.json", model)], &[]);
    let row = &found["rows"][0];
    assert_eq!(row["basis"], "monte-carlo");
    // by inversion of the characteristic functions; the trials are not asked
    let k = number(&row["coverage_factor"]);
    assert!((k - 1.75).abs() < 0.02, "{k}");
}

/// A coverage factor belongs to a law; that the result has it is said nowhere, in no language: not of one
/// rectangle of which nothing was looked at, and not of a sum of two, which is a triangle, though U prints
/// alike to one digit.
#[test]
fn no_law_is_stated_that_a_result_has_not() {
    let rectangle = json!({"distribution": "rectangular", "mean": 5, "half_width": 0.3});
    let one = json!({"inputs": {"r": rectangle}, "equations": {"b": "r"}, "outputs": {"b": {}}});
    let two = json!({"inputs": {"r": rectangle, "s": rectangle}, "equations": {"b": "r + s"},
        "outputs": {"b": {}}});
    for (model, digits, more) in [(one, 2, &["--trials", "0"][..]), (two, 1, &[])] {
        let certificate = json!({"title": "t", "digits": digits, "coverage_factor": 2,
            "language": ["en", "de", "fr", "it"], "rows": [{"model": "m.json", "output": "b"}]});
        let files = [("c.json", certificate), ("m.json", model)];
        let found = answer(&files, more);
        assert_eq!(found["rows"][0]["basis"], "normal");
        for (language, conditional, claims) in [
            ("en", "for a normal distribution corresponds", ["is normally", "not normally"]),
            ("de", "bei einer Normalverteilung", ["ist normalverteilt", "nicht normalverteilt"]),
            ("fr", "pour une loi normale", ["suit une loi", "suit pas une loi"]),
            ("it", "per una distribuzione normale", ["ha distribuzione", "non ha distribuzione"]),
        ] {
            let said = found["statements"][language].to_string();
            assert!(said.contains(conditional), "{said}");
            assert!(!claims.iter().any(|claim| said.contains(claim)), "{said}");
        }
    }
}

/// A product whose trials refute clause 8 at three digits, with U to one digit: its interval has the digits
/// of theirs, and the digital certificate names no law that they contradict.
#[test]
fn the_digital_certificate_names_no_law_that_trials_contradict() {
    for (digits, is_named) in [(1, true), (3, false)] {
        let model = json!({"inputs": {"a": normal(10.0, 0.1), "b": normal(10.0, 0.1)},
            "equations": {"y": "a*b"}, "outputs": {"y": {}},
            "monte_carlo": {"trials": 1_000_000, "digits": digits}});
        let mut file = small()[0].1.clone();
        file["digits"] = json!(1);
        file["rows"] = json!([{"model": "m.json", "output": "y"}]);
        if let Some(file) = file.as_object_mut() {
            file.remove("monte_carlo");
        }
        let folder = folder(&[("c.json", file), ("m.json", model)]);
        let name = path(folder.path(), "c.json");
        let dcc = output(&["certificate", &name, "--quiet", "--format", "dcc"]);
        assert!(dcc.contains("<si:coverageFactorXMLList>2.00</si:coverageFactorXMLList>"), "{dcc}");
        assert_eq!(dcc.contains("<si:distributionXMLList>normal<"), is_named, "{dcc}");
        assert_eq!(dcc.contains("<si:distributionXMLList>"), is_named, "{dcc}");
    }
}

#[test]
fn values_are_rounded_to_the_place_of_the_uncertainty() {
    let of = |value: f64, expanded: f64, rule: &str, digits: u64| {
        let x = match expanded {
            0.0 => json!({"distribution": "constant", "value": value}),
            _ => json!({"distribution": "normal", "mean": value, "expanded": expanded, "k": 2}),
        };
        let model = json!({"inputs": {"x": x}, "equations": {"y": "x"}, "outputs": {"y": {}}});
        let file = json!({"rounding": rule, "digits": digits, "monte_carlo": {"trials": 0},
            "rows": [{"model": "m.json", "output": "y"}]});
        let found = answer(&[("c.json", file), ("m.json", model)], &[]);
        let stated = found["rows"][0]["stated"].clone();
        [stated["value"].clone(), stated["expanded_uncertainty"].clone()]
            .map(|text| text.as_str().expect("a text").to_owned())
    };
    let cases = [
        (10.0576, 0.0273, "nearest", 2, "10.058", "0.027"),
        (123.456, 9.96, "nearest", 2, "123", "10"),
        (1234.5, 99.6, "nearest", 2, "1230", "100"),
        (123_456.0, 999.9, "nearest", 2, "123500", "1000"),
        (56_789.0, 1234.0, "nearest", 2, "56800", "1200"),
        (56_789.0, 1234.0, "up", 2, "56800", "1300"),
        (1.2345, 0.349, "nearest", 1, "1.2", "0.3"),
        (1.2345, 0.349, "ea", 1, "1.2", "0.4"),
        (1.2345, 0.52, "ea", 1, "1.2", "0.5"),
        (-0.004, 0.12, "up", 2, "0.00", "0.12"),
        (1.5, 0.0, "nearest", 2, "1.5", "0"),
    ];
    for (value, expanded, rule, digits, y, u) in cases {
        assert_eq!(of(value, expanded, rule, digits), [y, u], "{value} {expanded} {rule}");
    }
}

#[test]
fn uncertainties_below_the_capability_are_warned_of_or_raised() {
    let model = json!({"inputs": {"x": normal(10.0, 0.1)}, "equations": {"y": "x"},
        "outputs": {"y": {"unit": "1", "cmc": 0.15}}});
    let rows = json!([
        {"model": "m.json", "output": "y"},
        {"model": "m.json", "output": "y", "cmc": "2.04 % of reading"},
        {"model": "m.json", "output": "y", "cmc": 0.504, "cmc_floor": true}]);
    let file = json!({"rows": rows, "monte_carlo": {"trials": 0}});
    let files = [("c.json", file), ("m.json", model)];
    let found = answer(&files, &[]);
    let row = |place: usize| &found["rows"][place];
    assert_eq!(row(0)["limit"], json!({"cmc": 0.15, "below": false, "raised": false}));
    assert_eq!(row(1)["limit"]["below"], true);
    assert_eq!(row(1)["stated"]["expanded_uncertainty"], "0.20");
    assert_eq!(row(2)["limit"]["raised"], true);
    // 0.50 would be below the capability of 0.504
    assert_eq!(row(2)["stated"]["expanded_uncertainty"], "0.51");
    let codes: Vec<&str> = found["warnings"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|warning| warning["code"].as_str())
        .collect();
    assert_eq!(codes, ["below-cmc", "raised-to-cmc"]);
    assert!(
        found["statements"]["en"].to_string().contains("Row 3: The evaluated expanded uncertainty")
    );
    let folder = folder(&files);
    let said = gumption().args(["certificate", &path(folder.path(), "c.json")]).assert().success();
    let notes = String::from_utf8(said.get_output().stderr.clone()).expect("UTF-8");
    assert!(notes.contains("row 2: U = 0.20 is below the laboratory's capability"), "{notes}");
}

/// Conditions are chosen, or evaluated at a value that the file does not have.
#[test]
fn rows_are_chosen_by_their_conditions() {
    let model = json!({"inputs": {"x": normal(1.0, 0.1)},
        "conditions": {"f": {"unit": "kHz", "values": [1, 2]}, "g": {"values": [1, 2]}},
        "equations": {"y": "x*f*g/1000"}, "outputs": {"y": {"unit": "Hz"}}});
    let file = json!({"monte_carlo": {"trials": 0}, "rows": [
        {"model": "m.json", "output": "y", "set": {"f": "2000 Hz", "g": 1}, "nominal": "f"},
        {"model": "m.json", "output": "y", "set": {"f": 3}, "nominal": "3 mHz"},
        {"model": "m.json", "output": "y", "set": {"g": 2}}]});
    let files = [("c.json", file), ("m.json", model)];
    let found = answer(&files, &[]);
    let values: Vec<f64> =
        found["rows"].as_array().expect("rows").iter().map(|row| number(&row["value"])).collect();
    assert_eq!(values, [2.0, 3.0, 6.0, 2.0, 4.0]);
    assert_eq!(found["rows"][0]["nominal"], 2000.0);
    assert_eq!(found["rows"][1]["nominal"], 0.003);
    assert_eq!(found["rows"][1]["conditions"], json!({"f": 3.0, "g": 1.0}));
    // `run` takes one value of a condition as well
    let folder = folder(&files);
    let name = path(folder.path(), "m.json");
    let said = output(&[
        "run",
        &name,
        "--set",
        "f=5000 Hz",
        "--trials",
        "0",
        "--format",
        "json",
        "--quiet",
    ]);
    let found: Value = serde_json::from_str(&said).expect("JSON");
    assert_eq!(found["rows"].as_array().expect("rows").len(), 2);
    assert_eq!(found["rows"][1]["conditions"], json!({"f": 5.0, "g": 2.0}));
}

/// Three rows with everything that a certificate may show, quick to evaluate.
fn small() -> Vec<(&'static str, Value)> {
    let model = json!({"inputs": {
            "n": {"unit": "m/s^2", "distribution": "normal", "mean": 9.81, "std": 0.0123},
            "r": {"unit": "m/s^2", "distribution": "rectangular", "mean": 0, "half_width": 0.2}},
        "conditions": {"f": {"unit": "Hz", "values": [5, 1000]}},
        "equations": {"a": "n", "b": "n + r"},
        "outputs": {"a": {"unit": "m/s^2"}, "b": {"unit": "m/s^2", "tolerance": {"lower": 9.5}}}});
    let party =
        json!({"name": "L & <Co>", "email": "a@example.org", "city": "Torino", "country": "IT"});
    let file = json!({"number": "C-1", "title": {"en": "Certificate", "de": "Schein"},
        "device": {"name": "device | 1", "manufacturer": "M", "serial_number": "=1+1"},
        "customer": party, "laboratory": party, "responsible": "R", "calibration_date": "2026-03-02",
        "environment": "23 °C", "method": "comparison", "remarks": ["a remark"],
        "language": ["en", "de"], "monte_carlo": {"trials": 50000, "seed": 3},
        "rows": [{"model": "m.json", "output": "a", "nominal": 9.8},
            {"model": "m.json", "output": "b", "nominal": 9.8}]});
    vec![("c.json", file), ("m.json", model)]
}

/// Every format prints the figures of the JSON answer, rounded once.
#[test]
fn every_format_states_the_same_figures() {
    let files = small();
    let folder = folder(&files);
    let name = path(folder.path(), "c.json");
    let found = answer(&files, &[]);
    let rows = found["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[3]["basis"], "monte-carlo");
    let stated: Vec<Vec<String>> = rows
        .iter()
        .map(|row| {
            let text = |key: &str| row["stated"][key].as_str().expect("a text").to_owned();
            let mut texts =
                vec![text("value"), text("expanded_uncertainty"), text("coverage_factor")];
            for end in row["stated"]["interval"].as_array().into_iter().flatten() {
                texts.push(end.as_str().expect("a text").to_owned());
            }
            texts
        })
        .collect();
    let page = |format: &str| output(&["certificate", &name, "--format", format, "--quiet"]);
    for format in ["table", "markdown", "latex", "html"] {
        let page = page(format).replace('\u{2007}', " ");
        let separators: &[char] = &['|', '&', '<', '>', '\n', '\\'];
        for (row, texts) in stated.iter().enumerate() {
            let lines: Vec<String> = match format {
                "html" => page.split("<tr>").map(str::to_owned).collect(),
                _ => page.lines().map(str::to_owned).collect(),
            };
            let holds = |line: &String| {
                let line = line.trim_end_matches("\\\\");
                let cells: Vec<&str> = match format {
                    "table" => line.split_whitespace().collect(),
                    _ => line.split(separators).map(str::trim).collect(),
                };
                texts.iter().all(|text| cells.contains(&text.as_str()))
            };
            assert!(lines.iter().any(holds), "{format}, row {}: {texts:?}\n{page}", row + 1);
        }
    }
    // CSV
    let text = page("csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    for (record, texts) in reader.records().zip(&stated) {
        let record = record.expect("a record");
        let cells: Vec<&str> = record.iter().collect();
        assert!(texts.iter().all(|text| cells.contains(&text.as_str())), "{cells:?} {texts:?}");
    }
    // the workbook has numbers
    let bytes = gumption().args(["certificate", &name, "--format", "xlsx", "--quiet"]).output();
    let bytes = bytes.expect("a workbook").stdout;
    let mut book: Xlsx<_> = Xlsx::new(std::io::Cursor::new(bytes)).expect("a workbook");
    let sheet = book.worksheet_range("Certificate").expect("a sheet");
    for texts in &stated {
        let wanted: Vec<f64> = texts.iter().map(|text| text.parse().expect("a number")).collect();
        let holds = |row: &[Data]| {
            let numbers: Vec<f64> = row
                .iter()
                .filter_map(|cell| match cell {
                    Data::Float(value) => Some(*value),
                    Data::Int(value) => Some(*value as f64),
                    _ => None,
                })
                .collect();
            wanted.iter().all(|value| numbers.contains(value))
        };
        assert!(sheet.rows().any(holds), "{texts:?}");
    }
    assert!(book.sheet_names().contains(&"Correlations".to_owned()));
}

/// The digital certificate: well-formed, its numbers those of the JSON, its files as they were.
#[test]
fn the_digital_certificate_reads_back() {
    let files = small();
    let folder = folder(&files);
    let name = path(folder.path(), "c.json");
    let text = output(&["certificate", &name, "--format", "dcc", "--quiet"]);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let found = answer(&files, &[]);
    let all = |tag: &str| -> Vec<String> {
        let nodes = document.descendants().filter(|node| node.tag_name().name() == tag);
        nodes.map(|node| node.text().unwrap_or_default().to_owned()).collect()
    };
    let stated = |rows: &[usize], key: &str| -> String {
        let text = |row: &usize| found["rows"][*row]["stated"][key].as_str().expect("a text");
        rows.iter().map(text).collect::<Vec<_>>().join(" ")
    };
    // for each output the conditions, the nominal and the measured values; b has intervals as well
    let values = all("valueXMLList");
    assert_eq!(values.len(), 7);
    assert_eq!(values[0], "5 1000");
    assert_eq!(values[1], "9.8 9.8");
    assert_eq!([&values[2], &values[5]], [&stated(&[0, 1], "value"), &stated(&[2, 3], "value")]);
    assert_eq!(
        all("uncertaintyXMLList"),
        [stated(&[0, 1], "expanded_uncertainty"), stated(&[2, 3], "expanded_uncertainty")]
    );
    assert_eq!(all("coverageProbabilityXMLList"), ["0.9545 0.9545"; 3]);
    assert_eq!(all("distributionXMLList"), ["normal normal", "other other", "other other"]);
    let low = |row: usize| found["rows"][row]["stated"]["interval"][0].as_str().expect("a text");
    assert_eq!(all("intervalMinXMLList"), [format!("{} {}", low(2), low(3))]);
    let units = all("unitXMLList");
    assert_eq!([units[0].as_str(), units[2].as_str()], [r"\hertz", r"\metre\second\tothe{-2}"]);
    assert_eq!(all("uniqueIdentifier"), ["C-1"]);
    assert!(all("content").contains(&"L & <Co>".to_owned()));
    // the files, byte for byte
    let attached: Vec<(String, Vec<u8>)> = all("fileName")
        .into_iter()
        .zip(all("dataBase64").iter().map(|text| STANDARD.decode(text).expect("base64")))
        .collect();
    let names: Vec<&str> = attached.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["result.json", "certificate.json", "m.json"]);
    let model = fs::read(folder.path().join("m.json")).expect("the model");
    assert_eq!(attached[2].1, model);
    let result: Value = serde_json::from_slice(&attached[0].1).expect("JSON");
    assert_eq!(result["rows"], found["rows"]);
}

/// Each version of the digital certificate names its schema; the older one has no place for the day
/// of issue.
#[test]
fn both_versions_of_the_digital_certificate() {
    let mut files = small();
    files[0].1["issue_date"] = json!("2026-03-09");
    files[0].1["receipt_date"] = json!("2026-02-26");
    files[0].1["traceability"] = json!("to the SI");
    let folder = folder(&files);
    let name = path(folder.path(), "c.json");
    for (version, issued) in [("3.2.1", true), ("3.1.2", false)] {
        let arguments = ["certificate", &name, "--format", "dcc", "--quiet", "--trials", "2000"];
        let chosen = [&arguments[..], &["--dcc-version", version]].concat();
        let text = output(&chosen);
        if issued {
            assert_eq!(output(&arguments), text, "the newest is the default");
        }
        let document = roxmltree::Document::parse(&text).expect("XML");
        let root = document.root_element();
        assert_eq!(root.attribute("schemaVersion"), Some(version));
        let place = ("http://www.w3.org/2001/XMLSchema-instance", "schemaLocation");
        assert!(root.attribute(place).is_some_and(|of| of.contains(&format!("v{version}/"))));
        let has = |name: &str| {
            document.descendants().any(|node| node.has_tag_name(("https://ptb.de/dcc", name)))
        };
        assert!(has("receiptDate") && has("issueDate") == issued, "{version}");
        let kinds: Vec<&str> =
            document.descendants().filter_map(|n| n.attribute("refType")).collect();
        assert!(kinds.contains(&"basic_conformity"), "{kinds:?}");
        assert!(kinds.contains(&"basic_metrologicallyTraceableToSI"), "{kinds:?}");
    }
    let refused = gumption()
        .args(["certificate", &name, "--format", "html", "--dcc-version", "3.1.2"])
        .assert()
        .code(2);
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(said.contains("`--dcc-version` goes with `--format dcc`"), "{said}");
}

/// A certificate that is printed in Italian and French: one decimal mark, statements of conformity in
/// its languages, its number and the page at the foot of each page, an end, a place to sign, and
/// nobody's folders.
#[test]
fn a_paper_for_a_customer() {
    let mut files = small();
    files[0].1["language"] = json!(["it", "fr"]);
    files[0].1["rows"][0]["model"] = json!("sub/m.json");
    files[0].1["rows"][1]["model"] = json!("sub/m.json");
    let folder = folder(&files[..1]);
    fs::create_dir(folder.path().join("sub")).expect("a folder");
    fs::write(folder.path().join("sub/m.json"), files[1].1.to_string()).expect("a file");
    let name = path(folder.path(), "c.json");
    let page = |format: &str| {
        output(&["certificate", &name, "--format", format, "--quiet", "--trials", "50000"])
    };
    for format in ["table", "markdown", "html", "latex"] {
        let page = page(format);
        assert!(!page.contains("sub/m.json") && page.contains("m.json"), "{format}");
        let lines = page.split_whitespace().collect::<Vec<_>>().join(" ").replace("&#39;", "'");
        for said in [
            "conforme alla tolleranza",
            "da 9,5 m/s",
            "accettazione semplice (JCGM 106:2012, 8.2)",
            "acceptation simple (JCGM 106:2012, 8.2)",
            "Fine del certificato di taratura",
            "Firma / Signature: R",
            "si riferiscono soltanto all'oggetto tarato",
        ] {
            assert!(lines.contains(said), "{format} does not say {said}\n{page}");
        }
        let value = if format == "latex" { "9.810" } else { "9,810" };
        assert!(page.contains(value), "{format}\n{page}");
        assert!(lines.contains("k = 2,00"), "{format}\n{page}");
    }
    let html = page("html");
    let foot = r#"@bottom-left { content: "Numero del certificato / Numéro du certificat: C-1"; }"#;
    assert!(html.contains(foot), "{html}");
    assert!(html.contains(r#"content: "Pagina " counter(page) " di " counter(pages)"#), "{html}");
    let latex = page("latex");
    assert!(latex.contains(r"Pagina \thepage{} di \pageref{end}"), "{latex}");
    assert!(latex.contains("output-decimal-marker={,}"));
    // spreadsheets and digital certificates are for programs
    assert!(page("csv").contains("9.810") && page("dcc").contains("9.810"));
    files[0].1["decimal_mark"] = json!("point");
    fs::write(folder.path().join("c.json"), files[0].1.to_string()).expect("a file");
    assert!(page("markdown").contains("9.810"));
}

/// The measurement is on the paper: equation, and what the symbols mean. What a model says of where its
/// values come from names files of the laboratory, and is not; the certificate file can leave it out.
#[test]
fn a_certificate_states_the_measurement() {
    let mut files = small();
    files[1].1["inputs"]["n"]["about"] = json!("reading, see drift/customer 7.csv. Not corrected.");
    files[1].1["inputs"]["r"]["about"] = json!("resolution of the indicator");
    files[1].1["equations"]["b"] =
        json!("n + sqrt(r^2)*table(n/n, \"secret.csv\", \"f\", \"c\", \"linear\")");
    let folder = folder(&files);
    fs::write(folder.path().join("secret.csv"), "f,c\n0,1\n2,1\n").expect("a table");
    let name = path(folder.path(), "c.json");
    let page = |format: &str| output(&["certificate", &name, "--format", format, "--quiet"]);
    for format in ["table", "markdown", "latex", "html"] {
        let page = page(format);
        for said in ["Measurement model", "Modell der Messung", "resolution of the indicator"] {
            assert!(page.contains(said), "{format} does not say {said}\n{page}");
        }
        let measured = page.split("Modell der Messung").nth(1).expect("the section");
        let section: String = measured.chars().take(4000).collect();
        let section = section.split("a remark").next().expect("the section");
        assert!(!section.contains(".csv"), "{format}\n{section}");
        assert!(!page.contains("drift") && !page.contains("Not corrected"), "{format}\n{page}");
    }
    assert!(page("html").contains("<msqrt>"), "{}", page("html"));
    let found: Value = serde_json::from_str(&page("json")).expect("JSON");
    let stated = &found["measurement"][0];
    assert_eq!(stated["equations"]["a"], "n");
    assert_eq!(
        stated["symbols"]["r"],
        json!({"meaning": "resolution of the indicator", "unit": "m/s^2"})
    );
    // what nothing is said of has a line as well
    assert_eq!(stated["symbols"]["b"], json!({"meaning": "", "unit": "m/s^2"}));
    assert_eq!(stated["symbols"]["f"], json!({"meaning": "", "unit": "Hz"}));
    files[0].1["equations"] = json!(false);
    fs::write(folder.path().join("c.json"), files[0].1.to_string()).expect("a file");
    assert!(!page("markdown").contains("Measurement model"));
}

/// Like rows print like coverage factors: the last digit is one that another seed does not change.
#[test]
fn coverage_factors_do_not_scatter() {
    let input = json!({"distribution": "rectangular", "mean": 5, "half_width": 0.3});
    let model = json!({"inputs": {"r": input}, "equations": {"y": "r"}, "outputs": {"y": {}}});
    let file = json!({"rows": [{"model": "m.json", "output": "y"}]});
    let files = [("c.json", file), ("m.json", model)];
    let factor = |trials: &str, seed: &str| {
        let found = answer(&files, &["--trials", trials, "--seed", seed]);
        assert_eq!(found["rows"][0]["basis"], "monte-carlo");
        found["rows"][0]["stated"]["coverage_factor"].as_str().expect("a text").to_owned()
    };
    for seed in ["1", "2", "3", "4"] {
        // 0.9545 sqrt(3) = 1.653; the numerical standard error is 0.0005 with a million trials, and
        // 0.007 with 20 000, where both neighbours in tenths are as near
        assert!(["1.6", "1.7"].contains(&factor("20000", seed).as_str()));
        assert_eq!(factor("1000000", seed), "1.65");
    }
}

/// A certificate is read back row by row, in both versions: where a row is not normal its standard
/// uncertainty is that of its coverage interval, with all digits, and the interval is no further value.
#[test]
fn rows_that_are_not_normal_are_read_back() {
    let model = json!({
        "conditions": {"p": {"unit": "bar", "values": [0, 1]}},
        "inputs": {
            "r": {"unit": "bar", "distribution": "rectangular", "mean": 5, "half_width": "0.3 [bar] - 0.29*p"},
            "n": {"unit": "bar", "distribution": "normal", "mean": 0, "std": 0.04}},
        "equations": {"y": "r + n"}, "outputs": {"y": {"unit": "bar"}}});
    let mut certificate = small().remove(0).1;
    certificate["rows"] = json!([{"model": "m.json", "output": "y"}]);
    let folder = folder(&[("c.json", certificate), ("m.json", model)]);
    let name = path(folder.path(), "c.json");
    let found: Value = serde_json::from_str(&output_of(&name, "json")).expect("JSON");
    let (first, second) = (&found["rows"][0], &found["rows"][1]);
    assert_eq!((&first["basis"], &second["basis"]), (&json!("monte-carlo"), &json!("normal")));
    for version in ["3.2.1", "3.1.2"] {
        let dcc =
            output(&["certificate", &name, "--format", "dcc", "--dcc-version", version, "--quiet"]);
        assert!(dcc.contains("gumption_coverageInterval"), "{dcc}");
        // as older files have it
        let older = dcc.replace("gumption_coverageInterval", "basic_measuredValue");
        for text in [dcc, older] {
            fs::write(folder.path().join("c.xml"), text).expect("a file");
            let back = json!({
                "conditions": {"p": {"unit": "bar", "values": [0, 1]}},
                "inputs": {"c": {"distribution": "dcc", "file": "c.xml",
                    "ref_type": "basic_measuredValue", "at": "p"}},
                "equations": {"y": "c"}, "outputs": {"y": {"unit": "bar"}}});
            fs::write(folder.path().join("b.json"), back.to_string()).expect("a file");
            let back = path(folder.path(), "b.json");
            let said = output(&["run", &back, "--trials", "0", "--format", "json", "--quiet"]);
            let said: Value = serde_json::from_str(&said).expect("JSON");
            let u = |row: usize| {
                number(&said["rows"][row]["outputs"]["y"]["gum"]["standard_uncertainty"])
            };
            assert!((u(0) / number(&first["standard_uncertainty"]) - 1.0).abs() < 1e-9, "{said}");
            let stated = &second["stated"];
            let text =
                |key: &str| stated[key].as_str().expect("a text").parse::<f64>().expect("a number");
            let of_digits = text("expanded_uncertainty") / text("coverage_factor");
            assert!((u(1) / of_digits - 1.0).abs() < 1e-9, "{said}");
            assert!(said["warnings"].to_string().contains("interval-uncertainty"), "{said}");
        }
    }
}

/// What is raised to the capability states no interval that is narrower than it, and no factor's
/// sentence.
#[test]
fn what_is_raised_to_the_capability_states_nothing_narrower() {
    let input = json!({"distribution": "rectangular", "mean": 5, "half_width": 0.3});
    let model = json!({"inputs": {"r": input}, "equations": {"y": "r"}, "outputs": {"y": {}}});
    let rows = json!([{"model": "m.json", "output": "y", "cmc": 0.5, "cmc_floor": true}]);
    let found = answer(&[("c.json", json!({"rows": rows})), ("m.json", model)], &[]);
    let row = &found["rows"][0];
    assert_eq!(row["limit"]["raised"], true);
    assert_eq!(row["stated"]["expanded_uncertainty"], "0.50");
    assert_eq!(row["stated"]["interval"], Value::Null);
    let said = found["statements"]["en"].to_string();
    assert!(said.contains("at least approximately 95 %") && !said.contains("shortest"), "{said}");
}

/// A decision rests on the uncertainty that is stated: with u = 1 um and a capability of 3 um, k = 2,
/// the guard band is 1.959964 * 1.5 um, and P = cdf(2.5/1.5) = 0.9522 (JCGM 106, 7.2 and 8.3.2).
#[test]
fn what_is_raised_to_the_capability_is_decided_with_it() {
    let input = json!({"unit": "mm", "distribution": "normal", "mean": 10.0075, "std": 0.001});
    let tolerance = json!({"lower": 9.99, "upper": 10.01, "risk": 0.025});
    let output = json!({"unit": "mm", "tolerance": tolerance});
    let model = json!({"inputs": {"x": input}, "equations": {"d": "x"}, "outputs": {"d": output}});
    let page = |floor: bool| {
        let rows = json!([{"model": "m.json", "output": "d", "cmc": 0.003, "cmc_floor": floor}]);
        let certificate = json!({"rows": rows, "coverage_factor": 2});
        let folder = folder(&[("c.json", certificate), ("m.json", model.clone())]);
        let name = path(folder.path(), "c.json");
        let found: Value = serde_json::from_str(&output_of(&name, "json")).expect("JSON");
        (output_of(&name, "markdown"), found["rows"][0].clone())
    };
    let (said, row) = page(true);
    assert!(said.contains("95.22 %") && said.contains("0.00294 mm"), "{said}");
    assert!(said.contains("does not conform") || said.contains("rejected"), "{said}");
    assert_eq!(number(&row["coverage_factor"]), 2.0);
    assert_eq!(number(&row["standard_uncertainty"]), 0.0015);
    // as evaluated: P = cdf(2.5), guard band 1.96 um
    let (said, row) = page(false);
    assert!(said.contains("0.00196 mm") && !said.contains("95.22 %"), "{said}");
    assert_eq!(number(&row["coverage_factor"]), 2.0);
}

/// A result within the tolerance that a guarded rule rejects is not said to fail the tolerance (JCGM
/// 106:2012, 8.3): of 0.097 N m with u = 0.01 N m the share within +-0.1 N m is cdf(0.3) = 0.6179, the
/// guard band for 5 % is 1.645 * 0.01 N m. One outside of the tolerance, 0.107 N m, does not conform;
/// the risk that it does all the same is cdf(-0.7) = 0.2420. Of 2 N m it is next to nothing.
#[test]
fn what_a_guarded_rule_rejects_may_lie_within_the_tolerance() {
    let certificate = |mean: f64, tolerance: Value, language: Value| {
        let mut input = normal(mean, 0.01);
        input["unit"] = json!("N m");
        let output = json!({"unit": "N m", "tolerance": tolerance});
        let model = json!({"inputs": {"e": input}, "equations": {"err": "e"},
            "outputs": {"err": output}});
        let mut file = small().swap_remove(0).1;
        file["language"] = language;
        // of a million trials the numerical standard error is 0.05 %
        file["monte_carlo"] = json!({"trials": 1_000_000});
        file["rows"] = json!([{"model": "m.json", "output": "err"}]);
        let folder = folder(&[("c.json", file), ("m.json", model)]);
        let name = path(folder.path(), "c.json");
        let page = |format: &str| {
            let page = output_of(&name, format);
            page.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        (page("table"), page("csv"), page("dcc"))
    };
    let guarded = || json!({"lower": -0.1, "upper": 0.1, "risk": 0.05});
    let not_shown = [
        (
            "en",
            "It is not shown that the result conforms to the tolerance from -0.1 to 0.1 N m: it is \
            within the tolerance, but outside the acceptance limits. The decision rule rejects it. \
            Specific risk that the rejected value conforms: 61.",
            "does not conform",
        ),
        (
            "de",
            "Es liegt innerhalb der Toleranz, aber außerhalb der Annahmegrenzen. Nach der \
            Entscheidungsregel wird es zurückgewiesen. Spezifisches Risiko, dass der zurückgewiesene \
            Wert konform ist: 61,",
            "nicht konform",
        ),
        ("it", "fuori dai limiti di accettazione", "non è conforme"),
        ("fr", "hors des limites d'acceptation", "n'est pas conforme"),
    ];
    for (language, said, not) in not_shown {
        let (page, csv, dcc) = certificate(0.097, guarded(), json!(language));
        assert!(page.contains(said) && !page.contains(not), "{page}");
        assert!(csv.contains(",decision ") && csv.contains(",rejected"), "{csv}");
        assert!(dcc.contains("<dcc:conformity>fail<"), "{dcc}");
    }
    let (page, ..) = certificate(0.107, guarded(), json!("en"));
    let said = "The result does not conform to the tolerance from -0.1 to 0.1 N m. Specific risk that \
                the rejected value conforms: 24.";
    assert!(page.contains(said), "{page}");
    let (page, ..) = certificate(2.0, guarded(), json!("en"));
    assert!(page.contains("that the rejected value conforms: less than 0.01 %."), "{page}");
    // 2 * sf(10) is all that the middle of the tolerance has beyond it
    let (page, ..) =
        certificate(0.0, json!({"lower": -0.1, "upper": 0.1, "risk": 1e-24}), json!("en"));
    assert!(page.contains("the decision rule accepts no value. The result is rejected."), "{page}");
    let (page, csv, dcc) = certificate(0.0, guarded(), json!("en"));
    assert!(page.contains("conforms with a probability of more than 99.99 %"), "{page}");
    assert!(csv.contains(",accepted") && dcc.contains("<dcc:conformity>pass<"), "{csv}");
    // without a rule that guards nothing lies between the two
    let (page, ..) = certificate(0.097, json!({"lower": -0.1, "upper": 0.1}), json!("de"));
    assert!(page.contains("hält die Toleranz von -0,1 bis 0,1 N m ein: konform"), "{page}");
}

/// Units are as print has them on what people read, and as the model has them for programs.
#[test]
fn units_are_printed_with_their_symbols() {
    let model = json!({
        "conditions": {"t": {"unit": "degC", "values": [20]}},
        "inputs": {"x": {"unit": "uohm", "distribution": "normal", "mean": 5, "std": 0.1},
            "v": {"unit": "uL", "distribution": "normal", "mean": 3, "std": 0.2}},
        "equations": {"y": "x*(1 + 0 [1/K]*(t - 20 [degC]))"},
        "outputs": {"y": {"unit": "uohm", "tolerance": {"upper": 6, "risk": 0.05}}}});
    let mut file = small().swap_remove(0).1;
    file["language"] = json!("en");
    file["rows"] = json!([{"model": "m.json", "output": "y", "set": {"v": "4 uL"}}]);
    let folder = folder(&[("c.json", file), ("m.json", model)]);
    let name = path(folder.path(), "c.json");
    for format in ["table", "markdown", "html"] {
        let page = output_of(&name, format);
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        for unit in ["µΩ", "µL", "°C", "up to 6 µΩ", "v = 4 µL"] {
            assert!(page.contains(unit), "{format}: {unit}\n{page}");
        }
        for unit in ["uohm", "uL", "degC"] {
            assert!(!page.contains(unit), "{format}: {unit}\n{page}");
        }
    }
    let latex = output_of(&name, "latex");
    assert!(latex.contains(r"\unit{\micro\ohm}"), "{latex}");
    let bytes = gumption().args(["certificate", &name, "--format", "xlsx", "--quiet"]).output();
    let mut book: Xlsx<_> =
        Xlsx::new(std::io::Cursor::new(bytes.expect("a workbook").stdout)).expect("a workbook");
    let sheet = book.worksheet_range("Certificate").expect("a sheet");
    let texts: Vec<String> = sheet.used_cells().map(|(_, _, cell)| cell.to_string()).collect();
    assert!(texts.contains(&"µΩ".to_owned()) && !texts.concat().contains("uohm"), "{texts:?}");
    let dcc = output_of(&name, "dcc");
    assert!(dcc.contains(r"\micro\ohm") && dcc.contains("up to 6 µΩ"), "{dcc}");
    let csv = output_of(&name, "csv");
    assert!(csv.contains(",uohm,") && csv.contains("v = 4 uL, t = 20 degC"), "{csv}");
    let found: Value = serde_json::from_str(&output_of(&name, "json")).expect("JSON");
    assert_eq!(found["rows"][0]["unit"], "uohm");
    let symbols = &found["measurement"][0]["symbols"];
    assert_eq!(symbols["t"], json!({"meaning": "", "unit": "degC"}));
}

/// Every language of a digital certificate has its own words and its own decimal mark; pages have one
/// mark, and mark up what is in another language than the page (WCAG 2.1, 3.1.2). Programs find what
/// is said of device and parties under the keys of the file.
#[test]
fn every_language_stands_by_itself() {
    let mut files = small();
    let entries = files[0].1.as_object_mut().expect("an object");
    entries.remove("title");
    entries.insert("language".into(), json!(["de", "en"]));
    entries.insert("correlations".into(), json!(true));
    entries.insert("remarks".into(), json!({"de": "eine Bemerkung", "en": "a remark"}));
    let folder = folder(&files);
    let name = path(folder.path(), "c.json");
    let page = |format: &str| {
        output(&["certificate", &name, "--format", format, "--quiet", "--trials", "50000"])
    };
    let dcc = page("dcc");
    let read = roxmltree::Document::parse(&dcc).expect("XML");
    let contents = |language: &str| -> Vec<&str> {
        let all = read.descendants().filter(|node| node.attribute("lang") == Some(language));
        all.filter_map(|node| node.text()).collect()
    };
    assert!(contents("de").contains(&"Kalibrierschein"), "{dcc}");
    assert!(contents("en").contains(&"Calibration certificate"), "{dcc}");
    assert!(contents("en").iter().any(|text| text.contains("k = 2.00")), "{dcc}");
    assert!(contents("de").iter().any(|text| text.contains("k = 2,00")), "{dcc}");
    let limits = |language: &str, said: &str| contents(language).iter().any(|of| of.contains(said));
    assert!(limits("de", "ab 9,5 m/s^2") && limits("en", "from 9.5 m/s^2 on"), "{dcc}");
    let html = page("html");
    assert!(html.contains("<html lang=\"de\">"), "{html}");
    let foreign: Vec<&str> = html.split(" lang=\"en\">").skip(1).collect();
    for said in
        ["for a normal distribution", "Row 3: The result conforms", "a remark", "Rows that share"]
    {
        let begins = |part: &&str| {
            let end = part.find("</p>").or_else(|| part.find("</ul>")).unwrap_or(part.len());
            part[..end].contains(said)
        };
        assert!(foreign.iter().any(begins), "{said}\n{html}");
    }
    assert!(foreign.iter().all(|part| !part.split("</").next().unwrap_or("").contains("Zeile")));
    let found: Value = serde_json::from_str(&page("json")).expect("JSON");
    let stated = &found["administrative"];
    assert_eq!(stated["laboratory"]["city"], "Torino");
    assert_eq!(stated["device"]["serial_number"], "=1+1");
    assert_eq!(stated["calibration_date"], json!(["2026-03-02", "2026-03-02"]));
    assert_eq!(stated["place"], "laboratory");
    // LaTeX has no signs of its own for some quotes
    files[0].1["language"] = json!(["en", "de", "it", "fr"]);
    fs::write(folder.path().join("c.json"), files[0].1.to_string()).expect("a file");
    let latex = page("latex");
    assert!(latex.contains("Das angegebene") && !latex.contains("U+"), "{latex}");
    assert_eq!(
        found["particulars"]["Laboratorium / Laboratory"],
        "L & <Co>, Torino, IT, a@example.org"
    );
}

fn output_of(certificate: &str, format: &str) -> String {
    output(&["certificate", certificate, "--format", format, "--quiet"])
}

/// A certificate with a number is one that leaves the house, and says what a laboratory has to.
#[test]
fn what_a_laboratory_has_to_say_and_does_not_is_noted() {
    let files = small();
    let found = answer(&files, &["--trials", "0"]);
    let notes: Vec<&Value> = found["warnings"].as_array().expect("a list").iter().collect();
    let note = notes.iter().find(|note| note["code"] == "not-stated").expect("a note");
    let text = note["text"].as_str().expect("a text");
    assert!(text.ends_with("`issue_date`, `traceability`"), "{text}");
}

#[test]
fn certificates_are_the_same_bytes_on_any_number_of_threads_and_at_any_place() {
    let files = small();
    for format in ["json", "html", "dcc", "latex"] {
        let with = |threads: &str| {
            let folder = folder(&files);
            let name = path(folder.path(), "c.json");
            let said = output(&[
                "certificate",
                &name,
                "--format",
                format,
                "--quiet",
                "--threads",
                threads,
            ]);
            assert!(!said.contains(folder.path().to_str().expect("a path")), "{format}");
            said
        };
        assert!(with("1") == with("3"), "{format}");
    }
}

#[test]
fn certificate_files_are_checked() {
    for entry in fs::read_dir(root().join("models/certificates")).expect("the folder") {
        let path = entry.expect("an entry").path();
        let said = output(&["check", path.to_str().expect("a path")]);
        assert!(said.contains("no errors found"), "{said}");
    }
}

/// A digital certificate without the answer for programs that is attached to it: that has all digits,
/// of which the last ones are those of the version.
fn without_answer(page: &str) -> String {
    let (name, end) = ("<dcc:fileName>result.json", "</dcc:dataBase64>");
    match page.split_once(name) {
        Some((before, rest)) => before.to_owned() + rest.split_once(end).expect("its bytes").1,
        None => page.to_owned(),
    }
}

/// The worked day: `gumption certificate models/certificates/three_axis_accelerometer.json`.
/// `GUMPTION_UPDATE=1 cargo test --test all worked_day` writes the reports anew.
#[test]
fn the_worked_day_is_the_one_in_reports() {
    for (format, name) in [
        ("markdown", "certificate.md"),
        ("html", "certificate.html"),
        ("dcc", "certificate.dcc.xml"),
    ] {
        let found = output(&["certificate", WORKED_DAY, "--format", format, "--quiet"]);
        let path = root().join("reports").join(name);
        if std::env::var_os("GUMPTION_UPDATE").is_some() {
            fs::write(&path, &found).expect("the report is written");
        }
        let kept = fs::read_to_string(&path).expect("the report");
        assert!(
            without_answer(&found) == without_answer(&kept),
            "reports/{name} is not what the command prints; see this test's comment"
        );
    }
}

/// Its last rows are table 1 of Chiominto et al. (2024), MEMS 1 on the linear bench: 422 +- 13,
/// 419 +- 12, 421 +- 11 D/(m/s^2), k = 2.
#[test]
fn the_worked_day_has_the_sensitivities_of_the_paper() {
    let said = output(&["certificate", WORKED_DAY, "--format", "json", "--quiet", "--trials", "0"]);
    let found: Value = serde_json::from_str(&said).expect("JSON");
    let below = |row: &Value| row["limit"]["below"] == true;
    assert!(!found["rows"].as_array().expect("rows").iter().any(below), "within the capability");
    let rows = found["rows"].as_array().expect("rows");
    let stated: Vec<(&str, &str)> = rows[rows.len() - 3..]
        .iter()
        .map(|row| {
            let text = |key: &str| row["stated"][key].as_str().expect("a text");
            (text("value"), text("expanded_uncertainty"))
        })
        .collect();
    assert_eq!(stated, [("422", "13"), ("419", "12"), ("421", "11")]);
}

/// The rows of a certificate of so few trials that their own last digits move with the seed.
fn table_of_few_trials(file: &str, seed: u32, method: &str) -> String {
    let seed = seed.to_string();
    let options = ["--format", "csv", "--quiet", "--trials", "20000"];
    let asked = ["--seed", &seed, "--method", method];
    output(&[&["certificate", file][..], &options, &asked].concat())
}

/// What is stated depends on no seed: of 20 seeds, each with so few trials that their own last digits
/// move, the worked day has the same line for every row.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn the_worked_day_has_the_same_digits_with_any_seed() {
    let stated = |seed, method| table_of_few_trials(WORKED_DAY, seed, method);
    let first = stated(1, "auto");
    for seed in 2..=20 {
        assert_eq!(stated(seed, "auto"), first, "seed {seed}");
    }
}

/// A row that the law of propagation does not describe: a product about zero, whose interval is that
/// of the trials, moves with the seed without figures that have no noise, and does not with them.
#[test]
fn a_row_beyond_the_law_of_propagation_has_the_same_digits_with_any_seed() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("model.json");
    let model_text = r#"{"inputs": {
        "a": {"distribution": "rectangular", "mean": 0.3, "half_width": 0.5},
        "b": {"distribution": "normal", "mean": 1, "std": 0.4},
        "c": {"distribution": "triangular", "mean": 0, "half_width": 0.4}},
        "equations": {"y": "a*b*exp(b) + c"}, "outputs": {"y": {}}}"#;
    fs::write(&model, model_text).expect("the model");
    let file = folder.path().join("certificate.json");
    let text = r#"{"digits": 3, "rows": [{"model": "model.json", "output": "y"}]}"#;
    fs::write(&file, text).expect("the certificate");
    let file = file.to_str().expect("a path");
    let stated = |seed, method| table_of_few_trials(file, seed, method);
    let first = stated(1, "auto");
    let moved = (2..=5).filter(|&seed| {
        assert_eq!(stated(seed, "auto"), first, "seed {seed}");
        stated(seed, "monte-carlo") != stated(1, "monte-carlo")
    });
    assert!(moved.count() > 0);
    for (method, said) in [("auto", "without random trials"), ("monte-carlo", "Monte Carlo method")]
    {
        let page = output(&["certificate", file, "--quiet", "--method", method]);
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(page.contains(said), "{page}");
    }
}

/// Readings with a mean of 0.0275 and few degrees of freedom, stated by the trials, whose mean lies on either side of it, and the value is rounded as that of the law of propagation with any
/// seed. The trials that were made are stated, which are more than the usual million where clause 8 is
/// undecided.
#[test]
fn a_value_at_a_tie_is_rounded_alike_with_any_seed() {
    let model = json!({"inputs": {
            "r": {"unit": "bar", "distribution": "readings", "values": [0.02, 0.03, 0.02, 0.04],
                "resolution": 0.01},
            "s": {"unit": "bar", "distribution": "normal", "mean": 0, "expanded": 0.0014, "k": 2},
            "h": {"unit": "bar", "distribution": "rectangular", "mean": 0, "half_width": 0.0005}},
        "equations": {"e": "r - s - h"}, "outputs": {"e": {"unit": "bar"}}});
    for seed in 1..=6 {
        let mut seeded = model.clone();
        seeded["monte_carlo"] = json!({"trials": 1_000_000, "seed": seed});
        let certificate = json!({"statement": "monte-carlo",
            "rows": [{"model": "m.json", "output": "e"}]});
        let found = answer(&[("certificate.json", certificate), ("m.json", seeded)], &[]);
        let row = &found["rows"][0];
        assert_eq!(row["basis"], "monte-carlo");
        assert_eq!(row["stated"]["value"], "0.028", "seed {seed}: {row}");
        let made = &found["provenance"]["models"][0]["trials_made"];
        assert_eq!(made, &json!([1_000_000, 1_000_000]));
    }
}

/// A certificate that states a line, and comes back as an input with what its results have in common.
#[test]
fn a_certificate_comes_back_with_its_correlations() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("written");
    };
    let run = |arguments: &[&str]| {
        let said = crate::support::command()
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .expect("a run");
        let error = String::from_utf8_lossy(&said.stderr).into_owned();
        assert!(said.status.success(), "{arguments:?}: {error}");
        String::from_utf8(said.stdout).expect("UTF-8")
    };
    // two masses with a common reference: r = 9/10
    write(
        "masses.json",
        r#"{"inputs": {"R": {"unit": "g", "distribution": "normal", "mean": 100, "std": 0.3},
        "d1": {"unit": "g", "distribution": "normal", "mean": 0, "std": 0.1},
        "d2": {"unit": "g", "distribution": "normal", "mean": 1, "std": 0.1}},
        "fits": {"line": {"x": {"unit": "g", "values": [1, 2, 3, 4, 5, 6]},
        "y": {"unit": "V", "values": [3.3, 5.6, 7.1, 9.3, 10.7, 12.1], "standard_uncertainty": 0.5}}},
        "equations": {"a": "R + d1", "b": "R + d2"}, "outputs": {"a": {"unit": "g"},
        "b": {"unit": "g"}}, "monte_carlo": {"trials": 0}}"#,
    );
    write(
        "certificate.json",
        r#"{"number": "1", "device": {"name": "d", "manufacturer": "M", "model": "T",
        "serial_number": "2"}, "customer": {"name": "C", "city": "Roma", "country": "IT",
        "email": "c@example.org"}, "laboratory": {"name": "L", "city": "Torino", "country": "IT",
        "email": "l@example.org"}, "responsible": "R", "calibration_date": "2026-03-04",
        "language": ["en", "de"], "rows": [{"model": "masses.json", "output": "a"},
        {"model": "masses.json", "output": "b"}],
        "functions": [{"model": "masses.json", "fit": "line", "label": "indication"}]}"#,
    );
    let page = run(&["certificate", "certificate.json"]);
    assert!(
        page.contains("Calibration function indication / Kalibrierfunktion indication"),
        "{page}"
    );
    // ISO/TS 28037, clause 6 with equal weights: a 1.8667, b 1.7571, u 0.4655 and 0.1195
    for part in ["line(x) = a + b x for 1 ≤ x ≤ 6", "1.867", "0.465", "1.757", "0.120"] {
        assert!(page.contains(part), "{part}: {page}");
    }
    for format in ["markdown", "latex", "html", "csv"] {
        run(&["certificate", "certificate.json", "--format", format]);
    }
    let book = ["certificate", "certificate.json", "--format", "xlsx", "--output", "c.xlsx"];
    run(&book);
    let answer: Value =
        serde_json::from_str(&run(&["certificate", "certificate.json", "--format", "json"]))
            .unwrap();
    let function = &answer["functions"][0];
    // U at the middle, x = 3.5: 2 * 0.5/sqrt(6) = 0.408
    assert_eq!(function["stated"]["x"][3], "3.5");
    assert_eq!(function["stated"]["expanded_uncertainty"][3], "0.41");
    run(&["certificate", "certificate.json", "--format", "dcc", "--output", "c.xml"]);
    // U = 2 sqrt(0.1) g is stated as 0.63 g, so u = 0.315 g; u(a - b) = u sqrt(2 (1 - 0.9))
    write(
        "difference.json",
        r#"{"inputs": {"a": {"distribution": "dcc", "file": "c.xml", "ref_type": "basic_measuredValue",
        "index": 0}, "b": {"distribution": "dcc", "file": "c.xml", "ref_type":
        "basic_measuredValue", "index": 1}}, "equations": {"y": "a - b"},
        "outputs": {"y": {"unit": "g"}}, "monte_carlo": {"trials": 0}}"#,
    );
    let answer: Value =
        serde_json::from_str(&run(&["run", "difference.json", "--format", "json"])).unwrap();
    let u = answer["outputs"]["y"]["gum"]["standard_uncertainty"].as_f64().unwrap();
    assert!((u - 0.315 * 0.2_f64.sqrt()).abs() < 1e-9, "{u}");
    assert!(answer["warnings"].to_string().contains("are kept: `a` and `b` (0.900"), "{answer}");
    // a coefficient of the file goes before that of the certificate
    let text = fs::read_to_string(folder.path().join("difference.json")).unwrap();
    let text =
        text.replacen("\"equations\"", "\"correlations\": [[\"a\", \"b\", 0]], \"equations\"", 1);
    write("difference.json", &text);
    let answer: Value =
        serde_json::from_str(&run(&["run", "difference.json", "--format", "json"])).unwrap();
    let u = answer["outputs"]["y"]["gum"]["standard_uncertainty"].as_f64().unwrap();
    assert!((u - 0.315 * 2.0_f64.sqrt()).abs() < 1e-9, "{u}");
}

/// A complex result has its region in the digital certificate (JCGM 102, 6.5): the covariance matrix,
/// k of two normal quantities, sqrt(-2 ln 0.05) = 2.448 (ellipse), and what reads the certificate still
/// finds the rows with their correlation.
#[test]
fn coverage_regions_are_in_the_digital_certificate() {
    let part = |mean: f64, std: f64| json!({"distribution": "normal", "mean": mean, "std": std});
    let model = json!({"inputs": {"z": {"unit": "ohm", "complex": {"re": part(50.0, 0.3),
            "im": part(2.0, 0.4), "correlation": 0.5}}, "w": part(1.0, 0.01)},
        "equations": {"Z": "z", "v": "w"}, "outputs": {"Z": {"unit": "ohm", "complex": "re-im"}, "v": {}},
        "coverage_probability": 0.95, "regions": [{"outputs": ["Z"]}, {"outputs": ["Z", "v"]}],
        "monte_carlo": {"trials": 0}});
    let mut files = small();
    files[1].1 = model;
    files[0].1["monte_carlo"] = json!({"trials": 0});
    let row = |output: &str| json!({"model": "m.json", "output": output});
    files[0].1["rows"] = json!([row("Z.re"), row("Z.im"), row("v")]);
    let folder = folder(&files);
    let name = path(folder.path(), "c.json");
    let text = output(&["certificate", &name, "--format", "dcc", "--quiet"]);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let within = |place: usize, tag: &str| -> Vec<String> {
        let regions = document.descendants().filter(|n| n.tag_name().name() == "ellipsoidalRegion");
        let region = regions.clone().nth(place).expect("a region");
        let nodes = region.descendants().filter(|n| n.tag_name().name() == tag);
        nodes.map(|node| node.text().unwrap_or_default().to_owned()).collect()
    };
    let covariance: Vec<f64> = within(0, "value").iter().map(|v| v.parse().expect("one")).collect();
    for (found, exact) in covariance.iter().zip([0.09, 0.06, 0.06, 0.16]) {
        assert!((found - exact).abs() < 1e-12, "{covariance:?}");
    }
    assert_eq!(within(0, "unit"), vec![r"\ohm\tothe{2}"; 4]);
    assert_eq!(within(0, "coverageFactor"), ["2.448"]);
    // three normal quantities: the 0.95 quantile of chi with 3 degrees of freedom
    assert_eq!(within(1, "coverageFactor"), ["2.795"]);
    assert_eq!(within(1, "unit")[2], r"\ohm");
    let has = |tag: &str| document.descendants().filter(|n| n.tag_name().name() == tag).count();
    assert_eq!([has("complex"), has("realList"), has("rectangularRegion")], [2, 2, 2]);
    let found = answer(&files, &[]);
    assert_eq!(found["regions"][0]["rows"], json!([1, 2]));
    assert_eq!(found["regions"][1]["region"]["outputs"], json!(["Z.re", "Z.im", "v"]));
    // read back: the difference of the parts has u^2 = 0.09 + 0.16 - 2*0.06
    fs::write(folder.path().join("c.xml"), &text).expect("written");
    let taken = |index: usize| json!({"distribution": "dcc", "file": "c.xml", "quantity": index});
    let back = json!({"inputs": {"a": taken(0), "b": taken(1)}, "equations": {"d": "a - b"},
        "outputs": {"d": {"unit": "ohm"}}});
    fs::write(folder.path().join("back.json"), back.to_string()).expect("written");
    let name = path(folder.path(), "back.json");
    let said = output(&["run", &name, "--trials", "0", "--format", "json", "--quiet"]);
    let answer: Value = serde_json::from_str(&said).expect("JSON");
    let u = number(&answer["outputs"]["d"]["gum"]["standard_uncertainty"]);
    // U of the certificate has two digits
    assert!((u - 0.13_f64.sqrt()).abs() < 0.01, "{u}");
}
