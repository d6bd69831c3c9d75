//! Columns whose cells hold an estimate and its uncertainty, `10.000 V ± 0.002 V (k=2)`.
//!
//! What stands before the sign is read as a cell of an estimate, and what stands behind it as one of
//! an uncertainty beside it: nothing else needs to know that they share a cell.

use std::collections::HashMap;

use super::columns::{Column, Header, place_of};
use super::grid::Cells;
use super::number::number_with_unit;
use gumption_text::value_text::PLUS_MINUS;

/// What a cell holds before and behind the sign; `None` where it holds one thing.
pub(crate) fn sides(cell: &str) -> Option<(&str, &str)> {
    let (estimate, uncertainty) = PLUS_MINUS.into_iter().find_map(|sign| cell.split_once(sign))?;
    let (estimate, uncertainty) = (estimate.trim(), uncertainty.trim());
    // both: `±` alone begins an uncertainty
    let is_both = number_with_unit(estimate, true).is_some() && !uncertainty.is_empty();
    is_both.then_some((estimate, uncertainty))
}

/// Columns that state one uncertainty, behind an estimate.
const BEHIND: [Column; 2] = [Column::Width, Column::Std];

/// The last line of each column that has such cells.
pub(super) struct LastOfBoth(HashMap<usize, usize>);

impl LastOfBoth {
    pub(super) fn of(cells: &Cells) -> Self {
        let of_line = |line: usize| {
            let row = cells.row(line).iter().enumerate();
            row.filter(|(_, cell)| sides(cell).is_some()).map(move |(place, _)| (place, line))
        };
        Self((0..cells.lines()).flat_map(of_line).collect())
    }

    fn is_below(&self, line: usize, place: usize) -> bool {
        self.0.get(&place).is_some_and(|last| *last > line)
    }
}

impl Header {
    /// Takes a column of estimates for one of uncertainties too, and a column of uncertainties for one
    /// of estimates, where no other column is one and its cells hold both.
    pub(super) fn cells_of_both(
        last: &LastOfBoth,
        line: usize,
        columns: &mut Vec<(usize, Column)>,
    ) {
        let of = |wanted| place_of(columns, wanted);
        let uncertain = BEHIND.into_iter().find_map(of);
        let (place, other) = match (of(Column::Estimate), uncertain) {
            (Some(place), None) if of(Column::Upper).is_none() => (place, Column::Width),
            (None, Some(place)) => (place, Column::Estimate),
            _ => return,
        };
        if last.is_below(line, place) {
            columns.push((place, other));
        }
    }

    /// The cell of a line in a column, or its side of a cell that holds an estimate and its uncertainty;
    /// empty where there is none.
    pub(super) fn cell<'c>(&self, cells: &'c Cells, line: usize, column: Column) -> &'c str {
        let of = |column| place_of(&self.columns, column);
        let text = of(column).map_or("", |place| cells.text(line, place));
        let beside = BEHIND.into_iter().find_map(|column| Some((column, of(column)?)));
        let (Some(place), Some((behind, other))) = (of(Column::Estimate), beside) else {
            return text;
        };
        let is_free = place == other || cells.text(line, other).trim().is_empty();
        if !is_free || column != Column::Estimate && column != behind {
            return text;
        }
        match sides(cells.text(line, place)) {
            Some((estimate, _)) if column == Column::Estimate => estimate,
            Some((_, uncertainty)) => uncertainty,
            None => {
                // a single number is what the heading of its column names, and that was taken first
                let named = self.columns.iter().find(|(at, _)| *at == place);
                named.filter(|(_, named)| *named == column).map_or("", |_| text)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::sides;

    #[test]
    fn sides_of_cells() {
        for (cell, found) in [
            ("10 V ± 20 µV", Some(("10 V", "20 µV"))),
            ("10.000 ± 0.002 (k=2)", Some(("10.000", "0.002 (k=2)"))),
            ("-0,5 +/- 0,1", Some(("-0,5", "0,1"))),
            ("3+-1", Some(("3", "1"))),
            ("± 20 µV", None),
            ("+/-3", None),
            ("10 V ±", None),
            ("10 V", None),
            ("the limits ± 3", None),
        ] {
            assert_eq!(sides(cell), found, "{cell}");
        }
    }
}
