//! Notes on what is right by the rules and seldom meant, and files of the same kind without one.

use std::path::Path;

use gumption::file::check_text;
use serde_json::{Value, json};

/// Codes of the notes on a file that has no mistake.
fn codes(file: &Value) -> Vec<&'static str> {
    let notes = check_text("m.json", &file.to_string(), Path::new(""));
    notes
        .unwrap_or_else(|faults| panic!("{file}\n{faults}"))
        .iter()
        .map(|note| note.code())
        .collect()
}

fn normal(unit: &str, mean: f64) -> Value {
    json!({"unit": unit, "distribution": "normal", "mean": mean, "std": 0.1})
}

fn of(unit: &str, formula: &str, unit_of_result: &str) -> Value {
    json!({"inputs": {"x": normal(unit, 5.0)}, "equations": {"y": formula},
        "outputs": {"y": {"unit": unit_of_result}}})
}

/// A share that is converted to the unit of its output is an error, as no meaning of the formula gives the
/// result; the same without the factor, or without the unit, is none.
#[test]
fn shares_that_are_converted_twice() {
    for (unit, formula, result) in [
        ("%", "100/x", "%"),
        ("1", "(x - 2)/2*100", "%"),
        ("1", "1e6*(x - 2)", "ppm"),
        ("%", "1e4*x", "ppm"),
        ("1", "(x - 2)/2*1e6 + x", "ppm"),
        ("1", "100*x/x - 100", "%"),
        ("1", "-max(100*(x - 1)/x, 0)", "%"),
        ("1", "if(x > 2, 100*(x - 1)/x, 0)", "%"),
        ("1", "mean(100*(x - 1)/x, x)", "%"),
        ("1", "2*(100*(x - 1)/x)", "%"),
        ("V", "(x - 2 [V])/(5 [V])*100", "%"),
        ("V", "(x - 2 [V])/(5 [V]/100)", "%"),
        ("V", "1e6*(x - 2 [V])/(5 [V])", "ppm"),
    ] {
        let file = of(unit, formula, result);
        let faults = check_text("m.json", &file.to_string(), Path::new("")).unwrap_err();
        let message = faults.to_string();
        assert!(message.contains("leave the factor out"), "{formula} in {result}: {message}");
    }
    for (formula, result) in [("(x - 2 [V])/(5 [V])", "%"), ("(x - 2 [V])/(5 [V])*100", "1")] {
        assert_eq!(codes(&of("V", formula, result)), Vec::<&str>::new(), "{formula}");
    }
    for equation in ["b - x", "mean(b, b)"] {
        let file = json!({"inputs": {"x": normal("1", 5.0)},
            "equations": {"b": "(x - 2)/2*1e6", "y": equation}, "outputs": {"y": {"unit": "ppm"}}});
        let faults = check_text("m.json", &file.to_string(), Path::new("")).unwrap_err();
        assert!(faults.to_string().contains("the output `y`"), "{equation}: {faults}");
    }
    let file = json!({"inputs": {"x": normal("V", 5.0), "k": {"value": 100}},
        "equations": {"r": "x/(5 [V])*100", "y": "r + 0.1 [%]", "z": "k*x/(5 [V])"},
        "outputs": {"y": {"unit": "%"}, "z": {"unit": "%"}}});
    let faults = check_text("m.json", &file.to_string(), Path::new("")).unwrap_err().to_string();
    assert!(faults.contains("the output `y`") && !faults.contains("`z`"), "{faults}");
}

