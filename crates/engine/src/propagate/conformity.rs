//! Conformity with tolerance limits (JCGM 106): the probability that the value conforms, the
//! specific risk of the decision, the acceptance limits for a wanted risk, and the global risks of
//! deciding about many items of which a prior distribution is known.

mod global;

pub use global::GlobalRisks;
use global::Inspection;

use super::evaluation::OutputEvaluation;
use super::gum::{Dof, Gum};
use super::monte_carlo::MonteCarlo;
use crate::model::{Output, Tolerance};
use crate::number::elementary;
use crate::special;
use crate::task::{Settings, Trials};

/// How probable it is that an output lies within its tolerance limits, and what is decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conformity {
    /// The limits.
    pub tolerance: Tolerance,
    /// The estimate that is decided about: the mean of the trials, or their median where there is
    /// no mean.
    pub estimate: f64,
    /// The conformance probability (JCGM 106, 7): with a prior that of the posterior distribution
    /// (6.3 and 7.1), otherwise the share of trials within the limits.
    pub probability: f64,
    /// The share of trials within the limits, where the probability takes a prior into account.
    pub without_prior: Option<f64>,
    /// Numerical standard error of the probability.
    pub numerical_standard_error: f64,
    /// The risk of false acceptance that is wanted.
    pub wanted_risk: Option<f64>,
    /// The acceptance limits: the tolerance limits moved inwards by the guard band. `None` if no
    /// value has so small a risk.
    pub acceptance: Option<Tolerance>,
    /// The width w of the guard band (JCGM 106, 8.3); 0 for simple acceptance (8.2).
    pub guard_band: Option<f64>,
    /// Whether the item is accepted: the estimate lies within the acceptance limits.
    pub conforms: bool,
    /// The global risks with these acceptance limits; `None` without a prior, or without a standard
    /// uncertainty.
    pub global: Option<GlobalRisks>,
    /// The standard uncertainty that is stated in place of the evaluated one, with which it was
    /// decided: the laboratory's capability over its coverage factor.
    pub stated_uncertainty: Option<f64>,
}

impl Conformity {
    /// The specific risk of the decision (JCGM 106, 9.3): that the accepted value does not conform,
    /// or that the rejected one does.
    pub fn specific_risk(&self) -> f64 {
        if self.conforms { 1.0 - self.probability } else { self.probability }
    }

    /// The decision about an output from its trials; `None` without a tolerance. The posterior
    /// probability, guard bands and global risks take the measured value to be normally distributed
    /// about the true one, with `u` as standard uncertainty. `linear` are estimate and standard
    /// uncertainty by the law of propagation, where that may be trusted.
    pub fn of(
        output: &Output,
        figures: &MonteCarlo,
        u: Option<f64>,
        linear: Option<(f64, f64)>,
    ) -> Option<Self> {
        let tolerance = output.tolerance?;
        let share = figures.inside;
        let u = figures.standard_uncertainty.or(u).filter(|u| u.is_finite() && *u > 0.0);
        let limits = tolerance.ends();
        let inspection = output.prior.as_deref().zip(u);
        let inspection = inspection.map(|(prior, u)| Inspection::new(prior, u, limits));
        let guard_band = match (output.risk, u, &inspection) {
            (None, ..) => Some(0.0),
            (Some(_), None, _) => None,
            (Some(risk), Some(_), Some(inspection)) => inspection.guard_band(risk),
            (Some(risk), Some(u), None) => guard_band(risk, u, limits),
        };
        let acceptance = guard_band.map(|width| tolerance.narrowed(width));
        let acceptance_ends = acceptance.map(|acceptance| acceptance.ends());
        let estimate = figures.location();
        let global = inspection.as_ref().zip(acceptance_ends).map(|(of, ends)| of.risks(ends));
        let posterior = output.prior.as_deref().zip(u).map(|(prior, spread)| {
            let at = |y: f64, u: f64| Inspection::new(prior, u, limits).conformance(y);
            if let Some((y, u)) = linear.filter(|(_, u)| *u > 0.0) {
                return (at(y, u), 0.0);
            }
            // the trials know both to their numerical standard errors
            let of_y = figures.errors.estimate.unwrap_or(figures.errors.median);
            let of_u = figures.errors.standard_uncertainty.unwrap_or(0.0).min(0.5 * spread);
            let change = |y: f64, u: f64| {
                0.5 * (at(estimate + y, spread + u) - at(estimate - y, spread - u))
            };
            let error = elementary::hypot(change(of_y, 0.0), change(0.0, of_u));
            (at(estimate, spread), error)
        });
        let error = (share * (1.0 - share) / figures.trials as f64).sqrt();
        let (probability, numerical_standard_error) = posterior.unwrap_or((share, error));
        Some(Self {
            tolerance,
            estimate,
            probability,
            without_prior: posterior.map(|_| share),
            numerical_standard_error,
            wanted_risk: output.risk,
            acceptance,
            guard_band,
            conforms: acceptance.is_some_and(|acceptance| acceptance.holds(figures.location())),
            global,
            stated_uncertainty: None,
        })
    }

