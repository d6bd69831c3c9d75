//! The promise of the next measurement.

use super::line;
use crate::Case;
use crate::discrepancy::Discrepancy;
use crate::mixture::standard_normals;
use crate::next::expected;
use crate::posterior::{Effort, Posterior, posterior, singles};
use crate::predict;
use crate::setup::Setup;
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::Column;
use gumption_engine::special::normal;
use gumption_engine::task::Row;

/// Two normal predictions with one output: the relative entropy is known.
#[test]
fn the_expectation_is_the_relative_entropy_of_normal_predictions() {
    // draws spread evenly, so that only the noise of what is measured is left to chance
    let scores = (0..1024).map(|i| normal::quantile((f64::from(i) + 0.5) / 1024.0));
    let own: Vec<f64> = scores.clone().map(|z| 1.0 + 0.5 * z).collect();
    let other: Vec<f64> = scores.map(|z| 0.8 * z).collect();
    let noise = 0.3;
    let of_seed =
        |seed| expected(std::slice::from_ref(&own), std::slice::from_ref(&other), &[noise], seed);
    let found = (1..=16).map(of_seed).sum::<f64>() / 16.0;
    let (va, vb): (f64, f64) = (0.25 + noise, 0.64 + noise);
    let exact = 0.5 * ((va + 1.0) / vb - 1.0 + (vb / va).ln());
    // by a separate simulation the noise leaves each seed a standard deviation of 0.019; five of the
    // mean of 16
    assert!((found - exact).abs() < 0.024, "{found} {exact}");
}

/// Measures a case's proposed row many times and looks how the odds change; the mean over the sets
/// is to be what was promised within 20 %. Takes minutes.
#[test]
#[ignore = "a study of minutes"]
fn promises_are_kept() {
    let case = line();
    let odds = |case: &Case| -> (Posterior, f64) {
        let setup = Setup::new(case);
        let discrepancy = Discrepancy::new(&setup);
        let effort = Effort::FULL;
        let found = posterior(
            &setup,
            singles(&setup, 1, effort),
            &discrepancy,
            1,
            effort,
            f64::NEG_INFINITY,
            &|_| {},
        );
        let ln = |effects: &[usize]| {
            let own = found.hypotheses.iter().find(|h| h.effects == effects).unwrap();
            own.evidence.ln_evidence
        };
        let odds = ln(&[0]) - ln(&[1]);
        (found, odds)
    };
    let setup = Setup::new(&case);
    let (found, before) = odds(&case);
    let own = found.hypotheses.iter().position(|h| h.effects == [0]).unwrap();
    let rival = found.hypotheses.iter().position(|h| h.effects == [1]).unwrap();
    let variances = vec![0.01; 12];
    let next = crate::next::best(&setup, &found, own, rival, &variances, 1).unwrap();
    let mut row: Row = case.task.rows[0].clone();
    row.conditions = next.conditions.clone();
    let draws = found.hypotheses[own].evidence.resampled(100);
    let values = predict::values(&setup, &[0], &draws, &[row.clone()]);
    let mut stream = StreamKey::new(9, "test").block(0);
    let mut normals = [Column::ZERO, Column::ZERO];
    for column in &mut normals {
        standard_normals(&mut stream, column);
    }
    let mut total = 0.0;
    for set in 0..100 {
        let mut more = case.clone();
        more.task.rows.push(row.clone());
        for (output, observed) in more.observed.iter_mut().flatten().enumerate() {
            observed.values.push(values[0][output][set] + 0.1 * normals[output].0[set]);
            observed.standard_uncertainties.as_mut().unwrap().push(0.1);
        }
        total += odds(&more).1 - before;
    }
    let mean = total / 100.0;
    let promised = next.expected_log_odds;
    assert!((mean / promised - 1.0).abs() < 0.2, "promised {promised}, kept {mean}");
}
