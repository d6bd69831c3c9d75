//! A plot of characters for terminals: a grid of cells with one character each.

/// A grid of characters, blank at first.
#[derive(Clone, Debug)]
pub(crate) struct CharacterGrid {
    width: usize,
    cells: Vec<char>,
}

/// The eighths of a cell, from an empty one to a full one.
const EIGHTHS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// Bars on one line of characters: heights relative to the largest.
pub(crate) fn bars(heights: &[f64]) -> String {
    let most = heights.iter().copied().fold(0.0, f64::max);
    let eighth = |height: &f64| (8.0 * height / most).round().clamp(0.0, 8.0) as usize;
    heights.iter().map(|height| EIGHTHS[if most > 0.0 { eighth(height) } else { 0 }]).collect()
}

/// The eighths of a cell from the left.
const LEFT_EIGHTHS: [char; 8] = [' ', '▏', '▎', '▍', '▌', '▋', '▊', '▉'];

/// A bar from the left for a share of `width` cells; empty for one that is not positive.
pub(crate) fn horizontal_bar(share: f64, width: usize) -> String {
    let eighths = (8.0 * width as f64 * share.clamp(0.0, 1.0)).round() as usize;
    let mut bar = "█".repeat(eighths / 8);
    let rest = eighths % 8;
    if rest > 0 {
        bar.push(LEFT_EIGHTHS[rest]);
    }
    bar
}

impl CharacterGrid {
    /// A blank grid with this number of columns and rows.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        Self { width, cells: vec![' '; width * height] }
    }

    /// The character in a column and a row, both from 0 at the top left; `None` outside.
    pub(crate) fn cell(&mut self, column: usize, row: usize) -> Option<&mut char> {
        let inside = column < self.width;
        self.cells.get_mut(row * self.width + column).filter(|_| inside)
    }

    /// Puts a character into a cell; does nothing outside the grid.
    pub(crate) fn put(&mut self, column: usize, row: usize, character: char) {
        if let Some(cell) = self.cell(column, row) {
            *cell = character;
        }
    }

    /// Writes a text from a column on; it is cut at the edge of the grid.
    pub(crate) fn write(&mut self, column: usize, row: usize, text: &str) {
        for (column, character) in (column..).zip(text.chars()) {
            self.put(column, row, character);
        }
    }

    /// An upright bar that begins on a row, with its height in eighths of a cell.
    pub(crate) fn bar(&mut self, column: usize, bottom: usize, eighths: usize) {
        let mut left = eighths;
        for row in (0..=bottom).rev() {
            self.put(column, row, EIGHTHS[left.min(8)]);
            left = left.saturating_sub(8);
        }
    }

    /// The rows as lines without spaces at their ends.
    pub(crate) fn lines(&self) -> String {
        let rows = self.cells.chunks(self.width.max(1));
        rows.map(|cells| cells.iter().collect::<String>().trim_end().to_owned() + "\n").collect()
    }
}

/// The cell, out of `count`, for a fraction of the way: the first at 0, the last at 1; `None`
/// outside.
pub(crate) fn cell_at(share: f64, count: usize) -> Option<usize> {
    let last = count.saturating_sub(1) as f64;
    (0.0..=1.0).contains(&share).then(|| (share * last).round() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_bars_stay_inside() {
        let mut grid = CharacterGrid::new(4, 3);
        grid.write(2, 0, "abc");
        grid.put(4, 0, 'x');
        grid.put(0, 3, 'x');
        grid.bar(0, 2, 12);
        grid.bar(1, 2, 99);
        assert_eq!(grid.lines(), " █ab\n▄█\n██\n");
    }

    #[test]
    fn bars_are_shares_of_the_highest() {
        assert_eq!(bars(&[0.0, 1.0, 2.0, 4.0]), " ▂▄█");
        assert_eq!(bars(&[0.0]), " ");
    }

    #[test]
    fn shares_go_to_the_nearest_cell() {
        assert_eq!([0.0, 0.49, 0.51, 1.0].map(|share| cell_at(share, 3)), [0, 1, 1, 2].map(Some));
        assert_eq!([-0.1, 1.1, f64::NAN].map(|share| cell_at(share, 3)), [None; 3]);
    }
}
