//! Which runs of a simulator to make next.

use std::collections::{BTreeMap, BTreeSet};

use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{elementary, largest_first};

use crate::halton::space_filling_scores;
use crate::space::Space;
use crate::state::State;
use crate::step::{Batch, Ending, Open, Step, TooFewRuns};
use crate::unseen::UnseenError;

/// The error of an emulator at the posterior that is small enough: the norm over all rows, in u. A fifth of
/// the noise in each of 500 rows would be 4.5, and ten units of log evidence.
pub const GOAL: f64 = 0.5;

/// The last runs, at what is reported.
const VERDICT: usize = 4;

/// The share of the budget that is kept for draws of what is to be reported: one tenth.
const KEPT: usize = 10;

/// So often hypotheses are weighed and run at draws of what is to be reported, at most.
const CHECKS: usize = 2;

/// Hypotheses of at least this probability are run at draws of what is to be reported.
const PROBABLE: f64 = 0.01;

/// An error that moves a probability by less than this does not count. One of e u in norm moves the logarithm
/// of an evidence by about e, and a probability p by p (1 - p) e.
const MOVED: f64 = 0.03;

/// This holds for errors of up to so many u.
const SMALL: f64 = 2.0;

/// The share of the budget that fills the space before anything is inferred: one third.
const START: usize = 3;

/// Runs of each effect at the start, at least.
const LEAST_START: usize = 6;

/// Runs of each effect, and of the best pairs, at its own best point before any is left out.
const FIRST: usize = 2;

/// So many pairs are run at their own best points, whatever superposition says of them.
const TRIED: usize = 6;

/// Hypotheses within this of the best score lead.
const NEAR: f64 = 12.0;

/// So many lead at most.
const MOST_LEADING: usize = 6;

/// Pairs are let in after so many rounds, whether the single effects are well known or not.
const SINGLES: usize = 5;

/// Rounds at most.
const ROUNDS: usize = 20;

/// A plan of the runs of a simulator.
///
/// It alternates between runs and inference and knows neither: whoever follows it makes the runs of
/// [`Step::Run`], lets the emulator learn from each batch in turn and tells [`Plan::learnt`] the error, and
/// hands the states of the hypotheses of [`Step::Infer`] to [`Plan::next`].
///
/// The start fills the space with a third of the budget: two thirds of it to learn from, one third to know
/// the error. Then every single effect is run at its own best point, twice, before any is left out. Once
/// singles are known, or after five rounds, all pairs are asked for, by superposition and without a run: two
/// effects that hide each other are each worse than nothing alone. The six best are run at their own best
/// points, as superposition is wrong where effects are large. The runs of a round go to the modes and
/// to draws of the posteriors of the leading hypotheses whose errors are not below 0.5 u in norm over all
/// rows.
///
/// Then all hypotheses are weighed as they are to be reported, [`Step::Weigh`], and those above a probability
/// of 0.01 are run at draws of these posteriors, which other noises and departures beside the effects may have
/// moved. Where the emulator was off by more than 0.5 u, and by so much that it moves a probability by 0.03,
/// they are weighed and run once more. A tenth of the budget is kept for this. The last runs are those
/// at what is reported.
///
/// The plan follows from its seed and from what it is told: somebody who made its runs before makes none
/// again.
#[derive(Clone, Debug)]
pub struct Plan {
    space: Space,
    budget: usize,
    seed: u64,
    used: usize,
    turn: usize,
    phase: Phase,
    stage: Stage,
    found: BTreeMap<Vec<usize>, State>,
    errors: BTreeMap<Vec<usize>, Errors>,
    /// What is to be reported, the most probable first.
    weighed: Vec<State>,
    /// How often it was run at.
    checks: usize,
    /// What is known well enough at draws of what was to be reported.
    checked: BTreeSet<Vec<usize>>,
}

/// Which hypotheses there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Single effects, of which none was run at its own best point.
    First,
    /// Single effects.
    Singles,
    /// All pairs, by superposition.
    Pairs,
    /// Those that were near the best once.
    All,
}

#[derive(Clone, Debug)]
enum Stage {
    Start,
    /// These are to be inferred next.
    Ask(Vec<Vec<usize>>),
    /// States were asked for.
    Decide,
    /// What is to be reported was asked for.
    Check,
    /// Runs at it were handed out.
    Checked,
    /// The last runs were handed out.
    Verdict,
}

