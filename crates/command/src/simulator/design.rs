//! Runs to be made elsewhere, as a table.

use gumption_emulator::SimulatorCase;
use gumption_report::csv_of_records;
use serde_json::json;

/// The column with the numbers of the runs.
pub(super) const RUN: &str = "run";

/// A table (CSV) of sets of parameters: a column `run` with numbers from `first` on, and a column for each
/// parameter with its unit, `length [m]`. Numbers are written so that they are read to the bit.
pub fn design(case: &SimulatorCase, batch: &[Vec<f64>], first: usize) -> String {
    let headings = case.parameters.iter().map(|parameter| match parameter.unit.as_str() {
        "1" => parameter.name.clone(),
        unit => format!("{} [{unit}]", parameter.name),
    });
    csv_of_records(|table| {
        table.write_record(std::iter::once(RUN.to_owned()).chain(headings))?;
        for (number, parameters) in batch.iter().enumerate() {
            let values = parameters.iter().map(|value| json!(value).to_string());
            table.write_record(std::iter::once((first + number).to_string()).chain(values))?;
        }
        Ok(())
    })
}
