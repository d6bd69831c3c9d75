//! Running text on the page: wrapped, and without characters that a terminal would obey.

use super::grid::Grid;
use super::text_width;
use crate::printed;
use gumption_text::is_obeyed;

/// Characters of a text that the page shows at most: twenty lines.
const LONGEST: usize = 2000;

/// One line of printable characters: everything that a terminal would obey becomes a space, and so
/// do line breaks.
pub(crate) fn one_line(text: &str) -> String {
    text.split(|c: char| c.is_whitespace() || is_obeyed(c))
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// A user's text on one line of printable characters. What is too long to be read is cut, with an
/// ellipsis.
pub fn plain(text: &str) -> String {
    let text = one_line(text);
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => text.get(..end).unwrap_or_default().trim_end().to_owned() + "…",
        None => text,
    }
}

/// A text of several lines without characters that a terminal would obey.
pub(crate) fn printable(text: &str) -> String {
    text.chars().filter(|c| matches!(c, '\n' | '\t') || !is_obeyed(*c)).collect()
}

/// A paragraph within the width of the page, ending in a newline; nothing for an empty text.
pub fn wrapped(text: &str) -> String {
    let text = printed::text(&one_line(text));
    if text.is_empty() {
        return String::new();
    }
    let mut grid = Grid::default();
    grid.text("", [text]);
    grid.bare(text_width())
}
