//! Runs as lines of JSON: a first line with the names of the parameters, then one for each run.

use std::error::Error;
use std::fmt;

use serde_json::{Value, json};

use crate::runs::{Run, RunHash, Runs};

/// A line of kept runs that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DamagedLine {
    /// Its number, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub reason: String,
}

impl fmt::Display for DamagedLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {} of the kept runs: {}", self.line, self.reason)
    }
}

impl Error for DamagedLine {}

impl Runs {
    /// The first line of a file of runs, with its end: `{"parameters":["length","drag"]}`.
    pub fn heading(&self) -> String {
        format!("{}\n", json!({ "parameters": self.names() }))
    }

    /// Reads runs that were kept, a line each behind the heading; blank lines are passed over.
    ///
    /// # Errors
    /// The first line that is damaged: no JSON of this form, a hash that is not that of the parameters, a
    /// run that was there before or does not fit the others.
    pub fn read(text: &str) -> Result<Self, DamagedLine> {
        let mut runs: Option<Self> = None;
        for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
            let damaged = |reason: String| DamagedLine { line: number + 1, reason };
            let value: Value =
                serde_json::from_str(line).map_err(|error| damaged(error.to_string()))?;
            match &mut runs {
                None => {
                    let names = texts(value.get("parameters")).ok_or_else(|| {
                        damaged("it does not name the parameters of the runs".to_owned())
                    })?;
                    runs = Some(Self::new(names));
                }
                Some(runs) => {
                    let run = run(&value).map_err(damaged)?;
                    runs.keep(run).map_err(|error| damaged(error.to_string()))?;
                }
            }
        }
        runs.ok_or_else(|| DamagedLine { line: 1, reason: "there is nothing".to_owned() })
    }
}

impl Run {
    /// A line of a file of runs, with its end: the hash and the values of the parameters, and the outputs or
    /// why there are none; of one that repeats others the number of the repetition as well. Numbers are written
    /// so that they are read to the bit.
    pub fn line(&self) -> String {
        let hash = RunHash::of(&self.parameters).to_string();
        let (key, result) = match &self.result {
            Ok(outputs) => ("outputs", json!(outputs)),
            Err(reason) => ("failed", json!(reason)),
        };
        let mut line = json!({ "hash": hash, "parameters": self.parameters, key: result });
        if self.repetition > 0 {
            line["repetition"] = json!(self.repetition);
        }
        format!("{line}\n")
    }
}

fn run(value: &Value) -> Result<Run, String> {
    let parameters = numbers(value.get("parameters")).ok_or("it has no values of `parameters`")?;
    let hash = value.get("hash").and_then(Value::as_str).ok_or("it has no `hash`")?;
    if hash != RunHash::of(&parameters).to_string() {
        return Err("its `hash` is not that of its parameters".to_owned());
    }
    let result = match (value.get("outputs"), value.get("failed")) {
        (Some(_), None) => {
            Ok(numbers(value.get("outputs")).ok_or("its `outputs` are not numbers")?)
        }
        (None, Some(Value::String(reason))) => Err(reason.clone()),
        _ => return Err("it has neither `outputs` nor a reason why it `failed`".to_owned()),
    };
    let repetition = match value.get("repetition") {
        None => 0,
        Some(number) => number
            .as_u64()
            .and_then(|number| usize::try_from(number).ok())
            .ok_or("its `repetition` is no number of a run, which is whole and not negative")?,
    };
    Ok(Run { parameters, repetition, result })
}

fn numbers(value: Option<&Value>) -> Option<Vec<f64>> {
    value?.as_array()?.iter().map(Value::as_f64).collect()
}

fn texts(value: Option<&Value>) -> Option<Vec<String>> {
    value?.as_array()?.iter().map(|text| text.as_str().map(str::to_owned)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text() -> String {
        let mut runs = Runs::new(vec!["a".to_owned(), "b".to_owned()]);
        let run = |a, b, result| Run { parameters: vec![a, b], repetition: 0, result };
        runs.keep(run(0.1, -0.0, Ok(vec![1.0 / 3.0, 5e-324]))).unwrap();
        runs.keep(run(1e300, 2.0, Err("exit code 3".to_owned()))).unwrap();
        runs.keep(Run { repetition: 1, ..run(0.1, -0.0, Ok(vec![0.25, 1.0])) }).unwrap();
        runs.made().iter().fold(runs.heading(), |text, run| text + &run.line())
    }

    #[test]
    fn runs_are_read_to_the_bit() {
        let text = text();
        let read = Runs::read(&text).unwrap();
        assert_eq!(read.names(), ["a", "b"]);
        assert_eq!(read.made()[0].parameters[1].to_bits(), (-0.0f64).to_bits());
        assert_eq!(read.made()[0].result, Ok(vec![1.0 / 3.0, 5e-324]));
        assert_eq!(read.find(&[1e300, 2.0]).unwrap().result, Err("exit code 3".to_owned()));
        assert_eq!(read.find_repetition(&[0.1, -0.0], 1).unwrap().result, Ok(vec![0.25, 1.0]));
        let again = read.made().iter().fold(read.heading(), |text, run| text + &run.line());
        assert_eq!(again, text);
    }

    #[test]
    fn damaged_lines_are_told_by_their_numbers() {
        let text = text();
        let lines: Vec<&str> = text.lines().collect();
        let error = |lines: &[&str]| Runs::read(&lines.join("\n")).unwrap_err();
        let cut = &lines[2][..lines[2].len() - 4];
        assert_eq!(error(&[lines[0], lines[1], cut]).line, 3);
        let changed = lines[1].replace("0.1", "0.2");
        let damaged = error(&[lines[0], "", &changed]);
        assert_eq!((damaged.line, damaged.reason.contains("hash")), (3, true));
        let twice = error(&[lines[0], lines[1], lines[1]]);
        assert_eq!((twice.line, twice.reason.contains("already")), (3, true));
        assert_eq!(error(&lines[1..]).line, 1);
        assert_eq!(error(&[]).line, 1);
        let negative = lines[3].replace("\"repetition\":1", "\"repetition\":-1");
        assert_eq!(error(&[lines[0], &negative]).line, 2);
        let missing = lines[2].replace("failed", "fails");
        assert_eq!(error(&[lines[0], &missing]).line, 2);
    }
}
