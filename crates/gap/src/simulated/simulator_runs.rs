//! The runs of a simulator, each made once.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use gumption_emulator::{Batch, Run, RunHash, RunKey, Runs, SimulatorCase, SimulatorRun, Space};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::task::Row;

use super::{MakeRuns, ParameterSet, refused, simulator_case};
use crate::{Case, OverrideError};

/// The runs of a simulator in some rows.
pub(super) struct SimulatorRuns {
    pub(super) space: Space,
    given: SimulatorCase,
    names: Arc<[String]>,
    /// What the values of a run are counted in: u, output after output.
    pub(super) units: Vec<f64>,
    pub(super) runs: Runs,
    /// Those of the first batch that was asked for last.
    pub(super) last: Vec<Run>,
    /// All that were asked for.
    used: HashSet<(RunHash, usize)>,
    /// How often each set of parameters was asked for, of a simulator whose outputs scatter: each time is
    /// another run.
    asked: Option<HashMap<RunHash, usize>>,
}

impl SimulatorRuns {
    /// In some rows of a case, with those that were kept; `units` are u of each output, row by row. Where outputs
    /// scatter, parameters that are asked for again are run again.
    ///
    /// # Errors
    /// A case without a simulator; kept runs of other parameters.
    pub(super) fn new(
        case: &Case,
        rows: &[Row],
        units: Vec<f64>,
        kept: Runs,
    ) -> Result<Self, OverrideError> {
        let of_case = case.simulator.as_ref().zip(simulator_case(case, rows));
        let Some((simulator, given)) = of_case else {
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
        Ok(Self {
            names: space.names().into(),
            space,
            given,
            units,
            runs: kept,
            last: Vec::new(),
            used: HashSet::new(),
            asked: simulator.is_noisy().then(HashMap::new),
        })
    }

    /// The runs of batches, made where they were not before; failed ones are left out.
    ///
    /// # Errors
    /// Another number of runs than was asked for, a run with another number of values than there are rows.
    pub(super) fn made(
        &mut self,
        batches: Vec<Batch>,
        make: &mut MakeRuns<'_>,
    ) -> Result<Vec<(Batch, Vec<SimulatorRun>)>, OverrideError> {
        let mut all: Vec<Vec<RunKey>> = Vec::new();
        for batch in &batches {
            let values =
                batch.scores.iter().map(|scores| self.space.values(&batch.effects, scores));
            all.push(values.collect::<Vec<_>>().into_iter().map(|of| self.key(of)).collect());
        }
        self.make_missing(all.iter().flatten(), make)?;
        let found = |key: &RunKey| self.find(key).cloned();
        self.last = all.iter().take(1).flatten().filter_map(found).collect();
        let mut made = Vec::new();
        for (batch, keys) in batches.into_iter().zip(all) {
            let mut learnt = Vec::new();
            for (scores, key) in batch.scores.iter().zip(keys) {
                let Some(outputs) = self.outputs(&key)? else { continue };
                learnt.push(SimulatorRun { scores: scores.clone(), outputs });
            }
            made.push((batch, learnt));
        }
        Ok(made)
    }

    /// So many runs of the plain simulator with all inputs at their medians, made where they were not before;
    /// failed ones are left out.
    ///
    /// # Errors
    /// Those of [`SimulatorRuns::made`].
    pub(super) fn repeats(
        &mut self,
        count: usize,
        make: &mut MakeRuns<'_>,
    ) -> Result<Vec<SimulatorRun>, OverrideError> {
        let scores = vec![0.0; self.space.unknowns(&[]).len()];
        let parameters = self.space.values(&[], &scores);
        if let Some(asked) = &mut self.asked {
            asked.insert(RunHash::of(&parameters), count);
        }
        let key = |repetition| RunKey { parameters: parameters.clone(), repetition };
        let keys: Vec<RunKey> = (0..count).map(key).collect();
        self.make_missing(keys.iter(), make)?;
        let mut made = Vec::new();
        for key in &keys {
            if let Some(outputs) = self.outputs(key)? {
                made.push(SimulatorRun { scores: scores.clone(), outputs });
            }
        }
        Ok(made)
    }

    /// What tells the next run with these parameters from all others.
    fn key(&mut self, parameters: Vec<f64>) -> RunKey {
        let Some(asked) = &mut self.asked else { return parameters.into() };
        let count = asked.entry(RunHash::of(&parameters)).or_default();
        *count += 1;
        RunKey { parameters, repetition: *count - 1 }
    }

    /// Makes the runs that were not made before, each once.
    fn make_missing<'k>(
        &mut self,
        keys: impl Iterator<Item = &'k RunKey>,
        make: &mut MakeRuns<'_>,
    ) -> Result<(), OverrideError> {
        let mut new: Vec<ParameterSet> = Vec::new();
        for key in keys {
            self.used.insert((RunHash::of(&key.parameters), key.repetition));
            let is_same = |set: &ParameterSet| {
                set.values == key.parameters && set.repetition == key.repetition
            };
            if self.find(key).is_none() && !new.iter().any(is_same) {
                new.push(ParameterSet {
                    names: Arc::clone(&self.names),
                    values: key.parameters.clone(),
                    repetition: key.repetition,
                });
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
            let run = Run { parameters: set.values, repetition: set.repetition, result };
            self.runs.keep(run).map_err(|error| refused(error.to_string()))?;
        }
        Ok(())
    }

    /// Whether the simulator's outputs scatter from run to run.
    pub(super) fn is_noisy(&self) -> bool {
        self.asked.is_some()
    }

    /// A run that was made before of a list of effects; `None` if it failed.
    ///
    /// # Errors
    /// A run with another number of values than there are rows.
    pub(super) fn kept(
        &self,
        effects: &[usize],
        key: &RunKey,
    ) -> Result<Option<SimulatorRun>, OverrideError> {
        let unknowns = self.space.unknowns(effects);
        let own: Vec<f64> = unknowns.iter().map(|&place| key.parameters[place]).collect();
        let scores = self.space.scores(effects, &own);
        let outputs = self.outputs(key)?;
        Ok(outputs.map(|outputs| SimulatorRun { scores, outputs }))
    }

    /// What it is run with.
    pub(super) fn given(&self) -> &SimulatorCase {
        &self.given
    }

    /// How many different runs were asked for.
    pub(super) fn used(&self) -> usize {
        self.used.len()
    }

    /// Values of all parameters for a message.
    pub(super) fn shown(&self, parameters: &[f64]) -> String {
        self.given.shown(parameters)
    }

    /// A run, if it was made.
    fn find(&self, key: &RunKey) -> Option<&Run> {
        self.runs.find_repetition(&key.parameters, key.repetition)
    }

    /// What a run gave, in u; `None` of one that failed.
    pub(super) fn outputs(&self, key: &RunKey) -> Result<Option<Vec<f64>>, OverrideError> {
        let run = self.find(key).and_then(|run| run.result.as_ref().ok());
        let Some(outputs) = run else { return Ok(None) };
        let rows = self.units.len();
        if outputs.len() != rows {
            return Err(refused(format!(
                "a run of the simulator has {} values, and the data have {rows}",
                outputs.len()
            )));
        }
        let outputs = outputs.iter().zip(&self.units).map(|(value, unit)| value / unit);
        Ok(Some(outputs.collect()))
    }

    /// The first run that failed, and why.
    pub(super) fn failed(&self) -> Option<(String, &str)> {
        let failed = |run: &Run| run.result.is_err();
        let run = self.runs.made().iter().find(|run| failed(run))?;
        Some((self.shown(&run.parameters), run.result.as_ref().err()?))
    }

    /// What is to be said of runs that failed.
    pub(super) fn failed_note(&self) -> Option<Fact> {
        let (at, why) = self.failed()?;
        let failed = self.runs.made().iter().filter(|run| run.result.is_err()).count();
        let runs = self.runs.made().len();
        Some(fact!("simulator.failed", failed, runs, at, why))
    }
}
