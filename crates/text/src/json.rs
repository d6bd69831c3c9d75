//! JSON with positions: each value is a part of the text, and where the part begins is its position.

use std::fmt;
use std::ops::Range;

use compact_str::CompactString;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::DiagnosticKind;
use super::source::SourceText;

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its half-open range of bytes in the text.
    pub span: Range<usize>,
    /// What it is.
    pub value: Json,
}

/// A JSON value. Numbers keep their text.
#[derive(Clone, Debug, PartialEq)]
pub enum Json {
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A number as it is written.
    Number(CompactString),
    /// A text without its quotation marks.
    Text(String),
    /// The elements of a list.
    List(Vec<Node>),
    /// The members of an object, in the order of the text.
    Object(Vec<Member>),
}

/// A key with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// The key.
    pub key: String,
    /// The half-open range of bytes of the key, with its quotation marks.
    pub key_span: Range<usize>,
    /// The value.
    pub value: Node,
}

impl Json {
    /// A number or a text as it is written.
    pub fn written(&self) -> Option<&str> {
        match self {
            Self::Number(text) => Some(text),
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// What it is, in words.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Null => "null",
            Self::Bool(_) => "true or false",
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Object(_) => "an object",
        }
    }
}

impl Node {
    /// The number, if it is one. A number beyond the range of double precision does not get here.
    pub fn number(&self) -> Option<f64> {
        match &self.value {
            Json::Number(text) => text.parse().ok(),
            _ => None,
        }
    }

    /// All texts in the value and all keys of its objects.
    pub fn texts(&self) -> Vec<&str> {
        match &self.value {
            Json::Text(text) => vec![text],
            Json::List(nodes) => nodes.iter().flat_map(Self::texts).collect(),
            Json::Object(members) => members
                .iter()
                .flat_map(|member| [vec![member.key.as_str()], member.value.texts()].concat())
                .collect(),
            Json::Null | Json::Bool(_) | Json::Number(_) => Vec::new(),
        }
    }
}

/// Parses a whole text.
#[allow(clippy::result_large_err)] // once for a file
pub fn parse(source: &SourceText) -> Result<Node, (Range<usize>, DiagnosticKind)> {
    if source.text.trim().is_empty() {
        return Err((0..0, DiagnosticKind::Empty));
    }
    if let Err(error) = serde_json::from_str::<Checked>(&source.text) {
        return Err(mistake(source, &error));
    }
    let whole = serde_json::from_str(&source.text).and_then(|raw| node(&source.text, raw));
    // it was checked, so this is not expected
    whole.map_err(|error| mistake(source, &error))
}

/// A value that accepts any JSON and keeps nothing.
struct Checked;

impl<'de> Deserialize<'de> for Checked {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Self)
    }
}

impl<'de> Visitor<'de> for Checked {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_bool<E>(self, _: bool) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_str<E>(self, _: &str) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_unit<E>(self) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self, A::Error> {
        while list.next_element::<Self>()?.is_some() {}
        Ok(self)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self, A::Error> {
        while map.next_entry::<Self, Self>()?.is_some() {}
        Ok(self)
    }
}

/// What the parser says of a text without its position, and the position as a half-open range of bytes.
pub fn mistake(source: &SourceText, error: &serde_json::Error) -> (Range<usize>, DiagnosticKind) {
    let full = error.to_string();
    let message = full.split(" at line ").next().unwrap_or(&full).to_owned();
    let start = source.line_start(error.line());
    let line = source.text.get(start..).and_then(|rest| rest.lines().next()).unwrap_or("");
    // the parser counts bytes within the line
    let mut at = (start + error.column().saturating_sub(1)).min(source.text.len());
    while at > 0 && !source.text.is_char_boundary(at) {
        at -= 1;
    }
    if at >= start + line.len() && !line.is_empty() {
        // a line end cannot be underlined, so its last character is
        at = start + line.char_indices().next_back().map_or(0, |(i, _)| i);
    }
    let first = source.text.get(at..).and_then(|rest| rest.chars().next());
    let whole = word(&source.text, at);
    let bare = source.text.get(whole.clone()).unwrap_or("").trim_start_matches(['-', '+']);
    let not_finite = ["NaN", "nan", "Inf", "inf"].iter().any(|name| bare.starts_with(name));
    if not_finite {
        (whole, DiagnosticKind::NotFiniteInJson)
    } else if message.contains("number out of range") {
        (whole, DiagnosticKind::NumberTooLarge)
    } else {
        let before = source.text.get(..at).unwrap_or("");
        let mut message = in_plain_words(&message, first, before);
        if before.trim().is_empty()
            && let Some(way) = way_in(&source.name)
        {
            message.push_str(way);
        }
        (at..at + first.map_or(0, char::len_utf8), DiagnosticKind::NotJson { message })
    }
}

/// How to convert a file of another format, recognized by its name, into a model file.
fn way_in(name: &str) -> Option<&'static str> {
    const BUDGETS: [&str; 4] = ["csv", "tsv", "xlsx", "xlsm"];
    let (_, extension) = name.rsplit_once('.')?;
    BUDGETS.contains(&extension.to_lowercase().as_str()).then_some(
        "; `gumption import` converts an uncertainty budget in a spreadsheet into a model file",
    )
}

/// The range of the number or bare word at a position.
fn word(text: &str, at: usize) -> Range<usize> {
    let belongs = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '+');
    let before = text.get(..at).unwrap_or("");
    let start = before.trim_end_matches(belongs).len();
    let after = text.get(at..).unwrap_or("");
    let length = after.find(|c| !belongs(c)).unwrap_or(after.len());
    start..at + length
}

