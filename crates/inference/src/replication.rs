//! Effects whose size each device (or day, or whatever groups the rows) has of its own.
//!
//! Beside every effect of the list stands one whose first parameter differs between the groups: a mean
//! with the prior of the list, and for each group a departure from it, normal with a standard deviation
//! that is unknown itself (a hierarchical size, Gelman et al., Bayesian Data Analysis, chapter 5). It is
//! written with departures of unit variance, which keeps the posterior free of funnels.

use crate::{Candidate, Case, Effect};
use gumption_engine::distribution::{Distribution, LogUniform, Normal};
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::Formula;
use gumption_engine::number::{ascending, largest_first};
use gumption_units::Unit;

/// The standard deviation between groups is log-uniform between these shares of that of the
/// parameter's prior.
const SPREADS: [f64; 2] = [0.03, 1.0];

/// The same of the logarithm of a parameter whose prior is log-uniform.
const LN_SPREADS: [f64; 2] = [0.02, 1.0];

/// Groups of rows, at most.
pub const MOST_GROUPS: usize = 8;

/// Which rows belong together, and the effects that differ between the groups.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Replication {
    /// Place of the condition that tells the groups apart.
    pub condition: usize,
    /// Its values, in order.
    pub groups: Vec<f64>,
    /// The effects that differ between the groups.
    pub effects: Vec<OwnSizes>,
}

/// A candidate whose first parameter each group has of its own, beside the one that all share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnSizes {
    /// Place of the candidate whose parameter all groups share.
    pub shared: usize,
    /// Place of that with a parameter for each group.
    pub own: usize,
    /// Whether the groups differ by ratios and not by differences.
    pub by_ratios: bool,
}

impl Case {
    /// The case with an effect of each group's own size beside every candidate; groups are rows with
    /// the same value of a condition. Effects whose first parameter is of a scale with a zero of its
    /// own, or has a prior without a standard deviation, are shared only.
    #[must_use]
    pub fn replicated(mut self, condition: usize) -> Self {
        let value = |row: &gumption_engine::task::Row| row.conditions.get(condition).copied();
        let mut groups: Vec<f64> = self.task.rows.iter().filter_map(value).collect();
        ascending(&mut groups);
        groups.dedup();
        let Some(name) =
            self.model.conditions.get(condition).map(|condition| condition.name.clone())
        else {
            return self;
        };
        let mut effects = Vec::new();
        let count =
            if (2..=MOST_GROUPS).contains(&groups.len()) { self.candidates.len() } else { 0 };
        let unit = &self.model.conditions[condition].unit;
        let values: Vec<f64> = groups.iter().map(|group| unit.to_si(*group)).collect();
        for shared in 0..count {
            if let Some((candidate, by_ratios)) = of_each(&self.candidates[shared], &name, &values)
            {
                let own = self.candidates.len();
                self.candidates.push(candidate);
                effects.push(OwnSizes { shared, own, by_ratios });
            }
        }
        self.replication = Some(Replication { condition, groups, effects });
        self
    }

    /// The name that the list has for a candidate: that of the shared effect for one of each group's
    /// own size.
    pub fn listed_name<'n>(&'n self, name: &'n str) -> &'n str {
        let own = self.replication.as_ref().map_or(&[][..], |replication| &replication.effects);
        let named = |place: usize| {
            self.candidates.get(place).map(|candidate| candidate.effect.name.as_str())
        };
        let found = own.iter().find(|replicated| named(replicated.own) == Some(name));
        found.and_then(|replicated| named(replicated.shared)).unwrap_or(name)
    }

    /// How many of a candidate's parameters the list has: not what differs between groups.
    pub fn listed_parameters(&self, place: usize) -> usize {
        let own = self.replication.as_ref().map_or(&[][..], |replication| &replication.effects);
        let shared = own
            .iter()
            .find(|replicated| replicated.own == place)
            .map_or(place, |replicated| replicated.shared);
        self.candidates.get(shared).map_or(0, |candidate| candidate.priors.len())
    }

