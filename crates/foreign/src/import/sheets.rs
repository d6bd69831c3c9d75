//! Which sheet of a workbook holds the budget, and what it hides.

use super::Budget;
use super::columns::{Column, Header};
use super::grid::{self, Cells};
use gumption_files::open::FROM_CERTIFICATES;
use gumption_text::DiagnosticKind;
use gumption_text::workbook::choice::{self, Wanted};
use gumption_text::workbook::{
    Book, MOST_COLUMNS, MOST_ROWS, Place, SheetName, letters, reference,
};

/// The sheet of a workbook that is read.
pub(super) struct Chosen {
    pub(super) cells: Cells,
    /// The text of messages.
    pub(super) text: String,
    /// What is worth knowing of the choice and of merged cells.
    pub(super) said: Vec<String>,
}

impl Chosen {
    /// The sheet of that name, or the one that is shown and holds a budget; the first one that is shown
    /// where none does.
    pub(super) fn of(content: Vec<u8>, wanted: Option<&str>) -> Result<Self, DiagnosticKind> {
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
            let (cells, text, said) = grid::of_sheet(rows, layout);
            Ok(Self { cells, text, said })
        };
        let holds = |chosen: &Self| Header::find(&chosen.cells).is_some();
        let (mut chosen, told) = choice::of(&mut book, wanted, &BUDGET, read, holds)?;
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

impl Budget<'_> {
    /// Says which columns are read though nobody sees them.
    pub(super) fn hidden_columns(&mut self, header: &Header) {
        let hidden = &self.cells.layout().hidden_columns;
        for (place, column) in &header.columns {
            let is_hidden = u32::try_from(*place).ok().filter(|place| hidden.contains(place));
            if let Some(place) = is_hidden {
                self.guessed.push(format!(
                    "column {} (`{}`) is hidden, and is read as {}",
                    letters(place),
                    header.heading(place as usize),
                    column.name()
                ));
            }
        }
    }

    /// Whether no number is that of several rows by a merged cell, which may be each one's or one of all;
    /// otherwise after a mistake.
    pub(super) fn has_own_numbers(&self, header: &Header) -> bool {
        let mut has_own = true;
        for &((first, column), (last, _)) in &self.cells.layout().merged {
            let (first, last, place) = (first as usize, last as usize, column as usize);
            let text = self.cells.text(first, place).trim();
            let is_of_numbers = |(of, column): &(usize, Column)| {
                *of == place && (column.is_of_place() || Column::UNCERTAIN.contains(column))
            };
            let holds = |line: usize| {
                let mut cells = header.columns.iter().map(|(of, _)| self.cells.text(line, *of));
                cells.any(|cell| !cell.trim().is_empty())
            };
            let is_shared = first > header.line && (first + 1..=last).any(holds);
            if is_shared && !text.is_empty() && header.columns.iter().any(is_of_numbers) {
                let reason = format!(
                    "the merged cell `{text}` below `{}` spans lines {} to {}: it can be the number of each \
                     of them, or one of all together; write it into the cell of each line, or keep one line",
                    header.heading(place).trim(),
                    first + 1,
                    last + 1
                );
                self.fail(first, reason);
                has_own = false;
            }
        }
        has_own
    }

    /// Whether all that the budget needs is there to be seen; otherwise after a mistake.
    pub(super) fn is_shown(&self, header: Option<&Header>) -> bool {
        let layout = self.cells.layout();
        let from = header.map_or(0, |header| header.first);
        let has = |place: usize, computed: bool| {
            let is_it = |(of, column): &(usize, Column)| {
                *of == place
                    && (computed || !matches!(column, Column::Contribution | Column::Share))
            };
            header.is_none_or(|header| header.columns.iter().any(is_it))
        };
        let is_needed = |(row, column): Place| row as usize >= from && has(column as usize, false);
        let mut missing: Vec<(Place, String)> =
            layout.without_values(is_needed).into_iter().collect();
        if header.is_some() {
            missing.extend(layout.uncalculated(is_needed));
        }
        let mut is_shown = missing.is_empty();
        missing.into_iter().for_each(|(cell, reason)| self.fail(cell.0 as usize, reason));
        if header.is_none() {
            return is_shown;
        }
        for line in from..self.cells.lines() {
            let Ok(row) = u32::try_from(line) else { continue };
            let cells = self.cells.row(line).iter().enumerate();
            let held: Vec<(usize, &String)> = cells
                .filter(|(place, cell)| has(*place, true) && !cell.trim().is_empty())
                .collect();
            let is_struck = |place: usize| {
                u32::try_from(place).is_ok_and(|of| layout.struck.contains(&(row, of)))
            };
            // one cell that is struck through withdraws its number
            let struck = held.iter().find(|(place, _)| is_struck(*place));
            let Some((_, cell)) = struck.or(held.first()) else { continue };
            let Some((how, undo)) = layout.withdrawn(row, struck.is_some()) else { continue };
            let reason =
                format!("row {} (`{}`) is {how}: {undo}, or delete it", line + 1, cell.trim());
            self.fail(line, reason);
            is_shown = false;
        }
        is_shown
    }
}
