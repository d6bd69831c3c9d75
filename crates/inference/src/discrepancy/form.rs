//! A term with a length, factored for a design.

use std::borrow::Cow;
use std::sync::Arc;

use gumption_engine::parallel;
use nalgebra::{DMatrix, DVector};

use super::LENGTHS;
use super::features::{Axes, Coordinates, Nodes, sites};
use super::grammar::{Term, terms};
use super::output_sets::OutputSet;
use crate::setup::Setup;
use gumption_engine::linalg::{dot, packed};
use gumption_engine::number::elementary;

/// Data with more values than this have their features computed when they are needed and not kept.
const MOST_KEPT: usize = 4000;

/// The share of all weight that functions of the order of the rows have, where there are any.
pub const HISTORY: f64 = 0.2;

/// A term with a length.
#[derive(Debug)]
pub struct Form {
    pub term: Term,
    pub length: f64,
    /// Logarithm of its prior weight among all forms.
    pub ln_weight: f64,
    pub nodes: Arc<Nodes>,
    /// What unit variance is multiplied by: for an amplitude of one standard uncertainty where those
    /// are known.
    pub(crate) scale: f64,
    /// The features of the data's values, unless there are too many.
    features: Option<DMatrix<f64>>,
    factored: Option<Factored>,
}

/// A form in the metric of the residuals, with the noise known.
#[derive(Debug)]
struct Factored {
    /// The features, whitened by the blocks.
    white: DMatrix<f64>,
    /// What shared inputs make of them.
    cross: DMatrix<f64>,
    /// Eigenvalues of the features' covariance.
    eigenvalues: Vec<f64>,
    eigenvectors: DMatrix<f64>,
}

impl Factored {
    /// `None` where the shared inputs' covariance has no root.
    fn new(setup: &Setup<'_>, features: &DMatrix<f64>) -> Option<Self> {
        let covariance = &setup.linear;
        let mut white = DMatrix::zeros(features.nrows(), features.ncols());
        for (column, mut out) in features.column_iter().zip(white.column_iter_mut()) {
            let whitened = covariance.whiten_blocks(column.as_slice());
            out.copy_from(&DVector::from_vec(whitened));
        }
        let k = covariance.basis.len();
        let products = DMatrix::from_fn(k, white.ncols(), |i, j| {
            dot(&covariance.basis[i], white.column(j).as_slice())
        });
        let cross = packed::to_matrix(&covariance.inner).solve_lower_triangular(&products)?;
        // products of the features that shared inputs cannot make
        let mut gram = vec![0.0; packed::triangle(white.ncols())];
        packed::add_squares(&mut gram, white.transpose().as_slice());
        let gram = packed::to_symmetric(&gram) - cross.tr_mul(&cross);
        let eigen = gram.symmetric_eigen();
        let eigenvalues = eigen.eigenvalues.iter().map(|value| value.max(0.0)).collect();
        Some(Self { white, cross, eigenvalues, eigenvectors: eigen.eigenvectors })
    }

    /// The scores of columns of values, whitened by the blocks, along the eigenvectors.
    fn scores(&self, setup: &Setup<'_>, whitened: &DMatrix<f64>) -> DMatrix<f64> {
        let project = |column: nalgebra::DVectorView<'_, f64>| {
            DVector::from_vec(setup.linear.project(column.as_slice()))
        };
        let projected: Vec<DVector<f64>> = whitened.column_iter().map(project).collect();
        let products =
            self.white.tr_mul(whitened) - self.cross.tr_mul(&DMatrix::from_columns(&projected));
        self.eigenvectors.tr_mul(&products)
    }
}

