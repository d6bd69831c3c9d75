//! The conditions of a measurement: a grid of values, or the rows of a table.

use std::collections::HashMap;
use std::ops::Range;

use super::keys;
use super::numbers_alone;
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::{Formula, FormulaError, Scope};
use gumption_gap::History;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::table::{self, Table};
use gumption_text::value_text::ValueOf;
use gumption_text::{Collector, DiagnosticKind, Folder, column_heading};
use gumption_units::Unit;

/// At most so many rows: a sweep of a million.
const MOST_ROWS: usize = 1_000_000;

/// Conditions with their rows of values, in their units.
#[derive(Clone, Debug, Default)]
pub(super) struct Conditions {
    pub(super) quantities: Vec<Quantity>,
    pub(super) places: Vec<Range<usize>>,
    pub(super) rows: Vec<Vec<f64>>,
    /// Between which values each can be set, in its unit, where the file says so.
    pub(super) reachable: Vec<Option<[f64; 2]>>,
    /// The tables read: name and content.
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// Names of those whose unit could not be read.
    pub(super) without_unit: Vec<String>,
    /// Names of those of which no unit is said, so that they are plain numbers.
    pub(super) unstated: Vec<String>,
    /// Those that follow from the order of the rows, and how many stand before them.
    pub(super) history: Vec<History>,
    pub(super) measured: usize,
    /// The place of the one that says when each row was taken.
    pub(super) clock: Option<usize>,
    /// Whether the rows could not be read, so that nothing is known of the conditions.
    pub(super) unreadable: bool,
}

impl Conditions {
    /// The only row of a file without conditions.
    pub(super) fn none() -> Self {
        Self { rows: vec![Vec::new()], ..Self::default() }
    }

    /// The rows of a table, without any condition.
    pub(super) fn rows_of(table: &Table) -> Self {
        Self { rows: vec![Vec::new(); table.rows.len()], ..Self::default() }
    }

    /// Whether a condition follows from the order of the rows.
    pub(super) fn is_history(&self, place: usize) -> bool {
        place.checked_sub(self.measured).is_some_and(|place| place < self.history.len())
    }

    /// A column of the data as a condition.
    pub(super) fn add_column(
        &mut self,
        table: &Table,
        name: &str,
        unit: Unit,
        named: &Range<usize>,
    ) {
        let place = table.column(name);
        self.places.push(named.clone());
        self.quantities.push(Quantity { name: name.to_owned(), unit, about: String::new() });
        self.reachable.push(None);
        for (row, data) in self.rows.iter_mut().zip(&table.rows) {
            row.push(place.and_then(|place| data.get(place)).copied().unwrap_or(f64::NAN));
        }
    }

    /// A condition with its unit, without values.
    fn add(&mut self, member: &Member, condition: &Object<'_>) {
        self.places.push(member.key_span.clone());
        if condition.get("unit").is_none() {
            self.unstated.push(member.key.clone());
        }
        let unit = unit(condition, "unit").unwrap_or_else(|| {
            self.without_unit.push(member.key.clone());
            Unit::one()
        });
        let about = condition.text("about").unwrap_or("").to_owned();
        self.reachable.push(reachable(condition, &member.key, &unit));
        self.quantities.push(Quantity { name: member.key.clone(), unit, about });
    }
}

/// The `range` of a condition: between which values it can be set.
fn reachable(condition: &Object<'_>, name: &str, unit: &Unit) -> Option<[f64; 2]> {
    let member = condition.get("range")?;
    let values = condition.values("range", unit, ValueOf::Quantity)?;
    if let [low, high] = values[..]
        && low < high
    {
        return Some([low, high]);
    }
    let name = name.to_owned();
    condition
        .log
        .report(&member.value.span, DiagnosticKind::ConditionRange { name, found: values });
    None
}

/// Reads `conditions`; paths are relative to `folder`. Conditions without values are columns of
/// `data`, whose rows are then those of the conditions.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    folder: Folder<'_>,
    data: Option<&Table>,
) -> Option<Conditions> {
    let object = Object::new(log, "`conditions`", &member.value, &member.key_span)?;
    let file = object.get("file").filter(|file| matches!(file.value.value, Json::Text(_)));
    match (file, data) {
        (Some(file), Some(_)) => {
            let reason = "the conditions of observations are columns of their table; in place of \
                          `file` give the columns by their names, with units";
            log.report(&file.key_span, DiagnosticKind::Observation { reason: reason.to_owned() });
            None
        }
        (Some(file), None) => from_table(&object, file, folder),
        (None, Some(data)) => columns_of(&object, data),
        (None, None) => grid(&object),
    }
}

/// The unit at `key`, a plain number if it is not there.
pub(super) fn unit(object: &Object<'_>, key: &str) -> Option<Unit> {
    let Some(text) = object.text(key) else {
        return object.get(key).is_none().then(Unit::one);
    };
    let span = object.get(key).map_or(object.place(), |member| &member.value.span);
    parse_unit(object.log, text, span)
}

