//! Celsius temperatures, levels and empirical formulas through the whole: what they come to, and
//! what earlier versions said without a word.

use std::fs;
use std::path::Path;

use gumption::file::read_text;
use gumption::propagate::{Control, evaluate};
use gumption::task::Trials;
use serde_json::{Value, json};

use crate::support::{command, output};

/// Inputs of the formulas below; `std` is 0.1 in the unit unless said otherwise.
fn inputs() -> Value {
    let of = |unit: &str, mean: f64, std: f64| json!({"unit": unit, "distribution": "normal", "mean": mean, "std": std});
    json!({
        "t": of("degC", 20.0, 0.1),
        "t1": of("degC", 10.0, 0.1),
        "tf": of("degF", 68.0, 0.18),
        "T": of("K", 300.0, 0.1),
        "dT": of("K", 2.0, 0.1),
        "p": of("hPa", 1000.0, 1.0),
        "dp": of("kPa", 1.993, 0.0125),
        "p_a": of("kPa", 101.4, 1.05),
        "t_a": of("degC", 19.65, 0.11),
        "R_s": of("J/(kg*K)", 287.06, 1e-9),
        "A": of("1/degC", 3.9083e-3, 1e-12),
        "B": of("1/degC^2", -5.775e-7, 1e-15),
        "c": of("ppm/degC", 11.5, 1e-6),
        "alpha": of("1/K", 11.5e-6, 1e-12),
        "R0": of("ohm", 100.0, 1e-9),
        "R": of("ohm", 138.5055, 0.01),
        "S": of("uV/degC", 40.0, 1e-9),
        "L": of("mm", 100.0, 1e-6),
        "n": of("1", 0.5, 1e-9),
    })
}

/// Estimate and standard uncertainty of a formula in a unit.
fn value(formula: &str, unit: &str) -> Result<(f64, f64), String> {
    let text = json!({"inputs": inputs(), "equations": {"y": formula},
        "outputs": {"y": {"unit": unit}}})
    .to_string();
    let file = read_text("m.json", &text, Path::new(""), &[]).map_err(|e| format!("{e:?}"))?;
    let mut task = file.task;
    task.settings.trials = Trials::Fixed(0);
    let evaluation = evaluate(&task, &Control::default()).map_err(|e| e.to_string())?;
    let gum = evaluation.rows[0].outputs[0].gum.as_ref().ok_or("no derivative")?;
    Ok((gum.estimate, gum.standard_uncertainty))
}

/// Right formulas, their units, and their estimates worked out by hand or from the literature.
const RIGHT: &[(&str, &str, f64)] = &[
    ("t", "degC", 20.0),
    ("t", "degF", 68.0),
    ("tf", "degC", 20.0),
    ("(t + t1)/2", "degC", 15.0),
    ("0.25*t + 0.75*t1", "degC", 12.5),
    ("t - t1", "K", 10.0),
    ("t - t1", "degC", 10.0),
    ("t - t1", "degF", 18.0),
    ("t + dT", "degC", 22.0),
    ("t + n*(t1 - t)", "degC", 15.0),
    ("kelvin(t)", "K", 293.15),
    ("kelvin(tf)", "K", 293.15),
    ("celsius(T)", "degC", 26.85),
    ("celsius(T)", "degF", 80.33),
    ("kelvin((t + t1)/2) - kelvin(t1)", "K", 5.0),
    ("t/[degC]", "1", 20.0),
    ("t/[degF]", "1", 68.0),
    ("(t > 15 [degC])*L", "mm", 100.0),
    ("L*(1 + alpha*(t - 10 [degC]))", "mm", 100.0115),
    ("L*(1 + c*(t - t1))", "mm", 100.0115),
    ("S*t", "uV", 800.0),
    // IEC 60751: a Pt100 has 138.5055 ohm at 100 degC and 107.7935 ohm at 20 degC
    ("R0*(1 + A*t + B*t^2)", "ohm", 107.7935),
    ("(-A + sqrt(A^2 - 4*B*(1 - R/R0)))/(2*B)", "degC", 100.0),
    ("kelvin((-A + sqrt(A^2 - 4*B*(1 - R/R0)))/(2*B))", "K", 373.15),
    ("p/(R_s*kelvin(t))", "kg/m^3", 1.188331),
    // NIST TN 1900, E4
    ("sqrt(2*dp*R_s*kelvin(t_a)/p_a)", "m/s", 57.48),
    ("max(t, t1)", "degC", 20.0),
    ("-5 [degC] + dT", "degC", -3.0),
];

