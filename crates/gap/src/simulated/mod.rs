//! The diagnosis of a simulator that is known by its runs.
//!
//! A [`Plan`] says which runs come next and which hypotheses to look at; an emulator learns from the runs, and
//! the inference takes its word for the simulator's. Once the plan ends the diagnosis is made as of any model.
//! Predictions in other rows take a few runs there, at draws of the posteriors.

mod case;
mod elsewhere;
mod notes;
mod simulation;
mod simulator_runs;
pub(crate) mod untold;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

pub use gumption_emulator::{
    Ending, Open, Parameter, Run, RunHash, RunResult, Runs, RunsError, Simulator, SimulatorCase,
    SimulatorCondition, SimulatorEffect, SimulatorQuantity, Space, SpaceError,
};
use gumption_emulator::{Plan, Step, UnseenError};

pub use self::case::simulator_case;
pub use self::elsewhere::{PREDICTION_RUNS, Predictions};
use self::simulation::Simulation;
use self::simulator_runs::SimulatorRuns;
use crate::diagnose::{DiagnosisOptions, diagnosed};
use crate::diagnosis::{Diagnosis, DiagnosisNote};
use crate::known_gap::KnownGap;
use crate::{Candidate, Case, OverrideError};

/// What a simulator is called with: all inputs and all parameters of its effects, always.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSet {
    /// The names of the parameters in their declared order.
    pub names: Arc<[String]>,
    /// Their values, each in the parameter's unit.
    pub values: Vec<f64>,
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
    known: Arc<KnownGap>,
}

/// Makes runs: for each set of parameters all rows of all outputs, output after output in the declared order
/// and each in the unit in which the simulator gives it, or why there are none.
pub type MakeRuns<'m> = dyn FnMut(&[ParameterSet]) -> Vec<RunResult> + 'm;

/// The share of the work that is done when the last run is made.
const RUN: f64 = 0.8;

/// Diagnoses a case with a simulator, of which `make` makes at most `budget` runs less those among `kept` that
/// the plan asks for. `progress` is told the share that is done. Once `stop` is set no run is asked for, and
/// `make` may give back fewer than it was asked for: `None` where the last run was not made yet, else what is
/// known, marked as interrupted.
///
/// # Errors
/// A case without a simulator, or one that cannot be diagnosed; a budget that is too small; kept runs of other
/// parameters; runs with another number of values than there are rows; no run of the plain simulator.
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
    let Some(simulator) = &case.simulator else {
        return Err(refused("the case has no simulator".to_owned()));
    };
    let runs = SimulatorRuns::new(simulator.space().clone(), case.simulator_units(), kept)?;
    let mut plan = Plan::new(simulator.space().clone(), budget, options.seed)
        .map_err(|error| refused(error.to_string()))?;
    let mut simulation = Simulation::new(case, runs, options.seed, stop);
    let is_stopped = || stop.load(Ordering::Relaxed);
    let mut states = Vec::new();
    let ending = loop {
        match plan.next(std::mem::take(&mut states)) {
            _ if is_stopped() => return Ok(None),
            Step::Run(batches) => {
                let made = match simulation.runs.made(batches, make) {
                    Err(_) if is_stopped() => return Ok(None),
                    made => made?,
                };
                for (batch, made) in made {
                    let learnt =
                        simulation.emulator.learn(&batch.effects, &made, batch.focus.clone());
                    plan.learnt(&batch, learnt.unseen.as_ref());
                }
                progress(RUN * plan.used() as f64 / budget as f64);
            }
            Step::Infer(asked) => states = simulation.inferred(asked)?,
            Step::Done(ending) => break ending,
        }
    };
    let emulated = simulation.emulated()?;
    let progress = |share: f64| progress(RUN + (1.0 - RUN) * share);
    let (mut diagnosis, known) = diagnosed(&emulated, options, &progress, Some(stop))?;
    without_simulated(&mut diagnosis, case.described());
    diagnosis.notes.extend(notes::open(case, &ending));
    let own = &diagnosis.most_probable.effects;
    let is_named = |of: &&Candidate| own.contains(&of.effect.name);
    let named: Vec<usize> =
        case.candidates.iter().filter(is_named).filter_map(|of| of.simulator).collect();
    let unseen = simulation.emulator.unseen(&named).map(UnseenError::median);
    let facts =
        std::iter::once(notes::runs(ending.runs, unseen)).chain(simulation.runs.failed_note());
    diagnosis.notes.extend(facts.map(|fact| DiagnosisNote { fact }));
    let SimulatorRuns { runs, last, .. } = simulation.runs;
    Ok(Some(SimulatorDiagnosis { diagnosis, runs, last, ending, known: Arc::new(known) }))
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
