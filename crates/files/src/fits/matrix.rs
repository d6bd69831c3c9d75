//! Covariance matrices: written out, or in a file of their own.

use std::ops::Range;

use super::super::keys;
use gumption_columns::recording::npy_matrix;
use gumption_columns::separator::{DecimalMarks, Separator, is_skipped};
use gumption_engine::regression::Cross;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Folder, bytes};

/// The largest file: 10,000 x 10,000 numbers as text.
const MOST_BYTES: u64 = 4_000_000_000;

/// Entries (i, j) and (j, i) may differ by this share of the standard deviations, as they are printed.
const SYMMETRY: f64 = 1e-6;

/// Numbers of a matrix, row by row, with where they come from.
struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<f64>,
    place: Range<usize>,
}

/// The lower triangle of a covariance matrix of so many values.
pub(super) fn covariance(
    log: &Collector,
    member: &Member,
    order: usize,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Vec<f64>> {
    let matrix = read(log, member, folder, files)?;
    let Matrix { rows, columns, entries, place } = matrix;
    if (rows, columns) != (order, order) {
        let reason = format!("it has {rows} x {columns} entries for {order} values");
        fault(log, member, reason, &place);
        return None;
    }
    let at = |i: usize, j: usize| entries[i * order + j];
    for i in 0..order {
        for j in 0..i {
            let scale = (at(i, i) * at(j, j)).abs().sqrt();
            if (at(i, j) - at(j, i)).abs() > SYMMETRY * scale {
                let reason = format!(
                    "it is not symmetric: row {} column {} is {}, but row {} column {} is {}",
                    j + 1,
                    i + 1,
                    at(j, i),
                    i + 1,
                    j + 1,
                    at(i, j)
                );
                fault(log, member, reason, &place);
                return None;
            }
        }
    }
    let mut lower = Vec::with_capacity(order * (order + 1) / 2);
    for i in 0..order {
        lower.extend((0..=i).map(|j| 0.5 * at(i, j) + 0.5 * at(j, i)));
    }
    Some(lower)
}

/// The covariances of abscissae with ordinates: of each point, or a matrix.
pub(super) fn cross(
    log: &Collector,
    member: &Member,
    order: usize,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Cross> {
    if let Json::List(list) = &member.value.value
        && list.iter().all(|node| node.number().is_some())
    {
        let each: Vec<f64> = list.iter().filter_map(Node::number).collect();
        if each.len() != order {
            let reason = format!("it has {} covariances for {order} points", each.len());
            fault(log, member, reason, &member.value.span);
            return None;
        }
        return Some(Cross::Each(each));
    }
    let Matrix { rows, columns, entries, place } = read(log, member, folder, files)?;
    if (rows, columns) != (order, order) {
        let reason = format!("it has {rows} x {columns} entries for {order} points");
        fault(log, member, reason, &place);
        return None;
    }
    Some(Cross::Joint(entries))
}

fn fault(log: &Collector, member: &Member, reason: String, place: &Range<usize>) {
    log.report(place, DiagnosticKind::Fit { name: member.key.clone(), reason });
}

fn read(
    log: &Collector,
    member: &Member,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Matrix> {
    match &member.value.value {
        Json::List(rows) => written(log, member, rows),
        Json::Object(_) => {
            let object = Object::new(log, "a matrix", &member.value, &member.key_span)?;
            keys::check(&object, keys::COVARIANCE_FILE);
            let place = object.required("file")?.value.span.clone();
            let name = object.text("file")?;
            of_file(log, member, name, place, folder, files)
        }
        other => {
            let diagnostic = DiagnosticKind::WrongType {
                what: format!("`{}`", member.key),
                found: other.kind(),
                expected: "a list of rows, or {\"file\": ...}",
            };
            log.report(&member.value.span, diagnostic);
            None
        }
    }
}

/// A matrix that is written out.
fn written(log: &Collector, member: &Member, rows: &[Node]) -> Option<Matrix> {
    let mut entries = Vec::new();
    let mut columns = None;
    for (number, row) in rows.iter().enumerate() {
        let numbers = match &row.value {
            Json::List(list) => list.iter().map(Node::number).collect::<Option<Vec<f64>>>(),
            _ => None,
        };
        let Some(numbers) = numbers else {
            let reason = format!("row {} is not a list of numbers", number + 1);
            fault(log, member, reason, &row.span);
            return None;
        };
        let expected = *columns.get_or_insert(numbers.len());
        if numbers.len() != expected {
            let reason = format!(
                "row {} has {} entries, and the rows above it have {expected}",
                number + 1,
                numbers.len()
            );
            fault(log, member, reason, &row.span);
            return None;
        }
        entries.extend(numbers);
    }
    let (rows, columns, place) = (rows.len(), columns.unwrap_or(0), member.value.span.clone());
    Some(Matrix { rows, columns, entries, place })
}

/// A matrix in a file: numbers by lines, or an array of NumPy's.
fn of_file(
    log: &Collector,
    member: &Member,
    name: &str,
    place: Range<usize>,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Matrix> {
    let content = log.value(&place, folder.content(name, MOST_BYTES))?;
    let found = if name.ends_with(".npy") {
        npy_matrix(&content)
    } else {
        bytes::text(&content).and_then(|text| lines(&text))
    };
    let (rows, columns, entries) = match found {
        Ok(found) => found,
        Err(reason) => {
            fault(log, member, format!("`{name}`: {reason}"), &place);
            return None;
        }
    };
    if files.iter().all(|(known, _)| known != name) {
        files.push((name.to_owned(), content));
    }
    Some(Matrix { rows, columns, entries, place })
}

/// The numbers of a text, a line each row; a first line without a number is a header.
fn lines(text: &str) -> Result<(usize, usize, Vec<f64>), String> {
    let mut numbered = text.lines().enumerate().filter(|(_, line)| !is_skipped(line)).peekable();
    let separator =
        numbered.peek().map_or(Separator::Comma, |(_, line)| Separator::of_line(line.trim()));
    let cells = |line: &str| {
        let cells = line.trim().split(separator.sign());
        cells.map(str::trim).map(str::to_owned).collect::<Vec<_>>()
    };
    let number = |cell: &str, marks: &mut DecimalMarks| {
        let parsed = marks.with_point(cell)?.parse::<f64>();
        Ok::<_, String>(parsed.ok().filter(|value| value.is_finite()))
    };
    let is_text = |cell: &String| {
        number(cell, &mut DecimalMarks::of(separator)).is_ok_and(|value| value.is_none())
    };
    if let Some((_, line)) = numbered.peek()
        && cells(line).iter().all(is_text)
    {
        numbered.next();
    }
    let mut marks = DecimalMarks::of(separator);
    let (mut rows, mut columns, mut entries) = (0, 0, Vec::new());
    for (place, line) in numbered {
        let before = entries.len();
        for (column, cell) in cells(line).iter().enumerate() {
            let value = number(cell, &mut marks)?.ok_or_else(|| {
                let found = if cell.is_empty() { "empty" } else { "no number" };
                format!("line {}, column {} is {found}", place + 1, column + 1)
            })?;
            entries.push(value);
        }
        let found = entries.len() - before;
        if rows > 0 && found != columns {
            return Err(format!(
                "line {} has {found} numbers, and the lines above it have {columns}",
                place + 1
            ));
        }
        (rows, columns) = (rows + 1, found);
    }
    if rows == 0 { Err("it has no numbers".to_owned()) } else { Ok((rows, columns, entries)) }
}
