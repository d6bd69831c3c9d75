//! JSON values of the schema, put together member by member in the order in which they are read.

use serde_json::{Map, Value};

/// An object with the given members.
pub(crate) fn object<K: Into<String>>(members: impl IntoIterator<Item = (K, Value)>) -> Value {
    let members = members.into_iter().map(|(key, value)| (key.into(), value));
    Value::Object(members.collect::<Map<_, _>>())
}

/// A list of texts.
pub(crate) fn texts<'t>(texts: impl IntoIterator<Item = &'t str>) -> Value {
    texts.into_iter().collect()
}

/// A reference to one of the definitions.
pub(crate) fn reference(name: &str) -> Value {
    object([("$ref", Value::from(format!("#/$defs/{name}")))])
}

/// Objects that grow.
pub(crate) trait With {
    /// The same object with one more member.
    #[must_use]
    fn with(self, key: &str, value: impl Into<Value>) -> Self;
}

impl With for Value {
    fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        if let Self::Object(members) = &mut self {
            members.insert(key.to_owned(), value.into());
        }
        self
    }
}
