//! What a hypothesis leaves of the data.

use gumption_engine::linalg::{dot, packed};
use gumption_engine::number::elementary;

use crate::covariance::inner_root;
use crate::noise::shared_noise::root_mean_square;
use crate::posterior::WeighedHypothesis;
use crate::setup::Setup;
use crate::whitened::{self, WhitenedResiduals};

/// What a hypothesis leaves at its best mode, less what the inputs explain that act linearly.
#[derive(Debug)]
pub struct Remainder {
    /// Row by row, outputs fastest; whitened by the blocks, or by the estimated noise. Empty where the
    /// hypothesis has no mode.
    pub residuals: Vec<f64>,
    /// The standard deviations of the estimated noise; empty where it is stated.
    pub(crate) deviations: Vec<f64>,
    /// The same error in each value as a share of its standard uncertainty, relative to that of a typical
    /// one.
    pub(crate) shares: Vec<f64>,
}

impl Remainder {
    /// Of a hypothesis.
    pub fn of(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Self {
        let nothing = Self { residuals: Vec::new(), deviations: Vec::new(), shares: Vec::new() };
        let Some(mode) = hypothesis.evidence.modes.first() else { return nothing };
        let likelihood = setup.likelihood(&hypothesis.effects);
        let found = whitened::residuals(&likelihood, std::slice::from_ref(&mode.scores)).pop();
        let Some(WhitenedResiduals { values: mut residuals, ln_variances }) = found else {
            return nothing;
        };
        let covariance = &setup.covariance;
        let mut deviations = Vec::new();
        let mut basis = covariance.basis.clone();
        if covariance.fitted {
            deviations = ln_variances.iter().map(|ln| elementary::exp(0.5 * ln)).collect();
            for column in &mut basis {
                column
                    .iter_mut()
                    .zip(&deviations)
                    .for_each(|(value, deviation)| *value /= deviation);
            }
        }
        let inner = inner_root(&basis);
        let mut sizes: Vec<f64> = basis.iter().map(|column| dot(column, &residuals)).collect();
        packed::solve(&inner, &mut sizes);
        packed::solve_transposed(&inner, &mut sizes);
        for (column, size) in basis.iter().zip(&sizes) {
            residuals.iter_mut().zip(column).for_each(|(left, value)| *left -= size * value);
        }
        let outputs = setup.data.outputs.len();
        let share = |value: usize| match &setup.data.uncertainties[value % outputs] {
            Some(u) => root_mean_square(u) / u[value / outputs],
            None => 1.0,
        };
        let shares = (0..residuals.len()).map(share).collect();
        Self { residuals, deviations, shares }
    }
}
