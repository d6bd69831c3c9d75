//! The joint distribution of many quantities: which of them are drawn together, and how.
//!
//! - Quantities with declared coefficients are drawn from joint standard normal ones: normal
//!   quantities exactly, all others through a Gaussian copula fitted to their coefficients
//!   ([`copula`], [`profile`]).
//! - Outputs of one saved result are drawn as they varied in its trials ([`rank_sample`]), unless a
//!   coefficient links one of them to another quantity.
//! - Paired readings are drawn from a multivariate t distribution ([`paired`]).
//! - Parameters of a fitted calibration function are drawn from their joint normal or t
//!   distribution, or, in each trial, from a fit to points of its own.
//!
//! Contradictory coefficients are an error and never changed. Only a contradiction within the
//! rounding of their last decimals is replaced by the nearest possible coefficients, with a
//! warning. The same holds if each pair can have its coefficient but the normal scores of the
//! copula cannot.

mod contradiction;
mod copula;
mod decimals;
mod draws;
mod error;
mod fit;
mod fits;
mod linked;
mod links;
pub mod paired;
mod profile;
mod profiles;
mod rank_sample;
mod scores;
mod standard;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::sync::{Arc, Mutex, PoisonError};

pub use draws::Draws;
pub use draws::Varying;
pub use error::CorrelationError;
pub use fits::Fits;
pub(crate) use linked::{Dependence, Linked};
pub(crate) use links::connected;
use profile::QuantileTable;
use profiles::{Profiled, Profiles};
use rank_sample::{RankSample, rank_samples};
pub use scores::FromScore;
use standard::Standard;

use super::Distribution;
use crate::linalg::{CorrelationMatrix, packed};
use crate::regression::Refit;

/// A declared correlation coefficient of two quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// Index of the first quantity.
    pub first: usize,
    /// Index of the second quantity.
    pub second: usize,
    /// The coefficient r, from -1 to 1.
    pub coefficient: f64,
}

/// Maximum number of dependent quantities. Their matrix and its factor take 64 MB.
const MOST_LINKED: usize = 2000;

/// A quantity of a group.
#[derive(Clone, Debug)]
struct Member {
    index: usize,
    shape: MemberShape,
}

/// How the group's standard normal or t quantity is converted.
#[derive(Clone, Debug)]
enum MemberShape {
    /// The quantity, apart from its location and scale.
    Plain,
    /// A value of this shape, from the table.
    Tabulated(Standard, Arc<QuantileTable>),
}

impl Member {
    fn plain(index: usize) -> Self {
        Self { index, shape: MemberShape::Plain }
    }

    fn table(&self) -> Option<&QuantileTable> {
        match &self.shape {
            MemberShape::Plain => None,
            MemberShape::Tabulated(_, table) => Some(table),
        }
    }

    /// Location and scale of the quantity in a row.
    fn placed(&self, distribution: &Distribution) -> [f64; 2] {
        match &self.shape {
            MemberShape::Plain => standard::plain(distribution),
            MemberShape::Tabulated(shape, _) => shape.placed(distribution),
        }
    }
}

/// Quantities that are drawn together.
#[derive(Clone, Debug)]
struct JointGroup {
    members: Vec<Member>,
    /// Lower triangular factor of the correlation matrix, packed.
    factor: Vec<f64>,
    /// The columns of the factor that are not zero: a quantity that the ones before it determine has
    /// none of its own.
    independent: Vec<usize>,
    /// Degrees of freedom of a multivariate t distribution; `None` for joint normals.
    dof: Option<f64>,
}

impl JointGroup {
    fn new(members: Vec<Member>, coefficients: &CorrelationMatrix, dof: Option<f64>) -> Self {
        let factor = coefficients.factor();
        let own = |row: &[f64]| row.last().is_some_and(|entry| *entry != 0.0);
        let rows = packed::rows(&factor).enumerate();
        let independent = rows.filter(|(_, row)| own(row)).map(|(index, _)| index).collect();
        Self { members, factor, independent, dof }
    }
}

