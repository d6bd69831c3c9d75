//! The tables of a certificate.

use super::CertificateReport;
use super::sentences::in_marks;
use super::stated::{self, StatedRow, UnitsAre};
use super::words::{self, Words, stacked};
use crate::number::{exact, rounded, significant};
use crate::plain;
use crate::printed::with_symbols;
use crate::sheet::{Figure, Sheet};
use gumption_engine::model::Quantity;
use gumption_engine::number::elementary::log10;
use gumption_units::Unit;

/// Maximum number of rows for which a page shows the matrix of correlation coefficients.
pub(super) const MOST_CORRELATED: usize = 12;

/// Decimal place of correlation coefficients (JCGM 100, 7.2.6).
const COEFFICIENT_PLACE: i32 = -3;

/// The result table.
pub(super) fn results(report: &CertificateReport<'_>) -> Sheet {
    let languages = &report.certificate.languages;
    let rows = stated::rows(report);
    let header = |word: fn(&Words) -> &'static str| stacked(languages, word);
    let mut sheet = Sheet::default();
    sheet.figures(&header(|w| w.row), rows.iter().map(StatedRow::numbered));
    sheet.text(&header(|w| w.quantity), rows.iter().map(|row| row.name(languages)));
    conditions(&mut sheet, report, &rows, &header(|w| w.conditions));
    if rows.iter().any(|row| row.line.nominal.is_some()) {
        sheet.figures(&header(|w| w.nominal), rows.iter().map(StatedRow::nominal));
    }
    sheet.figures(&header(|w| w.value), rows.iter().map(StatedRow::value));
    sheet.figures(&header(|w| w.expanded), rows.iter().map(StatedRow::expanded));
    let unit = |unit: &Unit| plain(with_symbols(unit).text());
    let of_values = rows.iter().map(|row| unit(&row.quantity.unit));
    sheet.units(&header(|w| w.unit), of_values);
    // a level has another unit than its differences
    if rows.iter().any(|row| row.quantity.unit.has_reference()) {
        let of_expanded = rows.iter().map(|row| unit(&row.quantity.unit.of_differences()));
        let header = format!("{} (U)", header(|w| w.unit));
        sheet.units(&header, of_expanded);
    }
    sheet.figures("k", rows.iter().map(StatedRow::factor));
    // degrees of freedom matter only if k follows from them
    if rows.iter().any(|row| !row.dof().text.is_empty()) {
        sheet.figures("ν_eff", rows.iter().map(StatedRow::dof));
    }
    sheet.figures(&header(|w| w.probability), rows.iter().map(StatedRow::percent));
    let ends: Vec<Option<[Figure; 2]>> = rows.iter().map(|row| row.interval(report)).collect();
    if ends.iter().any(Option::is_some) {
        let end = |place: usize| {
            let ends = ends.iter();
            ends.map(move |ends| match ends {
                Some(ends) => ends[place].clone(),
                None => Figure { text: String::new(), value: None },
            })
        };
        sheet.figures(&header(|w| w.low), end(0));
        sheet.figures(&header(|w| w.high), end(1));
    }
    sheet
}

/// Maximum number of conditions with a column of their own.
const MOST_COLUMNS: usize = 3;

/// A column for each condition, empty for rows without it, and one for replacements; for many
/// conditions, one column with all in words.
fn conditions(
    sheet: &mut Sheet,
    report: &CertificateReport<'_>,
    rows: &[StatedRow<'_>],
    header: &str,
) {
    let named = |quantity: &Quantity| match plain(with_symbols(&quantity.unit).text()).as_str() {
        "" | "1" => plain(&quantity.name),
        unit => {
            let unit = words::in_unit(&report.certificate.languages, unit);
            format!("{}\n{unit}", plain(&quantity.name))
        }
    };
    let mut names: Vec<String> = Vec::new();
    for (quantity, _) in rows.iter().flat_map(|row| row.shown(report)) {
        let name = named(quantity);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    if names.len() > MOST_COLUMNS {
        let text = |row: &StatedRow<'_>| {
            in_marks(
                report.certificate.decimal_mark,
                &row.circumstances(report, UnitsAre::Printed).join(", "),
            )
        };
        sheet.text(header, rows.iter().map(text));
        return;
    }
    let replaced = |row: &StatedRow<'_>| match row.line.label {
        Some(_) => String::new(),
        None => {
            in_marks(report.certificate.decimal_mark, &row.replaced(UnitsAre::Printed).join(", "))
        }
    };
    if rows.iter().any(|row| !replaced(row).is_empty()) {
        sheet.text(header, rows.iter().map(replaced));
    }
    for name in names {
        let value = |row: &StatedRow<'_>| {
            let shown = row.shown(report);
            match shown.iter().find(|(quantity, _)| named(quantity) == name) {
                Some((_, value)) => Figure::of(*value, exact(*value)),
                None => Figure { text: String::new(), value: None },
            }
        };
        sheet.figures(&name, rows.iter().map(value));
    }
}