/// The wrong ones are files in `tests/errors`, whose messages are held there.
#[test]
fn wrong_formulas_of_celsius_temperatures() {
    let files = fs::read_dir(crate::support::root().join("tests/errors")).expect("a folder");
    let is_wrong = |name: &str| {
        (name.starts_with("celsius_") || name.starts_with("kelvin_")) && name.ends_with(".json")
    };
    let names = files.map(|entry| crate::support::file_name(&entry.expect("an entry").path()));
    assert!(names.filter(|name| is_wrong(name)).count() >= 20);
}

#[test]
fn right_formulas_of_celsius_temperatures() {
    assert!(RIGHT.len() >= 20);
    for (formula, unit, right) in RIGHT {
        let (estimate, u) = value(formula, unit).unwrap_or_else(|e| panic!("{formula}: {e}"));
        // the right-hand sides have five to seven digits
        assert!((estimate - right).abs() <= 2e-5 * right.abs(), "{formula}: {estimate} {unit}");
        assert!(u > 0.0 || formula.contains('>') || formula.contains("max"), "{formula}: {u}");
    }
    // a width knows no zero: 0.18 degF is 0.1 K
    let (_, u) = value("kelvin(tf)", "K").unwrap();
    assert!((u - 0.1).abs() < 1e-12);
    let (_, u) = value("sqrt(2*dp*R_s*kelvin(t_a)/p_a)", "m/s").unwrap();
    // NIST TN 1900, E4: u(v) = 0.35 m/s of its U; suncal 1.7.1 with these inputs: 0.35
    assert!((u - 0.35).abs() < 0.01, "{u}");
}

/// Writes files and runs the program on the first; what it says as JSON.
fn answered(files: &[(&str, Value)], arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in files {
        fs::write(folder.path().join(name), content.to_string()).expect("a file");
    }
    let (first, _) = files.first().expect("a file");
    let path = folder.path().join(first);
    let (word, rest) = arguments.split_first().expect("a command");
    let mut words = vec![*word, path.to_str().expect("a path"), "--format", "json", "--quiet"];
    words.extend(rest);
    serde_json::from_str(&output(&words)).expect("JSON")
}

fn estimate(answer: &Value) -> f64 {
    answer["outputs"]["y"]["gum"]["estimate"].as_f64().expect("a number")
}

/// The density of a gas from its temperature in K.
fn gas() -> Value {
    json!({"inputs": {
            "p": {"unit": "kPa", "distribution": "normal", "mean": 100, "std": 0.1},
            "R_s": {"unit": "J/(kg*K)", "distribution": "constant", "value": 287.06},
            "T": {"unit": "K", "distribution": "normal", "mean": 293.15, "std": 0.2}},
        "equations": {"y": "p/(R_s*T)"}, "outputs": {"y": {"unit": "kg/m^3"}}})
}

/// 100 kPa/(287.06 J/(kg K) * 293.15 K); earlier versions took 20 degC for 20 K: 17.418.
const DENSITY: f64 = 1.188331;

