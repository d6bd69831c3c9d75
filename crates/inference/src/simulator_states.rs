//! What is found of the hypotheses of a case with a simulator while it is being run.

use std::sync::atomic::AtomicBool;

use gumption_emulator::State;
use gumption_engine::number::{COLUMN, elementary};
use gumption_engine::parallel;

use crate::integral::exploration::Exploration;
use crate::likelihood::Likelihood;
use crate::logarithm::ln_add;
use crate::posterior::{Effort, WeighedHypothesis};
use crate::setup::Setup;
use crate::simulated_outputs::SimulatedOutputs;

/// Draws of a posterior that a plan is told.
const DRAWS: usize = 200;

/// How much is computed between runs: modes are those of the round before, or near them.
const BETWEEN: Effort<'static> = Effort { generations: 0, rounds: 0, ..Effort::FULL };

/// Hypotheses of a case with the emulator as it is, each a list of candidates; `known` are those of the round
/// before, from whose modes they are searched where they have the same unknown quantities.
pub fn explored(
    setup: &Setup<'_>,
    hypotheses: Vec<Vec<usize>>,
    known: &[WeighedHypothesis],
    seed: u64,
    stop: Option<&AtomicBool>,
) -> Vec<WeighedHypothesis> {
    let unknowns = |effects: &[usize]| setup.likelihood(effects).unknowns();
    let is_same = |of: &&WeighedHypothesis| of.evidence.unknowns() == unknowns(&of.effects);
    let known: Vec<WeighedHypothesis> = known.iter().filter(is_same).cloned().collect();
    let exploration = Exploration::new(setup, seed, Effort { stop, ..BETWEEN });
    let begin = |effects| exploration.begin(effects, &known, None, f64::NEG_INFINITY);
    parallel::map(hypotheses, begin).into_iter().flatten().collect()
}

/// The state of the effects of the simulator that all of these hypotheses have, each with the logarithm of
/// what it counts beside the others; `None` without one that has a mode.
pub fn state(setup: &Setup<'_>, hypotheses: &[(f64, &WeighedHypothesis)]) -> Option<State> {
    let (_, best) = hypotheses.iter().max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    let mut state = State {
        effects: setup.case.simulator_effects(&best.effects),
        score: f64::NEG_INFINITY,
        mode: Vec::new(),
        draws: Vec::new(),
        weights: Vec::new(),
    };
    for (ln_weight, _) in hypotheses {
        state.score = ln_add(state.score, *ln_weight);
    }
    for (ln_weight, of) in hypotheses {
        let share = elementary::exp(ln_weight - state.score);
        let count = (DRAWS as f64 * share).round() as usize;
        let likelihood = setup.likelihood(&of.effects);
        let simulated = likelihood.simulated.as_ref()?;
        if of.effects == best.effects {
            let mode = of.evidence.modes.first()?.scores.clone();
            state.mode = scores(&likelihood, simulated, &[mode]).pop()?;
        }
        if count > 0 && of.evidence.has_draws() {
            let draws = scores(&likelihood, simulated, &of.evidence.resampled(count));
            state.weights.extend(draws.iter().map(|_| share / count as f64));
            state.draws.extend(draws);
        }
    }
    if state.draws.is_empty() {
        state.draws.push(state.mode.clone());
        state.weights.push(1.0);
    }
    let sum: f64 = state.weights.iter().sum();
    state.weights.iter_mut().for_each(|weight| *weight /= sum);
    Some(state)
}

/// The scores of the simulator's unknowns at points of a hypothesis.
fn scores(
    likelihood: &Likelihood<'_>,
    simulated: &SimulatedOutputs<'_>,
    points: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let of_chunk = |points: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let columns = likelihood.mixed(&likelihood.columns(points));
        let of_lane = |lane| simulated.scores(&likelihood.roles, &columns, lane);
        (0..points.len()).map(of_lane).collect()
    };
    points.chunks(COLUMN).flat_map(of_chunk).collect()
}