#[test]
fn formulas() {
    for (unit, formula, result, wanted) in [
        ("deg", "x + 90", "deg", Some("bare-number")),
        ("deg", "90 - 2*x", "deg", Some("bare-number")),
        ("deg", "if(x > 45, x, 0)", "deg", Some("bare-number")),
        ("%", "x + 2", "%", Some("bare-number")),
        ("ppm", "x - 10", "ppm", Some("bare-number")),
        ("deg", "x + 90 [deg]", "deg", None),
        ("%", "1 + x", "1", None),
        ("%", "x + 2 [%]", "%", None),
        ("%", "if(x > 0, x, 0)", "%", None),
        ("rad", "x + 1.5", "rad", None),
        ("deg", "pi/4 + x", "deg", None),
        ("deg", "1 - 2*x", "1", None),
        ("1", "x + 90", "1", None),
        ("deg", "sin(x*pi/180)", "1", Some("angle-converted-twice")),
        ("deg", "sin(x/180*pi)", "1", Some("angle-converted-twice")),
        ("deg", "sin(0.0174533*x)", "1", Some("angle-converted-twice")),
        ("%", "1 + x/100", "1", Some("share-converted-twice")),
        ("ppm", "1 + x*1e-6", "1", Some("share-converted-twice")),
        ("%", "1 + x/2", "1", None),
        ("%", "2 [V]*100/x", "V", Some("share-converted-twice")),
        ("%", "2 [V]*(100/x)", "V", Some("share-converted-twice")),
        ("%", "2 [V]/x*100", "V", Some("share-converted-twice")),
        ("%", "2 [V]*10^2/x", "V", Some("share-converted-twice")),
        ("ppm", "1e6*(2 [V])/x", "V", Some("share-converted-twice")),
        ("‰", "(2 [V])*1000/x", "V", Some("share-converted-twice")),
        ("%", "100*sqrt(4 [V^2])/x", "V", Some("share-converted-twice")),
        ("deg", "180/pi/x", "1", Some("angle-converted-twice")),
        ("1", "x/(3 [V])*(2 [V])*1000", "mV/V", Some("result-converted-twice")),
        ("1", "x*1000", "V/V", None),
        ("1", "cos(x)", "1", None),
        ("1", "cos(x + 1)", "1", None),
        // the factor may be meant for the result: one note
        ("%", "2 [V]/x", "V", None),
        ("%", "50 [V]/x", "V", None),
        ("1", "2 [V]*100/x", "V", None),
        ("%", "sqrt(x^2 + 3^2)", "%", Some("bare-number")),
        ("%", "sqrt(9 + (2*x)^2)", "%", Some("bare-number")),
        ("%", "sqrt(x^2 + (3 [%])^2)", "%", None),
        ("%", "sqrt(1 + x^2)", "1", None),
        ("%", "hypot(x, 3)", "%", Some("bare-number")),
        ("%", "min(x, 100)", "%", Some("bare-number")),
        ("deg", "max(x, 30)", "deg", Some("bare-number")),
        ("%", "min(x, 1)", "%", None),
        ("%", "max(x, 0.01)", "%", None),
        ("1", "min(x, 100)", "1", None),
        ("1", "1 + x/100", "1", None),
        ("deg", "sin(2*x)", "1", None),
        ("1", "sin(x*pi/180)", "1", None),
        ("deg", "x*180/pi", "1", None),
        ("deg", "sin(x [deg])", "1", Some("angle-converted-twice")),
        ("%", "2 [V]*x/100", "V", Some("share-converted-twice")),
        ("%", "2 [V]/100*x", "V", Some("share-converted-twice")),
        ("%", "200 [V]*x", "V", None),
        ("%", "100 [V]*x + 1 [V]", "V", None),
        ("rpm", "2 [N*m]*2*pi*x", "W", Some("rate-converted-twice")),
        ("rpm", "2 [N*m]*2*pi*x/60", "W", Some("rate-converted-twice")),
        ("rpm", "2 [N*m]*x", "W", None),
        ("1", "atan(x)*180/pi", "deg", Some("result-converted-twice")),
        ("1", "x*100", "1", None),
        ("1", "x*100 [%]", "%", None),
        ("1", "x/100", "%", None),
        ("1", "sin(30)*x", "1", Some("angle-of-turns")),
        ("dBm", "x + x", "dBm", Some("sum-of-levels")),
        ("dBm", "2*x", "dBm", Some("sum-of-levels")),
        ("dBm", "(x + x)/2", "dBm", None),
        ("dBm", "x + 3 [dB]", "dBm", None),
        ("dBm", "x - 10*log10(2 [mW]/[mW])", "dBm", None),
        ("dBm", "10*log10(10^(x/10) + 10^(x/10))", "dBm", None),
        ("1/min", "x", "rpm", Some("rate-of-turns")),
        ("1/min", "x*[rev]", "rpm", None),
        ("rpm", "x", "rpm", None),
        ("rpm", "x", "1/min", Some("radians-of-turns")),
        ("rpm", "x/[rev]", "1/min", None),
        ("rpm", "2 [m/min]/x", "mm", Some("radians-of-turns")),
        ("rpm", "2 [m/min]/x*[rev]", "mm", None),
        ("rpm", "2 [m/min]/x", "mm/rev", None),
        ("rpm", "2 [kW]/x", "N*m", None),
        ("rad/s", "2 [m/s]/x", "m", None),
        ("rad", "x", "1", None),
        ("1/min", "x", "1/min", None),
        // what is moved in a revolution, and the way of a circumference
        ("rpm", "10 [cm^3]*x", "L/min", Some("radians-of-turns")),
        ("rpm", "0.9*x*2 [g]", "kg/min", Some("radians-of-turns")),
        ("rpm", "2 [mol]*x", "mol/s", Some("radians-of-turns")),
        ("rpm", "2 [A*s]*x", "A", Some("radians-of-turns")),
        ("rpm", "800 [kg/m^3]*10 [cm^3]*x", "kg/s", Some("radians-of-turns")),
        ("rpm", "10 [cm^3]*x + 1 [L/min]", "L/min", Some("radians-of-turns")),
        ("rev/s", "pi*20 [mm]*x", "m/s", Some("radians-of-turns")),
        ("rpm", "pi*20 [m]*x/1000", "m/s", Some("radians-of-turns")),
        ("rpm", "10 [cm^3]*x/[rev]", "L/min", None),
        ("rpm", "10 [cm^3/rev]*x", "L/min", None),
        ("rpm", "10 [cm^3]*x/(2*pi)", "L/min", None),
        ("rpm", "pi*20 [mm]*x/[rev]", "m/s", None),
        ("rad/s", "10 [cm^3]*x", "L/min", None),
        ("1/min", "10 [cm^3]*x", "L/min", None),
        ("rpm", "10 [mm]*x", "m/s", None),
        ("rpm", "0.1 [mm/rev]*x", "mm/min", None),
        ("rpm", "2 [mm]*3 [mm^2]*x", "L/min", None),
        ("rpm", "2 [kg]*x", "N*s/m", None),
        ("rpm", "2*x*20 [mm]/pi", "m/s", None),
        ("rpm", "9550*2 [W]/x", "N*m", Some("rate-converted-twice")),
        ("rpm", "2 [N*m]*x/9550", "W", Some("rate-converted-twice")),
        ("rpm", "6*x", "deg/s", Some("result-converted-twice")),
        ("rpm", "2*x", "deg/s", None),
        ("deg", "3600*x", "arcsec", Some("result-converted-twice")),
        ("deg", "x*60", "arcmin", Some("result-converted-twice")),
        ("deg", "x*10", "arcmin", None),
        // the terms of a sum, and what a function takes
        ("1", "100*x/x - 100", "1", None),
        ("V", "(x - 2 [V])/(2 [V])*1e4", "ppm", Some("result-converted-twice")),
        ("V", "(x - (2 [V]))/x*1e4", "ppm", Some("result-converted-twice")),
        ("1", "2*(atan(x)*180/pi)", "deg", Some("result-converted-twice")),
        ("1", "atan(x)*180/pi + 2*x", "deg", Some("result-converted-twice")),
        ("1", "sin(atan(x)*180/pi)", "1", Some("angle-converted-twice")),
        ("1", "sin(atan(x)*180/pi*pi/180)", "1", None),
        ("1", "100*x + 0.02*x^2", "%", None),
        ("1", "0.01*100*(x - 1)/x", "1", None),
        // functions that give angles, and functions of what is in a unit
        ("1", "90 - atan(x)", "deg", Some("bare-number")),
        ("1", "cos(90 - atan(x))", "1", Some("bare-number")),
        ("1", "atan(x) + 0.5", "deg", Some("bare-number")),
        ("1", "atan(x) + 0.5", "rad", None),
        ("1", "atan(x) + pi", "deg", None),
        ("1", "sin(atan(x) + 0.5)", "1", None),
        ("1", "90 - atan(x)*180/pi", "1", None),
        ("1", "90 - atan(x)/[deg]", "1", None),
        ("deg", "90 - x*180/pi", "1", None),
        ("%", "100*x + 5", "1", None),
        ("deg", "abs(x) + 10", "deg", Some("bare-number")),
        ("deg", "max(x, 2*x) + 10", "deg", Some("bare-number")),
        ("deg", "if(x > 0, x, 10)", "deg", Some("bare-number")),
        ("%", "(1 + x) + 2", "1", None),
        ("%", "min(1 + x, 5)", "1", None),
        ("deg", "mod(x, 360)", "deg", Some("bare-number")),
        ("deg", "mod(x, 2*pi)", "deg", None),
        ("deg", "mod(x, 6.28319)", "deg", None),
        ("deg", "mod(x, 360 [deg])", "deg", None),
        ("1", "mod(x, 360)", "1", None),
        ("deg", "round(x)", "deg", Some("rounded-as-number")),
        ("deg", "floor(10*x)/10", "deg", Some("rounded-as-number")),
        ("%", "ceil(x)", "%", Some("rounded-as-number")),
        ("1", "round(atan(x))", "deg", Some("rounded-as-number")),
        ("deg", "round(x/[deg])*[deg]", "deg", None),
        ("deg", "round(x*180/pi)", "1", None),
        ("%", "floor(1000*x)/1000", "%", None),
        ("1", "round(x)", "1", None),
        ("rad", "round(x)", "rad", None),
        // periods are no radians
        ("Hz", "sin(x*2 [s])", "1", Some("periods-as-radians")),
        ("Hz", "cos(3*x*2 [s])", "1", Some("periods-as-radians")),
        ("Hz", "sin(2*pi*x*2 [s])", "1", None),
        ("Hz", "sin(6.2832*x*2 [s])", "1", None),
        ("Hz", "sin(x*[rev]*2 [s])", "1", None),
        ("Hz", "sin(x/(3 [Hz]))", "1", None),
        ("Hz", "exp(-x*2 [s])", "1", None),
        ("rad/s", "sin(x*2 [s])", "1", None),
        ("1/s", "sin(x*2 [s])", "1", None),
        ("pH", "x", "pH", Some("picohenry")),
        ("nH", "x", "nH", None),
    ] {
        let found = codes(&of(unit, formula, result));
        assert_eq!(found, Vec::from_iter(wanted), "{formula} of {unit} in {result}");
    }
    // 30 without a unit is in radians
    for (unit, formula, wanted) in [
        ("1", "cos(x)*1 [N]", Some("angle-of-turns")),
        ("1", "cos(x/30)*1 [N]", None),
        ("deg", "cos(x)*1 [N]", None),
        ("rad", "cos(x)*1 [N]", None),
    ] {
        let mut file = of(unit, formula, "N");
        file["inputs"]["x"]["mean"] = json!(30);
        assert_eq!(codes(&file), Vec::from_iter(wanted), "{formula} of 30 {unit}");
    }
    // numbers in their own units are meant so
    let mut unchecked = of("deg", "sin((x + 90)*pi/180)", "1");
    unchecked["check_units"] = json!(false);
    assert_eq!(codes(&unchecked), ["units-not-checked-changed"]);
}

