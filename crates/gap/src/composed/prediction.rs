//! What composed departures say at any conditions, and how far the gap shrinks with them.

use nalgebra::DMatrix;

use super::{Composition, Compositions};
use crate::diagnosis::Shrunk;
use crate::shrink::blocks;
use gumption_engine::linalg::{DenseRoot, column_products, dot};
use gumption_engine::task::Row;
use gumption_inference::data::by_rows;
use gumption_inference::discrepancy::{conditioned, tangent};
use gumption_inference::predict::Normals;
use gumption_inference::setup::Setup;

/// Composed departures that predictions are averaged over, at most.
const MOST: usize = 12;

impl Compositions {
    /// What the leading ones say in rows, each with its share of "unexplained". The sim is corrected
    /// by what the data say of shared inputs and of the departure; the uncertainties are those of
    /// these, with the parameters of the functions a standard deviation up and down.
    pub(crate) fn predictions(&self, setup: &Setup<'_>, rows: &[Row]) -> Vec<(f64, Normals)> {
        // what acts beside effects of the list depends on those as well
        let leading =
            self.all.iter().filter(|composition| composition.beside.is_empty()).take(MOST);
        let of = |composition: &Composition| {
            let normals = self.prediction(setup, composition, rows)?;
            Some((composition.share, normals))
        };
        leading.filter_map(of).collect()
    }

    /// The same for a part of the data.
    pub(crate) fn for_part(&self, whole: &Setup<'_>, part: &Setup<'_>) -> Self {
        let outputs = whole.data.outputs.len();
        let of_part = |variances: &Vec<f64>| {
            let place =
                |id: &usize| whole.data.ids.iter().position(|known| known == id).unwrap_or(0);
            let rows = part.data.ids.iter().map(place);
            rows.flat_map(|row| variances[row * outputs..(row + 1) * outputs].iter().copied())
                .collect()
        };
        Self { variances: self.variances.as_ref().map(of_part), ..self.clone() }
    }

