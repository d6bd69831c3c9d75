//! Answers for programs: JSON values whose objects keep the order of their keys, and the text of
//! them. Numbers are in the shortest text that reads back as the same number; what is infinite or
//! not a number is `null`, because JSON has neither.

use std::fmt::Debug;
use std::io::{self, Write};

use serde::Serialize;
use serde_json::Value;
use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter, Serializer};

use gumption_text::is_obeyed;

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

/// Indented JSON that ends in a newline. Characters that a terminal would obey, and those without a
/// width, are escaped.
pub fn pretty(answer: &impl Serialize) -> String {
    in_memory(|bytes| write_pretty(answer, bytes)) + "\n"
}

/// Writes what [`pretty`] gives, but for the newline.
pub(crate) fn write_pretty(answer: &impl Serialize, out: &mut dyn Write) -> serde_json::Result<()> {
    answer.serialize(&mut Serializer::with_formatter(out, Printable(PrettyFormatter::new())))
}

/// As [`pretty`], on one line without an end.
pub fn on_one_line(answer: &impl Serialize) -> String {
    in_memory(|bytes| {
        answer.serialize(&mut Serializer::with_formatter(bytes, Printable(CompactFormatter)))
    })
}

/// JSON whose texts are of printable characters.
struct Printable<F>(F);

macro_rules! as_usual {
    ($($name:ident($($argument:ident: $kind:ty),*);)*) => {
        $(
            fn $name<W: ?Sized + Write>(&mut self, out: &mut W $(, $argument: $kind)*) -> io::Result<()> {
                self.0.$name(out $(, $argument)*)
            }
        )*
    };
}

impl<F: Formatter> Formatter for Printable<F> {
    as_usual! {
        begin_array();
        end_array();
        begin_array_value(first: bool);
        end_array_value();
        begin_object();
        end_object();
        begin_object_key(first: bool);
        begin_object_value();
        end_object_value();
    }

    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        out: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        let mut rest = fragment;
        while let Some((at, c)) = rest.char_indices().find(|(_, c)| is_obeyed(*c)) {
            out.write_all(&rest.as_bytes()[..at])?;
            for unit in c.encode_utf16(&mut [0; 2]) {
                write!(out, "\\u{unit:04x}")?;
            }
            rest = &rest[at + c.len_utf8()..];
        }
        out.write_all(rest.as_bytes())
    }
}

/// Indented JSON whose lists stand on one line.
#[derive(Default)]
pub(crate) struct ListsOnOneLine(PrettyFormatter<'static>);

impl Formatter for ListsOnOneLine {
    as_usual! {
        begin_object();
        end_object();
        begin_object_key(first: bool);
        begin_object_value();
        end_object_value();
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        out.write_all(if first { b"" } else { b", " })
    }
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
pub(crate) fn in_order<K: Serialize, V: Serialize, S: serde::Serializer>(
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

    #[test]
    fn texts_are_escaped_as_far_as_a_terminal_would_obey_them() {
        let text = "\u{1b}[2J\u{9b}2J\u{202e}\u{feff}µ \"\n";
        let answer = pretty(&object([(text, text)]));
        assert!(answer.contains(r#""\u001b[2J\u009b2J\u202e\ufeffµ \"\n""#), "{answer}");
        let read: Value = serde_json::from_str(&answer).unwrap();
        assert_eq!(read[text], text);
    }
}
