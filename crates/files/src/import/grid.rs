//! The cells of a sheet, whatever stands in them.

use std::ops::Range;

use crate::open::json_as_table;
use crate::separator::{DecimalMarks, Separator};
use crate::source::SourceText;
use crate::{DiagnosticKind, bytes, workbook};

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
}

impl Cells {
    pub(super) fn lines(&self) -> usize {
        self.rows.len()
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
        self.separator != Some(Separator::Comma)
    }

    /// The decimal marks of its numbers; of a workbook, whose numbers have none, those of any text.
    pub(super) fn marks(&self) -> DecimalMarks {
        DecimalMarks::of(self.separator.unwrap_or(Separator::Comma))
    }
}

/// The cells of a CSV file or of the first sheet of an XLSX file, and the text of messages.
pub(super) fn of_content(
    content: Vec<u8>,
    is_workbook: bool,
) -> Result<(Cells, String), DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    if is_workbook {
        let rows = workbook::rows(content).map_err(unreadable)?;
        return Ok(of_rows(rows));
    }
    let text = bytes::text(&content).map_err(unreadable)?;
    if let Some((_, kind)) = json_as_table(&SourceText::new("", &text)) {
        return Err(kind);
    }
    let count = |sign: char| text.matches(sign).count();
    let separator = if count('\t') > count(';') && count('\t') > count(',') {
        Separator::Tab
    } else if count(';') > 0 {
        Separator::Semicolon
    } else {
        Separator::Comma
    };
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
        let line = record.position().map_or(last + 1, |place| place.line() as usize);
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
    let (mut cells, text) = of_rows(rows);
    cells.separator = Some(separator);
    Ok((cells, text))
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
    (Cells { rows, spans, separator: None }, text)
}

/// A number as spreadsheets write them; `1,5` where commas are decimal ones.
pub(super) fn number(text: &str, decimal_comma: bool) -> Option<f64> {
    let text = text.trim().replace(['\u{a0}', '\u{202f}'], "").replace('−', "-");
    if let Some(percent) = text.strip_suffix('%') {
        return number(percent, decimal_comma).map(|share| share / 100.0);
    }
    let plain = text.parse::<f64>().ok();
    let with_comma = || {
        let one = decimal_comma && text.matches(',').count() == 1 && !text.contains('.');
        one.then(|| text.replace(',', ".").parse::<f64>().ok()).flatten()
    };
    plain.or_else(with_comma).filter(|value| value.is_finite())
}

/// A number with the unit behind it, perhaps with digits in groups of three: `10 000,005 g`. The unit is
/// empty where there is none, and not looked at.
pub(super) fn number_with_unit(text: &str, decimal_comma: bool) -> Option<(f64, &str)> {
    let text = text.trim();
    if let Some(value) = number(text, decimal_comma) {
        return Some((value, ""));
    }
    let ends = text.char_indices().map(|(at, c)| at + c.len_utf8());
    ends.rev().find_map(|end| {
        let (digits, unit) = text.split_at_checked(end)?;
        let value = number(&ungrouped(digits.trim_end())?, decimal_comma)?;
        Some((value, unit.trim()))
    })
}

/// A number without the spaces between groups of three digits; `None` where there are others.
fn ungrouped(digits: &str) -> Option<String> {
    let mut groups = digits.split([' ', '\u{a0}', '\u{202f}']);
    let first = groups.next()?;
    groups.try_fold(first.to_owned(), |whole, group| {
        let (head, rest) = group.split_at_checked(3)?;
        let is_group = head.bytes().all(|b| b.is_ascii_digit())
            && !rest.starts_with(|c: char| c.is_ascii_digit())
            && whole.ends_with(|c: char| c.is_ascii_digit());
        is_group.then(|| whole + group)
    })
}
