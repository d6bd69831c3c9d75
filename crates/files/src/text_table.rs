//! Small tables of texts and numbers from CSV, with the place of every cell.

use std::ops::Range;
use std::sync::Arc;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::source::{Place, SourceText};
use super::table::place_of_cell;

/// At most so many rows.
const MOST_ROWS: usize = 10_000;

/// A table: column names and rows of texts.
#[derive(Clone, Debug)]
pub(super) struct TextTable {
    source: Arc<SourceText>,
    columns: Vec<String>,
    rows: Vec<(Range<usize>, Vec<String>)>,
    header: Range<usize>,
    semicolon: bool,
}

impl TextTable {
    /// Reads a table: a header row of names, `,` or `;` (then with decimal commas), lines that begin
    /// with `#` and empty ones skipped. Mistakes are reported.
    pub(super) fn parse(log: &Collector, source: &Arc<SourceText>) -> Option<Self> {
        let mut table: Option<Self> = None;
        let mut start = 0;
        for line in source.text.split_inclusive('\n') {
            let content = line.trim_end();
            let span = start..start + content.len();
            start += line.len();
            if content.trim().is_empty() || content.trim_start().starts_with('#') {
                continue;
            }
            let semicolon = table.as_ref().map_or(content.contains(';'), |table| table.semicolon);
            let place = Place { source: source.clone(), span: span.clone() };
            let cells = match cells(content, semicolon) {
                Ok(cells) => cells,
                Err(reason) => {
                    log.report_at(place, DiagnosticKind::Table { reason });
                    return None;
                }
            };
            let Some(table) = &mut table else {
                table = Some(Self::begin(log, source, span, cells, semicolon)?);
                continue;
            };
            let (found, expected) = (cells.len(), table.columns.len());
            if found != expected {
                let row = table.rows.len() + 1;
                log.report_at(place, DiagnosticKind::ShortRow { row, found, expected });
            }
            table.rows.push((span, cells));
            if table.rows.len() > MOST_ROWS {
                let (what, found) = ("rows of a table", table.rows.len());
                log.report(&table.header, DiagnosticKind::TooMany { what, found, most: MOST_ROWS });
                return None;
            }
        }
        let reason = match &table {
            None => "the table is empty; a header row of names and rows are needed",
            Some(table) if table.rows.is_empty() => "the table has a header but no rows",
            Some(_) => return table.filter(|_| log.is_clean()),
        };
        log.report(&(0..0), DiagnosticKind::Table { reason: reason.to_owned() });
        None
    }

    fn begin(
        log: &Collector,
        source: &Arc<SourceText>,
        header: Range<usize>,
        columns: Vec<String>,
        semicolon: bool,
    ) -> Option<Self> {
        let twice = columns
            .iter()
            .enumerate()
            .find(|(n, name)| columns.iter().take(*n).any(|earlier| earlier == *name));
        if let Some((_, name)) = twice {
            let reason = format!("the header has the name `{name}` twice");
            log.report(&header, DiagnosticKind::Table { reason });
            return None;
        }
        Some(Self { source: source.clone(), columns, rows: Vec::new(), header, semicolon })
    }

    pub(super) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The place of the column of that name.
    pub(super) fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    pub(super) fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The text of a cell; empty where there is no such column.
    pub(crate) fn text(&self, row: usize, column: &str) -> &str {
        let cell = self.column(column).and_then(|place| self.rows.get(row)?.1.get(place));
        cell.map_or("", String::as_str)
    }

    /// The text of a number, with a decimal point.
    pub(super) fn number(&self, row: usize, column: &str) -> String {
        let text = self.text(row, column);
        if self.semicolon { text.replace(',', ".") } else { text.to_owned() }
    }

    /// Where the header stands.
    pub(super) fn header(&self) -> Place {
        Place { source: self.source.clone(), span: self.header.clone() }
    }

    /// Where a cell stands.
    pub(super) fn place(&self, row: usize, column: &str) -> Place {
        let span = self.rows.get(row).map_or(self.header.clone(), |(span, _)| span.clone());
        let line = Place { source: self.source.clone(), span };
        self.column(column)
            .map_or(line.clone(), |place| place_of_cell(&line, place, self.semicolon))
    }
}

/// The cells of a line.
fn cells(line: &str, semicolon: bool) -> Result<Vec<String>, String> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(if semicolon { b';' } else { b',' })
        .trim(csv::Trim::All)
        .has_headers(false)
        .from_reader(line.as_bytes());
    match reader.records().next() {
        Some(Ok(record)) => Ok(record.iter().map(str::to_owned).collect()),
        Some(Err(error)) => Err(error.to_string()),
        None => Ok(Vec::new()),
    }
}
