//! A simulator that is being run, and what its emulator knows so far.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gumption_emulator::{
    Emulator, Ending, Plan, Scatter, SimulatorQuantity, SimulatorRun, State, Step, UnseenError,
};
use gumption_inference::noise::over_noises;
use gumption_inference::noise::prior_widths::OtherPriors;
use gumption_inference::noise::weighings::weighings;
use gumption_inference::posterior::{Effort, WeighedHypothesis};
use gumption_inference::setup::Setup;
use gumption_inference::simulator_states;
use gumption_inference::{LinearAt, linear_point};

use super::simulator_runs::SimulatorRuns;
use super::weighed_states::weighed_states;
use super::{MakeRuns, SimulatorDiagnosis, notes, refused, without_simulated};
use crate::diagnose::{DiagnosisOptions, diagnosed};
use crate::diagnosis::{
    DiagnosisNote, HypothesisKind, MostProbable, NamedQuantity, RunAtVerdict, SimulatorReport,
};
use crate::{Candidate, Case, OverrideError};

/// The inputs at which a simulator is linear beside departures are found anew so often at most.
const MOVES: usize = 3;

/// Where they move by less than this, as scores, they stay.
const MOVED: f64 = 0.1;

/// Why a plan was followed no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Followed {
    /// All hypotheses are to be weighed as they are to be reported.
    ToBeWeighed,
    /// The last run was made.
    Done,
    /// Somebody stopped it.
    Stopped,
}

