//! Frames of a CSV file: cells between `,`, `;` or tabs (with `;` and tabs decimal commas are
//! allowed), with or without a header. Lines that begin with `#` are skipped. Lines of an
//! instrument above the header are skipped with a warning; a line of units below it belongs to the
//! headings. A unit in a heading is compared with the unit in the recipe, whether the recipe names
//! the column by name or by number.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use csv::{ByteRecord, Reader};

use super::preamble::{self, Beginning, MOST_LINES};
use super::stamps::{Stamps, is_stamp};
use super::wide_text::NarrowText;
use super::{BLOCK, ColumnName, Frames, Wanted, place};
use crate::separator::DecimalMarks;
use crate::{ValueOf, gravity, heading};
use gumption_units::{Unit, nearest};

/// Words of instruments and programs for a missing value.
const OF_NO_VALUE: [&str; 12] = [
    "ovld", "ol", "overload", "over", "n/a", "na", "null", "none", "err", "error", "invalid", "--",
];

/// Longer cells are cut in messages.
const LONGEST: usize = 40;

type Whole<R> = io::Chain<Cursor<Vec<u8>>, BufReader<NarrowText<R>>>;

/// Frames of a text.
pub(super) struct CsvFrames<R> {
    reader: Reader<Whole<R>>,
    record: ByteRecord,
    /// Whether `record` holds a frame that has not been returned yet.
    waiting: bool,
    /// The record after it, if it has been read ahead.
    ahead: Option<ByteRecord>,
    marks: DecimalMarks,
    cells: usize,
    /// The index of each wanted column.
    places: Vec<usize>,
    wanted: Vec<Wanted>,
    samples: u64,
    /// Lines before the reader's first.
    skipped: u64,
    beginning: Beginning,
    /// The instants, if they are time stamps.
    stamps: Stamps,
}

/// Bytes of the lines that are examined before the samples are read.
const MOST_BYTES: u64 = 1 << 20;

/// The first lines of a text, as bytes, without a byte-order mark.
fn first_lines(reader: &mut impl BufRead) -> Result<Vec<Vec<u8>>, String> {
    let (mut lines, mut left): (Vec<Vec<u8>>, u64) = (Vec::new(), MOST_BYTES);
    // remarks and blank lines are not counted
    let mut counted = 0;
    while counted < MOST_LINES && left > 0 {
        let mut line = Vec::new();
        let limit = &mut reader.by_ref().take(left);
        let count = limit.read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        if count == 0 {
            break;
        }
        left -= count as u64;
        if lines.is_empty() && line.starts_with(b"\xef\xbb\xbf") {
            line.drain(..3);
        }
        let is_remark = line.starts_with(b"#") || line.trim_ascii().is_empty();
        counted += usize::from(!is_remark);
        lines.push(line);
    }
    Ok(lines)
}

impl<R: Read> CsvFrames<R> {
    pub(super) fn new(reader: R, wanted: Vec<Wanted>) -> Result<Self, String> {
        let text = NarrowText::new(reader).map_err(|error| error.to_string())?;
        let mut reader = BufReader::new(text);
        let lines = first_lines(&mut reader)?;
        let texts: Vec<String> =
            lines.iter().map(|line| String::from_utf8_lossy(line).into_owned()).collect();
        let Some(beginning) = Beginning::of(&texts, &wanted) else {
            return Err("it is empty; a recording has a line for each sample".to_owned());
        };
        if lines.iter().any(|line| line.contains(&0)) {
            return Err("it is not a text; WAV and NumPy files end in `.wav` and `.npy`".to_owned());
        }
        let skipped = beginning.first as u64;
        let separator = beginning.separator;
        let line = lines.get(beginning.first..).unwrap_or(&[]).concat();
        let reader = csv::ReaderBuilder::new()
            .delimiter(separator.byte())
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .buffer_capacity(1 << 18)
            .from_reader(Cursor::new(line).chain(reader));
        let mut frames = Self {
            reader,
            record: ByteRecord::new(),
            waiting: false,
            ahead: None,
            marks: DecimalMarks::of(separator),
            cells: 0,
            places: Vec::new(),
            wanted,
            samples: 0,
            skipped,
            beginning,
            stamps: Stamps::default(),
        };
        frames.begin()?;
        Ok(frames)
    }

