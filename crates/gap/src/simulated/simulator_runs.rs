//! The runs of a simulator, each made once.

use std::sync::Arc;

use gumption_emulator::{Batch, Run, Runs, SimulatorCase, SimulatorRun, Space};
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
    /// Those that were asked for last.
    pub(super) last: Vec<Run>,
}

impl SimulatorRuns {
    /// In some rows of a case, with those that were kept; `units` are u of each output, row by row.
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
        let names = space.names().into();
        Ok(Self { space, given, names, units, runs: kept, last: Vec::new() })
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
        let learnt = |(batch, parameters): (Batch, Vec<Vec<f64>>)| {
            let runs = batch.scores.iter().cloned().zip(&parameters);
            let runs = runs.filter_map(|(scores, values)| self.learnt(scores, values).transpose());
            let runs = runs.collect::<Result<_, _>>()?;
            Ok((batch, runs))
        };
        batches.into_iter().zip(all).map(learnt).collect()
    }

    /// Runs that were made of a list of effects, at values of all parameters; failed ones are left out.
    ///
    /// # Errors
    /// A run with another number of values than there are rows.
    pub(super) fn at(
        &self,
        effects: &[usize],
        parameters: &[Vec<f64>],
    ) -> Result<Vec<SimulatorRun>, OverrideError> {
        let unknowns = self.space.unknowns(effects);
        let learnt = |values: &Vec<f64>| {
            let own: Vec<f64> = unknowns.iter().map(|&place| values[place]).collect();
            self.learnt(self.space.scores(effects, &own), values).transpose()
        };
        parameters.iter().filter_map(learnt).collect()
    }

    /// A run that was made at values of all parameters, counted in u; `None` if it failed.
    fn learnt(
        &self,
        scores: Vec<f64>,
        values: &[f64],
    ) -> Result<Option<SimulatorRun>, OverrideError> {
        let run = self.runs.find(values).and_then(|run| run.result.as_ref().ok());
        let Some(outputs) = run else { return Ok(None) };
        let rows = self.units.len();
        if outputs.len() != rows {
            return Err(refused(format!(
                "a run of the simulator has {} values, and the data have {rows}",
                outputs.len()
            )));
        }
        let outputs = outputs.iter().zip(&self.units).map(|(value, unit)| value / unit).collect();
        Ok(Some(SimulatorRun { scores, outputs }))
    }

    /// The first run that failed, and why.
    pub(super) fn failed(&self) -> Option<(String, &str)> {
        let failed = |run: &Run| run.result.is_err();
        let run = self.runs.made().iter().find(|run| failed(run))?;
        Some((self.given.shown(&run.parameters), run.result.as_ref().err()?))
    }

    /// What is to be said of runs that failed.
    pub(super) fn failed_note(&self) -> Option<Fact> {
        let (at, why) = self.failed()?;
        let failed = self.runs.made().iter().filter(|run| run.result.is_err()).count();
        let runs = self.runs.made().len();
        Some(fact!("simulator.failed", failed, runs, at, why))
    }
}
