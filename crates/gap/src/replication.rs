//! What the data say of effects whose size each group of rows has of its own.

use super::diagnosis::{NamedQuantity, ReplicatedEffect, ReplicatedEffects};
use super::parameters::summary;
use gumption_engine::number::{COLUMN, elementary, largest_first};
use gumption_inference::OwnSizes;
use gumption_inference::latent::Map;
use gumption_inference::posterior::{Posterior, WeighedHypothesis};
use gumption_inference::setup::Setup;

/// What the data say of the sizes in each group.
pub(crate) fn report(
    setup: &Setup<'_>,
    posterior: &Posterior,
    coverage: f64,
) -> Option<ReplicatedEffects> {
    let replication = setup.case.replication.as_ref()?;
    let condition = setup.case.model.conditions.get(replication.condition)?;
    let effects = replication.effects.iter().map(|own| effect(setup, posterior, own, coverage));
    let mut effects: Vec<ReplicatedEffect> = effects.collect();
    let present = |effect: &ReplicatedEffect| effect.probability_shared + effect.probability_own;
    largest_first(&mut effects, present);
    Some(ReplicatedEffects {
        condition: NamedQuantity {
            name: condition.name.clone(),
            unit: condition.unit.text().to_owned(),
        },
        groups: replication.groups.clone(),
        effects,
    })
}

fn effect(
    setup: &Setup<'_>,
    posterior: &Posterior,
    of: &OwnSizes,
    coverage: f64,
) -> ReplicatedEffect {
    let groups = setup.case.replication.as_ref().map_or(0, |replication| replication.groups.len());
    let holding = |place: usize| -> Vec<&WeighedHypothesis> {
        posterior.hypotheses.iter().filter(|h| h.effects.contains(&place)).collect()
    };
    let (shared, own) = (holding(of.shared), holding(of.own));
    let sum = |hypotheses: &[&WeighedHypothesis]| hypotheses.iter().map(|h| h.probability).sum();
    let candidate = &setup.case.candidates[of.own];
    let maps: Vec<Map> = candidate.priors.iter().map(Map::of).collect();
    let parameters = setup.case.candidates[of.shared].effect.parameters.len();
    // for each group and the spread, values with weights
    let mut sizes: Vec<Vec<(f64, f64)>> = vec![Vec::new(); groups];
    let mut spread: Vec<(f64, f64)> = Vec::new();
    for hypothesis in &shared {
        let place = setup.parameters(&hypothesis.effects, of.shared).start;
        for (draw, weight) in weighted(hypothesis) {
            let value = maps[0].value(draw(place));
            sizes.iter_mut().for_each(|size| size.push((value, weight)));
        }
    }
    for hypothesis in &own {
        let first = setup.parameters(&hypothesis.effects, of.own).start;
        for (draw, weight) in weighted(hypothesis) {
            let value = |n: usize| maps[n].value(draw(first + n));
            let (mean, deviation) = (value(0), value(parameters));
            spread.push((deviation, weight));
            for (group, of_group) in sizes.iter_mut().enumerate() {
                let departure = deviation * value(parameters + 1 + group);
                let size =
                    if of.by_ratios { mean * elementary::exp(departure) } else { mean + departure };
                of_group.push((size, weight));
            }
        }
    }
    let unit = |place: usize| candidate.effect.parameters[place].unit.text().to_owned();
    let name = &candidate.effect.parameters[0].name;
    let shared_name = &setup.case.candidates[of.shared].effect.name;
    let sizes = sizes
        .into_iter()
        .filter_map(|draws| summary(draws, format!("{shared_name}/{name}"), unit(0), coverage));
    ReplicatedEffect {
        effect: shared_name.clone(),
        probability_shared: sum(&shared),
        probability_own: sum(&own),
        by_ratios: of.by_ratios,
        sizes: sizes.collect(),
        spread: summary(spread, format!("{shared_name}/{name}"), unit(parameters), coverage),
    }
}

/// The draws of a hypothesis: a score by its place, and the weight among all hypotheses.
fn weighted<'h>(
    hypothesis: &'h WeighedHypothesis,
) -> impl Iterator<Item = (impl Fn(usize) -> f64 + 'h, f64)> + 'h {
    let evidence = &hypothesis.evidence;
    let weights = evidence.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
    weights.map(move |(n, weight)| {
        let draw = move |place: usize| evidence.columns[n / COLUMN][place].0[n % COLUMN];
        (draw, weight * hypothesis.probability)
    })
}
