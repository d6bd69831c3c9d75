//! What to measure next: the conditions whose measurement would separate two hypotheses best.

use rayon::prelude::*;

use super::diagnosis::NextMeasurement;
use super::logarithm::{HALF_LN_TWO_PI, ln_sum};
use super::posterior::Posterior;
use super::predict;
use super::setup::Setup;
use crate::mixture::standard_normals;
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{COLUMN, Column, elementary};
use gumption_engine::task::{Row, Sharing};

/// Conditions that are tried at most.
const MOST_CANDIDATES: usize = 600;

/// Draws of each hypothesis.
const DRAWS: usize = 256;

/// How many of the most promising conditions are looked at closely.
const FINALISTS: usize = 8;

/// The best measurement to tell `verdict` from `rival` (places of hypotheses). `variances` are those
/// of the noise by value.
pub(crate) fn best(
    setup: &Setup<'_>,
    posterior: &Posterior,
    verdict: usize,
    rival: usize,
    variances: &[f64],
    seed: u64,
) -> Option<NextMeasurement> {
    let rows = candidates(setup);
    let draws = |place: usize| {
        let hypothesis = &posterior.hypotheses[place];
        let draws = hypothesis.evidence.resampled(DRAWS);
        predict::values(setup, &hypothesis.effects, &draws, &rows)
    };
    let (own, other) = (draws(verdict), draws(rival));
    let outputs = setup.data.outputs.len();
    let noise: Vec<f64> = (0..outputs)
        .map(|output| {
            let mut of: Vec<f64> =
                variances.iter().skip(output).step_by(outputs).copied().collect();
            of.sort_by(f64::total_cmp);
            of.get(of.len() / 2).copied().unwrap_or(1.0)
        })
        .collect();
    // first a rough order by two normal distributions, then the expectation itself
    let mut ranked: Vec<(f64, usize)> =
        (0..rows.len()).map(|row| (rough(&own[row], &other[row], &noise), row)).collect();
    ranked.retain(|(gain, _)| gain.is_finite());
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    ranked.truncate(FINALISTS);
    let (gain, row) = ranked
        .into_par_iter()
        .map(|(_, row)| (expected(&own[row], &other[row], &noise, seed), row))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    let names = |place: usize| {
        let effects = &posterior.hypotheses[place].effects;
        effects.iter().map(|&e| setup.case.candidates[e].effect.name.clone()).collect()
    };
    Some(NextMeasurement {
        separates: [names(verdict), names(rival)],
        conditions: rows[row].conditions.clone(),
        expected_log_odds: gain,
    })
}

/// Rows at all combinations of the levels of the data and, between those of the condition with most
/// levels, their middles. What is known about inputs that differ from row to row is taken from the
/// row with the nearest conditions, so such cases stay at the data's own rows.
fn candidates(setup: &Setup<'_>) -> Vec<Row> {
    let conditions = setup.case.model.conditions.len();
    let first = |point: &super::data::Point| point.rows.first().map(|&row| setup.data.ids[row]);
    let measured: Vec<&Row> =
        setup.data.points.iter().filter_map(first).map(|id| &setup.case.task.rows[id]).collect();
    let own = || -> Vec<Row> {
        let step = measured.len().div_ceil(MOST_CANDIDATES).max(1);
        measured.iter().step_by(step).map(|row| (*row).clone()).collect()
    };
    let Some(template) = measured.first() else { return Vec::new() };
    let same = measured.iter().all(|row| row.distributions == template.distributions);
    let by_condition =
        setup.case.task.variables.iter().any(|v| matches!(v.sharing, Sharing::Condition(_)));
    if !same || by_condition || setup.case.simulated > 0 || conditions == 0 {
        return own();
    }
    let mut axes: Vec<Vec<f64>> = (0..conditions)
        .map(|condition| {
            let mut values: Vec<f64> =
                measured.iter().map(|row| row.conditions[condition]).collect();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        })
        .collect();
    if let Some(longest) = axes.iter_mut().max_by_key(|axis| axis.len()) {
        let middle = |pair: &[f64]| {
            if pair[0] > 0.0 { (pair[0] * pair[1]).sqrt() } else { 0.5 * (pair[0] + pair[1]) }
        };
        let middles: Vec<f64> = longest.windows(2).map(middle).collect();
        if longest.len() < 100 {
            longest.extend(middles);
        }
    }
    let count = axes.iter().try_fold(1usize, |n, axis| n.checked_mul(axis.len()));
    if count.is_none_or(|count| count > MOST_CANDIDATES) {
        return own();
    }
    (0..count.unwrap_or(0))
        .map(|number| {
            let mut left = number;
            let conditions = axes.iter().map(|axis| {
                let value = axis[left % axis.len()];
                left /= axis.len();
                value
            });
            Row { conditions: conditions.collect(), distributions: template.distributions.clone() }
        })
        .collect()
}

/// The expected logarithm of the odds where both predictions are normal and outputs independent.
fn rough(own: &[Vec<f64>], other: &[Vec<f64>], noise: &[f64]) -> f64 {
    let moments = |draws: &[f64]| {
        let n = draws.len().max(1) as f64;
        let mean = draws.iter().sum::<f64>() / n;
        (mean, draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n)
    };
    own.iter()
        .zip(other)
        .zip(noise)
        .map(|((own, other), noise)| {
            let ((a, va), (b, vb)) = (moments(own), moments(other));
            let (va, vb) = (va + noise, vb + noise);
            0.5 * ((va + (a - b).powi(2)) / vb - 1.0 + elementary::ln(vb / va))
        })
        .sum()
}

/// The expectation of the gain in the logarithm of the odds of the verdict against its rival, if the
/// verdict is true: the relative entropy of their predictive densities. Each draw of the verdict is
/// measured once and left out of its own density.
pub(crate) fn expected(own: &[Vec<f64>], other: &[Vec<f64>], noise: &[f64], seed: u64) -> f64 {
    let draws = own.first().map_or(0, Vec::len);
    let outputs = own.len();
    let mut stream = StreamKey::new(seed, "gap/next").block(0);
    let mut normals = vec![Vec::with_capacity(draws + COLUMN); outputs];
    for normals in &mut normals {
        while normals.len() < draws {
            let mut column = Column::ZERO;
            standard_normals(&mut stream, &mut column);
            normals.extend(column.0);
        }
    }
    let ln_density = |values: &[Vec<f64>], measured: &[f64], without: Option<usize>| {
        let count = values.first().map_or(0, Vec::len);
        let each: Vec<f64> = (0..count)
            .filter(|draw| Some(*draw) != without)
            .map(|draw| {
                (0..outputs)
                    .map(|o| {
                        let z = (measured[o] - values[o][draw]).powi(2) / noise[o];
                        -0.5 * (z + elementary::ln(noise[o])) - HALF_LN_TWO_PI
                    })
                    .sum()
            })
            .collect();
        ln_sum(each.iter().copied()) - elementary::ln(each.len().max(1) as f64)
    };
    let total: f64 = (0..draws)
        .map(|draw| {
            let measured: Vec<f64> =
                (0..outputs).map(|o| own[o][draw] + noise[o].sqrt() * normals[o][draw]).collect();
            ln_density(own, &measured, Some(draw)) - ln_density(other, &measured, None)
        })
        .sum();
    total / draws.max(1) as f64
}
