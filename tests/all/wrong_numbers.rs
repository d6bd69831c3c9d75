//! Numbers that earlier versions gave wrong without a word, with today's answer for each: the right
//! number, or the mistake that is told instead.

use std::f64::consts::TAU;
use std::fs;
use std::process::Output;

use serde_json::{Value, json};

use crate::support::command;

/// What the program says to a model file, and the folder-free rest of the arguments.
fn run(model: &Value, arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.json");
    fs::write(&path, model.to_string()).expect("a file");
    command().arg("run").arg(path).args(arguments).output().expect("the program runs")
}

fn answer(model: &Value, arguments: &[&str]) -> Value {
    let said = run(model, &[&["--format", "json", "--quiet"], arguments].concat());
    assert!(said.status.success(), "{model}: {}", String::from_utf8_lossy(&said.stderr));
    serde_json::from_slice(&said.stdout).expect("JSON")
}

/// What is said of a model that is refused.
fn refused(model: &Value, arguments: &[&str]) -> String {
    let said = run(model, arguments);
    let text = String::from_utf8(said.stderr).expect("UTF-8");
    assert_eq!(said.status.code(), Some(2), "{model}: {text}");
    assert!(said.stdout.is_empty(), "{model}");
    text
}

/// A model of one output y.
fn model(inputs: &Value, formula: &str, unit: &str) -> Value {
    json!({"inputs": inputs, "equations": {"y": formula}, "outputs": {"y": {"unit": unit}}})
}

fn normal(unit: &str, mean: f64, std: f64) -> Value {
    json!({"unit": unit, "distribution": "normal", "mean": mean, "std": std})
}

/// Figures without noise whose squares leave the range of double precision were computed for ever.
#[test]
fn exact_figures_of_enormous_widths_are_refused() {
    let width = |half_width: f64| json!({"unit": "mm", "distribution": "rectangular", "mean": 0, "half_width": half_width});
    let inputs = json!({"a": width(0.0008), "b": width(1e305), "c": width(0.05)});
    for method in ["exact", "quasi", "auto"] {
        let options = ["--trials", "100000", "--method", method];
        let found = answer(&model(&inputs, "a + b + c", "mm"), &options);
        let said = found["outputs"]["y"].to_string();
        assert!(said.contains("is beyond double precision"), "{method}: {said}");
    }
}

