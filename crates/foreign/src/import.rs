//! Budgets that laboratories keep in spreadsheets, as model files.
//!
//! A budget is a table on a sheet: a row of headings, one row for each quantity, perhaps rows of the result,
//! perhaps the equation. What is not known is asked, never inferred: a question is an error that names the
//! readings and the option that decides. What the sheet says of its own result is compared with the model.

mod ask;
pub(crate) mod both;
pub(crate) mod columns;
pub(crate) mod concise;
pub(crate) mod coverage;
mod document;
mod equation;
mod grid;
pub(crate) mod heading;
pub(crate) mod mark;
mod model;
pub(crate) mod number;
mod options;
mod own;
mod rows;
mod sheets;
mod shown;
mod stated;
mod symbol;
mod table;
mod title;
mod widths;
mod words;

use std::cell::RefCell;
use std::path::Path;

pub use ask::{Question, RefusedBudget};
use ask::{ReadSheet, beginning};
use columns::{Column, identifier};
use equation::Equation;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_files::open::{FileKind, are_results};
use gumption_text::{Collector, DiagnosticKind, SourceText, bytes, workbook};
use mark::{MarkedCell, doubt};
pub use options::{Coefficients, ImportOptions};
use sheets::Chosen;
pub use shown::{ShownColumn, ShownSheet};
use table::Header;

/// A model file that was made of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedBudget {
    /// The model file, as JSON text that ends in a newline.
    pub text: String,
    /// What is worth knowing of how the sheet was read.
    pub notes: Vec<Fact>,
}

/// Reads a budget from a CSV file or from the sheet of an XLSX file that holds one; of a workbook that this
/// program has made, its model file with the cells that were changed.
///
/// # Errors
/// A file that cannot be read, or in which no budget is found; rows with mistakes, all at once; what the sheet
/// does not say, as questions.
pub fn import_budget(
    path: &Path,
    options: &ImportOptions,
) -> Result<ImportedBudget, RefusedBudget> {
    match bytes::of_file(path, bytes::MOST) {
        Ok(content) => import_budget_bytes(path, content, options),
        Err(message) => {
            let log = Collector::new(SourceText::new(path.display().to_string(), ""));
            log.report(&(0..0), DiagnosticKind::Unreadable { message });
            Err(log.into_diagnostics().into())
        }
    }
}

/// As [`import_budget`], of the content of a file of that name, which is not looked for on the disk.
///
/// # Errors
/// As [`import_budget`].
pub fn import_budget_bytes(
    path: &Path,
    content: Vec<u8>,
    options: &ImportOptions,
) -> Result<ImportedBudget, RefusedBudget> {
    read_budget(path, content, options).1
}

/// The names of the sheets of a workbook; none of a text.
pub fn sheet_names(path: &Path, content: Vec<u8>) -> Vec<String> {
    match workbook::is_workbook(path) {
        Ok(true) => sheets::names(content),
        _ => Vec::new(),
    }
}

/// As [`import_budget_bytes`], with the cells of the sheet that was read; none of a file that has no cells, and
/// of a workbook that this program has made.
pub fn read_budget(
    path: &Path,
    content: Vec<u8>,
    options: &ImportOptions,
) -> (Option<ShownSheet>, Result<ImportedBudget, RefusedBudget>) {
    let name = path.display().to_string();
    let failed = |kind: DiagnosticKind| {
        let log = Collector::new(SourceText::new(name.clone(), ""));
        log.report(&(0..0), kind);
        (None, Err(log.into_diagnostics().into()))
    };
    let is_workbook = match workbook::is_workbook(path) {
        Ok(is_workbook) => is_workbook,
        Err(message) => return failed(DiagnosticKind::Unreadable { message }),
    };
    if let Some(sheet) = options.sheet.as_deref().filter(|_| !is_workbook) {
        let message = format!("it is no workbook (.xlsx), and so has no sheet `{sheet}`");
        return failed(DiagnosticKind::Unreadable { message });
    }
    if is_workbook && options.sheet.is_none() {
        match own::of_workbook(path, &content) {
            Ok(None) => {}
            Ok(Some(made)) => return (None, made.map_err(RefusedBudget::from)),
            Err(message) => return failed(DiagnosticKind::Unreadable { message }),
        }
    }
    let read = if is_workbook {
        Chosen::of(content, options)
    } else {
        let read = grid::of_text(path, &content, options);
        read.map(|(cells, text)| Chosen { cells, text, said: Vec::new() })
    };
    let Chosen { cells, text, said } = match read {
        Ok(read) => read,
        Err(kind) => return failed(kind),
    };
    let file = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let log = Collector::new(SourceText::new(name, &text));
    let sheet = ReadSheet {
        cells: &cells,
        log: &log,
        options,
        marks: RefCell::new(cells.marks()),
        notes: RefCell::new(said),
        questions: RefCell::new(Vec::new()),
    };
    let made = sheet.budget(&file.unwrap_or_default());
    let ReadSheet { notes, questions, .. } = sheet;
    let notes = notes.into_inner();
    let made = log
        .finish(made.map(|text| ImportedBudget { text, notes }))
        .map_err(|diagnostics| RefusedBudget { diagnostics, questions: questions.into_inner() });
    (Some(ShownSheet::of(&cells, options)), made)
}

