//! Correlation coefficients between laboratories: a matrix with a header of their names, with or without
//! their names before the rows.

use std::path::Path;

use super::headings::{self, HeadingMeaning, Role};
use super::numbers::Numbers;
use super::sheet::{self, Content};
use gumption_engine::number::Shortest;
use gumption_text::text_table::TextTable;
use gumption_text::{Collector, DiagnosticKind, Place, SourceText, bytes};

/// The coefficients in the order of these laboratories, row by row. Mistakes are reported.
pub(super) fn read(log: &Collector, path: &Path, labels: &[&str]) -> Option<Vec<Vec<f64>>> {
    let name = path.display().to_string();
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    let content = bytes::of_file(path, bytes::MOST)
        .map_err(unreadable)
        .and_then(|bytes| sheet::matrix(path, bytes, labels));
    let Content { text, sheet, .. } = match content {
        Ok(content) => content,
        Err(kind) => {
            let place = Place { source: SourceText::new(name, ""), span: 0..0 };
            log.report_at(place, kind);
            return None;
        }
    };
    let source = SourceText::new(name, &text);
    let own = Collector::new(source.clone());
    let read = TextTable::parse(&own, &source).and_then(|table| {
        Matrix { numbers: Numbers::new(&own, &table, sheet.as_ref()), labels }.coefficients()
    });
    let mistakes = own.into_diagnostics().0;
    let read = read.filter(|_| mistakes.is_empty());
    for found in mistakes {
        log.report_at(Place { source: found.source, span: found.span }, found.kind);
    }
    read
}

struct Matrix<'a> {
    numbers: Numbers<'a>,
    labels: &'a [&'a str],
}

impl Matrix<'_> {
    fn fail_at(&self, place: Place, reason: String) {
        self.numbers.log.report_at(place, DiagnosticKind::Table { reason });
    }

    fn coefficients(&self) -> Option<Vec<Vec<f64>>> {
        let table = self.numbers.table;
        let fail = |reason: String| self.fail_at(table.header(), reason);
        let headings = table.columns();
        // the names of the rows stand below a heading that is none of a laboratory
        let is_of_names = headings.first().is_some_and(|first| {
            let is_word = first.is_empty()
                || matches!(headings::said(first), HeadingMeaning::Role(Role::Label, _));
            is_word && !self.labels.contains(&first.as_str())
        });
        let skipped = usize::from(is_of_names);
        let all = self.labels.len();
        let unknown =
            headings.iter().skip(skipped).find(|heading| !self.labels.contains(&heading.as_str()));
        if let Some(unknown) = unknown {
            fail(format!(
                "no laboratory of the table is called `{unknown}`: the header of the matrix has the names \
                 of all {all} laboratories"
            ));
            return None;
        }
        let mut columns = Vec::new();
        for label in self.labels {
            let Some(place) = headings.iter().skip(skipped).position(|heading| heading == label)
            else {
                fail(format!(
                    "`{label}` has no column: the header of the matrix has the names of all {all} \
                     laboratories; coefficients of 0 are written"
                ));
                return None;
            };
            columns.push(place + skipped);
        }
        if table.rows() != all {
            fail(format!(
                "the matrix has {} rows of coefficients, and a header of {all} laboratories",
                table.rows()
            ));
            return None;
        }
        if (0..table.rows()).any(|row| !table.is_whole(row)) {
            return None;
        }
        let mut rows = Vec::new();
        for (label, column) in self.labels.iter().zip(&columns) {
            let named = (0..all).find(|row| self.numbers.name(*row, 0) == *label);
            let row = if is_of_names { named } else { Some(column - skipped) };
            let Some(row) = row else {
                fail(format!("no row of the matrix begins with `{label}`"));
                return None;
            };
            rows.push(row);
        }
        // of two laboratories the later one first, so that each pair is read once
        let half = |i: usize| (0..=i).map(|j| self.coefficient(i, j, &rows, &columns)).collect();
        let halves: Vec<Vec<f64>> = (0..all).map(half).collect::<Option<_>>()?;
        let of = |i: usize, j: usize| halves[i.max(j)][i.min(j)];
        Some((0..all).map(|i| (0..all).map(|j| of(i, j)).collect()).collect())
    }

    /// The coefficient of two laboratories, from the one or the other half of the matrix; from the
    /// diagonal 1.
    fn coefficient(&self, i: usize, j: usize, rows: &[usize], columns: &[usize]) -> Option<f64> {
        let cells = [(rows[i], columns[j]), (rows[j], columns[i])];
        let (a, b) = (self.labels[i], self.labels[j]);
        let place = |cell: (usize, usize)| self.numbers.table.place(cell.0, cell.1);
        let held = cells.map(|(row, column)| !self.numbers.table.text(row, column).is_empty());
        let read = |which: usize| self.numbers.bare(cells[which].0, cells[which].1);
        if i == j {
            let r = if held[0] { read(0)? } else { 1.0 };
            if r != 1.0 {
                let reason = format!(
                    "`{a}` with itself has the coefficient {}; on the diagonal it is 1",
                    Shortest(r)
                );
                self.fail_at(place(cells[0]), reason);
            }
            return (r == 1.0).then_some(r);
        }
        let r = match held {
            [true, true] => {
                let (r, other) = (read(0)?, read(1)?);
                if r != other {
                    let reason = format!(
                        "the coefficient of `{a}` and `{b}` is {} in the row of `{a}` and {} in that \
                         of `{b}`: it is one number, or one of the two cells is empty",
                        Shortest(r),
                        Shortest(other)
                    );
                    self.fail_at(place(cells[0]), reason);
                    return None;
                }
                r
            }
            [true, false] => read(0)?,
            [false, true] => read(1)?,
            [false, false] => {
                let reason = format!(
                    "no coefficient of `{a}` and `{b}`: it stands in the one or the other half of the \
                     matrix, 0 where they are not correlated"
                );
                self.fail_at(place(cells[0]), reason);
                return None;
            }
        };
        if !(-1.0..=1.0).contains(&r) {
            let which = usize::from(!held[0]);
            let kind = DiagnosticKind::OutOfRange {
                key: format!("coefficient of {a} and {b}"),
                found: r,
                range: "from -1 to 1",
            };
            self.numbers.log.report_at(place(cells[which]), kind);
            return None;
        }
        Some(r)
    }
}
