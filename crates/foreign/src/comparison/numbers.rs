//! The numbers in the cells of a table.

use std::cell::{Cell, RefCell};

use super::both::is_of_both;
use super::sheet;
use crate::import::both::sides;
use crate::import::columns::without_in;
use crate::import::concise::concise;
use crate::import::mark::{MarkedCell, doubt};
use crate::import::number::{self, without_groups, written};
use gumption_columns::separator::{DecimalMarks, Separator};
use gumption_engine::decimal::{Decimal, to_position};
use gumption_engine::number::Shortest;
use gumption_text::text_table::TextTable;
use gumption_text::value_text::{decimal_comma, grouped_digits, is_comma, power_of_last_digit};
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::Unit;

/// A number as it stands in a cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Number {
    pub(super) value: f64,
    /// As it is printed, which a workbook may do with fewer digits.
    pub(super) printed: f64,
    /// Half a unit of its last printed digit.
    pub(super) half_unit: f64,
    /// The unit behind it.
    pub(super) unit: Option<Unit>,
}

/// The cells of a table, read as numbers.
pub(super) struct Numbers<'a> {
    pub(super) log: &'a Collector,
    pub(super) table: &'a TextTable,
    sheet: Option<&'a sheet::Cells>,
    marks: RefCell<DecimalMarks>,
    /// Whether the numbers have two decimal marks, which was said.
    mixed: Cell<bool>,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(
        log: &'a Collector,
        table: &'a TextTable,
        sheet: Option<&'a sheet::Cells>,
    ) -> Self {
        let marks = RefCell::new(DecimalMarks::of(table.separator()));
        Self { log, table, sheet, marks, mixed: Cell::new(false) }
    }

    /// Whether a comma may be the decimal mark of a number: not between commas, and not in a workbook.
    pub(super) fn has_commas(&self) -> bool {
        self.table.separator() != Separator::Comma
    }

    /// Whether the decimal mark of the numbers in these columns is known; otherwise after a mistake.
    pub(super) fn has_known_mark(&self, is_number: impl Fn(usize) -> bool) -> bool {
        let table = self.table;
        // the cells of a workbook are numbers
        if table.separator() == Separator::Comma || self.sheet.is_some() {
            return true;
        }
        let headings = table.columns();
        let places =
            (0..table.rows()).flat_map(|row| (0..headings.len()).map(move |column| (row, column)));
        let cells = places.flat_map(|(row, column)| {
            let text = table.text(row, column);
            let (estimate, uncertainty) = sides(text).map_or((text, None), |(a, b)| (a, Some(b)));
            let cell =
                |text| MarkedCell { place: (row, column), text, is_number: is_number(column) };
            [Some(estimate), uncertainty].into_iter().flatten().map(cell).collect::<Vec<_>>()
        });
        let doubt = doubt(headings.iter().map(String::as_str), cells);
        if let Some(((row, column), reason)) = &doubt {
            let reason = reason.clone();
            self.log.report_at(table.place(*row, *column), DiagnosticKind::Table { reason });
        }
        doubt.is_none()
    }

    /// The text of a cell as a name: of a date or a time what it shows.
    pub(super) fn name(&self, row: usize, column: usize) -> &'a str {
        let text = self.table.text(row, column);
        let is_date = self.sheet.is_some_and(|sheet| sheet.is_date(self.table.line(row), column));
        text.split_once(' ').filter(|_| is_date).map_or(text, |(_, shown)| shown)
    }

    /// Whether a cell holds nothing, or a sign that nothing is there.
    pub(super) fn is_empty(&self, row: usize, column: usize) -> bool {
        is_empty(self.table.text(row, column))
    }

    /// Whether a cell holds a number with a unit behind it.
    pub(super) fn has_unit(&self, row: usize, column: usize) -> bool {
        written(self.table.text(row, column), true)
            .is_some_and(|(_, _, unit)| Unit::parse(without_in(unit)).is_ok() && !unit.is_empty())
    }

    /// The number in a cell; `None` after a mistake, which is reported.
    pub(super) fn number(&self, row: usize, column: usize) -> Option<Number> {
        self.number_of(row, column, self.table.text(row, column))
    }

    /// The number in this text of a cell; `None` after a mistake, which is reported.
    pub(super) fn number_of(&self, row: usize, column: usize, text: &str) -> Option<Number> {
        let name = || self.table.columns().get(column).cloned().unwrap_or_default();
        let place = || self.table.place(row, column);
        let fail = |reason: String| {
            let reason = format!("row {}, column `{}`: {reason}", row + 1, name());
            self.log.report_at(place(), DiagnosticKind::Table { reason });
        };
        let line = self.table.line(row);
        if let Some(reason) = self.sheet.and_then(|sheet| sheet.no_number(line, column)) {
            fail(reason);
            return None;
        }
        let no_number = || {
            let kind =
                DiagnosticKind::Cell { row: row + 1, column: name(), found: text.to_owned() };
            self.log.report_at(place(), kind);
        };
        let with_commas = self.has_commas();
        let read = written(text, with_commas)
            .map(|(value, digits, unit)| (value, digits, without_in(unit)));
        let Some((value, digits, unit)) = read else {
            // of a text between commas, and in a workbook, the decimal mark is a point
            match whole_before_comma(text).filter(|_| !with_commas) {
                Some((whole, rest)) => fail(decimal_comma(whole, rest)),
                None => no_number(),
            }
            return None;
        };
        if is_comma(unit) {
            fail(decimal_comma(value, unit));
            return None;
        }
        let parsed = (!unit.is_empty()).then(|| self.log.unit(unit)).transpose();
        let Ok(parsed) = parsed else {
            if let Some((_, std, _)) = concise(text, with_commas) {
                fail(format!(
                    "`{text}` is an estimate with its standard uncertainty, {}: write the estimate alone, and \
                     the uncertainty into a column `u`",
                    Shortest(std)
                ));
                return None;
            }
            match grouped_digits(unit) {
                Some(reason) => fail(reason),
                None if is_of_both(text, with_commas) => fail(format!(
                    "`{text}` holds an uncertainty, as a column beside it does: write the estimate alone"
                )),
                None => no_number(),
            }
            return None;
        };
        let own = text.trim().strip_suffix(unit).unwrap_or(text).trim();
        let plain = without_groups(own);
        if let Err(reason) = self.marks.borrow_mut().with_point(plain.as_deref().unwrap_or(own)) {
            // of all cells that follow it would be said again
            if !self.mixed.replace(true) {
                self.log.report_at(place(), DiagnosticKind::Table { reason });
            }
            return None;
        }
        let shown = self.sheet.and_then(|sheet| sheet.last_digit(line, column));
        let last = shown.unwrap_or_else(|| power_of_last_digit(&digits));
        let printed = shown.map_or(value, |last| to_position(value, last));
        Some(Number { value, printed, half_unit: half_unit(last), unit: parsed })
    }

    /// The number in a cell that has no unit; `None` after a mistake.
    pub(super) fn bare(&self, row: usize, column: usize) -> Option<f64> {
        let found = self.number(row, column)?;
        if let Some(unit) = found.unit {
            let reason = format!(
                "row {}, column `{}`: a number without a unit is needed, and `{}` stands behind it",
                row + 1,
                self.table.columns().get(column).map_or("", String::as_str),
                unit.text()
            );
            self.log.report_at(self.table.place(row, column), DiagnosticKind::Table { reason });
            return None;
        }
        Some(found.value)
    }
}

/// Whether a text stands for nothing.
pub(super) fn is_empty(text: &str) -> bool {
    matches!(text.trim(), "" | "-" | "–" | "—" | "−" | "/" | "n/a" | "N/A" | "n.a.")
}

/// The number before the first comma of a text that is one with it, and the rest from the comma.
fn whole_before_comma(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    written(text, true)?;
    let at = text.find(',')?;
    let whole = number::number(text.get(..at)?, false)?;
    Some((whole, text.get(at..)?))
}

/// Half a unit of a digit.
fn half_unit(last: i32) -> f64 {
    // from its decimal form, which is the nearest number
    Decimal::new(5, last.saturating_sub(1)).value()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_units_of_printed_digits() {
        for (text, half) in
            [("423", 0.5), ("0.010", 0.0005), ("1.50e-3", 5e-6), ("-7.", 0.5), ("2e4", 5e3)]
        {
            assert_eq!(half_unit(power_of_last_digit(text)), half, "{text}");
        }
    }
}
