//! One line for each row of the table, as stated, for spreadsheets.

use super::CertificateReport;
use super::stated::{self, Stated, UnitsAre};
use crate::csv::{number, of_records, text};
use crate::table::comparison;

const COLUMNS: [&str; 15] = [
    "row",
    "quantity",
    "conditions",
    "nominal",
    "value",
    "expanded_uncertainty",
    "unit",
    "coverage_factor",
    "dof",
    "coverage_probability",
    "interval_low",
    "interval_high",
    "basis",
    "standard_uncertainty",
    "model",
];

/// The last column, if some row has a tolerance.
const DECISION: &str = "decision";

/// The rows as comma-separated values: value, expanded uncertainty, coverage factor and interval
/// rounded as stated, the standard uncertainty with all digits; if some row has a tolerance, the
/// decision `accepted` or `rejected`. An empty cell means infinite or undefined.
pub fn csv(report: &CertificateReport<'_>) -> String {
    of_records(|writer| {
        let rows = stated::rows(report);
        let decided = rows.iter().any(|row| row.conformity().is_some());
        let header = COLUMNS.into_iter().chain(decided.then_some(DECISION));
        writer.write_record(header)?;
        rows.iter().try_for_each(|row| {
            let decision = row.conformity().map_or("", |found| comparison::decision(&found));
            let cells = record(report, row).into_iter();
            writer.write_record(cells.chain(decided.then(|| decision.to_owned())))
        })
    })
}

fn record(report: &CertificateReport<'_>, row: &Stated<'_>) -> Vec<String> {
    let ends = row.interval(report).map(|ends| ends.map(|end| end.text));
    let [low, high] = ends.unwrap_or_default();
    vec![
        row.number.to_string(),
        text(&row.name(&report.certificate.languages)),
        text(&row.circumstances(report, UnitsAre::OfFile).join(", ")),
        number(row.line.nominal),
        row.value().text,
        row.expanded().text,
        text(row.quantity.unit.text()),
        row.factor().text,
        number(row.dof().value),
        number(row.statement.coverage_probability),
        low,
        high,
        row.statement.basis.name().to_owned(),
        number(Some(row.statement.standard_uncertainty)),
        text(&row.asked.model),
    ]
}
