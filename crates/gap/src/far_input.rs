//! Inputs that would explain the data if they were further from their estimates than their uncertainties
//! allow.
//!
//! A calibration that is out of date or a value of another device is no effect of the list, and no
//! departure that anybody would look for: what it makes is called *unexplained*. For each input that all
//! rows share the shift is sought that leaves the least chi-square (Gauss-Newton steps of the sim itself,
//! everything else as it is stated). It is no hypothesis and takes no probability from any.

use gumption_engine::linalg::dot;
use gumption_engine::number::{elementary, smallest_first};
use gumption_engine::parallel;
use gumption_engine::special;

use gumption_inference::covariance::Covariance;
use gumption_inference::noise::noise_model::NoiseModel;
use gumption_inference::setup::Setup;

/// An input is far from its estimate by more than this, in standard uncertainties.
const FAR: f64 = 3.0;

/// What is left counts as explained where so large a chi-square has at least this probability.
const EXPLAINED: f64 = 0.01;

/// Inputs that leave a chi-square larger by this than the least one explain less.
const AS_WELL: f64 = 4.0;

/// Of more values it is not asked.
const MOST_VALUES: usize = 5000;

/// Steps at most, and the shift that needs none further, in standard uncertainties.
const MOST_STEPS: usize = 20;
const ENOUGH: f64 = 1e-3;

/// An input that would explain the data.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FarInput {
    /// Place of the variable.
    pub(crate) variable: usize,
    /// How far it is above its estimate, in its standard uncertainties.
    pub(crate) distance: f64,
}

/// The inputs of which each alone would explain the data, nearest to its estimate first.
pub(crate) fn found(setup: &Setup<'_>) -> Vec<FarInput> {
    let stated;
    let setup = if setup.linear.fitted {
        stated = setup.with_noise(NoiseModel::default());
        &stated
    } else {
        setup
    };
    if setup.linear.fitted || setup.data.len() > MOST_VALUES {
        return Vec::new();
    }
    let varies = |v: &usize| setup.spread.deviations[*v].iter().any(|deviation| *deviation > 0.0);
    let varying: Vec<usize> = (0..setup.case.task.variables.len()).filter(varies).collect();
    let is_correlated = |v: usize| {
        setup
            .case
            .task
            .correlations
            .iter()
            .any(|correlation| correlation.first == v || correlation.second == v)
    };
    let alone =
        varying.iter().copied().filter(|&v| setup.spread.shared[v].is_none() && !is_correlated(v));
    let alone: Vec<usize> = alone.collect();
    let nearest = parallel::map(&alone, |&variable| {
        let others: Vec<usize> =
            varying.iter().copied().filter(|other| *other != variable).collect();
        let covariance = Covariance::new(setup.case, &setup.data, &setup.spread, &others);
        nearest(setup, variable, &covariance)
    });
    let least = nearest.iter().flatten().map(|(chi2, _)| *chi2).fold(f64::INFINITY, f64::min);
    let far = alone.into_iter().zip(nearest).filter_map(|(variable, nearest)| {
        let (chi2, distance) = nearest?;
        let explains = distance.abs() > FAR && chi2 < least + AS_WELL;
        explains.then_some(FarInput { variable, distance })
    });
    let mut far: Vec<FarInput> = far.collect();
    smallest_first(&mut far, |far| far.distance.abs());
    far
}

/// The least chi-square that an input leaves, if that is no more than what the other inputs and the noise let
/// expect, and how far it is from its estimate there.
fn nearest(setup: &Setup<'_>, variable: usize, covariance: &Covariance) -> Option<(f64, f64)> {
    let mut distance = 0.0;
    for _ in 0..MOST_STEPS {
        let (residuals, slopes) = shifted(setup, variable, distance)?;
        let [residuals, slopes] =
            [residuals, slopes].map(|columns| covariance.whiten_blocks(&columns));
        let [left, right] = [&residuals, &slopes].map(|columns| covariance.project(columns));
        let information = covariance.square(&slopes);
        let step = (dot(&residuals, &slopes) - dot(&left, &right)) / information;
        if !step.is_finite() {
            return None;
        }
        if step.abs() < ENOUGH {
            let chi2 = covariance.square(&residuals).max(0.0);
            let free = setup.data.len().checked_sub(1).filter(|free| *free > 0)? as f64;
            let p_value = special::gamma::ln_sf(0.5 * chi2, 0.5 * free);
            return (p_value > elementary::ln(EXPLAINED)).then_some((chi2, distance));
        }
        distance += step;
    }
    None
}

/// What is left of the data with an input so far above its estimate, and by how much the sim rises for each
/// standard uncertainty more, both row by row with outputs fastest; `None` where the sim is not finite.
fn shifted(setup: &Setup<'_>, variable: usize, distance: f64) -> Option<(Vec<f64>, Vec<f64>)> {
    let data = &setup.data;
    let mut residuals = Vec::with_capacity(data.len());
    let mut slopes = Vec::with_capacity(data.len());
    for (row, &point) in data.point_of.iter().enumerate() {
        let deviation = setup.spread.deviations[variable][point];
        let mut at = setup.row(row).estimates();
        at[variable] += distance * deviation;
        let (values, gradients) = setup.case.gradients(&at);
        for (output, &place) in data.outputs.iter().enumerate() {
            residuals.push(data.residual(output, row, values[place]));
            slopes.push(gradients[place][variable] * deviation);
        }
    }
    let are_finite = residuals.iter().chain(&slopes).all(|value| value.is_finite());
    are_finite.then_some((residuals, slopes))
}
