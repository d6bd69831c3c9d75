//! Whether residuals are as large as their uncertainties let expect: chi-square and F tests.

use super::diagnosis::{GapTest, HypothesisKind};
use gumption_engine::number::elementary;
use gumption_engine::special;
use gumption_inference::data::by_rows;
use gumption_inference::setup::Setup;

/// Noise and what belongs to a row alone.
pub(crate) fn plus_rows(setup: &Setup<'_>, noise: &[f64]) -> Vec<f64> {
    if setup.covariance.fitted {
        return noise.iter().zip(&setup.linear.variances).map(|(n, v)| n.max(*v)).collect();
    }
    setup.linear.variances.clone()
}

/// The chi-square test of all residuals.
pub(crate) fn gap(setup: &Setup<'_>, kind: HypothesisKind) -> GapTest {
    let present = kind != HypothesisKind::None;
    let values = setup.data.len() as f64;
    if setup.linear.fitted {
        return lack_of_fit(setup, present);
    }
    let residuals = by_rows(&setup.data.linear_residuals());
    let whitened = setup.linear.whiten_blocks(&residuals);
    let chi2 = setup.linear.square(&whitened).max(0.0);
    let p_value = elementary::exp(special::gamma::ln_sf(0.5 * chi2, 0.5 * values));
    GapTest { present, p_value: Some(p_value), chi2, dof: values }
}

/// Where the noise is estimated: means of repeats against the scatter of repeats (F test of lack of
/// fit), the shared inputs being free.
fn lack_of_fit(setup: &Setup<'_>, present: bool) -> GapTest {
    let data = &setup.data;
    let repeated = data.repeats(setup.case);
    let residuals = data.nominal_residuals();
    let (mut within, mut between, mut repeats, mut means) = (0.0, 0.0, 0usize, 0usize);
    let mut variances = Vec::new();
    for residuals in &residuals {
        let mut squares = 0.0;
        let mut count = 0;
        for rows in repeated.iter().filter(|rows| rows.len() > 1) {
            let mean = rows.iter().map(|&row| residuals[row]).sum::<f64>() / rows.len() as f64;
            squares += rows.iter().map(|&row| (residuals[row] - mean).powi(2)).sum::<f64>();
            count += rows.len() - 1;
        }
        variances.push((squares, count));
    }
    for (residuals, (squares, count)) in residuals.iter().zip(&variances) {
        if *count == 0 || *squares <= 0.0 {
            continue;
        }
        let variance = squares / *count as f64;
        within += squares / variance;
        repeats += count;
        for rows in &repeated {
            let n = rows.len() as f64;
            let mean = rows.iter().map(|&row| residuals[row]).sum::<f64>() / n;
            between += n * mean * mean / variance;
            means += 1;
        }
    }
    if repeats == 0 || means == 0 {
        return GapTest { present, p_value: None, chi2: f64::NAN, dof: 0.0 };
    }
    let f = (between / means as f64) / (within / repeats as f64);
    let (d1, d2) = (means as f64, repeats as f64);
    let p_value = special::beta::cdf(d2 / (d2 + d1 * f), 0.5 * d2, 0.5 * d1);
    GapTest { present, p_value: Some(p_value), chi2: between, dof: d1 }
}

/// A mean square of normalized residuals that data without a misfit exceed with probability 1e-3.
pub(crate) fn misfit(values: usize) -> f64 {
    let n = values.max(1) as f64;
    special::gamma::quantile_upper(1e-3, 0.5 * n) / (0.5 * n)
}
