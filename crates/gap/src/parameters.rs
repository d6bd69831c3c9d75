//! The parameters of effects after the data: estimates, standard uncertainties, intervals.

use super::diagnosis::EffectParameter;
use super::latent::Role;
use super::posterior;
use super::predict;
use super::setup::Setup;
use super::shrink;
use gumption_engine::number::COLUMN;
use gumption_engine::task::Row;

/// The parameters of a hypothesis' effects.
pub(crate) fn parameters(
    setup: &Setup<'_>,
    hypothesis: &posterior::WeighedHypothesis,
    probability: f64,
) -> Vec<EffectParameter> {
    let likelihood = setup.likelihood(&hypothesis.effects);
    let evidence = &hypothesis.evidence;
    let central = central_draw(setup, hypothesis);
    let mut parameters = Vec::new();
    for &effect in &hypothesis.effects {
        let places = setup.parameters(&hypothesis.effects, effect);
        let candidate = &setup.case.candidates[effect].effect;
        for (place, quantity) in places.zip(&candidate.parameters) {
            let Some(Role::Variable { maps, .. }) = likelihood.roles.get(place) else { continue };
            let Some(map) = maps.first() else { continue };
            let mut weighted: Vec<(f64, f64)> = evidence
                .weights
                .iter()
                .enumerate()
                .filter(|(_, weight)| **weight > 0.0)
                .map(|(n, &weight)| {
                    (map.value(evidence.columns[n / COLUMN][place].0[n % COLUMN]), weight)
                })
                .collect();
            let mean: f64 = weighted.iter().map(|(x, w)| x * w).sum();
            let variance: f64 = weighted.iter().map(|(x, w)| w * (x - mean).powi(2)).sum();
            let estimate = central.get(place).map_or(mean, |score| map.value(*score));
            weighted.sort_by(|a, b| a.0.total_cmp(&b.0));
            let [lower, upper] = equal_tails(&weighted, probability);
            parameters.push(EffectParameter {
                name: format!("{}/{}", candidate.name, quantity.name),
                unit: quantity.unit.text().to_owned(),
                estimate,
                standard_uncertainty: variance.max(0.0).sqrt(),
                interval: [lower.min(estimate), upper.max(estimate)],
            });
        }
    }
    parameters
}

/// The draw whose prediction of the data is nearest to the mean prediction; the most probable point
/// where the hypothesis is not worth that.
fn central_draw(setup: &Setup<'_>, hypothesis: &posterior::WeighedHypothesis) -> Vec<f64> {
    let mode =
        hypothesis.evidence.modes.first().map(|mode| mode.scores.clone()).unwrap_or_default();
    if hypothesis.effects.is_empty() || hypothesis.probability < 1e-3 {
        return mode;
    }
    let draws = hypothesis.evidence.resampled(128);
    let step = setup.data.points.len().div_ceil(500).max(1);
    let rows: Vec<Row> = setup
        .data
        .points
        .iter()
        .step_by(step)
        .filter_map(|point| point.rows.first())
        .map(|&row| setup.case.task.rows[setup.data.ids[row]].clone())
        .collect();
    let values = predict::values(setup, &hypothesis.effects, &draws, &rows);
    let moments = shrink::moments(&values);
    let spread: Vec<f64> = (0..setup.data.outputs.len())
        .map(|output| moments.iter().map(|row| row[output].1).sum::<f64>().max(f64::MIN_POSITIVE))
        .collect();
    let distance = |draw: usize| -> f64 {
        values
            .iter()
            .zip(&moments)
            .flat_map(|(row, means)| row.iter().zip(means).zip(&spread))
            .map(|((draws, (mean, _)), spread)| (draws[draw] - mean).powi(2) / spread)
            .sum()
    };
    let nearest = (0..draws.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    nearest.map_or(mode, |nearest| draws[nearest].clone())
}

/// The interval with equal tails; values are in order, with weights that sum to one. Half of each
/// value's weight lies on either side of it.
fn equal_tails(weighted: &[(f64, f64)], share: f64) -> [f64; 2] {
    let tail = 0.5 * (1.0 - share);
    [quantile(weighted, tail), quantile(weighted, 1.0 - tail)]
}

fn quantile(weighted: &[(f64, f64)], p: f64) -> f64 {
    let mut before = 0.0;
    let mut last: Option<(f64, f64)> = None;
    for &(value, weight) in weighted {
        let middle = before + 0.5 * weight;
        if middle >= p {
            return match last {
                Some((lower, at)) if middle > at => {
                    lower + (value - lower) * (p - at) / (middle - at)
                }
                _ => value,
            };
        }
        before += weight;
        last = Some((value, middle));
    }
    last.map_or(f64::NAN, |(value, _)| value)
}
