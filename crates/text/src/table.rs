//! Tables of numbers from CSV files and from lists in a file, with the position of every cell.

use std::ops::Range;
use std::sync::Arc;

use super::date::Day;
use super::diagnostics::Collector;
use super::folder::Folder;
use super::json::{Json, Member, Node};
use super::object::Object;
use super::source::{Place, SourceText};
use super::value_text::power_of_last_digit;
use super::{DiagnosticKind, bytes, column_heading};
use gumption_columns::separator::{DecimalMarks, Separator, is_skipped};
use gumption_units::nearest;

/// Maximum number of columns and of rows.
const MOST_COLUMNS: usize = 10_000;
const MOST_ROWS: usize = 1_000_000;

/// Maximum number of faulty cells; more than messages list.
const MOST_FAULTS: usize = 2000;

/// A table: column names and rows of numbers.
#[derive(Clone, Debug)]
pub struct Table {
    /// What messages call it.
    pub name: String,
    /// The text that holds the table.
    pub source: Arc<SourceText>,
    /// The names in the header.
    pub columns: Vec<String>,
    /// The values by row; NaN in columns that were not wanted.
    pub rows: Vec<Vec<f64>>,
    /// For each column the power of ten of the last written digit of any of its numbers; `None` for
    /// a column that was not wanted.
    pub last_digits: Vec<Option<i32>>,
    /// Whether each column has dates, of which the values are numbers of days.
    pub are_days: Vec<bool>,
    places: Places,
}

/// Where the cells of a table are in the text that holds it.
#[derive(Clone, Debug)]
enum Places {
    /// Each row is a line, its cells between separators.
    Lines(Vec<Range<usize>>, Separator),
    /// Each column is a list; the position of each cell, by column.
    Lists(Vec<Vec<Range<usize>>>),
}

impl Table {
    /// The column with this name: an exact header first, otherwise the only header that is this
    /// name with a unit, `f [Hz]` for `f`.
    pub fn column(&self, name: &str) -> Option<usize> {
        column_heading::place_of(&self.columns, name)
    }

    /// The message that there is no column of this name.
    pub fn no_column(&self, name: &str) -> String {
        let of_name = |column: &&String| column_heading::bare(column) == name;
        let alike: Vec<String> =
            self.columns.iter().filter(of_name).map(|column| format!("`{column}`")).collect();
        if alike.len() > 1 {
            return format!(
                "`{}` has more than one column `{name}`: {}; write the full header of one, with \
                 its unit",
                self.name,
                gumption_units::listed(&alike, " and ")
            );
        }
        let near = nearest(name, self.columns.iter().map(String::as_str));
        let hint = match near {
            Some(near) => format!("; did you mean `{near}`?"),
            None => format!("; its columns are {}", self.columns.join(", ")),
        };
        format!("`{}` has no column `{name}`{hint}", self.name)
    }

    /// The place of a cell.
    pub fn place(&self, row: usize, column: usize) -> Place {
        let source = self.source.clone();
        match &self.places {
            Places::Lines(lines, separator) => {
                let span = lines.get(row).cloned().unwrap_or(0..0);
                place_of_cell(&Place { source, span }, column, *separator)
            }
            Places::Lists(lists) => {
                let span = lists.get(column).and_then(|cells| cells.get(row)).cloned();
                Place { source, span: span.unwrap_or(0..0) }
            }
        }
    }
}

/// All errors of a table, with their positions.
type PlacedKinds = Vec<(Place, DiagnosticKind)>;

/// Reads the table `name` in `folder` and reports its errors. A file that cannot be read is
/// reported at `named`, where the model file names it. Only the `wanted` columns, or all if the
/// list is empty, must contain numbers; others may hold times or remarks. The content of the file
/// is returned too.
pub fn read(
    log: &Collector,
    folder: Folder<'_>,
    name: &str,
    named: &Range<usize>,
    wanted: Option<&[&str]>,
) -> Option<(Table, Vec<u8>)> {
    read_dated(log, folder, name, named, wanted, None)
}

