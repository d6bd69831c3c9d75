//! The runs of a simulator, each made once.

use std::sync::Arc;

use gumption_emulator::{Batch, Run, Runs, SimulatorRun, Space};
use gumption_engine::fact;
use gumption_engine::fact::Fact;

use super::{MakeRuns, ParameterSet, refused};
use crate::OverrideError;

/// The runs of a simulator in some rows.
pub(super) struct SimulatorRuns {
    pub(super) space: Space,
    names: Arc<[String]>,
    /// What the values of a run are counted in: u, output after output.
    pub(super) units: Vec<f64>,
    pub(super) runs: Runs,
    /// Those of the first batch that was asked for last.
    pub(super) last: Vec<Run>,
}

impl SimulatorRuns {
    /// With those that were kept.
    ///
    /// # Errors
    /// Kept runs of other parameters.
    pub(super) fn new(space: Space, units: Vec<f64>, kept: Runs) -> Result<Self, OverrideError> {
        if kept.names() != space.names() {
            return Err(refused(format!(
                "the runs that were kept are of the parameters {}, and the simulator has {}",
                kept.names().join(", "),
                space.names().join(", ")
            )));
        }
        Ok(Self { names: space.names().into(), space, units, runs: kept, last: Vec::new() })
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
        self.last = all.iter().take(1).flatten().filter_map(found).collect();
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

    /// The first run that failed, and why.
    pub(super) fn failed(&self) -> Option<(String, &str)> {
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
}
