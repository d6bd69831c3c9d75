//! What is stated of an output: value, expanded uncertainty and coverage factor, by the method that
//! is to be believed.

use super::agreement::DifferenceCause;
use super::exact::Noiseless;
use super::figures::OutputEvaluation;
use super::gum::{Dof, Gum};
use super::monte_carlo::MonteCarlo;
use crate::decimal::to_position;
use crate::task::{Coverage, Settings, StatementMethod};

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

/// Value and expanded uncertainty as they are stated, before capability and rounding, in the unit of
/// the output.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stated {
    /// What they rest on.
    pub basis: Basis,
    /// The value: the estimate by the law of propagation, or the mean of the trials where the statement
    /// rests on them and they have a variance.
    pub value: f64,
    /// Its standard uncertainty.
    pub standard_uncertainty: f64,
    /// The expanded uncertainty: k u, or the distance of the value from the farther end of the
    /// interval.
    pub expanded_uncertainty: f64,
    /// The coverage factor: the expanded uncertainty over the standard uncertainty.
    pub coverage_factor: f64,
    /// The shortest coverage interval, where the statement rests on it.
    pub interval: Option<[f64; 2]>,
    /// Whether that interval is from figures without the noise of trials.
    pub without_trials: bool,
    /// Whether value and standard uncertainty are those of the distribution that trials show, and not
    /// those of the law of propagation.
    pub of_distribution: bool,
}

impl Stated {
    /// What is stated of an output by [`Settings::statement`]; `None` where there is no expanded
    /// uncertainty to be stated.
    pub fn of(output: &OutputEvaluation, settings: &Settings) -> Option<Self> {
        let linear = || by_propagation(output.gum.as_ref()?, settings);
        // figures without the noise of trials, so that no digit depends on a seed
        let trials = || {
            let gum = output.gum.as_ref();
            let noiseless = output.noiseless.as_ref().and_then(|figures| figures.as_deref().ok());
            let noiseless = noiseless.and_then(|noiseless| without_noise(noiseless, gum));
            noiseless.or_else(|| by_trials(output.monte_carlo.as_deref()?, gum))
        };
        let agreed = |stated: Self| match settings.coverage {
            Coverage::Factor { factor, fixed: true } => stated.with_factor(factor),
            _ => stated,
        };
        match settings.statement {
            StatementMethod::Gum => linear(),
            StatementMethod::MonteCarlo => trials().map(agreed),
            // trials on both sides of a cut have no mean and no interval
            StatementMethod::Auto if output.jump.is_some() => {
                linear().or_else(|| trials().map(agreed))
            }
            StatementMethod::Auto if output.agrees(settings.statement_tolerance) => {
                linear().or_else(|| trials().map(agreed))
            }
            // an agreed factor is kept, with the standard uncertainty that a linear model has
            StatementMethod::Auto => match (settings.coverage, output.nonlinear) {
                (Coverage::Factor { fixed: true, .. }, Some(false)) => {
                    linear().or_else(trials).map(agreed)
                }
                _ => trials().or_else(linear).map(agreed),
            },
        }
    }

    /// With an agreed coverage factor, which says nothing of an interval.
    fn with_factor(self, factor: f64) -> Self {
        let expanded_uncertainty = factor * self.standard_uncertainty;
        Self {
            basis: Basis::Fixed,
            expanded_uncertainty,
            coverage_factor: factor,
            interval: None,
            ..self
        }
    }
}

fn by_propagation(gum: &Gum, settings: &Settings) -> Option<Stated> {
    let coverage_factor = gum.coverage_factor?;
    let basis = match (settings.coverage, gum.dof) {
        (Coverage::Factor { fixed: true, .. }, Dof::Finite(_)) | (_, Dof::Undefined) => {
            Basis::Fixed
        }
        (_, Dof::Finite(_)) if !is_normal(coverage_factor, settings.coverage) => Basis::Student,
        _ => Basis::Normal,
    };
    Some(Stated {
        basis,
        value: gum.estimate,
        standard_uncertainty: gum.standard_uncertainty,
        expanded_uncertainty: coverage_factor * gum.standard_uncertainty,
        coverage_factor,
        interval: None,
        without_trials: false,
        of_distribution: false,
    })
}

/// Whether a coverage factor is printed like that of a normal distribution: to two decimals.
fn is_normal(factor: f64, coverage: Coverage) -> bool {
    to_position(factor, -2) == to_position(coverage.normal_factor(), -2)
}

