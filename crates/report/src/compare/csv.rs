//! One line for each comparison, in full precision, for spreadsheets.

use super::{Compare, gauge, proficiency};
use crate::csv::{number, of_records, text};

/// The rows as comma-separated values; for laboratories those of the degrees of equivalence.
pub fn csv(compare: &Compare) -> String {
    let mut records: Vec<Vec<String>> = Vec::new();
    let header = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let numbers = |values: &[f64]| -> Vec<String> {
        values.iter().map(|value| number(Some(*value))).collect()
    };
    match compare {
        Compare::Pairs { compared, units, rounding, .. } => {
            let mut names = vec!["label", "difference", "U", "en", "zeta", "probability"];
            names.extend(rounding.then_some(["range_low", "range_high"]).into_iter().flatten());
            names.extend(["compatible", "unit"]);
            records.push(header(&names));
            for (row, unit) in compared.iter().zip(units) {
                let figures =
                    [row.difference, row.expanded, row.normalized_error, row.zeta, row.probability];
                let mut record = vec![text(&row.label)];
                record.extend(numbers(&figures));
                record.extend(numbers(if *rounding { &row.range } else { &[] }));
                record.push(row.is_compatible().to_string());
                record.push(text(unit));
                records.push(record);
            }
        }
        Compare::Laboratories { comparison, unit } => {
            records.push(header(&[
                "label",
                "x",
                "difference",
                "U",
                "en",
                "zeta",
                "probability",
                "compatible",
                "in_reference",
                "unit",
            ]));
            for row in &comparison.rows {
                let mut record = vec![text(&row.label)];
                record.extend(numbers(&[
                    row.value,
                    row.difference,
                    row.expanded,
                    row.normalized_error,
                    row.zeta,
                    row.probability,
                ]));
                record.push(row.is_compatible().map_or_else(String::new, |is| is.to_string()));
                record.push(row.member.to_string());
                record.push(text(unit));
                records.push(record);
            }
        }
        Compare::Proficiency { test, unit } => records = proficiency::records(test, unit),
        Compare::Gauge { study, unit } => records = gauge::records(study, unit),
    }
    of_records(|writer| records.iter().try_for_each(|record| writer.write_record(record)))
}