/// The errors of a hypothesis at its posterior, the root mean square of the last round and of the one before.
#[derive(Clone, Copy, Debug)]
struct Errors {
    last: f64,
    before: Option<f64>,
}

impl Plan {
    /// A plan for so many runs in all, the last ones included.
    ///
    /// # Errors
    /// A budget that is smaller than the start, each effect's runs at its own best point and the last runs.
    pub fn new(space: Space, budget: usize, seed: u64) -> Result<Self, TooFewRuns> {
        let effects = space.effects();
        let least = plain_start(&space) + FIRST + effects * (LEAST_START + FIRST) + VERDICT;
        if budget < least {
            return Err(TooFewRuns { least });
        }
        Ok(Self::begun(space, budget, seed))
    }

    fn begun(space: Space, budget: usize, seed: u64) -> Self {
        Self {
            space,
            budget,
            seed,
            used: 0,
            turn: 0,
            phase: Phase::First,
            stage: Stage::Start,
            found: BTreeMap::new(),
            errors: BTreeMap::new(),
            weighed: Vec::new(),
            checks: 0,
            checked: BTreeSet::new(),
        }
    }

    /// At most so many runs that fill the space as the start of a plan does, for a simulator that is run
    /// only once for all.
    ///
    /// # Errors
    /// Fewer runs than the start of a plan takes.
    pub fn filling(space: &Space, runs: usize, seed: u64) -> Result<Vec<Batch>, TooFewRuns> {
        let least = plain_start(space) + space.effects() * LEAST_START;
        if runs < least {
            return Err(TooFewRuns { least });
        }
        Ok(filled(space, runs, seed))
    }

    /// What runs that were made elsewhere leave open, and the runs of the next round. `weighed` are the states of
    /// all hypotheses, as after [`Step::Weigh`], each with the error of the emulator at its posterior, the norm
    /// over all rows in u, where that is known; `singles` are others, as after [`Step::Infer`], that are not to
    /// be left out before they are known.
    pub fn of_made(
        space: &Space,
        runs: usize,
        weighed: Vec<(State, Option<f64>)>,
        singles: Vec<(State, Option<f64>)>,
        seed: u64,
    ) -> (Ending, Vec<Batch>) {
        let mut plan = Self { used: runs, ..Self::begun(space.clone(), runs, seed) };
        for (state, error) in weighed.iter().chain(&singles) {
            if let &Some(last) = error {
                plan.errors.insert(state.effects.clone(), Errors { last, before: None });
            }
        }
        plan.weighed = weighed.into_iter().map(|(state, _)| state).collect();
        plan.sort_weighed();
        plan.note_checked();
        let ending = plan.ending();
        let open = plan.unchecked().into_iter();
        let mut next: Vec<Batch> =
            open.map(|state| plan.batch(state, runs_in_round(&state.effects))).collect();
        let unknown = singles.iter().filter(|(state, _)| !plan.is_known(&state.effects));
        next.extend(unknown.map(|(state, _)| plan.batch(state, FIRST)));
        (ending, next)
    }

    /// How many runs were asked for so far.
    pub fn used(&self) -> usize {
        self.used
    }

    /// Takes the error of the emulator on a batch before it learnt from it. What fills the space says nothing
    /// of a posterior.
    pub fn learnt(&mut self, batch: &Batch, unseen: Option<&UnseenError>) {
        if let (Some(_), Some(unseen)) = (&batch.focus, unseen) {
            let before = self.errors.get(&batch.effects).map(|errors| errors.last);
            let errors = Errors { last: unseen.norm(), before };
            self.errors.insert(batch.effects.clone(), errors);
        }
    }

    /// The next step. After [`Step::Infer`] the states of the hypotheses that were asked for are given; one
    /// that is missing stays as it was. After [`Step::Weigh`] those of all that are probable are, each with
    /// the logarithm of its probability as its score.
    pub fn next(&mut self, states: Vec<State>) -> Step {
        match std::mem::replace(&mut self.stage, Stage::Verdict) {
            Stage::Start => {
                self.stage = Stage::Ask(self.few());
                self.run(filled(&self.space, self.budget / START, self.seed))
            }
            Stage::Ask(asked) => {
                self.stage = Stage::Decide;
                Step::Infer(asked)
            }
            Stage::Decide => {
                let states = states.into_iter().map(|state| (state.effects.clone(), state));
                self.found.extend(states);
                self.decide()
            }
            Stage::Check => {
                self.weighed = states;
                self.sort_weighed();
                self.check()
            }
            Stage::Checked => {
                self.note_checked();
                if self.unchecked().is_empty() {
                    Step::Done(self.ending())
                } else if self.checks < CHECKS && self.left() > 0 {
                    self.weigh()
                } else {
                    self.last_runs()
                }
            }
            Stage::Verdict => {
                self.note_checked();
                Step::Done(self.ending())
            }
        }
    }