    /// Reads the header, or determines that there is none.
    fn begin(&mut self) -> Result<(), String> {
        self.next()?;
        self.cells = self.record.len();
        let header = self.beginning.is_header || self.has_header()?;
        let names: Vec<String> = self
            .record
            .iter()
            .map(|cell| String::from_utf8_lossy(cell.trim_ascii()).into_owned())
            .collect();
        self.waiting = !header;
        if header {
            self.pass_units()?;
        }
        for wanted in &self.wanted {
            let found = match &wanted.column {
                ColumnName::Number(number) if *number <= self.cells => number - 1,
                ColumnName::Number(number) => {
                    return Err(format!("it has {} columns, so no column {number}", self.cells));
                }
                ColumnName::Name(name) if !header => {
                    return Err(format!(
                        "it has no header, so no column `{name}`; give the number of the column, from \
                         1 to {}",
                        self.cells
                    ));
                }
                ColumnName::Name(name) => {
                    if names.iter().filter(|column| *column == name).count() > 1 {
                        return Err(format!("its header has the name `{name}` twice"));
                    }
                    let Some(place) = heading::place_of(&names, name) else {
                        let near = nearest(name, names.iter().map(String::as_str));
                        let hint = match near {
                            Some(near) => format!("did you mean `{near}`?"),
                            None => format!("its columns are {}", names.join(", ")),
                        };
                        return Err(format!("it has no column `{name}`; {hint}"));
                    };
                    place
                }
            };
            if wanted.is_time() && self.beginning.is_without_unit(found) {
                return Err(format!(
                    "its column `{}` counts samples, as the line of units below the header says, and is no \
                     time: leave out `time` and state `sampling_rate`",
                    names.get(found).map_or("", String::as_str)
                ));
            }
            // a clock shows hours, minutes and seconds, whatever its heading says
            let is_clock = || wanted.is_time() && self.ahead_cell(found).is_some_and(is_stamp);
            let contradicted = names.get(found).filter(|_| header && !is_clock());
            let contradicted = contradicted.and_then(|name| {
                contradiction(
                    wanted,
                    &preamble::with_unit(
                        name,
                        self.beginning.unit(found, wanted.is_time()).as_deref(),
                    ),
                )
            });
            if let Some(contradiction) = contradicted {
                return Err(contradiction);
            }
            self.places.push(found);
        }
        Ok(())
    }

    /// Skips the line of units below the header, and examines the first sample: header cells that
    /// do not name a column have no cells below them.
    fn pass_units(&mut self) -> Result<(), String> {
        let header = self.record.clone();
        let mut ahead = ByteRecord::new();
        let mut is_units = self.beginning.units.is_none();
        loop {
            if !self.reader.read_byte_record(&mut ahead).map_err(|error| error.to_string())? {
                return Ok(());
            }
            let is_blank = ahead.iter().all(|cell| cell.trim_ascii().is_empty());
            match (is_blank, is_units) {
                (true, _) if self.beginning.units.is_some() => {}
                (_, true) => break,
                (_, false) => is_units = true,
            }
        }
        let count = ahead.len();
        let is_beside = |cell: &[u8]| {
            let text = String::from_utf8_lossy(cell.trim_ascii()).to_lowercase();
            matches!(text.as_str(), "" | "comment" | "start" | "increment") || text.contains('=')
        };
        let is_empty = |cell: &[u8]| cell.trim_ascii().is_empty();
        let fits = header.iter().skip(count).all(is_beside)
            && ahead.iter().skip(header.len()).all(is_empty);
        if fits {
            self.cells = count;
        }
        self.ahead = Some(ahead);
        Ok(())
    }

    /// The text of a cell of the first sample below the header.
    fn ahead_cell(&self, place: usize) -> Option<&str> {
        std::str::from_utf8(self.ahead.as_ref()?.get(place)?).ok().map(str::trim)
    }

