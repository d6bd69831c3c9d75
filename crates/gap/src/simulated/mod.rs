//! The diagnosis of a simulator that is known by its runs.
//!
//! A [`Plan`] says which runs come next and which hypotheses to look at; an emulator learns from the runs, and
//! the inference takes its word for the simulator's. Then all hypotheses are weighed as of any model, and run at
//! draws of what is to be reported, until the emulator is right there.
//! Predictions in other rows take a few runs there, at draws of the posteriors.

mod case;
mod elsewhere;
mod notes;
mod simulation;
mod simulator_runs;
mod weighed_states;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

pub use gumption_emulator::{
    Ending, Open, Parameter, Run, RunHash, RunResult, Runs, RunsError, Simulator, SimulatorCase,
    SimulatorCondition, SimulatorEffect, SimulatorQuantity, Space, SpaceError,
};
use gumption_emulator::{Plan, UnseenError};
use gumption_inference::noise::prior_widths::OtherPriors;
use gumption_inference::posterior::Effort;

pub use self::case::simulator_case;
pub use self::elsewhere::{PREDICTION_RUNS, Predictions};
use self::simulation::{Followed, Simulation};
use self::simulator_runs::SimulatorRuns;
use self::weighed_states::weighed_states;
use crate::diagnose::{DiagnosisOptions, diagnosed};
use crate::diagnosis::{Diagnosis, DiagnosisNote};
use crate::known_gap::KnownGap;
use crate::weighed::Weighed;
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

/// How well hypotheses are weighed while runs are made: their draws say where the next ones go, and what is
/// improbable is not looked at from end to end.
const WHILE_RUN: Effort<'static> = Effort { generations: 0, ..Effort::QUICK };

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
    let plan = Plan::new(simulator.space().clone(), budget, options.seed)
        .map_err(|error| refused(error.to_string()))?;
    let mut simulation = Simulation::new(case, plan, runs, options.seed, stop);
    let while_run = |used: usize| progress(RUN * used as f64 / budget as f64);
    if simulation.follow(Vec::new(), make, &while_run)? == Followed::Stopped {
        return Ok(None);
    }
    simulation.move_linear()?;
    let effort = Effort { stop: Some(stop), ..WHILE_RUN };
    loop {
        let emulated = simulation.emulated()?;
        let others = OtherPriors::of(&emulated);
        let Weighed { setup, posterior, .. } =
            Weighed::new(&emulated, &others, options.seed, effort, &|_| {});
        let states = weighed_states(&setup, &posterior, 0.0);
        if simulation.follow(states, make, &while_run)? != Followed::ToBeWeighed {
            break;
        }
    }
    let emulated = simulation.emulated()?;
    let progress = |share: f64| progress(RUN + (1.0 - RUN) * share);
    let (mut diagnosis, known) = diagnosed(&emulated, options, &progress, Some(stop))?;
    without_simulated(&mut diagnosis, case.described());
    let ending = simulation.plan.ending();
    diagnosis.notes.extend(notes::open(case, &ending));
    let own = &diagnosis.most_probable.effects;
    let is_named = |of: &&Candidate| own.contains(&of.effect.name);
    let named: Vec<usize> =
        case.candidates.iter().filter(is_named).filter_map(|of| of.simulator).collect();
    let unseen = simulation.emulator.unseen(&named).map(UnseenError::norm);
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
