//! A simulator that is being run, and what its emulator knows so far.

use std::sync::atomic::{AtomicBool, Ordering};

use gumption_emulator::{Emulator, Plan, State, Step};
use gumption_inference::posterior::WeighedHypothesis;
use gumption_inference::setup::Setup;
use gumption_inference::simulator_states;
use gumption_inference::tangent::{self, LinearAt};

use super::simulator_runs::SimulatorRuns;
use super::{MakeRuns, refused};
use crate::{Case, OverrideError};

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
    pub(super) plan: Plan,
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
    /// One of which nothing is known but the runs that were kept.
    pub(super) fn new(
        case: &'c Case,
        plan: Plan,
        runs: SimulatorRuns,
        seed: u64,
        stop: &'c AtomicBool,
    ) -> Self {
        let emulator = Emulator::new(runs.space.clone(), runs.units.len());
        Self { case, plan, runs, emulator, linear_at: None, known: Vec::new(), seed, stop }
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

    /// Follows the plan, whose last question these states answer, until it asks for all hypotheses or ends;
    /// `progress` is told how many runs were used.
    ///
    /// # Errors
    /// Runs with another number of values than there are rows; no run of the plain simulator.
    pub(super) fn follow(
        &mut self,
        mut states: Vec<State>,
        make: &mut MakeRuns<'_>,
        progress: &dyn Fn(usize),
    ) -> Result<Followed, OverrideError> {
        loop {
            let step = self.plan.next(std::mem::take(&mut states));
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
                        self.plan.learnt(&batch, learnt.unseen.as_ref());
                    }
                    progress(self.plan.used());
                }
                Step::Infer(asked) => states = self.inferred(asked)?,
                Step::Weigh => return Ok(Followed::ToBeWeighed),
                Step::Done(_) => return Ok(Followed::Done),
            }
        }
    }

    /// Finds the inputs at which the simulator is linear beside departures.
    pub(super) fn move_linear(&mut self) -> Result<(), OverrideError> {
        for _ in 0..MOVES {
            let case = self.emulated()?;
            let plain = self.known.iter().filter(|of| of.effects.is_empty());
            let modes = plain.flat_map(|of| &of.evidence.modes).map(|mode| mode.scores.clone());
            let modes: Vec<Vec<f64>> = modes.collect();
            let moved = tangent::beside_departure(&Setup::new(&case), &modes, MOVED);
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
            simulator_states::state(&setup, &own)
        });
        let states = states.collect();
        self.known.retain(|old| !found.iter().any(|new| new.effects == old.effects));
        self.known.extend(found);
        Ok(states)
    }
}
