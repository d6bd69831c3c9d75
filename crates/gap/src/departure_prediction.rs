//! What "unexplained" predicts: smooth departures and composed ones together, and less sure outside
//! of the data's box.
//!
//! Within the box of the data's conditions each has the weight that the data give it. Outside of it
//! the data say little of which function goes on how: there weights are the square roots of those (as
//! if of half of the data), composed departures have at most a weight of 0.7, and the uncertainty of
//! smooth ones grows with the distance. The change is gradual over a tenth of the range.

use super::composed::Compositions;
use super::shrink;
use gumption_engine::task::Row;
use gumption_inference::discrepancy::{Discrepancy, Weighted};
use gumption_inference::predict::Normals;
use gumption_inference::setup::Setup;

/// The distance from the box, in ranges of a condition, over which weights change.
const GRADUAL: f64 = 0.1;

/// The standard uncertainty of a smooth departure grows by so many times itself for each range.
const GROWTH: f64 = 2.0;

/// Composed departures have at most this weight outside of the box: where a smooth one is right, its
/// prediction is then within two standard uncertainties of the mixture's.
const MOST_COMPOSED: f64 = 0.7;

/// Kinds of smooth departures that count outside of the box, at most.
const MOST_KINDS: usize = 40;

/// How far rows are from the box of the data, in ranges of the conditions.
fn distances(setup: &Setup<'_>, rows: &[Row]) -> Vec<f64> {
    let boxes: Vec<(f64, f64)> = (0..setup.case.measured())
        .map(|c| {
            let values = (0..setup.data.rows()).map(|row| setup.row(row).conditions[c]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        })
        .collect();
    let distance = |row: &Row| {
        let each = boxes.iter().zip(&row.conditions).map(|(&(low, high), &x)| {
            let out = (low - x).max(x - high).max(0.0);
            // a condition that does not vary in the data has no range to count in
            let range = if high > low { high - low } else { low.abs().max(f64::MIN_POSITIVE) };
            out / range
        });
        each.fold(0.0, f64::max)
    };
    rows.iter().map(distance).collect()
}

/// How many of these rows are outside of the box of the data.
pub(crate) fn outside(setup: &Setup<'_>, rows: &[Row]) -> usize {
    distances(setup, rows).into_iter().filter(|distance| *distance > 0.0).count()
}

/// What "unexplained" says in rows that count as within the box of the data, as a block of conditions
/// does that was left out.
pub(crate) fn within(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    kinds: &[Weighted],
    compositions: &Compositions,
    rows: &[Row],
) -> Normals {
    let process = discrepancy.predict(setup, shrink::top(kinds), rows, false);
    joined(process, &compositions.predictions(setup, rows), &vec![0.0; rows.len()])
}

/// What "unexplained" says in rows: means and variances of the outputs.
pub(crate) fn unexplained(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    kinds: &[Weighted],
    compositions: &Compositions,
    rows: &[Row],
) -> Normals {
    let distances = distances(setup, rows);
    let mut process = discrepancy.predict(setup, shrink::top(kinds), rows, false);
    let outside: Vec<usize> = (0..rows.len()).filter(|&row| distances[row] > 0.0).collect();
    if !outside.is_empty() {
        let of_rows: Vec<Row> = outside.iter().map(|&row| rows[row].clone()).collect();
        let mut tempered: Vec<Weighted> = kinds.to_vec();
        tempered.iter_mut().for_each(|kind| kind.weight = kind.weight.sqrt());
        tempered.truncate(MOST_KINDS);
        let there = discrepancy.predict(setup, &tempered, &of_rows, true);
        for (place, of_row) in outside.iter().zip(there) {
            let share = (distances[*place] / GRADUAL).min(1.0);
            let growth = (1.0 + GROWTH * distances[*place]).powi(2);
            for (own, other) in process[*place].iter_mut().zip(of_row) {
                *own = mixed(&[(1.0 - share, *own), (share, (other.0, other.1 * growth))]);
            }
        }
    }
    joined(process, &compositions.predictions(setup, rows), &distances)
}

/// Smooth and composed departures together, at these distances from the box.
fn joined(process: Normals, composed: &[(f64, Normals)], distances: &[f64]) -> Normals {
    if composed.is_empty() {
        return process;
    }
    let together: f64 = composed.iter().map(|(share, _)| share).sum();
    let roots: f64 = composed.iter().map(|(share, _)| share.sqrt()).sum();
    // none of them has a share that a number holds
    if roots == 0.0 {
        return process;
    }
    (0..process.len())
        .map(|row| {
            let out = (distances[row] / GRADUAL).min(1.0);
            // what is not composed is smooth
            let rest = (1.0 - together).max(0.0);
            let half = (together.sqrt() / (together.sqrt() + rest.sqrt())).min(MOST_COMPOSED);
            let smooth = (1.0 - out) * rest + out * (1.0 - half);
            process[row]
                .iter()
                .enumerate()
                .map(|(output, &own)| {
                    let mut parts = vec![(smooth, own)];
                    parts.extend(composed.iter().map(|(share, normals)| {
                        let weight = (1.0 - out) * share + out * half * share.sqrt() / roots;
                        (weight, normals[row][output])
                    }));
                    mixed(&parts)
                })
                .collect()
        })
        .collect()
}

/// Weights below this are not told from none: evidences are not known that well, and an exponential that
/// runs away would make the whole mean of it.
const LEAST_WEIGHT: f64 = 1e-4;

/// Mean and variance of a mixture.
fn mixed(parts: &[(f64, (f64, f64))]) -> (f64, f64) {
    let parts = parts.iter().filter(|(weight, _)| *weight >= LEAST_WEIGHT);
    let total: f64 = parts.clone().map(|(weight, _)| weight).sum();
    let mean = parts.clone().map(|(weight, (mean, _))| weight * mean).sum::<f64>() / total;
    let variance = parts
        .map(|(weight, (own, variance))| weight * (variance + (own - mean) * (own - mean)))
        .sum::<f64>();
    (mean, variance / total)
}