#[test]
fn values_in_degrees_celsius_for_an_input_in_kelvin() {
    let near = |found: f64| assert!((found - DENSITY).abs() < 1e-5, "{found}");
    let run = ["run", "--trials", "0", "--set"];
    for set in ["T=20 degC", "T=68 degF", "T=293150 mK"] {
        near(estimate(&answered(&[("m.json", gas())], &[&run[..], &[set]].concat())));
    }
    let mut text = gas();
    text["inputs"]["T"]["mean"] = "20 degC".into();
    near(estimate(&answered(&[("m.json", text)], &["run", "--trials", "0"])));
    let mut swept = gas();
    swept["inputs"]["T"]["mean"] = "T0".into();
    swept["conditions"] = json!({"T0": {"unit": "degC", "values": [20, "303.15 K", "86 degF"]}});
    let answer = answered(&[("m.json", swept)], &["run", "--trials", "0"]);
    for (row, right) in [(0, DENSITY), (1, 1.149132), (2, 1.149132)] {
        let found = answer["rows"][row]["outputs"]["y"]["gum"]["estimate"].as_f64().unwrap();
        assert!((found - right).abs() < 1e-5, "{found}");
    }
    let certificate = json!({"title": "Gas", "monte_carlo": {"trials": 0}, "rows": [
        {"model": "m.json", "output": "y", "set": {"T": "20 degC"}}]});
    let answer = answered(&[("c.json", certificate), ("m.json", gas())], &["certificate"]);
    let stated = answer.to_string();
    assert!(stated.contains("1.188"), "{stated}");
    assert!(!stated.contains("17.4"), "{stated}");

    let mut celsius = json!({"inputs": {"t": {"unit": "degC", "distribution": "normal", "mean": 20,
            "std": 0.1}}, "equations": {"y": "t"}, "outputs": {"y": {"unit": "degC"}}});
    let set = ["run", "--trials", "0", "--set", "t=300 K"];
    let found = estimate(&answered(&[("m.json", celsius.clone())], &set));
    assert!((found - 26.85).abs() < 1e-12, "{found}");
    celsius["inputs"]["t"]["mean"] = "t0".into();
    celsius["conditions"] = json!({"t0": {"unit": "K", "values": [300]}});
    let answer = answered(&[("m.json", celsius)], &["run", "--trials", "0"]);
    let found = answer["rows"][0]["outputs"]["y"]["gum"]["estimate"].as_f64().unwrap();
    assert!((found - 26.85).abs() < 1e-12, "{found}");
}

/// The air density of ISO/TR 20461 and the volume of a pipette; its formula is written for hPa, %
/// and degrees Celsius.
fn pipette(check: bool) -> Value {
    let air = if check {
        "(0.34848*p/[hPa] - 0.009*h/[%]*exp(0.061*t/[degC]))/(273.15 + t/[degC]) * 1 [kg/m^3]"
    } else {
        "(0.34848*p - 0.009*h*exp(0.061*t))/(273.15 + t)"
    };
    let volume = if check {
        "m/(rho_w - air)*(1 - air/8000 [kg/m^3])*(1 - g*(t - 20 [degC]))"
    } else {
        // mg over kg/m^3 is 1e-3 uL
        "1000*m/(rho_w - air)*(1 - air/8000)*(1 - g*(t - 20))"
    };
    json!({"format": 2, "check_units": check, "inputs": {
            "m": {"unit": "mg", "distribution": "normal", "mean": 996.36, "std": 0.01},
            "t": {"unit": "degC", "distribution": "normal", "mean": 20.5, "std": 0.1},
            "p": {"unit": "hPa", "distribution": "normal", "mean": 1005, "std": 1},
            "h": {"unit": "%", "distribution": "normal", "mean": 50, "std": 5},
            "rho_w": {"unit": "kg/m^3", "distribution": "normal", "mean": 998.2, "std": 0.01},
            "g": {"unit": "1/degC", "distribution": "constant", "value": 2.4e-4}},
        "equations": {"air": air, "y": volume}, "outputs": {"y": {"unit": "uL"}}})
}

#[test]
fn empirical_formulas_with_and_without_the_check_of_units() {
    // by hand: air = (350.2224 - 0.45*exp(1.2505))/293.65 = 1.187301 kg/m^3; earlier versions,
    // in Pa and shares, said 1116 uL for such a pipette
    let air = (0.34848 * 1005.0 - 0.009 * 50.0 * 3.492_088_6) / 293.65;
    let right = 996_360.0 / (998.2 - air) * (1.0 - air / 8000.0) * (1.0 - 2.4e-4 * 0.5);
    for check in [true, false] {
        let found = estimate(&answered(&[("m.json", pipette(check))], &["run", "--trials", "0"]));
        assert!((found / right - 1.0).abs() < 1e-6, "{check}: {found} {right}");
    }
}