    /// Whether the first record is a header: if columns are wanted by name, or if columns wanted by
    /// number have no numbers in it. Text in other columns may be a state or a date that every line
    /// has.
    fn has_header(&mut self) -> Result<bool, String> {
        let marks = &self.marks;
        let is_clock = |cell: &[u8]| std::str::from_utf8(cell).is_ok_and(is_stamp);
        let is_text = |cell: &[u8]| {
            number(cell, &mut marks.clone()).is_ok_and(|of| of.is_none()) && !is_clock(cell)
        };
        let texts: Vec<bool> = self.record.iter().map(is_text).collect();
        let wanted = self.wanted.iter().filter_map(|wanted| match &wanted.column {
            ColumnName::Number(number) => Some(number - 1),
            ColumnName::Name(_) => None,
        });
        let wanted: Vec<usize> = wanted.filter(|place| *place < texts.len()).collect();
        let has_names = wanted.len() < self.wanted.len();
        if has_names || !texts.contains(&true) {
            return Ok(texts.contains(&true));
        }
        let cell = |place: usize| {
            let cell = self.record.get(place).unwrap_or(b"").trim_ascii();
            String::from_utf8_lossy(cell).chars().take(LONGEST).collect::<String>()
        };
        let is_number = |place: &&usize| !texts[**place];
        let value = wanted.iter().find(is_number);
        let word = wanted.iter().find(|place| !is_number(place));
        // a value with a unit, and a mark for a missing one
        let is_sample = |place: usize| {
            let text = cell(place);
            text.is_empty()
                || OF_NO_VALUE.contains(&text.to_lowercase().as_str())
                || text.trim_start_matches(['-', '+', '\u{2212}', '.']).starts_with(digit)
        };
        // an empty cell among names is a column without a name
        let is_name = |place: &usize| {
            !is_sample(*place) || cell(*place).is_empty() && !texts.contains(&false)
        };
        match (value, word) {
            (None, word) if word.is_none_or(is_name) => return Ok(true),
            (None, _) => {}
            (Some(_), None) => return self.is_above_numbers(&texts),
            (Some(_), Some(_)) => {}
        }
        let word = word.copied().unwrap_or_default();
        Err(format!(
            "line {}: `{}` in column {} is no number, and other cells of the line are values: it is neither \
             a header nor a sample",
            self.line(),
            cell(word),
            word + 1
        ))
    }

    /// Whether a first line with numbers in the wanted columns and texts elsewhere is a header: not
    /// if the second line has texts there too.
    fn is_above_numbers(&mut self, texts: &[bool]) -> Result<bool, String> {
        let mut ahead = ByteRecord::new();
        if !self.reader.read_byte_record(&mut ahead).map_err(|error| error.to_string())? {
            return Ok(false);
        }
        let marks = &self.marks;
        let is_number = |cell: &[u8]| number(cell, &mut marks.clone()).is_ok_and(|of| of.is_some());
        let of_texts = ahead.iter().zip(texts).filter(|(_, text)| **text);
        let is_unlike = of_texts.into_iter().any(|(cell, _)| is_number(cell));
        self.ahead = Some(ahead);
        if is_unlike {
            return Err(format!(
                "line {} has numbers in the columns that are read, and in others text where the next line has \
                 numbers: it can be a header or the first sample; name the columns as the header does, or \
                 leave the line out",
                self.line()
            ));
        }
        Ok(false)
    }

    /// The next record; false at the end.
    fn next(&mut self) -> Result<bool, String> {
        if let Some(ahead) = self.ahead.take() {
            self.record = ahead;
            return Ok(true);
        }
        self.reader.read_byte_record(&mut self.record).map_err(|error| error.to_string())
    }

    fn line(&self) -> u64 {
        self.skipped + self.record.position().map_or(0, csv::Position::line)
    }

    fn frame(&mut self, columns: &mut [Vec<f64>]) -> Result<(), String> {
        self.samples += 1;
        if self.record.len() != self.cells {
            return Err(format!(
                "line {} (sample {}) has {} cells, but the lines before have {}",
                self.line(),
                self.samples,
                self.record.len(),
                self.cells
            ));
        }
        for ((column, at), wanted) in columns.iter_mut().zip(&self.places).zip(&self.wanted) {
            let cell = self.record.get(*at).unwrap_or(b"");
            if wanted.is_time()
                && let Ok(text) = std::str::from_utf8(cell)
                && let Some(seconds) = self
                    .stamps
                    .seconds(text)
                    .map_err(|reason| format!("line {}: {reason}", self.line()))?
            {
                column.push(seconds / wanted.unit.factor());
                continue;
            }
            match number(cell, &mut self.marks).map(|cell| cell.filter(|cell| cell.is_finite())) {
                Ok(Some(value)) => column.push(value),
                Err(reason) => return Err(format!("line {}: {reason}", self.line())),
                Ok(None) => {
                    let (line, place) = (self.line(), place(self.samples, &wanted.channel));
                    let text = String::from_utf8_lossy(cell.trim_ascii()).into_owned();
                    return Err(if text.is_empty() {
                        format!("line {line} ({place}): the cell is empty; a value is missing")
                    } else {
                        let text: String = text.chars().take(LONGEST).collect();
                        format!("line {line} ({place}): `{text}` is not a finite number")
                    });
                }
            }
        }
        Ok(())
    }
}

