//! One line for each row and frequency, as observations of a gap case and conditions of a model take
//! them: all cells are numbers, all names are names of quantities.

use super::Observed;
use crate::csv::number;

/// The observations as comma-separated values: the conditions, the frequency in hertz, and for each
/// figure `NAME` its value and `u_NAME`, its standard uncertainty.
pub fn csv(observed: &Observed<'_>) -> String {
    let figures = observed.figures();
    let mut header: Vec<String> = observed.conditions.iter().map(|c| c.name.clone()).collect();
    header.push(observed.frequency.to_owned());
    header.extend(figures.iter().flat_map(|of| [of.name.clone(), format!("u_{}", of.name)]));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut written = writer.write_record(&header);
    for (line, (conditions, channels)) in observed.lines().enumerate() {
        let mut record: Vec<String> = conditions.iter().map(|value| number(Some(*value))).collect();
        record.push(number(Some(observed.hertz(channels).0)));
        for figure in &figures {
            let (value, u) = figure.values.get(line).copied().unwrap_or((f64::NAN, f64::NAN));
            record.extend([number(Some(value)), number(Some(u))]);
        }
        written = written.and_then(|()| writer.write_record(&record));
    }
    // writing to memory cannot fail, and all records have as many cells
    debug_assert!(written.is_ok(), "{written:?}");
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}
