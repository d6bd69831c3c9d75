//! A text that was read, with its name in messages.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// A file's text and name.
#[derive(Debug)]
pub struct SourceText {
    /// The name, as the user gave it.
    pub name: String,
    /// The text, without a byte-order mark.
    pub text: String,
    /// The byte at which each line begins.
    lines: Vec<usize>,
    /// The byte and column of the last request: in a line of megabytes the next column is counted
    /// from there.
    last: Mutex<[usize; 2]>,
}

impl PartialEq for SourceText {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.text == other.text
    }
}

impl Eq for SourceText {}

/// A position in a source: a half-open range of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The text.
    pub source: Arc<SourceText>,
    /// The range, counted from 0.
    pub span: Range<usize>,
}

impl SourceText {
    /// A text of this name; a byte-order mark is removed.
    pub fn new(name: impl Into<String>, text: &str) -> Arc<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let after = text.match_indices('\n').map(|(at, _)| at + 1);
        let lines = std::iter::once(0).chain(after).collect();
        Arc::new(Self { name: name.into(), text: text.to_owned(), lines, last: Mutex::default() })
    }

    /// Line and column of a byte, both from 1; the column counts characters.
    pub fn position(&self, byte: usize) -> (usize, usize) {
        let byte = byte.min(self.text.len());
        let line = self.lines.partition_point(|&start| start <= byte);
        let start = self.line_start(line);
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let [from, counted] = if (start..=byte).contains(&last[0]) { *last } else { [start, 0] };
        let column = counted + self.text.get(from..byte).unwrap_or("").chars().count();
        *last = [byte, column];
        (line, column + 1)
    }

    /// The byte at which a line begins; lines count from 1.
    pub(crate) fn line_start(&self, line: usize) -> usize {
        self.lines.get(line.saturating_sub(1)).copied().unwrap_or(self.text.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters() {
        let source = SourceText::new("a", "\u{feff}äb\ncd\n");
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position("ä".len()), (1, 2));
        assert_eq!(source.position("äb\nc".len()), (2, 2));
        assert_eq!(source.position(1000), (3, 1));
        assert_eq!(source.position("äb".len()), (1, 3));
        assert_eq!(source.position("äb".len()), (1, 3));
        assert_eq!(source.position("ä".len()), (1, 2));
        assert_eq!(source.position("äb\ncd".len()), (2, 3));
        assert_eq!(source.line_start(2), "äb\n".len());
    }
}