/// As [`read`], with columns that may have dates ([`Table::are_days`]): they become numbers of days
/// since `origin`.
pub fn read_dated(
    log: &Collector,
    folder: Folder<'_>,
    name: &str,
    named: &Range<usize>,
    wanted: Option<&[&str]>,
    origin: Option<Day>,
) -> Option<(Table, Vec<u8>)> {
    let bytes = match folder.content(name, bytes::MOST) {
        Ok(bytes) => bytes,
        Err(kind) => {
            log.report(named, kind);
            return None;
        }
    };
    let kinds = match read_bytes(bytes, &folder.shown(name), wanted, origin) {
        Ok(read) => return Some(read),
        Err(kinds) => kinds,
    };
    for (place, diagnostic) in kinds {
        match diagnostic {
            DiagnosticKind::Unreadable { message } => {
                let message = format!("`{name}`: {message}");
                log.report(named, DiagnosticKind::Unreadable { message });
            }
            diagnostic => log.report_at(place, diagnostic),
        }
    }
    None
}

/// Reads a table: a header row of names, cells between `,`, `;` or tabs (with `;` and tabs decimal
/// commas are allowed). Lines that begin with `#` are skipped. All faulty cells are returned.
fn read_bytes(
    bytes: Vec<u8>,
    name: &str,
    wanted: Option<&[&str]>,
    origin: Option<Day>,
) -> Result<(Table, Vec<u8>), PlacedKinds> {
    let unreadable = |message: String| {
        let place = Place { source: SourceText::new(name, ""), span: 0..0 };
        vec![(place, DiagnosticKind::Unreadable { message })]
    };
    let text = bytes::text(&bytes).map_err(unreadable)?;
    let source = SourceText::new(name, &text);
    drop(text);
    match parse_dated(&source, wanted, origin) {
        Ok(table) => Ok((table, bytes)),
        // the content may be anything, and is not quoted
        Err(_) if !has_numbers(&source.text) => {
            let message = "it is not a table of numbers: there is no number below its first line";
            Err(unreadable(message.to_owned()))
        }
        Err(kinds) => Err(kinds),
    }
}

/// Whether some cell below the first line is a number; an empty file has nothing to hide.
fn has_numbers(text: &str) -> bool {
    let mut lines = text.lines().filter(|line| !is_skipped(line));
    let number = |cell: &str| {
        let cell = cell.trim().trim_matches('"');
        cell.parse::<f64>().is_ok() || cell.replace(',', ".").parse::<f64>().is_ok()
    };
    match lines.next() {
        None => true,
        Some(_) => lines.any(|line| line.split([',', ';', '\t']).any(number)),
    }
}

/// Parses a table. Cells of columns that are not `wanted` need not be numbers; without a list all
/// columns are wanted.
///
/// # Errors
/// All errors, each with its position.
pub fn parse(source: &Arc<SourceText>, wanted: Option<&[&str]>) -> Result<Table, PlacedKinds> {
    parse_dated(source, wanted, None)
}

