//! How wide the page is.

use std::cell::Cell;

/// Characters in a line of a page that goes to no terminal.
pub(super) const USUAL: usize = 100;

/// Lines of running text that are longer than this are hard to read.
const LONGEST_TEXT: usize = 100;

/// Widths of terminals that pages are laid out for; one that is narrower breaks lines itself.
const LEAST: usize = 40;
const MOST: usize = 200;

thread_local! {
    // every page would have to hand it down to every paragraph; a thread draws one page at a time
    static WIDTH: Cell<usize> = const { Cell::new(USUAL) };
}

/// Draws pages of text for a terminal that has so many columns, instead of the usual 100.
///
/// ```
/// use gumption_report::{within_width, wrapped};
///
/// let page = within_width(60, || wrapped(&"word ".repeat(30)));
/// assert!(page.lines().all(|line| line.len() <= 60));
/// ```
pub fn within_width<R>(columns: usize, draw: impl FnOnce() -> R) -> R {
    /// Restores the width also where `draw` panics.
    struct Restore(usize);
    impl Drop for Restore {
        fn drop(&mut self) {
            WIDTH.set(self.0);
        }
    }
    let _restore = Restore(WIDTH.replace(columns.clamp(LEAST, MOST)));
    draw()
}

/// Characters in a line of a table, at most.
pub(crate) fn width() -> usize {
    WIDTH.get()
}

/// Characters in a line of running text, at most.
pub(crate) fn text_width() -> usize {
    width().min(LONGEST_TEXT)
}
