//! The text of a table, from a file of text or from a sheet of a workbook.

use std::borrow::Cow;
use std::path::Path;

use super::ComparisonOptions;
use super::headings::{self, HeadingMeaning, Role};
use super::study;
use gumption_engine::fact::Fact;
use gumption_text::workbook::choice::{self, Wanted};
use gumption_text::workbook::{Book, Layout};
use gumption_text::{DiagnosticKind, bytes, workbook};

/// A table as text, and what else is known of it.
#[derive(Debug, Default)]
pub(super) struct Content {
    pub(super) text: String,
    /// Where its cells stand in a workbook.
    pub(super) sheet: Option<Cells>,
    /// Which of several sheets it is.
    pub(super) said: Option<Fact>,
}

/// Where the cells of a table stand in a workbook: its lines are the rows of the sheet.
#[derive(Debug)]
pub(super) struct Cells {
    first_column: u32,
    layout: Layout,
}

impl Cells {
    fn place(&self, line: usize, column: usize) -> Option<(u32, u32)> {
        Some((u32::try_from(line).ok()?, self.first_column + u32::try_from(column).ok()?))
    }

    /// Why a cell holds no number, though its value is one.
    pub(super) fn no_number(&self, line: usize, column: usize) -> Option<String> {
        self.layout.no_number(self.place(line, column)?)
    }

    /// Whether a cell shows a date or a time.
    pub(super) fn is_date(&self, line: usize, column: usize) -> bool {
        self.place(line, column).is_some_and(|place| self.layout.dates.contains_key(&place))
    }

    /// The power of ten of the last digit that a cell shows.
    pub(super) fn last_digit(&self, line: usize, column: usize) -> Option<i32> {
        self.layout.last_digits.get(&self.place(line, column)?).copied()
    }
}

const RESULTS: Wanted = Wanted { a: "a table of results", one: "one table", has_option: true };
const MATRIX: Wanted = Wanted { a: "a matrix", one: "one matrix", has_option: false };

/// The table of results in a file.
pub(super) fn results(
    path: &Path,
    content: Vec<u8>,
    options: ComparisonOptions<'_>,
) -> Result<Content, DiagnosticKind> {
    let holds = |header: &[String]| {
        if options.is_gauge_study {
            return study::is_header(header);
        }
        let of = |role: fn(&Role) -> bool| {
            header
                .iter()
                .any(|cell| matches!(headings::said(cell), HeadingMeaning::Role(found, _) if role(&found)))
        };
        let is_uncertain = of(|role| matches!(role, Role::Expanded(_) | Role::Standard(_)))
            || header
                .iter()
                .any(|cell| matches!(headings::said(cell), HeadingMeaning::SomeUncertainty(_)));
        let is_deviation =
            |cell: &String| matches!(headings::said(cell), HeadingMeaning::Deviation(_));
        let has_value = of(|role| matches!(role, Role::Value(_)));
        let has_label = of(|role| matches!(role, Role::Label));
        let is_uncertain = is_uncertain || options.is_proficiency_test && has_label;
        (has_value || header.iter().any(is_deviation)) && is_uncertain
    };
    read(path, content, options.sheet, &RESULTS, holds)
}

/// The matrix of correlation coefficients of these laboratories in a file.
pub(super) fn matrix(
    path: &Path,
    content: Vec<u8>,
    labels: &[&str],
) -> Result<Content, DiagnosticKind> {
    let holds = |header: &[String]| header.iter().any(|cell| labels.contains(&cell.trim()));
    read(path, content, None, &MATRIX, holds)
}

fn read(
    path: &Path,
    content: Vec<u8>,
    sheet: Option<&str>,
    wanted: &Wanted,
    holds: impl Fn(&[String]) -> bool,
) -> Result<Content, DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    if !workbook::is_workbook(path).map_err(unreadable)? {
        if let Some(sheet) = sheet {
            let message = format!("it is no workbook (.xlsx), and so has no sheet `{sheet}`");
            return Err(unreadable(message));
        }
        let text = bytes::text(&content).map(Cow::into_owned).map_err(unreadable)?;
        return Ok(Content { text, ..Content::default() });
    }
    let mut book = Book::open(content).map_err(unreadable)?;
    if book.is_certificate() {
        let message = "it is the workbook of a certificate, whose rows are results of one laboratory and \
                       no results of several";
        return Err(unreadable(message.to_owned()));
    }
    let (table, said) = choice::of(
        &mut book,
        sheet,
        wanted,
        |book, sheet| book.table(sheet).map_err(unreadable),
        |table| holds(&table.header()),
    )?;
    let (text, first_column, layout) = table.text().map_err(unreadable)?;
    Ok(Content { text, sheet: Some(Cells { first_column, layout }), said })
}
