//! Effects that explain the data with a size that their prior all but excludes.

use super::diagnosis::PriorConflict;
use super::parameters::parameters;
use crate::Case;
use gumption_engine::distribution::Distribution;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::{elementary, largest_first};
use gumption_inference::noise::weighing::Weighing;

/// Conflicts below this probability are not worth a word.
const LEAST: f64 = 0.01;

/// A normal prior contradicts an estimate from so many standard deviations on.
const FAR: f64 = 3.0;

/// The conflicts, most probable first, with intervals of this coverage probability.
pub(crate) fn conflicts(
    case: &Case,
    weighings: &[Weighing<'_>],
    coverage: f64,
) -> Vec<PriorConflict> {
    let mut found = Vec::new();
    for weighing in weighings {
        let Some(widened) = weighing.widths.widened() else { continue };
        for alone in &weighing.posterior.hypotheses {
            let hypothesis = weighing.posterior.together(alone);
            let probability = hypothesis.probability * weighing.probability;
            if probability < LEAST {
                continue;
            }
            let effects = weighing.setup.effect_names(&hypothesis.effects);
            let candidates = hypothesis.effects.iter().map(|&effect| &case.candidates[effect]);
            let priors = candidates.flat_map(|candidate| {
                candidate.priors.iter().map(|prior| (&candidate.effect, prior))
            });
            let estimated = parameters(&weighing.setup, &hypothesis, coverage);
            for (parameter, (effect, prior)) in estimated.into_iter().zip(priors) {
                let (prior_distance, bounded) = distance(prior, parameter.estimate);
                if prior_distance > if bounded { 0.0 } else { FAR } {
                    found.push(PriorConflict {
                        effect: effect.name.clone(),
                        effects: effects.clone(),
                        parameter,
                        prior_distance,
                        bounded,
                        widened,
                        probability,
                    });
                }
            }
        }
    }
    largest_first(&mut found, |a| a.probability);
    found
}

/// How far a value is from a prior, and whether that is beyond a bound.
fn distance(prior: &Distribution, value: f64) -> (f64, bool) {
    let [low, high] = [prior.quantile(0.25), prior.quantile(0.75)];
    let beyond = |low: f64, high: f64, value: f64| {
        // the quartiles are half a width apart
        let width = 2.0 * (high - low);
        let middle = 0.5 * (low + high);
        ((value - middle).abs() / width - 0.5, true)
    };
    match prior {
        Distribution::Rectangular(_) => beyond(low, high, value),
        Distribution::LogUniform(_) => {
            beyond(elementary::ln(low), elementary::ln(high), elementary::ln(value))
        }
        _ => ((value - prior.mean()).abs() / prior.standard_uncertainty(), false),
    }
}

/// What is to be said of a conflict.
pub(crate) fn note(conflict: &PriorConflict) -> Fact {
    let PriorConflict { effect, effects, parameter, prior_distance, probability, widened, .. } =
        conflict;
    let who = match &effects[..] {
        [others @ .., last] if !others.is_empty() => {
            fact!("effects-together", others = others.to_vec(), last)
        }
        _ => fact!("effect-alone", effect),
    };
    fact!(
        "prior-conflict",
        who,
        parameter = &parameter.name,
        distance = Argument::Number(format!("{prior_distance:.1}")),
        counted_in = conflict.counted_in(),
        probability = Argument::Number(format!("{probability:.2}")),
        widened = *widened,
    )
}
