//! Which column of a table of results holds what, and in which unit.

use super::headings::{self, Role, Said, UnitOfHeading};
use super::numbers::Numbers;
use crate::DiagnosticKind;
use crate::column_heading;
use crate::import::columns;
use crate::import::coverage::HeaderCoverage;
use gumption_engine::task::Warning;

/// The columns of a table.
#[derive(Debug)]
pub(super) struct Columns {
    roles: Vec<(Role, usize)>,
    /// Conditions, by their names.
    conditions: Vec<(String, usize)>,
    /// The units that headings state, by place.
    units: Vec<(usize, UnitOfHeading)>,
    /// What headings of expanded uncertainties say of their coverage, by place.
    coverages: Vec<(usize, HeaderCoverage)>,
}

impl Columns {
    /// The columns of a table, of which these conditions may be some. Mistakes are reported.
    pub(super) fn of(
        numbers: &Numbers<'_>,
        conditions: &[&str],
        warnings: &mut Vec<Warning>,
    ) -> Option<Self> {
        let headings = numbers.table.columns();
        let fail = |reason: String| {
            numbers.log.report_at(numbers.table.header(), DiagnosticKind::Table { reason });
        };
        let mut found: Vec<(Role, bool, usize)> = Vec::new();
        let (mut of_conditions, mut unknown, mut doubtful) = (Vec::new(), Vec::new(), Vec::new());
        for (place, heading) in headings.iter().enumerate() {
            let bare = column_heading::bare(heading);
            if let Some(name) = conditions.iter().find(|name| **name == heading || **name == bare) {
                of_conditions.push(((*name).to_owned(), place));
                continue;
            }
            if heading.is_empty() {
                if (0..numbers.table.rows()).any(|row| !numbers.is_empty(row, place)) {
                    fail(format!("column {} has no name in the header", place + 1));
                }
                continue;
            }
            match headings::said(heading) {
                Said::Role(role, is_symbol) => found.push((role, is_symbol, place)),
                Said::SomeUncertainty => doubtful.push(place),
                Said::Nothing => unknown.push(place),
            }
        }
        let heading = |place: usize| headings.get(place).map_or("", String::as_str);
        // a nominal value tells which point is meant where results stand beside it
        let is_value = |role: Role| matches!(role, Role::Value(_));
        let is_nominal = |(role, _, place): &(Role, bool, usize)| {
            is_value(*role) && columns::is_nominal(heading(*place))
        };
        let mut nominal = Vec::new();
        if found.iter().any(|of| is_value(of.0) && !is_nominal(of)) {
            nominal.extend(found.extract_if(.., |of| is_nominal(of)).map(|(_, _, place)| place));
        }
        let mut roles: Vec<(Role, usize)> = Vec::new();
        for &(role, is_symbol, place) in &found {
            let others: Vec<&(Role, bool, usize)> =
                found.iter().filter(|(of, _, at)| *of == role && *at != place).collect();
            let before = others.iter().any(|(_, symbol, at)| match role {
                // of several words the first one is the label
                Role::Label => *symbol && !is_symbol || *symbol == is_symbol && *at < place,
                _ => *symbol && !is_symbol,
            });
            if before {
                unknown.push(place);
                continue;
            }
            if let Some((_, _, other)) =
                others.iter().find(|(_, symbol, at)| *symbol == is_symbol && *at < place)
            {
                fail(format!(
                    "the columns `{}` and `{}` hold the same: leave one of them, or write `#` before \
                     its words",
                    heading(*other),
                    heading(place)
                ));
                return None;
            }
            roles.push((role, place));
        }
        let has = |role: Role| roles.iter().any(|(of, _)| *of == role);
        // a factor tells that they are expanded
        match doubtful.as_slice() {
            [] => {}
            &[place] if has(Role::Factor(0)) && !has(Role::Expanded(0)) => {
                roles.push((Role::Expanded(0), place));
            }
            &[.., place] => {
                fail(format!(
                    "`{}` can be the standard uncertainty or an expanded one: call the column `u`, or \
                     `U` with its coverage factor, `U (k=2)`",
                    heading(place)
                ));
                return None;
            }
        }
        let known = ["label", "correlation"];
        let (alike, others): (Vec<usize>, Vec<usize>) = unknown
            .into_iter()
            .partition(|place| headings::is_like_uncertainty(heading(*place), &known));
        for place in &alike {
            fail(format!(
                "the column `{}` is not known, and looks like one that changes the results; there are \
                 label, x, U (or u), k of laboratories, and label, x1, U1, x2, U2, k1, k2, r of pairs. Take \
                 it out, or begin its heading with another word",
                heading(*place)
            ));
        }
        let others = [others, nominal].concat();
        if !others.is_empty() {
            let mut places = others;
            places.sort_unstable();
            let names: Vec<String> =
                places.iter().map(|place| format!("`{}`", heading(*place))).collect();
            let (columns, are) =
                if names.len() == 1 { ("column", "is") } else { ("columns", "are") };
            let text =
                format!("the {columns} {} {are} not read", gumption_units::listed(&names, " and "));
            warnings.push(Warning::new("columns-not-read", "", text));
        }
        let mut units = Vec::new();
        let mut coverages = Vec::new();
        for &(role, place) in &roles {
            if matches!(role, Role::Expanded(_)) {
                coverages.push((place, headings::coverage(heading(place))));
            }
            if !matches!(role, Role::Value(_) | Role::Expanded(_) | Role::Standard(_)) {
                continue;
            }
            let parse = |text: &str| numbers.log.unit(text).map_err(|error| error.to_string());
            match headings::unit(heading(place), parse) {
                Ok(unit) => units.extend(unit.map(|unit| (place, unit))),
                Err(reason) => {
                    fail(reason);
                    return None;
                }
            }
        }
        alike.is_empty().then_some(Self { roles, conditions: of_conditions, units, coverages })
    }

    /// The place of the column that holds this.
    pub(super) fn place(&self, role: Role) -> Option<usize> {
        self.roles.iter().find(|(of, _)| *of == role).map(|(_, place)| *place)
    }

    pub(super) fn has(&self, role: Role) -> bool {
        self.place(role).is_some()
    }

    /// Whether the column holds measured values or uncertainties.
    pub(super) fn is_of_results(&self, place: usize) -> bool {
        let is_result =
            |role: Role| matches!(role, Role::Value(_) | Role::Expanded(_) | Role::Standard(_));
        self.roles.iter().any(|(role, at)| *at == place && is_result(*role))
    }

    /// The place of a condition.
    pub(super) fn condition(&self, name: &str) -> Option<usize> {
        self.conditions.iter().find(|(of, _)| of == name).map(|(_, place)| *place)
    }

    /// The unit that the heading of a column states.
    pub(super) fn unit(&self, place: usize) -> Option<&UnitOfHeading> {
        self.units.iter().find(|(of, _)| *of == place).map(|(_, unit)| unit)
    }

    /// What the heading of a column says of the coverage.
    pub(super) fn coverage(&self, place: usize) -> HeaderCoverage {
        let found = self.coverages.iter().find(|(of, _)| *of == place);
        found.map_or(HeaderCoverage::None, |(_, coverage)| *coverage)
    }
}
