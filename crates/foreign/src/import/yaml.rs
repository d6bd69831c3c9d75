//! YAML text as a tree whose nodes know their places.
//!
//! What stands behind an anchor is shared and not copied, so that a small file cannot unfold to a
//! large one.

use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span};

/// Nesting of a file at most.
const DEEPEST: usize = 64;

/// Nodes of a file at most.
const MOST: usize = 1_000_000;

/// A value, where it stands, and its tag, such as `!quantity`.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) span: Range<usize>,
    pub(super) tag: Option<String>,
    pub(super) value: Yaml,
}

/// What a node holds.
#[derive(Debug)]
pub(super) enum Yaml {
    /// Text as it stands, and whether it stands in quotes.
    Scalar(String, bool),
    List(Vec<Rc<Node>>),
    Mapping(Vec<(Rc<Node>, Rc<Node>)>),
}

/// Why a text is no YAML: the place and the reason.
pub(super) type Wrong = (Range<usize>, String);

impl Node {
    /// The text of a scalar that is not null.
    pub(super) fn text(&self) -> Option<&str> {
        match &self.value {
            Yaml::Scalar(text, quoted) if *quoted || !is_null(text) => Some(text),
            _ => None,
        }
    }

    /// Whether it says that there is nothing.
    pub(super) fn is_null(&self) -> bool {
        matches!(&self.value, Yaml::Scalar(text, false) if is_null(text))
    }

    /// The member of a mapping under a key, where it is there and not null.
    pub(super) fn get(&self, key: &str) -> Option<&Node> {
        let Yaml::Mapping(members) = &self.value else { return None };
        let found = members.iter().find(|(name, _)| name.text() == Some(key));
        found.map(|(_, value)| value.as_ref()).filter(|value| !value.is_null())
    }

    /// The entries of a list.
    pub(super) fn entries(&self) -> &[Rc<Node>] {
        match &self.value {
            Yaml::List(entries) => entries,
            _ => &[],
        }
    }
}

fn is_null(text: &str) -> bool {
    matches!(text, "" | "~" | "null" | "Null" | "NULL" | "None")
}

/// A node that is not complete yet: its anchor, start and tag, and what it holds so far.
struct Open {
    anchor: usize,
    start: Span,
    tag: Option<String>,
    is_mapping: bool,
    held: Vec<Rc<Node>>,
}

/// The first document of a text.
pub(super) fn read(text: &str) -> Result<Rc<Node>, Wrong> {
    let places = Places::of(text);
    let failed = |error: ScanError| {
        let at = places.byte(error.marker().index());
        (at..at, error.info().to_owned())
    };
    let mut anchors: BTreeMap<usize, Rc<Node>> = BTreeMap::new();
    let mut open: Vec<Open> = Vec::new();
    let mut root = None;
    let mut count = 0;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(failed)?;
        let here = places.range(&span);
        count += 1;
        if count > MOST || open.len() > DEEPEST {
            return Err((here, "it is larger or deeper than any project".to_owned()));
        }
        let tagged = |tag: Option<std::borrow::Cow<'_, saphyr_parser::Tag>>| {
            tag.map(|tag| format!("{}{}", tag.handle, tag.suffix))
        };
        let (anchor, node) = match event {
            Event::Scalar(text, style, anchor, tag) => {
                let quoted = !matches!(style, ScalarStyle::Plain);
                let value = Yaml::Scalar(text.into_owned(), quoted);
                (anchor, Rc::new(Node { span: here, tag: tagged(tag), value }))
            }
            Event::Alias(anchor) => {
                let known = anchors.get(&anchor);
                let Some(node) = known else {
                    return Err((here, "it names an anchor that is not there yet".to_owned()));
                };
                (0, node.clone())
            }
            Event::SequenceStart(anchor, tag) => {
                let tag = tagged(tag);
                open.push(Open { anchor, start: span, tag, is_mapping: false, held: Vec::new() });
                continue;
            }
            Event::MappingStart(anchor, tag) => {
                let tag = tagged(tag);
                open.push(Open { anchor, start: span, tag, is_mapping: true, held: Vec::new() });
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => {
                let Some(done) = open.pop() else { continue };
                let start = places.range(&done.start);
                let value = if done.is_mapping {
                    let pairs = done.held.chunks_exact(2);
                    Yaml::Mapping(pairs.map(|of| (of[0].clone(), of[1].clone())).collect())
                } else {
                    Yaml::List(done.held)
                };
                let span = start.start..here.end.max(start.end);
                (done.anchor, Rc::new(Node { span, tag: done.tag, value }))
            }
            Event::DocumentEnd => break,
            _ => continue,
        };
        if anchor > 0 {
            anchors.insert(anchor, node.clone());
        }
        match open.last_mut() {
            Some(open) => open.held.push(node),
            None => root = Some(node),
        }
    }
    root.ok_or_else(|| (0..0, "there is nothing in it".to_owned()))
}

/// The bytes at which characters begin: the parser counts characters.
struct Places {
    starts: Vec<usize>,
    end: usize,
}

impl Places {
    fn of(text: &str) -> Self {
        Self { starts: text.char_indices().map(|(at, _)| at).collect(), end: text.len() }
    }

    fn byte(&self, character: usize) -> usize {
        self.starts.get(character).copied().unwrap_or(self.end)
    }

    fn range(&self, span: &Span) -> Range<usize> {
        self.byte(span.start.index())..self.byte(span.end.index())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_with_places() {
        let text = "- name: µ\n  list: [1, '2', null]\n  same: &a {x: 1.5}\n  again: *a\n";
        let root = read(text).unwrap();
        let first = &root.entries()[0];
        assert_eq!(first.get("name").unwrap().text(), Some("µ"));
        let list = first.get("list").unwrap();
        assert_eq!(list.entries()[1].text(), Some("2"));
        assert!(list.entries()[2].is_null() && list.entries()[2].text().is_none());
        assert_eq!(&text[list.entries()[0].span.clone()], "1");
        let again = first.get("again").unwrap();
        assert_eq!(again.get("x").unwrap().text(), Some("1.5"));
        assert_eq!(&text[again.get("x").unwrap().span.clone()], "1.5");
    }

    /// Nine levels of nine aliases each stand for 9^9 nodes.
    #[test]
    fn what_unfolds_or_nests_without_end() {
        let mut text = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n".to_owned();
        for level in 1..10 {
            let list = vec![format!("*a{}", level - 1); 9].join(", ");
            text += &format!("a{level}: &a{level} [{list}]\n");
        }
        assert!(read(&text).is_ok());
        assert!(read(&"[".repeat(100_000)).is_err());
        assert!(read(&"- ".repeat(100_000)).is_err());
        assert!(read("").is_err());
        assert!(read("a: *b\n").is_err());
        assert!(read("a: 'b\n").is_err());
    }
}