/// A symmetric interval that is longer than the shortest one by less than this share is stated in its
/// place.
const AS_SHORT: f64 = 0.01;

fn without_noise(figures: &Noiseless, gum: Option<&Gum>) -> Option<Stated> {
    let length = |[low, high]: [f64; 2]| high - low;
    let symmetric = figures.symmetric_interval;
    let shorter = |ends: &[f64; 2]| length(*ends) < (1.0 - AS_SHORT) * length(symmetric);
    let shortest = figures.shortest_interval.filter(|_| figures.shortest_unique).filter(shorter);
    let ends = shortest.unwrap_or(symmetric);
    let mean = figures.estimate.filter(|_| figures.standard_uncertainty.is_some());
    let value = mean.unwrap_or_else(|| without_mean(gum, figures.median));
    let found = by_interval(value, ends, figures.standard_uncertainty, gum)?;
    Some(Stated { without_trials: true, ..found })
}

fn by_trials(figures: &MonteCarlo, gum: Option<&Gum>) -> Option<Stated> {
    let ends = figures.stated_interval().ends;
    let (value, _) = located(figures, gum);
    by_interval(value, ends, figures.standard_uncertainty, gum)
}

/// Numerical standard errors within which the mean of the trials is no other than the estimate by the
/// law of propagation: normal scatter is so far out once in 500 million times.
const SAME_ESTIMATE: f64 = 6.0;

impl OutputEvaluation {
    /// Whether the interval of the law of propagation agrees with that of the trials within a share
    /// of the expanded uncertainty, apart from few degrees of freedom. Where nothing was compared it
    /// is believed.
    pub fn agrees(&self, share: f64) -> bool {
        let is_refuted = self.validation.is_some_and(|v| v.gum_valid != Some(true));
        !is_refuted || self.agreement.is_some_and(|agreement| agreement.is_within(share))
    }

    /// Why clause 8 does not validate the interval of the law of propagation, given the difference
    /// that is allowed, relative to the expanded uncertainty; `None` where it does or is undecided,
    /// or where nothing was compared.
    pub fn difference_cause(&self, allowed: f64) -> Option<DifferenceCause> {
        let is_refuted = self.validation.is_some_and(|v| v.gum_valid == Some(false));
        Some(self.agreement.filter(|_| is_refuted)?.cause(allowed))
    }

    /// Where the output lies by its trials, and the numerical standard error of that (0 of what no seed
    /// moves), in the unit of the output; `None` without trials. It is the mean of the trials where they
    /// have a variance and it is told from the estimate by the law of propagation, and otherwise that
    /// estimate, or without it the median.
    pub fn located(&self) -> Option<(f64, f64)> {
        self.monte_carlo.as_deref().map(|figures| located(figures, self.gum.as_ref()))
    }
}

/// Where an output lies by its trials, and the numerical standard error of that: at their mean where they
/// have a variance. The estimate by the law of propagation, which no seed moves, stands in its place where
/// the trials do not tell it from theirs, and where they have no variance or no mean; without a law of
/// propagation their median.
pub(super) fn located(figures: &MonteCarlo, gum: Option<&Gum>) -> (f64, f64) {
    let Some(mean) = figures.settled_mean() else {
        let error = if gum.is_some() { 0.0 } else { figures.errors.median };
        return (without_mean(gum, figures.median), error);
    };
    let error = figures.errors.estimate.unwrap_or(f64::NAN);
    let same = gum.filter(|gum| (gum.estimate - mean).abs() <= SAME_ESTIMATE * error);
    (same.map_or(mean, |gum| gum.estimate), error)
}

/// Where an output without a mean lies.
fn without_mean(gum: Option<&Gum>, median: f64) -> f64 {
    gum.map_or(median, |gum| gum.estimate)
}

/// What an interval says; few readings and quotients by what may be zero have no variance in trials,
/// and their standard uncertainty is that of the law of propagation.
fn by_interval(
    value: f64,
    [low, high]: [f64; 2],
    standard_uncertainty: Option<f64>,
    gum: Option<&Gum>,
) -> Option<Stated> {
    let u = standard_uncertainty.or_else(|| gum.map(|gum| gum.standard_uncertainty))?;
    let expanded_uncertainty = (high - value).max(value - low);
    (u > 0.0 && expanded_uncertainty.is_finite()).then(|| Stated {
        basis: Basis::Shortest,
        value,
        standard_uncertainty: u,
        expanded_uncertainty,
        coverage_factor: expanded_uncertainty / u,
        interval: Some([low, high]),
        without_trials: false,
        of_distribution: true,
    })
}