/// How a set of quantities is drawn, apart from the locations and scales, which differ between
/// rows.
#[derive(Clone, Debug, Default)]
pub struct Joint {
    groups: Vec<JointGroup>,
    /// Outputs of saved results.
    rank_samples: Vec<RankSample>,
    /// Parameters of fits, in each trial from points of its own.
    refits: Vec<Refit>,
    /// Whether some matrix was positive semi-definite only up to the rounding of its coefficients.
    pub(crate) rounded: bool,
    /// The quantities that are drawn through a Gaussian copula, in order. They include normal ones
    /// that share a group with others.
    pub(crate) copula: Vec<usize>,
    /// The largest change of a coefficient, within its rounding, that a copula needed.
    pub(crate) adjusted: f64,
    /// The coefficients that a copula cannot produce exactly: wanted, and drawn.
    pub(crate) changes: Arc<Vec<(Correlation, f64)>>,
    /// Whether nothing is drawn: for an evaluation without trials, of quantities that only the law
    /// of propagation can correlate.
    pub(crate) undrawn: bool,
}

impl Joint {
    /// The joint draw of quantities with these distributions and coefficients.
    #[cfg(test)]
    pub fn new(
        distributions: &[Distribution],
        correlations: &[Correlation],
    ) -> Result<Arc<Self>, CorrelationError> {
        let shared: Vec<Arc<Distribution>> = distributions.iter().cloned().map(Arc::new).collect();
        Fits::default().joint(&shared, correlations)
    }

    /// The joint draw of quantities with these distributions and coefficients. Constants and
    /// coefficients of 0 are ignored. `profiles` is kept for the next call.
    fn with(
        profiles: &Mutex<Profiles>,
        distributions: &[Arc<Distribution>],
        correlations: &[Correlation],
    ) -> Result<Self, CorrelationError> {
        let active = active(distributions, correlations);
        let mut joint = Self::default();
        for ensemble in paired::ensembles(distributions) {
            ensemble.check(distributions)?;
            let members = &ensemble.members;
            if let Some(c) =
                active.iter().find(|c| members.contains(&c.first) || members.contains(&c.second))
            {
                let (first, second) = (members.contains(&c.first), members.contains(&c.second));
                let (member, other) = if first { (c.first, c.second) } else { (c.second, c.first) };
                if ensemble.fit.is_some() {
                    return Err(CorrelationError::GivenByFit { member, other });
                }
                let paired = first && second;
                return Err(CorrelationError::GivenByReadings { member, other, paired });
            }
            if let Some(fit) = ensemble.fit.as_ref().filter(|fit| !fit.is_linear()) {
                let parameter = |m: &usize| match &*distributions[*m] {
                    Distribution::Fitted(fitted) => fitted.parameter().map(|of| (*m, of)),
                    _ => None,
                };
                let (members, parameters) = members.iter().filter_map(parameter).unzip();
                joint.refits.push(Refit::new(members, parameters, Arc::clone(fit)));
                continue;
            }
            let dof = members.first().map(|&m| distributions[m].drawn_dof());
            let members = members.iter().map(|&m| Member::plain(m)).collect();
            let dof = dof.filter(|dof| dof.is_finite());
            joint.groups.push(JointGroup::new(members, &ensemble.coefficients, dof));
        }
        let linked = connected(&active);
        joint.rank_samples = rank_samples(distributions);
        // a coefficient with another quantity takes all of them out
        joint.rank_samples.retain(|set| {
            let other = |m: &usize| !set.members.contains(m);
            !linked.iter().any(|ms| ms.iter().any(|m| !other(m)) && ms.iter().any(other))
        });
        for members in linked {
            let inside = |set: &RankSample| members.iter().all(|m| set.members.contains(m));
            if !joint.rank_samples.iter().any(inside) {
                joint.add_correlated(&members, distributions, &active, profiles)?;
            }
        }
        joint.copula.sort_unstable();
        Ok(joint)
    }