/// A simulator that is being run.
pub(super) struct Simulation<'c> {
    case: &'c Case,
    pub(super) runs: SimulatorRuns,
    pub(super) emulator: Emulator,
    /// The inputs at which it is linear beside departures; `None` for the estimates.
    linear_at: Option<LinearAt>,
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
        Self { case, runs, emulator, linear_at: None, known: Vec::new(), seed, stop }
    }

    /// Forgets what was learnt from runs.
    pub(super) fn forget(&mut self) {
        let runs = &self.runs;
        let scatter = self.emulator.scatter().cloned();
        self.emulator = Emulator::new(runs.space.clone(), runs.units.len()).with_scatter(scatter);
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
        let (emulator, units) = (self.emulator.clone(), self.runs.units.clone());
        let emulated = self.case.emulated(emulator, units, self.linear_at.clone());
        emulated.ok_or_else(|| refused("the case has no simulator".to_owned()))
    }

    /// Follows a plan, whose last question these states answer, until it asks for all hypotheses or ends;
    /// `progress` is told how many runs were used.
    ///
    /// # Errors
    /// Runs with another number of values than there are rows; no run of the plain simulator.
    pub(super) fn follow(
        &mut self,
        plan: &mut Plan,
        mut states: Vec<State>,
        make: &mut MakeRuns<'_>,
        progress: &dyn Fn(usize),
    ) -> Result<Followed, OverrideError> {
        loop {
            let step = plan.next(std::mem::take(&mut states));
            if self.is_stopped() {
                return Ok(Followed::Stopped);
            }
            match step {
                Step::Run(batches) => {
                    let made = match self.runs.made(batches, make) {
                        Err(_) if self.is_stopped() => return Ok(Followed::Stopped),
                        made => made?,
                    };
                    for (batch, made) in made {
                        let learnt =
                            self.emulator.learn(&batch.effects, &made, batch.focus.clone());
                        plan.learnt(&batch, learnt.unseen.as_ref());
                    }
                    progress(plan.used());
                }
                Step::Infer(asked) => states = self.inferred(asked)?,
                Step::Weigh => return Ok(Followed::ToBeWeighed),
                Step::Done(_) => return Ok(Followed::Done),
            }
        }
    }

    /// The states of all lists of the simulator's effects with all hypotheses weighed, as they are to be
    /// reported.
    pub(super) fn weighed(&self, effort: Effort<'static>) -> Result<Vec<State>, OverrideError> {
        let case = self.emulated()?;
        let others = OtherPriors::of(&case);
        let effort = Effort { stop: Some(self.stop), ..effort };
        let weighings = weighings(&case, &others, self.seed, effort, &|_| {});
        let (setup, _, posterior) = over_noises::summed(weighings);
        let states = weighed_states(&setup, &posterior, 0.0).into_iter();
        Ok(states.map(|state| self.for_runs(state)).collect())
    }

    /// A state as runs need it: those of a simulator that scatters are further apart.
    fn for_runs(&self, state: State) -> State {
        match self.emulator.scatter() {
            Some(scatter) => state.widened(scatter),
            None => state,
        }
    }

    /// Finds the inputs at which the simulator is linear beside departures.
    pub(super) fn move_linear(&mut self) -> Result<(), OverrideError> {
        for _ in 0..MOVES {
            let case = self.emulated()?;
            let plain = self.known.iter().filter(|of| of.effects.is_empty());
            let modes = plain.flat_map(|of| &of.evidence.modes).map(|mode| mode.scores.clone());
            let modes: Vec<Vec<f64>> = modes.collect();
            let moved = linear_point::beside_departure(&Setup::new(&case), &modes, MOVED);
            if moved.is_none() {
                break;
            }
            self.linear_at = moved;
        }
        Ok(())
    }

    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
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
            let own = found.iter().filter(own);
            let own: Vec<(f64, &WeighedHypothesis)> = own.map(|of| (of.ln_weight(), of)).collect();
            simulator_states::state(&setup, &own).map(|state| self.for_runs(state))
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
        let report = self.report(&diagnosis.most_probable, ending.runs);
        let scatter = self.emulator.scatter().cloned();
        let facts = std::iter::once(notes::runs(report.runs, report.error))
            .chain(notes::scatter(self.case, scatter.as_ref(), repeats))
            .chain(self.runs.failed_note());
        diagnosis.notes.extend(facts.map(|fact| DiagnosisNote { fact }));
        diagnosis.simulator = Some(report);
        let SimulatorRuns { runs, last, .. } = self.runs;
        let known = Arc::new(known);
        Ok(SimulatorDiagnosis { diagnosis, runs, last, ending, more, scatter, known })
    }

    /// How the simulator was run for a verdict.
    fn report(&self, verdict: &MostProbable, runs: usize) -> SimulatorReport {
        let is_named = |of: &&Candidate| verdict.effects.contains(&of.effect.name);
        let named: Vec<&Candidate> = self.case.candidates.iter().filter(is_named).collect();
        let effects: Vec<usize> = named.iter().filter_map(|of| of.simulator).collect();
        let is_plain = effects.len() == named.len();
        SimulatorReport {
            runs,
            failed: self.runs.runs.made().iter().filter(|run| run.result.is_err()).count(),
            error: self.emulator.unseen(&effects).map(UnseenError::norm),
            at_verdict: match verdict.kind {
                HypothesisKind::Unexplained => None,
                _ => self.run_at(&effects, is_plain),
            },
        }
    }

    /// The first of the last runs beside what the emulator has there, if it is one of these effects; beside the
    /// data as well where formulas change nothing.
    fn run_at(&self, effects: &[usize], is_plain: bool) -> Option<RunAtVerdict> {
        let run = self.runs.last.first()?;
        let space = &self.runs.space;
        if space.acting(&run.parameters) != effects {
            return None;
        }
        let outputs = run.result.as_ref().ok()?.iter().zip(&self.runs.units);
        let outputs: Vec<f64> = outputs.map(|(value, unit)| value / unit).collect();
        let unknowns = space.unknowns(effects);
        let values: Vec<f64> = unknowns.iter().map(|&place| run.parameters[place]).collect();
        let emulated = self.emulator.values(effects, &space.at_values(effects, &values));
        // until there are runs, the conditions that they fill hold what was measured
        let rows = &self.case.task.rows;
        let first = self.case.described();
        let measured = (first..first + outputs.len() / rows.len())
            .flat_map(|place| rows.iter().map(move |row| row.conditions[place]));
        let measured = measured.zip(&self.runs.units).map(|(value, unit)| value / unit);
        let square = |a: &[f64], b: &mut dyn Iterator<Item = f64>| -> f64 {
            a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
        };
        let residual = (square(&outputs, &mut measured.into_iter()) / outputs.len() as f64).sqrt();
        let parameters = self.runs.given().parameters.iter().zip(&run.parameters);
        let named = |of: &SimulatorQuantity| NamedQuantity {
            name: of.name.clone(),
            unit: if of.unit == "1" { String::new() } else { of.unit.clone() },
        };
        Some(RunAtVerdict {
            parameters: parameters.map(|(of, &value)| (named(of), value)).collect(),
            error: square(&outputs, &mut emulated.into_iter()).sqrt(),
            residual: is_plain.then_some(residual),
        })
    }
}
