//! A document as a page of text for a terminal.

use super::{Block, Document};
use crate::report::{Grid, WIDTH, plain, wrapped};

/// The whole document, ending in a newline; what has no form in text is left out.
pub(in crate::report) fn text(document: &Document) -> String {
    let mut parts = vec![heading(&document.title, '═')];
    parts.push(document.subtitle.iter().map(|line| wrapped(line)).collect());
    parts.extend(document.blocks.iter().map(block));
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

fn heading(title: &str, rule: char) -> String {
    let title = plain(title);
    let rule: String = std::iter::repeat_n(rule, title.chars().count().min(WIDTH)).collect();
    format!("{}{rule}\n", wrapped(&title))
}

fn block(block: &Block) -> String {
    match block {
        Block::Section(title) => heading(title, '─'),
        Block::Text(text) => wrapped(text),
        Block::Verdict(sentences) => sentences.iter().map(|said| wrapped(said)).collect(),
        Block::List(items) => items.iter().map(|item| wrapped(&format!("- {item}"))).collect(),
        Block::Table(sheet) if sheet.columns.iter().all(|column| column.header.is_empty()) => {
            Grid::of(sheet).bare(WIDTH)
        }
        Block::Table(sheet) => Grid::of(sheet).render(WIDTH),
        Block::Figure(_) => String::new(),
        Block::Listing { about, text } => format!("{}{}\n", wrapped(about), text.trim_end()),
    }
}
