//! What an evaluation gives: figures of its rows and of their outputs, by both methods.

use std::sync::Arc;

use super::agreement::Agreement;
use super::branch::Jump;
use super::conformity::Conformity;
use super::exact::Noiseless;
use super::gum::Gum;
use super::inherited::Inherited;
use super::monte_carlo::{MonteCarlo, Undefined};
use super::region_figures::RegionEvaluation;
use super::second_order::SecondOrder;
use super::validate::Validation;
use crate::decimal::{Decimal, Direction, to_digits};
use crate::distribution::Correlation;
use crate::model::{COMPUTED_DIGITS, Capability};
use crate::task::{Coverage, Settings};

/// The evaluation of a whole task.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Evaluation {
    /// The coverage probability used.
    pub coverage_probability: f64,
    /// The settings used.
    pub settings: Settings,
    /// One entry for each row of conditions.
    pub rows: Vec<RowEvaluation>,
    /// Whether declared correlations were taken as possible only within the rounding of their
    /// coefficients.
    pub rounded_correlations: bool,
    /// The variables that are drawn through a Gaussian copula in some row, in order.
    pub copula: Vec<usize>,
    /// The largest change of a declared coefficient, within its rounding, that a copula needed.
    pub copula_adjusted: f64,
    /// Whether the run was stopped before all trials were made.
    pub stopped: bool,
}

/// The evaluation of one row.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RowEvaluation {
    /// Values of the conditions.
    pub conditions: Vec<f64>,
    /// One entry for each output.
    pub outputs: Vec<OutputEvaluation>,
    /// Correlation coefficients between the outputs i < j: from the trials, or by the law of
    /// propagation if there are none.
    pub correlations: Vec<f64>,
    /// Numerical standard errors of those from the trials; `None` where an output's trials do not
    /// tell them. Empty by the law of propagation, which has none.
    pub correlation_errors: Vec<Option<f64>>,
    /// The coverage regions of several outputs together, as many as the task asks for.
    pub regions: Vec<RegionEvaluation>,
    /// Trials that were left out because an output was not finite.
    pub undefined: Option<Box<Undefined>>,
    /// The variables that are outputs of saved results, drawn as they varied together there.
    pub jointly_drawn: Vec<JointlyDrawn>,
    /// Coefficients that the copula of the trials does not give as they are, and what it gives.
    pub copula_changes: Arc<Vec<(Correlation, f64)>>,
}

/// Variables that are outputs of one saved result and drawn from its trials.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JointlyDrawn {
    /// The variables, in order.
    pub variables: Vec<usize>,
    /// How many trials the result holds.
    pub trials: usize,
}

/// One output by both methods.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct OutputEvaluation {
    /// By the law of propagation; `None` where a sensitivity coefficient is not finite.
    pub gum: Option<Gum>,
    /// By the Monte Carlo method; `None` without trials.
    pub monte_carlo: Option<Box<MonteCarlo>>,
    /// The law of propagation with its terms of second order, where they tell why the two differ, or
    /// what the law leaves out.
    pub second_order: Option<Box<SecondOrder>>,
    /// What the limited trials of saved results among the inputs do to the figures; `None` without such
    /// results. The numerical standard errors of the trials have it in them.
    pub inherited: Option<Box<Inherited>>,
    /// Whether the trials tell that the model is not linear over the uncertainties of its inputs; `None`
    /// without trials or without a law of propagation.
    pub(super) nonlinear: Option<bool>,
    /// How the trials lie on both sides of a cut, where they do.
    pub(super) jump: Option<Box<Jump>>,
    /// Figures without the noise of trials, or why there are none; `None` where none were asked for.
    pub noiseless: Option<Result<Box<Noiseless>, String>>,
    /// Their comparison.
    pub validation: Option<Validation>,
    /// How far their intervals agree apart from few degrees of freedom, on which
    /// [`StatementMethod::Auto`](crate::task::StatementMethod::Auto) decides; `None` where clause 8
    /// validates the interval of the law of propagation, or where there are not both intervals.
    pub agreement: Option<Agreement>,
    /// The laboratory's capability, and what may be stated beside it; `None` if there is none of
    /// either.
    pub capability: Option<Box<CapabilityStatement>>,
    /// The decision about the output's tolerance with the uncertainty that is stated; `None` without
    /// a tolerance, or an uncertainty.
    pub conformity: Option<Box<Conformity>>,
    /// The fewest degrees of freedom among the t distributions that the output depends on.
    pub drawn_dof: f64,
    /// The guard band for the wanted specific risk, by the distribution of the trials, where it was
    /// looked for; `None` inside where no value has so small a risk.
    pub(super) guard_band_of_trials: Option<Option<f64>>,
}