/// ITS-90, type K, inverse polynomial of NIST Monograph 175 for 0 to 500 degC, in mV and degC.
#[test]
fn a_thermocouple_polynomial_without_the_check_of_units() {
    let polynomial = "25.08355*E + 7.860106e-2*E^2 - 2.503131e-1*E^3 + 8.315270e-2*E^4 \
                      - 1.228034e-2*E^5 + 9.804036e-4*E^6 - 4.413030e-5*E^7 + 1.057734e-6*E^8 \
                      - 1.052755e-8*E^9";
    let model = |check: bool, formula: &str| {
        json!({"check_units": check, "inputs": {"E": {"unit": "mV", "distribution": "normal",
                "mean": 4.096, "std": 0.001}}, "equations": {"y": formula},
            "outputs": {"y": {"unit": "degC"}}})
    };
    let answer = answered(&[("m.json", model(false, polynomial))], &["run", "--trials", "0"]);
    // the polynomial is within 0.05 degC of the reference function, which is 4.096 mV at 100 degC;
    // earlier versions took 0.004096 and said 0.103 degC
    assert!((estimate(&answer) - 100.0).abs() < 0.06, "{answer}");
    let note = &answer["warnings"][0];
    assert_eq!(note["code"], "units-not-checked-changed");
    assert!(note["text"].as_str().unwrap().starts_with("CHECK THIS RESULT"), "{note}");
    let checked = format!("({}) [degC]", polynomial.replace('E', "(E/[mV])"));
    let answer = answered(&[("m.json", model(true, &checked))], &["run", "--trials", "0"]);
    assert!((estimate(&answer) - 100.0).abs() < 0.06, "{answer}");
    assert_eq!(answer["warnings"], json!([]));
}

#[test]
fn the_note_of_unchecked_units_stands_on_every_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.json");
    fs::write(&path, pipette(false).to_string()).expect("a file");
    let path = path.to_str().expect("a path");
    for format in ["table", "json", "markdown", "latex", "html"] {
        let page = output(&["run", path, "--trials", "0", "--format", format]);
        let said = command().args(["run", path, "--trials", "0", "--format", format]).output();
        let said = String::from_utf8(said.expect("the program runs").stderr).expect("UTF-8");
        assert!(
            page.contains("units are not checked") || said.contains("units are not checked"),
            "{format}"
        );
    }
}

/// A thermistor of 10 kohm at 25 degC, by Steinhart and Hart.
#[test]
fn steinhart_hart_is_in_degrees_celsius() {
    let model = |formula: &str| {
        json!({"inputs": {"R": {"unit": "kohm", "distribution": "normal", "mean": 10, "std": 0.01}},
            "equations": {"x": "ln(R/[ohm])", "y": formula}, "outputs": {"y": {"unit": "degC"}}})
    };
    let kelvin = "1/(1.129148e-3 + 2.34125e-4*x + 8.76741e-8*x^3)";
    let right = model(&format!("celsius({kelvin} * 1 [K])"));
    let found = estimate(&answered(&[("m.json", right)], &["run", "--trials", "0"]));
    // the coefficients have seven digits; earlier versions said 298.150 degC
    assert!((found - 25.0).abs() < 0.005, "{found}");
    let text = model(&format!("{kelvin} * 1 [K]")).to_string();
    let errors = read_text("m.json", &text, Path::new(""), &[]).expect_err("kelvin in degC");
    assert!(format!("{errors:?}").contains("KelvinInCelsius"), "{errors:?}");
}

/// A ratio of 100 of two voltages is 40 dB; earlier versions said 100 dB.
#[test]
fn a_gain_in_decibels() {
    let model = |formula: &str, unit: &str| {
        json!({"inputs": {
                "u1": {"unit": "mV", "distribution": "normal", "mean": 10, "std": 0.01},
                "u2": {"unit": "V", "distribution": "normal", "mean": 1, "std": 0.001},
                "L": {"unit": "dB", "distribution": "normal", "mean": 40, "std": 0.1},
                "P": {"unit": "dBm", "distribution": "normal", "mean": 10, "std": 0.1}},
            "equations": {"y": formula}, "outputs": {"y": {"unit": unit}}})
    };
    for (formula, unit, right) in [
        ("20*log10(u2/u1)", "dB", 40.0),
        ("20*log10(u2/u1)", "Np", 4.605_170_185_988_092),
        ("u1*10^(L/20)", "V", 1.0),
        ("P + L", "dBm", 50.0),
        ("P + L", "dBW", 20.0),
        ("10^(P/10)*1 [mW]", "mW", 10.0),
        ("(P - 4 [dBm])/2", "dB", 3.0),
    ] {
        let answer = answered(&[("m.json", model(formula, unit))], &["run", "--trials", "0"]);
        let found = estimate(&answer);
        assert!((found - right).abs() < 1e-12 * right, "{formula}: {found}");
    }
}