/// What an equation computes has the unit of what it is computed from, and is converted by the unit of
/// an output that it is a term of.
#[test]
fn formulas_of_several_equations() {
    for (unit, equations, result, wanted) in [
        ("deg", [("b", "2*x"), ("y", "b + 10")], "deg", Some(("bare-number", "y"))),
        ("1", [("b", "atan(x)"), ("y", "90 - b")], "deg", Some(("bare-number", "y"))),
        ("1", [("b", "atan(x)*180/pi"), ("y", "90 - b")], "1", None),
        (
            "1",
            [("b", "atan(x)*180/pi"), ("y", "sin(b)")],
            "1",
            Some(("angle-converted-twice", "y")),
        ),
        ("1", [("b", "atan(x)*180/pi"), ("y", "sin(b*pi/180)")], "1", None),
        ("%", [("b", "1 + x"), ("y", "b + 2")], "1", None),
        ("%", [("b", "100*x"), ("y", "b + 2")], "1", None),
        ("1", [("b", "(x - 2)/2*1e6"), ("y", "b/1e6")], "ppm", None),
        ("1", [("b", "(x - 2)/2*1e6"), ("y", "b - x")], "1", None),
        ("1", [("b", "(x - 2)/2*1e6"), ("y", "b [ppm]")], "ppm", None),
        ("rpm", [("b", "10 [cm^3]*x"), ("y", "0.9*b")], "L/min", Some(("radians-of-turns", "b"))),
        ("rpm", [("b", "10 [cm^3]*x"), ("y", "b/[rev]")], "L/min", None),
        (
            "rpm",
            [("b", "pi*(20 [mm])^2*5 [mm]"), ("y", "b*x")],
            "L/min",
            Some(("radians-of-turns", "y")),
        ),
        ("rpm", [("r", "0.5*20 [mm]"), ("y", "2 [N*m]*r/(2*pi*x*r^3*3 [mm])")], "mPa*s", None),
        (
            "rpm",
            [("r", "0.5*20 [mm]"), ("y", "2 [N]*r*2*pi*x")],
            "W",
            Some(("rate-converted-twice", "y")),
        ),
        ("Hz", [("k", "2*pi*2 [s]"), ("y", "sin(k*x)")], "1", None),
    ] {
        let file = json!({"inputs": {"x": normal(unit, 5.0)},
            "equations": serde_json::Map::from_iter(
                equations.map(|(name, formula)| (name.to_owned(), json!(formula)))),
            "outputs": {"y": {"unit": result}}});
        let notes = check_text("m.json", &file.to_string(), Path::new(""));
        let notes = notes.unwrap_or_else(|faults| panic!("{file}\n{faults}"));
        let found: Vec<_> = notes.iter().map(|note| (note.code(), note.place.as_str())).collect();
        assert_eq!(found, Vec::from_iter(wanted), "{file}");
    }
}

