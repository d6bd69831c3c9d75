//! Tables that formulas interpolate in: `table(x, 'file.csv', 'x column', 'y column')`.

use std::ops::Range;
use std::sync::Arc;

use super::model_reader::Equation;
use super::scopes::place_in_formula;
use gumption_engine::decimal;
use gumption_engine::fact;
use gumption_engine::fact::Argument;
use gumption_engine::model::formula::{TableCall, TableData};
use gumption_engine::model::{Interpolation, InterpolationMethod, NumberForm, TableFault};
use gumption_engine::task::Warning;
use gumption_text::column_heading::heading;
use gumption_text::table::{self, Table};
use gumption_text::{Collector, DiagnosticKind, Folder};
use gumption_units::{Unit, nearest};

/// The tables of a file's equations, as formulas take them.
#[derive(Debug, Default)]
pub(super) struct Interpolated {
    /// Each table with what is known of it; nothing of one that could not be read.
    pub(super) tables: Vec<(TableCall, Option<TableData>)>,
    /// What is to be said of them.
    pub(super) notes: Vec<Warning>,
}

/// Reads the tables of all equations, each file once; its content is added to `files`.
pub(super) fn read(
    log: &Collector,
    folder: Folder<'_>,
    equations: &[Equation<'_>],
    form: NumberForm,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Interpolated {
    let mut found = Interpolated::default();
    let mut opened: Vec<(&TableCall, Option<Table>)> = Vec::new();
    for (quantity, member, formula) in equations {
        for call in formula.iter().flat_map(|formula| formula.tables()) {
            if found.tables.iter().any(|(known, _)| known.is_same(call)) {
                continue;
            }
            let named = member.map_or(0..0, |member| place_in_formula(log, member, &call.span));
            let is_read = |of: &TableCall| of.file == call.file && of.columns == call.columns;
            let known = opened.iter().position(|(source, _)| is_read(source));
            let known = known.unwrap_or_else(|| {
                let wanted =
                    call.columns.as_ref().map(|names| names.each_ref().map(String::as_str));
                let wanted = wanted.as_ref().map(<[&str; 2]>::as_slice);
                let read = table::read(log, folder, &call.file, &named, wanted);
                let table = read.map(|(table, bytes)| {
                    if files.iter().all(|(known, _)| *known != call.file) {
                        files.push((call.file.clone(), bytes));
                    }
                    table
                });
                opened.push((call, table));
                opened.len() - 1
            });
            let table = opened.get(known).and_then(|(_, table)| table.as_ref());
            let data = table.and_then(|table| of_columns(log, table, call, form, &named));
            if let Some(data) = &data {
                found.notes.push(note(quantity, call, data, form));
            }
            found.tables.push((call.clone(), data));
        }
    }
    found
}

fn of_columns(
    log: &Collector,
    table: &Table,
    call: &TableCall,
    form: NumberForm,
    named: &Range<usize>,
) -> Option<TableData> {
    let fault = |reason: String| log.report(named, DiagnosticKind::Table { reason });
    let headers: Vec<Option<(&str, Unit)>> =
        table.columns.iter().map(|column| heading(log, column)).collect();
    let place = |name: &str| {
        let is_it = |(text, header): (&String, &Option<(&str, Unit)>)| {
            text == name || header.as_ref().is_some_and(|(short, _)| *short == name)
        };
        table.columns.iter().zip(&headers).position(is_it)
    };
    let columns = match &call.columns {
        None if table.columns.len() < 2 => {
            fault(format!("`{}` has one column; a table needs two", call.file));
            return None;
        }
        None => [0, 1],
        Some(names) => {
            let mut places = [0; 2];
            for (slot, name) in places.iter_mut().zip(names) {
                let Some(found) = place(name) else {
                    let near = nearest(name, table.columns.iter().map(String::as_str));
                    fault(format!(
                        "`{}` has no column `{name}`{}",
                        call.file,
                        match near {
                            Some(near) => format!("; did you mean `{near}`?"),
                            None => format!("; its columns are {}", table.columns.join(", ")),
                        }
                    ));
                    return None;
                };
                *slot = found;
            }
            places
        }
    };
    let unit = |column: usize| {
        let unit = headers.get(column).and_then(Option::as_ref).map(|(_, unit)| unit.clone());
        if unit.is_none() {
            let name = table.columns.get(column).map_or("", String::as_str);
            fault(format!("`{name}` of `{}`: what stands in brackets is no unit", call.file));
        }
        unit
    };
    let units = [unit(columns[0])?, unit(columns[1])?];
    let is_stated = columns.map(|column| {
        let whole = table.columns.get(column).map(|text| text.trim());
        headers.get(column).and_then(Option::as_ref).map(|(name, _)| *name) != whole
    });
    let points: Vec<[f64; 2]> = table
        .rows
        .iter()
        .map(|row| {
            let at = |which: usize| {
                let value = row.get(columns[which]).copied().unwrap_or(f64::NAN);
                form.number(value, &units[which])
            };
            [at(0), at(1)]
        })
        .collect();
    let label = format!("table of `{}`", call.file);
    match Interpolation::new(label, &points, call.method) {
        Ok(interpolation) => Some(TableData { table: Arc::new(interpolation), units, is_stated }),
        Err(error) => {
            let reason = format!("`{}`: {error}", call.file);
            match error {
                TableFault::Repeated(row) | TableFault::Unsorted(row) => {
                    log.report_at(table.place(row, columns[0]), DiagnosticKind::Table { reason });
                }
                _ => fault(reason),
            }
            None
        }
    }
}

/// How values between the points are found, and what the way of it moves them by.
fn note(quantity: &str, call: &TableCall, data: &TableData, form: NumberForm) -> Warning {
    let [x, y] = &data.units;
    let given = |value: f64, unit: &Unit| match form {
        NumberForm::Declared => value,
        NumberForm::Coherent => unit.value_from_si(value),
    };
    let factor = match form {
        NumberForm::Declared => 1.0,
        NumberForm::Coherent => y.factor(),
    };
    let [low, high] = data.table.range().map(|end| decimal::significant(given(end, x), 6));
    let (low, high) = (Argument::Number(low), in_unit(high, x));
    let difference = decimal::significant(data.table.method_difference() / factor, 2);
    let difference = in_unit(difference, y);
    let (points, file) = (data.table.points(), &call.file);
    let fact = match call.method {
        InterpolationMethod::Cubic => {
            fact!("interpolated", quantity, points, file, low, high, difference)
        }
        InterpolationMethod::Linear => {
            fact!("interpolated.linear", quantity, points, file, low, high, difference)
        }
    };
    Warning::new(quantity, fact)
}

fn in_unit(number: String, unit: &Unit) -> Argument {
    let is_plain = unit.text().is_empty() || unit.text() == "1";
    Argument::Number(if is_plain { number } else { format!("{number} {unit}") })
}
