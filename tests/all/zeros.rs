//! Temperatures and levels through everything that converts units: calibration functions, saved
//! results, tables, brackets, names of one's own. Each once gave a number that counted from another
//! zero, without a word.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::support::command;

/// The answer of a model file in a folder, or what was said instead.
fn run(folder: &Path, file: &Value) -> Result<Value, String> {
    fs::write(folder.join("m.json"), file.to_string()).unwrap();
    let mut run = command();
    run.current_dir(folder).args(["run", "m.json", "--trials", "0", "--format", "json"]);
    let output = run.output().unwrap();
    match output.status.code() {
        Some(0) => Ok(serde_json::from_slice(&output.stdout).unwrap()),
        _ => Err(String::from_utf8(output.stderr).unwrap()),
    }
}

fn estimate(answer: &Value, output: &str) -> f64 {
    answer["outputs"][output]["gum"]["estimate"].as_f64().unwrap()
}

/// The line 14 + 18 x in degF: what the points are off it is at right angles to 1 and to x. None of its
/// coefficients may be shifted.
#[test]
fn calibration_functions_in_fahrenheit() {
    let folder = tempfile::tempdir().unwrap();
    for x in ["V", "1"] {
        let file = |formula: &str, input: &str, unit: &str| {
            json!({"fits": {"line": {"x": {"unit": x, "values": [1, 2, 3, 4]},
                    "y": {"unit": "degF", "values": [32.1, 49.7, 68.3, 85.9]}}},
                "inputs": {"r": input}, "equations": {"t": formula}, "outputs": {"t": {"unit": unit}}})
        };
        let volts = if x == "1" { "1.5" } else { "1.5 V" };
        for (unit, expected) in [("degF", 41.0), ("degC", 5.0)] {
            let found = estimate(&run(folder.path(), &file("line(r)", volts, unit)).unwrap(), "t");
            assert!((found - expected).abs() < 1e-9, "{found} {unit} of x in {x}");
        }
        let back = run(folder.path(), &file("inverse(line, r)", "41 degF", x)).unwrap();
        assert!((estimate(&back, "t") - 1.5).abs() < 1e-9);
    }
}

/// A saved result is scaled, but never shifted.
#[test]
fn saved_results_for_units_of_another_zero() {
    let folder = tempfile::tempdir().unwrap();
    let saved = json!({"inputs": {"T": "20.00(5) degC", "P": "30.0(1) dBm"},
        "equations": {"t": "T", "p": "P"}, "outputs": {"t": {"unit": "degC"}, "p": {"unit": "dBm"}}});
    fs::write(folder.path().join("a.json"), saved.to_string()).unwrap();
    let mut save = command();
    save.current_dir(folder.path()).args(["run", "a.json", "--trials", "1e4", "--save", "a.sav"]);
    assert!(save.output().unwrap().status.success());
    let of = |output: &str, unit: &str| {
        let input =
            json!({"distribution": "result", "file": "a.sav", "output": output, "unit": unit});
        run(
            folder.path(),
            &json!({"inputs": {"x": input}, "equations": {"y": "x"},
                "outputs": {"y": {"unit": unit}}}),
        )
    };
    assert_eq!(estimate(&of("t", "degC").unwrap(), "y"), 20.0);
    assert_eq!(estimate(&of("p", "dBm").unwrap(), "y"), 30.0);
    for (output, unit) in [("t", "degF"), ("t", "K"), ("p", "dBW")] {
        let said = of(output, unit).unwrap_err();
        assert!(said.contains("different zeros"), "{said}");
    }
    assert!(of("p", "dBV").is_err());
}

/// 5 dBW are 35 dBm: in a table whose abscissas are in dBm, and divided by a unit.
#[test]
fn tables_and_brackets_of_levels() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("g.csv"), "L [dBm],g [1]\n0,1\n40,3\n").unwrap();
    let of = |level: &str, formula: &str| {
        let file = json!({"inputs": {"L": level}, "equations": {"y": formula},
            "outputs": {"y": {"unit": "1"}}});
        run(folder.path(), &file)
    };
    for (level, expected) in [("5.0(1) dBW", 2.75), ("35.0(1) dBm", 2.75)] {
        let found = estimate(&of(level, "table(L, 'g.csv')").unwrap(), "y");
        assert!((found - expected).abs() < 1e-12, "{found} at {level}");
    }
    // 45 dBm are outside
    let outside = of("15.0(1) dBW", "table(L, 'g.csv')").unwrap_err();
    assert!(outside.contains("at 45, outside its range 0 to 40"), "{outside}");
    assert_eq!(estimate(&of("30.0(1) dBm", "L/[dBW]").unwrap(), "y"), 0.0);
    assert_eq!(estimate(&of("30.0(1) dBm", "L/[dBm]").unwrap(), "y"), 30.0);
    assert!(of("30.0(1) dBm", "L/[dBV]").unwrap_err().contains("cannot take them together"));
}

/// A name of one's own for a unit with a zero, or one that counts angle, is that unit.
#[test]
fn names_of_ones_own() {
    let folder = tempfile::tempdir().unwrap();
    let file = |n: &str| {
        json!({"units": {"Cel": "degC", "upm": "rpm"},
            "inputs": {"t": {"unit": "Cel", "value": "20.0(1)"}, "n": {"unit": "upm", "value": 60}},
            "equations": {"T": "kelvin(t)", "f": n},
            "outputs": {"T": {"unit": "K"}, "f": {"unit": "Hz"}}})
    };
    assert!(run(folder.path(), &file("n")).unwrap_err().contains("counts angle"));
    let answer = run(folder.path(), &file("n/[rev]")).unwrap();
    assert_eq!(estimate(&answer, "T"), 293.15);
    assert!((estimate(&answer, "f") - 1.0).abs() < 1e-15);
}

/// 273.15 K added to a Celsius temperature leave one, of 293.15 degC.
#[test]
fn the_ice_point_is_not_added() {
    let folder = tempfile::tempdir().unwrap();
    let of = |formula: &str| {
        let file = json!({"inputs": {"t": "20.0(1) degC"}, "equations": {"y": formula},
            "outputs": {"y": {"unit": "degC"}}});
        run(folder.path(), &file)
    };
    for formula in ["t + 273.15 [K]", "273.2 [K] + t", "273150 [mK] + t"] {
        let said = of(formula).unwrap_err();
        assert!(said.contains("write `kelvin(t)`"), "{formula}: {said}");
    }
    assert_eq!(estimate(&of("t + 1 [K]").unwrap(), "y"), 21.0);
}

/// Where units are not checked, brackets of a quantity in another unit than the coherent one are a
/// hundred times off: only a name divided by them is known.
#[test]
fn brackets_where_units_are_not_checked() {
    let folder = tempfile::tempdir().unwrap();
    let of = |formula: &str| {
        let file = json!({"format": 2, "check_units": false, "inputs": {"p": "1013 hPa", "l": "2 m"},
            "equations": {"y": formula}, "outputs": {"y": {"unit": "hPa"}}});
        run(folder.path(), &file)
    };
    for formula in ["p/[hPa]*2", "2*(p/[hPa])", "2*p"] {
        assert_eq!(estimate(&of(formula).unwrap(), "y"), 2026.0, "{formula}");
    }
    for formula in ["2*p/[hPa]", "p + 1 [hPa]", "p - 1 [Pa]"] {
        assert!(of(formula).unwrap_err().contains("units are not checked here"), "{formula}");
    }
    // lengths are in metres here, as in coherent units
    assert!((estimate(&of("p*(l + 500 [mm])").unwrap(), "y") - 2532.5).abs() < 1e-9);
}
