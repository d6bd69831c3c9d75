//! Which column of a table of results holds what, and in which unit.

use super::both;
use super::headings::{self, HeadingMeaning, Role, UnitOfHeading};
use super::numbers::Numbers;
use crate::import::columns;
use crate::import::coverage::HeaderCoverage;
use gumption_engine::fact;
use gumption_engine::fact::Argument;
use gumption_engine::task::Warning;
use gumption_text::{DiagnosticKind, column_heading};

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

/// Gives columns without an owner to the laboratory where others are those of the reference, and those of
/// laboratories to a table of laboratories where there is no reference: `Result`, `U` beside `Ref. value`,
/// `U_ref`; `x_lab`, `U_lab` alone. `is_owned` tells columns that say whose they are in words.
fn owned(roles: &mut [(Role, usize)], is_owned: impl Fn(usize) -> bool, is_against: bool) {
    let kinds = [Role::Value, Role::Expanded, Role::Standard, Role::Factor];
    let place = |roles: &[(Role, usize)], role: Role| {
        roles.iter().find(|(own, _)| *own == role).map(|(_, place)| *place)
    };
    let change = |roles: &mut [(Role, usize)], from: Role, to: Role| {
        if let (Some(at), None) = (place(roles, from), place(roles, to))
            && let Some(found) = roles.iter_mut().find(|(_, own)| *own == at)
        {
            found.0 = to;
        }
    };
    let has_any = |roles: &[(Role, usize)], result: u8| {
        kinds.iter().any(|kind| place(roles, kind(result)).is_some())
    };
    if place(roles, Role::Value(2)).is_some_and(&is_owned) {
        let has_own_u = [Role::Expanded(2), Role::Standard(2)]
            .into_iter()
            .any(|role| place(roles, role).is_some_and(&is_owned));
        change(roles, Role::Value(0), Role::Value(1));
        if has_own_u {
            change(roles, Role::Expanded(0), Role::Expanded(1));
            change(roles, Role::Standard(0), Role::Standard(1));
        }
    } else if !is_against && !has_any(roles, 2) {
        let of_words =
            |(role, at): &(Role, usize)| kinds.iter().all(|kind| *role != kind(1)) || is_owned(*at);
        if roles.iter().all(of_words) {
            kinds.iter().for_each(|kind| change(roles, kind(1), kind(0)));
        }
    }
}

