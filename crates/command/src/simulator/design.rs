//! Runs to be made elsewhere, as a table.

use gumption_emulator::SimulatorCase;
use serde_json::json;

/// The column with the numbers of the runs.
pub(super) const RUN: &str = "run";

/// A table (CSV) of sets of parameters: a column `run` with numbers from `first` on, and a column for each
/// parameter with its unit, `length [m]`. Numbers are written so that they are read to the bit.
pub fn design(case: &SimulatorCase, batch: &[Vec<f64>], first: usize) -> String {
    let headings = case.parameters.iter().map(|parameter| match parameter.unit.as_str() {
        "1" => cell(&parameter.name),
        unit => cell(&format!("{} [{unit}]", parameter.name)),
    });
    let mut table = std::iter::once(RUN.to_owned()).chain(headings).collect::<Vec<_>>().join(",");
    table.push('\n');
    for (number, parameters) in batch.iter().enumerate() {
        let values = parameters.iter().map(|value| json!(value).to_string());
        let number = (first + number).to_string();
        table += &std::iter::once(number).chain(values).collect::<Vec<_>>().join(",");
        table.push('\n');
    }
    table
}

/// A cell, in quotes if it needs them (RFC 4180, 2).
fn cell(text: &str) -> String {
    if text.contains([',', ';', '"', '\n', '\t']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
