//! Whether the columns of a table are those of results, and say one thing.

use super::ComparisonReader;
use super::headings::Role;

/// The columns that a table of pairs, and one of laboratories, needs.
const OF_PAIRS: &str = "label, x1, U1, x2, U2";
const OF_LABORATORIES: &str = "label, x, U";

/// What the rows of a table are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableKind {
    /// Two results.
    Pairs,
    /// One result, of which the other one comes from a run.
    AgainstRun,
    /// The result of a laboratory.
    Laboratories,
    /// The result of a participant, perhaps without an uncertainty.
    Proficiency,
}

impl TableKind {
    /// The numbers of the results that a row has.
    fn results(self) -> &'static [u8] {
        match self {
            Self::Pairs => &[1, 2],
            Self::AgainstRun => &[1],
            Self::Laboratories | Self::Proficiency => &[0],
        }
    }
}

impl ComparisonReader<'_> {
    /// Whether the columns of a table of this kind are there, and none that contradicts them.
    pub(super) fn check_columns(&self, kind: TableKind) -> Option<()> {
        let results = kind.results();
        let has = |role: Role| self.columns.has(role);
        let mut missing = Vec::new();
        if !has(Role::Label) {
            missing.push("label".to_owned());
        }
        for result in results {
            let number = if *result == 0 { String::new() } else { result.to_string() };
            if !has(Role::Value(*result)) {
                missing.push(format!("x{number}"));
            }
            let is_uncertain = has(Role::Expanded(*result)) || has(Role::Standard(*result));
            if !is_uncertain && kind != TableKind::Proficiency {
                missing.push(format!("U{number}"));
            }
        }
        if !missing.is_empty() {
            let kinds = match kind {
                TableKind::Proficiency => {
                    "a table of a proficiency test has label, x (and perhaps U, k)".to_owned()
                }
                _ => format!(
                    "a table of pairs has {OF_PAIRS} (and perhaps k1, k2, r), one of laboratories \
                     {OF_LABORATORIES} (and perhaps k), one of a proficiency test (`--scheme \
                     iso13528`) label, x (and perhaps U, k)"
                ),
            };
            self.fail(format!(
                "the table has no column {}; {kinds}. Words such as `Laboratory`, `Value`, `Standard \
                 uncertainty`, and `Lab value`, `U_lab`, `Ref. value`, `U_ref` are understood",
                missing.join(", ")
            ));
            return None;
        }
        let of_uncertainty = [Role::Expanded(0), Role::Standard(0)].into_iter().any(has);
        if let Some(place) = self.columns.place(Role::Factor(0)).filter(|_| !of_uncertainty)
            && kind == TableKind::Proficiency
        {
            let name = self.heading(place);
            self.fail(format!(
                "the column `{name}` is the coverage factor of an uncertainty, and the table has no \
                 column `U`: add it, or take the factors out"
            ));
            return None;
        }
        let is_of_pairs = matches!(kind, TableKind::Pairs | TableKind::AgainstRun);
        let stray = |result: u8| {
            [
                Role::Value(result),
                Role::Expanded(result),
                Role::Standard(result),
                Role::Factor(result),
            ]
        };
        let others: Vec<Role> = match is_of_pairs {
            true => stray(0).to_vec(),
            false => [stray(1), stray(2)].concat().into_iter().chain([Role::Correlation]).collect(),
        };
        let other = others.into_iter().chain(is_of_pairs.then_some(Role::Dof));
        let other = other.filter_map(|role| self.columns.place(role)).min();
        if let Some(place) = other {
            let (table, names) = if is_of_pairs {
                ("pairs", "label, x1, U1, x2, U2, k1, k2, r")
            } else {
                ("laboratories", "label, x, U, k")
            };
            let name = self.heading(place);
            self.fail(format!(
                "the column `{name}` does not belong to a table of {table}, which has {names}: take it out, \
                 or write `#` before its words"
            ));
            return None;
        }
        for result in results {
            self.check_factors(*result)?;
        }
        self.check_units(results)
    }

    /// Whether what is said of factors and degrees of freedom has one meaning.
    fn check_factors(&self, of: u8) -> Option<()> {
        let place = |role: Role| self.columns.place(role);
        let (expanded, factor) = (place(Role::Expanded(of)), place(Role::Factor(of)));
        if let (None, Some(u), Some(k)) = (expanded, place(Role::Standard(of)), factor) {
            self.fail(format!(
                "`{}` beside `{}` can be divided by it already or not: call the uncertainties `U` where \
                 they are still to be divided, or take the factors out",
                self.heading(u),
                self.heading(k)
            ));
            return None;
        }
        let is_of_probability = factor.is_none()
            && expanded.is_some_and(|place| self.columns.coverage(place).probability().is_some());
        if let Some(dof) = place(Role::Dof).filter(|_| of == 0 && !is_of_probability) {
            self.fail(format!(
                "`{}`: the comparison takes the standard uncertainties as known, without degrees of \
                 freedom; they tell the coverage factor where the heading of U states a probability, \
                 `U (95 %)`, and no factor is stated. Take the column out",
                self.heading(dof)
            ));
            return None;
        }
        Some(())
    }

    /// Whether all values and uncertainties have units, or none.
    fn check_units(&self, results: &[u8]) -> Option<()> {
        let roles = results.iter().flat_map(|result| {
            [Role::Value(*result), Role::Expanded(*result), Role::Standard(*result)]
        });
        let places: Vec<usize> = roles.filter_map(|role| self.columns.place(role)).collect();
        let of_cells = |place: usize| {
            (0..self.numbers.table.rows()).any(|row| self.numbers.has_unit(row, place))
        };
        let is_bare = |place: &&usize| self.columns.unit(**place).is_none() && !of_cells(**place);
        if self.columns.has(Role::Unit) {
            if let Some(with) = places.iter().find(|place| self.columns.unit(**place).is_some()) {
                let column = self.columns.place(Role::Unit).map_or("", |place| self.heading(place));
                self.fail(format!(
                    "`{}` states a unit, and the column `{column}` does: leave one of them",
                    self.heading(*with)
                ));
                return None;
            }
            return Some(());
        }
        let with = places.iter().find(|place| self.columns.unit(**place).is_some());
        if let (Some(with), Some(without)) = (with, places.iter().find(is_bare)) {
            let unit = self.columns.unit(*with).map_or("", |unit| unit.unit.text());
            self.fail(format!(
                "the column `{}` has the unit `{unit}` and `{}` none; write units into the headings of \
                 all values and uncertainties, or of none",
                self.heading(*with),
                self.heading(*without)
            ));
            return None;
        }
        let mut units = places.iter().filter_map(|place| Some((place, self.columns.unit(*place)?)));
        let first =
            units.clone().find(|(_, unit)| !unit.unit.is_relative()).or_else(|| units.next());
        let Some((_, first)) = first else { return Some(()) };
        for (place, unit) in units {
            let is_share = unit.unit.is_relative() && self.is_uncertainty(*place);
            if !is_share && !unit.unit.is_compatible(&first.unit) {
                self.fail(format!(
                    "`{}` cannot be converted to `{}`; write values and expanded uncertainties in units \
                     of one quantity, or uncertainties in % of the values",
                    self.heading(*place),
                    first.unit.text()
                ));
                return None;
            }
        }
        Some(())
    }

    fn is_uncertainty(&self, place: usize) -> bool {
        (0..3).any(|result| {
            let own = [Role::Expanded(result), Role::Standard(result)];
            own.into_iter().any(|role| self.columns.place(role) == Some(place))
        })
    }
}
