//! The inputs about which a simulator is linear beside a departure.

use crate::data::by_rows;
use crate::discrepancy::Discrepancy;
use crate::integral::search;
use crate::latent::{Map, Role};
use crate::setup::Setup;
use crate::simulator::LinearAt;

/// Inputs further than this from their estimates, as scores, are there because nothing explains the data.
const FARTHEST: f64 = 4.0;

/// The simulator's inputs that are most probable beside the heaviest departure without effects, where they are
/// further than `least` from those at which it is linear now, as scores, and not far out in their priors; `None`
/// elsewhere. `known` are points to look from, scores of the unknown quantities without effects.
pub fn beside_departure(setup: &Setup<'_>, known: &[Vec<f64>], least: f64) -> Option<LinearAt> {
    let simulator = setup.case.simulator.as_ref()?;
    let discrepancy = Discrepancy::new(setup);
    let residuals = by_rows(&setup.data.linear_residuals());
    let departure = discrepancy.evidence(setup, &residuals, f64::NEG_INFINITY);
    let with = setup.with_functions(&discrepancy.columns(setup, departure.kinds.first()?));
    let likelihood = with.likelihood(&[]);
    let now = setup.case.linear_scores(&likelihood.roles);
    let mut starts = known.to_vec();
    starts.push(now.clone());
    let mode = search::modes(&likelihood, &starts, 1).into_iter().next()?;
    let inputs = likelihood.roles.iter().enumerate().filter_map(|(place, role)| match role {
        Role::Variable { place: input, .. } => Some((place, *input, role.map()?)),
        Role::Noise { .. } | Role::Power { .. } => None,
    });
    let inputs: Vec<(usize, usize, &Map)> = inputs.collect();
    if inputs.iter().all(|(place, ..)| (mode.scores[*place] - now[*place]).abs() <= least) {
        return None;
    }
    if inputs.iter().any(|(place, ..)| mode.scores[*place].abs() > FARTHEST) {
        return None;
    }
    let mixed = likelihood.mixed(&likelihood.columns(std::slice::from_ref(&mode.scores)));
    let mut values = setup.case.task.rows.first()?.estimates();
    values.truncate(simulator.space().inputs());
    for (place, input, map) in &inputs {
        values[*input] = map.value(mixed[*place].0[0]);
    }
    let scores = inputs.iter().map(|(place, input, _)| (*input, mode.scores[*place])).collect();
    Some(LinearAt { values, scores })
}
