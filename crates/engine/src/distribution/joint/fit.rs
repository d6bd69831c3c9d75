//! The fit of a Gaussian copula to the coefficients of a group.

use std::collections::HashMap;
use std::sync::Arc;

use super::contradiction::changed;
use super::copula::{Margin, Pair};
use super::decimals::are_linked_results;
use super::error::unit;
use super::profiles::Profiled;
use super::{Correlation, CorrelationError};
use crate::distribution::Distribution;
use crate::linalg::CorrelationMatrix;

/// Largest allowed change of the coefficients of saved results in draws: the copula of dependent
/// outputs need not be Gaussian. The change is reported.
const RESULTS: f64 = 0.05;

/// A group of quantities.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit<'a> {
    pub members: &'a [usize],
    pub(super) distributions: &'a [Arc<Distribution>],
    /// The members' profiles; `None` for normal ones.
    pub(super) profiles: &'a [Option<Arc<Profiled>>],
    /// Decimals of the coefficients.
    pub(super) decimals: usize,
}

/// What was found.
#[derive(Debug)]
pub(super) struct Fitted {
    /// The coefficients of the normals.
    pub(super) normals: CorrelationMatrix,
    /// The largest necessary change of a coefficient.
    pub(super) adjusted: f64,
    /// The coefficients that the copula cannot produce exactly: wanted, and drawn.
    pub(super) changes: Vec<(Correlation, f64)>,
}

/// Pairs of shapes with their fits: members with equal shapes are frequent.
#[derive(Debug)]
struct Pairs<'a> {
    margins: Vec<Margin<'a>>,
    /// The number of each member's shape.
    shapes: Vec<usize>,
    found: HashMap<[usize; 2], Known>,
}

#[derive(Debug)]
struct Known {
    pair: Pair,
    /// Coefficients of the normal scores, by the bits of those of the quantities.
    fits: HashMap<u64, Option<f64>>,
}

impl<'a> Pairs<'a> {
    fn new(profiles: &'a [Option<Arc<Profiled>>]) -> Self {
        let mut numbers: HashMap<*const Profiled, usize> = HashMap::new();
        let shapes = profiles.iter().map(|profiled| match profiled {
            None => 0,
            Some(profiled) => {
                let next = numbers.len() + 1;
                *numbers.entry(Arc::as_ptr(profiled)).or_insert(next)
            }
        });
        let shapes = shapes.collect();
        let margins = profiles
            .iter()
            .map(|profiled| profiled.as_ref().map_or(Margin::Normal, |p| p.margin()))
            .collect();
        Self { margins, shapes, found: HashMap::new() }
    }

    fn known(&mut self, i: usize, j: usize) -> &mut Known {
        let Self { margins, shapes, found } = self;
        found.entry([shapes[i], shapes[j]]).or_insert_with(|| Known {
            pair: Pair::new(&margins[i], &margins[j]),
            fits: HashMap::new(),
        })
    }

    fn pair(&mut self, i: usize, j: usize) -> &Pair {
        &self.known(i, j).pair
    }

    /// The coefficient of the normal scores of two members for that of the quantities.
    fn fit(&mut self, i: usize, j: usize, coefficient: f64) -> Option<f64> {
        let Known { pair, fits } = self.known(i, j);
        *fits.entry(coefficient.to_bits()).or_insert_with(|| pair.fit(coefficient))
    }
}

impl Fit<'_> {
    /// The coefficients of the normal scores that give the quantities the wanted ones.
    pub(super) fn fit(&self, wanted: &CorrelationMatrix) -> Result<Fitted, CorrelationError> {
        let Self { members, distributions, decimals, .. } = *self;
        let mut pairs = Pairs::new(self.profiles);
        let mut adjusted: f64 = 0.0;
        let mut changes = Vec::new();
        let mut fitted = CorrelationMatrix::identity(wanted.size());
        for (i, j) in wanted.pairs() {
            let coefficient = wanted.get(i, j);
            if coefficient == 0.0 {
                continue;
            }
            let mut found = pairs.fit(i, j, coefficient);
            if found.is_none() && are_linked_results(distributions, members[i], members[j]) {
                // one is a function of the other, and the copula reaches it up to rounding
                let [least, most] = pairs.pair(i, j).attainable();
                let nearest = coefficient.clamp(least, most);
                let change = (coefficient - nearest).abs();
                if change <= 0.5 * unit(decimals) {
                    adjusted = adjusted.max(change);
                    let (first, second) = (members[i], members[j]);
                    changes.push((Correlation { first, second, coefficient }, nearest));
                    found = pairs.fit(i, j, nearest);
                }
            }
            let Some(r) = found else {
                let declared = Correlation { first: members[i], second: members[j], coefficient };
                let attainable = pairs.pair(i, j).attainable();
                return Err(CorrelationError::OutOfReach { declared, attainable });
            };
            fitted.set(i, j, r);
        }
        if fitted.is_semidefinite() {
            return Ok(Fitted { normals: fitted, adjusted, changes });
        }
        let repaired = fitted.nearest();
        let mut drawn = wanted.clone();
        for (i, j) in wanted.pairs() {
            drawn.set(i, j, pairs.pair(i, j).of_normals(repaired.get(i, j)));
        }
        let change = wanted
            .pairs()
            .map(|(i, j)| (wanted.get(i, j) - drawn.get(i, j)).abs())
            .fold(0.0, f64::max);
        let linked = |i: usize, j: usize| are_linked_results(distributions, members[i], members[j]);
        let of_results = wanted.pairs().all(|(i, j)| wanted.get(i, j) == 0.0 || linked(i, j));
        let most = if of_results { RESULTS } else { 0.5 * unit(decimals) };
        if change > most {
            return Err(CorrelationError::BeyondCopula {
                members: members.to_vec(),
                nearest: changed(members, wanted, &drawn, decimals),
                decimals,
            });
        }
        let changes = wanted.pairs().map(|(i, j)| {
            let (first, second) = (members[i], members[j]);
            (Correlation { first, second, coefficient: wanted.get(i, j) }, drawn.get(i, j))
        });
        let (changes, adjusted) = (changes.collect(), adjusted.max(change));
        Ok(Fitted { normals: repaired, adjusted, changes })
    }
}
