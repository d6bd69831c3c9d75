//! Separators between the cells of a text, and the decimal marks of its numbers.

use std::borrow::Cow;

/// The separator between the cells of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
}

impl Separator {
    /// The separator of a header line.
    pub fn of_header(header: &str) -> Self {
        if header.contains(';') {
            Self::Semicolon
        } else if header.contains('\t') && !header.contains(',') {
            Self::Tab
        } else {
            Self::Comma
        }
    }

    /// The separator of a line that may hold numbers, possibly with decimal commas between tabs.
    pub fn of_line(line: &str) -> Self {
        match (line.contains(';'), line.contains('\t')) {
            (true, _) => Self::Semicolon,
            (false, true) => Self::Tab,
            (false, false) => Self::Comma,
        }
    }

    /// The sign itself.
    pub const fn sign(self) -> char {
        match self {
            Self::Comma => ',',
            Self::Semicolon => ';',
            Self::Tab => '\t',
        }
    }

    /// The separator as a byte.
    pub const fn byte(self) -> u8 {
        self.sign() as u8
    }

    /// The cells of a line, without surrounding blanks.
    ///
    /// # Errors
    /// Why the line cannot be read, as a sentence.
    pub fn cells(self, line: &str) -> Result<Vec<String>, String> {
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(self.byte())
            .trim(csv::Trim::All)
            .has_headers(false)
            .from_reader(line.as_bytes());
        match reader.records().next() {
            Some(Ok(record)) => Ok(record.iter().map(str::to_owned).collect()),
            Some(Err(error)) => Err(error.to_string()),
            None => Ok(Vec::new()),
        }
    }
}

/// Whether a line is not a record: empty, a comment, or the separator announced by a spreadsheet
/// (`sep=;`).
pub fn is_skipped(line: &str) -> bool {
    let line = line.trim();
    let announced = line.get(..4).is_some_and(|begin| begin.eq_ignore_ascii_case("sep="));
    line.is_empty() || line.starts_with('#') || (announced && line.chars().count() <= 5)
}

/// The decimal marks of the numbers of one text: a point everywhere, or a comma everywhere if
/// commas do not separate cells. In `1.234;1` and `2,5;2` the first number may be 1234.
#[derive(Clone, Debug)]
pub struct DecimalMarks {
    separator: Separator,
    point: Option<String>,
    comma: Option<String>,
}

impl DecimalMarks {
    /// The marks of a text whose numbers have not been seen yet.
    pub const fn of(separator: Separator) -> Self {
        Self { separator, point: None, comma: None }
    }

    /// The text of a number with a decimal point, and with a hyphen instead of a typographic minus
    /// sign.
    ///
    /// # Errors
    /// The text has numbers with both marks.
    pub fn with_point<'c>(&mut self, cell: &'c str) -> Result<Cow<'c, str>, String> {
        if let Some(rest) = cell.strip_prefix('−') {
            return self.with_point(rest).map(|rest| Cow::Owned(format!("-{rest}")));
        }
        if self.separator == Separator::Comma {
            return Ok(Cow::Borrowed(cell));
        }
        let (point, comma) = (cell.contains('.'), cell.contains(','));
        if point && self.point.is_none() {
            self.point = Some(cell.to_owned());
        }
        if comma && self.comma.is_none() {
            self.comma = Some(cell.to_owned());
        }
        match (&self.point, &self.comma) {
            (Some(with_point), Some(with_comma)) => Err(format!(
                "`{with_point}` has a decimal point and `{with_comma}` a decimal comma in one table, so \
                 that the one or the other may group thousands; write all numbers with the same \
                 decimal mark"
            )),
            _ if comma => Ok(Cow::Owned(cell.replace(',', "."))),
            _ => Ok(Cow::Borrowed(cell)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_mark_in_all_numbers() {
        let read = |separator, cells: &[&str]| -> Result<Vec<String>, String> {
            let mut marks = DecimalMarks::of(separator);
            cells.iter().map(|cell| marks.with_point(cell).map(Cow::into_owned)).collect()
        };
        assert_eq!(read(Separator::Semicolon, &["1,5", "2", "1e3"]).unwrap(), ["1.5", "2", "1e3"]);
        assert_eq!(read(Separator::Tab, &["1.5", "2"]).unwrap(), ["1.5", "2"]);
        for cells in [["1.234", "2,5"], ["2,5", "1.234"], ["1.234,5", "2"]] {
            assert!(read(Separator::Semicolon, &cells).unwrap_err().contains("decimal mark"));
        }
        assert_eq!(read(Separator::Comma, &["1.5", "−5"]).unwrap(), ["1.5", "-5"]);
        assert_eq!(read(Separator::Tab, &["−1,5"]).unwrap(), ["-1.5"]);
    }

    #[test]
    fn headers_and_lines_that_are_none() {
        assert_eq!(Separator::of_header("a;b"), Separator::Semicolon);
        assert_eq!(Separator::of_header("a\tb"), Separator::Tab);
        assert_eq!(Separator::of_header("a,\tb"), Separator::Comma);
        assert_eq!(Separator::of_header("a"), Separator::Comma);
        assert!(["", " # x", "sep=;", "SEP=\t"].iter().all(|line| is_skipped(line)));
        assert!(!is_skipped("sep=value;b"));
    }
}
