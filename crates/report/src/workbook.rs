//! Workbooks: worksheets of texts, numbers and live formulas with their cached values. No date and
//! no name of a person is in them, so that the same answer is the same bytes.

use std::io;

use rust_xlsxwriter::utility::{check_sheet_name, quote_sheet_name, row_col_to_cell_absolute};
use rust_xlsxwriter::{
    Chart, Color, DocProperties, ExcelDateTime, Format, FormatAlign, FormatBorder, Formula,
    Workbook, Worksheet, XlsxError,
};

use super::number::MISSING;
use super::sheet::{ColumnKind, Sheet};
use gumption_engine::decimal::position;

/// Letters of a worksheet's name, at most.
const LONGEST_NAME: usize = 31;

/// Characters of a cell, at most.
const LONGEST_TEXT: usize = 32_000;

/// Width of a column, in letters: the least, the most.
const WIDTHS: (usize, usize) = (9, 60);

/// Height of a line of text, in points.
const LINE_HEIGHT: f64 = 15.0;

/// Shares of which small parts count, as per cent.
pub(crate) const PERCENT: &str = "0.00%";

/// Shares that are compared with each other, as per cent.
pub(crate) const SHARE: &str = "0.0%";

/// Decimals that are shown at most without an exponent.
const MOST_DECIMALS: i32 = 9;

/// Digits that a spreadsheet holds of a number.
const MOST_DIGITS: i32 = 15;

/// What a formula gives at the time of writing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cached {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
}

/// How a cell looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Look {
    /// A number that follows from others.
    Plain,
    /// A number that may be changed.
    Input,
    /// A result.
    Stressed,
    /// Words, which may run over their neighbours.
    Words,
}

/// A workbook that is being written.
pub(crate) struct Book {
    workbook: Workbook,
    names: Vec<String>,
}

/// A worksheet that is being written.
pub(crate) struct Leaf {
    worksheet: Worksheet,
    name: String,
    /// The widest text of each column.
    widths: Vec<usize>,
    /// Rows of headers, whose height follows from the widths.
    headers: Vec<((u32, u16), Vec<String>)>,
}

