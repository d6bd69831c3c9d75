//! The covariance of the residuals that does not depend on the unknown quantities: stated
//! uncertainties of the data, and inputs that act linearly and are integrated out exactly.
//!
//! It is a block for each row of the data plus a matrix of low rank, and is never formed.

use nalgebra::{DMatrix, DVector};

use super::correlated;
use super::data::{Data, Spread};
use crate::Case;
use crate::noise::resolution::Rounding;
use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::elementary;

/// Covariance V = B + L L', with B in blocks of the outputs of a row.
#[derive(Clone, Debug)]
pub struct Covariance {
    /// Number of outputs.
    pub outputs: usize,
    /// For each row the inverse of the lower Cholesky root of its block, row by row of the triangle.
    pub(crate) roots: Vec<f64>,
    /// For each value (row by row, outputs fastest) the variance that is known whatever the noise.
    pub variances: Vec<f64>,
    /// The columns of L, whitened by the roots where the noise is known.
    pub basis: Vec<Vec<f64>>,
    /// The columns of L in the outputs' units.
    pub raw_basis: Vec<Vec<f64>>,
    /// Lower Cholesky root of I + L' inv(B) L, row by row of the triangle.
    pub inner: Vec<f64>,
    /// Half the logarithm of the determinant of V.
    pub(crate) half_ln_det: f64,
    /// Whether the noise of some output is to be estimated.
    pub fitted: bool,
    /// For each row the correlation of its whitened noise with that of the row before; empty where
    /// rows are independent.
    pub lags: Vec<f64>,
}

impl Covariance {
    /// `linear` are the variables to be integrated out, all of those that differ from row to row
    /// among them.
    pub fn new(case: &Case, data: &Data, spread: &Spread, linear: &[usize]) -> Self {
        let (rows, outputs) = (data.rows(), data.outputs.len());
        let fitted = data.uncertainties.iter().any(Option::is_none);
        let mut blocks = vec![0.0; rows * triangle(outputs)];
        let at = |row: usize, i: usize, j: usize| row * triangle(outputs) + triangle(i) + j;
        for (output, uncertainties) in data.uncertainties.iter().enumerate() {
            for (row, u) in uncertainties.iter().flatten().enumerate() {
                blocks[at(row, output, output)] += u * u;
            }
        }
        if let Some(common) = &data.noise.common {
            for row in 0..rows {
                for i in 0..outputs {
                    for j in 0..i {
                        let u = |output: usize| {
                            data.uncertainties[output].as_ref().map_or(0.0, |u| u[row])
                        };
                        blocks[at(row, i, j)] += common.between(i, j) * u(i) * u(j);
                    }
                }
            }
        }
        let mut basis: Vec<Vec<f64>> = Vec::new();
        // first, as they have nothing to do with each other: the root of the inner products is zero there
        if let Some(shared) = &data.noise.shared {
            basis.extend(shared.columns(case, data));
        }
        let root = correlated::root(case, linear);
        for (place, &variable) in linear.iter().enumerate() {
            let own = |variable: usize, row: usize, output: usize| {
                let point = data.point_of[row];
                data.points[point].tangent.gradients[output][variable]
                    * spread.deviations[variable][point]
            };
            // of correlated variables, which are shared alike, what is independent of those before
            let effect = |row: usize, output: usize| match &root {
                None => own(variable, row, output),
                Some(root) => (place..linear.len())
                    .filter(|&other| root[(other, place)] != 0.0)
                    .map(|other| root[(other, place)] * own(linear[other], row, output))
                    .sum(),
            };
            match &spread.shared[variable] {
                None => {
                    let column = (0..rows * outputs).map(|n| effect(n / outputs, n % outputs));
                    basis.push(column.collect());
                }
                Some(groups) if groups.iter().enumerate().all(|(row, &group)| row == group) => {
                    for row in 0..rows {
                        for i in 0..outputs {
                            for j in 0..=i {
                                blocks[at(row, i, j)] += effect(row, i) * effect(row, j);
                            }
                        }
                    }
                }
                Some(groups) => {
                    let levels = groups.iter().max().map_or(0, |most| most + 1);
                    let mut columns = vec![vec![0.0; rows * outputs]; levels];
                    for (row, &group) in groups.iter().enumerate() {
                        for output in 0..outputs {
                            columns[group][row * outputs + output] = effect(row, output);
                        }
                    }
                    basis.extend(columns);
                }
            }
        }
        for (output, &place) in data.outputs.iter().enumerate() {
            let covariance = case.observed[place].as_ref();
            if let Some(matrix) = covariance.and_then(|o| o.simulation_covariance.as_ref()) {
                let matrix: Vec<Vec<f64>> = data
                    .ids
                    .iter()
                    .map(|&i| data.ids.iter().map(|&j| matrix[i][j]).collect())
                    .collect();
                basis.extend(roots_of(&matrix).into_iter().map(|root| {
                    let mut column = vec![0.0; rows * outputs];
                    for (row, value) in root.into_iter().enumerate() {
                        column[row * outputs + output] = value;
                    }
                    column
                }));
            }
        }
        for output in 0..outputs {
            let Some(rounding) = Rounding::of(case, data, output) else { continue };
            let deviation = rounding.deviation();
            for equal in rounding.equal(data, output) {
                // the mean of equal values is as uncertain as one of them
                let shared = deviation * (1.0 - 1.0 / equal.len() as f64).sqrt();
                let mut column = vec![0.0; rows * outputs];
                for row in equal {
                    blocks[at(row, output, output)] += rounding.variance(row);
                    column[row * outputs + output] = shared;
                }
                basis.push(column);
            }
        }
        basis.retain(|column| column.iter().any(|value| *value != 0.0));
        let variances = (0..rows * outputs)
            .map(|n| blocks[at(n / outputs, n % outputs, n % outputs)])
            .collect();
        let mut covariance = Self {
            outputs,
            roots: Vec::new(),
            variances,
            raw_basis: basis.clone(),
            basis,
            inner: Vec::new(),
            half_ln_det: 0.0,
            fitted,
            lags: if fitted { Vec::new() } else { data.lags.clone() },
        };
        if !fitted {
            covariance.factor(blocks);
        }
        covariance
    }

