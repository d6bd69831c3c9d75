//! What a model that is being written still lacks. It is no error: the page names it, and waits.

use jsonc_parser::ast::{Object, Value};
use serde_json::{Value as Json, json};

use crate::tree::{self, PathStep, path_of, raw};

/// Keys of which an empty value says nothing wrong.
const BESIDE: [&str; 4] = ["title", "source", "about", "group"];

/// Marks errors (a list of the page) that only say what is still lacking with `open`, and gives the
/// places that lack something, each with a suggestion where there is one. `missing` are the names
/// that equations use but nothing defines.
pub(crate) fn points(
    text: &str,
    root: &Value<'_>,
    missing: &[String],
    diagnostics: &mut [Json],
) -> Json {
    let mut points = empty(text, root);
    let without_unit = without_unit(text, root);
    let mut are_units_open = false;
    for of in diagnostics {
        let path: Vec<PathStep> = serde_json::from_value(of["path"].clone()).unwrap_or_default();
        let found = tree::at(root, &path);
        let is_empty = found.is_some_and(|of| is_empty(text, of));
        let is_missing = of["hint"].is_null()
            && named(text, found, of).is_some_and(|name| missing.contains(&name));
        let is_dimension = of["isOfUnits"] == true;
        let is_of_units = is_dimension && !without_unit.is_empty();
        are_units_open |= is_of_units;
        // an output whose unit is not chosen yet
        let output = match path.as_slice() {
            [PathStep::Key(key), name, ..] if key == "outputs" => tree::at(root, &path_to(name)),
            _ => None,
        };
        let has_unit = output.is_none_or(|of| tree::get(of, "unit").is_some());
        let is_unit = is_dimension && !has_unit && !is_of_units;
        if is_unit && let Some(name) = path.get(1) {
            let mut path = path_to(name);
            path.push(PathStep::Key("unit".to_owned()));
            points.push(json!({ "path": path, "suggestion": of["unit"] }));
        }
        of["open"] = json!(is_empty || is_missing || is_of_units || is_unit);
    }
    if are_units_open {
        points.extend(without_unit);
    }
    Json::Array(points)
}

fn path_to(output: &PathStep) -> Vec<PathStep> {
    vec![PathStep::Key("outputs".to_owned()), output.clone()]
}

/// The text that an error is about, within the text of its value.
fn named(text: &str, found: Option<&Value<'_>>, of: &Json) -> Option<String> {
    let units: Vec<u16> = raw(text, found?).encode_utf16().collect();
    let [from, to] =
        [0, 1].map(|end| of["within"][end].as_u64().and_then(|at| usize::try_from(at).ok()));
    Some(String::from_utf16_lossy(units.get(from?..to?)?))
}

fn is_empty(text: &str, value: &Value<'_>) -> bool {
    match value {
        Value::Object(of) => of.properties.is_empty(),
        Value::Array(of) => of.elements.is_empty(),
        Value::NullKeyword(_) => true,
        other => raw(text, other).trim().is_empty(),
    }
}

/// Inputs whose values are empty, and lists of the file that are empty.
fn empty(text: &str, root: &Value<'_>) -> Vec<Json> {
    let mut points = Vec::new();
    // a case may have a column of simulated values in place of equations
    let is_case = tree::get(root, "observations").is_some();
    for key in ["equations", "outputs"].into_iter().filter(|_| !is_case) {
        if tree::get(root, key).is_some_and(|of| is_empty(text, of)) {
            points.push(json!({ "path": [key] }));
        }
    }
    for (name, object) in inputs(root) {
        for member in &object.properties {
            let key = member.name.as_str();
            if is_empty(text, &member.value) && !BESIDE.contains(&key) {
                points.push(json!({ "path": ["inputs", name, key] }));
            }
        }
    }
    points
}

/// The units of inputs that have none.
fn without_unit(text: &str, root: &Value<'_>) -> Vec<Json> {
    let is_open = |object: &Object<'_>| {
        tree::member(object, "unit").is_none_or(|unit| is_empty(text, &unit.value))
            && tree::member(object, "components").is_none()
    };
    let open = inputs(root).filter(|(_, object)| is_open(object));
    open.map(|(name, _)| json!({ "path": path_of(["inputs", name, "unit"]) })).collect()
}

fn inputs<'v>(root: &'v Value<'_>) -> impl Iterator<Item = (&'v str, &'v Object<'v>)> {
    let object = tree::get(root, "inputs").and_then(Value::as_object);
    let members = object.into_iter().flat_map(|object| &object.properties);
    members.filter_map(|member| Some((member.name.as_str(), member.value.as_object()?)))
}