    fn weigh(&mut self) -> Step {
        self.stage = Stage::Check;
        Step::Weigh
    }

    /// Runs at draws of what is to be reported, where the emulator is not known to be right.
    fn check(&mut self) -> Step {
        self.checks += 1;
        let mut left = self.left();
        let mut batches = Vec::new();
        for state in self.unchecked() {
            let count = runs_in_round(&state.effects).min(left);
            if count > 0 {
                batches.push(self.batch(state, count));
                left -= count;
            }
        }
        if batches.is_empty() {
            return self.last_runs();
        }
        self.stage = Stage::Checked;
        self.run(batches)
    }

    /// Runs at the best of what is to be reported.
    fn last_runs(&mut self) -> Step {
        self.stage = Stage::Verdict;
        let count = VERDICT.min(self.budget - self.used);
        let best = self.weighed.first().map(|best| self.batch(best, count));
        self.run(best.into_iter().collect())
    }

    /// What is to be reported and not known well enough there.
    fn unchecked(&self) -> Vec<&State> {
        self.weighed.iter().filter(|state| !self.checked.contains(&state.effects)).collect()
    }

    /// What is probable enough to be run at, the most probable first.
    fn sort_weighed(&mut self) {
        self.weighed.retain(|state| state.score >= elementary::ln(PROBABLE));
        largest_first(&mut self.weighed, |state| state.score);
    }

    fn note_checked(&mut self) {
        let known = self.weighed.iter().filter(|state| {
            let probability = elementary::exp(state.score);
            let error = self.errors.get(&state.effects).map(|errors| errors.last);
            let small = error.filter(|error| *error <= SMALL);
            let moved = small.map(|error| probability * (1.0 - probability) * error);
            self.is_known(&state.effects) || moved.is_some_and(|moved| moved < MOVED)
        });
        let known: Vec<Vec<usize>> = known.map(|state| state.effects.clone()).collect();
        self.checked.extend(known);
    }

    /// What follows from the states that were given.
    fn decide(&mut self) -> Step {
        let leading = self.leading();
        let mut open: Vec<Vec<usize>> =
            leading.iter().filter(|of| !self.is_known(of)).cloned().collect();
        let turn = self.turn;
        self.turn += 1;
        if self.phase == Phase::Singles && (open.is_empty() || turn >= SINGLES) {
            let pairs = self.pairs();
            self.phase = if pairs.is_empty() { Phase::All } else { Phase::Pairs };
            if self.phase == Phase::Pairs {
                self.stage = Stage::Decide;
                return Step::Infer(pairs);
            }
        }
        // what was never run at its own best point, wherever it stands
        let new = match self.phase {
            Phase::First => self.few(),
            Phase::Pairs => self.best_pairs_beside(&leading),
            _ => Vec::new(),
        };
        let is_finished = self.phase == Phase::All && open.is_empty();
        if self.left_in_rounds() == 0 || turn >= ROUNDS || is_finished {
            return self.weigh();
        }
        if self.phase == Phase::First {
            open.clear();
        } else if open.is_empty() && new.is_empty() {
            open.clone_from(&leading);
        }
        let counts = new.iter().map(|of| (of, FIRST));
        let counts = counts.chain(open.iter().map(|of| (of, runs_in_round(of))));
        let mut batches = Vec::new();
        let mut left = self.left_in_rounds();
        for (of, count) in counts {
            let count = count.min(left);
            if let Some(state) = self.found.get(of).filter(|_| count > 0) {
                batches.push(self.batch(state, count));
                left -= count;
            }
        }
        let mut next = leading;
        let more = if self.phase == Phase::Singles { self.few() } else { new };
        for of in more {
            if !next.contains(&of) {
                next.push(of);
            }
        }
        self.stage = Stage::Ask(next);
        self.phase = match self.phase {
            Phase::First => Phase::Singles,
            Phase::Pairs => Phase::All,
            other => other,
        };
        self.run(batches)
    }

