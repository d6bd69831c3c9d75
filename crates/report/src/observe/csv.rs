//! One line for each row and frequency, as observations of a gap case and conditions of a model take
//! them: all cells are numbers, all names are names of quantities.

use super::ObservationReport;
use crate::csv::{number, of_records};

/// The observations as comma-separated values: the conditions, the frequency in hertz, and for each
/// figure `NAME` its value and `u_NAME`, its standard uncertainty.
pub fn csv(observed: &ObservationReport<'_>) -> String {
    let figures = observed.figures();
    let mut header: Vec<String> = observed.conditions.iter().map(|c| c.name.clone()).collect();
    header.push(observed.frequency.to_owned());
    header.extend(figures.iter().flat_map(|of| [of.name.clone(), format!("u_{}", of.name)]));
    of_records(|writer| {
        writer.write_record(&header)?;
        observed.lines().enumerate().try_for_each(|(line, (conditions, channels))| {
            let mut record: Vec<String> =
                conditions.iter().map(|value| number(Some(*value))).collect();
            record.push(number(Some(observed.hertz(channels).0)));
            for figure in &figures {
                let (value, u) = figure.values.get(line).copied().unwrap_or((f64::NAN, f64::NAN));
                record.extend([number(Some(value)), number(Some(u))]);
            }
            writer.write_record(&record)
        })
    })
}