fn parse_dated(
    source: &Arc<SourceText>,
    wanted: Option<&[&str]>,
    origin: Option<Day>,
) -> Result<Table, PlacedKinds> {
    let starts: Vec<usize> = std::iter::once(0)
        .chain(source.text.match_indices('\n').map(|(newline, _)| newline + 1))
        .collect();
    let at_line = |line: usize| {
        let start = starts.get(line.saturating_sub(1)).copied().unwrap_or(source.text.len());
        let text = source.text.get(start..).and_then(|rest| rest.lines().next()).unwrap_or("");
        Place { source: source.clone(), span: start..start + text.len() }
    };
    // comments and blank lines become empty lines, which count but are not records
    let mut text = String::with_capacity(source.text.len() + 1);
    let mut header = None;
    for (number, line) in source.text.lines().enumerate() {
        // trailing empty cells of a line with tabs are cells
        let line = if is_skipped(line) { "" } else { line.trim_end_matches(['\r', ' ']) };
        if header.is_none() && !line.is_empty() {
            header = Some((number + 1, line));
        }
        text.push_str(line);
        text.push('\n');
    }
    let Some((header_line, header)) = header else {
        let reason = "the table is empty; a header row of names and rows of numbers are needed";
        return Err(vec![(at_line(1), DiagnosticKind::Table { reason: reason.to_owned() })]);
    };
    let separator = Separator::of_header(header);
    let mut marks = DecimalMarks::of(separator);
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator.byte())
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(text.as_bytes());
    let columns: Vec<String> = match reader.headers() {
        Ok(header) => header.iter().map(str::to_owned).collect(),
        Err(error) => {
            return Err(vec![(
                at_line(header_line),
                DiagnosticKind::Table { reason: error.to_string() },
            )]);
        }
    };
    let too_many = |what, found, most| {
        (found > most)
            .then(|| vec![(at_line(header_line), DiagnosticKind::TooMany { what, found, most })])
    };
    let lines = text.lines().filter(|line| !line.is_empty()).count();
    let too_many = too_many("columns of a table", columns.len(), MOST_COLUMNS)
        .or_else(|| too_many("rows of a table", lines - 1, MOST_ROWS));
    if let Some(kinds) = too_many {
        return Err(kinds);
    }
    let is_wanted: Vec<bool> = match wanted {
        None => vec![true; columns.len()],
        Some(names) => {
            let places = names.iter().filter_map(|name| column_heading::place_of(&columns, name));
            let places: Vec<usize> = places.collect();
            (0..columns.len()).map(|place| places.contains(&place)).collect()
        }
    };
    let mut kinds = Vec::new();
    for (number, name) in columns.iter().enumerate().filter(|(number, _)| is_wanted[*number]) {
        let reason = if name.is_empty() {
            format!("column {} has no name in the header", number + 1)
        } else if columns.iter().position(|column| column == name) == Some(number)
            && columns.iter().skip(number + 1).any(|column| column == name)
        {
            format!("the header has the name `{name}` twice")
        } else {
            continue;
        };
        kinds.push((at_line(header_line), DiagnosticKind::Table { reason }));
    }
    let mut rows = Vec::new();
    let mut last_digits: Vec<Option<i32>> = vec![None; columns.len()];
    let mut lines = Vec::new();
    let mut are_days = vec![false; columns.len()];
    for (number, record) in reader.records().enumerate() {
        if kinds.len() >= MOST_FAULTS {
            break;
        }
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                kinds.push((
                    at_line(number + 2),
                    DiagnosticKind::Table { reason: error.to_string() },
                ));
                break;
            }
        };
        let mut line = record.position().map_or(number + 2, |p| p.line() as usize);
        let mut place = at_line(line);
        // the reader's position was before the comments and empty lines that it skipped
        while line < starts.len()
            && is_skipped(source.text.get(place.span.clone()).unwrap_or_default())
        {
            line += 1;
            place = at_line(line);
        }
        if record.len() != columns.len() {
            let diagnostic = DiagnosticKind::ShortRow {
                row: number + 1,
                found: record.len(),
                expected: columns.len(),
            };
            kinds.push((place, diagnostic));
            continue;
        }
        let mut row = Vec::with_capacity(columns.len());
        for (number_of_cell, (cell, column)) in record.iter().zip(&columns).enumerate() {
            if !is_wanted[number_of_cell] {
                row.push(f64::NAN);
                continue;
            }
            if let (Some(origin), Some(day)) = (origin, Day::parse(cell)) {
                let is_first = rows.is_empty();
                if is_first || are_days[number_of_cell] {
                    are_days[number_of_cell] = true;
                    row.push(day.since(origin));
                    continue;
                }
            }
            let read = marks.with_point(cell).map(|text| (text.parse::<f64>(), text));
            let diagnostic = match read {
                Ok((Ok(value), text)) if value.is_finite() && !are_days[number_of_cell] => {
                    let last = power_of_last_digit(&text);
                    let finest = &mut last_digits[number_of_cell];
                    *finest = Some(finest.map_or(last, |known| known.min(last)));
                    row.push(value);
                    continue;
                }
                Ok(_) => {
                    let (column, found) = (column.clone(), cell.to_owned());
                    DiagnosticKind::Cell { row: number + 1, column, found }
                }
                // the same message would apply to every number after it
                Err(reason) => {
                    let place = place_of_cell(&place, number_of_cell, separator);
                    return Err(vec![(place, DiagnosticKind::Table { reason })]);
                }
            };
            kinds.push((place_of_cell(&place, number_of_cell, separator), diagnostic));
        }
        rows.push(row);
        lines.push(place.span);
    }
    if rows.is_empty() && kinds.is_empty() {
        let reason = "the table has a header but no rows".to_owned();
        kinds.push((at_line(header_line), DiagnosticKind::Table { reason }));
    }
    if kinds.is_empty() {
        let (name, source) = (source.name.clone(), source.clone());
        let places = Places::Lines(lines, separator);
        Ok(Table { name, source, columns, rows, last_digits, are_days, places })
    } else {
        Err(kinds)
    }
}