    fn run(&mut self, batches: Vec<Batch>) -> Step {
        self.used += batches.iter().map(|batch| batch.scores.len()).sum::<usize>();
        Step::Run(batches)
    }

    /// Runs that are left but for the last ones.
    fn left(&self) -> usize {
        self.budget.saturating_sub(self.used + VERDICT)
    }

    /// Those of them that are not kept for what is to be reported. Every effect is run at its own best point
    /// before any are.
    fn left_in_rounds(&self) -> usize {
        let kept = if self.phase == Phase::First { 0 } else { self.budget / KEPT };
        self.left().saturating_sub(kept)
    }

    /// No effect and every one alone.
    fn few(&self) -> Vec<Vec<usize>> {
        few(&self.space)
    }

    fn pairs(&self) -> Vec<Vec<usize>> {
        let count = self.space.effects();
        (0..count).flat_map(|a| (a + 1..count).map(move |b| vec![a, b])).collect()
    }

    /// The best pairs that do not lead, as superposition has them.
    fn best_pairs_beside(&self, leading: &[Vec<usize>]) -> Vec<Vec<usize>> {
        let mut pairs = self.pairs();
        pairs.retain(|pair| self.found.contains_key(pair) && !leading.contains(pair));
        largest_first(&mut pairs, |pair| self.found[pair].score);
        pairs.truncate(TRIED);
        pairs
    }

    /// The hypotheses near the best one, the best first.
    fn leading(&self) -> Vec<Vec<usize>> {
        let mut order: Vec<&State> = self.found.values().collect();
        largest_first(&mut order, |state| state.score);
        let Some(best) = order.first().map(|state| state.score) else { return Vec::new() };
        let near = order.iter().take_while(|state| state.score > best - NEAR);
        near.take(MOST_LEADING).map(|state| state.effects.clone()).collect()
    }

    /// Whether the error of a hypothesis at its posterior is small enough.
    fn is_known(&self, effects: &[usize]) -> bool {
        self.errors.get(effects).is_some_and(|errors| errors.last <= GOAL)
    }

    /// The mode and draws of a posterior.
    fn batch(&self, state: &State, count: usize) -> Batch {
        let key = StreamKey::new(self.seed, &format!("emulator/draws/{:?}", state.effects));
        state.batch(&self.space, count, key, self.used as u64)
    }

    /// How it ends if no run is made any more.
    pub fn ending(&self) -> Ending {
        let open = self.unchecked().into_iter().map(|state| {
            let effects = state.effects.clone();
            let errors = self.errors.get(&effects);
            let rounds = errors.map_or(1.0, |errors| {
                let falls = errors.before.map_or(0.5, |before| errors.last / before);
                let falls = falls.clamp(0.1, 0.5_f64.sqrt());
                (elementary::ln(GOAL / errors.last) / elementary::ln(falls)).ceil().max(1.0)
            });
            let runs = rounds as usize * runs_in_round(&effects);
            Open { effects, error: errors.map(|errors| errors.last), runs }
        });
        Ending { runs: self.used, open: open.collect() }
    }
}

/// No effect and every one alone.
fn few(space: &Space) -> Vec<Vec<usize>> {
    let singles = (0..space.effects()).map(|effect| vec![effect]);
    std::iter::once(Vec::new()).chain(singles).collect()
}

/// About so many runs that fill the space, of each hypothesis to learn from and to know the error.
fn filled(space: &Space, runs: usize, seed: u64) -> Vec<Batch> {
    let plain = plain_start(space);
    let rest = runs.saturating_sub(plain);
    let share = rest.checked_div(space.effects()).unwrap_or(0).max(LEAST_START);
    let mut batches = Vec::new();
    for effects in few(space) {
        let count = if effects.is_empty() { plain } else { share };
        let key = StreamKey::new(seed, &format!("emulator/start/{effects:?}"));
        let mut scores = space_filling_scores(count, space.unknowns(&effects).len(), key);
        let unseen = scores.split_off(2 * count / 3);
        for scores in [scores, unseen] {
            batches.push(Batch { effects: effects.clone(), scores, focus: None });
        }
    }
    batches
}

/// Runs of the plain simulator at the start.
fn plain_start(space: &Space) -> usize {
    4 * space.unknowns(&[]).len() + 4
}

/// Runs of a hypothesis in a round.
fn runs_in_round(effects: &[usize]) -> usize {
    4 + 2 * effects.len()
}
