//! Conformity with tolerance limits (JCGM 106): the probability that the value conforms, the
//! specific risk of the decision, the acceptance limits for a wanted risk, and the global risks of
//! deciding about many items of which a prior distribution is known.

mod error_law;
mod global;
mod level;
mod turns;

pub(super) use error_law::ErrorLaw;
use error_law::StudentLaw;
pub use global::GlobalRisks;
use global::Inspection;
pub use level::ConformityLevel;

use super::figures::OutputEvaluation;
use super::gum::Gum;
use super::monte_carlo::MonteCarlo;
use super::statement::{Stated, located};
use crate::distribution::Distribution;
use crate::model::{GuardRule, Output, Tolerance};
use crate::number::elementary;
use crate::task::{Settings, Trials};

/// How probable it is that an output lies within its tolerance limits, and what is decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conformity {
    /// The limits.
    pub tolerance: Tolerance,
    /// The estimate that is decided about: the value that is stated ([`Stated::value`]). Of an output
    /// that comes round it is on the branch of the limits.
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
    /// The width of the guard band in expanded uncertainties, where that is the rule (ILAC-G8:09/2019,
    /// 4.2.2).
    pub guard_factor: Option<f64>,
    /// The named rule of the guard band, where that is the rule.
    pub guard_rule: Option<GuardRule>,
    /// The expanded uncertainty that is stated beside the estimate; `None` where there is none.
    pub expanded_uncertainty: Option<f64>,
    /// The acceptance limits: the tolerance limits moved inwards by the guard band. `None` if no
    /// value has so small a risk, or the guard band is more than half of the tolerance.
    pub acceptance: Option<Tolerance>,
    /// The width w of the guard band (JCGM 106, 8.3); 0 for simple acceptance (8.2).
    pub guard_band: Option<f64>,
    /// Whether the item is accepted: the estimate lies within the acceptance limits.
    pub conforms: bool,
    /// The statement of four levels, where that is the rule and there is a guard band.
    pub level: Option<ConformityLevel>,
    /// The global risks with these acceptance limits; `None` without a prior, or without a standard
    /// uncertainty.
    pub global: Option<GlobalRisks>,
    /// The standard uncertainty that is stated in place of the evaluated one, with which it was
    /// decided: the laboratory's capability over its coverage factor.
    pub stated_uncertainty: Option<f64>,
}

impl Conformity {
    /// Whether the acceptance limits are not the tolerance's (JCGM 106, 8.3).
    pub fn is_guarded(&self) -> bool {
        self.wanted_risk.is_some() || self.guard_factor.is_some() || self.guard_rule.is_some()
    }

    /// The test uncertainty ratio (ANSI/NCSL Z540.3, 3.11): the tolerance over twice the expanded
    /// uncertainty, which has to be that of approximately 95 %. `None` with one limit alone, or without an
    /// uncertainty.
    pub fn test_uncertainty_ratio(&self) -> Option<f64> {
        let (lower, upper) = self.tolerance.lower.zip(self.tolerance.upper)?;
        let expanded = self.expanded_uncertainty.filter(|expanded| *expanded > 0.0)?;
        Some((upper - lower) / (2.0 * expanded))
    }

    /// Whether the statement is that the value conforms, conditionally or not.
    pub fn states_conformity(&self) -> bool {
        self.level.map_or(self.conforms, ConformityLevel::is_pass)
    }

    /// The specific risk of the decision (JCGM 106, 9.3): that the accepted value does not conform,
    /// or that the rejected one does.
    pub fn specific_risk(&self) -> f64 {
        if self.states_conformity() { 1.0 - self.probability } else { self.probability }
    }