    /// Adds the group of quantities connected by coefficients.
    fn add_correlated(
        &mut self,
        members: &[usize],
        distributions: &[Arc<Distribution>],
        active: &[Correlation],
        profiles: &Mutex<Profiles>,
    ) -> Result<(), CorrelationError> {
        for &member in members {
            let dof = distributions[member].drawn_dof();
            if !(dof > 2.0 && distributions[member].standard_deviation().is_finite()) {
                return Err(CorrelationError::NoVariance { member, dof });
            }
            if !distributions[member].has_quantiles() {
                return Err(CorrelationError::NoQuantiles { member });
            }
        }
        let decimals = decimals::decimals(members, active, distributions);
        let mut wanted = self.possible(members, active, decimals)?;
        let mut shaped: Vec<Option<Arc<Profiled>>> = vec![None; members.len()];
        let mut drawn: Vec<Member> = members.iter().map(|&m| Member::plain(m)).collect();
        if members.iter().any(|&m| !distributions[m].is_drawn_normal()) {
            for (shaped, member) in shaped.iter_mut().zip(&mut drawn) {
                let shape = Standard::of(&distributions[member.index]);
                let mut profiles = profiles.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some(profiled) = profiles.of(&shape) {
                    let table = Arc::clone(&profiled.table);
                    member.shape = MemberShape::Tabulated(shape, table);
                    *shaped = Some(profiled);
                }
            }
            let fit = fit::Fit { members, distributions, profiles: &shaped, decimals };
            let fit::Fitted { normals, adjusted, changes } = fit.fit(&wanted)?;
            wanted = normals;
            self.adjusted = self.adjusted.max(adjusted);
            Arc::make_mut(&mut self.changes).extend(changes);
            self.copula.extend(members);
        }
        self.groups.push(JointGroup::new(drawn, &wanted, None));
        Ok(())
    }

    /// The joint draw for an evaluation without trials, for quantities that cannot be drawn with
    /// these coefficients: the law of propagation needs only their standard uncertainties (JCGM
    /// 100, 5.2.2).
    ///
    /// # Errors
    /// Impossible coefficients, or too many of them.
    fn of_propagation(
        distributions: &[Arc<Distribution>],
        correlations: &[Correlation],
    ) -> Result<Self, CorrelationError> {
        let active = active(distributions, correlations);
        let mut joint = Self { undrawn: true, ..Self::default() };
        for members in connected(&active) {
            let decimals = decimals::decimals(&members, &active, distributions);
            joint.possible(&members, &active, decimals)?;
        }
        Ok(joint)
    }

    /// The coefficients of a group, or the nearest possible ones within their rounding, with a
    /// flag.
    fn possible(
        &mut self,
        members: &[usize],
        active: &[Correlation],
        decimals: usize,
    ) -> Result<CorrelationMatrix, CorrelationError> {
        let count = members.len();
        if count > MOST_LINKED {
            return Err(CorrelationError::TooMany { count, most: MOST_LINKED });
        }
        let declared = coefficients(members, active);
        if declared.is_semidefinite() {
            return Ok(declared);
        }
        let nearest = declared.nearest();
        if !contradiction::is_rounding(&declared, &nearest, decimals) {
            return Err(contradiction::contradiction(members, &declared, &nearest, decimals));
        }
        self.rounded = true;
        Ok(nearest)
    }

    /// The sets of outputs of saved results that are drawn together.
    pub(crate) fn rank_samples(&self) -> &[RankSample] {
        &self.rank_samples
    }
}

/// The coefficients that have an effect: not 0, and between quantities with an uncertainty.
fn active<'c>(
    distributions: &[Arc<Distribution>],
    correlations: &'c [Correlation],
) -> Cow<'c, [Correlation]> {
    let varies = |q: usize| distributions.get(q).is_some_and(|d| d.constant().is_none());
    let says = |c: &Correlation| c.coefficient != 0.0 && varies(c.first) && varies(c.second);
    if correlations.iter().all(says) {
        return Cow::Borrowed(correlations);
    }
    Cow::Owned(correlations.iter().copied().filter(says).collect())
}

/// The matrix of the coefficients among `members`, which are in order.
fn coefficients(members: &[usize], correlations: &[Correlation]) -> CorrelationMatrix {
    let mut matrix = CorrelationMatrix::identity(members.len());
    let index = |quantity: usize| members.binary_search(&quantity).ok();
    for c in correlations {
        if let (Some(i), Some(j)) = (index(c.first), index(c.second)) {
            matrix.set(i, j, c.coefficient);
        }
    }
    matrix
}
