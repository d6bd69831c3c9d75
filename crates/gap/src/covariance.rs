//! The covariance of the residuals that does not depend on the unknown quantities: stated
//! uncertainties of the data, and inputs that act linearly and are integrated out exactly.
//!
//! It is a block for each row of the data plus a matrix of low rank, and is never formed.

use nalgebra::{DMatrix, DVector};

use super::data::{Data, Spread};
use crate::Case;

/// Covariance V = B + L L', with B in blocks of the outputs of a row.
#[derive(Clone, Debug)]
pub(crate) struct Covariance {
    /// Number of outputs.
    pub outputs: usize,
    /// For each row the inverse of the lower Cholesky root of its block, row by row of the triangle.
    pub(crate) roots: Vec<f64>,
    /// For each value (row by row, outputs fastest) the variance that is known whatever the noise.
    pub(crate) variances: Vec<f64>,
    /// The columns of L, whitened by the roots where the noise is known.
    pub(crate) basis: Vec<Vec<f64>>,
    /// The columns of L in the outputs' units.
    pub(crate) raw_basis: Vec<Vec<f64>>,
    /// Lower Cholesky root of I + L' inv(B) L.
    pub(crate) inner: DMatrix<f64>,
    /// Half the logarithm of the determinant of V.
    pub(crate) half_ln_det: f64,
    /// Whether the noise of some output is to be estimated.
    pub(crate) fitted: bool,
}

/// Number of elements of a lower triangle.
pub(crate) const fn triangle(order: usize) -> usize {
    order * (order + 1) / 2
}

