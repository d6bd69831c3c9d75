//! The promise of the next measurement.

use super::line;
use crate::Case;
use crate::discrepancy::Discrepancy;
use crate::mixture::standard_normals;
use crate::next::expected;
use crate::posterior::{Effort, Posterior, posterior};
use crate::predict;
use crate::setup::Setup;
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{COLUMN, Column};
use gumption_engine::task::Row;

/// Two normal predictions with one output: the relative entropy is known.
#[test]
fn the_expectation_is_the_relative_entropy_of_normal_predictions() {
    let mut columns = Vec::new();
    let mut stream = StreamKey::new(2, "test").block(0);
    for _ in 0..32 {
        let mut column = Column::ZERO;
        standard_normals(&mut stream, &mut column);
        columns.extend(column.0);
    }
    let (first, second) = columns.split_at(16 * COLUMN);
    let own: Vec<f64> = first.iter().map(|z| 1.0 + 0.5 * z).collect();
    let other: Vec<f64> = second.iter().map(|z| 0.8 * z).collect();
    let noise = 0.3;
    let found = expected(&[own], &[other], &[noise], 3);
    let (va, vb): (f64, f64) = (0.25 + noise, 0.64 + noise);
    let exact = 0.5 * ((va + 1.0) / vb - 1.0 + (vb / va).ln());
    // 2048 draws: a standard deviation of about 1.0 per draw, and mixtures of as many components
    assert!((found - exact).abs() < 0.08, "{found} {exact}");
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
        let found = posterior(&setup, &discrepancy, 1, effort, &|_| {});
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
