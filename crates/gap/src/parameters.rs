//! The parameters of effects after the data: estimates, standard uncertainties, intervals.

use super::diagnosis::{EffectParameter, PresentEffect};
use super::shrink;
use gumption_engine::number::{COLUMN, largest_first, smallest_first};
use gumption_engine::task::Row;
use gumption_inference::latent::{Map, Role};
use gumption_inference::posterior::{Posterior, WeighedHypothesis};
use gumption_inference::predict;
use gumption_inference::setup::Setup;

/// The candidate effects with the probability that each is part of the truth, most probable first,
/// and their parameters over all hypotheses that hold them.
pub(crate) fn present(
    setup: &Setup<'_>,
    posterior: &Posterior,
    coverage: f64,
) -> Vec<PresentEffect> {
    let mut present: Vec<PresentEffect> = (0..setup.case.candidates.len())
        .map(|effect| {
            let holding: Vec<&WeighedHypothesis> =
                posterior.named().filter(|h| h.effects.contains(&effect)).collect();
            let probability = holding.iter().map(|h| h.probability).sum();
            let candidate = &setup.case.candidates[effect];
            // what differs between devices is reported by itself
            let listed = setup.case.listed_parameters(effect);
            let parameters = candidate.effect.parameters.iter().zip(&candidate.priors);
            let parameters = parameters.take(listed).enumerate();
            let parameters = parameters.filter_map(|(n, (quantity, prior))| {
                let map = Map::of(prior);
                let mut draws: Vec<(f64, f64)> = Vec::new();
                for hypothesis in &holding {
                    let place = setup.parameters(&hypothesis.effects, effect).start + n;
                    let own = weighted(hypothesis, place, &map);
                    draws.extend(own.map(|(x, weight)| (x, weight * hypothesis.probability)));
                }
                let name = format!("{}/{}", candidate.effect.name, quantity.name);
                summary(draws, name, quantity.unit.text().to_owned(), coverage)
            });
            PresentEffect {
                effect: candidate.effect.name.clone(),
                probability,
                parameters: parameters.collect(),
            }
        })
        .collect();
    largest_first(&mut present, |a| a.probability);
    present
}

/// Mean, standard deviation and interval of weighted values; `None` where they weigh nothing.
pub(crate) fn summary(
    mut draws: Vec<(f64, f64)>,
    name: String,
    unit: String,
    coverage: f64,
) -> Option<EffectParameter> {
    let total: f64 = draws.iter().map(|(_, weight)| weight).sum();
    if total.is_nan() || total <= 0.0 {
        return None;
    }
    draws.iter_mut().for_each(|(_, weight)| *weight /= total);
    smallest_first(&mut draws, |a| a.0);
    let mean: f64 = draws.iter().map(|(x, w)| x * w).sum();
    let variance: f64 = draws.iter().map(|(x, w)| w * (x - mean).powi(2)).sum();
    let [lower, upper] = equal_tails(&draws, coverage);
    Some(EffectParameter {
        name,
        unit,
        estimate: mean,
        standard_uncertainty: variance.max(0.0).sqrt(),
        interval: [lower.min(mean), upper.max(mean)],
    })
}

/// Values of an unknown quantity with their weights.
fn weighted<'h>(
    hypothesis: &'h WeighedHypothesis,
    place: usize,
    map: &'h Map,
) -> impl Iterator<Item = (f64, f64)> + 'h {
    let evidence = &hypothesis.evidence;
    let weights = evidence.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
    weights.map(move |(n, &weight)| {
        (map.value(evidence.columns[n / COLUMN][place].0[n % COLUMN]), weight)
    })
}

