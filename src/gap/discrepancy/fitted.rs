//! The evidence of a discrepancy where the noise is estimated from the data as well.
//!
//! At each amplitude the noise is integrated out about its most probable value (Laplace), which is
//! accurate because a standard deviation from many residuals is nearly lognormal.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::{AMPLITUDES, Discrepancy, Unexplained, Weighted, weigh};
use crate::gap::covariance::triangle;
use crate::gap::latent::{EDGE, Role, ln_prior};
use crate::gap::likelihood::{HALF_LN_TWO_PI, root_in_place};
use crate::gap::setup::Setup;

/// Points of the integral over the logarithm of the amplitude.
const STEPS: usize = 14;

/// Step of differences in the scores of the noise; their posterior is some 0.01 to 0.1 wide.
const STEP: f64 = 2e-3;

const MOST_STEPS: usize = 12;

pub(crate) fn evidence(
    discrepancy: &Discrepancy,
    setup: &Setup<'_>,
    residuals: &[f64],
) -> Unexplained {
    let noise: Vec<&Role> = setup.roles.iter().filter(|role| role.is_noise()).collect();
    let parts = discrepancy
        .forms
        .par_iter()
        .enumerate()
        .map(|(place, form)| {
            let features = form.features(setup, &discrepancy.axes);
            let problem = Problem::new(setup, &features, &noise, residuals);
            let mut scores = vec![0.0; noise.len()];
            let mut parts = Vec::with_capacity(STEPS);
            // from the largest amplitude on, where the noise is least
            for step in (0..STEPS).rev() {
                let share = (step as f64 + 0.5) / STEPS as f64;
                let amplitude = AMPLITUDES[0] * (AMPLITUDES[1] / AMPLITUDES[0]).powf(share);
                let ln = problem.integrate(amplitude, &mut scores);
                let variances = problem.variances(&scores);
                let multiplier = amplitude * problem.scale(&variances);
                let ln = ln + form.ln_weight - (STEPS as f64).ln();
                let variances = Some(Arc::new(variances));
                parts.push((
                    ln,
                    Weighted { form: place, multiplier, weight: 0.0, base: None, variances },
                ));
            }
            parts
        })
        .collect::<Vec<_>>();
    weigh(parts.into_iter().flatten().collect())
}

struct Problem<'p> {
    setup: &'p Setup<'p>,
    noise: &'p [&'p Role],
    residuals: &'p [f64],
    features: &'p DMatrix<f64>,
    /// For each value the variance of the discrepancy at unit variance of the function.
    own: Vec<f64>,
    touched: usize,
}

