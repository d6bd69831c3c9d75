//! Answers for programs as a tree whose objects keep the order of their keys.

use serde::{Serialize, Serializer};

/// A value of an answer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tree {
    /// Infinite, not defined, or not there.
    Null,
    Truth(bool),
    Whole(u64),
    Number(f64),
    Text(String),
    List(Vec<Tree>),
    Object(Vec<(String, Tree)>),
}

impl Tree {
    /// An object of these keys, in their order.
    pub(crate) fn object<K: Into<String>>(entries: impl IntoIterator<Item = (K, Self)>) -> Self {
        Self::Object(entries.into_iter().map(|(key, value)| (key.into(), value)).collect())
    }

    /// A list.
    pub(crate) fn list<T: Into<Self>>(items: impl IntoIterator<Item = T>) -> Self {
        Self::List(items.into_iter().map(Into::into).collect())
    }

    /// The tree as indented JSON, ending in a newline.
    pub(crate) fn json(&self) -> String {
        // a tree has no keys that are not text
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

impl Serialize for Tree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Null => serializer.serialize_unit(),
            Self::Truth(value) => serializer.serialize_bool(*value),
            Self::Whole(value) => serializer.serialize_u64(*value),
            // JSON has neither infinity nor what is not a number
            Self::Number(value) if !value.is_finite() => serializer.serialize_unit(),
            Self::Number(value) => serializer.serialize_f64(*value),
            Self::Text(text) => serializer.serialize_str(text),
            Self::List(items) => serializer.collect_seq(items),
            Self::Object(entries) => {
                serializer.collect_map(entries.iter().map(|(key, value)| (key, value)))
            }
        }
    }
}

impl From<f64> for Tree {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Option<f64>> for Tree {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Null, Self::Number)
    }
}

impl From<[f64; 2]> for Tree {
    fn from(ends: [f64; 2]) -> Self {
        Self::list(ends)
    }
}

impl From<Option<[f64; 2]>> for Tree {
    fn from(ends: Option<[f64; 2]>) -> Self {
        ends.map_or(Self::Null, Self::from)
    }
}

impl From<u64> for Tree {
    fn from(value: u64) -> Self {
        Self::Whole(value)
    }
}

impl From<bool> for Tree {
    fn from(value: bool) -> Self {
        Self::Truth(value)
    }
}

impl From<&str> for Tree {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_keep_their_order_and_numbers_their_digits() {
        let tree = Tree::object([
            ("z", Tree::from(0.1)),
            ("a", Tree::from(f64::INFINITY)),
            ("m", Tree::list([1.0, 2.5])),
        ]);
        let text: String = tree.json().split_whitespace().collect();
        assert_eq!(text, r#"{"z":0.1,"a":null,"m":[1.0,2.5]}"#);
    }
}
