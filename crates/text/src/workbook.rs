//! The sheets of a workbook: their cells, and a sheet as the text of a CSV table.
//!
//! Nothing limits what a workbook of a few kilobytes unpacks to: a part may grow a thousandfold,
//! and a single stray cell in the last corner spans a sheet of seventeen thousand million cells.
//! Therefore every part is unpacked within a limit first, cells are read one by one, and only cells
//! with content are kept.

pub mod choice;
mod date;
mod layout;
mod rich;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::io::{Cursor, Read};
use std::path::Path;

use calamine::{Data, DataRef, Reader as _, SheetType, SheetVisible, Style, Xlsx};
use quick_xml::events::{BytesStart, Event};
use zip::ZipArchive;

use super::number_format::{NumberFormat, last_digit};
use super::xml_limits;
use layout::PartsOf;
pub use layout::{Layout, Place};

/// Maximum size of an unpacked part, in bytes. A table of ten thousand rows needs less than a
/// quarter of it.
const MOST_OF_PART: u64 = 20_000_000;

/// Maximum size of all unpacked parts, in bytes.
const MOST_OF_ALL: u64 = 100_000_000;

/// Parts, at most.
const MOST_PARTS: usize = 10_000;

/// Sheets, at most.
const MOST_SHEETS: usize = 256;

/// Maximum size of the table's text, in bytes: a text that is stored once may appear in any number
/// of cells.
const MOST_OF_TEXT: usize = 20_000_000;

/// Rows of a sheet (ECMA-376, and every program that writes workbooks).
const ROWS: u32 = 1 << 20;
const COLUMNS: u32 = 1 << 14;

/// The cells of a sheet with content: rows, then columns, both from 0.
type Cells = BTreeMap<u32, BTreeMap<u32, String>>;

/// A sheet as a table: its rows become the lines of a CSV text.
#[derive(Debug)]
pub struct SheetTable {
    cells: Cells,
    layout: Layout,
}

impl SheetTable {
    /// The cells of its header, the first row that is not a comment.
    pub fn header(&self) -> Vec<String> {
        let header = header(&self.cells).map(BTreeMap::values);
        header.into_iter().flatten().map(|text| unquoted(text)).collect()
    }

    /// The table's text, its first column, and the layout of the sheet.
    ///
    /// # Errors
    /// What is wrong with the sheet, as a sentence about the workbook.
    pub fn text(self) -> Result<(String, u32, Layout), String> {
        self.layout.check_shown(self.cells.keys())?;
        let first = header(&self.cells).and_then(|header| header.keys().next().copied());
        Ok((csv(&self.cells)?, first.unwrap_or(0), self.layout))
    }
}

/// Whether a file is a workbook that can be read, by the end of its name.
///
/// # Errors
/// The file is a workbook of another format; a sentence about it.
pub fn is_workbook(path: &Path) -> Result<bool, String> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("xlsx" | "xlsm") => Ok(true),
        Some(other @ ("xls" | "xlsb" | "ods" | "numbers" | "xlt" | "fods")) => Err(format!(
            "it is a workbook of the format .{other}, which cannot be read: save it as .xlsx, or \
             its sheet \
             as .csv"
        )),
        _ => Ok(false),
    }
}

/// A sheet of a workbook.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet<'a> {
    /// The last one.
    Last,
    /// The sheet of this name; an unknown one has no cells.
    Named(&'a str),
}

/// All cells of a sheet, row by row, including empty ones.
///
/// # Errors
/// What is wrong with the workbook, as a sentence about it.
pub fn rows_of(bytes: Vec<u8>, sheet: Sheet<'_>) -> Result<Vec<Vec<String>>, String> {
    check_parts(&bytes)?;
    Ok(rows(&cells(&mut opened(bytes)?, sheet, &mut 0)?.0))
}

/// The most rows that are read; larger budgets are not expected.
pub const MOST_ROWS: u32 = 10_000;
/// The most columns that are read.
pub const MOST_COLUMNS: u32 = 256;

fn rows(cells: &Cells) -> Vec<Vec<String>> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (row, cells) in cells.range(..MOST_ROWS) {
        rows.resize(*row as usize, Vec::new());
        let mut line: Vec<String> = Vec::new();
        for (column, text) in cells.range(..MOST_COLUMNS) {
            line.resize(*column as usize, String::new());
            line.push(unquoted(text));
        }
        rows.push(line);
    }
    rows
}

