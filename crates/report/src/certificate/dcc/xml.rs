//! Writes XML: elements, and texts in several languages.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

use crate::answer::in_memory;
use gumption_analysis::certificate::contents::{Language, Localized};
use gumption_text::is_obeyed;

/// A document in memory.
#[allow(missing_debug_implementations)] // the library's writer has none
pub(super) struct Xml {
    writer: Writer<Vec<u8>>,
    written: io::Result<()>,
}

impl Xml {
    pub(super) fn new() -> Self {
        let writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        let mut xml = Self { writer, written: Ok(()) };
        xml.put(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
        xml
    }

    fn put(&mut self, event: Event<'_>) {
        let written = self.writer.write_event(event);
        if self.written.is_ok() {
            self.written = written;
        }
    }

    /// An element with attributes and the content that `inside` writes.
    pub(super) fn within(
        &mut self,
        name: &str,
        attributes: &[(&str, &str)],
        inside: impl FnOnce(&mut Self),
    ) {
        let start = BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.put(Event::Start(start));
        inside(self);
        self.put(Event::End(BytesEnd::new(name)));
    }

    /// An element with the content that `inside` writes.
    pub(super) fn element(&mut self, name: &str, inside: impl FnOnce(&mut Self)) {
        self.within(name, &[], inside);
    }

    /// An element with a text.
    pub(super) fn leaf(&mut self, name: &str, text: &str) {
        self.leaf_with(name, &[], text);
    }

    /// An element with attributes and a text.
    pub(super) fn leaf_with(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) {
        // the schema rejects spaces at the ends of many texts
        let text: String = text.trim().chars().filter(|c| is_allowed(*c)).collect();
        let start = BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.put(Event::Start(start));
        self.put(Event::Text(BytesText::new(&text)));
        self.put(Event::End(BytesEnd::new(name)));
    }

    /// The contents of a text in each language.
    pub(super) fn contents(&mut self, text: &Localized, languages: &[Language]) {
        for language in languages {
            self.leaf_with("dcc:content", &[("lang", language.code())], text.get(*language));
        }
    }

    /// An element with a text in each language.
    pub(super) fn text(&mut self, name: &str, text: &Localized, languages: &[Language]) {
        self.element(name, |xml| xml.contents(text, languages));
    }

    /// The whole document, ending in a newline.
    pub(super) fn finish(self) -> String {
        in_memory(|bytes| {
            *bytes = self.writer.into_inner();
            self.written
        }) + "\n"
    }
}

/// Whether XML 1.0 allows a character, and terminals do not interpret it.
fn is_allowed(c: char) -> bool {
    matches!(c, '\t' | '\n') || !(is_obeyed(c) || matches!(c, '\u{fffe}' | '\u{ffff}'))
}
