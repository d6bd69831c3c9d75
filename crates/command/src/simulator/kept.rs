//! Runs in a folder, each of which is written as soon as it ends, so that no run is made twice.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use gumption_columns::read_failure;
use gumption_emulator::{Run, RunKey, RunResult, Runs, Simulator, SimulatorCase};

use super::runs_file::{NAME, RunsFile, heading, read};
use crate::{Failure, signals};

/// The runs of a case.
#[derive(Debug)]
pub struct KeptRuns {
    case: SimulatorCase,
    runs: Runs,
    file: Option<KeptFile>,
}

/// The file to which runs are appended, a line each.
#[derive(Debug)]
struct KeptFile {
    path: PathBuf,
    file: File,
}

impl KeptRuns {
    /// No runs yet, which are written nowhere.
    pub fn in_memory(case: SimulatorCase) -> Self {
        Self { runs: Runs::new(case.parameter_names()), case, file: None }
    }

    /// These runs, and those to come, which are written nowhere.
    pub fn of(case: SimulatorCase, runs: Runs) -> Self {
        Self { case, runs, file: None }
    }

    /// The runs in a folder, to whose file `runs.jsonl` all later ones are appended; folder and file are made
    /// if they do not exist. The second value are notes: a last line that was written in part is dropped, and
    /// runs of another `simulator`, which is the command, are kept.
    ///
    /// # Errors
    /// The file cannot be read or written, another process uses it, it has runs of another case, or a
    /// line before the last one is damaged.
    pub fn open(
        folder: &Path,
        case: SimulatorCase,
        simulator: &str,
    ) -> Result<(Self, Vec<String>), Failure> {
        let path = folder.join(NAME);
        let shown = path.display().to_string();
        let system = |error: io::Error| {
            Failure::System(format!("`{shown}`: {}", read_failure::in_words(&error)))
        };
        std::fs::create_dir_all(folder).map_err(system)?;
        let options = &mut OpenOptions::new();
        let mut file = options.read(true).append(true).create(true).open(&path).map_err(system)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::Error(error)) => return Err(system(error)),
            Err(TryLockError::WouldBlock) => {
                return Err(Failure::System(format!("`{shown}` is in use by another program")));
            }
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(system)?;
        let RunsFile { runs, simulator: before, whole, note } = read(&bytes, &shown, &case)?;
        let mut notes: Vec<String> = note.into_iter().collect();
        if let Some(before) = before.filter(|before| before != simulator) {
            notes.push(format!(
                "the runs in `{shown}` were made by `{before}`, further runs are made by `{simulator}`"
            ));
        }
        let kept = KeptFile { path, file };
        kept.file.set_len(whole as u64).map_err(system)?;
        if runs.is_none() {
            kept.append(&heading(&case, simulator))?;
        } else if !bytes[..whole].ends_with(b"\n") {
            kept.append("\n")?;
        }
        let runs = runs.unwrap_or_else(|| Runs::new(case.parameter_names()));
        Ok((Self { case, runs, file: Some(kept) }, notes))
    }

    /// The runs, in the order in which they ended.
    pub fn runs(&self) -> &Runs {
        &self.runs
    }

    /// Whether each run is written to a folder.
    pub fn are_kept(&self) -> bool {
        self.file.is_some()
    }

    /// The results of all runs, in their order. Only the runs that were not made before are
    /// made now, each of them once; `None` for those that a stop left out. A result with a wrong number of
    /// values is a failed run.
    ///
    /// # Errors
    /// A parameter is no finite number, or a run cannot be written.
    pub fn results(
        &mut self,
        simulator: &dyn Simulator,
        batch: &[RunKey],
    ) -> Result<Vec<Option<RunResult>>, Failure> {
        let find = |runs: &Runs, key: &RunKey| {
            let run = runs.find_repetition(&key.parameters, key.repetition);
            run.map(|run| run.result.clone())
        };
        let mut missing: Vec<&RunKey> = Vec::new();
        for key in batch {
            if find(&self.runs, key).is_none() && !missing.contains(&key) {
                missing.push(key);
            }
        }
        let sets: Vec<Vec<f64>> = missing.iter().map(|key| key.parameters.clone()).collect();
        let mut kept = Ok(());
        let case = self.case.clone();
        simulator.run(&sets, &case, &mut |index, result| {
            let RunKey { parameters, repetition } = missing[index].clone();
            kept = self.keep(Run { parameters, repetition, result });
            if kept.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        kept?;
        Ok(batch.iter().map(|key| find(&self.runs, key)).collect())
    }

    fn keep(&mut self, mut run: Run) -> Result<(), Failure> {
        let values = self.case.rows * self.case.outputs.len();
        if let Some(found) = run.result.as_ref().ok().map(Vec::len).filter(|len| *len != values) {
            run.result = Err(format!("the run has {found} values instead of {values}"));
        }
        let kept = self.runs.keep(run).map_err(|error| Failure::System(error.to_string()))?;
        let line = kept.line();
        self.file.as_ref().map_or(Ok(()), |file| file.append(&line))
    }
}

impl KeptFile {
    /// Appends a text at once; no signal ends the process in between.
    fn append(&self, text: &str) -> Result<(), Failure> {
        let _whole = signals::whole();
        (&self.file).write_all(text.as_bytes()).map_err(|error| {
            Failure::System(format!("cannot write `{}`: {error}", self.path.display()))
        })
    }
}
