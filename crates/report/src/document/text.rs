//! A document as a text page for a terminal.

use super::{Block, Document, Head};
use crate::printed::{self, on_terminal};
use crate::table::{USUAL, width};
use crate::{Grid, plain, wrapped};

/// A line for a signature.
const RULE: &str = "________________________________";

/// The whole document that `made` makes, ending in a newline; what has no form in text is left out.
pub(crate) fn text(made: impl FnOnce() -> Document) -> String {
    on_terminal(|| page(&made()))
}

fn page(document: &Document) -> String {
    let head = document.head.iter().flat_map(Head::text).map(|line| wrapped(&line)).collect();
    // a program that reads a page in a pipe finds each result on one line
    let is_screen = width() < USUAL;
    let whole = |line: &String| format!("{}\n", printed::text(&plain(line)));
    let first =
        document.first.iter().map(|line| if is_screen { wrapped(line) } else { whole(line) });
    let remarks = document.remarks.iter().map(|said| wrapped(said)).collect();
    let mut parts = vec![head, first.collect(), remarks];
    if !document.title.is_empty() {
        parts.push(heading(&document.title, '═'));
    }
    parts.push(document.subtitle.iter().map(|line| wrapped(line)).collect());
    parts.extend(document.written(|part| block(part, document.comma)));
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

fn heading(title: &str, rule: char) -> String {
    let title = printed::text(&plain(title));
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
        Block::Table(sheet) => Grid::of(sheet).render(width()),
        Block::Figure(_) => String::new(),
        Block::Characters(drawn) => drawn.clone(),
        Block::Folded(title, blocks) => {
            let blocks = blocks.iter().map(|part| self::block(part, comma));
            let mut parts = vec![format!("{}:\n", plain(title))];
            parts.extend(blocks.filter(|part| !part.is_empty()));
            parts.join("\n")
        }
        Block::Signature(places) => {
            let line = |place: &String| format!("\n{RULE}\n{}", wrapped(place));
            places.iter().map(line).collect()
        }
        Block::End(text) => wrapped(&format!("— {text} —")),
        Block::Listing { about, text } => {
            let line = |line: &str| match line.chars().count() > width() {
                true => wrapped(line),
                false => format!("{line}\n"),
            };
            wrapped(about) + &text.trim_end().lines().map(line).collect::<String>()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::Sheet;

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
        insta::assert_snapshot!(page(&document), @r"
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
