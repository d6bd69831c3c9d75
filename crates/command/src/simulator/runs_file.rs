//! A file of runs: a heading that says which case they belong to, then a line for each run.

use gumption_emulator::{Runs, SimulatorCase};
use gumption_units::listed;
use serde_json::{Value, json};

use crate::Failure;

/// The name of the file in its folder.
pub(super) const NAME: &str = "runs.jsonl";

/// The first line, with its end: the names of parameters and outputs, the hash of the case, and the command
/// of the simulator.
pub(super) fn heading(case: &SimulatorCase, simulator: &str) -> String {
    let heading = json!({
        "parameters": case.parameter_names(),
        "outputs": case.output_names(),
        "case": case.hash(),
        "simulator": simulator,
    });
    format!("{heading}\n")
}

/// The content of a file of runs.
#[derive(Debug)]
pub(super) struct RunsFile {
    /// `None` if there is not even a heading.
    pub(super) runs: Option<Runs>,
    /// The command in the heading.
    pub(super) simulator: Option<String>,
    /// Bytes up to the end of the last undamaged line.
    pub(super) whole: usize,
    /// What was dropped.
    pub(super) note: Option<String>,
}

/// Reads the runs of a case. A damaged last line, which was written when the process or the machine was
/// stopped, is dropped.
///
/// # Errors
/// Runs of another case; another damaged line.
pub(super) fn read(bytes: &[u8], shown: &str, case: &SimulatorCase) -> Result<RunsFile, Failure> {
    let failure = |message: String| Failure::Argument(format!("`{shown}`: {message}"));
    let dropped = || Some(format!("the last line of `{shown}` is damaged and is dropped"));
    let text = String::from_utf8_lossy(bytes);
    let last_line = start_of_last_line(bytes);
    let Some(first) = text.lines().next().filter(|_| !text.trim().is_empty()) else {
        return Ok(RunsFile { runs: None, simulator: None, whole: 0, note: None });
    };
    let Ok(heading) = serde_json::from_str::<Value>(first) else {
        if last_line == 0 {
            return Ok(RunsFile { runs: None, simulator: None, whole: 0, note: dropped() });
        }
        return Err(failure("its first line is not the heading of runs".to_owned()));
    };
    check(&heading, case).map_err(failure)?;
    let simulator = heading.get("simulator").and_then(Value::as_str).map(str::to_owned);
    let error = match Runs::read(&text) {
        Ok(runs) => {
            return Ok(RunsFile { runs: Some(runs), simulator, whole: bytes.len(), note: None });
        }
        Err(error) => error,
    };
    let before = String::from_utf8_lossy(&bytes[..last_line]);
    if error.line != before.lines().count() + 1 {
        return Err(failure(format!("line {} is damaged: {}", error.line, error.reason)));
    }
    let runs = Runs::read(&before).map_err(|error| failure(error.to_string()))?;
    Ok(RunsFile { runs: Some(runs), simulator, whole: last_line, note: dropped() })
}

/// The byte at which the last line that is not blank begins.
fn start_of_last_line(bytes: &[u8]) -> usize {
    let end = bytes.trim_ascii_end();
    end.iter().rposition(|byte| *byte == b'\n').map_or(0, |newline| newline + 1)
}

/// Compares a heading with that of the case.
fn check(heading: &Value, case: &SimulatorCase) -> Result<(), String> {
    let own = [("parameters", case.parameter_names()), ("outputs", case.output_names())];
    for (key, names) in own {
        if heading.get(key) != Some(&json!(names)) {
            let shown = |names: &[&str]| {
                let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
                if names.is_empty() { "none".to_owned() } else { listed(&names, " and ") }
            };
            let kept = heading.get(key).and_then(Value::as_array);
            let kept = kept.map(|names| names.iter().filter_map(Value::as_str).collect::<Vec<_>>());
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            return Err(format!(
                "its runs are of another case: their {key} are {}, but the case has {}",
                shown(&kept.unwrap_or_default()),
                shown(&names)
            ));
        }
    }
    if heading.get("case") != Some(&json!(case.hash())) {
        return Err("its runs are of another case: conditions or units differ".to_owned());
    }
    Ok(())
}
