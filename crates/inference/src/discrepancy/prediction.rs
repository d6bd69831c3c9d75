//! What "unexplained" says at any conditions: a Gaussian process conditioned on the data.

use nalgebra::{DMatrix, DVector};

use super::features::{Coordinates, Site};
use super::{Discrepancy, Weighted};
use crate::data::by_rows;
use crate::predict::{self, Normals};
use crate::setup::Setup;
use gumption_engine::task::Row;

impl Discrepancy {
    /// What "unexplained" says in these rows: the model at the inputs' estimates, corrected by what the
    /// data say of shared inputs and of the discrepancy (a Gaussian process conditioned on the data).
    /// `beyond` says that rows are outside of the data and the caller enlarges the variances of smooth
    /// functions with their distance.
    pub fn predict(
        &self,
        setup: &Setup<'_>,
        kinds: &[Weighted],
        rows: &[Row],
        beyond: bool,
    ) -> Normals {
        let outputs = setup.data.outputs.len();
        let plain = by_rows(&setup.data.nominal_residuals());
        let nominals: Vec<(Vec<f64>, Vec<Vec<f64>>)> =
            rows.iter().map(|row| nominal(setup, row)).collect();
        let sites: Vec<Site> = rows
            .iter()
            .zip(&nominals)
            .map(|(row, (nominal, _))| Site {
                conditions: row.conditions.clone(),
                nominal: nominal.clone(),
            })
            .collect();
        let gradients: Vec<Vec<Vec<f64>>> =
            nominals.iter().map(|(_, gradients)| gradients.clone()).collect();
        let total: f64 = kinds.iter().map(|kind| kind.weight).sum();
        let mut sums = vec![vec![(0.0, 0.0); outputs]; rows.len()];
        for kind in kinds {
            let form = &self.forms[kind.form];
            let share = kind.weight / total;
            // the model, or the effects that act beside the discrepancy
            let (residuals, sims) = match &kind.base {
                None => (plain.clone(), nominals.iter().flat_map(|(sim, _)| sim.clone()).collect()),
                Some(base) => {
                    let residuals = base.residuals(setup);
                    let there_too = predict::values(
                        setup,
                        &base.effects,
                        std::slice::from_ref(&base.scores),
                        rows,
                    );
                    let first = |draws: Vec<f64>| draws.first().copied();
                    let sims: Vec<f64> =
                        there_too.into_iter().flatten().filter_map(first).collect();
                    (residuals, sims)
                }
            };
            let variances = kind.variances.as_deref().unwrap_or(&setup.linear.variances);
            let coordinates = Coordinates::new(&form.term, &self.axes, &sites, outputs);
            let roots = coordinates.roots(&form.term, form.length, &form.nodes);
            let there = coordinates.features(&roots, rows.len() * outputs) * form.scale;
            // what the nodes do not determine of the function is left at its prior variance
            let undetermined = match form.term.is_smooth() && beyond {
                true => vec![0.0; rows.len() * outputs],
                false => coordinates.undetermined(&roots, rows.len() * outputs),
            };
            let size = kind.multiplier * form.scale;
            let features = form.features(setup, &self.axes);
            let Some(found) = conditioned(
                setup,
                variances,
                &residuals,
                &(kind.multiplier * features.as_ref()),
                rows,
                &gradients,
                &(kind.multiplier * there),
            ) else {
                continue;
            };
            for (value, (shift, variance)) in found.into_iter().enumerate() {
                let mean = sims[value] + shift;
                let variance = variance + size * size * undetermined[value];
                let sum = &mut sums[value / outputs][value % outputs];
                sum.0 += share * mean;
                sum.1 += share * (variance + mean * mean);
            }
        }
        for of_row in &mut sums {
            for (mean, square) in of_row {
                *square = (*square - *mean * *mean).max(0.0);
            }
        }
        sums
    }
}

/// What shared inputs and functions, whose factors are standard normal, add to the model in rows after
/// residuals of the data: means and variances by value. `features` are the functions at the data,
/// `there` in the rows, `gradients` the model's derivatives there, `variances` those of the noise.
pub fn conditioned(
    setup: &Setup<'_>,
    variances: &[f64],
    residuals: &[f64],
    features: &DMatrix<f64>,
    rows: &[Row],
    gradients: &[Vec<Vec<f64>>],
    there: &DMatrix<f64>,
) -> Option<Vec<(f64, f64)>> {
    let outputs = setup.data.outputs.len();
    let shared: Vec<usize> = (0..setup.case.task.variables.len())
        .filter(|&v| setup.spread.shared[v].is_none())
        .collect();
    // coefficients: one for each shared input, then those of the functions
    let m = features.ncols();
    let order = shared.len() + m;
    let effect = |gradients: &[Vec<f64>], row: &Row, output: usize, v: usize| {
        let deviation = row.distributions[v].standard_deviation();
        gradients[output][v] * if deviation.is_finite() { deviation } else { 0.0 }
    };
    let mut design = DMatrix::zeros(residuals.len(), order);
    for (row, &id) in setup.data.ids.iter().enumerate() {
        let point = &setup.data.points[setup.data.point_of[row]];
        for output in 0..outputs {
            let value = row * outputs + output;
            let weight = variances[value].sqrt().recip();
            for (j, &v) in shared.iter().enumerate() {
                let own = effect(&point.gradients, &setup.case.task.rows[id], output, v);
                design[(value, j)] = own * weight;
            }
            for j in 0..m {
                design[(value, shared.len() + j)] = features[(value, j)] * weight;
            }
        }
    }
    let white = DVector::from_iterator(
        residuals.len(),
        residuals.iter().zip(variances.iter()).map(|(r, v)| r / v.sqrt()),
    );
    let precision = design.tr_mul(&design) + DMatrix::identity(order, order);
    let root = precision.cholesky()?;
    let coefficients = root.solve(&design.tr_mul(&white));
    let lower = root.l();
    let mut found = Vec::with_capacity(rows.len() * outputs);
    for (row, gradients) in gradients.iter().enumerate() {
        for output in 0..outputs {
            let value = row * outputs + output;
            let mut features = DVector::zeros(order);
            for (j, &v) in shared.iter().enumerate() {
                features[j] = effect(gradients, &rows[row], output, v);
            }
            for j in 0..m {
                features[shared.len() + j] = there[(value, j)];
            }
            let half = lower.solve_lower_triangular(&features);
            let variance = half.map_or(0.0, |half| half.norm_squared());
            found.push((features.dot(&coefficients), variance));
        }
    }
    Some(found)
}

/// What the model says in a row at the inputs' estimates, with its derivatives.
pub fn nominal(setup: &Setup<'_>, row: &Row) -> (Vec<f64>, Vec<Vec<f64>>) {
    let variables = row.estimates();
    let (values, gradients) = setup.case.task.model.program.gradients(&variables);
    let outputs = &setup.data.outputs;
    (
        outputs.iter().map(|&output| values[output]).collect(),
        outputs.iter().map(|&output| gradients[output].clone()).collect(),
    )
}
