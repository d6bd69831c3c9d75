//! Which sheet of a workbook holds the budget, and what it hides.

use super::Budget;
use super::columns::{Column, Header};
use super::grid::{self, Cells};
use crate::DiagnosticKind;
use crate::open::FROM_CERTIFICATES;
use crate::workbook::{Book, Place, SheetName, letters};

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
        let sheets = book.sheets();
        if let Some(message) = of_certificate(&mut book, &sheets) {
            return Err(unreadable(message));
        }
        let mut read = |sheet: &SheetName| {
            let (rows, layout) = book.sheet(sheet).map_err(unreadable)?;
            let (cells, text, said) = grid::of_sheet(rows, layout);
            Ok(Self { cells, text, said })
        };
        if let Some(name) = wanted {
            let Some(sheet) = sheets.iter().find(|sheet| sheet.name == name) else {
                let message = format!(
                    "it has no sheet `{name}`; its sheets are {}",
                    list(sheets.iter(), "and")
                );
                return Err(unreadable(message));
            };
            return Ok(read(sheet)?.told(sheet, &sheets));
        }
        let (mut first, mut found): (Option<Self>, Vec<(&SheetName, Self)>) = (None, Vec::new());
        for sheet in sheets.iter().filter(|sheet| !sheet.is_hidden) {
            let chosen = read(sheet)?;
            if Header::find(&chosen.cells).is_some() {
                found.push((sheet, chosen));
            } else if first.is_none() {
                first = Some(chosen);
            }
        }
        if found.len() > 1 {
            let reason = format!(
                "the sheets {} hold a budget each: say which one with `--sheet NAME`, or keep one budget \
                 in a workbook",
                list(found.iter().map(|(sheet, _)| *sheet), "and")
            );
            return Err(DiagnosticKind::Table { reason });
        }
        if found.is_empty() {
            for sheet in sheets.iter().filter(|sheet| sheet.is_hidden) {
                if Header::find(&read(sheet)?.cells).is_some() {
                    let name = &sheet.name;
                    let reason = format!(
                        "no sheet that is shown holds a budget, and the hidden sheet `{name}` does: show \
                         it, or say it with `--sheet`"
                    );
                    return Err(DiagnosticKind::Table { reason });
                }
            }
        }
        match found.pop() {
            Some((sheet, chosen)) => Ok(chosen.told(sheet, &sheets)),
            None => first.ok_or_else(|| unreadable("the workbook has no sheet".to_owned())),
        }
    }

    /// Says which of several sheets it is.
    fn told(mut self, own: &SheetName, sheets: &[SheetName]) -> Self {
        let others: Vec<&SheetName> = sheets.iter().filter(|sheet| *sheet != own).collect();
        if !others.is_empty() {
            let others = list(others.into_iter(), "or");
            self.said.insert(0, format!("sheet `{}` is read, not {others}", own.name));
        }
        self
    }
}

/// Why the workbook of a certificate of this program is no budget; `None` of other ones.
fn of_certificate(book: &mut Book, sheets: &[SheetName]) -> Option<String> {
    let named = |name: &str| sheets.iter().find(|sheet| sheet.name == name);
    let (certificate, _) = named("Certificate").zip(named("Unrounded"))?;
    let (rows, _) = book.sheet(certificate).ok()?;
    let is_ours = |cell: &String| cell.starts_with("certificate file, SHA-256:");
    rows.iter().flatten().any(is_ours).then(|| {
        format!(
            "it is the workbook of a certificate, whose rows are results and no inputs of a sum; \
             {FROM_CERTIFICATES}"
        )
    })
}

/// Names of sheets in a sentence; not more than the first ten.
fn list<'a>(sheets: impl Iterator<Item = &'a SheetName>, and: &str) -> String {
    const MOST: usize = 10;
    let named = |sheet: &SheetName| {
        format!("`{}`{}", sheet.name, if sheet.is_hidden { " (hidden)" } else { "" })
    };
    let mut names: Vec<String> = sheets.map(named).collect();
    if names.len() > MOST {
        let rest = names.split_off(MOST).len();
        names.push(format!("{rest} more"));
    }
    gumption_units::listed(&names, &format!(" {and} "))
}

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
            let mut held =
                cells.filter(|(place, cell)| has(*place, true) && !cell.trim().is_empty());
            let Some((place, cell)) = held.next() else { continue };
            let is_struck = u32::try_from(place).is_ok_and(|of| layout.struck.contains(&(row, of)));
            let (how, undo) = if layout.hidden.contains(&row) {
                ("hidden", "show it")
            } else if is_struck {
                ("struck through", "take the line through it away")
            } else {
                continue;
            };
            let reason =
                format!("row {} (`{}`) is {how}: {undo}, or delete it", line + 1, cell.trim());
            self.fail(line, reason);
            is_shown = false;
        }
        is_shown
    }
}
