//! What changed beside the inputs, in words.

use serde_json::{Map, Value};

use crate::ModelFile;

/// Keys of the root whose values are compared as they stand.
const WHOLE: [&str; 8] = [
    "model",
    "conditions",
    "correlations",
    "correlation_matrix",
    "coverage_probability",
    "coverage_factor",
    "coverage_factor_fixed",
    "check_units",
];

/// Keys of the root whose members are compared one by one.
const MEMBERS: [(&str, &str); 2] = [("equations", "equation"), ("outputs", "output")];

/// The changes of two files, in the order above.
pub(super) fn list(first: &ModelFile, second: &ModelFile) -> Vec<String> {
    let [first, second] = [first, second].map(|file| {
        // the files were read, so they are JSON objects
        match serde_json::from_str(&file.source.text) {
            Ok(Value::Object(members)) => members,
            _ => Map::new(),
        }
    });
    let mut changes = Vec::new();
    for key in WHOLE {
        let values = [first.get(key), second.get(key)];
        changes.extend(change(&format!("`{key}`"), values));
    }
    for (key, what) in MEMBERS {
        let [a, b] = [&first, &second].map(|file| file.get(key).and_then(Value::as_object));
        let names = |object: Option<&Map<String, Value>>| {
            object.map(|o| o.keys().cloned().collect::<Vec<_>>()).unwrap_or_default()
        };
        let mut all = names(a);
        all.extend(names(b).into_iter().filter(|name| a.is_none_or(|a| !a.contains_key(name))));
        for name in all {
            let values = [a, b].map(|object| object.and_then(|object| object.get(&name)));
            changes.extend(change(&format!("{what} `{name}`"), values));
        }
    }
    changes.extend(of_evidence(&first, &second));
    changes
}

/// The changes of the evidence of inputs: readings that support what is stated are no part of an
/// evaluation, and say what it is worth.
fn of_evidence(first: &Map<String, Value>, second: &Map<String, Value>) -> Vec<String> {
    let [a, b] = [first, second].map(|file| file.get("inputs").and_then(Value::as_object));
    let names = |fields: Option<&Map<String, Value>>| -> Vec<String> {
        fields.map(|inputs| inputs.keys().cloned().collect()).unwrap_or_default()
    };
    let mut all = names(a);
    all.extend(names(b).into_iter().filter(|name| a.is_none_or(|a| !a.contains_key(name))));
    let changed = all.iter().filter_map(|name| {
        let values = [a, b].map(|inputs| inputs?.get(name)?.get("evidence"));
        change(&format!("evidence of `{name}`"), values)
    });
    changed.collect()
}

fn change(what: &str, values: [Option<&Value>; 2]) -> Option<String> {
    match values {
        [Some(a), Some(b)] if a != b => Some(format!("{what}: from {a} to {b}")),
        [Some(a), None] => Some(format!("{what} removed: {a}")),
        [None, Some(b)] => Some(format!("{what} added: {b}")),
        _ => None,
    }
}