    /// Roots of the blocks, and the basis whitened by them.
    fn factor(&mut self, mut blocks: Vec<f64>) {
        let outputs = self.outputs;
        let mut half_ln_det = 0.0;
        for block in blocks.chunks_exact_mut(triangle(outputs)) {
            packed::cholesky_of_definite(block);
            half_ln_det += packed::ln_diagonal(block);
            packed::invert(block);
        }
        self.roots = blocks;
        let basis = std::mem::take(&mut self.basis);
        self.basis = basis.into_iter().map(|column| self.whiten_blocks(&column)).collect();
        let inner = inner_root(&self.basis);
        let of_lag = |lag: &f64| 0.5 * outputs as f64 * elementary::ln(1.0 - lag * lag);
        half_ln_det += self.lags.iter().map(of_lag).sum::<f64>();
        self.half_ln_det = half_ln_det + packed::ln_diagonal(&inner);
        self.inner = inner;
    }

    /// The same with more that is integrated out: columns of values whose factors are standard normal.
    pub(crate) fn with(&self, columns: &[Vec<f64>]) -> Self {
        let mut with = self.clone();
        with.raw_basis.extend_from_slice(columns);
        if self.fitted {
            with.basis.extend_from_slice(columns);
            return with;
        }
        with.basis.extend(columns.iter().map(|column| self.whiten_blocks(column)));
        with.inner = inner_root(&with.basis);
        with.half_ln_det += packed::ln_diagonal(&with.inner) - packed::ln_diagonal(&self.inner);
        with
    }

    /// inv(root of B) x, for x row by row with outputs fastest.
    pub fn whiten_blocks(&self, values: &[f64]) -> Vec<f64> {
        let outputs = self.outputs;
        let mut whitened = vec![0.0; values.len()];
        for ((root, x), y) in self
            .roots
            .chunks_exact(triangle(outputs))
            .zip(values.chunks_exact(outputs))
            .zip(whitened.chunks_exact_mut(outputs))
        {
            for (y, row) in y.iter_mut().zip(packed::rows(root)) {
                *y = dot(row, x);
            }
        }
        for (row, lag) in self.lags.iter().enumerate().skip(1).rev() {
            let (before, here) = whitened.split_at_mut(row * outputs);
            let before = &before[(row - 1) * outputs..];
            for (here, before) in here.iter_mut().zip(before) {
                *here = (*here - lag * before) / (1.0 - lag * lag).sqrt();
            }
        }
        whitened
    }

    /// inv(inner root) L' x for an x that is whitened by the blocks: x'x less its square is the
    /// squared length of x in the metric of V.
    pub fn project(&self, whitened: &[f64]) -> Vec<f64> {
        let mut products: Vec<f64> =
            self.basis.iter().map(|column| dot(column, whitened)).collect();
        packed::solve(&self.inner, &mut products);
        products
    }

    /// The products of vectors that are whitened by the blocks, in the metric of V: the lower triangle.
    pub(crate) fn products(&self, whitened: &[DVector<f64>]) -> Vec<f64> {
        let projected: Vec<Vec<f64>> =
            whitened.iter().map(|white| self.project(white.as_slice())).collect();
        let product =
            |i: usize, j: usize| whitened[i].dot(&whitened[j]) - dot(&projected[i], &projected[j]);
        (0..whitened.len())
            .flat_map(|i| (0..=i).map(move |j| (i, j)))
            .map(|(i, j)| product(i, j))
            .collect()
    }

    /// The squared length of an x, whitened by the blocks, in the metric of V.
    pub fn square(&self, whitened: &[f64]) -> f64 {
        let projected = self.project(whitened);
        dot(whitened, whitened) - dot(&projected, &projected)
    }
}

/// The lower Cholesky root of I + L' L, for the columns of L, row by row of the triangle.
pub(crate) fn inner_root(basis: &[Vec<f64>]) -> Vec<f64> {
    let mut inner = Vec::with_capacity(triangle(basis.len()));
    for (i, column) in basis.iter().enumerate() {
        inner.extend(basis[..=i].iter().map(|other| dot(column, other)));
        inner[triangle(i) + i] += 1.0;
    }
    packed::cholesky_of_definite(&mut inner);
    inner
}

/// Columns whose outer products sum to a covariance matrix; what rounding leaves below zero is
/// dropped.
fn roots_of(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let order = matrix.len();
    let dense = DMatrix::from_fn(order, order, |i, j| 0.5 * (matrix[i][j] + matrix[j][i]));
    let eigen = dense.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    (0..order)
        .filter(|&k| eigen.eigenvalues[k] > 1e-12 * largest)
        .map(|k| {
            let scale = eigen.eigenvalues[k].sqrt();
            eigen.eigenvectors.column(k).iter().map(|value| scale * value).collect()
        })
        .collect()
}