impl Columns {
    /// The columns of a table, of which these conditions of a run that it is held against may be some.
    /// Mistakes are reported.
    pub(super) fn of(
        numbers: &Numbers<'_>,
        run: Option<&[&str]>,
        warnings: &mut Vec<Warning>,
    ) -> Option<Self> {
        let (conditions, is_against) = (run.unwrap_or(&[]), run.is_some());
        let headings = numbers.table.columns();
        let fail = |reason: String| {
            numbers.log.report_at(numbers.table.header(), DiagnosticKind::Table { reason });
        };
        let mut found: Vec<(Role, bool, usize)> = Vec::new();
        let (mut of_conditions, mut unknown) = (Vec::new(), Vec::new());
        // the results that they are of, and their places
        let (mut doubtful, mut deviations) = (Vec::<(u8, usize)>::new(), Vec::<(u8, usize)>::new());
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
                HeadingMeaning::Role(role, is_symbol) => found.push((role, is_symbol, place)),
                HeadingMeaning::SomeUncertainty(of) => doubtful.push((of, place)),
                HeadingMeaning::Deviation(of) => deviations.push((of, place)),
                HeadingMeaning::Nothing => unknown.push(place),
            }
        }
        let heading = |place: usize| headings.get(place).map_or("", String::as_str);
        let holds_both = |place: usize| {
            let cells = (0..numbers.table.rows()).map(|row| numbers.table.text(row, place));
            cells.into_iter().any(|cell| both::is_of_both(cell, numbers.has_commas()))
        };
        // a nominal value tells which point is meant where results stand beside it
        let is_value = |role: Role| matches!(role, Role::Value(_));
        let is_nominal = |(role, _, place): &(Role, bool, usize)| {
            is_value(*role) && columns::is_nominal(heading(*place))
        };
        let mut nominal = Vec::new();
        // the difference of two results is computed here; beside one value it may be the result
        let is_pair = [1, 2]
            .iter()
            .all(|result| found.iter().any(|(role, ..)| *role == Role::Value(*result)));
        for (result, place) in deviations {
            let is_other = |other: &&(Role, bool, usize)| match other.0 {
                Role::Value(other) => result == 0 || other == result,
                _ => false,
            };
            let value = found.iter().filter(|other| !is_nominal(other)).find(is_other);
            match value {
                _ if result == 0 && is_pair => nominal.push(place),
                None => found.push((Role::Value(result), false, place)),
                Some((.., other)) => {
                    fail(format!(
                        "`{}` and `{}` can both be what is compared: leave one of them, or write `#` before \
                         its words",
                        heading(*other),
                        heading(place)
                    ));
                    return None;
                }
            }
        }
        if found.iter().any(|found| is_value(found.0) && !is_nominal(found)) {
            nominal
                .extend(found.extract_if(.., |found| is_nominal(found)).map(|(_, _, place)| place));
        }
        let mut roles: Vec<(Role, usize)> = Vec::new();
        for &(role, is_symbol, place) in &found {
            let others: Vec<&(Role, bool, usize)> =
                found.iter().filter(|(own, _, at)| *own == role && *at != place).collect();
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
        // points are no laboratories, whose results have a mean
        let has = |role: Role| roles.iter().any(|(own, _)| *own == role);
        if has(Role::Value(2)) && !has(Role::Label) {
            let is_point = |place: &usize| headings::is_of_points(heading(*place));
            let is_nominal = |place: &usize| columns::is_nominal(heading(*place));
            let found = if let Some(at) = unknown.iter().position(is_point) {
                Some(unknown.remove(at))
            } else {
                nominal.iter().position(is_nominal).map(|at| nominal.remove(at))
            };
            roles.extend(found.map(|place| (Role::Label, place)));
        }
        owned(&mut roles, |place| headings::is_of_party(heading(place)), is_against);
        for &(result, place) in &doubtful {
            let has = |role: Role| roles.iter().any(|(own, _)| *own == role);
            let is_only = doubtful.iter().filter(|(other, _)| *other == result).count() == 1;
            let is_free = is_only && !has(Role::Expanded(result));
            // a factor tells that they are expanded, and a cell with a value may say it itself
            if is_free
                && (has(Role::Factor(result)) || !has(Role::Value(result)) && holds_both(place))
            {
                roles.push((Role::Expanded(result), place));
            } else {
                fail(format!(
                    "`{}` can be the standard uncertainty or an expanded one: call the column `u`, or \
                     `U` with its coverage factor, `U (k=2)`",
                    heading(place)
                ));
                return None;
            }
        }
        for result in 0..=2 {
            let place = |role: Role| roles.iter().find(|(own, _)| *own == role).map(|(_, at)| *at);
            let uncertain = place(Role::Expanded(result)).or(place(Role::Standard(result)));
            match (place(Role::Value(result)), uncertain) {
                (Some(value), None) if holds_both(value) => {
                    roles.push((Role::Expanded(result), value))
                }
                (None, Some(place)) if holds_both(place) => {
                    roles.push((Role::Value(result), place))
                }
                _ => {}
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
            let fact = match places[..] {
                [place] => fact!("columns-not-read.one", name = heading(place)),
                _ => {
                    let names = places.iter().map(|place| fact!("quoted", name = heading(*place)));
                    fact!("columns-not-read", names = Argument::all_of(names.collect()))
                }
            };
            warnings.push(Warning::new("", fact));
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
        self.roles.iter().find(|(own, _)| *own == role).map(|(_, place)| *place)
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

    /// Whether the column holds numbers of any kind.
    pub(super) fn is_of_numbers(&self, place: usize) -> bool {
        let is_number =
            |role: Role| matches!(role, Role::Factor(_) | Role::Correlation | Role::Dof);
        self.is_of_results(place)
            || self.roles.iter().any(|(role, at)| *at == place && is_number(*role))
            || self.conditions.iter().any(|(_, at)| *at == place)
    }

    /// The place of a condition.
    pub(super) fn condition(&self, name: &str) -> Option<usize> {
        self.conditions.iter().find(|(own, _)| own == name).map(|(_, place)| *place)
    }

    /// The unit that the heading of a column states.
    pub(super) fn unit(&self, place: usize) -> Option<&UnitOfHeading> {
        self.units.iter().find(|(own, _)| *own == place).map(|(_, unit)| unit)
    }

    /// What the heading of a column says of the coverage.
    pub(super) fn coverage(&self, place: usize) -> HeaderCoverage {
        let found = self.coverages.iter().find(|(own, _)| *own == place);
        found.map_or(HeaderCoverage::None, |(_, coverage)| *coverage)
    }
}
