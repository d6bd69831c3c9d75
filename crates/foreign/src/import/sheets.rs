//! Which sheet of a workbook holds the budget, and what it hides.

use super::ask::ReadSheet;
use super::columns::Column;
use super::grid::{self, Cells};
use super::options::ImportOptions;
use super::table::{Header, line_of};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_files::open::FROM_CERTIFICATES;
use gumption_text::DiagnosticKind;
use gumption_text::workbook::choice::{self, Wanted};
use gumption_text::workbook::{Book, MOST_COLUMNS, MOST_ROWS, Place, SheetName, reference};

/// The sheet of a workbook that is read.
pub(super) struct Chosen {
    pub(super) cells: Cells,
    /// The text of messages.
    pub(super) text: String,
    /// What is worth knowing of the choice and of merged cells.
    pub(super) said: Vec<Fact>,
}

/// The names of the sheets of a workbook; none of one that cannot be opened.
pub(super) fn names(content: Vec<u8>) -> Vec<String> {
    let sheets = Book::open(content).map(|book| book.sheets());
    sheets.unwrap_or_default().into_iter().map(|sheet| sheet.name).collect()
}

impl Chosen {
    /// The sheet of that name, or the one that is shown and holds a budget; the first one that is shown
    /// where none does.
    pub(super) fn of(content: Vec<u8>, options: &ImportOptions) -> Result<Self, DiagnosticKind> {
        let unreadable = |message| DiagnosticKind::Unreadable { message };
        let mut book = Book::open(content).map_err(unreadable)?;
        if book.is_certificate() {
            let message = format!(
                "it is the workbook of a certificate, whose rows are results and no inputs of a sum; \
                 {FROM_CERTIFICATES}"
            );
            return Err(unreadable(message));
        }
        let read = |book: &mut Book, sheet: &SheetName| {
            let (rows, layout) = book.sheet(sheet).map_err(unreadable)?;
            let (cells, text, said) = grid::of_sheet(rows, layout, options);
            Ok(Self { cells, text, said })
        };
        let holds = |chosen: &Self| line_of(&chosen.cells, options).is_some();
        let (mut chosen, told) =
            choice::of(&mut book, options.sheet.as_deref(), &BUDGET, read, holds)?;
        if let Some(cell) = chosen.cells.layout().beyond {
            let message = format!(
                "its cell {} holds something; of a sheet {MOST_ROWS} rows and {MOST_COLUMNS} columns are read, \
                 and a budget has fewer",
                reference(cell)
            );
            return Err(unreadable(message));
        }
        chosen.said.splice(0..0, told);
        Ok(chosen)
    }
}

const BUDGET: Wanted = Wanted { a: "a budget", one: "one budget", has_option: true };

impl ReadSheet<'_> {
    /// Whether all that the budget needs is there to be seen, and no cell holds the number of several rows;
    /// otherwise after a mistake.
    pub(super) fn is_shown(&self, header: &Header) -> bool {
        self.has_values(header);
        self.has_no_withdrawn(header);
        self.has_own_numbers(header);
        let hidden = &self.cells.layout().hidden_columns;
        for (place, column) in &header.columns {
            if hidden.contains(&(*place as u32)) && *column != Column::Ignored {
                self.note(fact!("import.hidden-column", column = header.column(*place)));
            }
        }
        self.log.is_clean()
    }

    /// Formulas have their values.
    fn has_values(&self, header: &Header) {
        let layout = self.cells.layout();
        let is_needed = |(row, column): Place| {
            let is_it = |(place, column_kind): &(usize, Column)| {
                *place == column as usize
                    && !matches!(column_kind, Column::Contribution | Column::Ignored)
            };
            row as usize >= header.first && header.columns.iter().any(is_it)
        };
        let missing = layout.without_values(is_needed);
        for (cell, reason) in missing.into_iter().chain(layout.uncalculated(is_needed)) {
            self.fail(cell.0 as usize, reason);
        }
    }

    /// No row is hidden or struck through.
    fn has_no_withdrawn(&self, header: &Header) {
        let layout = self.cells.layout();
        for line in header.first..self.cells.lines() {
            let Ok(row) = u32::try_from(line) else { continue };
            let places = header.columns.iter().map(|(place, _)| *place);
            let held: Vec<usize> =
                places.filter(|place| !self.cells.text(line, *place).trim().is_empty()).collect();
            let is_struck = |place: &&usize| layout.struck.contains(&(row, **place as u32));
            // one cell that is struck through withdraws its number
            let struck = held.iter().find(is_struck);
            let Some(place) = struck.or(held.first()) else { continue };
            let Some((how, undo)) = layout.withdrawn(row, struck.is_some()) else { continue };
            let text = self.cells.text(line, *place).trim();
            self.fail(line, format!("row {} (`{text}`) is {how}: {undo}, or delete it", line + 1));
        }
    }

    /// No number is that of several rows by a merged cell, which may be each one's or one of all.
    fn has_own_numbers(&self, header: &Header) {
        for &((first, column), (last, _)) in &self.cells.layout().merged {
            let (first, last, place) = (first as usize, last as usize, column as usize);
            let text = self.cells.text(first, place).trim();
            let is_of_numbers =
                |(own, column): &(usize, Column)| *own == place && column.is_of_numbers();
            let holds = |line: usize| {
                header.columns.iter().any(|(own, _)| !self.cells.text(line, *own).trim().is_empty())
            };
            let is_shared = first > header.line && (first + 1..=last).any(holds);
            if is_shared && !text.is_empty() && header.columns.iter().any(is_of_numbers) {
                self.fail(
                    first,
                    format!(
                        "the merged cell `{text}` below `{}` spans rows {} to {}: it can be the number of \
                         each of them, or one of all together; write it into the cell of each row",
                        header.heading(place),
                        first + 1,
                        last + 1
                    ),
                );
            }
        }
    }
}
