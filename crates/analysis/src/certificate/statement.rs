//! What a certificate states of one result.

use super::rounding;
use crate::certificate::contents::Rounding;
use gumption_engine::decimal::{Decimal, Direction, to_position};
use gumption_engine::model::Capability;
use gumption_engine::propagate::Noiseless;
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::special;
use gumption_engine::task::{Coverage, Settings};

/// What a stated expanded uncertainty rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// A normal distribution (EA-4/02, 5.1).
    Normal,
    /// A t distribution with the effective degrees of freedom (EA-4/02, 5.3 and annex E).
    Student,
    /// A coverage factor that the file fixes, whatever the degrees of freedom.
    Fixed,
    /// The shortest coverage interval of the Monte Carlo trials, because the distribution is not
    /// normal (JCGM 101, clause 8 fails) or the law of propagation gives no interval.
    Shortest,
}

impl Basis {
    /// The name that answers use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Student => "t",
            Self::Fixed => "fixed-factor",
            Self::Shortest => "monte-carlo",
        }
    }
}

/// A stated expanded uncertainty beside the laboratory's capability (ILAC-P14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The capability (CMC) at the value.
    pub cmc: f64,
    /// Whether the evaluated expanded uncertainty is below it.
    pub below: bool,
    /// Whether the stated one was raised to it.
    pub raised: bool,
}

/// What is stated of one result, in the unit of the output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statement {
    /// What it rests on.
    pub basis: Basis,
    /// The value: the estimate by the law of propagation, or of the trials where the statement
    /// rests on them.
    pub value: f64,
    /// Its standard uncertainty; the capability over the coverage factor if it was raised to that.
    pub standard_uncertainty: f64,
    /// The expanded uncertainty that is stated: k u, or the capability if it was raised. Where the
    /// statement rests on the trials it is the distance of the value from the farther end of the
    /// interval.
    pub expanded_uncertainty: f64,
    /// The coverage factor: the expanded uncertainty over the standard uncertainty; that of a normal
    /// distribution if it was raised to the capability.
    pub coverage_factor: f64,
    /// Effective degrees of freedom; undefined where there is no evaluation by the law of
    /// propagation.
    pub dof: Dof,
    /// The coverage probability; `None` where a coverage factor is fixed and says nothing of it.
    pub coverage_probability: Option<f64>,
    /// The shortest coverage interval, where the statement rests on it.
    pub interval: Option<[f64; 2]>,
    /// Whether that interval is from figures without the noise of trials.
    pub without_trials: bool,
    /// The laboratory's capability, where it is known.
    pub limit: Option<Limit>,
    /// The expanded uncertainty to the digits of the certificate; `None` if it is 0.
    pub rounded: Option<Decimal>,
}

impl Statement {
    /// The value to the last digit of the rounded expanded uncertainty; `None` where that is 0.
    pub fn rounded_value(&self) -> Option<Decimal> {
        Some(Decimal::shortest(self.value)?.round(self.rounded?.position(), Direction::Nearest))
    }

    /// The ends of the interval to the same digit: to the nearest, or outwards where expanded
    /// uncertainties are always rounded up. `None` where there is no interval, or no such digit.
    pub fn rounded_interval(&self, rule: Rounding) -> Option<[Decimal; 2]> {
        let position = self.rounded?.position();
        let [low, high] = self.interval?.map(Decimal::shortest);
        let [down, up] = match rule {
            Rounding::Up => [Direction::Down, Direction::Up],
            Rounding::Nearest | Rounding::Ea => [Direction::Nearest; 2],
        };
        Some([low?.round(position, down), high?.round(position, up)])
    }
}

/// What a certificate asks of every statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted<'a> {
    pub(super) settings: &'a Settings,
    pub(super) rounding: Rounding,
    pub(super) digits: u32,
}

/// The figures before capability and rounding.
struct Found {
    basis: Basis,
    value: f64,
    standard_uncertainty: f64,
    expanded_uncertainty: f64,
    coverage_factor: f64,
    interval: Option<[f64; 2]>,
    without_trials: bool,
}