/// The upper triangle of the correlation coefficients between the rows, with the standard
/// uncertainties to which they belong.
pub(super) fn correlations(report: &CertificateReport<'_>) -> Sheet {
    let matrix = &report.issued.correlations;
    let count = matrix.len();
    let mut sheet = Sheet::default();
    sheet.text("r", (1..=count).map(|row| row.to_string()));
    let spreads = report.issued.spreads.iter();
    let digits = report.certificate.digits + 1;
    sheet.figures("u_i", spreads.map(|u| Figure::rounded(*u, |u| significant(u, digits))));
    let rows = stated::rows(report);
    let units = rows.iter().map(|row| plain(with_symbols(&row.quantity.unit).text()));
    sheet.units(&stacked(&report.certificate.languages, |w| w.unit), units);
    for column in 1..count {
        let cells =
            matrix.iter().enumerate().map(|(row, coefficients)| match coefficients.get(column) {
                _ if row >= column => Figure { text: String::new(), value: None },
                Some(Some(r)) => coefficient(*r),
                _ => Figure::missing(),
            });
        sheet.figures(&(column + 1).to_string(), cells);
    }
    sheet
}

/// A correlation coefficient; one close to 1 keeps the digits in which it differs from 1.
fn coefficient(r: f64) -> Figure {
    let apart = 1.0 - r.abs();
    let place = if apart > 1e-9 && apart < 0.01 {
        log10(apart).floor() as i32 - 1
    } else {
        COEFFICIENT_PLACE
    };
    let text = rounded(r, place);
    Figure::of(text.parse().unwrap_or(r), text)
}

/// Whether some rows vary together.
pub(super) fn are_correlated(report: &CertificateReport<'_>) -> bool {
    let matrix = &report.issued.correlations;
    let seen = |r: &Option<f64>| r.is_some_and(|r| r.abs() >= 0.0005);
    matrix.iter().enumerate().any(|(i, row)| row.iter().take(i).any(seen))
}

/// The unrounded figures, for workbooks.
pub(super) fn unrounded(report: &CertificateReport<'_>) -> Sheet {
    let rows = stated::rows(report);
    let column = |value: fn(&StatedRow<'_>) -> Option<f64>| -> Vec<Figure> {
        rows.iter().map(|row| Figure::rounded(value(row), |value| value.to_string())).collect()
    };
    let mut sheet = Sheet::default();
    sheet.figures("row", rows.iter().map(StatedRow::numbered));
    sheet.text("quantity", rows.iter().map(|row| plain(&row.quantity.name)));
    sheet.units("unit", rows.iter().map(|row| plain(with_symbols(&row.quantity.unit).text())));
    sheet.figures("value", column(|row| Some(row.statement.value)));
    sheet.figures("standard uncertainty", column(|row| Some(row.statement.standard_uncertainty)));
    sheet.figures("expanded uncertainty", column(|row| Some(row.statement.expanded_uncertainty)));
    sheet.figures("coverage factor", column(|row| Some(row.statement.coverage_factor)));
    sheet.figures("interval from", column(|row| row.statement.interval.map(|ends| ends[0])));
    sheet.figures("interval to", column(|row| row.statement.interval.map(|ends| ends[1])));
    sheet.text("basis", rows.iter().map(|row| row.statement.basis.name().to_owned()));
    sheet
}