/// A rotational viscometer, whose 2 pi is that of its cylinder.
#[test]
fn area_of_a_cylinder() {
    for formula in ["T*a/(2*pi*R^3*L*n)", "T*a/(2*pi*n*R^3*L)", "T/(2*pi*n*R*R*L)*(a/R)"] {
        let file = json!({
            "inputs": {"T": normal("uN*m", 15.0), "n": normal("rpm", 60.0), "R": normal("mm", 12.5),
                "a": normal("mm", 0.5), "L": normal("mm", 37.5)},
            "equations": {"eta": formula}, "outputs": {"eta": {"unit": "mPa*s"}}});
        assert_eq!(codes(&file), Vec::<&str>::new(), "{formula}");
    }
}

/// A level that its formula puts above 1 uV is none above 1 V.
#[test]
fn levels_have_the_reference_of_their_formula() {
    for (unit, formula, result, right) in [
        ("uV", "20*log10(x/[uV])", "dBuV", true),
        ("uV", "20*log10(x/[uV])", "dB", true),
        ("uV", "20*log10(x/[uV])", "dBV", false),
        ("uV", "20*log10(x/1 [uV]) + 3 [dB]", "dBmV", false),
        ("W", "10*log10(x/[mW])", "dBm", true),
        ("W", "10*log10(x/[mW])", "dBW", false),
        ("V", "20*log10(x/1 [V])", "dBV", true),
        ("uV", "20*log10(x/[uV]) - 20*log10(2 [V]/[V])", "dB", true),
    ] {
        let found = check_text("m.json", &of(unit, formula, result).to_string(), Path::new(""));
        match found {
            Ok(_) => assert!(right, "{formula} in {result}"),
            Err(faults) => {
                assert!(!right, "{formula} in {result}: {faults}");
                assert!(faults.to_string().contains("write the reference out"), "{faults}");
            }
        }
    }
}

