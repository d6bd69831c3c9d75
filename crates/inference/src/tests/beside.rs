//! Effects with a departure beside them against dense normal densities, and what departures say outside.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::cases::{candidate, case, line, normal, observed};
use super::ln_normal;
use crate::beside::Beside;
use crate::discrepancy::{Base, Discrepancy, Weighted};
use crate::integral::search::at_points;
use crate::logarithm::ln_add;
use crate::posterior::Effort;
use crate::setup::Setup;
use gumption_engine::distribution::StreamKey;
use gumption_engine::task::{Row, Sharing};

/// y = a + 0.5 x + o with o of 0 +- 0.4: linear in everything.
fn linear(values: &[f64], u: f64) -> crate::Case {
    case(
        normal(1.0, 0.3),
        Sharing::All,
        &[("y", "a + 0.5*x")],
        vec![observed(values, Some(&vec![u; values.len()]))],
        vec![candidate("tilt", "o", normal(0.1, 0.4), &[("y", "y + o*x")])],
    )
}

const VALUES: [f64; 12] = [1.0, 1.9, 3.3, 3.9, 4.4, 4.9, 6.3, 7.8, 8.6, 8.9, 9.4, 10.9];

/// The logarithm of the evidence of a form at an amplitude with effect, input and noise together.
fn dense(setup: &Setup<'_>, features: &DMatrix<f64>) -> f64 {
    let n = VALUES.len();
    let covariance = DMatrix::from_fn(n, n, |i, j| {
        let noise = if i == j { 0.01 } else { 0.0 };
        noise + 0.09 + 0.16 * (i * j) as f64
    });
    let mean = |i: usize| 1.0 + 0.6 * i as f64;
    let left = DVector::from_fn(n, |i, _| setup.data.values[0][i] - mean(i));
    ln_normal(&left, &(covariance + features * features.transpose()))
}

/// Where everything is linear the evidence with effects at any point is that of the dense covariance of
/// noise, input, effect and departure, form by form and amplitude by amplitude.
#[test]
fn the_effects_size_is_integrated_out_with_the_departure() {
    let case = linear(&VALUES, 0.1);
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let likelihood = setup.likelihood(&[0]);
    let unknowns = setup.roles.len() + 1;
    for score in [0.0, 1.5] {
        let mode = at_points(&likelihood, &[vec![score; unknowns]]).remove(0);
        let base = Arc::new(Base::at(&setup, &[0], &mode).unwrap());
        let found = discrepancy.evidence_beside(&setup, &base, f64::NEG_INFINITY);
        for kind in found.kinds.iter().step_by(23) {
            let form = &discrepancy.forms[kind.form];
            let features = form.features(&setup, &discrepancy.axes).into_owned() * kind.multiplier;
            let wanted = dense(&setup, &features) + form.ln_weight - 48f64.ln();
            let own = found.ln_evidence + kind.weight.ln();
            // differences of 1e-3 of a linear function, and matrices with condition numbers up to 1e8
            assert!((own - wanted).abs() < 1e-5, "{:?}: {own}, not {wanted}", form.term);
        }
    }
}

/// The integral over the effect's size and the sum over the departures, from a mode far off.
#[test]
fn the_evidence_beside_a_departure_is_the_sum_over_all_of_them() {
    let case = linear(&VALUES, 0.1);
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let likelihood = setup.likelihood(&[0]);
    let start = at_points(&likelihood, &[vec![-2.0; setup.roles.len() + 1]]);
    let key = StreamKey::new(1, "test");
    let floor = f64::NEG_INFINITY;
    let found =
        Beside::fitted(&setup, &discrepancy, &[0], &start, key, Effort::FULL, floor).unwrap();
    let mut wanted = f64::NEG_INFINITY;
    for form in &discrepancy.forms {
        let unit = form.features(&setup, &discrepancy.axes).into_owned();
        for amplitude in crate::discrepancy::amplitudes() {
            let ln = dense(&setup, &(&unit * amplitude)) + form.ln_weight - 48f64.ln();
            wanted = ln_add(wanted, ln);
        }
    }
    // some hundred effective draws know the logarithm to 0.1
    let own = found.named.evidence.ln_evidence;
    assert!((own - wanted).abs() < 0.3, "{own}, not {wanted}");
}

/// Farther from the data nothing that a departure may be is surer, and far away its standard uncertainty
/// is its amplitude, or more where the data say little of inputs or of a trend.
#[test]
fn no_departure_is_surer_farther_from_the_data() {
    let case = line();
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let at = |x: f64| Row { conditions: vec![x], ..case.task.rows[0].clone() };
    let places = [5.0, 5.2, 5.5, 6.0, 6.5, 7.0, 8.0, 10.0, 13.0, 20.0, 40.0, 100.0, 1000.0];
    let rows: Vec<Row> = places.iter().map(|&x| at(x)).collect();
    for (place, form) in discrepancy.forms.iter().enumerate() {
        for multiplier in [3.0, 30.0] {
            let kind =
                Weighted { form: place, multiplier, weight: 1.0, base: None, variances: None };
            let said = discrepancy.predict(&setup, &[kind], &rows, &[]);
            let u = |row: usize, output: usize| said[row][output].1.sqrt();
            for &output in &form.term.outputs {
                for row in 1..rows.len() {
                    // but for rounding
                    assert!(
                        u(row, output) >= u(row - 1, output) * (1.0 - 1e-6),
                        "{:?} {}: {} at {}, {} at {}",
                        form.term,
                        form.length,
                        u(row - 1, output),
                        places[row - 1],
                        u(row, output),
                        places[row]
                    );
                }
                if form.term.is_smooth() && !form.term.relative {
                    let amplitude = multiplier * form.scale;
                    let far = u(rows.len() - 1, output);
                    assert!(far > 0.999 * amplitude, "{:?}: {far} of {amplitude}", form.term);
                }
            }
        }
    }
}
