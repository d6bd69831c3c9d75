//! A simulator that is being run, and what its emulator knows so far.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption_emulator::{Emulator, Ending, Scatter, SimulatorRun, State, UnseenError};
use gumption_inference::posterior::WeighedHypothesis;
use gumption_inference::setup::Setup;
use gumption_inference::simulator_states;

use super::simulator_runs::SimulatorRuns;
use super::{SimulatorDiagnosis, notes, refused, without_simulated};
use crate::diagnose::{DiagnosisOptions, diagnosed};
use crate::diagnosis::DiagnosisNote;
use crate::{Candidate, Case, OverrideError};

/// A simulator that is being run.
pub(super) struct Simulation<'c> {
    case: &'c Case,
    pub(super) runs: SimulatorRuns,
    pub(super) emulator: Emulator,
    /// The hypotheses as they were looked at last.
    known: Vec<WeighedHypothesis>,
    seed: u64,
    stop: &'c AtomicBool,
}

impl<'c> Simulation<'c> {
    /// One of which nothing is known but the runs at the start, those that were kept and how runs scatter.
    pub(super) fn new(
        case: &'c Case,
        runs: SimulatorRuns,
        (start, scatter): (Vec<SimulatorRun>, Option<Scatter>),
        seed: u64,
        stop: &'c AtomicBool,
    ) -> Self {
        let mut emulator =
            Emulator::new(runs.space.clone(), runs.units.len()).with_scatter(scatter);
        emulator.learn(&[], &start, None);
        Self { case, runs, emulator, known: Vec::new(), seed, stop }
    }

    /// The case with the emulator as it is.
    pub(super) fn emulated(&self) -> Result<Case, OverrideError> {
        if self.emulator.correction(&[]).is_none() {
            return Err(refused(match self.runs.failed() {
                Some((run, why)) => {
                    format!("no run of the plain simulator succeeded: {run}: {why}")
                }
                None => "no run of the plain simulator is near the data".to_owned(),
            }));
        }
        let emulated = self.case.emulated(self.emulator.clone(), self.runs.units.clone());
        emulated.ok_or_else(|| refused("the case has no simulator".to_owned()))
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
        let found =
            simulator_states::explored(&setup, hypotheses, &self.known, self.seed, Some(self.stop));
        let states = asked.iter().filter_map(|effects| {
            let own = |of: &&WeighedHypothesis| case.simulator_effects(&of.effects) == *effects;
            let own: Vec<&WeighedHypothesis> = found.iter().filter(own).collect();
            let state = simulator_states::state(&setup, &own)?;
            Some(match self.emulator.scatter() {
                Some(scatter) => state.widened(scatter),
                None => state,
            })
        });
        let states = states.collect();
        self.known.retain(|old| !found.iter().any(|new| new.effects == old.effects));
        self.known.extend(found);
        Ok(states)
    }

    /// The diagnosis with the emulator as it is; `more` are runs that would tell more, and `repeats` how many
    /// runs showed how outputs scatter.
    pub(super) fn concluded(
        self,
        ending: Ending,
        more: Vec<Vec<f64>>,
        repeats: usize,
        options: DiagnosisOptions,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<SimulatorDiagnosis, OverrideError> {
        let emulated = self.emulated()?;
        let (mut diagnosis, known) = diagnosed(&emulated, options, progress, Some(self.stop))?;
        without_simulated(&mut diagnosis, self.case.described());
        diagnosis.notes.extend(notes::open(self.case, &ending));
        let own = &diagnosis.most_probable.effects;
        let is_named = |of: &&Candidate| own.contains(&of.effect.name);
        let named = self.case.candidates.iter().filter(is_named);
        let named: Vec<usize> = named.filter_map(|of| of.simulator).collect();
        let unseen = self.emulator.unseen(&named).map(UnseenError::median);
        let scatter = self.emulator.scatter().cloned();
        let facts = std::iter::once(notes::runs(ending.runs, unseen))
            .chain(notes::scatter(self.case, scatter.as_ref(), repeats))
            .chain(self.runs.failed_note());
        diagnosis.notes.extend(facts.map(|fact| DiagnosisNote { fact }));
        let SimulatorRuns { runs, last, .. } = self.runs;
        let known = Arc::new(known);
        Ok(SimulatorDiagnosis { diagnosis, runs, last, ending, more, scatter, known })
    }
}