/// The parameters of a hypothesis' effects.
pub(crate) fn parameters(
    setup: &Setup<'_>,
    hypothesis: &WeighedHypothesis,
    probability: f64,
) -> Vec<EffectParameter> {
    if !hypothesis.evidence.has_draws() {
        return Vec::new();
    }
    let likelihood = setup.likelihood(&hypothesis.effects);
    let central = CentralPoint::of(setup, hypothesis);
    let mut parameters = Vec::new();
    for &effect in &hypothesis.effects {
        let places = setup.parameters(&hypothesis.effects, effect);
        let candidate = &setup.case.candidates[effect].effect;
        for (place, quantity) in places.zip(&candidate.parameters) {
            let Some(Role::Variable { maps, .. }) = likelihood.roles.get(place) else { continue };
            let Some(map) = maps.first() else { continue };
            let mut weighted: Vec<(f64, f64)> = weighted(hypothesis, place, map).collect();
            let mean: f64 = weighted.iter().map(|(x, w)| x * w).sum();
            let variance: f64 = weighted.iter().map(|(x, w)| w * (x - mean).powi(2)).sum();
            let estimate = match &central {
                CentralPoint::Mean => mean,
                CentralPoint::At(scores) => scores.get(place).map_or(mean, |s| map.value(*s)),
            };
            smallest_first(&mut weighted, |a| a.0);
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

/// Where the estimates of a hypothesis' parameters are taken.
enum CentralPoint {
    /// The mean of each parameter, with which the model predicts what it does on average.
    Mean,
    /// The scores of one draw.
    At(Vec<f64>),
}

/// The mean of the draws predicts the data like their mean prediction where its squared distance from
/// that is below this share of the mean one of the draws, of each output.
const LIKE_THE_MEAN: f64 = 0.1;

impl CentralPoint {
    /// The means, if they predict the data like the draws do on average. They do not where parameters can
    /// be exchanged or mirrored: then the draw whose prediction is nearest to the mean prediction. The most
    /// probable point where the hypothesis is not worth that.
    fn of(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Self {
        let evidence = &hypothesis.evidence;
        let mode = evidence.modes.first().map(|mode| mode.scores.clone()).unwrap_or_default();
        if hypothesis.effects.is_empty() || hypothesis.probability < 1e-3 {
            return Self::At(mode);
        }
        // sizes of devices are products of a spread and departures, whose means fit nothing together; each
        // parameter is told by itself all the same
        let replication = setup.case.replication.as_ref();
        let own = replication.map_or(&[][..], |replication| &replication.effects);
        if own.iter().any(|replicated| hypothesis.effects.contains(&replicated.own)) {
            return Self::Mean;
        }
        let draws = evidence.resampled(128);
        let step = setup.data.points.len().div_ceil(500).max(1);
        let points = setup.data.points.iter().step_by(step);
        let rows = points.filter_map(|point| point.rows.first());
        let rows: Vec<Row> = rows.map(|&row| setup.row(row).clone()).collect();
        let values = predict::values(setup, &hypothesis.effects, &draws, &rows);
        let moments = shrink::moments(&values);
        let spread: Vec<f64> = (0..setup.data.outputs.len())
            .map(|output| {
                moments.iter().map(|row| row[output].1).sum::<f64>().max(f64::MIN_POSITIVE)
            })
            .collect();
        let distance = |values: &[Vec<Vec<f64>>], draw: usize| -> f64 {
            values
                .iter()
                .zip(&moments)
                .flat_map(|(row, means)| row.iter().zip(means).zip(&spread))
                .map(|((draws, (mean, _)), spread)| (draws[draw] - mean).powi(2) / spread)
                .sum()
        };
        let mean = mean_scores(hypothesis, mode.len());
        let of_mean = predict::values(setup, &hypothesis.effects, &[mean], &rows);
        if distance(&of_mean, 0) < LIKE_THE_MEAN * spread.len() as f64 {
            return Self::Mean;
        }
        let of_draws = |&draw: &usize| distance(&values, draw);
        let nearest = (0..draws.len()).min_by(|a, b| of_draws(a).total_cmp(&of_draws(b)));
        Self::At(nearest.map_or(mode, |nearest| draws[nearest].clone()))
    }
}

/// The mean score of each unknown quantity.
fn mean_scores(hypothesis: &WeighedHypothesis, unknowns: usize) -> Vec<f64> {
    let evidence = &hypothesis.evidence;
    let weights = evidence.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
    let mut mean = vec![0.0; unknowns];
    for (n, &weight) in weights {
        for (mean, column) in mean.iter_mut().zip(&evidence.columns[n / COLUMN]) {
            *mean += weight * column.0[n % COLUMN];
        }
    }
    mean
}

/// The interval with equal tails; values are in order, with weights that sum to one. Half of each
/// value's weight lies on either side of it.
pub(crate) fn equal_tails(weighted: &[(f64, f64)], share: f64) -> [f64; 2] {
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
