//! Headings of columns that a file names, held against the units that it states.

use std::ops::Range;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::value_text::ValueOf;
pub use gumption_columns::heading::{bare, enclosed, named, place_of, stated};
use gumption_units::Unit;

/// The name of a column and its unit, which may be one of the file's own; see
/// [`gumption_columns::heading::heading`].
pub fn heading<'h>(log: &Collector, text: &'h str) -> Option<(&'h str, Unit)> {
    gumption_columns::heading::heading(|unit| log.unit(unit).ok(), text)
}

/// Reports, at the place that names the column, that its heading has another unit than `declared`,
/// which its values (quantities, or widths) are read in.
pub fn check(
    log: &Collector,
    place: &Range<usize>,
    column: &str,
    declared: (&Unit, ValueOf),
) -> bool {
    let unit = |text: &str| log.unit(text).ok();
    let contradiction = gumption_columns::heading::contradiction(unit, column, declared);
    let is_same = contradiction.is_none();
    contradiction
        .into_iter()
        .for_each(|found| log.report(place, DiagnosticKind::ColumnUnit(found)));
    is_same
}
