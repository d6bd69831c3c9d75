//! A simulator that is being run, and what its emulator knows so far.

use std::sync::Arc;

use gumption_emulator::{Batch, Emulator, Run, Runs, SimulatorRun, Space, State};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_inference::posterior::WeighedHypothesis;
use gumption_inference::setup::Setup;
use gumption_inference::simulator_states;

use super::{MakeRuns, ParameterSet, refused};
use crate::{Case, OverrideError};

/// A simulator that is being run.
pub(super) struct Simulation<'c> {
    case: &'c Case,
    space: Space,
    names: Arc<[String]>,
    /// What the emulator counts the values of a run in.
    units: Vec<f64>,
    pub(super) emulator: Emulator,
    pub(super) runs: Runs,
    /// Those of the last step.
    pub(super) last: Vec<Run>,
    /// The hypotheses as they were looked at last.
    known: Vec<WeighedHypothesis>,
    seed: u64,
}

impl<'c> Simulation<'c> {
    /// One of which nothing is known but the runs that were kept.
    pub(super) fn new(case: &'c Case, space: Space, kept: Runs, seed: u64) -> Self {
        let units = case.simulator_units();
        Self {
            case,
            names: space.names().into(),
            emulator: Emulator::new(space.clone(), units.len()),
            space,
            units,
            runs: kept,
            last: Vec::new(),
            known: Vec::new(),
            seed,
        }
    }

    /// The runs of batches, made where they were not before; failed ones are left out.
    pub(super) fn made(
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
    pub(super) fn emulated(&self) -> Result<Case, OverrideError> {
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
    pub(super) fn failed_note(&self) -> Option<Fact> {
        let (at, why) = self.failed()?;
        let failed = self.runs.made().iter().filter(|run| run.result.is_err()).count();
        let runs = self.runs.made().len();
        Some(fact!("simulator.failed", failed, runs, at, why))
    }

    /// The states of lists of the simulator's effects, each alone and with one effect that formulas make
    /// beside it.
    pub(super) fn inferred(&mut self, asked: Vec<Vec<usize>>) -> Result<Vec<State>, OverrideError> {
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