impl<R: Read> Frames for CsvFrames<R> {
    fn passed_by(&self) -> Option<String> {
        let above = self.beginning.above?;
        let (first, header) = (above + 1, self.beginning.first + 1);
        Some(match header - first {
            1 => format!("line {first} stands above the header in line {header} and is not read"),
            _ => format!(
                "lines {first} to {} stand above the header in line {header} and are not read",
                header - 1
            ),
        })
    }

    fn read(&mut self, columns: &mut [Vec<f64>]) -> Result<(), String> {
        for _ in 0..BLOCK {
            if !self.waiting && !self.next()? {
                break;
            }
            self.waiting = false;
            // a blank line is not a record
            if self.record.len() == 1
                && self.record.get(0).is_some_and(|c| c.trim_ascii().is_empty())
                && self.cells > 1
            {
                continue;
            }
            self.frame(columns)?;
        }
        Ok(())
    }
}

/// The message that the heading of a column has another unit than the one in which its values are
/// read, and what to write.
fn contradiction(wanted: &Wanted, heading: &str) -> Option<String> {
    let of = (&wanted.unit, ValueOf::Quantity);
    let found = heading::contradiction(|text| Unit::parse(text).ok(), heading, of)?;
    let unit = &found.heading;
    let key = if wanted.is_time() { "time_unit" } else { "raw_unit" };
    let Ok(of) = Unit::parse(unit) else { return Some(found.to_string()) };
    let gravity = || gravity::meant(unit, wanted.becomes.dimension());
    let advice = if of.is_compatible(&wanted.unit) {
        format!("; in the recipe this is `\"{key}\": \"{unit}\"`")
    } else if let Some(meant) = gravity() {
        format!("; in the recipe this is `\"{key}\": \"{meant}\"`")
    } else if wanted.is_time() || gravity::meant(wanted.becomes.text(), of.dimension()).is_some() {
        // another unit for this key would be of the wrong dimension
        String::new()
    } else {
        format!(
            "; in the recipe this is `\"{key}\": \"{unit}\"` and a `scale` or a `sensitivity` by \
             which it becomes `{}`",
            wanted.becomes
        )
    };
    Some(format!("{found}{advice}"))
}

fn digit(c: char) -> bool {
    c.is_ascii_digit()
}

/// The number in a cell, if it is one.
fn number(cell: &[u8], marks: &mut DecimalMarks) -> Result<Option<f64>, String> {
    let Ok(text) = std::str::from_utf8(cell) else { return Ok(None) };
    Ok(marks.with_point(text.trim())?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of the first column, by its number.
    fn read(text: &str) -> Result<Vec<f64>, String> {
        let volt = Unit::parse("V").expect("a unit");
        let wanted = Wanted {
            column: ColumnName::Number(1),
            channel: "a".to_owned(),
            unit: volt.clone(),
            becomes: volt,
        };
        let mut frames = CsvFrames::new(text.as_bytes(), vec![wanted])?;
        let mut columns = vec![Vec::new()];
        frames.read(&mut columns)?;
        Ok(columns.remove(0))
    }

    /// Other text in a line of numbers does not make it a header.
    #[test]
    fn a_first_sample_is_no_header() {
        for text in ["1,OK\n2,OK\n", "1,\n2,\n", "1;;\n2;;\n", "1,\n2,3\n", "1\n2\n"] {
            let found = read(text);
            match text {
                // a heading above numbers, or a missing cell
                "1,\n2,3\n" => assert!(found.unwrap_err().contains("a header or the first sample")),
                _ => assert_eq!(found, Ok(vec![1.0, 2.0]), "{text}"),
            }
        }
        for text in ["a,b\n1,OK\n2,OK\n", "a,state\n1,OK\n2,\n", "a\n1\n2\n", "a,1\n1,5\n2,5\n"] {
            assert_eq!(read(text), Ok(vec![1.0, 2.0]), "{text}");
        }
        for (text, cell) in
            [("OVLD,1\n2,1\n", "`OVLD`"), ("1.42 V,x\n2,x\n", "`1.42 V`"), (",1\n2,1\n", "``")]
        {
            let reason = read(text).unwrap_err();
            assert!(reason.contains(cell) && reason.contains("neither a header nor"), "{reason}");
        }
    }
}