/// Formula by formula: inputs, formula and unit, what was said, and what is right: a number (by hand,
/// or of the source named) with the share that its digits allow, or the mistake.
#[test]
fn numbers_that_were_wrong() {
    const EXACT: f64 = 1e-12;
    let gas = json!({"p": normal("kPa", 100.0, 0.1), "R": normal("J/(kg*K)", 287.06, 1e-9),
        "T": normal("K", 293.15, 0.1), "t": normal("degC", 20.0, 0.1)});
    let pitot = json!({"dp": normal("kPa", 1.993, 0.0125), "p": normal("kPa", 101.4, 1.05),
        "R": normal("J/(kg*K)", 287.06, 1e-9), "t": normal("degC", 19.65, 0.11)});
    let gain = json!({"Vo": normal("V", 1.0, 0.001), "Vi": normal("mV", 10.0, 0.01),
        "L": normal("dB", 20.0, 0.1), "n": normal("1", 2.0, 0.01)});
    let turns = json!({"n": normal("rpm", 60.0, 0.1), "f": normal("Hz", 1.0, 0.001)});
    let warm = json!({"a": normal("mV/degF", 1.0, 0.01), "t": normal("degF", 68.0, 0.1)});
    type Right = Result<(f64, f64), &'static str>;
    let table: &[(&Value, &str, &str, f64, Right)] = &[
        (&gas, "p/(R*T)", "kg/m^3", 17.418, Ok((1.188_331, 1e-6))),
        (&gas, "p/(R*t)", "kg/m^3", 17.418, Err("Write `kelvin(t)`")),
        (&gas, "p/(R*kelvin(t))", "kg/m^3", 17.418, Ok((1.188_331, 1e-6))),
        (&gas, "kelvin(t)", "degC", 293.15, Err("celsius")),
        (&gas, "T", "degC", 293.15, Err("celsius")),
        (&gas, "T - t", "degC", 273.15, Err("kelvin(t)")),
        (&gas, "(t + T)/2", "degC", 162.5, Err("kelvin(t)")),
        (&gas, "t", "K", 20.0, Err("kelvin")),
        (&gas, "celsius(T)", "degC", 293.15, Ok((20.0, EXACT))),
        // NIST TN 1900, E4
        (&pitot, "sqrt(2*dp*R*t/p)", "m/s", 14.89, Err("kelvin(t)")),
        (&pitot, "sqrt(2*dp*R*kelvin(t)/p)", "m/s", 14.89, Ok((57.48, 1e-4))),
        (&gain, "Vo/Vi", "dB", 100.0, Err("20*log10")),
        (&gain, "20*log10(Vo/Vi)", "dB", 100.0, Ok((40.0, EXACT))),
        (&gain, "L + Vo/Vi", "dB", 120.0, Err("log10(Vo/Vi)")),
        (&gain, "10*n*log10(Vo/Vi)", "dB", f64::NAN, Ok((40.0, EXACT))),
        (&turns, "n", "Hz", TAU, Err("rev")),
        (&turns, "f", "rad/s", 1.0, Err("2*pi")),
        (&turns, "n/[rev]", "Hz", TAU, Ok((1.0, EXACT))),
        (&turns, "2*pi*f", "rad/s", 1.0, Ok((TAU, EXACT))),
        // 1 mV/degF times 68 degF was 36 mV, as of 20 degrees from 0 degC
        (&warm, "a*t", "mV", 36.0, Err("give the coefficient per degC")),
        (&warm, "a*(t - 60 [degF])", "mV", 8.0, Ok((8.0, EXACT))),
    ];
    for (inputs, formula, unit, was, right) in table {
        let model = model(inputs, formula, unit);
        match right {
            Ok((right, share)) => {
                let found = &answer(&model, &["--trials", "0"])["outputs"]["y"]["gum"]["estimate"];
                let found = found.as_f64().expect("a number");
                assert!((found / right - 1.0).abs() <= *share, "{formula}: {found}, once {was}");
            }
            Err(said) => {
                let text = refused(&model, &["--trials", "0"]);
                assert!(text.contains(said), "{formula}, once {was} {unit}: {text}");
            }
        }
    }
}

/// u of a product of two quantities of 50 % and of a t of 5 degrees of freedom with 0.5 % of the
/// variance: the trials' 0.75 against 0.71 is the product's, sqrt(1/2 + 1/16) = 0.75, not the t's.
#[test]
fn the_reason_of_a_difference_is_the_true_one() {
    let mut inputs = json!({"a": normal("1", 1.0, 0.5), "b": normal("1", 1.0, 0.5),
        "c": normal("1", 0.0, 0.05)});
    inputs["c"]["dof"] = 5.into();
    let answer = answer(&model(&inputs, "a*b + c", "1"), &["--trials", "1000000"]);
    let u = answer["outputs"]["y"]["monte_carlo"]["standard_uncertainty"].as_f64().unwrap();
    // its own numerical standard error is 0.0008
    assert!((u - 0.752).abs() < 0.005, "{u}");
    let codes: Vec<&str> = answer["warnings"].as_array().unwrap().iter().map(code).collect();
    assert!(codes.contains(&"non-linear") && !codes.contains(&"few-dof"), "{codes:?}");
}

fn code(warning: &Value) -> &str {
    warning["code"].as_str().expect("a code")
}

/// A half-width of 0.05 K that is known to 50 %: trials within +-0.0475 K were recommended, which is
/// 95 % of the width as if it were exact.
#[test]
fn doubt_about_a_half_width_counts_in_the_trials() {
    let inputs = json!({"d": {"unit": "K", "distribution": "rectangular", "mean": 0,
        "half_width": 0.05, "dof": 2}});
    let mut model = model(&inputs, "d", "K");
    model["coverage_probability"] = 0.95.into();
    let answer = answer(&model, &["--trials", "1000000"]);
    let interval = &answer["outputs"]["y"]["monte_carlo"]["symmetric_interval"];
    let [low, high] = [0, 1].map(|end| interval[end].as_f64().unwrap());
    // inexactness 0.05/sqrt(2 dof) = 0.025 K: the limits lie from 0.025 to 0.075 K
    assert!((0.05..0.075).contains(&high) && (low + high).abs() < 0.001, "{low} {high}");
}

