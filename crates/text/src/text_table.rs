//! Small tables of texts and numbers from CSV, with the position of every cell.

use std::ops::Range;
use std::sync::Arc;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::source::{Place, SourceText};
use super::table::place_of_cell;
use gumption_columns::separator::{Separator, is_skipped};

/// Maximum number of rows.
const MOST_ROWS: usize = 10_000;

/// A table: column names and rows of texts.
#[derive(Clone, Debug)]
pub struct TextTable {
    source: Arc<SourceText>,
    columns: Vec<String>,
    rows: Vec<(Range<usize>, Vec<String>)>,
    header: Range<usize>,
    separator: Separator,
}

impl TextTable {
    /// Reads a table: a header row of names, cells between `,`, `;` or tabs; empty lines and lines
    /// that begin with `#` are skipped. Errors are reported. Rows with too few or too many cells
    /// are kept, but are not [whole](Self::is_whole).
    pub fn parse(log: &Collector, source: &Arc<SourceText>) -> Option<Self> {
        let mut table: Option<Self> = None;
        let mut start = 0;
        while let Some(rest) = source.text.get(start..).filter(|rest| !rest.is_empty()) {
            let line = rest.get(..end_of_line(rest)).unwrap_or(rest);
            if is_skipped(line) {
                start += line.len();
                continue;
            }
            let separator = match &table {
                Some(table) => table.separator,
                None => Separator::of_header(line),
            };
            // a quoted cell may continue after the end of the line (RFC 4180, 2.6)
            let Some(length) = record(rest, separator.sign()) else {
                let span = start..start + line.trim_end().len();
                let reason = "a cell begins with a quote but has no closing quote".to_owned();
                let place = Place { source: source.clone(), span };
                log.report_at(place, DiagnosticKind::Table { reason });
                return None;
            };
            let content = rest.get(..length).unwrap_or(rest).trim_end_matches(['\n', '\r', ' ']);
            let span = start..start + content.len();
            start += length;
            let place = Place { source: source.clone(), span: span.clone() };
            let cells = match separator.cells(content) {
                Ok(cells) => cells,
                Err(reason) => {
                    log.report_at(place, DiagnosticKind::Table { reason });
                    return None;
                }
            };
            let Some(table) = &mut table else {
                table = Some(Self::begin(log, source, span, cells, separator)?);
                continue;
            };
            let mut cells = cells;
            let expected = table.columns.len();
            // spreadsheets write as many separators as the widest row needs
            while cells.len() > expected && cells.last().is_some_and(String::is_empty) {
                cells.pop();
            }
            let found = cells.len();
            if found != expected {
                let row = table.rows.len() + 1;
                let held: Vec<&String> = cells.iter().filter(|cell| !cell.is_empty()).collect();
                let kind = match held[..] {
                    [words] if expected > 1 => DiagnosticKind::Table { reason: alone(words) },
                    _ => DiagnosticKind::ShortRow { row, found, expected },
                };
                log.report_at(place, kind);
            }
            table.rows.push((span, cells));
            if table.rows.len() > MOST_ROWS {
                // further ones are not counted
                let (what, found) = ("rows of a table", usize::MAX);
                log.report(&table.header, DiagnosticKind::TooMany { what, found, most: MOST_ROWS });
                return None;
            }
        }
        let reason = match &table {
            None => "the table is empty; a header row of names and rows are needed",
            Some(table) if table.rows.is_empty() => "the table has a header but no rows",
            // lines of another length have been reported; the other lines are still read
            Some(_) => return table,
        };
        log.report(&(0..0), DiagnosticKind::Table { reason: reason.to_owned() });
        None
    }

    fn begin(
        log: &Collector,
        source: &Arc<SourceText>,
        header: Range<usize>,
        mut columns: Vec<String>,
        separator: Separator,
    ) -> Option<Self> {
        while columns.last().is_some_and(String::is_empty) {
            columns.pop();
        }
        let twice = columns
            .iter()
            .enumerate()
            .filter(|(_, name)| !name.is_empty())
            .find(|(n, name)| columns.iter().take(*n).any(|earlier| earlier == *name));
        if let Some((_, name)) = twice {
            let reason = format!("the header has the name `{name}` twice");
            log.report(&header, DiagnosticKind::Table { reason });
            return None;
        }
        Some(Self { source: source.clone(), columns, rows: Vec::new(), header, separator })
    }

    /// The names in the header.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Whether a row has a cell for each column.
    pub fn is_whole(&self, row: usize) -> bool {
        self.rows.get(row).is_some_and(|(_, cells)| cells.len() == self.columns.len())
    }

    /// The text of a cell; empty if there is no such column.
    pub fn text(&self, row: usize, column: usize) -> &str {
        let cell = self.rows.get(row).and_then(|(_, cells)| cells.get(column));
        cell.map_or("", String::as_str)
    }

