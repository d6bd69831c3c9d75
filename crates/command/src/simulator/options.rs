//! Options of a diagnosis whose sim is a program.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use clap::Args;
use gumption_emulator::SimulatorCase;
use gumption_engine::task::Row;
use gumption_gap::Case;
use gumption_gap::simulated::{self, PREDICTION_RUNS, simulator_case};

use super::{KeptRuns, MadeRuns, Program, SimulatedCase, design, made};
use crate::Failure;
use crate::options::Threads;
use crate::output::Destination;

/// Runs of a simulator if no number is given.
const RUNS: usize = 300;

/// The simulator of a case.
#[derive(Debug, Args)]
pub(crate) struct SimulatorOptions {
    /// Program that computes the outputs: it is started for each run, reads parameters and conditions
    /// as JSON on standard input, and writes outputs as JSON on standard output. COMMAND is split into
    /// words as in a shell, but started without one
    #[arg(long, value_name = "COMMAND")]
    simulator: Option<String>,
    /// Start the simulator once for many runs: it reads a line of JSON for each run, and writes a line
    /// for each answer
    #[arg(long, requires = "simulator")]
    simulator_lines: bool,
    /// Maximum number of runs of the simulator [default: 300]
    #[arg(long, value_name = "N", value_parser = runs)]
    runs: Option<usize>,
    /// Write each run to FOLDER as soon as it ends, and use the runs that are there
    #[arg(long, value_name = "FOLDER", requires = "simulator")]
    keep: Option<PathBuf>,
    /// Use the runs in FOLDER, and make none: kept runs, or parameters.csv with a file for each run,
    /// 1.json or 1.csv. With --design, the runs that would tell more are written
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["simulator", "predict"])]
    made: Option<PathBuf>,
    /// Write the parameters of runs to be made elsewhere to FILE (CSV), and without --made diagnose nothing
    #[arg(long, value_name = "FILE", conflicts_with_all = ["simulator", "predict"])]
    design: Option<PathBuf>,
    /// End a run that takes longer, with all processes that it started (on Windows the program alone);
    /// it has then failed
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "simulator")]
    run_timeout: Option<Duration>,
}

impl SimulatorOptions {
    /// The file to which a design is written.
    pub(crate) fn design(&self) -> Option<&Path> {
        self.design.as_deref()
    }

    /// Whether nothing is done but a design.
    pub(crate) fn is_design_alone(&self) -> bool {
        self.design.is_some() && self.made.is_none()
    }

    /// Writes the runs to be made before anything is known.
    pub(crate) fn write_design(
        &self,
        case: &Case,
        seed: u64,
        file: Destination,
    ) -> Result<(), Failure> {
        if case.simulator.is_none() {
            return Err(self.without_simulator());
        }
        let runs = simulated::design(case, self.budget(), seed);
        let runs = runs.map_err(|error| Failure::Argument(error.to_string()))?;
        let sets: Vec<Vec<f64>> = runs.into_iter().map(|run| run.parameters).collect();
        self.write_runs(case, &sets, 1, file)
    }

    /// Writes runs to be made, numbered from `first` on.
    pub(crate) fn write_runs(
        &self,
        case: &Case,
        sets: &[Vec<f64>],
        first: usize,
        file: Destination,
    ) -> Result<(), Failure> {
        let Some(given) = simulator_case(case, &case.task.rows) else {
            return Err(self.without_simulator());
        };
        let table = design(&given, sets, first);
        file.write_with(|out| out.write_all(table.as_bytes()).map(|()| true))
    }