/// Whether a character is a quotation mark that JSON does not know.
fn is_other_quote(c: char) -> bool {
    matches!(c, '\'' | '`' | '´' | '‘' | '’' | '‚' | '“' | '”' | '„' | '«' | '»')
}

/// Whether only a part of a word precedes, as in the text `title: a budget`.
fn is_first_word(before: &str) -> bool {
    before.trim_start().chars().all(char::is_alphabetic)
}

/// What would be right, for parser messages that do not say it.
fn in_plain_words(message: &str, found: Option<char>, before: &str) -> String {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let is_key = message == "key must be a string";
    let words = match message {
        "expected value" | "key must be a string" if found.is_some_and(is_other_quote) => {
            "texts and keys need straight double quotes, `\"`"
        }
        _ if is_key
            && digit(found)
            && before.strip_suffix(',').is_some_and(|b| digit(b.chars().next_back())) =>
        {
            "write a decimal fraction with a point, such as 5.01, not with a comma"
        }
        "expected ident" if is_first_word(before) => {
            "a file begins with `{` and its keys are in double quotes; YAML and TOML are not read, \
             and \
             budgets of other programs by `gumption import`"
        }
        "expected value" | "expected ident" => {
            "a value is expected here: a number, a text in double quotes, true, false, null, a \
             list or an object"
        }
        "key must be a string" if found == Some('/') => {
            "it has no comments; `about`, `title` and `source` take texts"
        }
        "key must be a string" => "a key in double quotes is expected here",
        "trailing comma" => "there is a comma before this end of a list or object; remove it",
        "trailing characters" => "there is more after the end of the value",
        "expected `,` or `}`" | "expected `,` or `]`" => {
            return format!("{} is missing before this", message.replace("expected ", ""));
        }
        "expected `:`" => "a colon is missing between key and value",
        "invalid number" => {
            "write a number like 0.5, -3 or 1e-6: with digits on both sides of a point, \
             without leading zeros or a plus sign"
        }
        "recursion limit exceeded" => "more than 127 lists and objects are nested",
        _ if message.starts_with("EOF") => "the text ends before a text, list or object is closed",
        _ if message.starts_with("control character") => {
            "a text in quotes must end on the line on which it begins; write a line break as `\\n`"
        }
        other => other,
    };
    words.to_owned()
}

/// The value that is `raw`, a part of the text.
fn node(text: &str, raw: &RawValue) -> serde_json::Result<Node> {
    let own = raw.get();
    let value = match own.as_bytes().first() {
        Some(b'n') => Json::Null,
        Some(b't' | b'f') => Json::Bool(own == "true"),
        Some(b'"') => Json::Text(serde_json::from_str(own)?),
        Some(b'[') => {
            let elements: Vec<&RawValue> = serde_json::from_str(own)?;
            let mut list = Vec::with_capacity(elements.len());
            for raw in elements {
                list.push(node(text, raw)?);
            }
            Json::List(list)
        }
        Some(b'{') => {
            let Members(members) = serde_json::from_str(own)?;
            let member = |(key, value): (&RawValue, &RawValue)| {
                Ok(Member {
                    key_span: place(text, key),
                    key: serde_json::from_str(key.get())?,
                    value: node(text, value)?,
                })
            };
            Json::Object(members.into_iter().map(member).collect::<Result<_, _>>()?)
        }
        _ => Json::Number(own.into()),
    };
    Ok(Node { span: place(text, raw), value })
}

/// The half-open range of bytes of a part of the text.
fn place(text: &str, part: &RawValue) -> Range<usize> {
    let start = part.get().as_ptr().addr() - text.as_ptr().addr();
    start..start + part.get().len()
}

/// The keys and values of an object as they are written, in the order of the text.
struct Members<'t>(Vec<(&'t RawValue, &'t RawValue)>);

impl<'de> Deserialize<'de> for Members<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Self(Vec::new()))
    }
}

impl<'de> Visitor<'de> for Members<'de> {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<Self, A::Error> {
        while let Some(member) = map.next_entry()? {
            self.0.push(member);
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> (String, DiagnosticKind) {
        let source = SourceText::new("x", text);
        let (span, diagnostic) = parse(&source).unwrap_err();
        (source.text[span].to_owned(), diagnostic)
    }

    #[test]
    fn values_know_their_places() {
        let source = SourceText::new("x", r#"{"a": [1, {"b": "ü"}]}"#);
        let node = parse(&source).unwrap();
        let Json::Object(members) = &node.value else { panic!() };
        assert_eq!(&source.text[members[0].key_span.clone()], "\"a\"");
        let Json::List(list) = &members[0].value.value else { panic!() };
        assert_eq!(&source.text[list[1].span.clone()], r#"{"b": "ü"}"#);
    }

    #[test]
    fn mistakes_of_syntax() {
        assert_eq!(at("  \n "), (String::new(), DiagnosticKind::Empty));
        assert!(matches!(at("{\"a\": 1,}").1, DiagnosticKind::NotJson { .. }));
        assert_eq!(at("{\"a\": NaN}").1, DiagnosticKind::NotFiniteInJson);
        assert_eq!(at("{\"a\": -Infinity}").1, DiagnosticKind::NotFiniteInJson);
        assert_eq!(at("{\"a\": 1e999}").1, DiagnosticKind::NumberTooLarge);
        let deep = "[".repeat(100_000);
        assert!(matches!(at(&deep).1, DiagnosticKind::NotJson { .. }));
        assert_eq!(at("[-Infinity]").0, "-Infinity");
        assert_eq!(at("[1e999, 2]").0, "1e999");
    }
}
