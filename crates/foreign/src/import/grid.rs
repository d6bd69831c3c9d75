//! The cells of a sheet, whatever stands in them.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;

use super::columns::{self, Column, Header};
use gumption_columns::separator::{DecimalMarks, Separator};
use gumption_files::open::no_table;
use gumption_text::text_table::record;
use gumption_text::workbook::Layout;
use gumption_text::{DiagnosticKind, SourceText, bytes};

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
    /// The lines of a text that may hold equations, as they are written.
    written: HashMap<usize, String>,
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

    /// A cell and those behind it that no quotes part from it, as they stand in a text: what a separator
    /// within an equation has made cells of. `count` of them, or `None` where there are not so many.
    pub(super) fn run_on(&self, line: usize, place: usize, count: usize) -> Option<String> {
        let cells = self.row(line).get(place..=place + count)?;
        let sign = self.separator?.sign().to_string();
        let joined = cells.join(&sign);
        let is_bare = self.written.get(&line).is_some_and(|written| written.contains(&joined));
        is_bare.then_some(joined)
    }

    /// What a workbook says of the cells besides their values; of a text nothing.
    pub(super) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Writes what merged cells hold into all rows that they span, in columns of what several rows can
    /// have in common; what was taken, as sentences.
    fn spread_merged(&mut self, header: &Header) -> Vec<String> {
        const COMMON: [Column; 7] = [
            Column::Unit,
            Column::UnitOfUncertainty,
            Column::Distribution,
            Column::Divisor,
            Column::Dof,
            Column::Sensitivity,
            Column::UnitOfSensitivity,
        ];
        let mut said = Vec::new();
        for ((first, column), (last, _)) in self.layout.merged.clone() {
            let (first, last, place) = (first as usize, last as usize, column as usize);
            let is_common =
                |(of, column): &(usize, Column)| *of == place && COMMON.contains(column);
            let text = self.text(first, place).to_owned();
            if first <= header.line
                || text.trim().is_empty()
                || !header.columns.iter().any(is_common)
            {
                continue;
            }
            let mut is_taken = false;
            for row in self.rows.iter_mut().take(last + 1).skip(first + 1) {
                if row.iter().all(|cell| cell.trim().is_empty()) {
                    continue;
                }
                row.resize(row.len().max(place + 1), String::new());
                if row[place].is_empty() {
                    row[place].clone_from(&text);
                    is_taken = true;
                }
            }
            if is_taken {
                said.push(format!(
                    "the merged cell `{}` counts for lines {} to {}",
                    text.trim(),
                    first + 1,
                    last + 1
                ));
            }
        }
        said
    }

    /// Moves the words of totals that stand right before their numbers, `,,,,,,uc,0.304`, or in a column before the
    /// names, to where the names of quantities stand.
    fn move_totals(&mut self, header: &Header) {
        let Some((place, _)) = header.columns.iter().find(|(_, of)| *of == Column::Quantity) else {
            return;
        };
        let (place, symbol) = (*place, header.columns.iter().find(|(_, of)| *of == Column::Symbol));
        for row in self.rows.iter_mut().skip(header.line + 1) {
            let Some(first) = row.iter().position(|cell| !cell.trim().is_empty()) else { continue };
            if first == place
                || first < place && row.get(place).is_some_and(|name| !name.trim().is_empty())
                || symbol.is_some_and(|(symbol, _)| *symbol == first)
            {
                continue;
            }
            let words = row[first].trim();
            let is_total = columns::is_combined_symbol(words)
                || columns::is_summary_symbol(words)
                || columns::is_expanded_symbol(words)
                || columns::is_result(words);
            if is_total {
                row.swap(place, first);
            }
        }
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
        let of = |of: usize| u32::try_from(of).ok();
        let of_texts = |place| self.layout.texts.contains(&place);
        self.separator.is_some() || of(line).zip(of(place)).is_some_and(of_texts)
    }
}

/// The cells of a sheet of a workbook, the text of messages, and what was taken of merged cells.
pub(super) fn of_sheet(rows: Vec<Vec<String>>, layout: Layout) -> (Cells, String, Vec<String>) {
    let (cells, text) = of_rows(rows);
    let mut cells = Cells { layout, ..cells };
    let Some(header) = Header::find(&cells) else { return (cells, text, Vec::new()) };
    let said = cells.spread_merged(&header);
    cells.move_totals(&header);
    (cells, text, said)
}

/// The cells of a CSV file, and the text of messages.
pub(super) fn of_text(content: &[u8]) -> Result<(Cells, String), DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    let text = bytes::text(content).map_err(unreadable)?;
    if let Some((_, kind)) = no_table(&SourceText::new("", &text)) {
        return Err(kind);
    }
    // words may have any of the signs in them: the header tells which one separates
    let order = [Separator::Semicolon, Separator::Tab, Separator::Comma];
    let read = order.map(|separator| separated(&text, separator));
    let columns = |read: &Result<(Cells, String), DiagnosticKind>| {
        let found = read.as_ref().ok().and_then(|(cells, _)| Header::find(cells));
        found.map_or(0, |header| header.columns.len())
    };
    let counts = read.each_ref().map(columns);
    let most = counts.iter().copied().max().unwrap_or(0);
    let is_used = |sign: Separator| text.contains(sign.sign());
    // a quote without an end hides the header from every sign
    if most == 0 && read.iter().all(Result::is_err) {
        let [.., last] = read;
        return last;
    }
    let best = match most {
        // no header: what stands there is told in the words of the most likely one
        0 => order.iter().position(|sign| is_used(*sign)).unwrap_or(2),
        _ => counts.iter().position(|count| *count == most).unwrap_or(2),
    };
    let [semicolon, tab, comma] = read;
    let (mut cells, text) = match best {
        0 => semicolon,
        1 => tab,
        _ => comma,
    }?;
    if let Some(header) = Header::find(&cells) {
        cells.move_totals(&header);
    }
    Ok((cells, text))
}

fn separated(text: &str, separator: Separator) -> Result<(Cells, String), DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    if let Some(line) = line_of_open_quote(text, separator) {
        let message =
            format!("line {line}: a cell that begins with a quote has no quote at its end");
        return Err(unreadable(message));
    }
    let (mut rows, mut written) = (Vec::new(), HashMap::new());
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
        if record.iter().any(|cell| cell.contains('=')) {
            let start = record.position().map_or(0, |place| place.byte() as usize);
            let content = text.get(start..).unwrap_or_default().trim_start_matches(['\n', '\r']);
            written.insert(rows.len(), content.lines().next().unwrap_or_default().to_owned());
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
    Ok((Cells { separator: Some(separator), quoted_commas, written, ..cells }, text))
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