    /// The simulator with the runs that were made before, and notes about them; `None` for a case
    /// without a simulator.
    ///
    /// # Errors
    /// A case with a simulator for which there is neither a program nor runs, a case without one for which
    /// there are; a command without words; runs that cannot be read or kept.
    pub(crate) fn simulated(
        &self,
        case: &Case,
        threads: &Threads,
        stop: &Arc<AtomicBool>,
    ) -> Result<Option<(SimulatedCase, Vec<String>)>, Failure> {
        let Some(given) = simulator_case(case, &case.task.rows) else {
            let is_asked = self.simulator.is_some() || self.made.is_some();
            return if is_asked { Err(self.without_simulator()) } else { Ok(None) };
        };
        if let Some(folder) = &self.made {
            let MadeRuns { runs, notes } = made(folder, &given)?;
            return Ok(Some((SimulatedCase::of_made(given, runs, Arc::clone(stop)), notes)));
        }
        let Some(command) = self.simulator.as_deref() else {
            let reason = "the outputs of this case come from a simulator: add --simulator COMMAND to run \
                          it, --made FOLDER to use runs that were made, or --design FILE to write which \
                          runs to make";
            return Err(Failure::Argument(reason.to_owned()));
        };
        self.of_program(command, given, self.keep.clone(), (self.budget(), threads, stop)).map(Some)
    }

    /// The simulator in other rows than those of the data. With `--keep` its runs are in a folder of their own
    /// within FOLDER.
    ///
    /// # Errors
    /// Runs that cannot be read or kept.
    pub(crate) fn elsewhere(
        &self,
        case: &Case,
        at: &[Row],
        threads: &Threads,
        stop: &Arc<AtomicBool>,
    ) -> Result<Option<SimulatedCase>, Failure> {
        let Some((command, given)) = self.simulator.as_deref().zip(simulator_case(case, at)) else {
            return Ok(None);
        };
        let keep = self.keep.as_ref().map(|folder| prediction_folder(folder, &given));
        let of = self.of_program(command, given, keep, (PREDICTION_RUNS, threads, stop))?;
        Ok(Some(of.0))
    }

    /// The simulator that a command is, with the runs in a folder.
    fn of_program(
        &self,
        command: &str,
        given: SimulatorCase,
        keep: Option<PathBuf>,
        (budget, threads, stop): (usize, &Threads, &Arc<AtomicBool>),
    ) -> Result<(SimulatedCase, Vec<String>), Failure> {
        let program = self.program(command, threads, stop)?;
        let (runs, notes) = match keep {
            Some(folder) => KeptRuns::open(&folder, given, command)?,
            None => (KeptRuns::in_memory(given), Vec::new()),
        };
        Ok((SimulatedCase::new(runs, Box::new(program), budget, Arc::clone(stop)), notes))
    }

    fn budget(&self) -> usize {
        self.runs.unwrap_or(RUNS)
    }

    fn program(
        &self,
        command: &str,
        threads: &Threads,
        stop: &Arc<AtomicBool>,
    ) -> Result<Program, Failure> {
        let program = Program::new(command).map_err(Failure::Argument)?;
        let mut program = program.with_runs_at_once(threads.count()).with_stop(Arc::clone(stop));
        if let Some(timeout) = self.run_timeout {
            program = program.with_timeout(timeout);
        }
        Ok(if self.simulator_lines { program.line_by_line() } else { program })
    }

    /// The error that an option needs a simulator.
    fn without_simulator(&self) -> Failure {
        let option = match (&self.simulator, &self.made) {
            (Some(_), _) => "--simulator",
            (None, Some(_)) => "--made",
            (None, None) => "--design",
        };
        Failure::Argument(format!(
            "`{option}` needs a case whose outputs come from a simulator; this case has no `simulator`"
        ))
    }
}

/// The folder within that of a diagnosis in which runs of a prediction are kept: its name is the beginning of
/// the hash of what the simulator is run with there.
pub fn prediction_folder(folder: &Path, elsewhere: &SimulatorCase) -> PathBuf {
    folder.join(format!("predict-{}", &elsewhere.hash()[..12]))
}

/// A number of runs.
fn runs(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(count @ 1..=1_000_000) => Ok(count),
        _ => Err("a whole number from 1 to 1000000 is needed".to_owned()),
    }
}

/// A positive time in seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let time = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.filter(|time| !time.is_zero())
        .ok_or_else(|| "a positive number of seconds is needed, such as 60 or 0.5".to_owned())
}