impl OutputEvaluation {
    /// The law of propagation where the trials do not refute it.
    pub(super) fn trusted(&self) -> Option<&Gum> {
        let is_trusted = self.validation.is_some_and(|v| v.gum_valid != Some(false));
        self.gum.as_ref().filter(|_| is_trusted)
    }
}

/// The expanded uncertainty that a laboratory may state beside its capability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapabilityStatement {
    /// The capability (CMC) at the estimate.
    pub cmc: f64,
    /// The estimate.
    pub estimate: f64,
    /// The expanded uncertainty that was evaluated: half of the interval that is stated.
    pub evaluated: f64,
    /// The expanded uncertainty to be stated.
    pub expanded_uncertainty: f64,
    /// Whether the evaluated one is below the capability.
    pub below: bool,
    /// Whether it was raised to the capability.
    pub raised: bool,
}

/// A capability, which is stated for approximately 95 % and the factor 2 (ILAC-P14:09/2020, 4.2), with
/// another coverage: it grows with the factor of a normal distribution.
fn with_coverage(cmc: f64, coverage: Coverage) -> f64 {
    if coverage.is_about_95() {
        return cmc;
    }
    to_digits(0.5 * coverage.normal_factor() * cmc, COMPUTED_DIGITS)
}

/// Significant digits of a capability in words.
const CAPABILITY_DIGITS: u32 = 6;

impl CapabilityStatement {
    /// What may be stated where this expanded uncertainty of this estimate was evaluated, with this
    /// coverage.
    pub fn of(capability: &Capability, estimate: f64, evaluated: f64, coverage: Coverage) -> Self {
        let cmc = with_coverage(capability.at(estimate), coverage);
        let below = to_digits(evaluated, COMPUTED_DIGITS) < cmc;
        let raised = below && capability.floor;
        let expanded_uncertainty = if raised { cmc } else { evaluated };
        Self { cmc, estimate, evaluated, expanded_uncertainty, below, raised }
    }

    /// The capability in words, in the output's unit: with as many digits as one is stated with.
    pub fn cmc_text(&self) -> String {
        crate::decimal::exact(to_digits(self.cmc, CAPABILITY_DIGITS))
    }

    /// The expanded uncertainty to be stated, to so many significant digits: to the nearest, or up where
    /// that would bring below the capability what is not below it. `None` of zero, and of what is not
    /// finite.
    pub fn rounded(&self, digits: u32) -> Option<Decimal> {
        let exact = Decimal::shortest(self.expanded_uncertainty)?;
        let to = |direction| exact.round_to_digits(digits, direction);
        let nearest = to(Direction::Nearest);
        let is_kept = (self.raised || !self.below) && nearest.value() < self.cmc;
        Some(if is_kept { to(Direction::Up) } else { nearest })
            .filter(|_| self.expanded_uncertainty > 0.0)
    }
}

impl RowEvaluation {
    /// The trials that were made, those that were left out included; `None` without trials.
    pub(super) fn made(&self) -> Option<u64> {
        let figures = self.outputs.iter().find_map(|output| output.monte_carlo.as_deref())?;
        let undefined = self.undefined.as_deref().map_or(0, |undefined| undefined.count);
        Some(figures.trials + undefined)
    }
}

/// A difference of two standard uncertainties below this share is not worth a word.
pub(super) const NOTEWORTHY: f64 = 0.01;

/// Rows at most of an evaluation without trials for which terms of second order are computed.
pub(super) const FEW_ROWS: usize = 16;

/// The standard deviation of the standard deviation of so many normal trials (JCGM 100, E.4.3). What
/// few trials tell of it themselves is as uncertain as it is.
pub(super) fn scatter_of_few(u: f64, trials: u64) -> f64 {
    u / (2.0 * (trials as f64 - 1.0).max(0.5)).sqrt()
}