impl ReadSheet<'_> {
    /// The model file of the budget; `None` after a mistake or a question.
    fn budget(&self, file: &str) -> Option<String> {
        if are_results(self.cells.row(0).iter().map(|cell| cell.trim())) {
            self.log.report(&self.cells.line(0), FileKind::Results.described());
            return None;
        }
        // what an option says wrong is told before anything is asked
        let said = self.said_rows()?;
        let header = Header::of(self)?;
        if !self.is_shown(&header) || !self.has_known_mark(&header) {
            return None;
        }
        self.note_columns(&header);
        self.correlations(&header);
        self.unknown_units(&header);
        let known = self.names_of_rows(&header);
        let equations = self.equations(&known)?;
        let measurand = equations.last().map(|equation| equation.name.as_str());
        let used: Vec<String> = equations.iter().flat_map(Equation::names).collect();
        let rows = self.rows(&header, measurand, &used, said)?;
        let stated = self.stated(&header, &rows)?;
        let title = self.title(&header, file);
        let model = self.model(&header, &rows, &equations, &stated, &title)?;
        self.compare(&rows.quantities, &stated, &model);
        Some(model.text)
    }

    /// Says what the columns are.
    fn note_columns(&self, header: &Header) {
        let shown = header.columns.iter().filter(|(_, column)| *column != Column::Ignored);
        let shown: Vec<Fact> = shown
            .map(|(place, column)| {
                let heading = beginning(header.heading(*place));
                let unit = header.unit(*place).map(|unit| fact!("import.in-unit", unit));
                fact!("import.column", heading, name = column.name(), unit)
            })
            .collect();
        self.note(fact!("import.columns", row = header.first + 1, columns = shown));
    }

    /// The names that the rows below the headings would have in formulas.
    pub(super) fn names_of_rows(&self, header: &Header) -> Vec<String> {
        let lines = header.line + 1..self.cells.lines();
        let names = lines.flat_map(|line| {
            let of = |column| {
                let words = header.cell(self.cells, line, column);
                let plain = columns::with_unit_in_brackets(words);
                identifier(plain.as_ref().map_or(words, |(name, _)| *name))
            };
            [of(Column::Symbol), of(Column::Quantity), of(Column::Description)]
                .into_iter()
                .find(|name| !name.is_empty())
        });
        names.collect()
    }

    /// Whether the decimal mark of the numbers is known; otherwise after a mistake.
    fn has_known_mark(&self, header: &Header) -> bool {
        if self.cells.separator() == Some(gumption_columns::separator::Separator::Comma) {
            return true;
        }
        let headings = header.columns.iter().map(|(place, _)| header.heading(*place));
        let is_number = |line: usize, place: usize| {
            let is_one = |(own, column): &(usize, Column)| *own == place && column.is_of_numbers();
            line > header.line && header.columns.iter().any(is_one)
        };
        let cells = (0..self.cells.lines()).flat_map(|line| {
            let written = self.cells.row(line).iter().enumerate();
            let written = written.filter(move |(place, _)| self.cells.is_written(line, *place));
            written.map(move |(place, text)| (line, place, text.as_str()))
        });
        let cells = cells.map(|(line, place, text)| MarkedCell {
            place: line,
            text,
            is_number: is_number(line, place),
        });
        let doubt = doubt(headings, cells);
        if let Some((line, reason)) = &doubt {
            self.fail(*line, reason);
        }
        doubt.is_none()
    }
}

#[cfg(test)]
mod tests;
