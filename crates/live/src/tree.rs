//! The text of a file with the positions of all values. Comments and trailing commas are tolerated,
//! so that a text that the readers reject can still be edited.

use std::fmt;

use jsonc_parser::ast::{Object, ObjectProp, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

/// A step from a value to one inside it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum PathStep {
    /// Into a list, counted from 0.
    Place(usize),
    /// Into an object.
    Key(String),
}

impl fmt::Display for PathStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place(place) => place.fmt(f),
            Self::Key(key) => f.write_str(key),
        }
    }
}

/// The root of a text, if it can be parsed.
pub(crate) fn parse(text: &str) -> Result<Value<'_>, String> {
    let parsed = parse_to_ast(text, &CollectOptions::default(), &ParseOptions::default());
    match parsed {
        Ok(parsed) => parsed.value.ok_or_else(|| "the text is empty".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}

/// The member of that name.
pub(crate) fn member<'v, 't>(object: &'v Object<'t>, key: &str) -> Option<&'v ObjectProp<'t>> {
    object.properties.iter().find(|member| member.name.as_str() == key)
}

/// The value of a member of an object; `None` for anything else.
pub(crate) fn get<'v, 't>(value: &'v Value<'t>, key: &str) -> Option<&'v Value<'t>> {
    Some(&member(value.as_object()?, key)?.value)
}

/// The value behind a path.
pub(crate) fn at<'v, 't>(root: &'v Value<'t>, path: &[PathStep]) -> Option<&'v Value<'t>> {
    path.iter().try_fold(root, |value, step| match step {
        PathStep::Key(key) => get(value, key),
        PathStep::Place(place) => value.as_array()?.elements.get(*place),
    })
}

/// What a value says, for the fields of a form: numbers as they are written.
pub(crate) fn content(text: &str, value: &Value<'_>) -> Json {
    match value {
        Value::Object(object) => {
            let member =
                |of: &ObjectProp<'_>| (of.name.as_str().to_owned(), content(text, &of.value));
            Json::Object(object.properties.iter().map(member).collect())
        }
        Value::Array(array) => array.elements.iter().map(|of| content(text, of)).collect(),
        Value::BooleanLit(of) => Json::Bool(of.value),
        Value::NullKeyword(_) => Json::Null,
        Value::StringLit(_) | Value::NumberLit(_) => Json::String(raw(text, value)),
    }
}

/// A value as a user would type it: a text without its quotes, everything else unchanged.
pub(crate) fn raw(text: &str, value: &Value<'_>) -> String {
    match value {
        Value::StringLit(found) => found.value.clone().into_owned(),
        other => text.get(other.start()..other.end()).unwrap_or("").to_owned(),
    }
}

/// The path to the innermost value, or its key, at a position of the text.
pub(crate) fn path_to(root: &Value<'_>, byte: usize) -> Vec<PathStep> {
    let mut path = Vec::new();
    let mut value = root;
    loop {
        let next = match value {
            Value::Object(object) => {
                let found = object.properties.iter().find(|member| contains(*member, byte));
                found.map(|member| (PathStep::Key(member.name.as_str().to_owned()), &member.value))
            }
            Value::Array(array) => {
                let found = array.elements.iter().position(|element| contains(element, byte));
                found.map(|place| (PathStep::Place(place), &array.elements[place]))
            }
            _ => None,
        };
        let Some((step, inner)) = next else { return path };
        path.push(step);
        value = inner;
    }
}

fn contains(of: &impl Ranged, byte: usize) -> bool {
    (of.start()..of.end()).contains(&byte)
}

/// A path from keys.
pub(crate) fn path_of<const N: usize>(keys: [&str; N]) -> Vec<PathStep> {
    keys.into_iter().map(|key| PathStep::Key(key.to_owned())).collect()
}
