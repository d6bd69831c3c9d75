//! A term with a length, factored for a design.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::LENGTHS;
use super::features::{Axes, Coordinates, Nodes, sites};
use super::grammar::{Term, terms};
use crate::gap::setup::Setup;

/// A term with a length.
#[derive(Debug)]
pub(crate) struct Form {
    pub(crate) term: Term,
    pub(crate) length: f64,
    /// Logarithm of its prior weight among all forms.
    pub(crate) ln_weight: f64,
    pub(crate) nodes: Nodes,
    /// Features of the data's values, scaled to an amplitude of one standard uncertainty where those
    /// are known, and of unit variance where they are not.
    pub(crate) features: DMatrix<f64>,
    /// What unit variance was multiplied by.
    pub(crate) scale: f64,
    /// Eigenvalues of the features' covariance in the metric of the residuals.
    pub(crate) eigenvalues: Vec<f64>,
    /// Takes residuals, whitened by the blocks, to scores along the eigenvectors.
    pub(crate) projector: DMatrix<f64>,
}

/// All forms for a design.
pub(crate) fn forms(setup: &Setup<'_>, axes: &Axes) -> Vec<Form> {
    let terms = terms(setup.case, &setup.data);
    let ln_term = -(terms.len() as f64).ln();
    let sites = sites(setup.case, &setup.data);
    let outputs = setup.data.outputs.len();
    let with_lengths: Vec<(&Term, f64, f64)> = terms
        .iter()
        .flat_map(|term| {
            let lengths = if term.is_smooth() { &LENGTHS[..] } else { &LENGTHS[..1] };
            let ln_weight = ln_term - (lengths.len() as f64).ln();
            lengths.iter().map(move |&length| (term, length, ln_weight))
        })
        .collect();
    with_lengths
        .into_par_iter()
        .map(|(term, length, ln_weight)| {
            let coordinates = Coordinates::new(term, axes, &sites, outputs);
            let nodes = Nodes::new(term, length, &coordinates);
            let roots = coordinates.roots(term, length, &nodes);
            let mut features = coordinates.features(&roots, setup.data.len());
            let touched: Vec<usize> = coordinates.touched().collect();
            let mut scale = 1.0;
            if !setup.linear.fitted {
                let squares: f64 = touched
                    .iter()
                    .map(|&value| {
                        features.row(value).norm_squared() / setup.linear.variances[value]
                    })
                    .sum();
                scale = (touched.len().max(1) as f64 / squares.max(f64::MIN_POSITIVE)).sqrt();
                features *= scale;
            }
            let form = Form {
                term: term.clone(),
                length,
                ln_weight,
                nodes,
                features,
                scale,
                eigenvalues: Vec::new(),
                projector: DMatrix::zeros(0, 0),
            };
            if setup.linear.fitted { form } else { form.factored(setup) }
        })
        .collect()
}

impl Form {
    fn factored(mut self, setup: &Setup<'_>) -> Self {
        let covariance = &setup.linear;
        let mut white = DMatrix::zeros(self.features.nrows(), self.features.ncols());
        for (column, mut out) in self.features.column_iter().zip(white.column_iter_mut()) {
            let whitened = covariance.whiten_blocks(column.as_slice());
            out.copy_from(&DVector::from_vec(whitened));
        }
        let k = covariance.basis.len();
        let basis = DMatrix::from_fn(white.nrows(), k, |i, j| covariance.basis[j][i]);
        // the part of the features that shared inputs cannot make
        let inner = covariance.inner.solve_lower_triangular(&basis.transpose());
        let projected = inner.map(|half| {
            let cross = &half * &white;
            (white.tr_mul(&white) - cross.tr_mul(&cross), white.transpose() - cross.tr_mul(&half))
        });
        let Some((gram, projector)) = projected else { return self };
        let eigen = gram.symmetric_eigen();
        self.projector = eigen.eigenvectors.tr_mul(&projector);
        self.eigenvalues = eigen.eigenvalues.iter().map(|value| value.max(0.0)).collect();
        self
    }
}