    /// The decision about an estimate of which a standard uncertainty is stated that is not the
    /// evaluated one, such as a laboratory's capability: the estimate is taken to be normally
    /// distributed with it (JCGM 106, 7.2). `None` without a tolerance or an uncertainty above zero.
    pub fn with_stated(output: &Output, estimate: f64, u: f64) -> Option<Self> {
        let found = Self::about(output, estimate, u, f64::INFINITY)?;
        Some(Self { stated_uncertainty: Some(u), ..found })
    }

    /// The decision about an output with its evaluated uncertainty; `None` without a tolerance.
    pub fn evaluated(
        output: &Output,
        figures: &OutputEvaluation,
        settings: &Settings,
    ) -> Option<Self> {
        let gum = figures.gum.as_ref();
        let of_trials = figures.monte_carlo.as_ref().and_then(|trials| {
            let u = gum.map(|gum| gum.standard_uncertainty);
            let trusted = figures.validation.is_some_and(|v| v.gum_valid != Some(false));
            let linear = gum.filter(|_| trusted);
            let linear = linear.map(|gum| (gum.estimate, gum.standard_uncertainty));
            Self::of(output, trials, u, linear)
        });
        let alone = gum.filter(|_| settings.trials == Trials::Fixed(0));
        of_trials.or_else(|| alone.and_then(|gum| Self::by_propagation(output, gum)))
    }

    /// The decision about an output with the uncertainty that is stated of it: the evaluated one,
    /// or the laboratory's capability that it is raised to (ISO/IEC 17025, 7.8.6).
    pub(super) fn decided(
        output: &Output,
        figures: &OutputEvaluation,
        settings: &Settings,
    ) -> Option<Self> {
        match figures.capability.as_deref().filter(|stated| stated.raised) {
            Some(stated) => {
                let u = stated.expanded_uncertainty / settings.coverage.normal_factor();
                Self::with_stated(output, stated.estimate, u)
            }
            None => Self::evaluated(output, figures, settings),
        }
    }

    /// The decision about an output by the law of propagation alone, where no trials are made: the
    /// output is normally distributed (JCGM 106, 7.2), or as t with its effective degrees of freedom
    /// (JCGM 100, G.3). `None` without a tolerance or an uncertainty above zero.
    pub fn by_propagation(output: &Output, gum: &Gum) -> Option<Self> {
        let dof = match gum.dof {
            Dof::Finite(dof) => dof,
            Dof::Infinite | Dof::Undefined => f64::INFINITY,
        };
        Self::about(output, gum.estimate, gum.standard_uncertainty, dof)
    }

    /// The decision about an estimate about which the output is distributed as t.
    fn about(output: &Output, estimate: f64, u: f64, dof: f64) -> Option<Self> {
        let tolerance = output.tolerance?;
        let limits = tolerance.ends();
        if !(u > 0.0 && u.is_finite()) {
            return None;
        }
        let inspection = output.prior.as_deref().map(|prior| Inspection::new(prior, u, limits));
        let guard_band = match (output.risk, &inspection) {
            (None, _) => Some(0.0),
            (Some(risk), Some(inspection)) => inspection.guard_band(risk),
            (Some(risk), None) => guard_band(risk, u, limits),
        };
        let acceptance = guard_band.map(|width| tolerance.narrowed(width));
        let [lower, upper] = limits.map(|limit| (limit - estimate) / u);
        let share = special::student::cdf(upper, dof) - special::student::cdf(lower, dof);
        let global = inspection.as_ref().zip(acceptance).map(|(of, to)| of.risks(to.ends()));
        Some(Self {
            tolerance,
            estimate,
            probability: inspection.as_ref().map_or(share, |of| of.conformance(estimate)),
            without_prior: inspection.as_ref().map(|_| share),
            numerical_standard_error: 0.0,
            wanted_risk: output.risk,
            acceptance,
            guard_band,
            conforms: acceptance.is_some_and(|acceptance| acceptance.holds(estimate)),
            global,
            stated_uncertainty: None,
        })
    }
}

/// The guard band with which a value measured at an acceptance limit does not conform with at most
/// this probability (JCGM 106, 8.3.2); `None` if the middle of the tolerance has a larger one.
fn guard_band(risk: f64, u: f64, [lower, upper]: [f64; 2]) -> Option<f64> {
    // what lies beyond the near limit and, where there is one, beyond the far one
    let at = |width: f64| {
        special::normal::sf(width / u) + special::normal::sf((upper - lower - width) / u)
    };
    let most = if (upper - lower).is_finite() { 0.5 * (upper - lower) } else { 40.0 * u };
    if at(most) > risk {
        return None;
    }
    Some(smallest(0.0, most, |width| at(width) <= risk))
}

/// The smallest width between two at which something holds, which it does at the larger one and
/// goes on to do.
fn smallest(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    if holds(low) {
        return low;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle
        } else {
            low = middle
        }
        if high - low <= 1e-9 * high {
            break;
        }
    }
    high
}

#[cfg(test)]
mod tests;
