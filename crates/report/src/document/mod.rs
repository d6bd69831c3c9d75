//! A document without a format: its content in order. Markdown, LaTeX and HTML each draw the same
//! document, so that a number is rounded once and is the same everywhere.

mod beside;
mod html;
mod latex;
mod letterhead;
mod markdown;
mod text;

pub use beside::{FigureNames, PageWithFigures, with_figures};
pub(super) use html::{fragment, html};
pub use latex::equation_latex;
pub(super) use latex::latex;
#[cfg(test)]
pub(crate) use latex::unit::Declared;
pub(crate) use letterhead::Head;
pub(super) use markdown::{markdown, markdown_with_code};
pub(crate) use text::text;

use super::html::Drawing;
use super::sheet::Sheet;

/// A document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Document {
    /// The lines above the title of a text page, which are not wrapped.
    pub(crate) first: Vec<String>,
    /// What a text page says below these lines.
    pub(crate) remarks: Vec<String>,
    /// Its title; a text page may have none.
    pub(crate) title: String,
    /// Lines below the title.
    pub(crate) subtitle: Vec<String>,
    /// The language of its texts, as a code of ISO 639-1; empty means English.
    pub(crate) language: &'static str,
    /// Whether numbers in tables have a decimal comma; the cells of [`Sheet`]s have points.
    pub(crate) comma: bool,
    /// Whether it is for a terminal, where figures are drawn in characters.
    pub(crate) terminal: bool,
    /// The head of the first page.
    pub(crate) head: Option<Head>,
    /// The footer of printed pages; by default the title.
    pub(crate) foot: Option<Foot>,
    /// What it says.
    pub(crate) blocks: Vec<Block>,
}

/// The footer of printed pages.
#[derive(Clone, Debug)]
pub(crate) struct Foot {
    /// What the page belongs to.
    pub(crate) about: String,
    /// The page number: `{page}`, `{pages}`.
    pub(crate) page: String,
}

impl Foot {
    /// The footer of a document that is identified by its title.
    pub(crate) fn of_title(title: &str) -> Self {
        Self { about: title.to_owned(), page: "{page} / {pages}".to_owned() }
    }

    /// The parts of the text with the page number.
    pub(crate) fn parts(&self) -> Vec<FootPart<'_>> {
        let mut parts = Vec::new();
        let mut rest = self.page.as_str();
        while let Some((before, after)) = rest.split_once('{') {
            parts.push(FootPart::Text(before));
            let (name, behind) = after.split_once('}').unwrap_or((after, ""));
            parts.push(if name == "pages" { FootPart::Pages } else { FootPart::Page });
            rest = behind;
        }
        parts.push(FootPart::Text(rest));
        parts.retain(|part| !matches!(part, FootPart::Text("")));
        parts
    }
}

/// A part of a [`Foot`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FootPart<'a> {
    /// A text.
    Text(&'a str),
    /// The number of the page.
    Page,
    /// The number of pages.
    Pages,
}

/// A part of a document.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    /// The title of a section.
    Section(String),
    /// A paragraph.
    Text(String),
    /// Highlighted sentences, the first one emphasized.
    Verdict(Vec<String>),
    /// A list of sentences.
    List(Vec<String>),
    /// A table.
    Table(Sheet),
    /// A figure: part of an HTML page, and a file beside a Markdown or LaTeX page ([`with_figures`]).
    Figure(Drawing),
    /// A figure drawn in characters, which only pages for a terminal show; each line ends in a newline.
    Characters(String),
    /// A part in another language than the document's, with its code of ISO 639-1.
    InLanguage(&'static str, Box<Block>),
    /// Parts that an HTML page shows on request, below their title.
    Folded(String, Vec<Block>),
    /// Places to be filled in by hand, each with its label.
    Signature(Vec<String>),
    /// The mark at the end of the document.
    End(String),
    /// A literal text, with its description.
    Listing {
        /// What it is.
        about: String,
        /// The text.
        text: String,
    },
}

impl Document {
    /// The footer of printed pages.
    pub(crate) fn foot(&self) -> Foot {
        self.foot.clone().unwrap_or_else(|| Foot::of_title(&self.title))
    }

    /// Adds a section with its title.
    pub(crate) fn section(&mut self, title: impl Into<String>) {
        self.blocks.push(Block::Section(title.into()));
    }

    /// Adds a paragraph.
    pub(crate) fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds a paragraph in a language, `de`.
    pub(crate) fn text_in(&mut self, language: &'static str, text: impl Into<String>) {
        self.push_in(language, Block::Text(text.into()));
    }

    /// Adds a list of sentences in a language.
    pub(crate) fn list_in(&mut self, language: &'static str, items: Vec<String>) {
        self.push_in(language, Block::List(items));
    }

    fn push_in(&mut self, language: &'static str, block: Block) {
        self.blocks.push(match language == self.language {
            true => block,
            false => Block::InLanguage(language, Box::new(block)),
        });
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

    /// Adds a figure, if there is one, as the document's pages show it.
    pub(crate) fn picture(
        &mut self,
        drawn: impl FnOnce() -> Option<Drawing>,
        in_characters: impl FnOnce() -> Option<String>,
    ) {
        self.blocks.extend(match self.terminal {
            true => in_characters().map(Block::Characters),
            false => drawn().map(Block::Figure),
        });
    }

    /// The blocks in a format without figures, without parts that are empty there: a section with
    /// only figures disappears.
    fn written(&self, written: impl FnMut(&Block) -> String) -> Vec<String> {
        let all: Vec<String> = self.blocks.iter().map(written).collect();
        let all = self.blocks.iter().zip(all).filter(|(_, part)| !part.is_empty());
        let mut left: Vec<(&Block, String)> = Vec::new();
        let is_section = |of: &Block| matches!(of, Block::Section(_));
        for (of, part) in all {
            if is_section(of) {
                left.pop_if(|(last, _)| is_section(last));
            }
            left.push((of, part));
        }
        left.pop_if(|(last, _)| is_section(last));
        left.into_iter().map(|(_, part)| part).collect()
    }
}

/// A sentence with its capital and full stop. A name at the beginning is unchanged.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_foot_says_which_page_it_is() {
        let foot = Foot { about: String::new(), page: "Page {page} of {pages}".to_owned() };
        let parts =
            [FootPart::Text("Page "), FootPart::Page, FootPart::Text(" of "), FootPart::Pages];
        assert_eq!(foot.parts(), parts);
    }
}
