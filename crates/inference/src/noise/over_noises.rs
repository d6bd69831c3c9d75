//! One posterior over all that the noise may be: probabilities are summed, draws are put together.
//!
//! What the noise is does not only decide between hypotheses, it decides how large an effect may be
//! and how wide its interval is. Sizes and predictions are therefore those of the mixture of all
//! noises, and not those of the most probable one.

use std::sync::Arc;

use crate::beside::{self, Beside};
use crate::discrepancy::{Discrepancy, Unexplained};
use crate::integral::evidence::EvidenceEstimate;
use crate::latent::{Role, score_as, score_of_none};
use crate::noise::noise_model::NoiseModel;
use crate::noise::prior_widths::PriorWidths;
use crate::noise::weighing::{Weighing, most_probable};
use crate::posterior::{Posterior, WeighedHypothesis};
use crate::setup::Setup;
use gumption_engine::number::Column;

/// A hypothesis below this probability is not worth more draws.
const LEAST: f64 = 1e-3;

/// A noise with less than this share of a hypothesis does not move its draws.
const LEAST_SHARE: f64 = 0.01;

/// The weighing with the most probable noise, in which the probabilities of hypotheses are summed
/// over what the noise may be and their draws are those of all noises.
pub fn summed(mut weighings: Vec<Weighing<'_>>) -> (Setup<'_>, Arc<Discrepancy>, Posterior) {
    let most = most_probable(&weighings);
    let mut first = weighings.swap_remove(most);
    let other = first.widths != PriorWidths::AsStated;
    if let (true, Some(stated)) = (other, weighings.first_mut()) {
        // few pairs are among the hypotheses with other priors, whose draws those of the rest are not
        let own = &mut first.posterior.hypotheses;
        let theirs = std::mem::take(&mut stated.posterior.hypotheses);
        let (known, pairs): (Vec<_>, Vec<_>) =
            theirs.into_iter().partition(|h| own.iter().any(|other| other.effects == h.effects));
        stated.posterior.hypotheses = known;
        own.extend(pairs.into_iter().map(|pair| WeighedHypothesis {
            probability: pair.probability * stated.probability / first.probability,
            evidence: pair.evidence.without_draws(),
            ..pair
        }));
    }
    let Weighing { setup, discrepancy, mut posterior, probability: own_share, .. } = first;
    let stated = NoiseModel::default().hypotheses(setup.case);
    let scale = |factor: f64, own: f64| if own > 0.0 { factor / own } else { 1.0 };
    let own = setup.prior();
    for hypothesis in &mut posterior.hypotheses {
        // as the case has it, where the noise is as stated
        hypothesis.prior *= match hypothesis.effects.len() {
            0 => scale(stated.none, own.none),
            1 => scale(stated.one, own.one),
            2 => scale(stated.two, own.two),
            _ => scale(stated.three, own.three),
        };
    }
    posterior.prior *= scale(stated.unexplained, own.unexplained);
    posterior.departure_prior *= scale(stated.unexplained, own.unexplained);
    for hypothesis in &mut posterior.hypotheses {
        let effects = hypothesis.effects.clone();
        let has_draws = hypothesis.evidence.has_draws();
        sum(&setup, hypothesis, own_share, has_draws, &weighings, &|w| w.posterior.of(&effects));
    }
    // a departure that another noise has is one of the forms there
    for other in weighings.iter().flat_map(|w| &w.posterior.beside) {
        if posterior.beside(&other.named.effects).is_none() {
            let kinds = Vec::new();
            posterior.beside.push(Beside {
                named: WeighedHypothesis {
                    probability: 0.0,
                    evidence: other.named.evidence.clone().without_draws(),
                    ..other.named.clone()
                },
                departure: Unexplained { kinds, ..other.departure },
            });
        }
    }
    for beside_effects in &mut posterior.beside {
        let effects = beside_effects.named.effects.clone();
        beside_effects.named.prior = beside::prior(setup.case, &stated, &effects);
        sum(&setup, &mut beside_effects.named, own_share, true, &weighings, &|w| {
            Some(&w.posterior.beside(&effects)?.named)
        });
    }
    let unexplained = |w: &Weighing<'_>| w.probability * w.posterior.probability;
    let others = weighings.iter().map(unexplained).sum::<f64>();
    posterior.probability = (posterior.probability * own_share + others).min(1.0);
    (setup, discrepancy, posterior)
}

