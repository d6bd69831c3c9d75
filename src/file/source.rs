//! A text that was read, with the name that messages use for it.

use std::ops::Range;
use std::sync::Arc;

/// A file's text and name.
#[derive(Debug, PartialEq, Eq)]
pub struct Source {
    /// The name, as the user gave it.
    pub name: String,
    /// The text, without a byte-order mark.
    pub text: String,
}

/// A place in a source: a half-open range of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) source: Arc<Source>,
    pub(crate) span: Range<usize>,
}

impl Source {
    /// A text of the given name; a byte-order mark is dropped.
    pub fn new(name: impl Into<String>, text: &str) -> Arc<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Arc::new(Self { name: name.into(), text: text.to_owned() })
    }

    /// Line and column of a byte, both counted from 1; the column counts characters.
    pub fn position(&self, byte: usize) -> (usize, usize) {
        let before = self.text.get(..byte.min(self.text.len())).unwrap_or(&self.text);
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (line, before.get(start..).unwrap_or("").chars().count() + 1)
    }

    /// The byte at which a line begins, lines counted from 1.
    pub(crate) fn line_start(&self, line: usize) -> usize {
        if line <= 1 {
            return 0;
        }
        self.text.match_indices('\n').nth(line - 2).map_or(self.text.len(), |(at, _)| at + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters() {
        let source = Source::new("a", "\u{feff}äb\ncd\n");
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position("ä".len()), (1, 2));
        assert_eq!(source.position("äb\nc".len()), (2, 2));
        assert_eq!(source.position(1000), (3, 1));
        assert_eq!(source.line_start(2), "äb\n".len());
    }
}
