//! The diagnosis of a simulator that is known by its runs.
//!
//! A [`Plan`] says which runs come next and which hypotheses to look at; an emulator learns from the runs, and
//! the inference takes its word for the simulator's. Once the plan ends the diagnosis is made as of any model.

use std::sync::Arc;

use gumption_emulator::{Batch, Emulator, GOAL, Plan, SimulatorRun, State, Step, UnseenError};
pub use gumption_emulator::{
    Ending, Open, Parameter, Run, RunHash, Runs, RunsError, SimulatorEffect, Space, SpaceError,
};
use gumption_engine::decimal::significant;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_inference::posterior::WeighedHypothesis;
use gumption_inference::setup::Setup;
use gumption_inference::simulator_states;

use crate::diagnose::{DiagnosisOptions, diagnose as diagnosed};
use crate::diagnosis::{Diagnosis, DiagnosisNote};
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
}

/// Makes runs: for each set of parameters all rows of all outputs, output after output in the declared order
/// and each in the unit in which the simulator gives it, or why there are none.
pub type MakeRuns<'m> = dyn FnMut(&[ParameterSet]) -> Vec<Result<Vec<f64>, String>> + 'm;

/// The share of the work that is done when the last run is made.
const RUN: f64 = 0.8;

/// Diagnoses a case with a simulator, of which `make` makes at most `budget` runs less those among `kept` that
/// the plan asks for. `progress` is told the share that is done.
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
) -> Result<SimulatorDiagnosis, OverrideError> {
    case.check()?;
    let Some(simulator) = &case.simulator else {
        return Err(refused("the case has no simulator".to_owned()));
    };
    let space = simulator.space().clone();
    if kept.names() != space.names() {
        return Err(refused(format!(
            "the runs that were kept are of the parameters {}, and the simulator has {}",
            kept.names().join(", "),
            space.names().join(", ")
        )));
    }
    let mut plan = Plan::new(space.clone(), budget, options.seed)
        .map_err(|error| refused(error.to_string()))?;
    let units = case.simulator_units();
    let mut simulation = Simulation {
        case,
        names: space.names().into(),
        emulator: Emulator::new(space.clone(), units.len()),
        space,
        units,
        runs: kept,
        last: Vec::new(),
        known: Vec::new(),
        seed: options.seed,
    };
    let mut states = Vec::new();
    let ending = loop {
        match plan.next(std::mem::take(&mut states)) {
            Step::Run(batches) => {
                for (batch, made) in simulation.made(batches, make)? {
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
    let mut diagnosis = diagnosed(&emulated, None, options, &progress)?;
    without_simulated(&mut diagnosis, case.described());
    diagnosis.notes.extend(notes(case, &ending));
    let own = &diagnosis.most_probable.effects;
    let is_named = |of: &&Candidate| own.contains(&of.effect.name);
    let named: Vec<usize> =
        case.candidates.iter().filter(is_named).filter_map(|of| of.simulator).collect();
    let unseen = simulation.emulator.unseen(&named).map(UnseenError::median);
    let facts = std::iter::once(run_note(ending.runs, unseen)).chain(simulation.failed_note());
    diagnosis.notes.extend(facts.map(|fact| DiagnosisNote { fact }));
    let Simulation { runs, last, .. } = simulation;
    Ok(SimulatorDiagnosis { diagnosis, runs, last, ending })
}

/// A simulator that is being run.
struct Simulation<'c> {
    case: &'c Case,
    space: Space,
    names: Arc<[String]>,
    /// What the emulator counts the values of a run in.
    units: Vec<f64>,
    emulator: Emulator,
    runs: Runs,
    /// Those of the last step.
    last: Vec<Run>,
    /// The hypotheses as they were looked at last.
    known: Vec<WeighedHypothesis>,
    seed: u64,
}

impl Simulation<'_> {
    /// The runs of batches, made where they were not before; failed ones are left out.
    fn made(
        &mut self,
        batches: Vec<Batch>,
        make: &mut MakeRuns<'_>,
    ) -> Result<Vec<(Batch, Vec<SimulatorRun>)>, OverrideError> {
        let parameters = |batch: &Batch| -> Vec<Vec<f64>> {
            let values = |scores: &Vec<f64>| self.space.values(&batch.effects, scores);
            batch.scores.iter().map(values).collect()
        };
        let all: Vec<Vec<Vec<f64>>> = batches.iter().map(parameters).collect();
        let mut new: Vec<ParameterSet> = Vec::new();
        for values in all.iter().flatten() {
            let is_known = self.runs.find(values).is_some();
            if !is_known && !new.iter().any(|set| set.values == *values) {
                new.push(ParameterSet { names: Arc::clone(&self.names), values: values.clone() });
            }
        }
        let results = if new.is_empty() { Vec::new() } else { make(&new) };
        if results.len() != new.len() {
            return Err(refused(format!(
                "{} runs of the simulator were asked for, and {} came back",
                new.len(),
                results.len()
            )));
        }
        for (set, result) in new.into_iter().zip(results) {
            let run = Run { parameters: set.values, result };
            self.runs.keep(run).map_err(|error| refused(error.to_string()))?;
        }
        let found = |values: &Vec<f64>| self.runs.find(values).cloned();
        self.last = all.iter().flatten().filter_map(found).collect();
        let rows = self.units.len();
        let mut made = Vec::new();
        for (batch, parameters) in batches.into_iter().zip(all) {
            let mut learnt = Vec::new();
            for (scores, values) in batch.scores.iter().zip(parameters) {
                let run = self.runs.find(&values).and_then(|run| run.result.as_ref().ok());
                let Some(outputs) = run else { continue };
                if outputs.len() != rows {
                    return Err(refused(format!(
                        "a run of the simulator has {} values, and the data have {rows}",
                        outputs.len()
                    )));
                }
                let outputs = outputs.iter().zip(&self.units).map(|(value, unit)| value / unit);
                learnt.push(SimulatorRun { scores: scores.clone(), outputs: outputs.collect() });
            }
            made.push((batch, learnt));
        }
        Ok(made)
    }

    /// The case with the emulator as it is.
    fn emulated(&self) -> Result<Case, OverrideError> {
        if self.emulator.correction(&[]).is_none() {
            return Err(refused(match self.failed() {
                Some((run, why)) => {
                    format!("no run of the plain simulator succeeded: {run}: {why}")
                }
                None => "no run of the plain simulator is near the data".to_owned(),
            }));
        }
        let emulated = self.case.emulated(self.emulator.clone(), self.units.clone());
        emulated.ok_or_else(|| refused("the case has no simulator".to_owned()))
    }

    /// The first run that failed, and why.
    fn failed(&self) -> Option<(String, &str)> {
        let failed = |run: &Run| run.result.is_err();
        let run = self.runs.made().iter().find(|run| failed(run))?;
        let values = self.names.iter().zip(&run.parameters);
        let values: Vec<String> = values.map(|(name, value)| format!("{name} = {value}")).collect();
        Some((values.join(", "), run.result.as_ref().err()?))
    }

    /// What is to be said of runs that failed.
    fn failed_note(&self) -> Option<Fact> {
        let (at, why) = self.failed()?;
        let failed = self.runs.made().iter().filter(|run| run.result.is_err()).count();
        let runs = self.runs.made().len();
        Some(fact!("simulator.failed", failed, runs, at, why))
    }

    /// The states of lists of the simulator's effects, each alone and with one effect that formulas make
    /// beside it.
    fn inferred(&mut self, asked: Vec<Vec<usize>>) -> Result<Vec<State>, OverrideError> {
        let case = self.emulated()?;
        let setup = Setup::new(&case);
        let candidates = || case.candidates.iter().enumerate();
        let formulas: Vec<usize> =
            candidates().filter(|(_, c)| c.simulator.is_none()).map(|(place, _)| place).collect();
        let most = if case.prior.two > 0.0 { 2 } else { 1 };
        let mut hypotheses = Vec::new();
        for effects in &asked {
            let is_one = |simulator: Option<usize>| simulator.is_some_and(|s| effects.contains(&s));
            let own: Vec<usize> =
                candidates().filter(|(_, c)| is_one(c.simulator)).map(|(place, _)| place).collect();
            if own.len() < most {
                hypotheses.extend(formulas.iter().map(|&other| {
                    let mut with = own.clone();
                    with.push(other);
                    with.sort_unstable();
                    with
                }));
            }
            hypotheses.push(own);
        }
        let found = simulator_states::explored(&setup, hypotheses, &self.known, self.seed);
        let states = asked.iter().filter_map(|effects| {
            let own = |of: &&WeighedHypothesis| case.simulator_effects(&of.effects) == *effects;
            let own: Vec<&WeighedHypothesis> = found.iter().filter(own).collect();
            simulator_states::state(&setup, &own)
        });
        let states = states.collect();
        self.known.retain(|old| !found.iter().any(|new| new.effects == old.effects));
        self.known.extend(found);
        Ok(states)
    }
}

/// Takes out the conditions that hold what the simulator gives.
fn without_simulated(diagnosis: &mut Diagnosis, described: usize) {
    diagnosis.conditions.truncate(described);
    for row in &mut diagnosis.rows {
        row.conditions.truncate(described);
    }
}

/// What is to be said of hypotheses that are not known well enough.
fn notes(case: &Case, ending: &Ending) -> Vec<DiagnosisNote> {
    let note = |open: &Open| {
        let name = |effect: &usize| {
            let of = case.candidates.iter().find(|of| of.simulator == Some(*effect));
            of.map_or("", |of| of.effect.name.as_str())
        };
        let name = open.effects.iter().map(name).collect::<Vec<_>>().join(" + ");
        let runs = open.runs;
        let number = |value: f64| Argument::Number(significant(value, 2));
        let goal = number(GOAL);
        let fact = match (open.error.map(number), name.is_empty()) {
            (Some(error), true) => fact!("emulator.plain", error, goal, runs),
            (Some(error), false) => fact!("emulator", name, error, goal, runs),
            (None, true) => fact!("emulator.plain-not-run", runs),
            (None, false) => fact!("emulator.not-run", name, runs),
        };
        DiagnosisNote { fact }
    };
    ending.open.iter().map(note).collect()
}

/// How often the simulator was run, and how well its outputs are known at what is reported.
fn run_note(runs: usize, unseen: Option<f64>) -> Fact {
    match unseen {
        Some(error) => {
            let error = Argument::Number(significant(error, 2));
            fact!("simulator", runs, error)
        }
        None => fact!("simulator.runs", runs),
    }
}

fn refused(reason: String) -> OverrideError {
    OverrideError::Case { reason }
}
