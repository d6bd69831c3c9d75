//! A coordinate of the points of a calibration function.

use std::rc::Rc;

use super::super::conditions::unit;
use super::super::dates;
use super::super::dcc::{self, Certificates};
use super::super::keys;
use super::matrix;
use gumption_engine::fact::Fact;
use gumption_engine::regression::Spread;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::table::{self, Table};
use gumption_text::value_text::ValueOf;
use gumption_text::width::Width;
use gumption_text::{Collector, DiagnosticKind, Folder, column_heading};
use gumption_units::Unit;

/// The values of a coordinate in its unit, and their uncertainties.
pub(crate) struct Side {
    pub(crate) values: Vec<f64>,
    pub(crate) unit: Unit,
    /// Whether the file says the unit.
    pub(super) is_stated: bool,
    pub(super) spread: Spread,
    /// What is to be borne in mind about a certificate.
    pub(super) notes: Vec<Fact>,
}

/// The tables of a fit, each read once: both coordinates mostly are columns of one. Only the columns that the fit
/// names need be numbers.
pub(super) struct Tables<'f> {
    /// What the fit names.
    named: Vec<&'f str>,
    read: Vec<(String, Rc<Table>)>,
}

impl<'f> Tables<'f> {
    /// Of a fit with these coordinates, none of which was read yet. One that names no column is in that of its
    /// own name, which is one of `own`.
    pub(super) fn of(coordinates: [&'f Member; 2], own: &[&'static str]) -> Self {
        let named = coordinates.into_iter().flat_map(|member| member.value.texts());
        Self { named: own.iter().copied().chain(named).collect(), read: Vec::new() }
    }

    pub(super) fn read(
        &mut self,
        log: &Collector,
        name: &str,
        place: &std::ops::Range<usize>,
        folder: Folder<'_>,
        files: &mut Vec<(String, Vec<u8>)>,
    ) -> Option<Rc<Table>> {
        if let Some((_, known)) = self.read.iter().find(|(known, _)| known == name) {
            return Some(Rc::clone(known));
        }
        let origin = log.date_origin().unwrap_or_default();
        let (table, bytes) =
            table::read_dated(log, folder, name, place, Some(&self.named), Some(origin))?;
        if files.iter().all(|(known, _)| known != name) {
            files.push((name.to_owned(), bytes));
        }
        let table = Rc::new(table);
        self.read.push((name.to_owned(), Rc::clone(&table)));
        Some(table)
    }
}

/// Reads the coordinate `name`; tables that were read are added to `files`.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    name: &'static str,
    (folder, tables): (Folder<'_>, &mut Tables<'_>),
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Side> {
    let what = match name {
        "x" => "`x` of a fit",
        "y" => "`y` of a fit",
        _ => "a part of a complex `y`",
    };
    let object = Object::new(log, what, &member.value, &member.key_span)?;
    keys::check(&object, keys::POINTS);
    if let Some(member) = object.get("dcc") {
        return certified(&object, member, name, folder, files);
    }
    let unit = match object.get("unit") {
        None => Unit::one(),
        Some(_) => unit(&object, "unit")?,
    };
    let table = match object.get("file") {
        None => None,
        Some(member) => {
            Some(tables.read(log, object.text("file")?, &member.value.span, folder, files)?)
        }
    };
    let values = match (&table, object.get("values")) {
        (Some(_), Some(second)) => {
            let keys = "`values` and `file`";
            let reason = format!("{keys} are given; one of them has the points");
            let diagnostic = DiagnosticKind::Fit { name: name.to_owned(), reason };
            log.report(&second.key_span, diagnostic);
            return None;
        }
        (Some(table), None) => {
            let column = match object.get("column") {
                None => name,
                Some(_) => object.text("column")?,
            };
            let place = object.get("column").or(object.get("file"));
            let place = place.map_or(object.place(), |member| &member.value.span);
            column_of(log, table, name, column, place, (&unit, ValueOf::Quantity))?
        }
        (None, _) => {
            object.required("values")?;
            object.values("values", &unit, ValueOf::Quantity)?
        }
    };
    if values.is_empty() {
        object.report(DiagnosticKind::NoValues { name: name.to_owned() });
        return None;
    }
    let spread = spread(&object, name, &values, &unit, table.as_deref(), folder, files)?;
    let is_stated = object.get("unit").is_some();
    Some(Side { values, unit, is_stated, spread, notes: Vec::new() })
}

/// A coordinate from a table of a certificate, whose abscissae are exact.
fn certified(
    object: &Object<'_>,
    member: &Member,
    name: &'static str,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Side> {
    let log = object.log;
    let other = object.members().iter().find(|other| !["dcc", "about"].contains(&&*other.key));
    if let Some(other) = other {
        let reason =
            format!("`dcc` says unit, values and uncertainties; leave out `{}`", other.key);
        log.report(&other.key_span, DiagnosticKind::Fit { name: name.to_owned(), reason });
        return None;
    }
    let inner = Object::new(log, "`dcc`", &member.value, &member.key_span)?;
    keys::check(&inner, keys::CERTIFIED_TABLE);
    inner.required("at")?;
    let mut certificates = Certificates::default();
    let found = dcc::read(&inner, folder, &mut certificates)?;
    let (of_x, points) = found.table()?;
    for (name, content) in certificates.files {
        if files.iter().all(|(known, _)| *known != name) {
            files.push((name, content));
        }
    }
    let column = |at: usize| points.iter().map(|point| point[at]).collect();
    if name == "x" {
        let (values, spread) = (column(0), Spread::None);
        return Some(Side { values, unit: of_x, is_stated: true, spread, notes: Vec::new() });
    }
    let variances: Vec<f64> = points.iter().map(|point| point[2] * point[2]).collect();
    let is_exact = variances.iter().all(|variance| *variance == 0.0);
    let spread = if is_exact { Spread::None } else { Spread::Each(variances) };
    let notes = found.notes(name, inner.text("file").unwrap_or(""));
    Some(Side { values: column(1), unit: found.unit, is_stated: true, spread, notes })
}

