//! The joint distribution of many quantities: which of them are drawn together, and how.
//!
//! - Quantities that declared coefficients link are drawn from joint standard normals: normal ones
//!   exactly, all others through a Gaussian copula fitted to their coefficients ([`copula`],
//!   [`profile`]).
//! - Outputs of one saved result are drawn as they varied in its trials ([`together`]), unless a
//!   coefficient links one of them to another quantity.
//! - Paired readings are drawn from a multivariate t distribution ([`paired`]).
//!
//! Contradictory coefficients are refused, never changed: only what lies within the rounding of
//! their last decimals is taken as the nearest possible, and said to be. The same holds where each
//! pair can have its coefficient but the normals behind the copula cannot.

mod copula;
mod error;
mod matrix;
pub(crate) mod paired;
mod profile;
#[cfg(test)]
mod tests;
mod together;

use std::sync::Arc;

use copula::{Margin, Pair};
pub use error::CorrelationError;
use error::unit;
use matrix::Symmetric;
use profile::{Profile, Table};
use together::{Together, together};

use super::{Distribution, Rectangular, Stream, StreamKey, StudentT, normal};
use crate::number::Column;

/// A declared correlation coefficient of two quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// Place of the first quantity.
    pub first: usize,
    /// Place of the second quantity.
    pub second: usize,
    /// The coefficient r, from -1 to 1.
    pub coefficient: f64,
}

/// A quantity of a group.
#[derive(Clone, Debug)]
struct Member {
    place: usize,
    /// The quantity is `location` + `scale` times the group's standard normal or t quantity,
    location: f64,
    scale: f64,
    /// or times what this makes of the standard normal.
    table: Option<Arc<Table>>,
}

impl Member {
    /// A multiple of the group's own quantity.
    fn plain(place: usize, distribution: &Distribution) -> Self {
        let scale = match distribution {
            Distribution::Readings(readings) => readings.drawn_scale(),
            other => other.standard_uncertainty(),
        };
        Self { place, location: distribution.mean(), scale, table: None }
    }
}

/// Quantities that are drawn together.
#[derive(Clone, Debug)]
struct Group {
    members: Vec<Member>,
    /// Lower triangular factor of the correlation matrix, row by row.
    factor: Vec<Vec<f64>>,
    /// Degrees of freedom of a multivariate t distribution; `None` for joint normals.
    dof: Option<f64>,
}

/// A joint draw that rows share, or why there is none.
pub(crate) type Shared = Result<Arc<Joint>, CorrelationError>;

/// How a set of quantities is drawn.
#[derive(Clone, Debug, Default)]
pub(crate) struct Joint {
    groups: Vec<Group>,
    /// Outputs of saved results.
    together: Vec<Together>,
    /// Whether some matrix was positive semi-definite only up to the rounding of its coefficients.
    pub(crate) rounded: bool,
    /// The quantities that are drawn through a Gaussian copula, in order. Normal ones that share a
    /// group with others are among them.
    pub(crate) copula: Vec<usize>,
    /// The largest change of a coefficient, within its rounding, that a copula needed.
    pub(crate) adjusted: f64,
    /// The coefficients that a copula does not give as they are: wanted, and drawn.
    pub(crate) changes: Vec<(Correlation, f64)>,
}

impl Joint {
    /// The joint draw of quantities with these distributions and coefficients.
    #[cfg(test)]
    pub(crate) fn new(
        distributions: &[Distribution],
        correlations: &[Correlation],
    ) -> Result<Self, CorrelationError> {
        Self::with(&mut Profiles::default(), distributions, correlations)
    }

