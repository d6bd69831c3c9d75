//! A document as a text page for a terminal.

use super::{Block, Document};
use crate::sheet::{Kind, Sheet};
use crate::{Grid, plain, table::width, wrapped};

/// A line for a signature.
const RULE: &str = "________________________________";

/// Minimum number of letters per line of a text, however narrow the page is.
const LEAST_TEXT: usize = 10;

/// The whole document, ending in a newline; blocks that text cannot show are left out.
pub(crate) fn text(document: &Document) -> String {
    let mut parts = vec![heading(&document.title, '═')];
    parts.push(document.subtitle.iter().map(|line| wrapped(line)).collect());
    parts.push(below(document));
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

/// The part below title and subtitle.
pub(crate) fn below(document: &Document) -> String {
    document.written(|part| block(part, document.comma)).join("\n")
}

fn heading(title: &str, rule: char) -> String {
    let title = plain(title);
    let rule: String = std::iter::repeat_n(rule, title.chars().count().min(width())).collect();
    format!("{}{rule}\n", wrapped(&title))
}

fn block(block: &Block, comma: bool) -> String {
    match block {
        Block::Table(sheet) if comma => {
            self::block(&Block::Table(sheet.clone().with_commas()), false)
        }
        Block::Section(title) => heading(title, '─'),
        Block::Text(text) => wrapped(text),
        Block::InLanguage(_, part) => self::block(part, comma),
        Block::Verdict(sentences) => sentences.iter().map(|said| wrapped(said)).collect(),
        Block::List(items) => items.iter().map(|item| wrapped(&format!("- {item}"))).collect(),
        Block::Table(sheet) if !sheet.has_headers() => Grid::of(sheet).bare(width()),
        Block::Table(sheet) => grid(sheet).render(width()),
        Block::Figure(_) => String::new(),
        Block::Folded(title, blocks) => {
            let blocks: String = blocks.iter().map(|part| self::block(part, comma)).collect();
            heading(title, '─') + &blocks
        }
        Block::Signature(places) => {
            let line = |place: &String| format!("\n{RULE}\n{}", wrapped(place));
            places.iter().map(line).collect()
        }
        Block::End(text) => wrapped(&format!("— {text} —")),
        Block::Listing { about, text } => format!("{}{}\n", wrapped(about), text.trim_end()),
    }
}

/// A table in which only long texts wrap.
fn grid(sheet: &Sheet) -> Grid {
    let mut grid = Grid::default();
    for column in &sheet.columns {
        let cells = column.cells.iter().cloned();
        match column.kind {
            Kind::Numbers => grid.numbers(&column.header, cells),
            Kind::Text | Kind::Equations => grid.text_from(&column.header, LEAST_TEXT, cells),
            Kind::Units => grid.units(&column.header, cells),
        }
    }
    grid
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_is_a_page() {
        let mut document = Document { title: "Title".to_owned(), ..Document::default() };
        let mut sheet = Sheet::default();
        sheet.text("", ["a".to_owned()]);
        sheet.text("", ["b".to_owned()]);
        document.table(sheet);
        document.section("Results");
        let mut sheet = Sheet::default();
        sheet.numbers("value", ["1.5".to_owned(), "10".to_owned()]);
        sheet.units("unit", ["m/s^2".to_owned(), "m".to_owned()]);
        document.table(sheet);
        document.text("A sentence.");
        document.blocks.push(Block::List(vec!["one".to_owned(), "two".to_owned()]));
        insta::assert_snapshot!(text(&document), @r"
        Title
        ═════

        a  b

        Results
        ───────

        value  unit
        ────────────
          1.5  m/s^2
         10    m

        A sentence.

        - one
        - two
        ");
    }
}