/// Reads a table whose columns are the members of an object, each a list of numbers, and reports its
/// errors. Messages call it by the key of the object.
pub fn of_lists(log: &Collector, member: &Member, what: &'static str) -> Option<Table> {
    let object = Object::new(log, what, &member.value, &member.key_span)?;
    let too_many = |what, found, most| {
        if found > most {
            object.report(DiagnosticKind::TooMany { what, found, most });
        }
        found > most
    };
    let members = object.members();
    if members.is_empty() {
        object.report(DiagnosticKind::NoValues { name: member.key.clone() });
        return None;
    }
    if too_many("columns of a table", members.len(), MOST_COLUMNS) {
        return None;
    }
    let lists: Option<Vec<&[Node]>> = members.iter().map(|of| object.list(&of.key)).collect();
    let lists = lists?;
    let mut is_right = true;
    let mut of_table = |place: &Range<usize>, reason: String| {
        log.report(place, DiagnosticKind::Table { reason });
        is_right = false;
    };
    let count = lists.first().map_or(0, |list| list.len());
    let columns: Vec<String> = members.iter().map(|of| of.key.trim().to_owned()).collect();
    for (place, (of, list)) in members.iter().zip(&lists).enumerate() {
        let name = &columns[place];
        if name.is_empty() {
            of_table(&of.key_span, "a column has no name".to_owned());
        } else if columns[..place].contains(name) {
            of_table(&of.key_span, format!("two columns have the name `{name}`"));
        } else if list.is_empty() {
            of_table(&of.value.span, format!("the column `{name}` has no values"));
        } else if list.len() != count && count > 0 {
            let (first, found) = (&columns[0], list.len());
            let reason = format!(
                "the column `{name}` has {found} values, but `{first}` has {count}; all columns \
                 have the same number of values"
            );
            of_table(&of.value.span, reason);
        }
    }
    if too_many("rows of a table", count, MOST_ROWS) {
        return None;
    }
    let mut last_digits = Vec::with_capacity(lists.len());
    let mut values: Vec<Vec<f64>> = Vec::with_capacity(lists.len());
    for (name, list) in columns.iter().zip(&lists) {
        let mut finest: Option<i32> = None;
        let mut column = Vec::with_capacity(list.len());
        for (row, node) in list.iter().enumerate() {
            match (&node.value, node.number()) {
                (Json::Number(text), Some(value)) => {
                    let last = power_of_last_digit(text);
                    finest = Some(finest.map_or(last, |known| known.min(last)));
                    column.push(value);
                }
                (other, _) => {
                    let found = match other {
                        Json::Null => String::new(),
                        Json::Text(text) => text.clone(),
                        other => other.kind().to_owned(),
                    };
                    let (row, column) = (row + 1, name.clone());
                    is_right = false;
                    log.report(&node.span, DiagnosticKind::Cell { row, column, found });
                }
            }
        }
        last_digits.push(finest);
        values.push(column);
    }
    if !is_right {
        return None;
    }
    let rows = (0..count).map(|row| values.iter().map(|column| column[row]).collect()).collect();
    let spans = |list: &&[Node]| list.iter().map(|node| node.span.clone()).collect();
    Some(Table {
        name: member.key.clone(),
        source: log.source.clone(),
        columns,
        rows,
        last_digits,
        are_days: vec![false; lists.len()],
        places: Places::Lists(lists.iter().map(spans).collect()),
    })
}