    /// The joint draw of quantities with these distributions and coefficients. Constants take no
    /// part; coefficients of 0 say nothing. `profiles` is kept for the next one.
    fn with(
        profiles: &mut Profiles,
        distributions: &[Distribution],
        correlations: &[Correlation],
    ) -> Result<Self, CorrelationError> {
        let varies = |q: usize| distributions.get(q).is_some_and(|d| d.constant().is_none());
        let active: Vec<Correlation> = correlations
            .iter()
            .copied()
            .filter(|c| c.coefficient != 0.0 && varies(c.first) && varies(c.second))
            .collect();
        let mut joint = Self::default();
        for ensemble in paired::ensembles(distributions) {
            ensemble.check(distributions)?;
            let members = &ensemble.members;
            if let Some(c) =
                active.iter().find(|c| members.contains(&c.first) || members.contains(&c.second))
            {
                let (first, second) = (members.contains(&c.first), members.contains(&c.second));
                let (member, other) = if first { (c.first, c.second) } else { (c.second, c.first) };
                let paired = first && second;
                return Err(CorrelationError::GivenByReadings { member, other, paired });
            }
            joint.groups.push(Group {
                members: members.iter().map(|&m| Member::plain(m, &distributions[m])).collect(),
                factor: ensemble.coefficients.factor(),
                dof: members.first().map(|&m| distributions[m].drawn_dof()),
            });
        }
        let linked = connected(&active);
        joint.together = together(distributions);
        // a link to another quantity takes all of them out
        joint.together.retain(|set| {
            let other = |m: &usize| !set.members.contains(m);
            !linked.iter().any(|ms| ms.iter().any(|m| !other(m)) && ms.iter().any(other))
        });
        for members in linked {
            let inside = |set: &Together| members.iter().all(|m| set.members.contains(m));
            if !joint.together.iter().any(inside) {
                joint.add_correlated(&members, distributions, &active, profiles)?;
            }
        }
        joint.copula.sort_unstable();
        Ok(joint)
    }

