//! One line for each row and frequency, as observations of a gap case and conditions of a model take
//! them: all cells are numbers, all headings are names of quantities with their unit, which those files
//! are held against.

use super::{FigureColumn, ObservationReport};
use crate::csv::{number, of_records};

/// The observations as comma-separated values: the conditions, the frequency in hertz, and for each
/// figure `NAME` its value and `u_NAME`, its standard uncertainty, where one is known; each with its
/// unit, `NAME [m/s^2]`. So for the frequency where it has one.
pub fn csv(observed: &ObservationReport<'_>) -> String {
    let figures = observed.figures();
    let conditions = observed.conditions.iter();
    let mut header: Vec<String> = conditions.map(|c| heading(&c.name, c.unit.text())).collect();
    header.push(heading(observed.frequency, "Hz"));
    let is_uncertain = observed.lines().any(|(_, channels)| observed.hertz(channels).1 > 0.0);
    if is_uncertain {
        header.push(heading(&format!("u_{}", observed.frequency), "Hz"));
    }
    let is_known = |of: &FigureColumn| of.values.iter().any(|(_, u)| u.is_some());
    for of in &figures {
        header.push(heading(&of.name, &of.unit));
        header.extend(is_known(of).then(|| heading(&format!("u_{}", of.name), &of.unit)));
    }
    of_records(|writer| {
        writer.write_record(&header)?;
        observed.lines().enumerate().try_for_each(|(line, (conditions, channels))| {
            let mut record: Vec<String> =
                conditions.iter().map(|value| number(Some(*value))).collect();
            let (hertz, u) = observed.hertz(channels);
            record.push(number(Some(hertz)));
            record.extend(is_uncertain.then(|| number(Some(u))));
            for figure in &figures {
                let (value, u) = figure.values.get(line).copied().unwrap_or((f64::NAN, None));
                record.push(number(Some(value)));
                record.extend(is_known(figure).then(|| number(u)));
            }
            writer.write_record(&record)
        })
    })
}

/// The heading of a column: its name and, unless its values are numbers, their unit.
pub(crate) fn heading(name: &str, unit: &str) -> String {
    if unit.is_empty() || unit == "1" { name.to_owned() } else { format!("{name} [{unit}]") }
}