impl Covariance {
    /// `linear` are the variables to be integrated out, all of those that differ from row to row
    /// among them.
    pub(crate) fn new(case: &Case, data: &Data, spread: &Spread, linear: &[usize]) -> Self {
        let (rows, outputs) = (data.rows(), data.outputs.len());
        let fitted = data.uncertainties.iter().any(Option::is_none);
        let mut blocks = vec![0.0; rows * triangle(outputs)];
        let at = |row: usize, i: usize, j: usize| row * triangle(outputs) + triangle(i) + j;
        for (output, uncertainties) in data.uncertainties.iter().enumerate() {
            for (row, u) in uncertainties.iter().flatten().enumerate() {
                blocks[at(row, output, output)] += u * u;
            }
        }
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for &variable in linear {
            let effect = |row: usize, output: usize| {
                let point = data.point_of[row];
                data.points[point].gradients[output][variable] * spread.deviations[variable][point]
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
        join(case, linear, spread, &mut basis);
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
            inner: DMatrix::zeros(0, 0),
            half_ln_det: 0.0,
            fitted,
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
            half_ln_det += invert_root(block, outputs);
        }
        self.roots = blocks;
        let basis = std::mem::take(&mut self.basis);
        self.basis = basis.into_iter().map(|column| self.whiten_blocks(&column)).collect();
        let k = self.basis.len();
        let mut inner = DMatrix::identity(k, k);
        for i in 0..k {
            for j in 0..=i {
                let dot = dot(&self.basis[i], &self.basis[j]);
                inner[(i, j)] += dot;
                if i != j {
                    inner[(j, i)] += dot;
                }
            }
        }
        // the identity plus products has a root whatever the basis is
        self.inner = inner.cholesky().map_or_else(|| DMatrix::identity(k, k), |root| root.l());
        self.half_ln_det = half_ln_det + (0..k).map(|i| self.inner[(i, i)].ln()).sum::<f64>();
    }

    /// inv(root of B) x, for x row by row with outputs fastest.
    pub(crate) fn whiten_blocks(&self, values: &[f64]) -> Vec<f64> {
        let outputs = self.outputs;
        let mut whitened = vec![0.0; values.len()];
        for ((root, x), y) in self
            .roots
            .chunks_exact(triangle(outputs))
            .zip(values.chunks_exact(outputs))
            .zip(whitened.chunks_exact_mut(outputs))
        {
            for i in 0..outputs {
                y[i] = (0..=i).map(|j| root[triangle(i) + j] * x[j]).sum();
            }
        }
        whitened
    }

    /// inv(inner root) L' x for an x that is whitened by the blocks: x'x less its square is the
    /// squared length of x in the metric of V.
    pub(crate) fn project(&self, whitened: &[f64]) -> DVector<f64> {
        let products = DVector::from_iterator(
            self.basis.len(),
            self.basis.iter().map(|column| dot(column, whitened)),
        );
        self.inner.solve_lower_triangular(&products).unwrap_or(products)
    }
}

/// Correlated shared variables: their columns are combined by the root of the correlation matrix.
fn join(case: &Case, linear: &[usize], spread: &Spread, basis: &mut [Vec<f64>]) {
    let shared: Vec<usize> =
        linear.iter().copied().filter(|&variable| spread.shared[variable].is_none()).collect();
    let coefficients = super::correlated::matrix(case, &shared);
    let Some(coefficients) = coefficients else { return };
    // the columns of shared variables stand first among those of shared variables only if no other
    // variable comes between, so they are found by their order
    let mut places = Vec::new();
    let mut next = 0;
    for &variable in linear {
        match &spread.shared[variable] {
            None => {
                places.push(next);
                next += 1;
            }
            Some(groups) if groups.iter().enumerate().all(|(row, &group)| row == group) => {}
            Some(groups) => next += groups.iter().max().map_or(0, |most| most + 1),
        }
    }
    let Some(root) = coefficients.cholesky().map(|root| root.l()) else { return };
    let own: Vec<Vec<f64>> = places.iter().map(|&place| basis[place].clone()).collect();
    for (j, &place) in places.iter().enumerate() {
        for (n, value) in basis[place].iter_mut().enumerate() {
            *value = own.iter().enumerate().map(|(i, column)| column[n] * root[(i, j)]).sum();
        }
    }
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

/// Replaces the lower triangle of a positive definite block by the inverse of its Cholesky root;
/// gives half the logarithm of its determinant.
fn invert_root(block: &mut [f64], order: usize) -> f64 {
    let mut half_ln_det = 0.0;
    for i in 0..order {
        for j in 0..=i {
            let mut sum = block[triangle(i) + j];
            for k in 0..j {
                sum -= block[triangle(i) + k] * block[triangle(j) + k];
            }
            block[triangle(i) + j] = if i == j {
                let root = sum.max(f64::MIN_POSITIVE).sqrt();
                half_ln_det += root.ln();
                root
            } else {
                sum / block[triangle(j) + j]
            };
        }
    }
    // forward substitution on the unit vectors, in place from the last row on
    for i in 0..order {
        let pivot = 1.0 / block[triangle(i) + i];
        for j in 0..i {
            let sum: f64 = (j..i).map(|k| block[triangle(i) + k] * block[triangle(k) + j]).sum();
            block[triangle(i) + j] = -pivot * sum;
        }
        block[triangle(i) + i] = pivot;
    }
    half_ln_det
}

/// The lower Cholesky root of a lower triangle.
pub(crate) fn root_of(matrix: &[f64], order: usize) -> Vec<f64> {
    let mut root = matrix.to_vec();
    super::likelihood::root_in_place(&mut root, order);
    root
}

/// Sum of products.
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_root_whitens_its_block() {
        let block = [[4.0, 0.6, -0.4], [0.6, 2.0, 0.3], [-0.4, 0.3, 1.0]];
        let mut root: Vec<f64> = Vec::new();
        for (i, row) in block.iter().enumerate() {
            root.extend(&row[..=i]);
        }
        let half_ln_det = invert_root(&mut root, 3);
        let dense = DMatrix::from_fn(3, 3, |i, j| block[i][j]);
        let inverse =
            DMatrix::from_fn(3, 3, |i, j| if j <= i { root[triangle(i) + j] } else { 0.0 });
        let white = &inverse * &dense * inverse.transpose();
        // rounding of a 3 x 3 factorization: a few 1e-16
        assert!((white - DMatrix::identity(3, 3)).abs().max() < 1e-14);
        assert!((half_ln_det - 0.5 * dense.determinant().ln()).abs() < 1e-14);
    }
}