    /// The joint draws of rows of distributions. Rows whose linked quantities are the same share
    /// one, as fits take their time.
    pub(crate) fn of_rows<'a>(
        rows: impl Iterator<Item = &'a [Distribution]>,
        correlations: &[Correlation],
    ) -> Vec<Shared> {
        let linked = |row: &'a [Distribution]| -> Vec<&'a Distribution> {
            let declared = correlations.iter().flat_map(|c| [c.first, c.second]);
            let is_paired =
                |d: &&Distribution| matches!(d, Distribution::Readings(r) if r.together() > 1);
            let paired = row.iter().filter(is_paired);
            declared.filter_map(|q| row.get(q)).chain(paired).collect()
        };
        let mut profiles = Profiles::default();
        let mut last: Option<(Vec<&Distribution>, Shared)> = None;
        rows.map(|row| {
            let now = linked(row);
            if let Some((before, joint)) = &last
                && *before == now
            {
                return joint.clone();
            }
            let joint = Self::with(&mut profiles, row, correlations).map(Arc::new);
            last = Some((now, joint.clone()));
            joint
        })
        .collect()
    }

    /// Adds the group of quantities that coefficients link.
    fn add_correlated(
        &mut self,
        members: &[usize],
        distributions: &[Distribution],
        active: &[Correlation],
        profiles: &mut Profiles,
    ) -> Result<(), CorrelationError> {
        for &member in members {
            let dof = distributions[member].drawn_dof();
            if !(dof > 2.0 && distributions[member].standard_deviation().is_finite()) {
                return Err(CorrelationError::NoVariance { member, dof });
            }
        }
        let declared = matrix(members, active);
        let decimals = decimals(members, active, distributions);
        let mut wanted = declared.clone();
        if !declared.is_semidefinite() {
            wanted = declared.nearest_correlation();
            if !is_rounding(&declared, &wanted, decimals) {
                return Err(contradiction(members, &declared, &wanted, decimals));
            }
            self.rounded = true;
        }
        let mut shaped: Vec<Option<Arc<Profiled>>> = vec![None; members.len()];
        let mut drawn: Vec<Member> =
            members.iter().map(|&m| Member::plain(m, &distributions[m])).collect();
        if members.iter().any(|&m| !distributions[m].is_drawn_normal()) {
            for (shaped, member) in shaped.iter_mut().zip(&mut drawn) {
                let distribution = &distributions[member.place];
                if !distribution.is_drawn_normal() {
                    let (standard, location, scale) = standard(distribution);
                    let profiled = profiles.of(&standard);
                    let table = Some(Arc::clone(&profiled.table));
                    *member = Member { place: member.place, location, scale, table };
                    *shaped = Some(profiled);
                }
            }
            wanted = self.fit(members, distributions, &wanted, &shaped, decimals)?;
            self.copula.extend(members);
        }
        self.groups.push(Group { members: drawn, factor: wanted.factor(), dof: None });
        Ok(())
    }

    /// The coefficients of the normals that give the quantities the wanted ones.
    fn fit(
        &mut self,
        members: &[usize],
        distributions: &[Distribution],
        wanted: &Symmetric,
        profiles: &[Option<Arc<Profiled>>],
        decimals: usize,
    ) -> Result<Symmetric, CorrelationError> {
        let margins: Vec<Margin<'_>> = profiles
            .iter()
            .map(|profiled| profiled.as_ref().map_or(Margin::Normal, |p| p.margin()))
            .collect();
        let n = wanted.size();
        let mut fitted = Symmetric::identity(n);
        let mut pairs = Vec::new();
        for (i, j) in wanted.pairs() {
            let coefficient = wanted.get(i, j);
            if coefficient == 0.0 {
                continue;
            }
            let pair = Pair::new(&margins[i], &margins[j]);
            let mut found = pair.fit(coefficient);
            if found.is_none() && are_linked_results(distributions, members[i], members[j]) {
                // one is a function of the other, and the copula stops at rounding short of it
                let [least, most] = pair.attainable();
                let nearest = coefficient.clamp(least, most);
                let change = (coefficient - nearest).abs();
                if change <= 0.5 * unit(decimals) {
                    self.adjusted = self.adjusted.max(change);
                    let (first, second) = (members[i], members[j]);
                    self.changes.push((Correlation { first, second, coefficient }, nearest));
                    found = pair.fit(nearest);
                }
            }
            let Some(r) = found else {
                let declared = Correlation { first: members[i], second: members[j], coefficient };
                let attainable = pair.attainable();
                return Err(CorrelationError::OutOfReach { declared, attainable });
            };
            fitted.set(i, j, r);
            pairs.push((i, j, pair));
        }
        if fitted.is_semidefinite() {
            return Ok(fitted);
        }
        let repaired = fitted.nearest_correlation();
        let mut drawn = wanted.clone();
        for (i, j) in wanted.pairs() {
            let known = pairs.iter().find(|(a, b, _)| (*a, *b) == (i, j));
            let r = repaired.get(i, j);
            let coefficient = match known {
                Some((_, _, pair)) => pair.of_normals(r),
                None => Pair::new(&margins[i], &margins[j]).of_normals(r),
            };
            drawn.set(i, j, coefficient);
        }
        let change = wanted
            .pairs()
            .map(|(i, j)| (wanted.get(i, j) - drawn.get(i, j)).abs())
            .fold(0.0, f64::max);
        let linked = |i: usize, j: usize| are_linked_results(distributions, members[i], members[j]);
        let of_results = wanted.pairs().all(|(i, j)| wanted.get(i, j) == 0.0 || linked(i, j));
        let most = if of_results { RESULTS } else { 0.5 * unit(decimals) };
        if change > most {
            let nearest = changed(members, wanted, &drawn, decimals);
            return Err(CorrelationError::BeyondCopula {
                members: members.to_vec(),
                nearest,
                decimals,
            });
        }
        self.adjusted = self.adjusted.max(change);
        self.changes.retain(|(c, _)| !members.contains(&c.first));
        self.changes.extend(wanted.pairs().map(|(i, j)| {
            let (first, second) = (members[i], members[j]);
            (Correlation { first, second, coefficient: wanted.get(i, j) }, drawn.get(i, j))
        }));
        Ok(repaired)
    }

    /// The sets of outputs of saved results that are drawn together.
    pub(crate) fn together(&self) -> &[Together] {
        &self.together
    }

    /// The same draw with quantities counted among `kept` only (in order); no group has members
    /// outside it.
    pub(crate) fn restricted(mut self, kept: &[usize]) -> Self {
        let of_groups = self.groups.iter_mut().flat_map(|group| &mut group.members);
        let of_groups = of_groups.map(|member| &mut member.place);
        let of_results = self.together.iter_mut().flat_map(|set| &mut set.members);
        for place in of_groups.chain(of_results) {
            *place = kept.binary_search(place).unwrap_or(*place);
        }
        self
    }
}

/// How far the drawn coefficients of saved results may be from theirs: the copula of dependent
/// outputs need not be Gaussian. The change is told.
const RESULTS: f64 = 0.05;

/// Profiles that are kept at a time.
const MOST_PROFILES: usize = 64;

/// Profiles of the quantities met so far, as equal ones are frequent.
#[derive(Debug, Default)]
struct Profiles(Vec<(Distribution, Arc<Profiled>)>);

/// A profile with its Hermite coefficients, and its table for draws.
#[derive(Debug)]
struct Profiled {
    profile: Profile,
    terms: Vec<f64>,
    table: Arc<Table>,
}