/// 1/z with z ~ N(0, 1): no GUM evaluation, and trials without moments; only the former was said.
#[test]
fn an_output_without_a_gum_evaluation_has_notes_on_its_trials() {
    let model = model(&json!({"z": normal("1", 0.0, 1.0)}), "1/z", "1");
    let answer = answer(&model, &["--trials", "1000000"]);
    let warnings = answer["warnings"].as_array().unwrap();
    let codes: Vec<&str> = warnings.iter().map(|note| note["code"].as_str().unwrap()).collect();
    assert!(["gum-undefined", "heavy-tails"].iter().all(|code| codes.contains(code)), "{codes:?}");
}

/// 1/z with z ~ N(1, 0.3) has neither expectation nor variance; the page printed "1 to 2".
#[test]
fn an_output_without_moments() {
    let inputs = json!({"z": normal("1", 1.0, 0.3)});
    let mut model = model(&inputs, "1/z", "1");
    model["coverage_probability"] = 0.95.into();
    let arguments = ["--trials", "1000000", "--seed", "3"];
    let answer = answer(&model, &arguments);
    let found = &answer["outputs"]["y"]["monte_carlo"];
    // quantiles 0.025 and 0.975 of 1/z over both branches, 2e7 independent trials: 0.629, 2.42
    for (end, right, error) in [(0, 0.629, 0.003), (1, 2.42, 0.02)] {
        let symmetric = found["symmetric_interval"][end].as_f64().unwrap();
        assert!((symmetric - right).abs() < error, "{symmetric}");
    }
    assert!(found["numerical_standard_error"]["standard_uncertainty"].is_null(), "{found}");
    let warnings = answer["warnings"].as_array().unwrap();
    assert!(warnings.iter().map(code).any(|code| code == "heavy-tails"), "{warnings:?}");
    let page = run(&model, &arguments);
    let page = String::from_utf8(page.stdout).expect("UTF-8");
    let end = |name: &str, value: &str| {
        let line = page.lines().position(|line| line.starts_with(name)).expect(name);
        let lines: String = page.lines().skip(line).take(2).collect();
        assert!(lines.contains(value), "{lines}");
    };
    end("coverage interval, symmetric", " 0.63");
    end("coverage interval, symmetric", " 2.4");
}

/// Two readings have a t of one degree of freedom, which has no expectation; 2.27, 1.49 and 2.89 were
/// printed for three seeds.
#[test]
fn two_readings_have_no_estimate_by_trials() {
    let inputs = json!({"a": {"unit": "1", "distribution": "readings", "values": [1, 2]}});
    let answer = answer(&model(&inputs, "a", "1"), &["--trials", "20000"]);
    let output = &answer["outputs"]["y"];
    assert_eq!(output["gum"]["estimate"], 1.5);
    assert!(output["monte_carlo"]["estimate"].is_null(), "{output}");
    let median = output["monte_carlo"]["median"].as_f64().unwrap();
    // density of a Cauchy of scale 0.5 at its median: 0.64; error 0.5/sqrt(20000)/0.64 = 0.0055
    assert!((median - 1.5).abs() < 0.03, "{median}");
}

/// JCGM 106's ball bearings: 65.4 % was printed beside global risks that used the prior.
#[test]
fn conformity_with_a_prior_is_that_of_the_posterior() {
    let inputs = json!({"x": normal("1", 1.9, 0.25)});
    let mut model = model(&inputs, "x", "1");
    model["outputs"]["y"]["tolerance"] =
        json!({"upper": 2, "prior": {"distribution": "gamma", "shape": 4, "rate": 4}});
    let answer = answer(&model, &["--trials", "1000000"]);
    let conformity = &answer["outputs"]["y"]["conformity"];
    // quadrature of the posterior gamma(4, 4) * N(1.9, 0.25): 84.01 %
    let found = conformity["probability"].as_f64().unwrap();
    assert!((found - 0.8401).abs() < 0.003, "{conformity}");
    let without = conformity["probability_without_prior"].as_f64().unwrap();
    assert!((without - 0.6554).abs() < 0.003, "{conformity}");
}

