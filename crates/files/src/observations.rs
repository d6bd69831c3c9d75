//! The observations of a case: the table of the data, and which column holds what.

use gumption_engine::number::ascending;
use std::ops::Range;

use super::keys;
use gumption_engine::linalg::packed;
use gumption_gap::{MOST_GROUPS, ObservedOutput};
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::table::{self, Table};
use gumption_text::value_text::{ValueOf, with_plus_minus};
use gumption_text::width::{self, Width};
use gumption_text::{Collector, DiagnosticKind, Folder, Place};
use gumption_units::Unit;

/// The data's table with the columns of the observed outputs.
#[derive(Debug)]
pub(super) struct Observations {
    pub(super) table: Table,
    pub(super) columns: Vec<ObservedColumn>,
    /// The column that tells devices or days apart, and where it is named.
    pub(super) replication: Option<(String, Range<usize>)>,
    /// The column that says in which order the rows were taken.
    pub(super) order: Option<OrderColumn>,
    /// The content of the tables read, by name.
    pub(super) files: Vec<(String, Vec<u8>)>,
}

/// The column that says in which order the rows were taken, or when, and where it is named.
#[derive(Debug)]
pub(super) struct OrderColumn {
    pub(super) name: String,
    pub(super) place: Range<usize>,
    pub(super) is_time: bool,
}

/// What the table says of one output.
#[derive(Debug)]
pub(super) struct ObservedColumn {
    /// The headings that are named, with their places, and what their values are.
    pub(super) headings: Vec<(String, Range<usize>, ValueOf)>,
    pub(super) output: String,
    pub(super) place: Range<usize>,
    pub(super) observed: ObservedOutput,
    /// The column with somebody else's simulation of the output.
    pub(super) simulated: Option<String>,
    /// Standard uncertainties that are no columns: for all rows, or as they follow from the values.
    stated: Vec<StatedUncertainty>,
}

/// A standard uncertainty in place of a column, in the output's unit or in one of its own.
#[derive(Clone, Debug)]
struct StatedUncertainty {
    key: &'static str,
    value: Node,
    /// What shares of it are of.
    of: Vec<f64>,
}

impl ObservedColumn {
    /// What was measured of the output, whose unit is this; `None` after a mistake.
    pub(super) fn in_unit(&self, log: &Collector, unit: &Unit) -> Option<ObservedOutput> {
        let mut observed = self.observed.clone();
        for StatedUncertainty { key, value, of } in &self.stated {
            let width = Width::read(log, value, &self.output, key, unit, None)
                .map_err(|mistake| log.report(&value.span, mistake))
                .ok()?;
            let uncertainties: Vec<f64> = of.iter().map(|value| width.at(*value)).collect();
            if let Some(row) = uncertainties.iter().position(|u| *u <= 0.0) {
                let reason = format!(
                    "the standard uncertainty in row {} is 0, as a share of the value 0 there; add what it \
                     is at 0, such as `+ 0.001 {unit}`",
                    row + 1
                );
                log.report(&value.span, DiagnosticKind::Observation { reason });
                return None;
            }
            let place = match *key {
                UNCERTAINTY => &mut observed.standard_uncertainties,
                _ => &mut observed.simulation_uncertainties,
            };
            *place = Some(uncertainties);
        }
        Some(observed)
    }
}

const UNCERTAINTY: &str = "standard_uncertainty";
const OF_THE_SIMULATION: &str = "sim_standard_uncertainty";

/// Reads `observations`; paths are relative to `folder`. Of the columns of the data these are `wanted`.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    folder: Folder<'_>,
    wanted: &[&str],
) -> Option<Observations> {
    let object = Object::new(log, "`observations`", &member.value, &member.key_span)?;
    let are_known = keys::check(&object, keys::OBSERVATIONS);
    let table = data(&object, are_known, folder, wanted);
    let columns = object.required("columns");
    let (table, mut files) = table?;
    let columns = Object::new(log, "`columns`", &columns?.value, &member.key_span)?;
    let reader = ObservationsReader { log, folder, table: &table };
    let read: Vec<Option<ObservedColumn>> =
        columns.members().iter().map(|member| reader.column(member, &mut files)).collect();
    if read.is_empty() {
        columns.report(DiagnosticKind::NoValues { name: "columns".into() });
        return None;
    }
    let read = read.into_iter().collect::<Option<Vec<_>>>()?;
    once_each(log, columns.members(), &table);
    let replication = match object.get("replication") {
        Some(member) => Some((replication(&object, &table)?, member.value.span.clone())),
        None => None,
    };
    let order = order(&object, &table)?;
    Some(Observations { table, columns: read, replication, order, files })
}