/// A column of plain numbers of the table that a coordinate is in, if it has such a column.
pub(super) fn numbers_beside(
    log: &Collector,
    member: &Member,
    column: &Member,
    (folder, tables): (Folder<'_>, &mut Tables<'_>),
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Vec<f64>> {
    let object = Object::new(log, "a part of a complex `y`", &member.value, &member.key_span)?;
    let (Json::Text(name), Some(file)) = (&column.value.value, object.get("file")) else {
        let (key, found) = (column.key.clone(), column.value.value.kind());
        let what = format!("`{key}`");
        let expected = "a number, a list with one for each point, or a column of the file of y";
        log.report(&column.value.span, DiagnosticKind::WrongType { what, found, expected });
        return None;
    };
    let table = tables.read(log, object.text("file")?, &file.value.span, folder, files)?;
    let of = (&Unit::one(), ValueOf::Difference);
    column_of(log, &table, &column.key, name, &column.value.span, of)
}

/// A column of a table, for the coordinate `name`; `of` is what its values are, and their unit.
fn column_of(
    log: &Collector,
    table: &Table,
    name: &str,
    column: &str,
    place: &std::ops::Range<usize>,
    of: (&Unit, ValueOf),
) -> Option<Vec<f64>> {
    let Some(column) = table.column(column) else {
        let (name, reason) = (name.to_owned(), table.no_column(column));
        log.report(place, DiagnosticKind::Fit { name, reason });
        return None;
    };
    column_heading::check(log, place, &table.columns[column], of).then_some(())?;
    let factor = if table.are_days[column] { days_in(log, name, place, of)? } else { 1.0 };
    Some(table.rows.iter().filter_map(|row| row.get(column)).map(|value| factor * value).collect())
}

/// The length of a day in the unit of a column of dates, which must be of time.
fn days_in(
    log: &Collector,
    name: &str,
    place: &std::ops::Range<usize>,
    (unit, of): (&Unit, ValueOf),
) -> Option<f64> {
    let day = Unit::parse("d").ok().and_then(|day| Unit::conversion_factor(&day, unit).ok());
    let reason = match (day, of, log.date_origin()) {
        (Some(factor), ValueOf::Quantity, Some(_)) => return Some(factor),
        (Some(_), ValueOf::Quantity, None) => {
            format!("its column has dates; {}", dates::without_origin())
        }
        _ => format!(
            "its column has dates, which are numbers of days, but its unit is `{unit}`: write \
             `\"unit\": \"d\"` or `\"unit\": \"year\"`"
        ),
    };
    log.report(place, DiagnosticKind::Fit { name: name.to_owned(), reason });
    None
}

/// What is stated of the uncertainty.
fn spread(
    side: &Object<'_>,
    name: &str,
    values: &[f64],
    unit: &Unit,
    table: Option<&Table>,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Spread> {
    let log = side.log;
    match (side.get("standard_uncertainty"), side.get("covariance")) {
        (None, None) => Some(Spread::None),
        (Some(_), Some(second)) => {
            let reason = "`standard_uncertainty` and `covariance` are given; one of them is enough";
            let (name, reason) = (name.to_owned(), reason.to_owned());
            log.report(&second.key_span, DiagnosticKind::Fit { name, reason });
            None
        }
        (None, Some(member)) => {
            matrix::covariance(log, member, values.len(), folder, files).map(Spread::Joint)
        }
        (Some(member), None) => {
            let squares =
                |values: Vec<f64>| Some(Spread::Each(values.iter().map(|u| u * u).collect()));
            let column = |text: &str| table.filter(|table| table.column(text).is_some());
            let each = match &member.value.value {
                Json::List(_) => {
                    let each = side.values("standard_uncertainty", unit, ValueOf::Difference)?;
                    if each.len() != values.len() {
                        let reason = format!(
                            "there are {} standard uncertainties for {} values",
                            each.len(),
                            values.len()
                        );
                        let diagnostic = DiagnosticKind::Fit { name: name.to_owned(), reason };
                        log.report(&member.value.span, diagnostic);
                        return None;
                    }
                    each
                }
                Json::Text(text) if column(text).is_some() => {
                    let of = (unit, ValueOf::Difference);
                    column_of(log, column(text)?, name, text, &member.value.span, of)?
                }
                _ => {
                    let width =
                        Width::read(log, &member.value, name, "standard_uncertainty", unit, None);
                    let width = log.value(&member.value.span, width)?;
                    values.iter().map(|value| width.at(*value)).collect()
                }
            };
            if let Some(point) = each.iter().position(|u| *u < 0.0) {
                let (key, found) = ("standard_uncertainty".to_owned(), each[point]);
                log.report(&member.value.span, DiagnosticKind::NotPositive { key, found });
                return None;
            }
            squares(each)
        }
    }
}
