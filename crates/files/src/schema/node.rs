//! JSON whose keys keep the order in which they were written, so that the schema can be read.

use serde::ser::{Serialize, SerializeMap, Serializer};

/// A JSON value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    Truth(bool),
    Number(f64),
    Whole(u64),
    Text(String),
    List(Vec<Node>),
    Object(Vec<(String, Node)>),
}

/// An object with the given members.
pub(super) fn object<K: Into<String>>(members: impl IntoIterator<Item = (K, Node)>) -> Node {
    Node::Object(members.into_iter().map(|(key, value)| (key.into(), value)).collect())
}

/// A list of texts.
pub(super) fn texts<'t>(texts: impl IntoIterator<Item = &'t str>) -> Node {
    Node::List(texts.into_iter().map(Node::from).collect())
}

/// A reference to one of the definitions.
pub(super) fn reference(name: &str) -> Node {
    object([("$ref", Node::from(format!("#/$defs/{name}")))])
}

impl Node {
    /// The same object with one more member.
    #[must_use]
    pub(super) fn with(self, key: &str, value: impl Into<Node>) -> Self {
        match self {
            Self::Object(mut members) => {
                members.push((key.to_owned(), value.into()));
                Self::Object(members)
            }
            other => other,
        }
    }
}

impl From<&str> for Node {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Node {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<bool> for Node {
    fn from(truth: bool) -> Self {
        Self::Truth(truth)
    }
}

impl From<f64> for Node {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Node {
    fn from(number: u64) -> Self {
        Self::Whole(number)
    }
}

impl From<Vec<Node>> for Node {
    fn from(list: Vec<Self>) -> Self {
        Self::List(list)
    }
}

impl Serialize for Node {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Truth(truth) => truth.serialize(serializer),
            // limits such as 1, which read better without a decimal point
            Self::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
                (*number as i64).serialize(serializer)
            }
            Self::Number(number) => number.serialize(serializer),
            Self::Whole(number) => number.serialize(serializer),
            Self::Text(text) => text.serialize(serializer),
            Self::List(list) => list.serialize(serializer),
            Self::Object(members) => {
                let mut map = serializer.serialize_map(Some(members.len()))?;
                for (key, value) in members {
                    map.serialize_entry(key, value)?;
                }
                map.end()
            }
        }
    }
}