impl Found {
    /// Whether another's interval is the same to the digits of the certificate, and not by rounding
    /// alone: a coverage factor of 2 and the words "normally distributed" stand beside the digits.
    fn states_as(&self, other: &Self, wanted: Wanted<'_>) -> bool {
        if (other.coverage_factor / self.coverage_factor - 1.0).abs() > ROUNDED_AWAY {
            return false;
        }
        let Wanted { digits, rounding, .. } = wanted;
        let Some(to) = rounding::expanded(self.expanded_uncertainty, digits, rounding) else {
            return false;
        };
        let own = [self.value - self.expanded_uncertainty, self.value + self.expanded_uncertainty];
        let ends = |ends: [f64; 2]| ends.map(|end| to_position(end, to.position()));
        other.interval.is_some_and(|interval| ends(interval) == ends(own))
    }
}

/// The statement of an output; `None` where there is no expanded uncertainty to be stated.
pub(super) fn of(
    output: &OutputEvaluation,
    capability: Option<&Capability>,
    wanted: Wanted<'_>,
) -> Option<Statement> {
    let Wanted { settings, .. } = wanted;
    let noiseless = output.noiseless.as_ref().and_then(|found| found.as_deref().ok());
    let refuted = match (output.validation, noiseless, output.gum.as_ref().and_then(Gum::interval))
    {
        (Some(validation), Some(noiseless), Some(interval)) => {
            let ends = interval.iter().zip(noiseless.symmetric_interval);
            ends.into_iter().any(|(gum, end)| (gum - end).abs() > validation.tolerance)
        }
        (validation, ..) => validation.is_some_and(|v| v.gum_valid == Some(false)),
    };
    let linear = || by_propagation(output.gum.as_ref()?, settings);
    // figures without the noise of trials, so that no digit depends on a seed
    let trials = || {
        let gum = output.gum.as_ref();
        let noiseless = noiseless.and_then(|noiseless| without_noise(noiseless, gum));
        noiseless.or_else(|| by_trials(output.monte_carlo.as_ref()?, gum))
    };
    // a clause 8 that fails is no matter where what is stated would be the same
    let refuted = refuted
        && !linear()
            .zip(trials())
            .is_some_and(|(linear, trials)| linear.states_as(&trials, wanted));
    let found = if refuted { trials().or_else(linear) } else { linear().or_else(trials) }?;
    let evaluated = found.expanded_uncertainty;
    let limit = capability.map(|capability| {
        let cmc = capability.at(found.value);
        let below = evaluated < cmc;
        Limit { cmc, below, raised: below && capability.floor }
    });
    let raised = limit.filter(|limit| limit.raised);
    let expanded_uncertainty = raised.map_or(evaluated, |limit| limit.cmc);
    let mut rounded = rounding::expanded(expanded_uncertainty, wanted.digits, wanted.rounding);
    // rounding must not bring below the capability what is not below it
    let kept = limit.filter(|limit| limit.raised || !limit.below).map(|limit| limit.cmc);
    if let (Some(to), Some(cmc)) = (rounded, kept)
        && to.value() < cmc
    {
        rounded = rounding::expanded(expanded_uncertainty, wanted.digits, Rounding::Up);
    }
    // a capability is k standard uncertainties of a normal distribution, whatever was evaluated
    let (basis, coverage_factor, standard_uncertainty) = match raised {
        None => (found.basis, found.coverage_factor, found.standard_uncertainty),
        Some(limit) => {
            let factor = normal_factor(settings.coverage);
            let basis = if found.basis == Basis::Fixed { Basis::Fixed } else { Basis::Normal };
            (basis, factor, limit.cmc / factor)
        }
    };
    Some(Statement {
        basis,
        value: found.value,
        standard_uncertainty,
        expanded_uncertainty,
        coverage_factor,
        dof: output.gum.as_ref().map_or(Dof::Undefined, |gum| gum.dof),
        coverage_probability: (found.basis != Basis::Fixed)
            .then(|| settings.coverage.probability()),
        interval: found.interval,
        without_trials: found.without_trials,
        limit,
        rounded,
    })
}