pub(super) fn parse_unit(log: &Collector, text: &str, span: &Range<usize>) -> Option<Unit> {
    let parsed = log.unit(text);
    log.value(span, parsed.map_err(|error| DiagnosticKind::Unit { unit: text.to_owned(), error }))
}

/// The conditions in the rows of the data.
fn columns_of(object: &Object<'_>, data: &Table) -> Option<Conditions> {
    let log = object.log;
    let mut conditions = Conditions::default();
    let mut places = Vec::new();
    for member in object.members() {
        let Some(condition) = Object::new(log, "a condition", &member.value, &member.key_span)
        else {
            continue;
        };
        keys::check(&condition, keys::CONDITION);
        if let Some(values) = condition.get("values") {
            let reason = format!(
                "the condition `{}` has values of its own, but with observations it is the column of \
                 that name; take `values` out",
                member.key
            );
            log.report(&values.key_span, DiagnosticKind::Observation { reason });
        }
        let place = data.column(&member.key);
        if place.is_none() {
            let reason = format!("for this condition {}", data.no_column(&member.key));
            log.report(&member.key_span, DiagnosticKind::Table { reason });
        }
        places.push(place);
        conditions.add(member, &condition);
        let heading = place.and_then(|place| data.columns.get(place));
        if let (Some(heading), Some(added)) = (heading, conditions.quantities.last()) {
            let of = (&added.unit, ValueOf::Quantity);
            column_heading::check(log, &member.key_span, heading, of);
        }
    }
    conditions.rows = data
        .rows
        .iter()
        .map(|row| {
            let value = |place: &Option<usize>| place.and_then(|place| row.get(place)).copied();
            places.iter().map(|place| value(place).unwrap_or(1.0)).collect()
        })
        .collect();
    Some(conditions)
}

fn grid(object: &Object<'_>) -> Option<Conditions> {
    let log = object.log;
    let mut conditions = Conditions::default();
    let mut axes: Vec<Vec<f64>> = Vec::new();
    for member in object.members() {
        let Some(condition) = Object::new(log, "a condition", &member.value, &member.key_span)
        else {
            continue;
        };
        keys::check(&condition, keys::CONDITION);
        conditions.add(member, &condition);
        let unit =
            conditions.quantities.last().map_or_else(Unit::one, |quantity| quantity.unit.clone());
        let values = if condition.get("values").is_some() {
            condition.values("values", &unit, ValueOf::Quantity)
        } else {
            condition.report(DiagnosticKind::NoTable { name: member.key.clone() });
            None
        };
        if values.as_ref().is_some_and(Vec::is_empty) {
            condition.report(DiagnosticKind::NoValues { name: member.key.clone() });
        }
        // one value in the place of none, so that the inputs are checked all the same
        axes.push(values.filter(|values| !values.is_empty()).unwrap_or_else(|| vec![1.0]));
    }
    if axes.is_empty() {
        object.report(DiagnosticKind::NoValues { name: "conditions".into() });
    }
    let count = axes.iter().try_fold(1usize, |n, axis| n.checked_mul(axis.len()));
    let count = count.unwrap_or(usize::MAX);
    if count > MOST_ROWS {
        object.report(DiagnosticKind::TooMany {
            what: "rows of conditions",
            found: count,
            most: MOST_ROWS,
        });
        return None;
    }
    // the last condition is the fastest
    conditions.rows = (0..count)
        .map(|number| {
            let mut left = number;
            let mut row: Vec<f64> = axes
                .iter()
                .rev()
                .filter_map(|axis| {
                    let value = axis.get(left % axis.len().max(1)).copied();
                    left /= axis.len().max(1);
                    value
                })
                .collect();
            row.reverse();
            row
        })
        .collect();
    Some(conditions)
}

