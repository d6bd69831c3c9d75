//! The likelihood against a dense normal density.

use nalgebra::{DMatrix, DVector};

use super::cases::{line_with, normal};
use super::ln_normal;
use crate::data::by_rows;
use crate::setup::Setup;
use gumption_engine::distribution::Rectangular;
use gumption_engine::number::Column;
use gumption_engine::task::Sharing;

/// One shared input that is negligible, one that is not, one for each row: the covariance of blocks
/// and low rank gives the density of the dense matrix.
#[test]
fn blocks_and_low_rank_are_the_dense_covariance() {
    let case = line_with(normal(1.0, 0.3), Sharing::Row);
    let setup = Setup::new(&case);
    assert!(setup.unknown_inputs.is_empty());
    let residuals = by_rows(&setup.data.nominal_residuals());
    let u = [0.1, 0.1, 0.12, 0.1, 0.2, 0.1];
    let covariance = DMatrix::from_fn(12, 12, |i, j| {
        // dy/da = 1, dz/da = x, the same draw in both outputs of a row
        let gradient =
            |value: usize| if value.is_multiple_of(2) { 1.0 } else { (value / 2) as f64 };
        let noise = if i == j { f64::powi(u[i / 2], 2) } else { 0.0 };
        let shared = if i / 2 == j / 2 { 0.09 * gradient(i) * gradient(j) } else { 0.0 };
        noise + shared
    });
    let exact = ln_normal(&DVector::from_vec(residuals), &covariance);
    let found = setup.likelihood(&[]).log_likelihood(&[], 1)[0];
    // a dozen squares summed in another order
    assert!((found - exact).abs() < 1e-10, "{found} {exact}");
}

/// A shared input as an unknown quantity: the likelihood at its score is that of its value.
#[test]
fn unknown_inputs_act_through_the_sim() {
    let case = line_with(Rectangular::new(1.0, 0.5).unwrap().into(), Sharing::All);
    let setup = Setup::new(&case);
    assert_eq!(setup.unknown_inputs, [0]);
    let score = 0.8;
    let a = 1.0 + 0.5 * score / 3f64.sqrt();
    let mut column = Column::ZERO;
    column.0[0] = score;
    let found = setup.likelihood(&[]).log_likelihood(&[column], 1)[0];
    let (y, z) = ([1.12, 1.55, 2.31, 2.64, 3.18, 3.9], [0.03, -0.08, 0.21, 0.1, 0.31, 0.26]);
    let u = [0.1f64, 0.1, 0.12, 0.1, 0.2, 0.1];
    let exact: f64 = (0..6)
        .map(|n| {
            let x = n as f64;
            let ln = |residual: f64| {
                -0.5 * (residual / u[n]).powi(2)
                    - u[n].ln()
                    - 0.5 * (2.0 * std::f64::consts::PI).ln()
            };
            ln(y[n] - a - 0.5 * x) + ln(z[n] - a * x + x)
        })
        .sum();
    assert!((found - exact).abs() < 1e-11, "{found} {exact}");
}
