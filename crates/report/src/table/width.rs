//! How wide the page is.

use std::cell::Cell;

/// Characters in a line of a page that goes to no terminal.
pub(crate) const USUAL: usize = 100;

/// Lines of running text that are longer than this are hard to read.
const LONGEST_TEXT: usize = 100;

/// Widths of terminals that pages are laid out for; one that is narrower breaks lines itself.
const LEAST: usize = 40;
const MOST: usize = 200;

/// What text pages are drawn for.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    /// Characters in a line; pages have from 40 to 200.
    pub columns: usize,
    /// Whether it shows the letters of printed numbers and units: `m/s²`, `Ω`, `5 × 10⁻⁷`.
    pub shows_print: bool,
}

thread_local! {
    // every page would have to hand it down to every paragraph; a thread draws one page at a time
    static SCREEN: Cell<Screen> = const { Cell::new(Screen { columns: USUAL, shows_print: false }) };
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
    within_screen(Screen { columns, ..SCREEN.get() }, draw)
}

/// Draws pages of text for a screen.
pub fn within_screen<R>(screen: Screen, draw: impl FnOnce() -> R) -> R {
    /// Restores the screen also where `draw` panics.
    struct Restore(Screen);
    impl Drop for Restore {
        fn drop(&mut self) {
            SCREEN.set(self.0);
        }
    }
    let columns = screen.columns.clamp(LEAST, MOST);
    let _restore = Restore(SCREEN.replace(Screen { columns, ..screen }));
    draw()
}

/// Whether text pages have the notation of print.
pub(crate) fn shows_print() -> bool {
    SCREEN.get().shows_print
}

/// Characters in a line of a table, at most.
pub(crate) fn width() -> usize {
    SCREEN.get().columns
}

/// Characters in a line of running text, at most.
pub(crate) fn text_width() -> usize {
    width().min(LONGEST_TEXT)
}