    /// Variances of the noise by value.
    fn variances<'v>(&'v self, setup: &'v Setup<'_>) -> &'v [f64] {
        self.variances.as_deref().unwrap_or(&setup.linear.variances)
    }

    fn prediction(
        &self,
        setup: &Setup<'_>,
        composition: &Composition,
        rows: &[Row],
    ) -> Option<Normals> {
        let outputs = setup.data.outputs.len();
        let tangents: Vec<_> = rows.iter().map(|row| tangent(setup, row)).collect();
        let sims: Vec<Vec<f64>> = tangents.iter().map(|of| of.touching.clone()).collect();
        let gradients: Vec<Vec<Vec<f64>>> =
            tangents.iter().map(|of| of.gradients.clone()).collect();
        let residuals = by_rows(&setup.data.linear_residuals());
        let mut sums = vec![(0.0, 0.0); rows.len() * outputs];
        let mut total = 0.0;
        for shares in composition.nearby() {
            let columns = composition.in_data(setup, &shares);
            let there = composition.columns(setup, rows, &sims, &shares);
            let wide = self.wide(setup, &columns);
            let matrix = |columns: &[Vec<f64>], values: usize| {
                DMatrix::from_fn(values, columns.len(), |i, j| columns[j][i] * wide[j])
            };
            let Some(found) = conditioned(
                setup,
                self.variances(setup),
                &residuals,
                &matrix(&columns, residuals.len()),
                rows,
                &gradients,
                &matrix(&there, rows.len() * outputs),
            ) else {
                continue;
            };
            total += 1.0;
            for (n, (shift, variance)) in found.into_iter().enumerate() {
                let mean = tangents[n / outputs].at_estimates[n % outputs] + shift;
                sums[n].0 += mean;
                sums[n].1 += variance + mean * mean;
            }
        }
        if total == 0.0 {
            return None;
        }
        let normal = |(sum, squares): &(f64, f64)| {
            let mean = sum / total;
            (mean, (squares / total - mean * mean).max(0.0))
        };
        let normals: Vec<(f64, f64)> = sums.iter().map(normal).collect();
        let finite =
            normals.iter().all(|(mean, variance)| mean.is_finite() && variance.is_finite());
        finite.then(|| normals.chunks(outputs).map(<[_]>::to_vec).collect())
    }

    /// The standard deviation of the prior of each function's factor: so wide that it does not matter.
    fn wide(&self, setup: &Setup<'_>, columns: &[Vec<f64>]) -> Vec<f64> {
        let variances = self.variances(setup);
        let of = |column: &Vec<f64>| {
            let squares = column.iter().zip(variances).map(|(x, v)| x * x / v);
            let touched = column.iter().filter(|x| **x != 0.0).count().max(1) as f64;
            WIDE / (squares.sum::<f64>() / touched).max(f64::MIN_POSITIVE).sqrt()
        };
        columns.iter().map(of).collect()
    }

    /// Root mean squares of the residuals before and after, each value being predicted from the
    /// rows of other blocks with the parameters of the functions held.
    pub(super) fn shrunk(&self, setup: &Setup<'_>, composition: &Composition) -> Shrunk {
        let data = &setup.data;
        let outputs = data.outputs.len();
        let residuals = by_rows(&data.linear_residuals());
        let variances = self.variances(setup);
        let columns = composition.in_data(setup, &composition.shares());
        let wide = self.wide(setup, &columns);
        let basis = &setup.linear.raw_basis;
        let k = basis.len();
        let order = k + columns.len();
        let design = DMatrix::from_fn(residuals.len(), order, |value, j| {
            let column = if j < k { basis[j][value] } else { columns[j - k][value] * wide[j - k] };
            column / variances[value].sqrt()
        });
        let white: Vec<f64> = residuals.iter().zip(variances).map(|(r, v)| r / v.sqrt()).collect();
        let blocks = blocks(setup);
        let mut block_of = vec![blocks.len(); data.rows()];
        for (number, rows) in blocks.iter().enumerate() {
            rows.iter().for_each(|&row| block_of[row] = number);
        }
        let is_in = |value: usize, block: usize| block_of[value / outputs] == block;
        // a single row is in no block: nothing predicts it
        let mut after = white.clone();
        for left_out in 0..blocks.len() {
            let used: Vec<usize> =
                (0..white.len()).filter(|&value| !is_in(value, left_out)).collect();
            let own = design.select_rows(&used);
            let own_white = nalgebra::DVector::from_iterator(
                used.len(),
                used.iter().map(|&value| white[value]),
            );
            let precision = column_products(&own, &own) + DMatrix::identity(order, order);
            let Some(root) = DenseRoot::of(precision) else { continue };
            let coefficients = root.solve(&own.tr_mul(&own_white));
            for value in (0..white.len()).filter(|&value| is_in(value, left_out)) {
                let row: Vec<f64> = design.row(value).iter().copied().collect();
                after[value] = white[value] - dot(&row, coefficients.as_slice());
            }
        }
        let mean = |values: &[f64]| dot(values, values) / values.len().max(1) as f64;
        let (before, after) = (mean(&white), mean(&after));
        let removable = before - 1.0;
        let removed = if removable > 0.0 { (before - after) / removable } else { 0.0 };
        Shrunk {
            rms_before: before.sqrt(),
            rms_after: after.sqrt(),
            noise_floor: 1.0,
            removed_fraction: removed.clamp(0.0, 1.0),
        }
    }
}

/// The prior of a size in standard uncertainties, where only the data matter.
const WIDE: f64 = 1e4;

impl Composition {
    /// The parameters at their best values and, each in turn, far enough up and down that all of them
    /// together have the covariance of the posterior.
    fn nearby(&self) -> Vec<Vec<Vec<f64>>> {
        let best = self.shares();
        let count: usize = best.iter().map(Vec::len).sum();
        let far = (count as f64 + 0.5).sqrt();
        let mut all = vec![best.clone()];
        for (number, term) in self.terms.iter().enumerate() {
            for (n, width) in term.widths.iter().enumerate() {
                for sign in [far, -far] {
                    let mut moved = best.clone();
                    let share = &mut moved[number][n];
                    *share = (*share + sign * width).clamp(0.0, 1.0);
                    all.push(moved);
                }
            }
        }
        all
    }
}
