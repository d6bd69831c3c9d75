//! However the unit of an output is spelled, its certificate says one unit in every format that
//! names units.

use std::collections::BTreeSet;
use std::fs;

use serde_json::{Map, Value, json};

use crate::support::output;

/// A certificate of one output for each spelling of a unit, in a format.
fn certificate(spellings: &[&str], format: &str) -> String {
    let (mut equations, mut outputs, mut rows) = (Map::new(), Map::new(), Vec::new());
    for (number, spelling) in spellings.iter().enumerate() {
        let name = format!("y{number}");
        equations.insert(name.clone(), json!("x"));
        outputs.insert(name.clone(), json!({"unit": spelling}));
        rows.push(json!({"model": "m.json", "output": name}));
    }
    let x = json!({"unit": spellings[0], "distribution": "normal", "mean": 9.81, "std": 0.0123});
    let model = json!({"inputs": {"x": x}, "equations": Value::Object(equations),
        "outputs": Value::Object(outputs)});
    let party = json!({"name": "L", "email": "a@example.org", "city": "Torino", "country": "IT"});
    let file = json!({"number": "C-1", "title": "Certificate", "device": {"name": "a",
        "manufacturer": "b", "serial_number": "c"}, "customer": party, "laboratory": party,
        "responsible": "R", "calibration_date": "2026-03-02", "monte_carlo": {"trials": 0},
        "rows": rows});
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in [("c.json", file), ("m.json", model)] {
        fs::write(folder.path().join(name), content.to_string()).expect("a file");
    }
    let path = folder.path().join("c.json");
    output(&["certificate", path.to_str().expect("a path"), "--format", format, "--quiet"])
}

/// What stands between two texts, each once.
fn between(text: &str, before: &str, after: &str) -> BTreeSet<String> {
    let parts = text.split(before).skip(1);
    parts.filter_map(|part| Some(part.split_once(after)?.0.to_owned())).collect()
}

#[test]
fn every_spelling_is_one_unit_on_a_certificate() {
    let units: [(&[&str], &str, &str); 4] = [
        (
            &["m/s^2", "m/s²", "m·s⁻²", "m s^-2", "m*s**-2", "m/s^(2)"],
            r"\metre\second\tothe{-2}",
            r"\metre\per\second\squared",
        ),
        (&["m^2", "m²", "m**2", "m^(2)", "(m)^2"], r"\metre\tothe{2}", r"\metre\squared"),
        (
            &["mV/(m/s^2)", "mV/(m/s²)", "mV·m⁻¹·s²"],
            r"\milli\volt\metre\tothe{-1}\second\tothe{2}",
            r"\milli\volt\per\metre\second\squared",
        ),
        (&["µΩ", "uohm", "μΩ"], r"\micro\ohm", r"\micro\ohm"),
    ];
    for (spellings, dcc, latex) in units {
        let page = certificate(spellings, "dcc");
        let found = between(&page, "<si:unitXMLList>", "</si:unitXMLList>");
        assert_eq!(found, BTreeSet::from([dcc.to_owned()]));
        let page = certificate(spellings, "latex");
        assert_eq!(between(&page, r"\unit{", "}"), BTreeSet::from([latex.to_owned()]));
    }
}
