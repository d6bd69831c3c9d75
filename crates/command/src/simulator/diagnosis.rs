//! The diagnosis of a case whose outputs come from a simulator.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gumption_emulator::{RunKey, RunResult, Runs, Simulator, SimulatorCase};
use gumption_engine::task::Row;
use gumption_gap::simulated::{
    MakeRuns, ParameterSet, SimulatorDiagnosis, diagnose, diagnose_made,
};
use gumption_gap::{Case, Diagnosis, DiagnosisOptions, OverrideError};

use super::KeptRuns;
use crate::Failure;

/// A simulator with the runs of it that were made: what [`gumption_gap::simulated`] asks for is made where it
/// was not before, and kept.
pub struct SimulatedCase {
    runs: KeptRuns,
    /// What makes runs; `None` if no more can be made.
    simulator: Option<Box<dyn Simulator + Send>>,
    budget: usize,
    stop: Arc<AtomicBool>,
}

impl fmt::Debug for SimulatedCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SimulatedCase").field("runs", &self.runs).finish_non_exhaustive()
    }
}

impl SimulatedCase {
    /// So many runs at most are made by the simulator beside those that there are. Once `stop` is set no run is
    /// begun.
    pub fn new(
        runs: KeptRuns,
        simulator: Box<dyn Simulator + Send>,
        budget: usize,
        stop: Arc<AtomicBool>,
    ) -> Self {
        Self { runs, simulator: Some(simulator), budget, stop }
    }

    /// Runs that were made elsewhere, and nothing to make more of them.
    pub fn of_made(case: SimulatorCase, runs: Runs, stop: Arc<AtomicBool>) -> Self {
        Self { runs: KeptRuns::of(case, runs), simulator: None, budget: 0, stop }
    }

    /// The runs.
    pub fn runs(&self) -> &KeptRuns {
        &self.runs
    }

    /// Diagnoses a case; `None` if it was stopped while runs were made.
    ///
    /// # Errors
    /// The case cannot be diagnosed, or a run cannot be kept.
    pub fn diagnose(
        &mut self,
        case: &Case,
        options: DiagnosisOptions,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Option<SimulatorDiagnosis>, Failure> {
        let (budget, kept) = (self.budget, self.runs.runs().clone());
        let stop = &*self.stop;
        let Some(simulator) = &self.simulator else {
            let found = diagnose_made(case, kept, options, progress, stop);
            return found.map_err(|error| Failure::System(error.to_string()));
        };
        with_runs(&mut self.runs, &**simulator, stop, |make| {
            diagnose(case, make, budget, kept, options, progress, stop)
        })
    }

    /// A diagnosis with its predictions in other rows, whose runs are these; `None` if it was stopped.
    ///
    /// # Errors
    /// Rows that are none of the case, no run of a hypothesis, or one that cannot be kept; runs that were made
    /// elsewhere.
    pub fn predict(
        &mut self,
        found: &SimulatorDiagnosis,
        at: Vec<Row>,
    ) -> Result<Option<Diagnosis>, Failure> {
        let (budget, kept) = (self.budget, self.runs.runs().clone());
        let stop = &*self.stop;
        let Some(simulator) = &self.simulator else {
            let reason = "predictions need the simulator, which is run at the other conditions";
            return Err(Failure::Argument(reason.to_owned()));
        };
        let predicted = with_runs(&mut self.runs, &**simulator, stop, |make| {
            found.predict(at, make, budget, kept)
        });
        match predicted {
            Err(_) if stop.load(Ordering::Relaxed) => Ok(None),
            predicted => Ok(Some(predicted?.diagnosis)),
        }
    }

    /// The sentence about an interruption while runs were made.
    pub(crate) fn interrupted(&self) -> String {
        let count = self.runs.runs().made().len();
        let how =
            if self.runs.are_kept() { ", which are kept; the same command continues" } else { "" };
        format!("interrupted after {count} runs{how}")
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