fn by_propagation(gum: &Gum, settings: &Settings) -> Option<Found> {
    let coverage_factor = gum.coverage_factor?;
    let basis = match (settings.coverage, gum.dof) {
        (Coverage::Factor { fixed: true, .. }, Dof::Finite(_)) | (_, Dof::Undefined) => {
            Basis::Fixed
        }
        (_, Dof::Finite(_)) if !is_normal(coverage_factor, settings.coverage) => Basis::Student,
        _ => Basis::Normal,
    };
    Some(Found {
        basis,
        value: gum.estimate,
        standard_uncertainty: gum.standard_uncertainty,
        expanded_uncertainty: coverage_factor * gum.standard_uncertainty,
        coverage_factor,
        interval: None,
        without_trials: false,
    })
}

/// Whether a coverage factor is printed like that of a normal distribution: to two decimals.
fn is_normal(factor: f64, coverage: Coverage) -> bool {
    to_position(factor, -2) == to_position(normal_factor(coverage), -2)
}

/// The coverage factor of a normal distribution.
fn normal_factor(coverage: Coverage) -> f64 {
    let of_probability = || special::normal::quantile(0.5 + 0.5 * coverage.probability());
    coverage.nominal_factor().unwrap_or_else(of_probability)
}

/// Rounding may change an expanded uncertainty by this share (EA-4/02 M:2022, 6.3).
const ROUNDED_AWAY: f64 = 0.05;

/// A symmetric interval that is longer than the shortest one by less than this share is stated in its
/// place.
const AS_SHORT: f64 = 0.01;

fn without_noise(figures: &Noiseless, gum: Option<&Gum>) -> Option<Found> {
    let length = |[low, high]: [f64; 2]| high - low;
    let symmetric = figures.symmetric_interval;
    let shorter = |ends: &[f64; 2]| length(*ends) < (1.0 - AS_SHORT) * length(symmetric);
    let shortest = figures.shortest_interval.filter(|_| figures.shortest_unique).filter(shorter);
    let ends = shortest.unwrap_or(symmetric);
    let value = figures.estimate.unwrap_or(figures.median);
    let found = by_interval(value, ends, figures.standard_uncertainty, gum)?;
    Some(Found { without_trials: true, ..found })
}

fn by_trials(figures: &MonteCarlo, gum: Option<&Gum>) -> Option<Found> {
    let ends = figures.stated_interval().ends;
    by_interval(located(figures, gum), ends, figures.standard_uncertainty, gum)
}

/// Numerical standard errors within which the mean of the trials is no other than the estimate by the
/// law of propagation.
const SAME_ESTIMATE: f64 = 3.0;

/// Where the value lies by the trials. The estimate by the law of propagation, which no seed moves,
/// stands in its place where the trials do not tell it from theirs.
fn located(figures: &MonteCarlo, gum: Option<&Gum>) -> f64 {
    let of_propagation =
        gum.map(|gum| gum.estimate).zip(figures.estimate.zip(figures.errors.estimate));
    match of_propagation {
        Some((linear, (mean, error))) if (linear - mean).abs() <= SAME_ESTIMATE * error => linear,
        _ => figures.location(),
    }
}

/// What an interval says; few readings have no variance in trials, and their standard uncertainty is
/// that of the law of propagation.
fn by_interval(
    value: f64,
    [low, high]: [f64; 2],
    standard_uncertainty: Option<f64>,
    gum: Option<&Gum>,
) -> Option<Found> {
    let u = standard_uncertainty.or_else(|| gum.map(|gum| gum.standard_uncertainty))?;
    let expanded_uncertainty = (high - value).max(value - low);
    (u > 0.0 && expanded_uncertainty.is_finite()).then(|| Found {
        basis: Basis::Shortest,
        value,
        standard_uncertainty: u,
        expanded_uncertainty,
        coverage_factor: expanded_uncertainty / u,
        interval: Some([low, high]),
        without_trials: false,
    })
}