/// The first cell beyond those that [`rows`] returns.
fn beyond(cells: &Cells) -> Option<Place> {
    let below = cells
        .range(MOST_ROWS..)
        .next()
        .and_then(|(row, row_cells)| Some((*row, *row_cells.keys().next()?)));
    let mut lines = cells.range(..MOST_ROWS);
    let beside = || {
        lines.find_map(|(row, row_cells)| Some((*row, *row_cells.range(MOST_COLUMNS..).next()?.0)))
    };
    below.or_else(beside)
}

/// A cell's text without the quotes of CSV.
fn unquoted(text: &str) -> String {
    let inside = text.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
    inside.map_or_else(|| text.to_owned(), |text| text.replace("\"\"", "\""))
}

/// A workbook from which several sheets are read.
pub struct Book {
    parts: PartsOf,
    workbook: Xlsx<Cursor<Vec<u8>>>,
    /// Bytes of the texts read so far.
    size: usize,
}

impl fmt::Debug for Book {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Book").field("size", &self.size).finish_non_exhaustive()
    }
}

/// The name of a sheet with cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SheetName {
    /// Its index among all sheets, from 0.
    place: usize,
    /// Its name.
    pub name: String,
    pub(crate) is_hidden: bool,
}

/// The label before the digest of a certificate's file, in the languages of certificates.
const CERTIFICATE_FILE: [&str; 4] = [
    "certificate file, SHA-256",
    "Kalibrierscheindatei, SHA-256",
    "fichier du certificat, SHA-256",
    "file del certificato, SHA-256",
];

impl Book {
    /// # Errors
    /// What is wrong with the workbook, as a sentence about it.
    pub fn open(bytes: Vec<u8>) -> Result<Self, String> {
        check_parts(&bytes)?;
        let parts = PartsOf::of(bytes.clone())?;
        Ok(Self { workbook: opened(bytes)?, parts, size: 0 })
    }

    /// Whether it is the workbook of a certificate of this program: its first sheet names the
    /// source file of the certificate, in the certificate's language.
    pub fn is_certificate(&mut self) -> bool {
        let sheets = self.sheets();
        let [first, _, ..] = sheets.as_slice() else { return false };
        let size = self.size;
        let cells = self.sheet(first).map(|(cells, _)| cells).unwrap_or_default();
        // read again only if it is needed
        self.size = size;
        cells
            .iter()
            .flatten()
            .any(|cell| CERTIFICATE_FILE.iter().any(|text| cell.starts_with(text)))
    }

    /// The sheets with cells, in their order.
    pub fn sheets(&self) -> Vec<SheetName> {
        let all = self.workbook.sheets_metadata().iter().enumerate();
        let with_cells = all.filter(|(_, sheet)| sheet.typ == SheetType::WorkSheet);
        with_cells
            .map(|(place, sheet)| SheetName {
                place,
                name: sheet.name.clone(),
                is_hidden: sheet.visible != SheetVisible::Visible,
            })
            .collect()
    }

    /// All cells of a sheet, row by row, and its layout.
    ///
    /// # Errors
    /// What is wrong with the workbook, as a sentence about it.
    pub fn sheet(&mut self, of: &SheetName) -> Result<(Vec<Vec<String>>, Layout), String> {
        let SheetTable { cells, mut layout } = self.table(of)?;
        layout.beyond = beyond(&cells);
        Ok((rows(&cells), layout))
    }

    /// A sheet as a table.
    ///
    /// # Errors
    /// What is wrong with the workbook, as a sentence about it.
    pub fn table(&mut self, of: &SheetName) -> Result<SheetTable, String> {
        let sheet = Sheet::Named(&of.name);
        let (cells, told) = cells(&mut self.workbook, sheet, &mut self.size)?;
        let Told { struck, texts, dates, last_digits } = told;
        let layout = Layout::of(&mut self.parts, of.place);
        Ok(SheetTable { cells, layout: Layout { struck, texts, dates, last_digits, ..layout } })
    }
}

/// The name of a cell, such as `D2`.
pub fn reference((row, column): Place) -> String {
    format!("{}{}", letters(column), row + 1)
}

fn is_none(error: impl fmt::Display) -> String {
    format!("it is not a workbook: {error}")
}

