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
            match key {
                "outputs" => changes.extend(of_output(&name, values)),
                _ => changes.extend(change(&format!("{what} `{name}`"), values)),
            }
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
    let [a, b] = values.map(|value| value.map(in_words));
    match [a, b] {
        [Some(a), Some(b)] if values[0] != values[1] => Some(format!("{what}: from {a} to {b}")),
        [Some(a), None] => Some(format!("{what} removed: {a}")),
        [None, Some(b)] => Some(format!("{what} added: {b}")),
        _ => None,
    }
}

/// The changes of an output: key by key where both files have it.
fn of_output(name: &str, values: [Option<&Value>; 2]) -> Vec<String> {
    let what = format!("output `{name}`");
    let [Some(Value::Object(a)), Some(Value::Object(b))] = values else {
        return change(&what, values).into_iter().collect();
    };
    let unit = |keys: &Map<String, Value>| match keys.get("unit") {
        Some(Value::String(unit)) if unit != "1" => format!(" {unit}"),
        _ => String::new(),
    };
    let keys = a.keys().chain(b.keys().filter(|key| !a.contains_key(*key)));
    let changed = keys.filter(|key| a.get(*key) != b.get(*key)).map(|key| {
        let values = [a, b].map(|of| {
            let value = of.get(key)?;
            Some(match (key.as_str(), value) {
                ("tolerance", Value::Object(limits)) => in_words_of_tolerance(limits, &unit(of)),
                _ => in_words(value),
            })
        });
        match values {
            [Some(a), Some(b)] => format!("{what}: {key} changed: {a}; now {b}"),
            [Some(a), None] => format!("{what}: {key} removed: {a}"),
            [None, Some(b)] => format!("{what}: {key} added: {b}"),
            [None, None] => what.clone(),
        }
    });
    changed.collect()
}

/// A tolerance: its limits with the unit of the output, then the other keys.
fn in_words_of_tolerance(limits: &Map<String, Value>, unit: &str) -> String {
    // a text has a unit of its own
    let limit = |key: &str| {
        limits.get(key).map(|limit| match limit {
            Value::String(text) => (text.clone(), ""),
            limit => (limit.to_string(), unit),
        })
    };
    let said = match [limit("lower"), limit("upper")] {
        [Some((lower, a)), Some((upper, b))] if a == b => {
            Some(format!("from {lower} to {upper}{b}"))
        }
        [Some((lower, a)), Some((upper, b))] => Some(format!("from {lower}{a} to {upper}{b}")),
        [Some((lower, unit)), None] => Some(format!("at least {lower}{unit}")),
        [None, Some((upper, unit))] => Some(format!("at most {upper}{unit}")),
        [None, None] => None,
    };
    let others = limits.iter().filter(|(key, _)| !matches!(key.as_str(), "lower" | "upper"));
    let others = others.map(|(key, value)| format!("{key} {}", in_words(value)));
    said.into_iter().chain(others).collect::<Vec<_>>().join(", ")
}

/// A value of a file: an object as its keys, each with its value.
fn in_words(value: &Value) -> String {
    match value {
        Value::Object(keys) => {
            let keys = keys.iter().map(|(key, value)| match value {
                Value::Object(_) => format!("{key} ({})", in_words(value)),
                Value::String(text) => format!("{key} {text}"),
                _ => format!("{key} {}", in_words(value)),
            });
            keys.collect::<Vec<_>>().join(", ")
        }
        Value::Array(items) => {
            let items = items.iter().map(|item| match item {
                Value::Object(_) | Value::Array(_) => format!("({})", in_words(item)),
                Value::String(text) => text.clone(),
                _ => in_words(item),
            });
            items.collect::<Vec<_>>().join(", ")
        }
        other => other.to_string(),
    }
}