/// An error of the library as one of the writer.
pub(crate) fn failed(error: XlsxError) -> io::Error {
    match error {
        XlsxError::IoError(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

impl Book {
    /// An empty workbook.
    pub(crate) fn new(title: &str) -> Result<Self, XlsxError> {
        let mut workbook = Workbook::new();
        // the date is that of the format, not of today
        let properties = DocProperties::new()
            .set_title(cut(title))
            .set_creation_datetime(&ExcelDateTime::from_ymd(2000, 1, 1)?);
        workbook.set_properties(&properties);
        Ok(Self { workbook, names: Vec::new() })
    }

    /// An empty worksheet with a name like the wanted one.
    pub(crate) fn leaf(&mut self, wanted: &str) -> Result<Leaf, XlsxError> {
        let name = self.name(wanted);
        let mut worksheet = Worksheet::new();
        worksheet.set_name(&name)?.set_paper_size(9).set_landscape();
        worksheet.set_print_fit_to_pages(1, 0);
        self.names.push(name.to_lowercase());
        Ok(Leaf { worksheet, name, widths: Vec::new(), headers: Vec::new() })
    }

    /// A name that is allowed and not yet taken; case makes no difference.
    fn name(&self, wanted: &str) -> String {
        let plain: String = wanted
            .chars()
            .map(|c| if "[]:*?/\\'".contains(c) || c.is_control() { '_' } else { c })
            .collect();
        let short = |most: usize| plain.chars().take(most).collect::<String>().trim().to_owned();
        let mut name = short(LONGEST_NAME);
        let mut number = 2;
        while self.names.contains(&name.to_lowercase()) || check_sheet_name(&name).is_err() {
            name = format!("{} {number}", short(LONGEST_NAME - 6)).trim().to_owned();
            number += 1;
        }
        name
    }

    /// Adds a worksheet that is finished.
    pub(crate) fn push(&mut self, mut leaf: Leaf) -> Result<(), XlsxError> {
        for (column, width) in (0_u16..).zip(&leaf.widths) {
            let width = (width + 2).clamp(WIDTHS.0, WIDTHS.1);
            leaf.worksheet.set_column_width(column, width as f64)?;
        }
        // some programs do not fit the height of a row to its text
        for ((row, first), headers) in &leaf.headers {
            let widths = leaf.widths.get(usize::from(*first)..).unwrap_or_default();
            let lines = headers.iter().zip(widths).map(|(header, width)| {
                lines(header, (width + 2).clamp(WIDTHS.0, WIDTHS.1).saturating_sub(1))
            });
            let lines = lines.max().unwrap_or(1).max(1);
            leaf.worksheet.set_row_height(*row, LINE_HEIGHT * lines as f64)?;
        }
        self.workbook.push_worksheet(leaf.worksheet);
        Ok(())
    }

    /// The bytes of the file.
    pub(crate) fn bytes(mut self) -> Result<Vec<u8>, XlsxError> {
        self.workbook.save_to_buffer()
    }
}

impl Leaf {
    /// How formulas of any worksheet call a cell of this one.
    pub(crate) fn cell(&self, row: u32, column: u16) -> String {
        format!("{}!{}", quoted(&self.name), here(row, column))
    }

    /// A title.
    pub(crate) fn title(&mut self, row: u32, text: &str) -> Result<(), XlsxError> {
        let format = Format::new().set_bold().set_font_size(14.0);
        self.worksheet.write_string_with_format(row, 0, cut(text), &format)?;
        Ok(())
    }

    /// A text that may run over its neighbours.
    pub(crate) fn line(&mut self, row: u32, text: &str) -> Result<(), XlsxError> {
        self.worksheet.write_string(row, 0, cut(text))?;
        Ok(())
    }

    /// A line of fixed-width text.
    pub(crate) fn code(&mut self, row: u32, text: &str) -> Result<(), XlsxError> {
        let format = Format::new().set_font_name("Courier New");
        self.worksheet.write_string_with_format(row, 0, cut(text), &format)?;
        Ok(())
    }

    /// Headers of a table.
    pub(crate) fn headers<'h>(
        &mut self,
        row: u32,
        headers: impl IntoIterator<Item = &'h str>,
    ) -> Result<(), XlsxError> {
        self.headers_from((row, 0), headers)
    }

    /// Headers of a table that begins at a column.
    pub(crate) fn headers_from<'h>(
        &mut self,
        (row, first): (u32, u16),
        headers: impl IntoIterator<Item = &'h str>,
    ) -> Result<(), XlsxError> {
        let plain = Format::new()
            .set_bold()
            .set_text_wrap()
            .set_align(FormatAlign::Bottom)
            .set_border_bottom(FormatBorder::Thin);
        let centred = plain.clone().set_align(FormatAlign::Center);
        let headers: Vec<&str> = headers.into_iter().collect();
        let texts = headers.iter().map(|header| (*header).to_owned()).collect();
        self.headers.push(((row, first), texts));
        for (column, header) in (first..).zip(headers) {
            let format = if column > 0 { &centred } else { &plain };
            self.worksheet.write_string_with_format(row, column, cut(header), format)?;
            let word = header.split_whitespace().map(|word| word.chars().count()).max();
            self.widen(column, word.unwrap_or(0));
        }
        Ok(())
    }

    /// A text.
    pub(crate) fn text(&mut self, row: u32, column: u16, text: &str) -> Result<(), XlsxError> {
        if !text.is_empty() {
            // apart from the number on its left
            let format = Format::new().set_indent(u8::from(column > 0));
            self.worksheet.write_string_with_format(row, column, cut(text), &format)?;
            self.widen(column, text.chars().count() + 1);
        }
        Ok(())
    }

    /// A number, shown to a decimal place if there is one; a dash for what is not finite.
    pub(crate) fn number(
        &mut self,
        (row, column): (u32, u16),
        value: f64,
        place: Option<i32>,
        look: Look,
    ) -> Result<(), XlsxError> {
        let shown = place.map(|place| shown(place, Some(value)));
        let format = format(shown.as_deref(), look);
        if value.is_finite() {
            self.worksheet.write_number_with_format(row, column, value, &format)?;
        } else {
            self.worksheet.write_string_with_format(row, column, MISSING, &format)?;
        }
        self.widen(column, 12);
        Ok(())
    }

    /// A share as per cent.
    pub(crate) fn share(
        &mut self,
        (row, column): (u32, u16),
        value: f64,
        shown: &str,
    ) -> Result<(), XlsxError> {
        let format = format(Some(shown), Look::Plain);
        self.worksheet.write_number_with_format(row, column, value, &format)?;
        self.widen(column, 12);
        Ok(())
    }

    /// A share as per cent by a formula, with what it gives now.
    pub(crate) fn share_formula(
        &mut self,
        (row, column): (u32, u16),
        formula: &str,
        now: f64,
        shown: &str,
    ) -> Result<(), XlsxError> {
        let format = format(Some(shown), Look::Plain);
        let formula = Formula::new(format!("={formula}")).set_result(format!("{now:?}"));
        self.worksheet.write_formula_with_format(row, column, formula, &format)?;
        self.widen(column, 12);
        Ok(())
    }

    /// A figure beside or below the cells.
    pub(crate) fn chart(
        &mut self,
        (row, column): (u32, u16),
        chart: &Chart,
    ) -> Result<(), XlsxError> {
        self.worksheet.insert_chart(row, column, chart)?;
        Ok(())
    }

    /// How a figure calls cells of this worksheet, from the first to the last.
    pub(crate) fn range(&self, first: (u32, u16), last: (u32, u16)) -> String {
        let cell = |(row, column): (u32, u16)| here(row, column);
        format!("={}!{}:{}", quoted(&self.name), cell(first), cell(last))
    }

    /// A text that looks like a number.
    pub(crate) fn word(
        &mut self,
        (row, column): (u32, u16),
        text: &str,
        look: Look,
    ) -> Result<(), XlsxError> {
        self.worksheet.write_string_with_format(row, column, text, &format(None, look))?;
        Ok(())
    }

    /// A formula with what it gives now.
    pub(crate) fn formula(
        &mut self,
        (row, column): (u32, u16),
        formula: &str,
        cached: &Cached,
        place: Option<i32>,
        look: Look,
    ) -> Result<(), XlsxError> {
        let (now, cached) = match cached {
            Cached::Number(value) if value.is_finite() => (Some(*value), format!("{value:?}")),
            Cached::Number(_) => (None, MISSING.to_owned()),
            Cached::Text(text) => (None, text.clone()),
        };
        let formula = Formula::new(format!("={formula}")).set_result(cached);
        let shown = place.map(|place| shown(place, now));
        let format = format(shown.as_deref(), look);
        self.worksheet.write_formula_with_format(row, column, formula, &format)?;
        self.widen(column, 12);
        Ok(())
    }

    /// A table from a row on: cells whose unrounded numbers are known are those, with as many
    /// decimals as the page shows. The row below it.
    pub(crate) fn table(&mut self, row: u32, sheet: &Sheet) -> Result<u32, XlsxError> {
        let titles: Vec<String> =
            sheet.columns.iter().map(super::sheet::SheetColumn::title).collect();
        self.headers(row, titles.iter().map(String::as_str))?;
        let mut below = row + 1;
        for line in 0..sheet.rows() {
            for (place, column) in (0_u16..).zip(&sheet.columns) {
                let text = column.cell(line);
                match (column.value(line), column.kind) {
                    (Some(value), _) => {
                        self.number((below, place), value, decimals(text), Look::Plain)?;
                    }
                    (None, ColumnKind::Numbers) => self.word((below, place), text, Look::Plain)?,
                    (None, ColumnKind::Text | ColumnKind::Units | ColumnKind::Equations) => {
                        self.text(below, place, text)?
                    }
                }
            }
            below += 1;
        }
        Ok(below)
    }

    /// Keeps the first rows in sight.
    pub(crate) fn freeze(&mut self, rows: u32) -> Result<(), XlsxError> {
        self.worksheet.set_freeze_panes(rows, 1)?;
        Ok(())
    }

    fn widen(&mut self, column: u16, width: usize) {
        let column = usize::from(column);
        if self.widths.len() <= column {
            self.widths.resize(column + 1, 0);
        }
        if let Some(known) = self.widths.get_mut(column) {
            *known = width.max(*known);
        }
    }
}

/// How formulas of the same worksheet call a cell.
pub(crate) fn here(row: u32, column: u16) -> String {
    row_col_to_cell_absolute(row, column)
}

fn quoted(name: &str) -> String {
    // a name that looks like a cell or a number needs quotation marks as well
    let quoted = quote_sheet_name(name);
    if quoted.starts_with('\'') { quoted } else { format!("'{quoted}'") }
}

/// The decimal place of the last digit of a number as a page shows it.
fn decimals(text: &str) -> Option<i32> {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    mantissa.parse::<f64>().ok()?;
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    Some(exponent.parse::<i32>().ok()? - i32::try_from(decimals).ok()?)
}

/// How a number is shown whose last digit has a place, by its value where that is known.
fn shown(place: i32, value: Option<f64>) -> String {
    let zeros = |count: i32| "0".repeat(count.unsigned_abs() as usize);
    match place {
        0..=MOST_DECIMALS => "0".to_owned(),
        _ if (-MOST_DECIMALS..0).contains(&place) => format!("0.{}", zeros(place)),
        _ => {
            // as many digits as there are, in plain decimals where that is readable
            let leading = value.and_then(|value| position(value, 1));
            // three of a number that is not known
            let digits = leading.map_or(3, |leading| leading.saturating_sub(place));
            let (leading, digits) = (leading.unwrap_or(place), digits.clamp(0, MOST_DIGITS - 1));
            if place < 0 && (-3..MOST_DECIMALS).contains(&leading) {
                format!("0.{}", zeros(digits - leading))
            } else if digits == 0 {
                "0E+00".to_owned()
            } else {
                format!("0.{}E+00", zeros(digits))
            }
        }
    }
}

/// The format of a cell, whose number is shown in that way where one is given.
fn format(shown: Option<&str>, look: Look) -> Format {
    let mut format = Format::new().set_align(FormatAlign::Right);
    if let Some(shown) = shown {
        format = format.set_num_format(shown);
    }
    match look {
        Look::Plain => format,
        Look::Input => {
            format.set_background_color(Color::RGB(0x00FF_F2CC)).set_border(FormatBorder::Hair)
        }
        Look::Stressed => format.set_bold(),
        Look::Words => format.set_bold().set_align(FormatAlign::Left),
    }
}

/// Lines that a text takes in a column of so many letters.
fn lines(text: &str, width: usize) -> usize {
    let mut lines = 1;
    let mut used = 0;
    for word in text.split_whitespace().map(|word| word.chars().count()) {
        let with = if used == 0 { word } else { used + 1 + word };
        // bold letters are wider
        let fits = with + with / 8 <= width;
        lines += usize::from(!fits && used > 0);
        used = if fits { with } else { word };
    }
    lines
}

/// As much of a text as a cell holds, without what no cell may hold.
fn cut(text: &str) -> String {
    let allowed = |c: &char| !c.is_control() || matches!(c, '\t' | '\n');
    text.chars().filter(allowed).take(LONGEST_TEXT).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_allowed_and_different() {
        let mut book = Book::new("t").unwrap();
        let mut name = |wanted: &str| book.leaf(wanted).unwrap().name;
        assert_eq!(name("Budget a_x"), "Budget a_x");
        assert_eq!(name("budget A_X"), "budget A_X 2");
        assert_eq!(name("a/b:c"), "a_b_c");
        assert_eq!(name(""), "2");
        let long = "x".repeat(50);
        assert_eq!(name(&long).len(), 31);
        assert_eq!(name(&long), "x".repeat(25) + " 2");
    }

    #[test]
    fn headers_wrap_at_words() {
        assert_eq!(lines("standard uncertainty", 12), 2);
        assert_eq!(lines("Monte Carlo interval, from", 12), 3);
        assert_eq!(lines("k", 8), 1);
    }

    #[test]
    fn places_of_shown_digits() {
        assert_eq!(decimals("0.0123"), Some(-4));
        assert_eq!(decimals("1200"), Some(0));
        assert_eq!(decimals("1.2e-7"), Some(-8));
        assert_eq!(decimals("∞"), None);
    }

    #[test]
    fn the_same_content_is_the_same_bytes() {
        let make = || {
            let mut book = Book::new("title").unwrap();
            let mut leaf = book.leaf("a").unwrap();
            let mut sheet = Sheet::default();
            sheet.text("name", ["=1+1".to_owned()]);
            sheet.numbers("value", ["1.5".to_owned()]);
            leaf.table(0, &sheet).unwrap();
            book.push(leaf).unwrap();
            book.bytes().unwrap()
        };
        assert_eq!(make(), make());
    }
}
