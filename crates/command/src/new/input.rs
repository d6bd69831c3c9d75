//! Inputs of a new file, as they are told: a value with its uncertainty, or a distribution.

use std::path::Path;

use serde_json::{Map, Value, json};

use gumption_files::{FileReader, schema};
use gumption_units::{Unit, nearest};

/// An input without values.
pub(super) fn blank() -> Value {
    let keys = [
        ("unit", Value::Null),
        ("distribution", json!("normal")),
        ("mean", Value::Null),
        ("std", Value::Null),
    ];
    Value::Object(keys.into_iter().map(|(key, value)| (key.to_owned(), value)).collect())
}

/// Whether a text begins as a distribution does, and not as a value: with a letter.
pub(super) fn is_distribution(text: &str) -> bool {
    text.starts_with(char::is_alphabetic)
}

/// An input as it stands in an option: `5.0112(23) V`, or `ohm,normal,mean=100,std=0.2`. A number is a
/// value, and a unit begins with a letter or a sign.
///
/// # Errors
/// What is wrong, as a sentence.
pub(super) fn told(files: FileReader<'_>, name: &str, text: &str) -> Result<Value, String> {
    let mut parts = text.split(',').map(str::trim);
    let (unit, shape) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default());
    // `2 V, U = 0.1 V, k = 2` is a value
    let has_unit = is_distribution(shape) && !shape.contains('=') && Unit::parse(unit).is_ok();
    if has_unit || is_distribution(text) {
        return described(text);
    }
    value(files, name, text)
}

/// A value with its uncertainty, as a model file takes it.
///
/// # Errors
/// What a model file would say of it.
pub(super) fn value(files: FileReader<'_>, name: &str, text: &str) -> Result<Value, String> {
    let output = format!("value_of_{name}");
    let file = json!({
        "format": 2,
        "check_units": false,
        "inputs": {name: text},
        "equations": {&output: name},
        "outputs": {&output: {}},
    });
    let read = files.check_text("the answer", &file.to_string(), Path::new(""));
    match read {
        Ok(_) => Ok(json!(text)),
        Err(found) => {
            let reasons: Vec<String> = found.0.iter().map(|found| found.kind.to_string()).collect();
            Err(reasons.join("; "))
        }
    }
}

/// An input as a unit and a distribution: `ohm,normal,mean=100,std=0.2`.
///
/// # Errors
/// What is wrong, as a sentence.
pub(super) fn described(said: &str) -> Result<Value, String> {
    let mut parts = said.split(',').map(str::trim);
    let unit = parts.next().unwrap_or_default();
    unit_of(unit)?;
    let shapes = schema::distributions();
    let name = parts.next().unwrap_or_default();
    let known = |name: &str| shapes.iter().find(|of| of.name == name || of.aliases.contains(&name));
    let Some(shape) = known(name) else {
        let names = shapes.iter().flat_map(|of| std::iter::once(&of.name).chain(of.aliases));
        let hint = match nearest(name, names.copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "`gumption help distributions` lists them".to_owned(),
        };
        return Err(format!("there is no distribution `{name}`; {hint}"));
    };
    let mut keys = Map::new();
    keys.insert("unit".into(), json!(unit));
    keys.insert("distribution".into(), json!(shape.name));
    for part in parts {
        let Some((key, value)) = part.split_once('=') else {
            return Err(format!("`{part}` is not of the form KEY=VALUE"));
        };
        let (key, value) = (key.trim(), value.trim());
        if !shape.keys.contains(&key) && key != "about" {
            let near = nearest(key, shape.keys.iter().copied());
            let hint = near.map_or_else(
                || format!("it has {}", shape.keys.join(", ")),
                |near| format!("did you mean `{near}`?"),
            );
            return Err(format!("`{}` has no key `{key}`; {hint}", shape.name));
        }
        if keys.insert(key.to_owned(), read(key, value)).is_some() {
            return Err(format!("`{key}` is given twice"));
        }
    }
    Ok(Value::Object(keys))
}

/// A value as JSON: a number, a list of numbers if the key holds one, else a text.
fn read(key: &str, value: &str) -> Value {
    let number = |text: &str| serde_json::from_str::<serde_json::Number>(text).map(Value::Number);
    if key == "values" {
        let list: Result<Vec<Value>, _> = value.split_whitespace().map(number).collect();
        return list.map_or_else(|_| json!(value), Value::Array);
    }
    number(value).unwrap_or_else(|_| json!(value))
}

/// Whether a text is a unit.
///
/// # Errors
/// What is wrong, as a sentence.
pub(super) fn unit_of(text: &str) -> Result<(), String> {
    Unit::parse(text).map(|_| ()).map_err(|why| why.to_string())
}