fn from_table(object: &Object<'_>, file: &Member, folder: Folder<'_>) -> Option<Conditions> {
    keys::check(object, keys::TABLE_OF_CONDITIONS);
    let log = object.log;
    let name = object.text("file")?;
    let wanted = object.get("columns").map(|member| member.value.texts());
    let table = table::read(log, folder, name, &file.value.span, wanted.as_deref());
    let units = match object.get("units") {
        Some(member) => Object::new(log, "`units`", &member.value, &member.key_span),
        None => None,
    };
    let (table, bytes) = table?;
    if table.rows.len() > MOST_ROWS {
        let found = table.rows.len();
        object.report(DiagnosticKind::TooMany {
            what: "rows of conditions",
            found,
            most: MOST_ROWS,
        });
        return None;
    }
    if let Some(units) = &units {
        for member in units.members() {
            if table.column(&member.key).is_none() {
                let reason = table.no_column(&member.key);
                log.report(&member.key_span, DiagnosticKind::Table { reason });
            }
        }
    }
    let table = match object.get("columns") {
        Some(member) => only(object, member, table)?,
        None => table,
    };
    let (mut without_unit, mut unstated) = (Vec::new(), Vec::new());
    let quantities: Vec<Quantity> = table
        .columns
        .iter()
        .map(|column| {
            let bare = column_heading::bare(column);
            let (name, unit) = match units.as_ref().filter(|units| units.get(bare).is_some()) {
                Some(units) => {
                    let unit = unit(units, bare).inspect(|unit| {
                        let place = units.get(bare).map_or(units.place(), |m| &m.value.span);
                        column_heading::check(log, place, column, (unit, ValueOf::Quantity));
                    });
                    (bare, unit)
                }
                None => match column_heading::heading(log, column) {
                    Some((name, unit)) => {
                        if name == column.trim() {
                            unstated.push(name.to_owned());
                        }
                        (name, Some(unit))
                    }
                    None => {
                        let reason = format!(
                            "the heading `{column}` names no unit that is known; a number other than 1 \
                             and a value are none"
                        );
                        log.report(&file.value.span, DiagnosticKind::Table { reason });
                        (bare, None)
                    }
                },
            };
            let unit = unit.unwrap_or_else(|| {
                without_unit.push(name.to_owned());
                Unit::one()
            });
            Quantity { name: name.to_owned(), unit, about: String::new() }
        })
        .collect();
    for (column, quantity) in quantities.iter().enumerate() {
        if let Some(first) =
            quantities[..column].iter().position(|other| other.name == quantity.name)
        {
            let [a, b] = [first, column].map(|place| &table.columns[place]);
            let reason =
                format!("the columns `{a}` and `{b}` both are the condition `{}`", quantity.name);
            log.report(&file.value.span, DiagnosticKind::Table { reason });
            return None;
        }
    }
    let places = vec![file.value.span.clone(); table.columns.len()];
    let (rows, files) = (table.rows, vec![(name.to_owned(), bytes)]);
    let reachable = vec![None; places.len()];
    Some(Conditions {
        quantities,
        places,
        rows,
        reachable,
        files,
        without_unit,
        unstated,
        ..Conditions::default()
    })
}

/// The table with only those columns that are wanted, in their order.
fn only(object: &Object<'_>, member: &Member, mut table: Table) -> Option<Table> {
    let nodes = object.list("columns")?;
    if nodes.is_empty() {
        object.log.report(&member.value.span, DiagnosticKind::NoValues { name: "columns".into() });
        return None;
    }
    let mut places = Vec::new();
    for node in nodes {
        let Json::Text(name) = &node.value else {
            let (what, found) = ("`columns`".to_owned(), node.value.kind());
            let expected = "a list of names of columns";
            object.log.report(&node.span, DiagnosticKind::WrongType { what, found, expected });
            return None;
        };
        match table.column(name) {
            Some(place) if places.contains(&place) => {
                let reason = format!("the column `{name}` is named twice");
                object.log.report(&node.span, DiagnosticKind::Table { reason });
                return None;
            }
            Some(place) => places.push(place),
            None => {
                let reason = table.no_column(name);
                object.log.report(&node.span, DiagnosticKind::Table { reason });
                return None;
            }
        }
    }
    table.columns = places.iter().map(|place| table.columns[*place].clone()).collect();
    for row in &mut table.rows {
        *row = places.iter().map(|place| row.get(*place).copied().unwrap_or(f64::NAN)).collect();
    }
    Some(table)
}

/// Whether two values of a condition are the same but for rounding.
pub(super) fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

/// What parameters of effects see of the conditions: nothing.
#[derive(Debug)]
pub(super) struct NoConditions;

impl super::condition_values::ConditionValues for NoConditions {
    fn rows(&self) -> usize {
        1
    }

    fn are_unreadable(&self) -> bool {
        false
    }

    fn check(
        &self,
        formula: &Formula,
        unit: &Unit,
        of: ValueOf,
    ) -> Result<(), Vec<DiagnosticKind>> {
        let kinds = |errors: Vec<FormulaError>| {
            errors.into_iter().map(|error| DiagnosticKind::Formula { error }).collect::<Vec<_>>()
        };
        formula.check_names(&Scope::new()).map_err(kinds)?;
        // of a coherent unit both readings are the same
        let kind = numbers_alone::mistake(formula, unit, of).filter(|_| unit.factor() != 1.0);
        kind.map_or(Ok(()), |kind| Err(vec![kind]))
    }

    fn values(
        &self,
        formula: &Formula,
        unit: &Unit,
        _: ValueOf,
    ) -> super::condition_values::ValuesOfRows<'_> {
        let value = formula.evaluate(&Scope::new(), &HashMap::<String, f64>::new());
        let value = unit.from_si(value.unwrap_or(f64::NAN));
        Box::new(move |_| value)
    }

    fn place(&self, _: &str) -> Option<usize> {
        None
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}
