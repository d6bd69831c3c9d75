//! Runs that were made elsewhere, in a folder.

use std::path::Path;

use gumption_columns::heading::named;
use gumption_columns::read_failure;
use gumption_emulator::{Run, RunResult, Runs, SimulatorCase, SimulatorQuantity};
use gumption_text::table::{self, Table};
use gumption_text::{Diagnostic, Diagnostics, SourceText, bytes};

use super::answer;
use super::design::RUN;
use super::runs_file::{self, NAME, RunsFile};
use crate::Failure;

/// The table of the parameters.
const PARAMETERS: &str = "parameters.csv";

/// The largest answer of a run, in bytes.
const MOST_OF_ANSWER: u64 = bytes::MOST_OF_SAMPLES;

/// Runs that were made elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct MadeRuns {
    /// The runs, also those that failed.
    pub runs: Runs,
    /// What the user should know: a damaged last line, runs without a file.
    pub notes: Vec<String>,
}

/// Reads the runs of a case in a folder. It has either the file `runs.jsonl` of kept runs, or a table
/// `parameters.csv`, as [`design`](super::design) writes it, with a file for each run: `7.json` for run 7
/// with what a program writes, or `7.csv` with a column for each output. A run whose file has anything else
/// has failed; a run without a file was not made. Runs with the same parameters are repetitions in the order of the
/// table.
///
/// # Errors
/// There is neither of the files, or it cannot be read; kept runs of another case; a table without one of the
/// parameters, in another unit, or with a number of a run that is no whole number.
pub fn made(folder: &Path, case: &SimulatorCase) -> Result<MadeRuns, Failure> {
    let kept = folder.join(NAME);
    if kept.is_file() {
        let name = kept.display().to_string();
        let bytes = std::fs::read(&kept).map_err(|error| {
            let reason = read_failure::of_file(&kept, &error);
            Failure::System(format!("`{name}`: {reason}"))
        })?;
        let RunsFile { runs, note, .. } = runs_file::read(&bytes, &name, case)?;
        let runs = runs.unwrap_or_else(|| Runs::new(case.parameter_names()));
        return Ok(MadeRuns { runs, notes: note.into_iter().collect() });
    }
    let path = folder.join(PARAMETERS);
    let name = path.display().to_string();
    if !path.is_file() {
        let folder = folder.display();
        return Err(Failure::Argument(format!("`{folder}` has neither {NAME} nor {PARAMETERS}")));
    }
    let columns = std::iter::once(RUN).chain(case.parameters.iter().map(|of| of.name.as_str()));
    let table = read_table(&path, &columns.collect::<Vec<_>>())?;
    let numbers = table.column(RUN).ok_or_else(|| Failure::Argument(table.no_column(RUN)))?;
    let places = columns_of(&table, &case.parameters).map_err(Failure::Argument)?;
    let mut runs = Runs::new(case.parameter_names());
    let mut missing = Vec::new();
    for row in &table.rows {
        let number = row[numbers];
        if number.fract() != 0.0 || !(1.0..=1e15).contains(&number) {
            return Err(Failure::Argument(format!(
                "`{name}`: a run has the number {number}, but must have a whole number from 1 on"
            )));
        }
        let parameters: Vec<f64> = places.iter().map(|place| row[*place]).collect();
        let Some(result) = result(folder, number as u64, case) else {
            missing.push(format!("{number}"));
            continue;
        };
        let repetition = runs.repetitions(&parameters);
        runs.keep(Run { parameters, repetition, result })
            .map_err(|error| Failure::Argument(format!("`{name}`: run {number}: {error}")))?;
    }
    Ok(MadeRuns { runs, notes: missing_note(&missing).into_iter().collect() })
}

/// The note about runs of the table that have no file.
fn missing_note(missing: &[String]) -> Option<String> {
    const NAMED: usize = 5;
    let named = missing.get(..NAMED).unwrap_or(missing).join(", ");
    let more = if missing.len() > NAMED { ", ..." } else { "" };
    (!missing.is_empty())
        .then(|| format!("{} runs of {PARAMETERS} have no file: {named}{more}", missing.len()))
}

/// The result of a run; `None` if there is no file.
fn result(folder: &Path, number: u64, case: &SimulatorCase) -> Option<RunResult> {
    let json = format!("{number}.json");
    if folder.join(&json).is_file() {
        let read = bytes::of_file(&folder.join(&json), MOST_OF_ANSWER);
        return Some(match read {
            Ok(read) => answer::outputs(&read, &format!("`{json}`"), case),
            Err(error) => Err(format!("`{json}`: {error}")),
        });
    }
    let csv = folder.join(format!("{number}.csv"));
    csv.is_file().then(|| outputs_of_table(&csv, case))
}

fn outputs_of_table(path: &Path, case: &SimulatorCase) -> RunResult {
    let names: Vec<&str> = case.outputs.iter().map(|output| output.name.as_str()).collect();
    let table = read_table(path, &names).map_err(|failure| match failure {
        Failure::Diagnostics(all) => all.to_string(),
        Failure::Argument(message) | Failure::System(message) => message,
    })?;
    let places = columns_of(&table, &case.outputs)?;
    if table.rows.len() != case.rows {
        let name = &case.outputs.first().map_or(String::new(), |output| output.name.clone());
        return Err(answer::length(name, table.rows.len(), case.rows));
    }
    Ok(places.iter().flat_map(|place| table.rows.iter().map(|row| row[*place])).collect())
}

/// The columns of quantities, whose headings may have their units.
fn columns_of(table: &Table, quantities: &[SimulatorQuantity]) -> Result<Vec<usize>, String> {
    let column = |quantity: &SimulatorQuantity| {
        let SimulatorQuantity { name, unit } = quantity;
        let place = table.column(name).ok_or_else(|| table.no_column(name))?;
        let heading = &table.columns[place];
        let stated = named(heading).filter(|_| heading != name).map(|(_, stated)| stated);
        match stated.filter(|stated| stated != unit) {
            Some(_) => Err(format!(
                "`{}` has the column `{heading}`, but must have `{name}` in {unit}",
                table.name
            )),
            None => Ok(place),
        }
    };
    quantities.iter().map(column).collect()
}

fn read_table(path: &Path, wanted: &[&str]) -> Result<Table, Failure> {
    let name = path.display().to_string();
    let unreadable = |message: String| Failure::System(format!("`{name}`: {message}"));
    let read = bytes::of_file(path, bytes::MOST).map_err(unreadable)?;
    let text =
        bytes::text(&read).map_err(|message| Failure::Argument(format!("`{name}`: {message}")))?;
    table::parse(&SourceText::new(name.clone(), &text), Some(wanted)).map_err(|errors| {
        let placed = errors.into_iter();
        let placed =
            placed.map(|(place, kind)| Diagnostic { source: place.source, span: place.span, kind });
        Failure::Diagnostics(Diagnostics(placed.collect()))
    })
}
