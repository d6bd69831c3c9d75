//! Whether the interval of the law of propagation agrees with that of the trials, apart from few
//! degrees of freedom.
//!
//! With few readings the two methods differ although the model is linear: trials draw a t
//! distribution, whose standard deviation is larger than s/sqrt(n) (JCGM 101, 6.4.9), and the law of
//! propagation allows for the same lack of knowledge in k (JCGM 100, G.4). Both are sound. The law
//! of propagation is wrong where a distribution is not normal or the model is not linear. To tell
//! the two causes apart, the quantities are drawn again as if their standard uncertainties were
//! known exactly, and compared with the interval of the law of propagation for that case.

use std::sync::Arc;

use super::Control;
use super::exact::Noiseless;
use super::gum::Gum;
use super::monte_carlo::{self, MonteCarlo, Request};
use crate::distribution::{Correlation, Distribution, Fits, paired};
use crate::regression::Regression;
use crate::task::{Row, Settings, Task, Trials};

/// How far the interval of the law of propagation lies from that of the trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// The largest difference of an endpoint, relative to the expanded uncertainty.
    pub difference: f64,
    /// Its numerical standard error.
    pub error: f64,
    /// Whether quantities with finite degrees of freedom were drawn with infinite ones.
    pub at_infinite_dof: bool,
}

/// Why the two coverage intervals of an output differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DifferenceCause {
    /// Few degrees of freedom of the inputs: with infinite ones the intervals agree.
    DegreesOfFreedom,
    /// The shape of a distribution, or a model that is not linear.
    Shape,
}

impl DifferenceCause {
    /// The name that answers use.
    pub fn name(self) -> &'static str {
        match self {
            Self::DegreesOfFreedom => "degrees-of-freedom",
            Self::Shape => "shape",
        }
    }
}

impl Agreement {
    /// The comparison with the trials of an output without finite degrees of freedom, or with its
    /// results without noise; `None` without an interval of the law of propagation.
    pub(super) fn as_drawn(
        gum: &Gum,
        trials: &MonteCarlo,
        noiseless: Option<&Noiseless>,
        settings: &Settings,
    ) -> Option<Self> {
        let (ends, errors) = match noiseless {
            Some(noiseless) => (noiseless.symmetric_interval, [0.0; 2]),
            None => (trials.symmetric_interval, trials.errors.symmetric_interval),
        };
        Self::between(gum, settings, ends, errors)
    }

    /// The comparison with trials whose quantities all have infinite degrees of freedom.
    fn at_infinite_dof(gum: &Gum, trials: &MonteCarlo, settings: &Settings) -> Option<Self> {
        let (ends, errors) = (trials.symmetric_interval, trials.errors.symmetric_interval);
        let found = Self::between(gum, settings, ends, errors)?;
        Some(Self { at_infinite_dof: true, ..found })
    }

    fn between(gum: &Gum, settings: &Settings, ends: [f64; 2], errors: [f64; 2]) -> Option<Self> {
        let expanded = settings.coverage.normal_factor() * gum.standard_uncertainty;
        let linear = [gum.estimate - expanded, gum.estimate + expanded];
        let differences = linear.iter().zip(ends).map(|(linear, end)| (linear - end).abs());
        let relative = |value: f64| value / expanded;
        (expanded > 0.0).then(|| Self {
            difference: relative(differences.fold(0.0, f64::max)),
            error: relative(errors.into_iter().fold(0.0, f64::max)),
            at_infinite_dof: false,
        })
    }

    /// Why clause 8 does not validate the interval of the law of propagation, given the difference
    /// that is allowed.
    pub fn cause(&self, allowed: f64) -> DifferenceCause {
        match self.at_infinite_dof && self.is_within(allowed) {
            true => DifferenceCause::DegreesOfFreedom,
            false => DifferenceCause::Shape,
        }
    }

    /// Whether the difference is at most a share of the expanded uncertainty.
    pub fn is_within(&self, share: f64) -> bool {
        self.difference <= share
    }
}