/// The forms for a design in which these sets of outputs may depart, those that are `wanted`.
pub(crate) fn forms(
    setup: &Setup<'_>,
    axes: &Axes,
    sets: &[OutputSet],
    wanted: &(dyn Fn(&Term, f64, &Coordinates) -> bool + Sync),
) -> Vec<Form> {
    let terms = terms(setup.case, &setup.data, sets);
    let weight_of = |of_history: bool| -> f64 {
        let all = terms.iter().filter(|(term, _)| term.is_of_history(setup.case) == of_history);
        all.map(|(_, weight)| weight).sum()
    };
    let weights = [weight_of(false), weight_of(true)];
    let share = if weights[1] > 0.0 { HISTORY } else { 0.0 };
    let ln_weight_of = |term: &Term, weight: f64| {
        let (share, all) = match term.is_of_history(setup.case) {
            true => (share, weights[1]),
            false => (1.0 - share, weights[0]),
        };
        elementary::ln(share * weight / all)
    };
    let sites = sites(setup.case, &setup.data);
    let outputs = setup.data.outputs.len();
    let of_term = |(term, weight): &(Term, f64)| -> Vec<(Term, Coordinates, f64, f64)> {
        let coordinates = Coordinates::new(term, axes, &sites, outputs);
        let lengths = if term.is_smooth() { &LENGTHS[..] } else { &LENGTHS[..1] };
        let lengths: Vec<f64> =
            lengths.iter().copied().filter(|&length| wanted(term, length, &coordinates)).collect();
        let ln_weight = ln_weight_of(term, *weight) - elementary::ln(lengths.len().max(1) as f64);
        let of_length = |length| (term.clone(), coordinates.clone(), length, ln_weight);
        lengths.into_iter().map(of_length).collect()
    };
    let with_lengths: Vec<(Term, Coordinates, f64, f64)> =
        parallel::map(&terms, of_term).into_iter().flatten().collect();
    // terms that are functions of the same at the same places have their nodes in common
    let mut distinct: Vec<usize> = Vec::new();
    let mut nodes_of = Vec::with_capacity(with_lengths.len());
    for (place, (term, coordinates, length, _)) in with_lengths.iter().enumerate() {
        let same = |&&other_place: &&usize| {
            let (other, others, other_length, _) = &with_lengths[other_place];
            term.of == other.of && length == other_length && coordinates.is_at_same(others)
        };
        let known = distinct.iter().find(same).copied();
        nodes_of.push(known.unwrap_or(place));
        if known.is_none() {
            distinct.push(place);
        }
    }
    let nodes: Vec<(usize, Arc<Nodes>)> = parallel::map(distinct, |place| {
        let (term, coordinates, length, _) = &with_lengths[place];
        let nodes = Nodes::new(term, *length, coordinates, setup.linear.fitted);
        (place, Arc::new(nodes))
    });
    let with_nodes = with_lengths.into_iter().zip(nodes_of).filter_map(|(form, place)| {
        Some((form, nodes.iter().find(|(other, _)| *other == place)?.1.clone()))
    });
    parallel::map(with_nodes, |((term, coordinates, length, ln_weight), nodes)| {
        let roots = coordinates.roots(&term, length, &nodes);
        let features = coordinates.features(&roots, setup.data.len());
        let touched: Vec<usize> = coordinates.touched().collect();
        let mut scale = 1.0;
        if !setup.linear.fitted {
            let squares: f64 = touched
                .iter()
                .map(|&value| features.row(value).norm_squared() / setup.linear.variances[value])
                .sum();
            scale = (touched.len().max(1) as f64 / squares.max(f64::MIN_POSITIVE)).sqrt();
        }
        let features = features * scale;
        let keep = setup.data.len() <= MOST_KEPT;
        Form {
            term,
            length,
            ln_weight,
            nodes,
            scale,
            factored: (keep && !setup.linear.fitted)
                .then(|| Factored::new(setup, &features))
                .flatten(),
            features: keep.then_some(features),
        }
    })
}

impl Form {
    /// Whether the features of the data's values are kept.
    pub(crate) fn is_kept(&self) -> bool {
        self.features.is_some()
    }

    /// The features of the data's values, a row each, times the scale.
    pub fn features(&self, setup: &Setup<'_>, axes: &Axes) -> Cow<'_, DMatrix<f64>> {
        if let Some(features) = &self.features {
            return Cow::Borrowed(features);
        }
        let sites = sites(setup.case, &setup.data);
        let coordinates = Coordinates::new(&self.term, axes, &sites, setup.data.outputs.len());
        let roots = coordinates.roots(&self.term, self.length, &self.nodes);
        Cow::Owned(coordinates.features(&roots, setup.data.len()) * self.scale)
    }

    /// Eigenvalues, and the scores of columns of values that are whitened by the blocks: a row for each
    /// eigenvalue.
    pub(crate) fn scores(
        &self,
        setup: &Setup<'_>,
        axes: &Axes,
        whitened: &DMatrix<f64>,
    ) -> (Vec<f64>, DMatrix<f64>) {
        let of = |factored: &Factored| factored.scores(setup, whitened);
        if let Some(factored) = &self.factored {
            return (factored.eigenvalues.clone(), of(factored));
        }
        match Factored::new(setup, &self.features(setup, axes)) {
            Some(factored) => (factored.eigenvalues.clone(), of(&factored)),
            None => (Vec::new(), DMatrix::zeros(0, whitened.ncols())),
        }
    }
}