/// With the check off a name is the number in its declared unit, and `kelvin`, `celsius` and a unit in
/// brackets below it know that; earlier versions added 273.15 to degrees Fahrenheit.
#[test]
fn temperatures_and_brackets_without_the_check_of_units() {
    let of = |unit: &str, mean: f64| json!({"unit": unit, "distribution": "normal", "mean": mean, "std": 0.18});
    let inputs = json!({"tf": of("degF", 68.0), "t": of("degC", 20.0), "T": of("K", 293.15),
        "m": of("mK", 293_150.0), "p": of("hPa", 1013.25), "h": of("%", 50.0)});
    for (formula, right, width) in [
        ("kelvin(tf)", 293.15, 0.1),
        ("kelvin(t)", 293.15, 0.18),
        ("kelvin(T)", 293.15, 0.18),
        ("kelvin(m)", 293.15, 0.00018),
        ("celsius(tf)", 20.0, 0.1),
        ("celsius(m)", 20.0, 0.00018),
        ("celsius(T)", 20.0, 0.18),
        ("tf/[degF]", 68.0, 0.18),
        ("tf/[degC]", 20.0, 0.1),
        ("t/[degC]", 20.0, 0.18),
        ("p/[hPa]", 1013.25, 0.18),
        ("p/[kPa]", 101.325, 0.018),
        ("h/[%]", 50.0, 0.18),
        ("h/[1]", 0.5, 0.0018),
        // the number of degrees Celsius, worked out
        ("kelvin((tf - 32)/1.8)", 293.15, 0.1),
    ] {
        let model = json!({"format": 2, "check_units": false, "inputs": inputs,
            "equations": {"y": formula}, "outputs": {"y": {"unit": "1"}}});
        let answer = answered(&[("m.json", model)], &["run", "--trials", "0"]);
        let gum = &answer["outputs"]["y"]["gum"];
        let (y, u) = (gum["estimate"].as_f64(), gum["standard_uncertainty"].as_f64());
        assert!((y.unwrap() / right - 1.0).abs() < 1e-12, "{formula}: {y:?}");
        assert!((u.unwrap() / width - 1.0).abs() < 1e-12, "{formula}: {u:?}");
    }
}

/// Path loss with an exponent n that has an uncertainty: 10 n lg(d/d0) = 10*2.7*2 = 54 dB.
#[test]
fn a_level_with_an_uncertain_factor() {
    let inputs = json!({
        "n": {"unit": "1", "distribution": "normal", "mean": 2.7, "std": 0.1},
        "d": {"unit": "m", "distribution": "constant", "value": 100}});
    for formula in ["10*n*log10(d/[m])", "n*10*log10(d/[m])", "10*log10(d/[m])*n"] {
        let model = json!({"inputs": inputs, "equations": {"y": formula},
            "outputs": {"y": {"unit": "dB"}}});
        let answer = answered(&[("m.json", model)], &["run", "--trials", "0"]);
        assert!((estimate(&answer) - 54.0).abs() < 1e-12, "{formula}");
        let u = answer["outputs"]["y"]["gum"]["standard_uncertainty"].as_f64().unwrap();
        assert!((u - 2.0).abs() < 1e-12, "{formula}: {u}");
    }
}

/// Units of the file's own in products, quotients and powers, and in every place of a value.
#[test]
fn units_of_a_files_own_in_products() {
    let model = json!({"units": {"HBW": "1", "tex": "1e-6*kg/m"},
        "inputs": {
            "h": {"unit": "HBW", "distribution": "normal", "mean": "250 HBW", "std": "0.4 % + 1 HBW"},
            "s": {"unit": "MPa/HBW", "distribution": "normal", "mean": "3.4 N/(mm^2 HBW)", "std": "10 kPa/HBW"},
            "q": "4.0(1) 1/HBW^2",
            "f": {"unit": "cN/tex", "distribution": "gamma", "shape": 4, "rate": "0.2 tex/cN"},
            "yarn": {"unit": "kg/m", "distribution": "samples", "values": ["20 tex", "2.02e-5 kg/m", 1.98e-5]}},
        "conditions": {"x": {"unit": "tex/HBW", "values": ["1e-6 kg/m/HBW", 2]}},
        "equations": {"y": "h*s", "n": "q*h^2 + h/[HBW]", "w": "f*yarn", "z": "x*h"},
        "outputs": {"y": {"unit": "MPa"}, "n": {"unit": "1"}, "w": {"unit": "cN"},
            "z": {"unit": "tex"}}});
    let answer = answered(&[("m.json", model.clone())], &["run", "--trials", "0"]);
    for (output, right) in [("y", 850.0), ("n", 250_250.0), ("w", 400.0), ("z", 250.0)] {
        let found = answer["rows"][0]["outputs"][output]["gum"]["estimate"].as_f64().unwrap();
        assert!((found / right - 1.0).abs() < 1e-12, "{output}: {found}");
    }
    let found = answer["rows"][1]["outputs"]["z"]["gum"]["estimate"].as_f64().unwrap();
    assert!((found / 500.0 - 1.0).abs() < 1e-12, "{found}");
    let arguments = ["run", "--trials", "0", "--set", "s=3400 kPa/HBW", "--set", "x=5 tex/HBW"];
    let answer = answered(&[("m.json", model)], &arguments);
    assert_eq!(answer["rows"].as_array().map(Vec::len), Some(1));
    let found = answer["rows"][0]["outputs"]["z"]["gum"]["estimate"].as_f64().unwrap();
    assert!((found / 1250.0 - 1.0).abs() < 1e-12, "{found}");
}

