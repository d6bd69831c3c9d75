//! Effects that ship with the program, tried where no effect of the list explains the data.

use super::departure;
use super::diagnosis::UnlistedEffect;
use super::parameters::parameters;
use crate::Case;
use gumption_engine::number::{elementary, largest_first};
use gumption_inference::logarithm::ln_add;
use gumption_inference::noise::weighing::Weighing;
use gumption_inference::posterior::{Effort, singles};
use gumption_inference::setup::Setup;

/// Effects below this probability are not handed over.
const LEAST: f64 = 0.01;

/// The unlisted effects that would explain the data alone, most probable first, with intervals of this
/// coverage probability.
pub(crate) fn explaining(
    case: &Case,
    weighings: &[Weighing<'_>],
    seed: u64,
    coverage: f64,
) -> Vec<UnlistedEffect> {
    let unexplained = departure::probability(weighings);
    let leading = weighings.get(departure::leading(weighings));
    let Some(weighing) = leading.filter(|_| unexplained > departure::WORTH_TELLING) else {
        return Vec::new();
    };
    let mut other = case.clone();
    other.candidates = std::mem::take(&mut other.shipped);
    other.candidates.retain(|candidate| case.model.program(&[&candidate.effect]).is_ok());
    if other.candidates.is_empty() {
        return Vec::new();
    }
    let own = &weighing.setup;
    let setup = Setup::with_data_and_inputs(
        &other,
        own.data.clone(),
        own.unknown_inputs.clone(),
        own.noise_roles(),
    );
    let ln_each = -elementary::ln(other.candidates.len() as f64);
    let tried = singles(&setup, seed, Effort::QUICK);
    let effects: Vec<_> = tried.into_iter().filter(|h| !h.effects.is_empty()).collect();
    let departures = weighing.posterior.departures().ln_evidence;
    let total =
        effects.iter().fold(departures, |sum, h| ln_add(sum, ln_each + h.evidence.ln_evidence));
    let mut found: Vec<UnlistedEffect> = effects
        .iter()
        .filter_map(|hypothesis| {
            let ln = ln_each + hypothesis.evidence.ln_evidence - total;
            let probability = unexplained * elementary::exp(ln);
            let candidate = other.candidates.get(*hypothesis.effects.first()?)?;
            (probability >= LEAST).then(|| UnlistedEffect {
                effect: candidate.effect.name.clone(),
                probability,
                parameters: parameters(&setup, hypothesis, coverage),
            })
        })
        .collect();
    largest_first(&mut found, |a| a.probability);
    found
}
