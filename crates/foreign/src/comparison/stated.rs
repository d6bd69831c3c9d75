//! Results as the rows of a table state them: units, factors, shares.

use super::headings::Role;
use super::numbers::{self, Number};
use super::{ComparisonReader, InUnits};
use gumption_analysis::compare::StatedResult;
use gumption_engine::number::Shortest;
use gumption_text::DiagnosticKind;
use gumption_text::share::{self, Share};
use gumption_text::value_text::{PLUS_MINUS, either_temperature};
use gumption_units::{IncompatibleUnits, Unit};

/// Coverage factor of a stated uncertainty unless the table has another.
pub(super) const USUAL_FACTOR: f64 = 2.0;

/// Two factors are the same where they differ by no more than this share: two digits, of which the least
/// are 1.0, are rounded by up to 5 %.
const ROUNDED: f64 = 0.05;

/// Whether two factors are not the same.
pub(super) fn differs(a: f64, b: f64) -> bool {
    (a - b).abs() > ROUNDED * b
}

impl ComparisonReader<'_> {
    /// A number with its unit: that of its cell, of its heading or of the column of units.
    pub(super) fn in_unit(&self, row: usize, place: usize) -> Option<Number> {
        self.in_unit_of(row, place, self.numbers.table.text(row, place))
    }

    /// The number in this text of a cell with its unit.
    pub(super) fn in_unit_of(&self, row: usize, place: usize, text: &str) -> Option<Number> {
        let mut found = self.numbers.number_of(row, place, text)?;
        let fail = |reason: String| self.fail_at(self.numbers.table.place(row, place), reason);
        if let (Some(own), Some(of_heading)) = (&found.unit, self.columns.unit(place)) {
            if own.text() != of_heading.unit.text() {
                fail(format!(
                    "`{}` stands in a column whose heading says `{}`",
                    self.numbers.table.text(row, place),
                    of_heading.unit.text()
                ));
                return None;
            }
            return Some(found);
        }
        if found.unit.is_none() {
            found.unit = self.columns.unit(place).map(|unit| unit.unit.clone());
        }
        if let (None, Some(units)) = (&found.unit, self.columns.place(Role::Unit)) {
            let text = self.numbers.table.text(row, units);
            if !numbers::is_empty(text) {
                match self.numbers.log.unit(text) {
                    Ok(unit) => found.unit = Some(unit),
                    Err(error) => {
                        let place = self.numbers.table.place(row, units);
                        self.fail_at(place, format!("`{text}` is no unit: {error}"));
                        return None;
                    }
                }
            }
        }
        Some(found)
    }

    /// The factor of a row's expanded uncertainty; `None` after a mistake.
    fn factor(&self, row: usize, of: u8, place: usize, expanded: &Number) -> Option<f64> {
        let coverage = self.columns.coverage(place);
        let stated = match self.columns.place(Role::Factor(of)) {
            // a cell that is empty is refused
            Some(k) => Some((k, self.numbers.bare(row, k)?)),
            None => None,
        };
        if let Some((k, found)) = stated.filter(|(_, found)| *found <= 0.0) {
            let kind = DiagnosticKind::NotPositive { key: self.heading(k).to_owned(), found };
            self.numbers.log.report_at(self.numbers.table.place(row, k), kind);
            return None;
        }
        let of_heading = match self.columns.place(Role::Dof) {
            Some(dof) if coverage.probability().is_some() && stated.is_none() => {
                coverage.factor(self.dof(row, dof)?)
            }
            _ => coverage
                .factor(None)
                .filter(|_| stated.is_none() || coverage.probability().is_none()),
        };
        let mut found = stated.map(|(k, found)| (found, self.heading(k)));
        if let Some(factor) = of_heading {
            if let Some((other, name)) = found.filter(|(other, _)| differs(*other, factor)) {
                let reason = format!(
                    "row {}: `{name}` says {}, `{}` {}: which factor is it?",
                    row + 1,
                    Shortest(other),
                    self.heading(place),
                    Shortest(factor)
                );
                self.fail_at(self.numbers.table.place(row, place), reason);
                return None;
            }
            found = found.or(Some((factor, self.heading(place))));
        }
        let Some(standard) = self.columns.place(Role::Standard(of)) else {
            return Some(found.map_or(USUAL_FACTOR, |(factor, _)| factor));
        };
        let own = self.in_unit(row, standard)?;
        let by = match (&own.unit, &expanded.unit) {
            (Some(from), Some(to)) => Unit::conversion_factor(from, to).ok(),
            (None, None) => Some(1.0),
            _ => None,
        };
        let quotient = by.map(|by| expanded.value / (own.value * by));
        let factor = found.map_or(quotient, |(factor, _)| Some(factor));
        match (quotient, factor) {
            (Some(quotient), Some(factor))
                if quotient.is_finite() && quotient >= 1.0 && !differs(quotient, factor) =>
            {
                Some(factor)
            }
            _ => {
                let reason = format!(
                    "row {}: `{}` and `{}` both state the uncertainty, and their quotient {}: correct \
                     one of them, or take a column out",
                    row + 1,
                    self.heading(place),
                    self.heading(standard),
                    quotient.map_or_else(
                        || "cannot be formed".to_owned(),
                        |quotient| format!("is {}", Shortest(quotient))
                    )
                );
                self.fail_at(self.numbers.table.place(row, standard), reason);
                None
            }
        }
    }

    /// The degrees of freedom of a row, `None` within where they are infinite.
    fn dof(&self, row: usize, place: usize) -> Option<Option<f64>> {
        let text = self.numbers.table.text(row, place).trim().to_lowercase();
        if numbers::is_empty(&text)
            || matches!(text.as_str(), "inf" | "infinity" | "infinite" | "∞" | "unendlich")
        {
            return Some(None);
        }
        let found = self.numbers.bare(row, place)?;
        if found < 1.0 {
            let range = "at least 1";
            let kind =
                DiagnosticKind::OutOfRange { key: self.heading(place).to_owned(), found, range };
            self.numbers.log.report_at(self.numbers.table.place(row, place), kind);
            return None;
        }
        Some(Some(found))
    }

    /// A stated result of a row, in its own units.
    pub(super) fn stated(&mut self, row: usize, of: u8) -> Option<InUnits> {
        let x = self.columns.place(Role::Value(of))?;
        let expanded = self.columns.place(Role::Expanded(of));
        let u = expanded.or(self.columns.place(Role::Standard(of)))?;
        let in_one = (x == u).then(|| self.in_one_cell(row, of, x));
        let (value, uncertainty, in_one) = match in_one {
            Some(found) => {
                let (value, uncertainty, factor) = found?;
                (Some(value), Some(uncertainty), Some(factor))
            }
            None => {
                // `±0.2` below a heading of uncertainties
                let text = self.numbers.table.text(row, u).trim();
                let sign = PLUS_MINUS.iter().find_map(|sign| text.strip_prefix(sign));
                let uncertainty = self.in_unit_of(row, u, sign.unwrap_or(text).trim_start());
                (self.in_unit(row, x), uncertainty, None)
            }
        };
        let factor = match (expanded, &uncertainty) {
            _ if in_one.is_some() => in_one,
            (Some(place), Some(uncertainty)) => self.factor(row, of, place, uncertainty),
            (None, _) => Some(1.0),
            // its factor may be a mistake as well
            (Some(_), None) => {
                self.columns.place(Role::Factor(of)).and_then(|k| self.numbers.bare(row, k))
            }
        };
        let (value, uncertainty) = (value?, uncertainty?);
        if uncertainty.value < 0.0 {
            let (range, found) = ("at least 0", uncertainty.value);
            let kind = DiagnosticKind::OutOfRange { key: self.heading(u).to_owned(), found, range };
            self.numbers.log.report_at(self.numbers.table.place(row, u), kind);
            return None;
        }
        let uncertainty = self.of_value(row, u, &value, uncertainty)?;
        let stated = StatedResult {
            value: value.value,
            expanded: uncertainty.value,
            factor: factor?,
            printed: [value.printed, uncertainty.printed],
            rounding: [value.half_unit, uncertainty.half_unit],
        };
        Some(InUnits { value, uncertainty, stated, column: u, of_run: None })
    }

    /// An uncertainty that is a share of the value, in the unit of that; every other one as it is.
    pub(super) fn of_value(
        &mut self,
        row: usize,
        place: usize,
        value: &Number,
        uncertainty: Number,
    ) -> Option<Number> {
        let Some(unit) = uncertainty.unit.clone() else { return Some(uncertainty) };
        let is_said = self.columns.unit(place).is_some_and(|unit| unit.is_of_value);
        let share = if is_said { Share::OfValue } else { Share::of(&unit, value.unit.as_ref()) };
        let fail = |reason: String| self.fail_at(self.numbers.table.place(row, place), reason);
        match share {
            Share::Own => Some(uncertainty),
            Share::OfValue if value.value == 0.0 => {
                fail(format!(
                    "`{}` of the value 0 is nothing: state the uncertainty in the unit of the value",
                    unit.after(&Shortest(uncertainty.value).to_string())
                ));
                None
            }
            // nothing is known of the value's unit, and it may be a number
            Share::OfValue if value.unit.is_none() && !is_said => {
                fail(share::two_meanings(unit.text(), "1"));
                None
            }
            Share::OfValue
                if value
                    .unit
                    .as_ref()
                    .is_some_and(|unit| unit.is_celsius() || !unit.level_exponent().is_zero()) =>
            {
                let own = value.unit.as_ref().map_or("", Unit::text);
                fail(format!(
                    "it is not clear what the share `{}` of a quantity in `{own}` is of: write the \
                     uncertainty in that unit",
                    unit.after(&Shortest(uncertainty.value).to_string())
                ));
                None
            }
            Share::OfValue => {
                self.shares.insert(unit.text().to_owned());
                let by = unit.factor() * value.value.abs();
                Some(Number {
                    value: uncertainty.value * by,
                    printed: uncertainty.printed * by,
                    half_unit: uncertainty.half_unit * by,
                    unit: value.unit.clone(),
                })
            }
            Share::Doubtful => {
                let own = value.unit.as_ref().map_or("1", Unit::text);
                fail(share::two_meanings(unit.text(), own));
                None
            }
        }
    }

    /// A result in the unit of the comparison.
    pub(super) fn converted(
        &self,
        row: usize,
        result: InUnits,
        wanted: Option<&Unit>,
    ) -> Option<StatedResult> {
        let InUnits { value, uncertainty, stated, column, .. } = result;
        let fail = |reason: String| {
            self.fail_at(self.numbers.table.place(row, column), reason);
        };
        let (of_x, of_u, wanted) = match (&value.unit, &uncertainty.unit, wanted) {
            (None, None, None) => return Some(stated),
            (Some(x), Some(u), Some(wanted)) => (x, u, wanted),
            _ => {
                fail(format!(
                    "row {}: some numbers have a unit and others none; write the unit into the headings",
                    row + 1
                ));
                return None;
            }
        };
        let is_absolute = of_x.has_reference() && wanted.has_reference();
        if of_x.is_compatible(wanted) && !of_x.has_zero_of(wanted) && !is_absolute {
            fail(format!(
                "row {}: a value in `{of_x}` is compared in `{wanted}`: {}",
                row + 1,
                either_temperature(wanted)
            ));
            return None;
        }
        let converted = || -> Result<StatedResult, IncompatibleUnits> {
            let by_x = Unit::conversion_factor(of_x, wanted)?;
            let by_u = Unit::conversion_factor(of_u, wanted)?;
            let [x, u] = stated.printed;
            Ok(StatedResult {
                value: Unit::convert(stated.value, of_x, wanted)?,
                expanded: stated.expanded * by_u,
                factor: stated.factor,
                printed: [Unit::convert(x, of_x, wanted)?, u * by_u],
                rounding: [stated.rounding[0] * by_x, stated.rounding[1] * by_u],
            })
        };
        converted().map_err(|error| fail(format!("row {}: {error}", row + 1))).ok()
    }
}
