//! Measured constants of CODATA 2022 as inputs, from the outside.

use std::fs;

use serde_json::{Value, json};

use crate::support::command;

fn run(file: &Value, more: &[&str]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("m.json"), file.to_string()).expect("written");
    let mut run = command();
    let run = run.current_dir(folder.path()).args(["run", "m.json"]).args(more).output();
    let output = run.expect("the program runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn constant(name: &str) -> Value {
    json!({"distribution": "codata", "constant": name})
}

/// Quantities that NIST publishes and that are not among the constants, from those that are: values to
/// half of u, or to the digits that masses are published with (2e-11), and u to 5 % (two digits).
#[test]
fn derived_constants_have_their_published_uncertainties() {
    let inputs = json!({
        "R": constant("Rydberg constant"), "a": constant("fine-structure constant"),
        "me": constant("m_e"), "mp": constant("m_p"), "mn": constant("m_n"), "mmu": constant("m_mu"),
        "md": constant("m_d"), "malpha": constant("m_alpha"), "muN": constant("mu_N"),
        "gp": constant("proton gyromagnetic ratio"), "mu0": constant("mu_0"),
        "eps0": constant("epsilon_0"), "mu": {"distribution": "codata", "constant": "m_u", "unit": "kg"},
    });
    let published = [
        ("electron", "2*[h]*R/([c]*a^2)", "kg", 9.109_383_713_9e-31, 2.8e-40),
        ("proton_electron", "mp/me", "1", 1_836.152_673_426, 3.2e-8),
        ("alpha_electron", "malpha/me", "1", 7_294.299_541_71, 1.7e-7),
        ("deuteron_proton", "md/mp", "1", 1.999_007_501_269_9, 8.4e-12),
        ("muon_proton", "mmu/mp", "1", 0.112_609_526_2, 2.5e-9),
        ("neutron_proton", "mn/mp", "1", 1.001_378_419_46, 4.0e-10),
        ("electron_in_u", "me/mu", "1", 5.485_799_090_441e-4, 9.7e-15),
        ("proton_moment", "gp*[h]/(4*pi*muN)", "1", 2.792_847_344_63, 8.2e-10),
    ];
    let mut file =
        json!({"inputs": inputs, "monte_carlo": {"trials": 0}, "equations": {}, "outputs": {}});
    for (name, formula, unit, ..) in published {
        file["equations"][name] = json!(formula);
        file["outputs"][name] = json!({"unit": unit});
    }
    file["equations"]["c2"] = json!("1/(mu0*eps0)");
    file["outputs"]["c2"] = json!({"unit": "m^2/s^2"});
    let (code, said, errors) = run(&file, &["--format", "json"]);
    assert_eq!(code, Some(0), "{errors}");
    let found: Value = serde_json::from_str(&said).expect("JSON");
    let gum = |name: &str| {
        let of = &found["outputs"][name]["gum"];
        [&of["estimate"], &of["standard_uncertainty"]]
            .map(|value| value.as_f64().expect("a number"))
    };
    for (name, .., value, u) in published {
        let [estimate, uncertainty] = gum(name);
        assert!(
            (estimate - value).abs() < f64::max(0.5 * u, 2e-11 * value),
            "{name}: {estimate} for {value}"
        );
        assert!((uncertainty / u - 1.0).abs() < 0.05, "{name}: {uncertainty} for {u}");
    }
    // fully correlated: c is exact
    let [c2, u] = gum("c2");
    assert!((c2 / 299_792_458_f64.powi(2) - 1.0).abs() < 1e-11 && u < 1e-15 * c2, "{c2} {u}");
    assert!(errors.contains("those of CODATA 2022"), "{errors}");
}

/// What the file states goes before CODATA; other names, units and components are errors.
#[test]
fn constants_of_a_file() {
    let file = |input: Value, more: Value| {
        let mut file = json!({"inputs": {"x": input, "z": constant("Z_0")},
            "equations": {"y": "x*z/[ohm]"}, "outputs": {"y": {"unit": "1"}},
            "monte_carlo": {"trials": 0}});
        for (key, value) in more.as_object().expect("an object") {
            file[key] = value.clone();
        }
        file
    };
    let relative = |more: Value| {
        let (_, said, errors) = run(&file(constant("alpha"), more), &["--format", "json"]);
        let found: Value = serde_json::from_str(&said).unwrap_or_else(|_| panic!("{errors}"));
        let of = &found["outputs"]["y"]["gum"];
        of["standard_uncertainty"].as_f64().unwrap() / of["estimate"].as_f64().unwrap()
    };
    let (full, none) = (relative(json!({})), relative(json!({"correlations": [["x", "z", 0]]})));
    assert!((full / none - 2_f64.sqrt()).abs() < 1e-6, "{full} {none}");
    for (input, expected) in [
        (constant("electron mas"), "electron mass"),
        (json!({"distribution": "codata", "constant": "m_e", "unit": "m"}), "`x`"),
        (json!({"distribution": "codata"}), "`constant`"),
        (
            json!({"unit": "kg", "mean": 0, "components":
                [{"name": "c", "distribution": "codata", "constant": "m_e"}]}),
            "which is an input of its own",
        ),
    ] {
        let (code, _, errors) = run(&file(input, json!({})), &[]);
        assert!(code == Some(2) && errors.contains(expected), "{errors}");
    }
}
