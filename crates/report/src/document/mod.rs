//! A document without a look: what it says, in order. Markdown, LaTeX and HTML each draw the same
//! one, so that a figure is rounded once and says the same everywhere.

mod html;
mod latex;
mod markdown;
mod text;

pub(super) use html::html;
pub(super) use latex::latex;
#[cfg(test)]
pub(crate) use latex::unit::Declared;
pub(super) use markdown::{markdown, markdown_with_code};
pub(crate) use text::{below, text};

use super::html::Drawing;
use super::sheet::Sheet;

/// A document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Document {
    /// Its title.
    pub(crate) title: String,
    /// Lines below the title.
    pub(crate) subtitle: Vec<String>,
    /// The language of its texts, as ISO 639-1 has it; English if that is empty.
    pub(crate) language: &'static str,
    /// What it says.
    pub(crate) blocks: Vec<Block>,
}

/// A part of a document.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    /// The title of a section.
    Section(String),
    /// A paragraph.
    Text(String),
    /// Sentences that are set off, the first one stressed.
    Verdict(Vec<String>),
    /// A list of sentences.
    List(Vec<String>),
    /// A table.
    Table(Sheet),
    /// A figure, which only pages of a browser show.
    Figure(Drawing),
    /// A text that stands as it is, with what it is.
    Listing {
        /// What it is.
        about: String,
        /// The text.
        text: String,
    },
}

impl Document {
    /// Adds a section with its title.
    pub(crate) fn section(&mut self, title: impl Into<String>) {
        self.blocks.push(Block::Section(title.into()));
    }

    /// Adds a paragraph.
    pub(crate) fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds a paragraph of one sentence that is written without its capital and full stop.
    pub(crate) fn sentence(&mut self, text: &str) {
        self.text(sentence(text));
    }

    /// Adds a table.
    pub(crate) fn table(&mut self, sheet: Sheet) {
        self.blocks.push(Block::Table(sheet));
    }

    /// Adds a figure, if there is one.
    pub(crate) fn figure(&mut self, drawing: Option<Drawing>) {
        self.blocks.extend(drawing.map(Block::Figure));
    }
}

/// A sentence with its capital and full stop. What begins with a name keeps it as it is.
pub(crate) fn sentence(text: &str) -> String {
    let (word, _) = text.split_once([' ', ':']).unwrap_or((text, ""));
    let mut letters = text.chars();
    match letters.next() {
        Some(first) if word.chars().all(|c| c.is_ascii_lowercase()) => {
            format!("{}{}.", first.to_ascii_uppercase(), letters.as_str())
        }
        _ => format!("{text}."),
    }
}
