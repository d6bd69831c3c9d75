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
    let named = enclosed(text, '[', "]").or_else(|| enclosed(text, '(', ")"));
    let named = named.or_else(|| after(text, " / "));
    named.map(|(name, _)| name).filter(|name| !name.is_empty()).unwrap_or(text)
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
    let named = enclosed(column, '[', "]").or_else(|| enclosed(column, '(', ")"));
    let Some((name, text)) = named.or_else(|| after(column, " / ")) else { return true };
    if name.is_empty() || text.parse::<f64>().is_ok() || text == declared.text() {
        return true;
    }
    let Ok(unit) = log.unit(text) else { return true };
    let is_same = unit.is_compatible(declared)
        && unit.factor() == declared.factor()
        && (of == ValueOf::Difference || unit.has_zero_of(declared));
    if !is_same {
        let (column, heading) = (column.to_owned(), text.to_owned());
        let declared = declared.text().to_owned();
        log.report(place, DiagnosticKind::ColumnUnit { column, heading, declared });
    }
    is_same
}