    /// The line on which a row begins, from 0.
    pub fn line(&self, row: usize) -> usize {
        let start = self.rows.get(row).map_or(0, |(span, _)| span.start);
        self.source.position(start).0.saturating_sub(1)
    }

    /// The separator of its cells.
    pub fn separator(&self) -> Separator {
        self.separator
    }

    /// The position of the header.
    pub fn header(&self) -> Place {
        Place { source: self.source.clone(), span: self.header.clone() }
    }

    /// The position of a heading.
    pub fn heading(&self, column: usize) -> Place {
        place_of_cell(&self.header(), column, self.separator)
    }

    /// The position of a cell.
    pub fn place(&self, row: usize, column: usize) -> Place {
        let span = self.rows.get(row).map_or(self.header.clone(), |(span, _)| span.clone());
        place_of_cell(&Place { source: self.source.clone(), span }, column, self.separator)
    }
}

/// What to do about a row with only one cell, such as a footnote.
pub fn alone(words: &str) -> String {
    let words: String = words.chars().take(40).collect();
    format!("`{words}` is alone in its row: remove the row, or begin it with `#` if it is a remark")
}

/// The length of the first line of a text including its end: `\n`, `\r\n`, or the lone `\r` that
/// spreadsheets write for old Macintosh computers.
fn end_of_line(text: &str) -> usize {
    match text.find(['\n', '\r']) {
        Some(at) if text[at..].starts_with("\r\n") => at + 2,
        Some(at) => at + 1,
        None => text.len(),
    }
}

/// The length of the first record of a text including its line end; `None` if a quoted cell is not
/// closed.
pub fn record(text: &str, separator: char) -> Option<usize> {
    let (mut begins, mut quoted) = (true, false);
    let mut letters = text.char_indices().peekable();
    while let Some((at, letter)) = letters.next() {
        match letter {
            // two quotes in the cell mean one
            '"' if quoted => match letters.peek() {
                Some((_, '"')) => {
                    letters.next();
                }
                _ => quoted = false,
            },
            _ if quoted => {}
            '"' if begins => quoted = true,
            '\n' | '\r' => return Some(at + end_of_line(&text[at..])),
            _ => {}
        }
        begins = !quoted && letter == separator;
    }
    (!quoted).then_some(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_ends_where_its_line_does_outside_of_quotes() {
        for (text, length) in [
            ("a,b\nc", Some(4)),
            ("a,b", Some(3)),
            ("\"a\nb\",c\nd", Some(8)),
            ("\"a\"\"\nb\",c\nd", Some(10)),
            // inch marks are not quotes, and neither are marks inside a cell
            ("x, \"a\nb\"\nd", Some(6)),
            ("5\" pipe,c\nd", Some(10)),
            ("a,b\rc", Some(4)),
            ("a,b\r\nc", Some(5)),
            ("\"a\rb\",c\rd", Some(8)),
            ("\"a\nb", None),
            ("\"a\",\"", None),
        ] {
            assert_eq!(record(text, ','), length, "{text:?}");
        }
        assert_eq!(record("a;\"b\nc\"\nd", ';'), Some(8));
    }

    #[test]
    fn cells_hold_line_breaks_in_quotes() {
        let text = "label,x\n\"two\r\nlines\",1\n# no row\nb,2\n";
        let source = SourceText::new("t", text);
        let log = Collector::new(source.clone());
        let table = TextTable::parse(&log, &source).unwrap();
        assert_eq!((table.rows(), table.text(0, 0)), (2, "two\r\nlines"));
        assert_eq!(table.text(1, 1), "2");
        let place = table.place(1, 1);
        assert_eq!(source.position(place.span.start), (5, 3));
    }

    /// A lone carriage return ends a line; before, everything after it was lost.
    #[test]
    fn carriage_returns_end_lines() {
        for text in ["label,x\ra,1\rb,2\r", "label,x\na,1\rb,2\n", "label,x\r\na,1\r\nb,2"] {
            let source = SourceText::new("t", text);
            let log = Collector::new(source.clone());
            let table = TextTable::parse(&log, &source).unwrap();
            assert_eq!(
                (table.rows(), table.text(0, 1), table.text(1, 0)),
                (2, "1", "b"),
                "{text:?}"
            );
        }
    }

    #[test]
    fn a_cell_without_an_end_is_named() {
        let source = SourceText::new("t", "label,x\n\"a,1\nb,2\n");
        let log = Collector::new(source.clone());
        assert!(TextTable::parse(&log, &source).is_none());
        let said = log.into_diagnostics().to_string();
        assert!(said.starts_with("t:2:1:") && said.contains("no closing quote"), "{said}");
    }
}