#[test]
fn inputs_and_correlations() {
    // one part of a complex input is use enough
    let mut file = json!({
        "inputs": {"a": normal("V", 1.0), "b": normal("V", 1.0), "unused": normal("V", 0.0),
            "Z": {"unit": "ohm", "complex": {"re": normal("ohm", 1.0), "im": normal("ohm", 2.0)}}},
        "equations": {"y": "a + b", "z": "abs(Z)"},
        "outputs": {"y": {"unit": "V"}, "z": {"unit": "ohm"}},
        "correlations": [["a", "b", 0.5]]
    });
    assert_eq!(codes(&file), ["unused-input"]);
    file["equations"]["y"] = json!("a + b + unused");
    assert_eq!(codes(&file), Vec::<&str>::new());
    file["inputs"]["b"] = json!({"unit": "V", "distribution": "constant", "value": 1});
    assert_eq!(codes(&file), ["correlation-with-constant"]);
    // what `new` wrote before it wrote nothing
    file["inputs"]["a"]["about"] = json!("where this is known from");
    assert_eq!(codes(&file), ["correlation-with-constant", "placeholder-about"]);
}

/// A calibration function outside of its points; a little beyond them is common.
#[test]
fn curves_beyond_their_points() {
    for (formula, unit, x, wanted) in [
        ("line(x)", "mm", 3.0, false),
        ("line(x)", "mm", 6.4, false),
        ("line(x)", "mm", 7.0, true),
        ("line(x)", "m", 0.003, false),
        ("line(x)", "m", 3.0, true),
        ("2*line(x - 1 [mm]) + line(x)", "mm", 1.0, true),
        ("inverse(line, x)", "mV", 10.0, false),
        ("inverse(line, x)", "mV", 40.0, true),
    ] {
        let file = json!({
            "fits": {"line": {
                "x": {"unit": "mm", "values": [1, 2, 3, 4, 5, 6]},
                "y": {"unit": "mV", "values": [3.3, 5.6, 7.1, 9.3, 10.7, 12.1],
                    "standard_uncertainty": 0.5}}},
            "inputs": {"x": {"unit": unit, "distribution": "constant", "value": x}},
            "equations": {"y": formula},
            "outputs": {"y": {"unit": if formula.starts_with("inv") { "mm" } else { "mV" }}}
        });
        let expected: &[&str] = if wanted { &["extrapolation"] } else { &[] };
        assert_eq!(codes(&file), expected, "{formula} {x} {unit}");
    }
}

