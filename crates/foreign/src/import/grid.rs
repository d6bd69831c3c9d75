//! The cells of a sheet, whatever stands in them.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;

use super::columns::{self, Column};
use super::options::ImportOptions;
use super::table::line_of;
use gumption_columns::separator::{DecimalMarks, Separator};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_files::open::no_table;
use gumption_text::SourceText;
use gumption_text::text_table::record;
use gumption_text::workbook::Layout;
use gumption_text::{DiagnosticKind, bytes};

/// Lines and cells, at most.
const MOST_LINES: usize = 10_000;

/// The cells of a sheet, line by line.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    rows: Vec<Vec<String>>,
    /// Where each line stands in the text.
    spans: Vec<Range<usize>>,
    /// What separated them in a text; `None` in a workbook.
    separator: Option<Separator>,
    /// Whether cells of a text with commas between them have decimal commas, in quotes.
    quoted_commas: bool,
    /// What a workbook says of its cells besides their values.
    layout: Layout,
    /// What texts of cells are as headings: of many rows few have others, and all are looked at.
    known: RefCell<HashMap<String, Option<Column>>>,
}

impl Cells {
    pub(super) fn lines(&self) -> usize {
        self.rows.len()
    }

    /// What a cell's text is as the heading of a column.
    pub(super) fn column(&self, text: &str) -> Option<Column> {
        if let Some(known) = self.known.borrow().get(text) {
            return *known;
        }
        let found = columns::column(text);
        self.known.borrow_mut().insert(text.to_owned(), found);
        found
    }

    /// The cells of a line.
    pub(super) fn row(&self, line: usize) -> &[String] {
        self.rows.get(line).map_or(&[], Vec::as_slice)
    }

    /// A cell; empty where there is none.
    pub(super) fn text(&self, line: usize, place: usize) -> &str {
        self.row(line).get(place).map_or("", String::as_str)
    }

    /// The place of a line in the text.
    pub(super) fn line(&self, line: usize) -> Range<usize> {
        self.spans.get(line).cloned().unwrap_or(0..0)
    }

    /// Whether numbers have a decimal comma.
    pub(super) fn decimal_comma(&self) -> bool {
        self.separator != Some(Separator::Comma) || self.quoted_commas
    }

    /// What separated them in a text; `None` in a workbook.
    pub(super) fn separator(&self) -> Option<Separator> {
        self.separator
    }

    /// What a workbook says of the cells besides their values; of a text nothing.
    pub(super) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Writes what merged cells hold into all rows that they span, in columns of what several rows can
    /// have in common; gives what was taken.
    fn spread_merged(&mut self, line: usize) -> Vec<Fact> {
        const COMMON: [Column; 7] = [
            Column::Unit,
            Column::UnitOfUncertainty,
            Column::Distribution,
            Column::Divisor,
            Column::Factor,
            Column::Dof,
            Column::UnitOfSensitivity,
        ];
        let mut said = Vec::new();
        for ((first, column), (last, _)) in self.layout.merged.clone() {
            let (first, last, place) = (first as usize, last as usize, column as usize);
            let is_common =
                self.column(self.text(line, place)).is_some_and(|column| COMMON.contains(&column));
            let text = self.text(first, place).to_owned();
            if first <= line || text.trim().is_empty() || !is_common {
                continue;
            }
            for row in self.rows.iter_mut().take(last + 1).skip(first + 1) {
                if row.iter().any(|cell| !cell.trim().is_empty()) {
                    row.resize(row.len().max(place + 1), String::new());
                    if row[place].is_empty() {
                        row[place].clone_from(&text);
                    }
                }
            }
            let (text, first, last) = (text.trim(), first + 1, last + 1);
            said.push(fact!("import.merged-cell", text, first, last));
        }
        said
    }

    /// The decimal marks of its numbers; of a workbook those of its texts, since its numbers have none.
    pub(super) fn marks(&self) -> DecimalMarks {
        DecimalMarks::of(self.separator.unwrap_or(Separator::Semicolon))
    }

    /// Why a cell of a workbook holds no number, though its value is one.
    pub(super) fn no_number(&self, line: usize, place: usize) -> Option<String> {
        self.layout.no_number((u32::try_from(line).ok()?, u32::try_from(place).ok()?))
    }

    /// Whether a cell holds what somebody wrote, and no number of a workbook.
    pub(super) fn is_written(&self, line: usize, place: usize) -> bool {
        let of = |number: usize| u32::try_from(number).ok();
        let of_texts = |place| self.layout.texts.contains(&place);
        self.separator.is_some() || of(line).zip(of(place)).is_some_and(of_texts)
    }
}

/// Whether a cell holds nothing, or a sign that nothing is there.
pub(super) fn is_empty(text: &str) -> bool {
    matches!(text.trim().to_lowercase().as_str(), "" | "-" | "–" | "—" | "n/a" | "na" | "n.a.")
}

/// The cells of a sheet of a workbook, the text of messages, and what was taken of merged cells.
pub(super) fn of_sheet(
    rows: Vec<Vec<String>>,
    layout: Layout,
    options: &ImportOptions,
) -> (Cells, String, Vec<Fact>) {
    let (cells, text) = of_rows(rows);
    let mut cells = Cells { layout, ..cells };
    let said = line_of(&cells, options).map(|line| cells.spread_merged(line)).unwrap_or_default();
    (cells, text, said)
}

