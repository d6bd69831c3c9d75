//! Compares the headings of columns that a file names with the units that the file states.

use std::ops::Range;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::value_text::ValueOf;
pub use gumption_columns::heading::{bare, contradiction, enclosed, named, place_of, stated};
use gumption_units::Unit;

/// The name and the unit of a column; the unit may be defined in the file. See
/// [`gumption_columns::heading::heading`].
pub fn heading<'h>(log: &Collector, text: &'h str) -> Option<(&'h str, Unit)> {
    gumption_columns::heading::heading(|unit| log.unit(unit).ok(), text)
}

/// Reports a heading whose unit differs from `declared`, the unit in which the values (quantities
/// or widths) are read. The error is reported where the file names the column.
pub fn check(
    log: &Collector,
    place: &Range<usize>,
    column: &str,
    declared: (&Unit, ValueOf),
) -> bool {
    let unit = |text: &str| log.unit(text).ok();
    let other = contradiction(unit, column, declared);
    let is_same = other.is_none();
    other.into_iter().for_each(|found| log.report(place, DiagnosticKind::ColumnUnit(found)));
    is_same
}