/// A value with a unit is taken wherever a value is; texts give the same as numbers in the unit.
#[test]
fn values_with_units_in_every_place() {
    let model = |values: Value, evidence: Value, rate: Value, pooled: Value, period: Value| {
        json!({"inputs": {
                "a": {"unit": "mV", "distribution": "samples", "values": values},
                "b": {"unit": "mV", "distribution": "rectangular", "mean": 5, "half_width": 1,
                    "evidence": {"values": evidence}},
                "c": {"unit": "ms", "distribution": "gamma", "shape": 4, "rate": rate},
                "d": {"unit": "mV", "distribution": "readings", "values": [1, 2, 3],
                    "pooled": {"std": pooled, "dof": 20}}},
            "equations": {"y": "a + b + d", "z": "c", "p": "a/[mV]*1 [deg]"},
            "outputs": {"y": {"unit": "mV"}, "z": {"unit": "ms"},
                "p": {"unit": "deg", "periodic": period}}})
    };
    let numbers = model(
        json!([1, 2, 3.5]),
        json!([4.5, 5, 5.5, 4.8, 5.1, 4.9, 5.3, 4.6]),
        json!(0.5),
        json!(0.2),
        json!(360),
    );
    let texts = model(
        json!(["1 mV", "2e-3 V", "3500 uV"]),
        json!(["4.5 mV", "5e-3 V", 5.5, 4.8, 5.1, "4900 uV", 5.3, 4.6]),
        json!("500 1/s"),
        json!("200 uV"),
        json!("1 rev"),
    );
    for arguments in [&["run", "--trials", "20000"][..], &["assumptions", "--trials", "20000"]] {
        let [mut a, mut b] =
            [&numbers, &texts].map(|model| answered(&[("m.json", model.clone())], arguments));
        for answer in [&mut a, &mut b] {
            answer["provenance"]["model_sha256"] = Value::Null;
        }
        assert_eq!(a, b);
    }
}

/// Hardness numbers and the like are plain numbers with a name.
#[test]
fn units_of_a_files_own() {
    let model = json!({"units": {"HBW": "1", "tex": "1e-6*kg/m"}, "inputs": {
            "h": {"unit": "HBW", "distribution": "normal", "mean": "250 HBW", "std": "2 HBW"},
            "yarn": {"unit": "tex", "distribution": "normal", "mean": 20, "std": 0.1},
            "L": {"unit": "km", "distribution": "constant", "value": 1}},
        "equations": {"y": "h + 5", "m": "yarn*L"},
        "outputs": {"y": {"unit": "HBW"}, "m": {"unit": "g"}}});
    let answer = answered(&[("m.json", model.clone())], &["run", "--trials", "0"]);
    assert_eq!(estimate(&answer), 255.0);
    assert_eq!(answer["outputs"]["y"]["unit"], "HBW");
    // 20 tex are 20 g/km
    let mass = answer["outputs"]["m"]["gum"]["estimate"].as_f64().unwrap();
    assert!((mass - 20.0).abs() < 1e-12, "{mass}");
    for (name, said) in [("mm", "there is a unit of that name"), ("H B", "letters, digits")] {
        let mut wrong = model.clone();
        wrong["units"][name] = "1".into();
        let errors = read_text("m.json", &wrong.to_string(), Path::new(""), &[]);
        let errors = errors.expect_err(name).to_string();
        assert!(errors.contains(said), "{errors}");
    }
}