/// The cells of a CSV file, and the text of messages. A file whose name ends in `.tsv` has tabs between its
/// cells, as a text that is copied from a spreadsheet.
pub(super) fn of_text(
    path: &Path,
    content: &[u8],
    options: &ImportOptions,
) -> Result<(Cells, String), DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    let text = bytes::text(content).map_err(unreadable)?;
    if let Some((_, kind)) = no_table(&SourceText::new("", &text)) {
        return Err(kind);
    }
    if path.extension().is_some_and(|of| of.eq_ignore_ascii_case("tsv")) {
        return separated(&text, Separator::Tab);
    }
    // words may have any of the signs in them: the headings tell which one separates
    let read = [Separator::Semicolon, Separator::Tab, Separator::Comma]
        .map(|separator| separated(&text, separator));
    let count = |read: &Result<(Cells, String), DiagnosticKind>| {
        let cells = read.as_ref().ok().map(|(cells, _)| cells)?;
        let line = line_of(cells, options)?;
        Some(cells.row(line).iter().filter(|cell| cells.column(cell).is_some()).count() + 1)
    };
    let counts = read.each_ref().map(|read| count(read).unwrap_or(0));
    let used = ['\u{3b}', '\t', ','].map(|sign| text.contains(sign));
    let most = counts.into_iter().max().unwrap_or(0);
    let best = match most {
        // no headings: what stands there is told in the words of the most likely sign
        0 => used.iter().position(|used| *used).unwrap_or(2),
        _ => counts.iter().position(|count| *count == most).unwrap_or(2),
    };
    read.into_iter().nth(best).unwrap_or_else(|| separated(&text, Separator::Comma))
}

fn separated(text: &str, separator: Separator) -> Result<(Cells, String), DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    if let Some(line) = line_of_open_quote(text, separator) {
        let message =
            format!("line {line}: a cell that begins with a quote has no quote at its end");
        return Err(unreadable(message));
    }
    let mut rows = Vec::new();
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator.byte())
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let mut last = 0;
    for record in reader.records() {
        let record = record.map_err(|error| unreadable(format!("it is no CSV: {error}")))?;
        // empty lines are no records, and count here
        let line = record.position().map_or(last + 1, |place| {
            // a record begins where the last one ended, before the empty lines
            let before = text.get(place.byte() as usize..).unwrap_or_default();
            let content = before.trim_start_matches(['\n', '\r']);
            let skipped = before.get(..before.len() - content.len()).unwrap_or_default();
            place.line() as usize + skipped.matches('\n').count()
        });
        while last + 1 < line {
            rows.push(Vec::new());
            last += 1;
        }
        rows.push(record.iter().map(str::to_owned).collect());
        last = line;
        if rows.len() > MOST_LINES {
            let message = format!("it has more than {MOST_LINES} lines; a budget has fewer");
            return Err(unreadable(message));
        }
    }
    let quoted_commas = separator == Separator::Comma && has_decimal_commas(&rows);
    let (cells, text) = of_rows(rows);
    Ok((Cells { separator: Some(separator), quoted_commas, ..cells }, text))
}

/// The line, from 1, with a cell that begins with a quote and has none at its end.
fn line_of_open_quote(text: &str, separator: Separator) -> Option<usize> {
    let mut start = 0;
    while let Some(rest) = text.get(start..).filter(|rest| !rest.is_empty()) {
        match record(rest, separator.sign()) {
            Some(length) => start += length,
            None => return Some(text[..start].lines().count() + 1),
        }
    }
    None
}

/// Whether numbers among cells that commas separate have decimal commas: there is one that cannot be
/// a group of three digits, and none has a decimal point.
fn has_decimal_commas(rows: &[Vec<String>]) -> bool {
    let begins =
        |cell: &&str| cell.starts_with(|c: char| c.is_ascii_digit() || "+-−–±".contains(c));
    let cells = rows.iter().flatten().map(|cell| cell.trim()).filter(begins);
    let (mut commas, mut points) = (false, false);
    for cell in cells {
        let digits =
            cell.split(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ',' | '+' | '-')));
        let number = digits.max_by_key(|part| part.len()).unwrap_or_default();
        points |= number.contains('.');
        let fraction = number.split_once(',').map(|(_, fraction)| fraction);
        // `50,000 2` has digits in groups behind the mark
        let behind = cell.split_once(number).map_or("", |(_, behind)| behind).strip_prefix(' ');
        let goes_on = behind.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
        commas |= fraction
            .is_some_and(|f| (f.len() != 3 || goes_on) && !f.is_empty() && !f.contains(','));
    }
    commas && !points
}

fn of_rows(mut rows: Vec<Vec<String>>) -> (Cells, String) {
    rows.truncate(MOST_LINES);
    let (mut text, mut spans) = (String::new(), Vec::new());
    for row in &rows {
        let start = text.len();
        let line: Vec<String> = row.iter().map(|cell| cell.replace(['\n', '\r'], " ")).collect();
        text.push_str(line.join(" | ").trim_end_matches([' ', '|']));
        spans.push(start..text.len());
        text.push('\n');
    }
    (Cells { rows, spans, ..Cells::default() }, text)
}