/// Unpacks every part once to check its size and that its cells lie within a sheet.
fn check_parts(bytes: &[u8]) -> Result<(), String> {
    // the entries of the list of parts, counted before memory is allocated for them
    let parts = bytes.windows(4).filter(|window| window == b"PK\x01\x02").count();
    if parts > MOST_PARTS {
        return Err(format!(
            "its archive has {parts} parts; this version reads at most {MOST_PARTS}"
        ));
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(is_none)?;
    let mut all = 0;
    for number in 0..archive.len() {
        let part = archive.by_index(number).map_err(is_none)?;
        let name = part.name().map_err(is_none)?.into_owned();
        let mut content = Vec::new();
        part.take(MOST_OF_PART + 1).read_to_end(&mut content).map_err(is_none)?;
        all += content.len() as u64;
        let (what, found, most) = match content.len() as u64 {
            size if size > MOST_OF_PART => (format!("its part `{name}`"), size, MOST_OF_PART),
            _ => ("the workbook".to_owned(), all, MOST_OF_ALL),
        };
        if found > most {
            let most = most / 1_000_000;
            return Err(format!(
                "{what} unpacks to more than {most} MB, the most that this version reads"
            ));
        }
        // other parts are pictures and printer settings
        if let Ok(text) = std::str::from_utf8(&content)
            && text.contains("sheetData")
        {
            check_references(text).map_err(|reason| format!("its part `{name}` {reason}"))?;
        }
        if let Ok(text) = std::str::from_utf8(&content)
            && let Err(excess) = xml_limits::check(text)
        {
            return Err(format!("its part `{name}`, byte {}: {}", excess.at, excess.reason));
        }
    }
    Ok(())
}

/// Whether all cells, rows and ranges of a sheet's XML have references that a sheet can have.
fn check_references(text: &str) -> Result<(), String> {
    let mut xml = quick_xml::Reader::from_str(text);
    loop {
        // invalid XML is reported by the reader of the cells
        let element = match xml.read_event() {
            Ok(Event::Start(element) | Event::Empty(element)) => element,
            Ok(Event::Eof) | Err(_) => return Ok(()),
            Ok(_) => continue,
        };
        let name = element.local_name();
        let right = match name.as_ref() {
            "c" => attribute(&element, "r").is_none_or(|r| is_cell(&r)),
            "row" => attribute(&element, "r").is_none_or(|r| is_row(&r)),
            "dimension" => attribute(&element, "ref")
                .is_none_or(|range| range.splitn(2, ':').all(is_cell) && is_ordered(&range)),
            _ => true,
        };
        if !right {
            let found = attribute(&element, "r").or_else(|| attribute(&element, "ref"));
            let found: String = found.unwrap_or_default().chars().take(40).collect();
            return Err(format!(
                "has a cell at `{found}`, which no sheet has: cells are A1 to XFD1048576"
            ));
        }
    }
}

fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    Some(element.try_get_attribute(name).ok()??.value.into_owned())
}

