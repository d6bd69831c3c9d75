//! A sheet as a user sees it: its cells, and what each column is taken for.

use serde::Serialize;

use super::columns::Column;
use super::grid::Cells;
use super::options::ImportOptions;
use super::table::{Header, line_of};

/// Rows and columns that are shown, at most.
const MOST_ROWS: usize = 200;
const MOST_COLUMNS: usize = 60;

/// The cells of the sheet that is read, for a user who says what they are.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ShownSheet {
    /// The first rows.
    pub rows: Vec<Vec<String>>,
    /// How many rows more there are.
    pub more: usize,
    /// The row of the headings, from 1, if one is known.
    pub heading: Option<usize>,
    /// What each column holds.
    pub columns: Vec<ShownColumn>,
    /// All names of columns, as options have them.
    pub names: Vec<&'static str>,
}

/// What a column of a sheet is taken for.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ShownColumn {
    /// Its name, by an option or by its heading.
    pub name: Option<&'static str>,
    /// Whether an option may say its unit.
    pub has_unit: bool,
}

impl ShownSheet {
    pub(super) fn of(cells: &Cells, options: &ImportOptions) -> Self {
        let all = cells.lines();
        let row = |line| cells.row(line).iter().take(MOST_COLUMNS).cloned().collect::<Vec<_>>();
        let rows: Vec<Vec<String>> = (0..all.min(MOST_ROWS)).map(row).collect();
        let width = rows.iter().map(Vec::len).max().unwrap_or(0);
        let line = line_of(cells, options);
        let header = line.map(|line| Header::said_only(cells, line, options));
        let column = |place: usize| {
            let by_words = || cells.column(cells.text(line?, place));
            let said = header.as_ref().and_then(|header| header.column_at(place));
            // of two headings that say the same the option has named the other one
            let is_taken = |column: &Column| {
                !column.may_repeat() && header.as_ref().is_some_and(|h| h.place(*column).is_some())
            };
            let found = said.or_else(|| by_words().filter(|column| !is_taken(column)));
            ShownColumn {
                name: found.map(Column::name),
                has_unit: found.is_some_and(Column::has_unit),
            }
        };
        Self {
            columns: (0..width).map(column).collect(),
            more: all - rows.len(),
            rows,
            heading: line.map(|line| line + 1),
            names: Column::names(),
        }
    }
}
