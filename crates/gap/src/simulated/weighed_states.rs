//! The posteriors of the simulator's effects once all hypotheses are weighed.

use std::borrow::Cow;
use std::collections::BTreeMap;

use gumption_emulator::State;
use gumption_engine::number::elementary;
use gumption_inference::posterior::{Posterior, WeighedHypothesis};
use gumption_inference::setup::Setup;
use gumption_inference::simulator_states;

/// The states of all lists of the simulator's effects that have at least this probability, the formulas and
/// departures beside them whatever they are. Each has the logarithm of its probability as its score; what is
/// unexplained without effects is none of them.
pub(super) fn weighed_states(setup: &Setup<'_>, posterior: &Posterior, least: f64) -> Vec<State> {
    let mut lists: BTreeMap<Vec<usize>, Vec<Cow<'_, WeighedHypothesis>>> = BTreeMap::new();
    let named = posterior.hypotheses.iter().map(|alone| posterior.together(alone));
    for hypothesis in named.filter(|of| of.evidence.has_draws()) {
        let effects = setup.case.simulator_effects(&hypothesis.effects);
        lists.entry(effects).or_default().push(hypothesis);
    }
    let probability =
        |of: &[Cow<'_, WeighedHypothesis>]| of.iter().map(|of| of.probability).sum::<f64>();
    let probable = lists.into_values().filter(|of| probability(of) >= least);
    let states = probable.filter_map(|own| {
        let own: Vec<(f64, &WeighedHypothesis)> =
            own.iter().map(|of| (elementary::ln(of.probability), &**of)).collect();
        simulator_states::state(setup, &own)
    });
    states.collect()
}
