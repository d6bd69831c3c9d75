//! Answers for programs: JSON values whose objects keep the order of their keys, and the text of
//! them. Numbers are in the shortest text that reads back as the same number; what is infinite or
//! not a number is `null`, because JSON has neither.

use std::fmt::Debug;

use serde::{Serialize, Serializer};
use serde_json::Value;

/// An object of these keys, in their order.
pub(crate) fn object<K: Into<String>, V: Into<Value>>(
    entries: impl IntoIterator<Item = (K, V)>,
) -> Value {
    entries.into_iter().collect()
}

/// A list.
pub(crate) fn list<T: Into<Value>>(items: impl IntoIterator<Item = T>) -> Value {
    items.into_iter().collect()
}

/// Indented JSON that ends in a newline.
pub(crate) fn pretty(answer: &impl Serialize) -> String {
    in_memory(|bytes| serde_json::to_writer_pretty(bytes, answer)) + "\n"
}

/// What `write` writes, as text.
///
/// # Panics
/// If `write` fails or does not write UTF-8. Nothing that is written here can: memory takes
/// everything, the keys of all objects are texts, and all records of a table have as many cells.
#[expect(clippy::expect_used, reason = "see above; an empty answer would be worse")]
pub(crate) fn in_memory<E: Debug>(write: impl FnOnce(&mut Vec<u8>) -> Result<(), E>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("writing to memory does not fail");
    String::from_utf8(bytes).expect("only texts are written")
}

/// Pairs as an object in their order, for fields of answers that are written piece by piece.
pub(crate) fn in_order<K: Serialize, V: Serialize, S: Serializer>(
    entries: &[(K, V)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(entries.iter().map(|(key, value)| (key, value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_keep_their_order_and_numbers_their_digits() {
        let answer = object([
            ("z", Value::from(0.1)),
            ("a", f64::INFINITY.into()),
            ("m", list([1.0, 2.5, 1e300, 5e-324])),
        ]);
        let text: String = pretty(&answer).split_whitespace().collect();
        assert_eq!(text, r#"{"z":0.1,"a":null,"m":[1.0,2.5,1e+300,5e-324]}"#);
    }
}
