//! The schema and the reader know the same keys; ready files and worked examples are valid.

mod result_file;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::text;
use crate as file;
use crate::keys::SHAPES;
use gumption_text::DiagnosticKind;

fn schema() -> Value {
    serde_json::from_str(&text()).unwrap()
}

fn validator() -> jsonschema::Validator {
    let schema = schema();
    assert!(jsonschema::meta::is_valid(&schema));
    jsonschema::draft202012::new(&schema).unwrap()
}

fn read(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Names of the entries of a folder of the repository.
fn entries(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn ready_files_and_worked_examples_are_valid() {
    let validator = validator();
    let ready = entries("models");
    let ready = ready.into_iter().filter(|path| path.extension().is_some_and(|e| e == "json"));
    let cases = entries("tests/cases").into_iter().filter(|path| {
        let name = path.file_name().unwrap().to_string_lossy();
        path.is_dir() && !name.starts_with("wrong-")
    });
    let gaps = entries("models/gap").into_iter().filter(|path| path.is_dir());
    let certificates = entries("models/certificates").into_iter();
    let files: Vec<PathBuf> = ready
        .chain(cases.map(|path| path.join("model.json")))
        .chain(gaps.map(|path| path.join("case.json")))
        .chain(certificates.filter(|path| path.extension().is_some_and(|e| e == "json")))
        .collect();
    assert!(files.len() > 100);
    let mut mistakes = Vec::new();
    for path in files {
        for error in validator.iter_errors(&read(&path)) {
            mistakes.push(format!("{} {}: {error}", path.display(), error.instance_path()));
        }
    }
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
}

#[test]
fn wrong_files_are_not_valid() {
    let validator = validator();
    let wrong = |name: &str| entries("tests/cases").into_iter().find(|p| p.ends_with(name));
    let path = wrong("wrong-unknown-key").unwrap().join("model.json");
    assert!(!validator.is_valid(&read(&path)));

    let right = json!({
        "inputs": {"x": {"distribution": "normal", "mean": 1, "std": 1}},
        "equations": {"y": "x"}, "outputs": {"y": {}}
    });
    assert!(validator.is_valid(&right));
    let inputs = [
        json!({"distribution": "normal", "mean": 1}),
        json!({"distribution": "normal", "std": 1}),
        json!({"distribution": "normal", "mean": 1, "std": 1, "expanded": 1, "k": 2}),
        json!({"distribution": "normal", "mean": 1, "expanded": 1}),
        json!({"distribution": "normal", "mean": 1, "expanded": 1, "k": 2, "p": 0.95}),
        json!({"distribution": "normal", "mean": 1, "std": -1}),
        json!({"distribution": "normal", "mean": 1, "std": 1, "half_width": 1}),
        json!({"distribution": "rectangular", "lower": 1}),
        json!({"distribution": "rectangular", "mean": 0, "lower": 1, "upper": 2}),
        json!({"distribution": "triangular", "mean": 0, "half_width": 1, "mode": 0}),
        json!({"distribution": "samples"}),
        json!({"distribution": "samples", "file": "x.csv", "values": [1]}),
        json!({"distribution": "norml", "mean": 1, "std": 1}),
        json!({"mean": 1, "std": 1}),
        json!({"mean": 1, "components": []}),
        json!({"mean": 1, "components": [{"distribution": "normal", "std": 1}]}),
        json!({"mean": 1, "distribution": "normal", "std": 1, "components": [
            {"name": "a", "distribution": "normal", "std": 1}]}),
        json!(true),
    ];
    for input in inputs {
        let mut file = right.clone();
        file["inputs"]["x"] = input.clone();
        assert!(!validator.is_valid(&file), "{input}");
    }
    let roots = [
        ("equations", json!({})),
        ("equations", json!({"2nd": "x"})),
        ("model", json!("inclined-plane")),
        ("outputs", json!({})),
        ("outputs", json!({"y": {"tolerance": {}}})),
        ("correlations", json!([["a", "b"]])),
        ("correlations", json!([["a", "b", 1.5]])),
        ("correlation_matrix", json!({"names": ["x"]})),
        ("coverage_factor_fixed", json!(true)),
        ("coverage_probability", json!(95)),
        ("monte_carlo", json!({"trials": 1})),
        ("monte_carlo", json!({"trials": "many"})),
        ("conditions", json!({"file": "x.csv", "unit": {}})),
        ("format", json!(3)),
        ("observations", json!({"file": "x.csv"})),
        ("observations", json!({"columns": {"y": {"value": "y"}}})),
        (
            "observations",
            json!({"file": "x.csv", "values": {"y": [1]}, "columns": {"y": {"value": "y"}}}),
        ),
        ("observations", json!({"values": {"y": ["1"]}, "columns": {"y": {"value": "y"}}})),
        ("observations", json!({"file": "x.csv", "columns": {}})),
        ("observations", json!({"file": "x.csv", "columns": {"y": {"sim": "s"}}})),
        (
            "observations",
            json!({"file": "x.csv", "columns": {"y": {"value": "y", "sim_covariance": "c.csv"}}}),
        ),
        ("effects", json!({"e": {"overrides": {"y": "y"}}})),
        (
            "effects",
            json!({"a/b": {"parameters": {"d": {"distribution": "normal", "mean": 0,
            "std": 1}}, "overrides": {"y": "y"}}}),
        ),
        ("catalogue", json!(["warp"])),
        ("catalogue", json!(["offset", "offset"])),
        ("catalogue", json!("every")),
        ("prior", json!({"none": -0.1})),
        ("prior", json!({"nothing": 1})),
    ];
    for (key, value) in roots {
        let mut file = right.clone();
        file[key] = value.clone();
        assert!(!validator.is_valid(&file), "{key}: {value}");
    }
}

#[test]
fn what_the_contract_allows_is_valid() {
    let validator = validator();
    let file = json!({
        "$schema": "gumption.schema.json",
        "format": 1,
        "inputs": {
            "θ_1": {"unit": "deg", "distribution": "uniform", "mean": "2*f", "semi_range": "1 %",
                  "per": "row", "evidence": {"values": [1, 2]}, "$note": 1},
            "a": {"unit": "V", "mean": 1, "components": [
                {"name": "certificate", "distribution": "gaussian", "expanded": 0.1, "k": 2},
                {"name": "drift", "distribution": "u-shaped", "half_width": "1 uV"}]},
            "r": {"distribution": "readings", "values": [1, 2], "paired": true},
            "s": {"distribution": "samples", "file": "s.csv"},
            "c": {"distribution": "result", "file": "r.json", "output": "y"}
        },
        "correlations": [["a/drift", "r", 0.5]],
        "correlation_matrix": {"file": "r.csv"},
        "conditions": {"f": {"unit": "Hz", "values": [1, 2]}},
        "equations": {"y": "a"},
        "outputs": {"y": {"unit": "mV", "tolerance": {"lower": 0, "prior": {
            "distribution": "normal", "mean": 1, "std": 1}}, "cmc": "1 % + 1 uV", "cmc_floor": true,
            "periodic": 360}},
        "coverage_factor": 2, "coverage_factor_fixed": true,
        "monte_carlo": {"trials": "adaptive", "max_trials": 1e6, "digits": 1, "seed": 0},
        "check_units": false, "allow_undefined": 0.01
    });
    let case = json!({
        "conditions": {"f": {"unit": "Hz"}},
        "outputs": {"y": {}, "z": {}},
        "observations": {"file": "d.csv", "columns": {
            "y": {"value": "y", "standard_uncertainty": "u", "sim": "s", "sim_covariance": "c.csv"},
            "z": {"value": "z", "sim": "t", "sim_standard_uncertainty": "v"}}},
        "effects": {"low pass": {"about": "", "source": "", "overrides": {"y": "y/d"}, "parameters": {
            "d": {"distribution": "log-uniform", "lower": 1, "upper": 2}}}},
        "catalogue": ["offset"], "prior": {"none": 0.5, "one": 0.5, "two": 0, "unexplained": 0}
    });
    for file in [file, case] {
        let mistakes: Vec<String> = validator.iter_errors(&file).map(|e| e.to_string()).collect();
        assert!(mistakes.is_empty(), "{mistakes:?}");
    }
}

/// The keys that the reader knows where `file` has the key `unknown`; none if it stops before.
fn known_to_reader(file: &Value) -> Option<BTreeSet<String>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/errors");
    let Err(diagnostics) = file::check_text("x", &file.to_string(), &folder) else {
        panic!("an unknown key was taken: {file}");
    };
    diagnostics.0.iter().find_map(|diagnostic| match &diagnostic.kind {
        DiagnosticKind::UnknownKey { key, known, .. } if key == "unknown" => {
            Some(known.iter().map(|key| (*key).to_owned()).collect())
        }
        _ => None,
    })
}

/// Names whose pattern every language has; Python knows no classes of letters.
#[test]
fn the_pattern_of_names_takes_what_the_reader_takes() {
    use gumption_engine::model::formula::is_name;

    let schema = schema();
    let pattern = schema["$defs"]["name"].clone();
    assert!(!pattern["pattern"].as_str().unwrap().contains("\\p"), "{pattern}");
    let validator = jsonschema::draft202012::new(&pattern).unwrap();
    let is_valid = |name: String| validator.is_valid(&json!(name));
    for letter in (1..=u32::from(char::MAX)).filter_map(char::from_u32) {
        // one letter of each block above the first ones is enough
        let code = u32::from(letter);
        if code > 0x3000 && code % 0x80 != 0 {
            continue;
        }
        for name in [format!("{letter}"), format!("a{letter}")] {
            assert!(is_valid(name.clone()) || !is_name(&name), "{name}");
            // signs, spaces and controls are refused
            assert!(is_name(&name) || code > 0xff || !is_valid(name.clone()), "{name:?}");
        }
    }
}

/// The keys that a definition knows.
fn known_to_schema(name: &str) -> BTreeSet<String> {
    let schema = schema();
    let properties = schema["$defs"][name]["properties"].as_object().unwrap();
    properties.keys().cloned().collect()
}

fn file_with(path: &[&str], value: Value) -> Value {
    let mut file = json!({
        "inputs": {"x": {"distribution": "constant", "value": 1}},
        "equations": {"y": "x"}, "outputs": {"y": {}}
    });
    let place = path.iter().fold(&mut file, |place, key| &mut place[key]);
    *place = value;
    file
}

/// What the reader knows and the schema does not, and the other way round, is a mistake.
#[test]
fn the_reader_knows_the_same_keys() {
    let same = |definition: &str, file: Value| {
        let Some(reader) = known_to_reader(&file) else {
            return false;
        };
        let schema = known_to_schema(definition);
        assert_eq!(reader, schema, "{definition}");
        true
    };
    assert!(same("model", file_with(&["unknown"], json!(1))));
    assert!(same("output", file_with(&["outputs", "y", "unknown"], json!(1))));
    assert!(same("monte-carlo", file_with(&["monte_carlo"], json!({"unknown": 1}))));
    let matrix = json!({"names": ["x"], "values": [[1]], "unknown": 1});
    assert!(same("correlation-matrix", file_with(&["correlation_matrix"], matrix)));
    let grid = json!({"f": {"values": [1], "unknown": 1}});
    assert!(same("condition", file_with(&["conditions"], grid)));
    let table = json!({"file": "x.csv", "unknown": 1});
    assert!(same("table-of-conditions", file_with(&["conditions"], table)));
    let part = json!({"name": "a", "distribution": "normal", "std": 1});
    let sum = json!({"mean": 1, "components": [part], "unknown": 1});
    assert!(same("input-of-components", file_with(&["inputs", "x"], sum)));

    let data = |column: Value| json!({"file": "gap.csv", "columns": {"y": column}});
    let observed = data(json!({"value": "y", "unknown": 1}));
    assert!(same("observed-output", file_with(&["observations"], observed)));
    let observations = json!({"file": "gap.csv", "unknown": 1});
    assert!(same("observations", file_with(&["observations"], observations)));
    let case = |key: &str, value: Value| {
        let mut file = file_with(&["observations"], data(json!({"value": "y"})));
        file[key] = value;
        file
    };
    assert!(same("effect", case("effects", json!({"e": {"unknown": 1}}))));
    assert!(same("prior", case("prior", json!({"unknown": 1}))));

    let certificate = |key: &str, value: Value| {
        let mut file = json!({"rows": [{"model": "ready.json", "output": "y"}]});
        file[key] = value;
        file
    };
    assert!(same("certificate", certificate("unknown", json!(1))));
    assert!(same("certificate-row", certificate("rows", json!([{"unknown": 1}]))));
    let functions = certificate("functions", json!([{"unknown": 1}]));
    assert!(same("certificate-function", functions));
    assert!(same("device", certificate("device", json!({"unknown": 1}))));
    assert!(same("party", certificate("customer", json!({"unknown": 1}))));

    let recipe = |path: &[&str], value: Value| {
        let mut file = json!({"recordings": {"r": {"file": "x.csv", "sampling_rate": 100}},
            "channels": {"a": {"column": 1}}, "frequency": {"value": 5}});
        *path.iter().fold(&mut file, |place, key| &mut place[key]) = value;
        file
    };
    let unknown = || json!({"unknown": 1});
    assert!(same("recipe", recipe(&["unknown"], json!(1))));
    assert!(same("recording", recipe(&["recordings", "r"], unknown())));
    assert!(same("channel", recipe(&["channels", "a"], unknown())));
    assert!(same("recipe-frequency", recipe(&["frequency"], unknown())));
    assert!(same("recipe-row", recipe(&["rows"], json!([{"unknown": 1}]))));
    assert!(same("recipe-condition", recipe(&["conditions"], json!({"c": {"unknown": 1}}))));

    let mut read = 0;
    for shape in &SHAPES {
        for name in std::iter::once(&shape.name).chain(shape.aliases) {
            let input = json!({"distribution": name, "unknown": 1});
            let component = json!({"name": "a", "distribution": name, "unknown": 1});
            let composed = json!({"mean": 1, "components": [component]});
            let input = file_with(&["inputs", "x"], input);
            let component = file_with(&["inputs", "x"], composed);
            // shapes that the reader does not draw yet have no keys there
            read += u32::from(same(&format!("input-{}", shape.name), input));
            read += u32::from(same(&format!("component-{}", shape.name), component));
        }
    }
    assert!(read >= 12, "{read}");
}
