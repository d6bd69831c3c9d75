//! What "unexplained" says at any conditions: a Gaussian process conditioned on the data.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::features::{Coordinates, Site};
use super::{Base, Discrepancy, Parts, Weighted};
use crate::data::by_rows;
use crate::predict::Normals;
use crate::setup::Setup;
use crate::tangent::Tangent;
use gumption_engine::task::Row;

/// What the model says, or effects that act beside a discrepancy, without what is linear in their
/// parameters.
struct InRows {
    base: Option<Arc<Base>>,
    /// What is left of the data, by value.
    residuals: Vec<f64>,
    /// What is said in the rows, by value.
    sims: Vec<f64>,
    /// The derivatives by the parameters' scores, in the data and in the rows.
    slopes: Vec<Vec<f64>>,
    slopes_there: Vec<Vec<f64>>,
}

impl InRows {
    fn of(setup: &Setup<'_>, base: Option<&Arc<Base>>, rows: &[Row], tangents: &[Tangent]) -> Self {
        let Some(base) = base else {
            let sims = tangents.iter().flat_map(|of| of.at_estimates.clone()).collect();
            let residuals = by_rows(&setup.data.linear_residuals());
            let (slopes, slopes_there) = (Vec::new(), Vec::new());
            return Self { base: None, residuals, sims, slopes, slopes_there };
        };
        let (values, slopes_there) = base.in_rows(setup, rows);
        let linear = base.linear_part(&slopes_there, values.len());
        Self {
            base: Some(Arc::clone(base)),
            residuals: base.residuals(setup),
            sims: values.iter().zip(linear).map(|(value, correction)| value - correction).collect(),
            slopes: base.slopes.clone(),
            slopes_there,
        }
    }

    fn is_of(&self, base: Option<&Arc<Base>>) -> bool {
        match (&self.base, base) {
            (None, None) => true,
            (Some(own), Some(base)) => Arc::ptr_eq(own, base),
            _ => false,
        }
    }
}

impl Discrepancy {
    /// What "unexplained" says in these rows: the model at the inputs' estimates, corrected by what the
    /// data say of shared inputs and of the discrepancy (a Gaussian process conditioned on the data).
    /// `growth` is what the variances of what the data determine are multiplied by in each row, 1 where it
    /// is empty; what they do not determine of a function has its prior variance, the square of its
    /// amplitude, whatever the row.
    pub fn predict(
        &self,
        setup: &Setup<'_>,
        kinds: &[Weighted],
        rows: &[Row],
        growth: &[f64],
    ) -> Normals {
        let outputs = setup.data.outputs.len();
        let tangents: Vec<Tangent> = rows.iter().map(|row| tangent(setup, row)).collect();
        let sites: Vec<Site> = rows
            .iter()
            .zip(&tangents)
            .map(|(row, tangent)| Site {
                conditions: row.conditions.clone(),
                sims: tangent.touching.clone(),
            })
            .collect();
        let gradients: Vec<Vec<Vec<f64>>> =
            tangents.iter().map(|tangent| tangent.gradients.clone()).collect();
        let total: f64 = kinds.iter().map(|kind| kind.weight).sum();
        let mut bases: Vec<InRows> = Vec::new();
        let mut sums = vec![vec![(0.0, 0.0); outputs]; rows.len()];
        for kind in kinds {
            let form = &self.forms[kind.form];
            let share = kind.weight / total;
            let known = bases.iter().position(|known| known.is_of(kind.base.as_ref()));
            let place = known.unwrap_or_else(|| {
                bases.push(InRows::of(setup, kind.base.as_ref(), rows, &tangents));
                bases.len() - 1
            });
            let InRows { residuals, sims, slopes, slopes_there, .. } = &bases[place];
            let variances = kind.variances.as_deref().unwrap_or(&setup.linear.variances);
            let coordinates = Coordinates::new(&form.term, &self.axes, &sites, outputs);
            let roots = coordinates.roots(&form.term, form.length, &form.nodes);
            let there = coordinates.features(&roots, rows.len() * outputs) * form.scale;
            // what the nodes do not determine of the function is left at its prior variance
            let undetermined = coordinates.undetermined(&roots, rows.len() * outputs);
            let size = kind.multiplier * form.scale;
            let features = form.features(setup, &self.axes);
            let Some(found) = conditioned(
                setup,
                variances,
                residuals,
                &beside(slopes, kind.multiplier * features.as_ref()),
                rows,
                &gradients,
                &beside(slopes_there, kind.multiplier * there),
            ) else {
                continue;
            };
            for (value, (shift, variance)) in found.into_iter().enumerate() {
                let mean = sims[value] + shift;
                let growth = growth.get(value / outputs).copied().unwrap_or(1.0);
                let variance = growth * variance + size * size * undetermined[value];
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

    /// What the inputs and a departure add to the data, beside effects whose parameters are integrated out.
    /// `variances` are those of the noise by value. `None` where their covariance has no root.
    pub fn parts(
        &self,
        setup: &Setup<'_>,
        base: &Base,
        departure: Option<&Weighted>,
        variances: &[f64],
    ) -> Option<Parts> {
        let rows = setup.all_rows();
        let features = match departure {
            Some(kind) => {
                kind.multiplier * self.forms[kind.form].features(setup, &self.axes).as_ref()
            }
            None => DMatrix::zeros(setup.data.len(), 0),
        };
        let gradients: Vec<Vec<Vec<f64>>> = setup
            .data
            .point_of
            .iter()
            .map(|&point| setup.data.points[point].tangent.gradients.clone())
            .collect();
        let nothing: Vec<Vec<Vec<f64>>> = gradients
            .iter()
            .map(|row| row.iter().map(|gradient| vec![0.0; gradient.len()]).collect())
            .collect();
        let residuals = base.residuals(setup);
        let zeros = vec![vec![0.0; setup.data.len()]; base.slopes.len()];
        let with = beside(&base.slopes, features.clone());
        let mean = |gradients: &[Vec<Vec<f64>>], there: &DMatrix<f64>| {
            let found = conditioned(setup, variances, &residuals, &with, &rows, gradients, there)?;
            Some(found.into_iter().map(|(mean, _)| mean).collect::<Vec<f64>>())
        };
        Some(Parts {
            inputs: mean(&gradients, &(0.0 * &with))?,
            function: mean(&nothing, &beside(&zeros, features))?,
        })
    }
}

/// Columns before those of a matrix.
fn beside(columns: &[Vec<f64>], matrix: DMatrix<f64>) -> DMatrix<f64> {
    let mut all = matrix.insert_columns(0, columns.len(), 0.0);
    for (place, column) in columns.iter().enumerate() {
        all.set_column(place, &DVector::from_column_slice(column));
    }
    all
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
                let own = effect(&point.tangent.gradients, &setup.case.task.rows[id], output, v);
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

/// The observed outputs in a row as linear functions of the inputs.
pub fn tangent(setup: &Setup<'_>, row: &Row) -> Tangent {
    setup.case.tangent(row).of_outputs(&setup.data.outputs)
}