/// The table of the data, from a file or from the case itself, and the content of the file;
/// `are_known` says that no key is misspelt.
#[allow(clippy::type_complexity)] // a table with the files that were read for it
fn data(
    object: &Object<'_>,
    are_known: bool,
    folder: Folder<'_>,
    wanted: &[&str],
) -> Option<(Table, Vec<(String, Vec<u8>)>)> {
    let [first, second] = ["file", "values"];
    match (object.get(first), object.get(second)) {
        (Some(file), None) => {
            let name = object.text(first)?;
            let (table, bytes) =
                table::read(object.log, folder, name, &file.value.span, Some(wanted))?;
            Some((table, vec![(name.to_owned(), bytes)]))
        }
        (None, Some(values)) => {
            table::of_lists(object.log, values, "`values`").map(|table| (table, Vec::new()))
        }
        (Some(_), Some(values)) => {
            object.log.report(&values.key_span, DiagnosticKind::Exclusive { first, second });
            None
        }
        // a misspelt key has been reported
        (None, None) if !are_known => None,
        (None, None) => {
            let reason = "`observations` needs the measured data: `file`, the name of a table, or \
                          `values`, the columns of one"
                .to_owned();
            object.report(DiagnosticKind::Observation { reason });
            None
        }
    }
}

/// The column that says in which order the rows were taken, or when; none where no key names one.
fn order(object: &Object<'_>, table: &Table) -> Option<Option<OrderColumn>> {
    let [first, second] = ["order", "time"];
    let member = match [first, second].map(|key| object.get(key)) {
        [Some(_), Some(other)] => {
            let diagnostic = DiagnosticKind::Exclusive { first, second };
            object.log.report(&other.key_span, diagnostic);
            return None;
        }
        [one, other] => one.or(other),
    };
    let Some(member) = member else { return Some(None) };
    let name = object.text(&member.key)?;
    if table.column(name).is_none() {
        let reason = table.no_column(name);
        object.log.report(&member.value.span, DiagnosticKind::Table { reason });
        return None;
    }
    let (name, place) = (name.to_owned(), member.value.span.clone());
    Some(Some(OrderColumn { name, place, is_time: member.key == second }))
}

/// The column that tells devices or days apart.
fn replication(object: &Object<'_>, table: &Table) -> Option<String> {
    let name = object.text("replication")?;
    let span = object.get("replication").map_or(object.place(), |member| &member.value.span);
    let report = |reason: String| {
        object.log.report(span, DiagnosticKind::Observation { reason });
    };
    let Some(place) = table.column(name) else {
        report(table.no_column(name));
        return None;
    };
    let mut groups: Vec<f64> =
        table.rows.iter().filter_map(|row| row.get(place).copied()).collect();
    ascending(&mut groups);
    groups.dedup();
    if !(2..=MOST_GROUPS).contains(&groups.len()) {
        report(format!(
            "different values in the column `{name}`: {}; units of replication are 2 to {MOST_GROUPS} \
             numbers, the same one in each row of a device or day",
            groups.len()
        ));
        return None;
    }
    Some(name.to_owned())
}