impl Profiles {
    fn of(&mut self, distribution: &Distribution) -> Arc<Profiled> {
        if let Some((_, known)) = self.0.iter().find(|(d, _)| d == distribution) {
            return Arc::clone(known);
        }
        let (profile, table) = Profile::of(distribution);
        let terms = copula::hermite(&profile);
        let profiled = Arc::new(Profiled { profile, terms, table: Arc::new(table) });
        if self.0.len() >= MOST_PROFILES {
            self.0.clear();
        }
        self.0.push((distribution.clone(), Arc::clone(&profiled)));
        profiled
    }
}

impl Profiled {
    fn margin(&self) -> Margin<'_> {
        Margin::Shaped { profile: &self.profile, terms: &self.terms }
    }
}

/// What a distribution is the multiple of, and location and scale: a t or rectangular distribution
/// of the standard one, whose profile serves all rows of a sweep; others of themselves.
fn standard(distribution: &Distribution) -> (Distribution, f64, f64) {
    let dof = distribution.drawn_dof();
    let found = match distribution {
        Distribution::Rectangular(shape) => Rectangular::new(0.0, 1.0)
            .map(|standard| (standard.into(), distribution.mean(), shape.half_width())),
        _ if dof.is_finite() && distribution.saved().is_none() => {
            StudentT::new(0.0, 1.0, dof).map(|standard| {
                let Member { location, scale, .. } = Member::plain(0, distribution);
                (standard.into(), location, scale)
            })
        }
        _ => return (distribution.clone(), 0.0, 1.0),
    };
    found.unwrap_or_else(|_| (distribution.clone(), 0.0, 1.0))
}

/// The decimals that the coefficients of a group are given with: those of the longest, as trailing
/// zeros are often left out, but at least 2, lest a rough 0.9 be taken as anything from 0.85 to
/// 0.95, and at most 6.
/// The coefficients of saved results scatter with their trials; they count as given with 2.
fn decimals(
    members: &[usize],
    correlations: &[Correlation],
    distributions: &[Distribution],
) -> usize {
    let of = |c: &Correlation| {
        let text = c.coefficient.to_string();
        text.split_once('.').map_or(0, |(_, decimals)| decimals.len())
    };
    let inside = correlations.iter().filter(|c| members.contains(&c.first));
    let inside = inside.filter(|c| !are_linked_results(distributions, c.first, c.second));
    inside.map(of).max().unwrap_or(0).clamp(2, 6)
}

/// Whether two quantities are saved results that depend on each other by themselves.
fn are_linked_results(distributions: &[Distribution], first: usize, second: usize) -> bool {
    let saved = |q: usize| distributions.get(q).and_then(Distribution::saved);
    saved(first).zip(saved(second)).is_some_and(|(a, b)| a.is_linked(b))
}

/// Whether a matrix may be a possible one whose coefficients were rounded to so many decimals. Such
/// a one lies at most half a unit of the last decimal away in each coefficient, so the nearest
/// possible one is not farther than that in all of them together.
fn is_rounding(declared: &Symmetric, nearest: &Symmetric, decimals: usize) -> bool {
    let n = declared.size() as f64;
    let farthest = 0.5 * unit(decimals) * (n * (n - 1.0)).sqrt();
    declared.distance(nearest) <= farthest * (1.0 + 1e-6)
}

fn contradiction(
    members: &[usize],
    declared: &Symmetric,
    nearest: &Symmetric,
    decimals: usize,
) -> CorrelationError {
    let offending = offending(declared, 0.5 * unit(decimals));
    let part = declared.part(&offending);
    CorrelationError::Contradiction {
        members: offending.iter().map(|&i| members[i]).collect(),
        eigenvalue: part.lowest_eigenvalue(),
        nearest: changed(members, declared, nearest, decimals),
        decimals,
    }
}

/// The rows that contradict each other: leaving out any further one leaves a possible matrix.
fn offending(matrix: &Symmetric, rounding: f64) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..matrix.size()).collect();
    for row in 0..matrix.size() {
        let without: Vec<usize> = kept.iter().copied().filter(|&k| k != row).collect();
        if without.len() > 1 && matrix.part(&without).lowest_eigenvalue() < -rounding {
            kept = without;
        }
    }
    kept
}