/// A component with an estimate of its own moves that of its input; one that has it once more doubles it.
#[test]
fn components_with_the_estimate_of_their_input() {
    for (component, wanted) in [
        (json!({"distribution": "rectangular", "lower": 9.9, "upper": 10.1}), true),
        (json!({"distribution": "normal", "mean": 10, "std": 0.1}), true),
        (json!({"distribution": "rectangular", "lower": -0.1, "upper": 0.3}), true),
        (json!({"distribution": "exponential", "mean": 0.1}), true),
        (json!({"distribution": "rectangular", "lower": -0.1, "upper": 0.1}), false),
        (json!({"distribution": "normal", "std": 0.1}), false),
        (json!({"distribution": "readings", "values": [9.9, 10.0, 10.1]}), false),
    ] {
        let mut component = component;
        component["name"] = json!("c");
        let input = json!({"unit": "mm", "mean": 10, "components": [component]});
        let file = json!({"inputs": {"a": input}, "equations": {"y": "a"},
            "outputs": {"y": {"unit": "mm"}}});
        let expected: &[&str] = if wanted { &["component-estimate"] } else { &[] };
        assert_eq!(codes(&file), expected, "{file}");
    }
}

/// The width of a component that follows an estimate of 0 is no width, which is told as of an input.
#[test]
fn components_without_a_width() {
    for (mean, wanted) in [(0.0, vec!["width-zero"]), (2.0, vec![])] {
        let component = json!({"name": "q", "distribution": "normal", "std": "1 %"});
        let file = json!({
            "inputs": {"a": {"unit": "V", "mean": mean, "components": [component]}},
            "equations": {"y": "a"}, "outputs": {"y": {"unit": "V"}}});
        assert_eq!(codes(&file), wanted, "{mean}");
    }
}

/// A share of reading beside a value is lost without a trace where the estimate is 0, as that of a
/// correction is.
#[test]
fn shares_of_an_estimate_of_zero() {
    for (mean, width, wanted) in [
        (0.0, "20 ppm of reading + 4 ppm of 10 V", Some("share-of-zero")),
        (0.0, "20 ppm + 2 uV", Some("share-of-zero")),
        (0.0, "20 ppm of 10 V + 4 ppm of 10 V", None),
        (5.0, "20 ppm of reading + 4 ppm of 10 V", None),
    ] {
        let input =
            json!({"unit": "V", "distribution": "rectangular", "mean": mean, "half_width": width});
        let file = json!({"inputs": {"x": input, "v": normal("V", 10.0)},
            "equations": {"y": "v + x"}, "outputs": {"y": {"unit": "V"}}});
        assert_eq!(codes(&file), wanted.as_slice(), "{mean} {width}");
    }
}