/// Limits of a deviation in degC or degF that are formulas in K are differences, those of a temperature are
/// temperatures, and what may be both or is the other is refused.
#[test]
fn limits_of_deviations_and_of_temperatures() {
    let limits = |unit: &str, equation: &str, lower: &str| {
        let text = json!({
            "conditions": {"t": {"unit": unit, "values": [50, 150]}},
            "inputs": {"x": {"unit": unit, "distribution": "normal", "mean": "t - 5 [K]", "std": 0.1}},
            "equations": {"e": equation},
            "outputs": {"e": {"unit": unit, "tolerance": {"lower": lower}}}
        });
        let file = read_text("m.json", &text.to_string(), Path::new(""), &[]);
        let output = file.map_err(|e| format!("{e:?}"))?.task.model.outputs[0].clone();
        let lower = output.following.as_ref().and_then(|of| of.lower.clone()).expect("a formula");
        assert_eq!(output.tolerance.unwrap().lower, Some(lower.at(&[50.0])));
        Ok::<[f64; 2], String>([50.0, 150.0].map(|t| lower.at(&[t])))
    };
    let deviation = "-(0.3 + 0.005*t/[degC])*1 [K]";
    assert_eq!(limits("degC", "x - t", deviation), Ok([-0.55, -1.05]));
    assert_eq!(limits("degC", "x - t", "0.5*(t - 150 [degC])"), Ok([-50.0, 0.0]));
    // a difference of one degree Fahrenheit for each of them
    assert_eq!(limits("degF", "x - t", "0.01*(t - 20 [degF])"), Ok([0.3, 1.3]));
    assert_eq!(limits("degF", "x - t", "-1 [K]*(t/[degF])/50"), Ok([-1.8, -5.4]));
    assert_eq!(limits("degC", "x", "t - 2 [K]"), Ok([48.0, 148.0]));
    assert_eq!(limits("degF", "x", "t - 5 [K]"), Ok([41.0, 141.0]));
    let refused = |equation: &str, lower: &str, said: &str| {
        let found = limits("degC", equation, lower).unwrap_err();
        assert!(found.contains(said), "{found}");
    };
    refused("x - t", "t - 2 [K]", "it is a temperature, and `e` is a difference of temperatures");
    refused("x", "t - 2 [degC]", "it is a difference of temperatures, and `e` is a temperature");
    refused(
        "x",
        "(2 + t/[degC])*1 [K]",
        "it is in K, and may be a difference, and `e` is a temperature",
    );
}

/// What is as large as a thermodynamic temperature is no correction of a Celsius temperature.
#[test]
fn reference_temperatures_in_kelvin_are_no_corrections() {
    let length = |reference: (&str, f64), formula: &str| {
        let (unit, value) = reference;
        let text = json!({
            "inputs": {
                "L": {"unit": "mm", "distribution": "normal", "mean": 100, "std": 0.001},
                "al": {"unit": "ppm/degC", "distribution": "normal", "mean": 11.5, "std": 0.1},
                "t": {"unit": "degC", "distribution": "normal", "mean": 25, "std": 0.1},
                "t0": {"unit": unit, "distribution": "constant", "value": value}
            },
            "equations": {"L0": formula}, "outputs": {"L0": {"unit": "mm"}}
        });
        let file = read_text("m.json", &text.to_string(), Path::new(""), &[]);
        let mut task = file.map_err(|e| format!("{e:?}"))?.task;
        task.settings.trials = Trials::Fixed(0);
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        Ok::<f64, String>(evaluation.rows[0].outputs[0].gum.as_ref().unwrap().estimate)
    };
    let right = 100.0 * (1.0 - 11.5e-6 * 5.0);
    let found = length(("degC", 20.0), "L*(1 - al*(t - t0))").unwrap();
    assert!((found - right).abs() < 1e-9, "{found}");
    let found = length(("K", 293.15), "L*(1 - al*(kelvin(t) - t0))").unwrap();
    assert!((found - right).abs() < 1e-9, "{found}");
    let found = length(("K", 293.15), "L*(1 - al*(t - t0))").unwrap_err();
    assert!(found.contains("DifferentZeros"), "{found}");
    // a correction of 20 K is one
    assert!(length(("K", 20.0), "L*(1 - al*(t - t0))").is_ok());
}
