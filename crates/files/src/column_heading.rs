//! Headings of columns with a unit: `t [degC]`, `t (degC)`, `t / degC`.
//!
//! A file that names a column states the unit of its values as well. Where the heading has another
//! one, the two contradict each other, and none is taken.

use std::ops::Range;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::value_text::ValueOf;
use gumption_units::Unit;

/// The name of a column and its unit; a plain number without. `None` where brackets have no unit.
pub(super) fn heading<'h>(log: &Collector, text: &'h str) -> Option<(&'h str, Unit)> {
    if let Some((name, unit)) = enclosed(text, '[', "]") {
        return Some((name, log.unit(unit).ok()?));
    }
    let known = enclosed(text, '(', ")").or_else(|| after(text, "/"));
    let known = known.and_then(|(name, unit)| Some((name, log.unit(unit).ok()?)));
    Some(known.filter(|(name, _)| !name.is_empty()).unwrap_or((text.trim(), Unit::one())))
}

/// The name of a column whose heading has a unit behind it; of every other one the whole.
pub(super) fn bare(text: &str) -> &str {
    named(text).map(|(name, _)| name).filter(|name| !name.is_empty()).unwrap_or(text)
}

/// The name and the unit of a heading that has one in brackets or behind a slash between spaces.
pub(super) fn named(text: &str) -> Option<(&str, &str)> {
    let named = enclosed(text, '[', "]").or_else(|| enclosed(text, '(', ")"));
    named.or_else(|| after(text, " / "))
}

/// The place of the column of that name: as it stands in the header, else the only one that has it with
/// a unit behind it, `f [Hz]` for `f`.
pub(super) fn place_of(columns: &[String], name: &str) -> Option<usize> {
    let exact = columns.iter().position(|column| column == name);
    exact.or_else(|| {
        let named = |(_, column): &(usize, &String)| bare(column) == name;
        let mut places = columns.iter().enumerate().filter(named).map(|(place, _)| place);
        places.next().filter(|_| places.next().is_none())
    })
}

/// The name and the unit of a heading that ends in brackets.
pub(super) fn enclosed<'h>(text: &'h str, open: char, close: &str) -> Option<(&'h str, &'h str)> {
    let (name, unit) = text.trim_end().strip_suffix(close)?.rsplit_once(open)?;
    Some((name.trim(), unit.trim()))
}

fn after<'h>(text: &'h str, sign: &str) -> Option<(&'h str, &'h str)> {
    let (name, unit) = text.split_once(sign)?;
    Some((name.trim(), unit.trim()))
}

/// Reports, at the place that names the column, that its heading has another unit than `declared`,
/// which its values (quantities, or widths) are read in. Nothing where the heading has no unit: what stands behind a slash
/// without spaces may be the other half of a ratio, and a number alone counts something.
pub(super) fn check(
    log: &Collector,
    place: &Range<usize>,
    column: &str,
    (declared, of): (&Unit, ValueOf),
) -> bool {
    let contradiction = contradiction(|text| log.unit(text).ok(), column, (declared, of));
    let is_same = contradiction.is_none();
    contradiction.into_iter().for_each(|kind| log.report(place, kind));
    is_same
}

/// That a heading has another unit than `declared`, as [`check`] reports it; `unit` reads the text of one.
pub(super) fn contradiction(
    unit: impl Fn(&str) -> Option<Unit>,
    column: &str,
    (declared, of): (&Unit, ValueOf),
) -> Option<DiagnosticKind> {
    let (name, text) = named(column)?;
    if name.is_empty() || text.parse::<f64>().is_ok() || text == declared.text() {
        return None;
    }
    let unit = unit(text)?;
    let is_same = unit.is_compatible(declared)
        && unit.factor() == declared.factor()
        && (of == ValueOf::Difference || unit.has_zero_of(declared));
    let (column, heading) = (column.to_owned(), text.to_owned());
    let declared = declared.text().to_owned();
    (!is_same).then_some(DiagnosticKind::ColumnUnit { column, heading, declared })
}