    /// The decision about an output from its trials; `None` without a tolerance. It is made with the
    /// value that is stated of the output, which no seed moves where the law of propagation or figures
    /// without noise have it. The posterior
    /// probability, global risks and guard bands with a prior take the measured value to be distributed
    /// about the true one as the law of propagation says where that may be trusted (`linear`): normal,
    /// or t with its effective degrees of freedom; and otherwise normal, with `u` as standard
    /// uncertainty. The guard band without a prior is that of the same distribution, and otherwise the
    /// one of the trials.
    fn of(
        output: &Output,
        figures: &MonteCarlo,
        gum: Option<&Gum>,
        stated: Option<Stated>,
        linear: Option<&Gum>,
        of_trials: Option<Option<f64>>,
    ) -> Option<Self> {
        let tolerance = output.tolerance?;
        let share = figures.inside;
        let u = figures.standard_uncertainty.or(gum.map(|gum| gum.standard_uncertainty));
        let u = u.filter(|u| u.is_finite() && *u > 0.0);
        let limits = limits_of(output, tolerance);
        let on_branch = |value| turns::at_limits(value, limits, output.period);
        let law = match (linear.filter(|gum| gum.standard_uncertainty > 0.0), u) {
            (Some(gum), _) => Some(StudentLaw::of(gum)),
            (None, Some(u)) => Some(StudentLaw::normal(u)),
            (None, None) => None,
        };
        let inspection = output.prior.as_deref().zip(law);
        let inspection = inspection.map(|(prior, law)| Inspection::new(prior, law, limits));
        let expanded = stated.map(|stated| stated.expanded_uncertainty);
        let guard_band = match (output.risk, u, &inspection) {
            (None, ..) => of_expanded(output, limits, expanded),
            (Some(_), None, _) => None,
            (Some(risk), Some(_), Some(inspection)) => inspection.guard_band(risk),
            (Some(risk), Some(u), None) => match linear {
                Some(gum) => ErrorLaw::of(gum).guard_band(risk, limits),
                None => of_trials.unwrap_or_else(|| ErrorLaw::normal(u).guard_band(risk, limits)),
            },
        };
        let [acceptance, accepted] = [tolerance, Tolerance::between(limits)]
            .map(|limits| guard_band.and_then(|width| limits.narrowed(width)));
        let (located, of_y) = located(figures, gum);
        let located = on_branch(located);
        let estimate = stated.map_or(located, |stated| on_branch(stated.value));
        let global =
            inspection.as_ref().zip(accepted).map(|(inspection, to)| inspection.risks(to.ends()));
        let posterior = output.prior.as_deref().zip(u).map(|(prior, spread)| {
            if let Some((gum, inspection)) = linear.zip(inspection.as_ref()) {
                return (inspection.conformance(on_branch(gum.estimate)), 0.0);
            }
            let at = |y: f64, u: f64| {
                Inspection::new(prior, StudentLaw::normal(u), limits).conformance(y)
            };
            // the trials know both to their numerical standard errors
            let of_u = figures.errors.standard_uncertainty.unwrap_or(0.0).min(0.5 * spread);
            let change =
                |y: f64, u: f64| 0.5 * (at(located + y, spread + u) - at(located - y, spread - u));
            let error = elementary::hypot(change(of_y, 0.0), change(0.0, of_u));
            (at(located, spread), error)
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
            guard_factor: output.guard_factor,
            guard_rule: output.guard_rule,
            expanded_uncertainty: expanded,
            acceptance,
            guard_band,
            conforms: accepted.is_some_and(|accepted| accepted.holds(estimate)),
            level: ConformityLevel::of(output, limits, guard_band, estimate),
            global,
            stated_uncertainty: None,
        })
    }

    /// The decision about an estimate of which a standard uncertainty `u` and an expanded one are stated
    /// that are not the evaluated ones, such as a laboratory's capability: the estimate is taken to be
    /// normally distributed with it (JCGM 106, 7.2). `None` without a tolerance or an uncertainty above
    /// zero.
    pub fn with_stated(output: &Output, estimate: f64, u: f64, expanded: f64) -> Option<Self> {
        let found = Self::about(output, estimate, StudentLaw::normal(u), Some(expanded))?;
        Some(Self { stated_uncertainty: Some(u), ..found })
    }

    /// The decision about an output with its evaluated uncertainty; `None` without a tolerance.
    pub fn evaluated(
        output: &Output,
        figures: &OutputEvaluation,
        settings: &Settings,
    ) -> Option<Self> {
        let gum = figures.gum.as_ref();
        let of_trials = figures.monte_carlo.as_deref().filter(|_| output.tolerance.is_some());
        let of_trials = of_trials.and_then(|trials| {
            let stated = Stated::of(figures, settings);
            let guard_band = figures.guard_band_of_trials;
            Self::of(output, trials, gum, stated, figures.trusted(), guard_band)
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
                let expanded = stated.expanded_uncertainty;
                let u = expanded / settings.coverage.normal_factor();
                Self::with_stated(output, stated.estimate, u, expanded)
            }
            None => Self::evaluated(output, figures, settings),
        }
    }

