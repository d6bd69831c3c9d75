//! The diagnosis of a case whose outputs come from a simulator.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gumption_emulator::{RunKey, RunResult, Simulator, SimulatorCase};
use gumption_engine::task::Row;
use gumption_gap::simulated::{
    MakeRuns, PREDICTION_RUNS, ParameterSet, RunBudget, SimulatorDiagnosis, diagnose,
    simulator_case,
};
use gumption_gap::{Case, Diagnosis, DiagnosisOptions, OverrideError};

use super::KeptRuns;
use crate::Failure;

/// The simulator of a case, with the runs that were made before.
pub(crate) struct SimulatedCase {
    pub(super) runs: KeptRuns,
    pub(super) simulator: Box<dyn Simulator + Send>,
    pub(super) budget: RunBudget,
    /// The folder in which runs are kept, and the command that makes them.
    pub(super) keep: Option<(PathBuf, String)>,
    pub(super) stop: Arc<AtomicBool>,
}

/// What came of a diagnosis with a simulator.
pub(crate) struct SimulatedDiagnosis {
    /// `None` if it was interrupted while runs were made.
    pub(crate) diagnosis: Option<Diagnosis>,
    /// The runs that failed, or those before the interruption.
    pub(crate) note: Option<String>,
}

impl SimulatedCase {
    /// Diagnoses the case, and predicts in the rows `at`; the runs that this asks for and that were not made
    /// are made now, and kept.
    ///
    /// # Errors
    /// The case cannot be diagnosed, or a run cannot be kept.
    pub(crate) fn diagnose_with(
        mut self,
        case: &Case,
        at: Option<Vec<Row>>,
        options: DiagnosisOptions,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<SimulatedDiagnosis, Failure> {
        let (budget, kept) = (self.budget, self.runs.runs().clone());
        let (simulator, stop) = (&*self.simulator, &*self.stop);
        let found = with_runs(&mut self.runs, simulator, stop, |make| {
            diagnose(case, make, budget, kept, options, progress, stop)
        })?;
        let failed = self.failed();
        let (Some(found), note) = (found, failed) else {
            return Ok(SimulatedDiagnosis { diagnosis: None, note: Some(self.interrupted()) });
        };
        let diagnosis = match at {
            Some(at) if !found.diagnosis.interrupted => self.predicted(case, &found, at)?,
            _ => Some(found.diagnosis),
        };
        Ok(SimulatedDiagnosis { diagnosis, note })
    }

    /// The diagnosis with its predictions; `None` if it was interrupted.
    fn predicted(
        &self,
        case: &Case,
        found: &SimulatorDiagnosis,
        at: Vec<Row>,
    ) -> Result<Option<Diagnosis>, Failure> {
        let Some(given) = simulator_case(case, &at) else { return Ok(None) };
        let mut runs = match &self.keep {
            Some((folder, command)) => {
                let folder = folder.join(format!("predict-{}", &given.hash()[..12]));
                KeptRuns::open(&folder, given, command)?.0
            }
            None => KeptRuns::in_memory(given),
        };
        let kept = runs.runs().clone();
        let predicted = with_runs(&mut runs, &*self.simulator, &self.stop, |make| {
            found.predict(at, make, PREDICTION_RUNS, kept)
        });
        match predicted {
            Err(_) if self.stop.load(Ordering::Relaxed) => Ok(None),
            predicted => Ok(Some(predicted?.diagnosis)),
        }
    }

    /// The sentence about an interruption while runs were made.
    fn interrupted(&self) -> String {
        let count = self.runs.runs().made().len();
        let how =
            if self.runs.are_kept() { ", which are kept; the same command continues" } else { "" };
        format!("interrupted after {count} runs{how}")
    }

    /// The sentence about runs that failed, with the reason of the first one.
    fn failed(&self) -> Option<String> {
        let made = self.runs.runs().made();
        let mut reasons = made.iter().filter_map(|run| run.result.as_ref().err());
        let first = reasons.next()?;
        let count = 1 + reasons.count();
        Some(format!("{count} of {} runs failed, the first of them: {first}", made.len()))
    }
}

/// Does something with the runs of a simulator, which are kept as they are made.
fn with_runs<T>(
    runs: &mut KeptRuns,
    simulator: &dyn Simulator,
    stop: &AtomicBool,
    work: impl FnOnce(&mut MakeRuns<'_>) -> Result<T, OverrideError>,
) -> Result<T, Failure> {
    let mut not_kept = None;
    let mut make = |sets: &[ParameterSet]| -> Vec<RunResult> {
        let key = |set: &ParameterSet| RunKey {
            parameters: set.values.clone(),
            repetition: set.repetition,
        };
        let batch: Vec<RunKey> = sets.iter().map(key).collect();
        let results = runs.results(simulator, &batch).unwrap_or_else(|failure| {
            not_kept = Some(failure);
            Vec::new()
        });
        if stop.load(Ordering::Relaxed) {
            return Vec::new();
        }
        let not_made = || Err("the run was not made".to_owned());
        results.into_iter().map(|result| result.unwrap_or_else(not_made)).collect()
    };
    let found = work(&mut make);
    match not_kept {
        Some(failure) => Err(failure),
        None => found.map_err(|error| Failure::System(error.to_string())),
    }
}

/// A simulator that cannot be run any more.
pub(super) struct NoMoreRuns;

impl Simulator for NoMoreRuns {
    fn run(
        &self,
        _: &[Vec<f64>],
        _: &SimulatorCase,
        _: &mut dyn FnMut(usize, RunResult) -> ControlFlow<()>,
    ) {
    }
}