/// Reasons that named numbers which were none.
#[test]
fn reasons_are_true() {
    let readings = |values: Value| {
        model(&json!({"a": {"unit": "1", "distribution": "readings", "values": values}}), "a", "1")
    };
    for values in [json!([1e308, -1e308]), json!([1e-320, 2e-320, 3e-320])] {
        let said = refused(&readings(values), &[]);
        assert!(!said.contains("are equal"), "{said}");
    }
    let mut many = model(&json!({"a": normal("1", 1.0, 0.1)}), "a*c0", "1");
    let values: Vec<u32> = (0..100).collect();
    for list in 0..30 {
        many["conditions"][format!("c{list}")] = json!({"unit": "1", "values": values});
    }
    let said = refused(&many, &[]);
    assert!(!said.contains("18446744073709551615"), "{said}");
    let said = refused(&readings(json!([1, 2])), &["--memory", "99999999999G"]);
    assert!(!said.contains("at least 1 MiB"), "{said}");
}

/// Values of which one unit is declared and another stands behind the uncertainty: earlier versions
/// took the second for both, so that 20 degC were -253.15 degC and 1 kg was 1 mg.
#[test]
fn a_value_has_one_unit() {
    let of =
        |unit: &str, value: &str| model(&json!({"x": {"unit": unit, "value": value}}), "x", unit);
    for (unit, value, said) in [
        ("degC", "20 ± 0.5 K (k=2)", "20 K, like its uncertainty, or 20 degC"),
        ("degC", "20(0.5) K", "20 K, like its uncertainty, or 20 degC"),
        ("kg", "1.000 ± 50 mg (95 %)", "1.000 mg, like its uncertainty, or 1.000 kg"),
        ("m", "10 +0.2 -0.1 mm", "10 mm, like its uncertainty, or 10 m"),
        ("m", "10, U = 2 mm, k = 2", "the value has no unit, but its uncertainty is in `mm`"),
    ] {
        let found = refused(&of(unit, value), &["--trials", "0"]);
        assert!(found.contains(said), "{value}: {found}");
    }
    // estimate and standard uncertainty, in the declared unit
    for (unit, value, right) in [
        ("degC", "20 degC ± 0.5 K (k=2)", [20.0, 0.25]),
        ("kg", "1.000 kg ± 50 mg (k=2)", [1.0, 25e-6]),
        ("kg", "1000.0(20) g", [1.0, 2e-3]),
        ("kg", "(1000 ± 4) g (k=2)", [1.0, 2e-3]),
        ("°C", "20 ± 0.5 degC (k=2)", [20.0, 0.25]),
        ("m", "10 +0.2 -0.2 m", [10.0, 0.2]),
        // per cent and ppm behind both are counted alike
        ("1", "(50 ± 2) % (k=2)", [0.5, 0.01]),
        ("1", "150 ppm ± 5 ppm (k=2)", [150e-6, 2.5e-6]),
        ("umol/mol", "(400 ± 1) ppm (k=2)", [400.0, 0.5]),
        ("ppm", "(50 ± 2) % (k=2)", [500_000.0, 10_000.0]),
        ("1", "0.5 ± 0.01 (k=2)", [0.5, 0.005]),
    ] {
        let found = answer(&of(unit, value), &["--trials", "0"]);
        let gum = &found["outputs"]["y"]["gum"];
        let found = ["estimate", "standard_uncertainty"].map(|key| gum[key].as_f64().unwrap());
        // a quotient or two of 16 digits
        let near =
            found.iter().zip(right).all(|(found, right)| (found / right - 1.0).abs() < 1e-14);
        assert!(near, "{value}: {found:?}");
    }
}

/// A width in per cent of an estimate in per cent, and in ppm of what counts as ppm does: a share of it,
/// or as much. Earlier versions took a share, so that 150 ppm with a half-width of 5 ppm had 0.8 ppb.
#[test]
fn a_share_of_a_share_is_asked() {
    for (unit, mean, key, width) in [
        ("1", json!("150 ppm"), "half_width", "5 ppm"),
        ("1", json!("50 %"), "half_width", "2 %"),
        ("umol/mol", json!(400), "half_width", "1 ppm"),
        ("uV/V", json!(12), "half_width", "5 ppm"),
    ] {
        let x = json!({"unit": unit, "distribution": "rectangular", "mean": mean, key: width});
        let found = refused(&model(&json!({"x": x}), "x", unit), &["--trials", "0"]);
        assert!(found.contains("of reading`"), "{width} of {mean} {unit}: {found}");
    }
}