/// Trials of the first comparison, and the most of all: fourfold each time, while the numerical
/// standard error leaves it open on which side of the tolerance a difference lies. The relative
/// error of an endpoint is about 0.4 % with the first number, 0.07 % with the last.
const FIRST: u64 = 1 << 17;
const MOST: u64 = FIRST << 5;

/// Numerical standard errors between a difference and the tolerance, at least.
const BEYOND: f64 = 4.0;

/// For each output the comparison with trials whose quantities have infinite degrees of freedom;
/// `None` where the row has no finite degrees of freedom, or where those trials do not exist.
pub(super) fn at_infinite_dof(
    task: &Task,
    row: &Row,
    estimates: &[f64],
    gums: &[Option<&Gum>],
    control: &Control<'_>,
) -> Option<Vec<Option<Agreement>>> {
    let (row, correlations) = with_infinite_dof(task, row)?;
    let joint = Fits::default().joint(&row.distributions, &correlations).ok()?;
    let settings = &task.settings;
    let mut trials = monte_carlo::RowTrials::new(task, &row, estimates, &joint);
    let control = Control { progress: None, ..*control };
    let probability = settings.coverage.probability();
    let most = match settings.trials {
        Trials::Fixed(asked) => asked.clamp(FIRST, MOST),
        Trials::Adaptive => MOST,
    };
    let mut count = FIRST;
    loop {
        let request = Request { trials: count, probability, moment_order: &[] };
        let finished = monte_carlo::run(&mut trials, request, &control);
        if finished.stopped || finished.trials == 0 {
            return None;
        }
        let found: Vec<Option<Agreement>> = gums
            .iter()
            .zip(&finished.outputs)
            .map(|(gum, trials)| Agreement::at_infinite_dof((*gum)?, trials, settings))
            .collect();
        let is_open = |found: &Agreement| {
            let apart = (found.difference - settings.statement_tolerance).abs();
            apart < BEYOND * found.error
        };
        if 4 * count > most || !found.iter().flatten().any(is_open) {
            return Some(found);
        }
        count *= 4;
    }
}

/// The row with quantities of infinite degrees of freedom, and the correlation coefficients that
/// their joint distributions had; `None` if nothing in it has finite ones.
fn with_infinite_dof(task: &Task, row: &Row) -> Option<(Row, Vec<Correlation>)> {
    let mut correlations = task.correlations.clone();
    // paired readings become normal quantities with the coefficients of the sample
    for ensemble in paired::ensembles(&row.distributions) {
        let is_readings = |member: &usize| {
            matches!(row.distributions.get(*member).map(|d| &**d), Some(Distribution::Readings(_)))
        };
        if ensemble.members.iter().all(is_readings) {
            correlations.extend(ensemble.correlations());
        }
    }
    let mut changed = false;
    // all parameters of a fit keep one fit in common
    let mut fits: Vec<(Arc<Regression>, Arc<Regression>)> = Vec::new();
    let distributions = row.distributions.iter().map(|distribution| {
        let found = match &**distribution {
            Distribution::Fitted(fitted) => {
                let known = fits.iter().find(|(of, _)| Arc::ptr_eq(of, fitted.fit()));
                let exact = match known {
                    Some((_, exact)) => Some(Arc::clone(exact)),
                    None => fitted.fit().with_infinite_dof().map(Arc::new),
                };
                exact.map(|exact| {
                    fits.push((Arc::clone(fitted.fit()), Arc::clone(&exact)));
                    Distribution::from(fitted.of_fit(&exact))
                })
            }
            other => other.with_infinite_dof(),
        };
        changed |= found.is_some();
        found.map_or_else(|| Arc::clone(distribution), Arc::new)
    });
    let distributions: Arc<[Arc<Distribution>]> = distributions.collect();
    changed.then(|| (Row { distributions, conditions: row.conditions.clone() }, correlations))
}
