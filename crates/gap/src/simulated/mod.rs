//! The diagnosis of a simulator that is known by its runs.
//!
//! A [`Plan`] says which runs come next and which hypotheses to look at; an emulator learns from the runs, and
//! the inference takes its word for the simulator's. Then all hypotheses are weighed as of any model, and run at
//! draws of what is to be reported, until the emulator is right there.
//! Predictions in other rows take a few runs there, at draws of the posteriors.

mod case;
mod elsewhere;
mod made;
mod notes;
mod repeats;
mod simulation;
mod simulator_runs;
pub(crate) mod untold;
mod weighed_states;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

pub use gumption_emulator::{
    Ending, Open, OutputScatter, Parameter, Run, RunHash, RunKey, RunResult, Runs, RunsError,
    Scatter, Simulator, SimulatorCase, SimulatorCondition, SimulatorEffect, SimulatorQuantity,
    Space, SpaceError, TooFewRuns,
};

use gumption_emulator::{Batch, Plan};
use gumption_inference::posterior::Effort;

pub use self::case::simulator_case;
pub use self::elsewhere::{PREDICTION_RUNS, Predictions};
pub use self::made::diagnose_made;
use self::simulation::{Followed, Simulation};
use self::simulator_runs::SimulatorRuns;
use crate::diagnose::DiagnosisOptions;
use crate::diagnosis::Diagnosis;
use crate::known_gap::KnownGap;
use crate::{Case, OverrideError};

/// What a simulator is called with: all inputs and all parameters of its effects, always.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSet {
    /// The names of the parameters in their declared order.
    pub names: Arc<[String]>,
    /// Their values, each in the parameter's unit.
    pub values: Vec<f64>,
    /// How many runs with these values come before it: 0, unless the simulator is run again to see whether it
    /// repeats, or how it scatters. The simulator does not get it.
    pub repetition: usize,
}

/// At most so many runs of a case's simulator that are made all at once: those that fill the space, and of one
/// that is noisy repeats with all inputs at their medians.
///
/// # Errors
/// A case without a simulator; fewer runs than the start of a diagnosis takes.
pub fn design(case: &Case, runs: usize, seed: u64) -> Result<Vec<RunKey>, OverrideError> {
    let Some(simulator) = &case.simulator else {
        return Err(refused("the case has no simulator".to_owned()));
    };
    let space = simulator.space();
    let repeats = if simulator.is_noisy() { repeats::count(true) } else { 0 };
    let batches = Plan::filling(space, runs.saturating_sub(repeats), seed);
    let batches = batches.map_err(|error| too_few(error, repeats))?;
    let medians = space.values(&[], &vec![0.0; space.unknowns(&[]).len()]);
    let again = (0..repeats).map(|repetition| RunKey { parameters: medians.clone(), repetition });
    let values = |batch: &Batch| {
        let values = batch.scores.iter().map(|scores| space.values(&batch.effects, scores));
        values.map(RunKey::from).collect::<Vec<_>>()
    };
    Ok(again.chain(batches.iter().flat_map(values)).collect())
}

fn too_few(error: TooFewRuns, repeats: usize) -> OverrideError {
    refused(TooFewRuns { least: error.least + repeats }.to_string())
}

/// A diagnosis with the runs that it took.
#[derive(Clone, Debug)]
pub struct SimulatorDiagnosis {
    /// What is known of the gap.
    pub diagnosis: Diagnosis,
    /// All runs, those that were made before as well.
    pub runs: Runs,
    /// The last of them: the simulator at the most probable parameters of what is reported, and at draws of
    /// their posterior.
    pub last: Vec<Run>,
    /// How many runs were used, and what is not known well enough.
    pub ending: Ending,
    /// The parameters of runs that would tell more, where none was made for the diagnosis.
    pub more: Vec<Vec<f64>>,
    /// How the simulator's outputs scatter from run to run, of one that is noisy.
    pub scatter: Option<Scatter>,
    known: Arc<KnownGap>,
}

/// Makes runs: for each set of parameters all rows of all outputs, output after output in the declared order
/// and each in the unit in which the simulator gives it, or why there are none.
pub type MakeRuns<'m> = dyn FnMut(&[ParameterSet]) -> Vec<RunResult> + 'm;

/// The share of the work that is done when the last run is made.
const RUN: f64 = 0.8;

/// How well hypotheses are weighed while runs are made: their draws say where the next ones go, and what is
/// improbable is not looked at from end to end.
const WHILE_RUN: Effort<'static> = Effort { generations: 0, ..Effort::QUICK };

/// Diagnoses a case with a simulator, of which `make` makes at most `budget` runs less those among `kept` that
/// are asked for. The first ones are repeats with all inputs at their medians: they show that the simulator
/// repeats, or if it is noisy how its outputs scatter. `progress` is told the share that is done. Once `stop` is
/// set no run is asked for, and `make` may give back fewer than it was asked for: `None` where the last run was
/// not made yet, else what is known, marked as interrupted.
///
/// # Errors
/// A case without a simulator, or one that cannot be diagnosed; a budget that is too small; kept runs of other
/// parameters; runs with another number of values than there are rows; no run of the plain simulator; a
/// simulator that is not noisy and gives something else at the same parameters.
pub fn diagnose(
    case: &Case,
    make: &mut MakeRuns<'_>,
    budget: usize,
    kept: Runs,
    options: DiagnosisOptions,
    progress: &(dyn Fn(f64) + Sync),
    stop: &AtomicBool,
) -> Result<Option<SimulatorDiagnosis>, OverrideError> {
    case.check()?;
    let mut runs = SimulatorRuns::new(case, &case.task.rows, case.simulator_units(), kept)?;
    let repeats = repeats::count(runs.is_noisy());
    let planned = budget.saturating_sub(repeats);
    let mut plan = Plan::new(runs.space.clone(), planned, options.seed)
        .map_err(|error| too_few(error, repeats))?;
    let start = match repeats::start(case, &mut runs, make) {
        Err(_) if stop.load(Ordering::Relaxed) => return Ok(None),
        start => start?,
    };
    let mut simulation = Simulation::new(case, runs, start, options.seed, stop);
    let while_run = |used: usize| progress(RUN * used as f64 / planned as f64);
    let mut followed = simulation.follow(&mut plan, Vec::new(), make, &while_run)?;
    simulation.move_linear()?;
    while followed == Followed::ToBeWeighed {
        let states = simulation.weighed(WHILE_RUN)?;
        followed = simulation.follow(&mut plan, states, make, &while_run)?;
    }
    if followed == Followed::Stopped {
        return Ok(None);
    }
    let ending = Ending { runs: simulation.runs.used(), ..plan.ending() };
    let progress = |share: f64| progress(RUN + (1.0 - RUN) * share);
    simulation.concluded(ending, Vec::new(), repeats, options, &progress).map(Some)
}

/// Takes out the conditions that hold what the simulator gives.
fn without_simulated(diagnosis: &mut Diagnosis, described: usize) {
    diagnosis.conditions.truncate(described);
    let rows = diagnosis.rows.iter_mut().map(|row| &mut row.conditions);
    let predicted = diagnosis.prediction.iter_mut().flatten().map(|row| &mut row.conditions);
    rows.chain(predicted).for_each(|conditions| conditions.truncate(described));
}

fn refused(reason: String) -> OverrideError {
    OverrideError::Case { reason }
}