/// Factors and probabilities mistaken for each other, which earlier versions computed with.
#[test]
fn factors_and_probabilities_are_told_apart() {
    let of = |key: &str, value: f64| {
        let x =
            json!({"unit": "1", "distribution": "normal", "mean": 1, "expanded": 0.1, key: value});
        model(&json!({"x": x}), "x", "1")
    };
    for (key, value) in [("k", 95.0), ("k", 0.95), ("p", 0.05)] {
        let found = refused(&of(key, value), &["--trials", "0"]);
        assert!(found.contains(&format!("`{key}` is {value}, but must be")), "{found}");
    }
    for (key, value) in [("coverage_factor", 0.95), ("coverage_probability", 0.05)] {
        let mut wrong = of("k", 2.0);
        wrong[key] = json!(value);
        let found = refused(&wrong, &["--trials", "0"]);
        assert!(found.contains(&format!("`{key}` is {value}, but must be")), "{found}");
    }
}

/// Readings beside an estimate that is not their mean: 5.2 is 3.5 times s/sqrt(3) = 0.0577 above 5.
#[test]
fn readings_far_from_the_estimate_are_told() {
    let of = |values: Value| {
        let part = json!({"name": "rep", "distribution": "readings", "values": values});
        model(&json!({"x": {"unit": "V", "mean": 5, "components": [part]}}), "x", "V")
    };
    let codes = |values: Value| {
        let found = answer(&of(values), &["--trials", "0"]);
        assert_eq!(found["outputs"]["y"]["gum"]["estimate"], 5.0);
        let notes = found["warnings"].as_array().cloned().unwrap_or_default();
        notes.iter().map(|note| code(note).to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(codes(json!([5.1, 5.2, 5.3])), ["readings-apart"]);
    // also by a decimal point that slipped
    assert_eq!(codes(json!([0.51, 0.52, 0.53])), ["readings-apart"]);
    assert_eq!(codes(json!([51, 52, 53])), ["readings-apart"]);
    // within their scatter, and deviations about zero
    assert!(codes(json!([5.1, 5.0, 5.3])).is_empty());
    assert!(codes(json!([0.1, -0.1, 0.05])).is_empty());
}

/// A width that is a share of another quantity.
#[test]
fn a_width_may_be_a_formula() {
    let inputs = json!({"a": {"unit": "mA", "distribution": "normal", "mean": "current",
        "std": "0.01*current"}});
    let mut model = model(&inputs, "a", "mA");
    model["conditions"] = json!({"current": {"unit": "A", "values": [1, 2]}});
    let answer = answer(&model, &["--trials", "0"]);
    for (row, right) in [(0, 10.0), (1, 20.0)] {
        let u = &answer["rows"][row]["outputs"]["y"]["gum"]["standard_uncertainty"];
        assert!((u.as_f64().unwrap() - right).abs() < 1e-12, "{u}");
    }
}

/// A time stamp with u = 50 ns: numbers near 1.8e9 are 2^-22 s = 0.24 us apart, so the trials took two
/// values, U was 0, and the linear difference was called not linear.
#[test]
fn trials_of_a_staircase_are_refused() {
    let inputs = json!({"t": normal("s", 1_795_000_000.25, 5e-8)});
    let mut model = model(&inputs, "t - 1795000000 [s]", "us");
    // half a spacing is 2^-53 times 1.795e9 s, 0.20 us
    let said = refused(&model, &["--trials", "10000"]);
    assert!(said.contains("leave 2.0e-7 s of `t` undetermined"), "{said}");
    assert!(said.contains("it is 1795000000.25 s"), "{said}");
    let by_law = answer(&model, &["--trials", "0"]);
    assert_eq!(code(&by_law["warnings"][0]), "double-precision", "{by_law}");
    // 4 us: 5 % is the limit of what is evaluated, and more than 0.5 % is told
    model["inputs"]["t"]["std"] = 5e-6.into();
    let found = answer(&model, &["--trials", "10000"]);
    let u = found["outputs"]["y"]["monte_carlo"]["standard_uncertainty"].as_f64().unwrap();
    // 10,000 trials: a standard error of 0.035, of which five
    assert!((u - 5.0).abs() < 0.18, "{u}");
    assert!(found["warnings"].as_array().unwrap().iter().any(|of| code(of) == "double-precision"));
    // where only the slope at the estimate vanishes, nothing is lost: cos(1e-14 rad) with u = 0.01 rad
    let flat = self::model(&json!({"x": normal("rad", 1e-14, 0.01)}), "cos(x)", "1");
    let found = answer(&flat, &["--trials", "10000"]);
    assert!(found["warnings"].as_array().unwrap().iter().all(|of| code(of) != "double-precision"));
}

/// 1e-200 squared is 1e-400, which was 0 with u = 0 and valid.
#[test]
fn underflow_is_told() {
    let model = model(&json!({"a": normal("1", 1e-200, 1e-201)}), "a*a", "1");
    let answer = answer(&model, &["--trials", "1000"]);
    let codes: Vec<&str> = answer["warnings"].as_array().unwrap().iter().map(code).collect();
    assert!(codes.contains(&"underflow"), "{codes:?}");
}

/// The standard deviation of n normal trials has the relative standard deviation 1/sqrt(2(n - 1)), 0.35
/// of 5: three of five runs said that 2 a is not linear.
#[test]
fn few_trials_do_not_tell_that_a_model_is_not_linear() {
    let model = model(&json!({"a": normal("1", 2.0, 0.1)}), "2*a", "1");
    for trials in ["2", "5", "10", "30", "100"] {
        for seed in ["1", "2", "3", "4"] {
            let answer = answer(&model, &["--trials", trials, "--seed", seed]);
            let warnings = answer["warnings"].as_array().unwrap();
            assert!(warnings.iter().all(|of| code(of) != "non-linear"), "{trials} {seed}");
        }
    }
}

/// Three readings each: their t distributions have no variance, so the trials' coefficients were -0.2 to
/// -0.9 with the seed. By hand: s_a^2 = 1e-4, s_b^2 = 19/3 e-4, r = (s_a^2 - s_b^2)/(s_a^2 + s_b^2).
#[test]
fn outputs_without_variance_are_correlated_by_the_law_of_propagation() {
    let readings =
        |values: [f64; 3]| json!({"unit": "V", "distribution": "readings", "values": values});
    let model = json!({
        "inputs": {"a": readings([1.01, 1.03, 1.02]), "b": readings([2.01, 2.03, 2.06])},
        "equations": {"s": "a + b", "d": "a - b"},
        "outputs": {"s": {"unit": "V"}, "d": {"unit": "V"}}
    });
    let right = (1.0 - 19.0 / 3.0) / (1.0 + 19.0 / 3.0);
    for seed in ["1", "4"] {
        let answer = answer(&model, &["--trials", "10000", "--seed", seed]);
        let found = answer["output_correlations"][0][2].as_f64().unwrap();
        // rounding of doubles alone
        assert!((found - right).abs() < 1e-9, "{found} {right}");
        let codes: Vec<&str> = answer["warnings"].as_array().unwrap().iter().map(code).collect();
        assert!(codes.contains(&"correlations-by-propagation"), "{codes:?}");
    }
    let page = run(&model, &["--trials", "10000", "--full"]);
    assert!(String::from_utf8(page.stdout).unwrap().contains("-0.727"));
}

/// A phase of 179(2) deg lies on both sides of the cut: r of the trials was +0.76 where the law of
/// propagation has -1.
#[test]
fn a_phase_over_the_cut_is_correlated_by_the_law_of_propagation() {
    let model = json!({
        "inputs": {"p": normal("deg", 179.0, 2.0)},
        "equations": {"z": "atan2(sin(p), cos(p))", "w": "-p"},
        "outputs": {"z": {"unit": "deg"}, "w": {"unit": "deg"}}
    });
    let answer = answer(&model, &["--trials", "10000"]);
    let found = answer["output_correlations"][0][2].as_f64().unwrap();
    assert!((found + 1.0).abs() < 1e-9, "{found}");
}

/// Five readings of each of three paired quantities have no joint distribution with a covariance: a file
/// with `trials` of 0 was evaluated with any `--trials`.
#[test]
fn the_number_of_trials_of_the_command_line_does_not_pass_by_a_refusal() {
    let paired = |values: [f64; 5]| json!({"unit": "V", "distribution": "readings", "values": values, "paired": true});
    let mut model = model(
        &json!({"a": paired([5.007, 4.994, 5.005, 4.990, 4.999]),
            "b": paired([1.9663, 1.9639, 1.9640, 1.9685, 1.9678]),
            "c": paired([1.0456, 1.0438, 1.0468, 1.0428, 1.0433])}),
        "a + b + c",
        "V",
    );
    model["monte_carlo"] = json!({"trials": 0});
    assert!(run(&model, &[]).status.success());
    let said = refused(&model, &["--trials", "10000"]);
    assert!(said.contains("at least 6 are needed (JCGM 102, 5.3)"), "{said}");
}

/// Regions of few degrees of freedom had the factors of normal distributions: of two outputs of six paired
/// readings the ellipsoid of 95 % held 79 %. Right are quantiles of Hotelling's T^2 with the degrees of
/// freedom of the covariance matrix, from scipy 1.16 (of 400 000 simulated sets of five readings each the
/// ellipsoid holds 95.2 %, of four and ten readings, nu = 6.75, 95.5 %); the box is that of t quantiles.
#[test]
fn a_region_of_few_degrees_of_freedom_holds_what_it_says() {
    let a = [1.01, 1.03, 1.02, 0.99, 1.04, 1.00, 1.05, 1.02, 0.98, 1.01];
    let b = [2.01, 2.03, 2.06, 1.99, 2.04, 1.97, 2.05, 2.02, 2.07, 1.98];
    let region = |a: &[f64], b: &[f64], paired: bool| {
        let readings = |values: &[f64]| json!({"unit": "V", "distribution": "readings", "values": values, "paired": paired});
        let model = json!({
            "inputs": {"a": readings(a), "b": readings(b)},
            "equations": {"s": "a + b", "d": "a - b"},
            "outputs": {"s": {"unit": "V"}, "d": {"unit": "V"}},
            "regions": [{"outputs": ["s", "d"], "probability": 0.95}]
        });
        let page = String::from_utf8(run(&model, &["--trials", "0"]).stdout).unwrap();
        assert!(page.contains("Hotelling"), "{page}");
        answer(&model, &["--trials", "0"])["regions"][0]["gum"].clone()
    };
    for (of_a, of_b, paired, dof, k) in [
        (6, 6, true, 5.0, 4.166_614_906),
        (5, 5, false, 6.0, 3.726_489_515),
        (6, 6, false, 7.5, 3.464_234_881),
        (10, 10, true, 9.0, 3.167_441_041),
    ] {
        let gum = region(&a[..of_a], &b[..of_b], paired);
        let near = |key: &str, right: f64| {
            let found = gum[key].as_f64().unwrap();
            assert!((found / right - 1.0).abs() < 1e-6, "{of_a}, {of_b}, {paired}: {gum}");
        };
        near("dof", dof);
        near("ellipsoid_k", k);
    }
}

/// Rounding is no variation: the trials of outputs that do not depend on their input scatter in the last
/// bits, and had a kurtosis, correlations and a clause 8 that failed by 4e-16.
#[test]
fn rounding_is_no_variation() {
    for (formula, value) in [
        ("cos(phi)^2 + sin(phi)^2", 1.0),
        ("(phi + 3)^2 - phi^2 - 6*phi", 9.0),
        ("exp(phi)*exp(-phi)", 1.0),
        ("sqrt(phi^2 + 2*phi + 1) - phi", 1.0),
    ] {
        let model = json!({
            "inputs": {"s": {"distribution": "normal", "mean": 0.7, "std": 0.05}},
            "equations": {"phi": "pi/4*s", "y": formula, "z": "2*s"},
            "outputs": {"y": {}, "z": {}},
            "monte_carlo": {"trials": 20000}
        });
        let found = answer(&model, &["--seed", "1"]);
        let y = &found["outputs"]["y"];
        let of_trials = &y["monte_carlo"];
        assert_eq!(of_trials["standard_uncertainty"], 0.0, "{formula}: {y}");
        assert!(of_trials["excess_kurtosis"].is_null(), "{formula}: {y}");
        assert!((of_trials["estimate"].as_f64().unwrap() - value).abs() < 1e-14, "{formula}: {y}");
        assert_eq!(y["validation"]["gum_valid"], true, "{formula}: {y}");
        assert!(found["output_correlations"][0][2].is_null(), "{formula}: {found}");
    }
}
