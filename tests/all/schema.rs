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