impl<'p> Problem<'p> {
    fn new(
        setup: &'p Setup<'p>,
        features: &'p DMatrix<f64>,
        noise: &'p [&'p Role],
        residuals: &'p [f64],
    ) -> Self {
        let own: Vec<f64> = features.row_iter().map(|row| row.norm_squared()).collect();
        let touched = own.iter().filter(|own| **own > 0.0).count();
        Self { setup, noise, residuals, features, own, touched }
    }

    /// Variance of the noise by value.
    fn variances(&self, scores: &[f64]) -> Vec<f64> {
        let count = self.setup.data.outputs.len();
        let mut ln = vec![None; count];
        let mut power = vec![0.0; count];
        for (role, &score) in self.noise.iter().zip(scores) {
            match role {
                Role::Noise { output, map } => ln[*output] = Some(map.value(score)),
                Role::Power { output, map } => power[*output] = map.value(score),
                Role::Variable { .. } => {}
            }
        }
        let known = &self.setup.linear.variances;
        let variance = |(value, known): (usize, &f64)| match ln[value % count] {
            Some(ln) => {
                (2.0 * (ln + power[value % count] * self.setup.ln_sizes[value])).exp() + known
            }
            None => *known,
        };
        known.iter().enumerate().map(variance).collect()
    }

    /// What unit variance is multiplied by for an amplitude of one standard uncertainty.
    fn scale(&self, variances: &[f64]) -> f64 {
        let squares: f64 = self.own.iter().zip(variances).map(|(own, v)| own / v).sum();
        (self.touched.max(1) as f64 / squares.max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Logarithm of likelihood times prior of the scores, without the prior's constant.
    fn ln_density(&self, amplitude: f64, scores: &[f64]) -> f64 {
        let variances = self.variances(scores);
        let multiplier = amplitude * self.scale(&variances);
        let basis = &self.setup.linear.basis;
        let (k, m) = (basis.len(), self.features.ncols());
        let order = k + m;
        let mut inner = vec![0.0; triangle(order)];
        for i in 0..order {
            inner[triangle(i) + i] = 1.0;
        }
        let mut products = vec![0.0; order];
        let mut row = vec![0.0; order];
        let mut ln = 0.0;
        for (value, (&residual, &variance)) in self.residuals.iter().zip(&variances).enumerate() {
            let root = variance.sqrt().recip();
            for (out, column) in row.iter_mut().zip(basis) {
                *out = column[value] * root;
            }
            for j in 0..m {
                row[k + j] = multiplier * root * self.features[(value, j)];
            }
            let white = residual * root;
            ln += root.ln() - 0.5 * white * white - HALF_LN_TWO_PI;
            for i in 0..order {
                if row[i] != 0.0 {
                    products[i] += row[i] * white;
                    for j in 0..=i {
                        inner[triangle(i) + j] += row[i] * row[j];
                    }
                }
            }
        }
        ln -= root_in_place(&mut inner, order);
        for i in 0..order {
            let mut sum = products[i];
            for j in 0..i {
                sum -= inner[triangle(i) + j] * products[j];
            }
            products[i] = sum / inner[triangle(i) + i];
            ln += 0.5 * products[i] * products[i];
        }
        let priors = self.noise.iter().zip(scores);
        ln + priors.map(|(role, score)| ln_prior(role.is_bounded(), *score)).sum::<f64>()
    }

    /// The integral over the scores of the noise; `scores` are where to start, and become the most
    /// probable ones.
    fn integrate(&self, amplitude: f64, scores: &mut [f64]) -> f64 {
        let d = scores.len();
        let at = |scores: &[f64]| self.ln_density(amplitude, scores);
        let mut here = at(scores);
        let mut damping = 1e-3;
        let mut curvature = DMatrix::identity(d, d);
        for _ in 0..MOST_STEPS {
            let mut gradient = DVector::zeros(d);
            let mut moved = scores.to_vec();
            let mut sides = vec![[0.0; 2]; d];
            for i in 0..d {
                for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
                    moved[i] = scores[i] + sign * STEP;
                    sides[i][side] = at(&moved);
                }
                moved[i] = scores[i];
                gradient[i] = (sides[i][0] - sides[i][1]) / (2.0 * STEP);
            }
            for i in 0..d {
                curvature[(i, i)] = (2.0 * here - sides[i][0] - sides[i][1]) / (STEP * STEP);
                for j in 0..i {
                    moved[i] = scores[i] + STEP;
                    moved[j] = scores[j] + STEP;
                    let both = at(&moved);
                    moved[i] = scores[i];
                    moved[j] = scores[j];
                    let mixed = (sides[i][0] + sides[j][0] - here - both) / (STEP * STEP);
                    curvature[(i, j)] = mixed;
                    curvature[(j, i)] = mixed;
                }
            }
            let mut moved_enough = false;
            for _ in 0..10 {
                let mut damped = curvature.clone();
                for i in 0..d {
                    let own: f64 = damped[(i, i)];
                    damped[(i, i)] = own.abs().max(1.0) * (1.0 + damping);
                }
                let step = match damped.cholesky() {
                    Some(root) => root.solve(&gradient),
                    None => gradient.map(|g| 0.1 * g.signum()),
                };
                let next: Vec<f64> = scores
                    .iter()
                    .zip(step.iter())
                    .map(|(score, step)| (score + step.clamp(-1.0, 1.0)).clamp(-EDGE, EDGE))
                    .collect();
                let there = at(&next);
                if there >= here {
                    moved_enough = there - here > 1e-4;
                    here = there;
                    scores.copy_from_slice(&next);
                    damping *= 0.1;
                    break;
                }
                damping = (damping * 10.0).max(1e-3);
            }
            if !moved_enough {
                break;
            }
        }
        let determinant = curvature.determinant();
        here - 0.5 * if determinant > 0.0 { determinant.ln() } else { 0.0 }
    }
}