/// Whether a text is a row number of a sheet, `1` to `1048576`.
fn is_row(text: &str) -> bool {
    text.parse().is_ok_and(|row: u32| (1..=ROWS).contains(&row))
        && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Whether a text is a cell reference of a sheet, `A1` to `XFD1048576`.
fn is_cell(text: &str) -> bool {
    place(text).is_some()
}

/// Column and row of a cell reference, both from 1.
fn place(text: &str) -> Option<(u32, u32)> {
    let (letters, row) = text.split_at_checked(text.find(|c: char| c.is_ascii_digit())?)?;
    let digit = |column: u32, letter: u8| {
        let letter = letter.to_ascii_uppercase();
        let value = letter.is_ascii_uppercase().then(|| u32::from(letter - b'A') + 1)?;
        column.checked_mul(26)?.checked_add(value)
    };
    let column = letters.bytes().try_fold(0, digit)?;
    let is_right = is_row(row) && (1..=COLUMNS).contains(&column);
    is_right.then_some(())?;
    Some((column, row.parse().ok()?))
}

/// Whether a range's last cell is not before its first.
fn is_ordered(range: &str) -> bool {
    let Some((first, last)) = range.split_once(':') else { return true };
    place(first).zip(place(last)).is_some_and(|((a, b), (c, d))| a <= c && b <= d)
}

/// The name of a column counted from 0.
pub fn letters(column: u32) -> String {
    let mut rest = column + 1;
    let mut name = String::new();
    while rest > 0 {
        rest -= 1;
        name.insert(0, char::from(b'A' + (rest % 26) as u8));
        rest /= 26;
    }
    name
}

/// How cells of a style display their numbers.
fn shown(style: &Style) -> NumberFormat {
    let format = style.number_format.as_ref();
    format.map(|format| NumberFormat::of(&format.format_code)).unwrap_or_default()
}

fn opened(bytes: Vec<u8>) -> Result<Xlsx<Cursor<Vec<u8>>>, String> {
    Xlsx::new(Cursor::new(bytes)).map_err(is_none)
}

/// What the cells of a sheet tell besides their values.
#[derive(Default)]
struct Told {
    /// Cells that are struck through.
    struck: BTreeSet<Place>,
    /// Cells with texts.
    texts: BTreeSet<Place>,
    /// Cells that display a date or a time.
    dates: BTreeMap<Place, String>,
    /// The powers of ten of the last displayed digits.
    last_digits: BTreeMap<Place, i32>,
}

/// The cells of a sheet, and what they tell besides their values; `size` counts the bytes of their
/// texts.
fn cells(
    workbook: &mut Xlsx<Cursor<Vec<u8>>>,
    sheet: Sheet<'_>,
    size: &mut usize,
) -> Result<(Cells, Told), String> {
    let names = workbook.sheet_names();
    let sheet = match sheet {
        Sheet::Last => names.last().cloned(),
        Sheet::Named(name) if !names.iter().any(|known| known == name) => {
            return Ok(Default::default());
        }
        Sheet::Named(name) => Some(name.to_owned()),
    };
    let sheet = sheet.ok_or_else(|| "the workbook has no sheet".to_owned())?;
    let mut reader = workbook.worksheet_cells_reader(&sheet).map_err(is_none)?;
    let formats: Vec<NumberFormat> = reader.styles().iter().map(shown).collect();
    let plain = NumberFormat::default();
    let code =
        |style: &Style| style.number_format.as_ref().map(|format| format.format_code.clone());
    let codes: Vec<Option<_>> = reader.styles().iter().map(code).collect();
    let is_struck = |style: &Style| style.font.as_ref().is_some_and(|font| font.strikethrough);
    let struck_styles: Vec<bool> = reader.styles().iter().map(is_struck).collect();
    let (mut cells, mut told) = (Cells::new(), Told::default());
    while let Some((cell, style)) = reader.next_cell_with_style_id().map_err(is_none)? {
        let ((row, column), value) = (cell.get_position(), cell.get_value());
        if row >= ROWS || column >= COLUMNS {
            return Err(is_none("it has a cell outside of the sheet"));
        }
        let value = match value {
            DataRef::Empty => continue,
            DataRef::SharedString(text) => Data::String((*text).to_owned()),
            other => Data::from(other.clone()),
        };
        let format = formats.get(style).unwrap_or(&plain);
        let is_text = matches!(value, Data::String(_));
        let number = match value {
            Data::Float(value) => Some(value),
            Data::Int(value) => Some(value as f64),
            _ => None,
        };
        if let Some(value) = number
            && let Some(Some(code)) = codes.get(style)
            && format.shows_digits_of(value)
            && let Some(last) = last_digit(code, value)
        {
            told.last_digits.insert((row, column), last);
        }
        let date = date::shown(&value);
        if let Some(shown) = &date {
            told.dates.insert((row, column), shown.clone());
        }
        let text = match value {
            _ if date.is_some() => date.unwrap_or_default(),
            Data::Float(value) => quoted(format.text(value)),
            Data::Int(value) if !format.is_plain() => quoted(format.text(value as f64)),
            Data::String(text) => quoted(text),
            other => other.to_string(),
        };
        if text.trim().is_empty() {
            continue;
        }
        if struck_styles.get(style).is_some_and(|is_struck| *is_struck) {
            told.struck.insert((row, column));
        }
        if is_text {
            told.texts.insert((row, column));
        }
        *size += text.len() + 1;
        if *size > MOST_OF_TEXT {
            let most = MOST_OF_TEXT / 1_000_000;
            return Err(format!(
                "its cells hold more than {most} MB of text, the most that this version reads"
            ));
        }
        cells.entry(row).or_default().insert(column, text);
    }
    Ok((cells, told))
}

/// A cell's text with the quotes that CSV needs; each row of the sheet becomes one line.
fn quoted(text: String) -> String {
    if text.contains([',', ';', '"', '\n', '\r', '#']) {
        format!("\"{}\"", text.replace('"', "\"\"").replace(['\n', '\r'], " "))
    } else {
        text
    }
}

fn is_comment(row: &BTreeMap<u32, String>) -> bool {
    row.first_key_value().is_some_and(|(_, text)| text.trim_start_matches('"').starts_with('#'))
}

/// The first row that is not a comment.
fn header(cells: &Cells) -> Option<&BTreeMap<u32, String>> {
    cells.values().find(|row| !is_comment(row))
}

/// The table's text. Its columns are those of the first row that is not a comment; a cell outside
/// them is an error, for example after a stray keystroke.
fn csv(cells: &Cells) -> Result<String, String> {
    let ends =
        header(cells).and_then(|header| Some([*header.keys().next()?, *header.keys().last()?]));
    let Some([first, last]) = ends else { return Ok(String::new()) };
    let mut text = String::new();
    let mut line = 0;
    for (&row, held) in cells {
        text.extend(std::iter::repeat_n('\n', (row - line) as usize));
        line = row;
        if is_comment(held) {
            // skipped, like a comment line of a text
            text.push('#');
            continue;
        }
        if let Some((&column, value)) = held.iter().find(|(c, _)| !(first..=last).contains(*c)) {
            let value: String = value.chars().take(40).collect();
            return Err(format!(
                "its cell {}{} holds `{value}`, but the columns of the table are {} to {}; clear \
                 the cell, or give its column a name",
                letters(column),
                row + 1,
                letters(first),
                letters(last)
            ));
        }
        let columns = (first..=last).map(|column| held.get(&column).map_or("", String::as_str));
        text.push_str(&columns.collect::<Vec<_>>().join(","));
    }
    text.push('\n');
    Ok(text)
}

#[cfg(test)]
mod tests {
    mod one_sheet;
    mod written;

    use std::io::Write;

    use super::*;
    use one_sheet::workbook;
    use written::{PARTS, sheets};

    fn first_sheet(bytes: Vec<u8>) -> Result<String, String> {
        let mut book = Book::open(bytes)?;
        let sheet = book.sheets().remove(0);
        Ok(book.table(&sheet)?.text()?.0)
    }

    fn of(sheet: &str) -> Result<String, String> {
        first_sheet(workbook(|out| out.write_all(sheet.as_bytes()), |_| Ok(())))
    }

    const TABLE: &str = r#"<row r="2"><c r="B2" t="inlineStr"><is><t>label</t></is></c><c r="C2" t="inlineStr"><is><t>x</t></is></c></row><row r="4"><c r="B4" t="inlineStr"><is><t>a, b</t></is></c><c r="C4"><v>1.5</v></c></row>"#;

    #[test]
    fn rows_are_lines_and_columns_those_of_the_header() {
        assert_eq!(of(TABLE).unwrap(), "\nlabel,x\n\n\"a, b\",1.5\n");
        let comment = r##"<row r="1"><c r="A1" t="inlineStr"><is><t># note, with a comma</t></is></c></row>"##;
        assert_eq!(of(&format!("{comment}{TABLE}")).unwrap(), "#\nlabel,x\n\n\"a, b\",1.5\n");
        assert_eq!(of("").unwrap(), "");
    }

    /// A sheet of 2^34 cells would take 512 GiB as a rectangle.
    #[test]
    fn a_stray_cell_far_away_is_named() {
        let stray = r#"<row r="1048576"><c r="XFD1048576"><v>7</v></c></row>"#;
        let said = of(&format!("{TABLE}{stray}")).unwrap_err();
        let expected = "its cell XFD1048576 holds `7`, but the columns of the table are B to C; clear \
                        the cell, or give its column a name";
        assert_eq!(said, expected);
        // an empty one is nothing
        let empty = r#"<row r="1048576"><c r="XFD1048576" s="1"/></row>"#;
        assert_eq!(of(&format!("{TABLE}{empty}")), of(TABLE));
    }

    #[test]
    fn references_that_no_sheet_has_are_mistakes() {
        for wrong in [
            "ZZZZZZZZ99999999999",
            "XFE1",
            "A1048577",
            "A0",
            "A",
            "1",
            "",
            "A1B",
            "Ä1",
            "A4294967297",
        ] {
            let said = of(&format!("{TABLE}<row r=\"9\"><c r=\"{wrong}\"><v>7</v></c></row>"));
            let said = said.unwrap_err();
            assert!(said.contains(&format!("has a cell at `{wrong}`")), "{said}");
        }
        for wrong in ["0", "1048577", "4294967297", "-1", "x"] {
            assert!(of(&format!("<row r=\"{wrong}\"/>")).is_err(), "{wrong}");
        }
        assert_eq!(letters(0), "A");
        assert_eq!([letters(25), letters(26), letters(16383)], ["Z", "AA", "XFD"]);
    }

    /// A few megabytes of archive that unpack to gigabytes.
    #[test]
    fn parts_are_unpacked_within_a_limit() {
        let many = |piece: &'static str, times: usize| {
            move |out: &mut dyn Write| {
                let million = piece.repeat(1 + 1_000_000 / piece.len());
                (0..times).try_for_each(|_| out.write_all(million.as_bytes()))
            }
        };
        let no = |_: &mut dyn Write| Ok(());
        let cases = [
            workbook(many(" ", 25), no),
            workbook(many("<c/>", 25), no),
            workbook(many("<row/>", 25), no),
            workbook(no, many("<si><t>A</t></si>", 25)),
            workbook(no, many("A", 25)),
        ];
        for bytes in cases {
            assert!(bytes.len() < 200_000);
            let said = first_sheet(bytes).unwrap_err();
            assert!(said.contains("unpacks to more than 20 MB"), "{said}");
        }
        // a text that is stored once and used in many cells
        let sheet = "<c t=\"s\"><v>0</v></c>".repeat(100);
        let string = format!("<si><t>{}</t></si>", "A".repeat(1_000_000));
        let bytes =
            workbook(|out| out.write_all(sheet.as_bytes()), |out| out.write_all(string.as_bytes()));
        let said = first_sheet(bytes).unwrap_err();
        assert!(said.contains("hold more than 20 MB of text"), "{said}");
    }

    /// A part that many sheets name would be read for each of them, and a parser compares the
    /// attributes of an element pairwise.
    #[test]
    fn sheets_and_attributes_have_limits() {
        let rows: &[&[&str]] = &[&["a", "1"]];
        let names: Vec<String> = (0..257).map(|number| format!("s{number}")).collect();
        let all: Vec<(&str, bool, &[&[&str]])> =
            names.iter().map(|name| (name.as_str(), false, rows)).collect();
        assert_eq!(Book::open(sheets(&all[..256])).unwrap().sheets().len(), 256);
        let said = Book::open(sheets(&all)).err().unwrap();
        assert_eq!(said, "it has 257 sheets; this version reads at most 256");
        let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
        for (name, text) in PARTS {
            let sheet = r#"<sheet name="a" sheetId="1" r:id="r1"/>"#;
            let twice = format!("{sheet}{}", sheet.replace("\"a\"", "\"b\""));
            zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
            zip.write_all(text.replace(sheet, &twice).as_bytes()).unwrap();
        }
        let said = Book::open(zip.finish().unwrap().into_inner()).err().unwrap();
        assert!(
            said.contains("sheets 1 and 2 are both the part `xl/worksheets/sheet1.xml`"),
            "{said}"
        );
        let attributes: String = (0..20_000).map(|n| format!(" a{n}=\"1\"")).collect();
        let said = of(&format!("<row{attributes}/>")).unwrap_err();
        assert!(said.contains("20000 attributes at one element here"), "{said}");
        assert!(said.starts_with("its part `xl/worksheets/sheet1.xml`, byte "), "{said}");
    }

    #[test]
    fn what_is_no_workbook_is_refused() {
        for bytes in
            [&b""[..], b"PK", b"label,x", b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"]
        {
            assert!(first_sheet(bytes.to_vec()).unwrap_err().contains("it is not a workbook"));
        }
        let said = first_sheet(b"PK\x01\x02".repeat(10_001)).unwrap_err();
        assert!(said.contains("10001 parts"), "{said}");
    }
}
