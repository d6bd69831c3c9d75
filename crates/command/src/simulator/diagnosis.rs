//! The diagnosis of a case whose outputs come from a simulator.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gumption_emulator::{RunResult, Simulator, SimulatorCase};
use gumption_gap::simulated::{ParameterSet, diagnose};
use gumption_gap::{Case, Diagnosis, DiagnosisOptions};

use super::KeptRuns;
use crate::Failure;

/// The simulator of a case, with the runs that were made before.
pub(crate) struct SimulatedCase {
    pub(super) runs: KeptRuns,
    pub(super) simulator: Box<dyn Simulator + Send>,
    pub(super) budget: usize,
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
    /// Diagnoses the case; the runs that the diagnosis asks for and that were not made are made now, and
    /// kept.
    ///
    /// # Errors
    /// The case cannot be diagnosed, or a run cannot be kept.
    pub(crate) fn diagnose_with(
        mut self,
        case: &Case,
        options: DiagnosisOptions,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<SimulatedDiagnosis, Failure> {
        let kept = self.runs.runs().clone();
        let is_stopped = || self.stop.load(Ordering::Relaxed);
        let mut not_kept = None;
        let mut make = |sets: &[ParameterSet]| -> Vec<RunResult> {
            let batch: Vec<Vec<f64>> = sets.iter().map(|set| set.values.clone()).collect();
            let results = self.runs.results(&*self.simulator, &batch).unwrap_or_else(|failure| {
                not_kept = Some(failure);
                Vec::new()
            });
            if is_stopped() {
                // an answer of another length ends the diagnosis
                return Vec::new();
            }
            let not_made = || Err("the run was not made".to_owned());
            results.into_iter().map(|result| result.unwrap_or_else(not_made)).collect()
        };
        let found = diagnose(case, &mut make, self.budget, kept, options, progress);
        let failed = self.failed();
        match found {
            Ok(found) => Ok(SimulatedDiagnosis { diagnosis: Some(found.diagnosis), note: failed }),
            Err(error) => match not_kept {
                Some(failure) => Err(failure),
                None if is_stopped() => {
                    Ok(SimulatedDiagnosis { diagnosis: None, note: Some(self.interrupted()) })
                }
                None => Err(Failure::System(error.to_string())),
            },
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