/// Adds to a hypothesis what it is with every other noise, `theirs`: the probabilities, and the draws as
/// those of a setup if these are wanted. `own_share` is the probability of its own noise.
fn sum<'w, 'c: 'w>(
    setup: &Setup<'_>,
    hypothesis: &mut WeighedHypothesis,
    own_share: f64,
    with_draws: bool,
    weighings: &'w [Weighing<'c>],
    theirs: &dyn Fn(&'w Weighing<'c>) -> Option<&'w WeighedHypothesis>,
) {
    let own = hypothesis.probability * own_share;
    let others: Vec<(f64, &Weighing<'_>, &WeighedHypothesis)> = weighings
        .iter()
        .filter_map(|w| Some((w, theirs(w)?)))
        .map(|(w, theirs)| (w.probability * theirs.probability, w, theirs))
        .collect();
    let all = own + others.iter().map(|(p, ..)| p).sum::<f64>();
    // sums to one but for the bits
    hypothesis.probability = all.min(1.0);
    if all < LEAST || !with_draws {
        return;
    }
    let roles = setup.likelihood(&hypothesis.effects).roles;
    let parts: Vec<(f64, Vec<Vec<Column>>, &EvidenceEstimate)> = others
        .into_iter()
        .filter(|(p, _, theirs)| p / all > LEAST_SHARE && theirs.evidence.has_draws())
        .filter_map(|(p, weighing, theirs)| {
            let from = weighing.setup.likelihood(&theirs.effects).roles;
            let columns = theirs.evidence.columns.iter();
            let converted = columns.map(|scores| converted(scores, &from, &roles));
            Some((p, converted.collect::<Option<_>>()?, &theirs.evidence))
        })
        .collect();
    let evidence = &mut hypothesis.evidence;
    evidence.scale_weights(own);
    for (p, columns, theirs) in parts {
        evidence.append(p, columns, &theirs.weights);
    }
    let sum: f64 = evidence.weights.iter().sum();
    if sum > 0.0 {
        evidence.scale_weights(sum.recip());
    }
}

/// Scores of the unknown quantities `from` as those of `to`; `None` where a quantity has a prior from
/// which its values cannot be taken back.
fn converted(scores: &[Column], from: &[Role], to: &[Role]) -> Option<Vec<Column>> {
    let score = |role: &Role| -> Option<Column> {
        let Some(at) = from.iter().position(|other| other.is_same_quantity(role)) else {
            return Some(Column([score_of_none(role)?; gumption_engine::number::COLUMN]));
        };
        let mut column = scores.get(at)?.clone();
        for value in &mut column.0 {
            *value = score_as(*value, &from[at], role)?;
        }
        Some(column)
    };
    to.iter().map(score).collect()
}

#[cfg(test)]
mod tests {
    use super::converted;
    use crate::latent::{Map, Role};
    use gumption_engine::number::Column;

    #[test]
    fn scores_are_those_of_the_same_values() {
        let uniform = |lower: f64, width: f64| Map::Uniform { lower, width };
        let of = |map: Map| Role::Variable { place: 3, maps: vec![map] };
        let factor = Role::Noise { output: 0, map: uniform(-1.0, 4.0) };
        let from = [of(uniform(0.0, 1.0))];
        let to = [factor, of(uniform(-1.0, 5.0))];
        let Some(found) = converted(&[Column([0.7; 128])], &from, &to) else { panic!() };
        // a factor of one, and the same value
        assert!(to[0].map().unwrap().value(found[0].0[5]).abs() < 1e-15);
        let (was, is) =
            (from[0].map().unwrap().value(0.7), to[1].map().unwrap().value(found[1].0[5]));
        assert!((was - is).abs() < 1e-15, "{was} {is}");
    }
}