/// A column of the data says one thing: it holds measured values, uncertainties or a simulation of
/// one output.
fn once_each(log: &Collector, outputs: &[Member], table: &Table) {
    let mut known: Vec<(&str, &str, &str)> = Vec::new();
    for output in outputs {
        let Json::Object(fields) = &output.value.value else { continue };
        for field in fields.iter().filter(|field| field.key != "sim_covariance") {
            let Json::Text(column) = &field.value.value else { continue };
            if is_stated(&field.value, table) {
                continue;
            }
            let earlier = known.iter().find(|(name, ..)| name == column);
            // a standard uncertainty may be common to several outputs
            let shared = |key: &str| key.ends_with("standard_uncertainty") && key == field.key;
            if let Some((_, of, key)) = earlier.filter(|(_, _, key)| !shared(key)) {
                let reason = format!(
                    "the column `{column}` is `{key}` of `{of}` already, and cannot be `{}` of `{}`",
                    field.key, output.key
                );
                log.report(&field.value.span, DiagnosticKind::Observation { reason });
            }
            known.push((column, &output.key, &field.key));
        }
    }
}

/// Whether a standard uncertainty is stated in place of a column that has it.
fn is_stated(node: &Node, table: &Table) -> bool {
    let Json::Text(text) = &node.value else { return true };
    let text = with_plus_minus(text);
    let width = text.trim().trim_start_matches('±').trim_start();
    table.column(&text).is_none() && width::number(width).is_ok()
}

struct ObservationsReader<'a> {
    log: &'a Collector,
    folder: Folder<'a>,
    table: &'a Table,
}