/// The coefficients that differ by half a unit of the last decimal or more.
fn changed(
    members: &[usize],
    from: &Symmetric,
    to: &Symmetric,
    decimals: usize,
) -> Vec<Correlation> {
    let differs = |i: usize, j: usize| (from.get(i, j) - to.get(i, j)).abs() > 0.5 * unit(decimals);
    from.pairs()
        .filter(|&(i, j)| differs(i, j))
        .map(|(i, j)| Correlation {
            first: members[i],
            second: members[j],
            coefficient: to.get(i, j),
        })
        .collect()
}

/// The sets of quantities that coefficients link, each in order.
fn connected(correlations: &[Correlation]) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = Vec::new();
    for c in correlations {
        let (mut joined, rest): (Vec<_>, Vec<_>) = sets
            .into_iter()
            .partition(|set: &Vec<usize>| set.contains(&c.first) || set.contains(&c.second));
        joined.push(vec![c.first, c.second]);
        let mut set: Vec<usize> = joined.concat();
        set.sort_unstable();
        set.dedup();
        sets = rest;
        sets.push(set);
    }
    sets.sort();
    sets
}

fn matrix(members: &[usize], correlations: &[Correlation]) -> Symmetric {
    let mut matrix = Symmetric::identity(members.len());
    let place = |q: usize| members.binary_search(&q).ok();
    for c in correlations {
        if let (Some(i), Some(j)) = (place(c.first), place(c.second)) {
            matrix.set(i, j, c.coefficient);
        }
    }
    matrix
}

/// The running draw of a set of quantities through one block.
#[derive(Debug)]
pub(crate) struct Draws<'a> {
    distributions: &'a [Distribution],
    joint: &'a Joint,
    in_group: Vec<bool>,
    streams: Vec<Stream>,
}

impl<'a> Draws<'a> {
    /// The draws of block `block`; `keys` are the streams of the quantities.
    pub(crate) fn new(
        distributions: &'a [Distribution],
        joint: &'a Joint,
        keys: &[StreamKey],
        block: u64,
    ) -> Self {
        let mut in_group = vec![false; distributions.len()];
        for member in joint.groups.iter().flat_map(|g| &g.members) {
            in_group[member.place] = true;
        }
        for &place in joint.together.iter().flat_map(|set| &set.members) {
            in_group[place] = true;
        }
        let streams = keys.iter().map(|key| key.block(block)).collect();
        Self { distributions, joint, in_group, streams }
    }

    /// Draws the next column of every quantity that is `used`; `register[q]` is where it goes.
    #[inline(always)]
    pub(crate) fn column(&mut self, registers: &mut [Column], register: &[usize], used: &[bool]) {
        for (q, distribution) in self.distributions.iter().enumerate() {
            if used[q] && !self.in_group[q] {
                distribution.draw(&mut self.streams[q], &mut registers[register[q]]);
            }
        }
        for group in &self.joint.groups {
            if group.members.iter().any(|m| used[m.place]) {
                self.group(group, registers, register);
            }
        }
        for set in &self.joint.together {
            if set.members.iter().any(|&m| used[m]) {
                set.draw(self.distributions, &mut self.streams, registers, register);
            }
        }
    }

    /// Standard normals, or a spherical t, mixed by the factor from the last row upwards, so that
    /// every row still finds the columns above it unmixed.
    #[inline(always)]
    fn group(&mut self, group: &Group, registers: &mut [Column], register: &[usize]) {
        if let Some(dof) = group.dof {
            let places = group.members.iter().map(|m| m.place);
            paired::draw_spherical(dof, places, &mut self.streams, registers, register);
        } else {
            for m in &group.members {
                let out = &mut registers[register[m.place]];
                normal::draw(0.0, 1.0, &mut self.streams[m.place], out);
            }
        }
        for (member, row) in group.members.iter().zip(&group.factor).rev() {
            let mut sum = Column::ZERO;
            for (&weight, other) in row.iter().zip(&group.members) {
                let z = &registers[register[other.place]].0;
                for (sum, z) in sum.0.iter_mut().zip(z) {
                    *sum += weight * z;
                }
            }
            let out = &mut registers[register[member.place]].0;
            if let Some(table) = &member.table {
                let z = sum.clone();
                table.values(&z.0, &mut sum.0);
            }
            for (out, sum) in out.iter_mut().zip(&sum.0) {
                *out = member.location + member.scale * sum;
            }
        }
    }
}
