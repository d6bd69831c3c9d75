//! The discrepancy's evidence against dense normal densities.

use nalgebra::{DMatrix, DVector};

use super::cases::{case, line, normal, observed};
use super::ln_normal;
use crate::data::by_rows;
use crate::discrepancy::{Discrepancy, OutputSet};
use crate::setup::Setup;
use gumption_engine::task::Sharing;

/// The weight of a form at an amplitude is that of the dense covariance of noise, input and process.
#[test]
fn weights_are_those_of_dense_covariances() {
    let case = line();
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let residuals = by_rows(&setup.data.nominal_residuals());
    let found = discrepancy.evidence(&setup, &residuals, f64::NEG_INFINITY);
    let u = [0.1f64, 0.1, 0.12, 0.1, 0.2, 0.1];
    let dense = |form: usize, multiplier: f64| {
        let form = &discrepancy.forms[form];
        let features = form.features(&setup, &discrepancy.axes).into_owned() * multiplier;
        let covariance = DMatrix::from_fn(12, 12, |i, j| {
            let gradient =
                |value: usize| if value.is_multiple_of(2) { 1.0 } else { (value / 2) as f64 };
            let noise = if i == j { u[i / 2] * u[i / 2] } else { 0.0 };
            noise + 0.09 * gradient(i) * gradient(j)
        });
        ln_normal(
            &DVector::from_vec(residuals.clone()),
            &(covariance + &features * features.transpose()),
        ) + form.ln_weight
    };
    let first = &found.kinds[0];
    for kind in found.kinds.iter().step_by(37) {
        let wanted = dense(kind.form, kind.multiplier) - dense(first.form, first.multiplier);
        let ratio = (kind.weight / first.weight).ln();
        // factorizations of 12 x 12 matrices with condition numbers up to 1e8
        assert!((ratio - wanted).abs() < 1e-6, "{ratio} {wanted}");
    }
    // and the first one in absolute terms, with the 48 amplitudes equally probable
    let absolute = found.ln_evidence + first.weight.ln();
    let wanted = dense(first.form, first.multiplier) - 48f64.ln();
    assert!((absolute - wanted).abs() < 1e-6, "{absolute} {wanted}");
}

/// The amplitude is in standard uncertainties: unit features have unit root mean square over them.
#[test]
fn features_are_scaled_to_the_uncertainties() {
    let case = line();
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let u = [0.1f64, 0.1, 0.12, 0.1, 0.2, 0.1];
    for form in &discrepancy.forms {
        let features = form.features(&setup, &discrepancy.axes);
        let mut squares = Vec::new();
        for value in 0..12 {
            let own = features.row(value).norm_squared();
            if own > 0.0 {
                squares.push(own / (u[value / 2] * u[value / 2]));
            }
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        assert!((mean - 1.0).abs() < 1e-9, "{:?}", form.term);
    }
}

/// With the noise to be estimated: the integral over it by a fine grid instead of Laplace's method.
#[test]
fn estimated_noise_is_integrated_out() {
    let values = [1.12, 1.55, 1.31, 2.04, 2.18, 1.9, 2.4, 2.1, 2.3, 2.8];
    let case = case(
        normal(1.0, 0.3),
        Sharing::All,
        &[("y", "a + 0*x")],
        vec![observed(&values, None)],
        Vec::new(),
    );
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let residuals = by_rows(&setup.data.nominal_residuals());
    let found = discrepancy.evidence(&setup, &residuals, f64::NEG_INFINITY);
    let rms = (residuals.iter().map(|r| r * r).sum::<f64>() / 10.0).sqrt();
    let mut ln_total = f64::NEG_INFINITY;
    let (steps, grid) = (14, 3000);
    for form in &discrepancy.forms {
        let unit = form.features(&setup, &discrepancy.axes).into_owned();
        let own: f64 = unit.row_iter().map(|row| row.norm_squared()).sum::<f64>() / 10.0;
        for step in 0..steps {
            let amplitude = 3.0 * 100f64.powf((step as f64 + 0.5) / steps as f64);
            for cell in 0..grid {
                // log-uniform from 1e-6 to 3 times the root mean square of the residuals
                let sigma = 1e-6 * rms * 3e6f64.powf((cell as f64 + 0.5) / grid as f64);
                if sigma < 1e-3 * rms {
                    continue;
                }
                let scale = amplitude * sigma / own.sqrt();
                let covariance = DMatrix::from_fn(10, 10, |i, j| {
                    0.09 + if i == j { sigma * sigma } else { 0.0 }
                }) + &unit * unit.transpose() * (scale * scale);
                let Some(root) = covariance.cholesky() else { continue };
                let r = DVector::from_vec(residuals.clone());
                let ln = -0.5 * r.dot(&root.solve(&r))
                    - root.l().diagonal().map(f64::ln).sum()
                    - 10.0 * crate::logarithm::HALF_LN_TWO_PI
                    + form.ln_weight
                    - (steps as f64 * grid as f64).ln();
                ln_total = crate::logarithm::ln_add(ln_total, ln);
            }
        }
    }
    // Laplace's method on the logarithm of a standard deviation from ten values is good to a few
    // hundredths where one form and amplitude dominates
    assert!((found.ln_evidence - ln_total).abs() < 0.1, "{} {ln_total}", found.ln_evidence);
}

/// Of five outputs the two that depart are a set, with the weight of one of ten that have that of five
/// single ones; so are three and four of them.
#[test]
fn of_many_outputs_those_that_depart_most_are_a_set() {
    let names = ["p", "q", "r", "s", "t"];
    let equations = names.map(|name| (name, "a + x"));
    let u = [0.1; 4];
    let of = |shift: f64| observed(&[1.0 + shift, 2.0 - shift, 3.0 + shift, 4.0], Some(&u));
    let data = [0.01, 0.5, 0.03, 0.8, 0.02].map(of).to_vec();
    let case = case(normal(1.0, 0.01), Sharing::All, &equations, data, Vec::new());
    let sets = OutputSet::all(&Setup::new(&case).data);
    let found: Vec<(&[usize], f64)> =
        sets.iter().map(|set| (set.outputs.as_slice(), set.weight)).collect();
    let wanted: [(&[usize], f64); 9] = [
        (&[0], 1.0),
        (&[1], 1.0),
        (&[2], 1.0),
        (&[3], 1.0),
        (&[4], 1.0),
        (&[1, 3], 5.0 / 10.0),
        (&[1, 2, 3], 5.0 / 10.0),
        (&[1, 2, 3, 4], 5.0 / 5.0),
        (&[0, 1, 2, 3, 4], 1.0),
    ];
    assert_eq!(found, wanted);
}