impl ObservationsReader<'_> {
    fn column(
        &self,
        member: &Member,
        files: &mut Vec<(String, Vec<u8>)>,
    ) -> Option<ObservedColumn> {
        let object = Object::new(self.log, "an observed output", &member.value, &member.key_span)?;
        keys::check(&object, keys::OBSERVED);
        object.required("value")?;
        let values = self.values(&object, "value");
        let uncertainties = self.uncertainties(&object, UNCERTAINTY);
        let simulated = object.text("sim");
        let sims = match simulated {
            Some(_) => Some(self.values(&object, "sim")?),
            None => None,
        };
        let simulation = self.uncertainties(&object, OF_THE_SIMULATION);
        let covariance = self.covariance(&object, files);
        for key in ["sim_standard_uncertainty", "sim_covariance"] {
            if let (None, Some(member)) = (object.get("sim"), object.get(key)) {
                let reason = format!("`{key}` belongs to the column that `sim` names");
                self.log.report(&member.key_span, DiagnosticKind::Observation { reason });
            }
        }
        if object.get("sim_standard_uncertainty").is_some()
            && let Some(member) = object.get("sim_covariance")
        {
            let (first, second) = ("sim_standard_uncertainty", "sim_covariance");
            self.log.report(&member.key_span, DiagnosticKind::Exclusive { first, second });
        }
        let headings = [
            ("value", ValueOf::Quantity),
            (UNCERTAINTY, ValueOf::Difference),
            ("sim", ValueOf::Quantity),
            (OF_THE_SIMULATION, ValueOf::Difference),
        ];
        let is_column =
            |key: &str| object.get(key).is_some_and(|member| !is_stated(&member.value, self.table));
        let headings = headings.into_iter().filter_map(|(key, kind)| {
            is_column(key).then_some(())?;
            let named = object.text(key)?;
            let heading = self.table.column(named).map(|place| self.table.columns[place].as_str());
            Some((heading.unwrap_or(named).to_owned(), object.get(key)?.value.span.clone(), kind))
        });
        let values = values?;
        let of = [(UNCERTAINTY, Some(&values)), (OF_THE_SIMULATION, sims.as_ref())];
        let stated = of.into_iter().filter_map(|(key, values)| {
            let value = object.get(key).filter(|_| !is_column(key))?.value.clone();
            Some(StatedUncertainty { key, value, of: values?.clone() })
        });
        let stated = stated.collect();
        Some(ObservedColumn {
            stated,
            headings: headings.collect(),
            output: member.key.clone(),
            place: member.key_span.clone(),
            observed: ObservedOutput {
                values,
                last_digit: object
                    .text("value")
                    .and_then(|name| self.table.column(name))
                    .and_then(|place| self.table.last_digits.get(place).copied().flatten()),
                standard_uncertainties: uncertainties?,
                simulation_uncertainties: simulation?,
                simulation_covariance: covariance?,
            },
            simulated: simulated.map(str::to_owned),
        })
    }

    /// The column that `key` names.
    fn values(&self, object: &Object<'_>, key: &str) -> Option<Vec<f64>> {
        let name = object.text(key)?;
        if let Some(place) = self.table.column(name) {
            return Some(
                self.table.rows.iter().filter_map(|row| row.get(place).copied()).collect(),
            );
        }
        let reason = self.table.no_column(name);
        let span = object.get(key).map_or(object.place(), |member| &member.value.span);
        self.log.report(span, DiagnosticKind::Table { reason });
        None
    }

    /// A column of standard uncertainties, all above zero; none if the key is not there.
    fn uncertainties(&self, object: &Object<'_>, key: &str) -> Option<Option<Vec<f64>>> {
        // what is stated in place of a column is in the output's unit, which is not known yet
        if object.get(key).is_none_or(|member| is_stated(&member.value, self.table)) {
            return Some(None);
        }
        let values = self.values(object, key)?;
        if let Some((row, value)) = values.iter().enumerate().find(|(_, u)| **u <= 0.0) {
            let reason = if values.iter().all(|u| *u == 0.0) {
                "all standard uncertainties are zero; without the column the noise is estimated from \
                 the data"
                    .to_owned()
            } else {
                format!(
                    "the standard uncertainty in row {} is {value}, but must be above zero",
                    row + 1
                )
            };
            let column = object.text(key).unwrap_or_default();
            let place = self.place_of(column, row);
            self.log.report_at(place, DiagnosticKind::Observation { reason });
            return None;
        }
        Some(Some(values))
    }

    /// The line of a row of the data.
    fn place_of(&self, column: &str, row: usize) -> Place {
        let place = self.table.column(column).unwrap_or(0);
        self.table.place(row, place)
    }

    fn covariance(
        &self,
        object: &Object<'_>,
        files: &mut Vec<(String, Vec<u8>)>,
    ) -> Option<Option<Vec<Vec<f64>>>> {
        let Some(member) = object.get("sim_covariance") else {
            return Some(None);
        };
        let Json::Text(name) = &member.value.value else {
            object.text("sim_covariance")?;
            return None;
        };
        let (matrix, bytes) = table::read(self.log, self.folder, name, &member.value.span, None)?;
        files.push((name.clone(), bytes));
        let rows = self.table.rows.len();
        let square = matrix.rows.len() == rows && matrix.columns.len() == rows;
        let symmetric = square
            && (0..rows).all(|i| {
                (0..i).all(|j| {
                    let (a, b) = (matrix.rows[i][j], matrix.rows[j][i]);
                    (a - b).abs() <= 1e-9 * (matrix.rows[i][i] * matrix.rows[j][j]).abs().sqrt()
                })
            });
        if !symmetric {
            let reason = format!(
                "the covariance matrix `{name}` has {} rows and {} columns{}, but must be symmetric \
                 with one row and column for each of the {rows} rows of the data",
                matrix.rows.len(),
                matrix.columns.len(),
                if square { " and is not symmetric" } else { "" },
            );
            self.log.report(&member.value.span, DiagnosticKind::Observation { reason });
            return None;
        }
        if !is_covariance(&matrix.rows) {
            let reason = format!(
                "the matrix `{name}` is no covariance matrix: with some weights the variance of the \
                 rows' weighted sum would be negative"
            );
            self.log.report(&member.value.span, DiagnosticKind::Observation { reason });
            return None;
        }
        Some(Some(matrix.rows))
    }
}

/// Whether a symmetric matrix is positive semi-definite, but for the rounding of its numbers.
fn is_covariance(rows: &[Vec<f64>]) -> bool {
    let largest = rows.iter().enumerate().filter_map(|(i, row)| row.get(i)).copied();
    let largest = largest.fold(0.0, f64::max);
    let slack = 1e-8 * largest;
    let mut lower = Vec::with_capacity(packed::triangle(rows.len()));
    for (i, row) in rows.iter().enumerate() {
        let Some(row) = row.get(..=i) else { return false };
        lower.extend(row);
        if let Some(diagonal) = lower.last_mut() {
            *diagonal += slack;
        }
    }
    largest > 0.0 && packed::cholesky(&mut lower, 0.0).is_ok()
}

#[cfg(test)]
mod tests;