    /// The decision about an output by the law of propagation alone, where no trials are made: the
    /// output is normally distributed (JCGM 106, 7.2), or as t with its effective degrees of freedom
    /// (JCGM 100, G.3). `None` without a tolerance or an uncertainty above zero.
    pub fn by_propagation(output: &Output, gum: &Gum) -> Option<Self> {
        Self::about(output, gum.estimate, StudentLaw::of(gum), gum.expanded_uncertainty())
    }

    /// The decision about an estimate about which the output is distributed by a law, with the expanded
    /// uncertainty that is stated.
    fn about(
        output: &Output,
        estimate: f64,
        errors: StudentLaw,
        expanded: Option<f64>,
    ) -> Option<Self> {
        let tolerance = output.tolerance?;
        let limits = limits_of(output, tolerance);
        let estimate = turns::at_limits(estimate, limits, output.period);
        if !(errors.scale > 0.0 && errors.scale.is_finite()) {
            return None;
        }
        let law = ErrorLaw::Student(errors);
        let inspection = output.prior.as_deref();
        let inspection = inspection.map(|prior| Inspection::new(prior, errors, limits));
        let guard_band = match (output.risk, &inspection) {
            (None, _) => of_expanded(output, limits, expanded),
            (Some(risk), Some(inspection)) => inspection.guard_band(risk),
            (Some(risk), None) => law.guard_band(risk, limits),
        };
        let [acceptance, accepted] = [tolerance, Tolerance::between(limits)]
            .map(|limits| guard_band.and_then(|width| limits.narrowed(width)));
        let share = turns::share(&law, estimate, limits, output.period);
        let global =
            inspection.as_ref().zip(accepted).map(|(inspection, to)| inspection.risks(to.ends()));
        Some(Self {
            tolerance,
            estimate,
            probability: inspection
                .as_ref()
                .map_or(share, |inspection| inspection.conformance(estimate)),
            without_prior: inspection.as_ref().map(|_| share),
            numerical_standard_error: 0.0,
            wanted_risk: output.risk,
            guard_factor: output.guard_factor,
            guard_rule: output.guard_rule,
            expanded_uncertainty: expanded,
            acceptance,
            guard_band,
            conforms: accepted.is_some_and(|accepted| accepted.holds(estimate)),
            level: ConformityLevel::of(output, limits, guard_band, estimate),
            global,
            stated_uncertainty: None,
        })
    }
}

/// The guard band without a wanted risk: a multiple of the expanded uncertainty, that of a named rule, or
/// none. `None` where there is no expanded uncertainty, or the rule accepts no value.
fn of_expanded(output: &Output, limits: [f64; 2], expanded: Option<f64>) -> Option<f64> {
    match (output.guard_rule, output.guard_factor) {
        (Some(rule), _) => rule.width(0.5 * (limits[1] - limits[0]), expanded?),
        (None, Some(factor)) => Some(factor * expanded?),
        (None, None) => Some(0.0),
    }
}

/// The limits with which a decision is made: those of an output that comes round on the branch of what
/// was known before measuring.
fn limits_of(output: &Output, tolerance: Tolerance) -> [f64; 2] {
    let prior = output.prior.as_deref().map(Distribution::mean);
    turns::at_prior(tolerance.ends(), prior, output.period)
}

/// Doublings of a guard band that are tried where one limit alone is given.
const DOUBLINGS: usize = 200;

/// The smallest guard band at which something holds, which it goes on to do: at most half of the
/// tolerance, and of one limit alone so many scales of the errors. `None` if there is none.
fn smallest_band(tolerance: f64, scale: f64, holds: impl Fn(f64) -> bool) -> Option<f64> {
    let most = if tolerance.is_finite() {
        0.5 * tolerance
    } else {
        let widths = std::iter::successors(Some(scale), |width| Some(2.0 * width));
        widths.take(DOUBLINGS).find(|width| holds(*width))?
    };
    holds(most).then(|| smallest(0.0, most, holds))
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
