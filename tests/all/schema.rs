//! `gumption schema` as a user runs it.

use serde_json::Value;

use crate::support::{gumption, output};

#[test]
fn the_schema_is_printed_and_written() {
    let printed = output(&["schema"]);
    let schema: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["$defs"]["model"]["additionalProperties"], false);
    let names = schema["$defs"]["distribution"]["enum"].as_array().unwrap();
    for name in ["rectangular", "uniform", "u-shaped", "student-t", "result"] {
        assert!(names.iter().any(|known| known == name), "{name}");
    }

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("gumption.schema.json");
    gumption().args(["schema", "--output"]).arg(&file).assert().success().stdout("");
    assert_eq!(std::fs::read_to_string(file).unwrap(), printed);
}

/// What `run --save` writes is valid, and so is the model file that it comes from.
#[test]
fn saved_results_are_valid() {
    let schema: Value = serde_json::from_str(&output(&["schema"])).unwrap();
    let validator = jsonschema::draft202012::new(&schema).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("r.json");
    let model = "models/inclined_plane.json";
    let to = file.to_str().unwrap();
    output(&["run", model, "--trials", "20000", "--save", to, "--quiet"]);
    for path in [file, crate::support::root().join(model)] {
        let text = std::fs::read_to_string(path).unwrap();
        let value: Value = serde_json::from_str(&text).unwrap();
        let mistakes: Vec<String> = validator.iter_errors(&value).map(|e| e.to_string()).collect();
        assert!(mistakes.is_empty(), "{mistakes:?}");
    }
}