/// The position of a cell in its line, or of the whole line if quotes make that uncertain. An empty
/// cell is shown by an adjacent separator.
pub(crate) fn place_of_cell(line: &Place, number: usize, separator: Separator) -> Place {
    let text = line.source.text.get(line.span.clone()).unwrap_or("");
    let separator = separator.sign();
    if text.contains('"') {
        return line.clone();
    }
    let Some(cell) = text.split(separator).nth(number) else {
        return line.clone();
    };
    let before: usize = text.split(separator).take(number).map(|cell| cell.len() + 1).sum();
    let start = line.span.start + before;
    let blank = cell.len() - cell.trim_start().len();
    let span = if !cell.trim().is_empty() {
        start + blank..start + blank + cell.trim().len()
    } else if before > 0 {
        start - 1..start + cell.len()
    } else {
        start..(start + cell.len() + 1).min(line.span.end)
    };
    Place { source: line.source.clone(), span }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_separators_are_read() {
        let table = parse(&SourceText::new("t", "# note\nf, x\n1,2.5\n"), None).unwrap();
        assert_eq!(
            (table.columns, table.rows),
            (vec!["f".into(), "x".into()], vec![vec![1.0, 2.5]])
        );
        let table = parse(&SourceText::new("t", "\u{feff}f;x\n1;2,5\n# end\n3;4\n"), None).unwrap();
        assert_eq!(table.rows, vec![vec![1.0, 2.5], vec![3.0, 4.0]]);
        // a comment may be the last line, without a line end, and may be indented
        let table = parse(&SourceText::new("t", "f\n  # middle\n\n1\n# end"), None).unwrap();
        assert_eq!(table.rows, vec![vec![1.0]]);
    }

    /// Times, remarks and a column without a name next to the wanted one.
    #[test]
    fn other_columns_need_not_be_numbers() {
        let source = SourceText::new("t", "time,U [V],\n10:00:00,1.01,ok\n10:00:01,1.02,\n");
        assert!(parse(&source, None).is_err());
        let table = parse(&source, Some(&["U"])).unwrap();
        assert_eq!(table.rows.iter().map(|row| row[1]).collect::<Vec<_>>(), vec![1.01, 1.02]);
        assert!(parse(&source, Some(&["U", "time"])).is_err());
    }

    #[test]
    fn faults_name_row_column_and_line() {
        let kinds = parse(&SourceText::new("t", "f,x\n1,\n# c\n2\nz,1\n"), None).unwrap_err();
        let lines: Vec<usize> =
            kinds.iter().map(|(place, _)| place.source.position(place.span.start).0).collect();
        assert_eq!(lines, vec![2, 4, 5]);
        assert_eq!(
            kinds[0].1,
            DiagnosticKind::Cell { row: 1, column: "x".into(), found: String::new() }
        );
        assert_eq!(kinds[1].1, DiagnosticKind::ShortRow { row: 2, found: 1, expected: 2 });
        let places: Vec<&str> =
            kinds.iter().map(|(place, _)| &place.source.text[place.span.clone()]).collect();
        assert_eq!(places, vec![",", "2", "z"]);
        assert!(parse(&SourceText::new("t", ""), None).is_err());
        assert!(parse(&SourceText::new("t", "a,b\n"), None).is_err());
        assert!(parse(&SourceText::new("t", "a,a\n1,2\n"), None).is_err());
    }
}