    /// The pairs of candidates that may act together: at most one of each group's own size, and not
    /// beside the same effect that all groups share.
    pub fn pairs(&self) -> Vec<Vec<usize>> {
        let own = self.replication.as_ref().map_or(&[][..], |replication| &replication.effects);
        let is_own = |place: usize| own.iter().any(|replicated| replicated.own == place);
        let same = |a: usize, b: usize| {
            own.iter().any(|replicated| replicated.shared == a && replicated.own == b)
        };
        let count = self.candidates.len();
        (0..count)
            .flat_map(|a| (a + 1..count).map(move |b| (a, b)))
            .filter(|&(a, b)| !(same(a, b) || is_own(a) && is_own(b)))
            .map(|(a, b)| vec![a, b])
            .collect()
    }
}

/// The candidate with a size for each group: its name, its parameters and formulas.
fn of_each(candidate: &Candidate, group: &str, values: &[f64]) -> Option<(Candidate, bool)> {
    let (parameter, prior) = (candidate.effect.parameters.first()?, candidate.priors.first()?);
    let by_ratios = matches!(prior, Distribution::LogUniform(_));
    if parameter.unit.to_si(0.0) != 0.0 || candidate.simulator.is_some() {
        return None;
    }
    let deviation = prior.standard_deviation();
    let spread = if by_ratios {
        LogUniform::new(LN_SPREADS[0], LN_SPREADS[1])
    } else {
        LogUniform::new(SPREADS[0] * deviation, SPREADS[1] * deviation)
    };
    let (spread, unit_normal) = (spread.ok()?, Normal::new(0.0, 1.0).ok()?);
    // names that nothing else has
    let taken = |name: &str| {
        let effect = &candidate.effect;
        let formulas = effect.overrides.iter().flat_map(|(_, formula)| formula.names());
        effect.parameters.iter().any(|p| p.name == name)
            || formulas.into_iter().any(|(n, _)| n == name)
    };
    let free = |stem: String| {
        let mut name = stem;
        while taken(&name) {
            name.push('_');
        }
        name
    };
    let own = &parameter.name;
    let spread_name = free(format!("{own}_spread"));
    let names: Vec<String> =
        (1..=values.len()).map(|number| free(format!("{own}_z{number}"))).collect();
    let of_group = |(name, value): (&String, &f64)| format!("{name}*({group} == {value:?})");
    let departures: Vec<String> = names.iter().zip(values).map(of_group).collect();
    let departure = format!("{spread_name}*({})", departures.join(" + "));
    let text = if by_ratios {
        format!("({own}*exp({departure}))")
    } else {
        format!("({own} + {departure})")
    };
    let overrides: Option<Vec<(String, Formula)>> = candidate
        .effect
        .overrides
        .iter()
        .map(|(name, formula)| {
            let mut changed = formula.text().to_owned();
            let mut places: Vec<_> = formula.names().filter(|(used, _)| used == own).collect();
            largest_first(&mut places, |(_, place)| place.start as f64);
            places.dedup();
            for (_, place) in places {
                changed.replace_range(place, &text);
            }
            Some((name.clone(), Formula::parse(&changed).ok()?))
        })
        .collect();
    let one = |(name, value): (&String, &f64)| Quantity {
        name: name.clone(),
        unit: Unit::one(),
        about: format!("departure where {group} is {value}, in spreads"),
    };
    let unit = if by_ratios { Unit::one() } else { parameter.unit.clone() };
    let about = format!("standard deviation of {own} between the values of {group}");
    let mut parameters = candidate.effect.parameters.clone();
    parameters.push(Quantity { name: spread_name, unit, about });
    parameters.extend(names.iter().zip(values).map(one));
    let mut priors = candidate.priors.clone();
    priors.push(spread.into());
    priors.extend(names.iter().map(|_| Distribution::from(unit_normal)));
    let effect = Effect {
        name: format!("{} (own of each {group})", candidate.effect.name),
        parameters,
        overrides: overrides?,
    };
    let about = format!("{} Its {own} differs between the values of {group}.", candidate.about);
    let about = about.trim_start().to_owned();
    Some((
        Candidate { effect, priors, about, source: candidate.source.clone(), simulator: None },
        by_ratios,
    ))
}
