//! The statement of a certificate about one result.

use super::rounding;
use crate::certificate::contents::Rounding;
use gumption_engine::decimal::{Decimal, Direction};
use gumption_engine::model::Capability;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::{Basis, CapabilityStatement, OutputEvaluation, Stated};
use gumption_engine::task::Settings;

/// A stated expanded uncertainty and the laboratory's capability (ILAC-P14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The capability (CMC) at the value.
    pub cmc: f64,
    /// Whether the evaluated expanded uncertainty is below it.
    pub below: bool,
    /// Whether the stated one was raised to it.
    pub raised: bool,
}

/// The statement about one result, in the unit of the output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statement {
    /// What it rests on.
    pub basis: Basis,
    /// The value: the estimate by the law of propagation, or by the trials if the statement is
    /// based on them.
    pub value: f64,
    /// Its standard uncertainty; if raised, the capability divided by the coverage factor.
    pub standard_uncertainty: f64,
    /// The stated expanded uncertainty: k u, or the capability if it was raised. If the statement
    /// is based on the trials, it is the larger distance from the value to an endpoint of the
    /// interval.
    pub expanded_uncertainty: f64,
    /// The coverage factor: the expanded uncertainty divided by the standard uncertainty; the
    /// factor of a normal distribution if it was raised to the capability.
    pub coverage_factor: f64,
    /// Effective degrees of freedom; undefined without an evaluation by the law of propagation.
    pub dof: Dof,
    /// The coverage probability; `None` for a fixed coverage factor, which implies no probability.
    pub coverage_probability: Option<f64>,
    /// The shortest coverage interval, if the statement is based on it.
    pub interval: Option<[f64; 2]>,
    /// Whether that interval is computed without the noise of trials.
    pub without_trials: bool,
    /// Whether value and standard uncertainty come from the distribution of the trials instead of
    /// the law of propagation.
    pub of_distribution: bool,
    /// The laboratory's capability, if it is known.
    pub limit: Option<Limit>,
    /// The expanded uncertainty to the digits of the certificate; `None` if it is 0.
    pub rounded: Option<Decimal>,
}

impl Statement {
    /// The value to the last digit of the rounded expanded uncertainty; `None` if that is 0.
    pub fn rounded_value(&self) -> Option<Decimal> {
        Some(Decimal::shortest(self.value)?.round(self.rounded?.position(), Direction::Nearest))
    }

    /// The endpoints of the interval to the same digit: to the nearest, or outwards if expanded
    /// uncertainties are always rounded up. `None` if there is no interval or no such digit.
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

/// Requirements of a certificate for every statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct StatementRules<'a> {
    pub(super) settings: &'a Settings,
    pub(super) rounding: Rounding,
    pub(super) digits: u32,
}

/// The statement of an output; `None` if there is no expanded uncertainty to state.
pub(super) fn of(
    output: &OutputEvaluation,
    capability: Option<&Capability>,
    wanted: StatementRules<'_>,
) -> Option<Statement> {
    let StatementRules { settings, .. } = wanted;
    let found = Stated::of(output, settings)?;
    let evaluated = found.expanded_uncertainty;
    let limit = capability.map(|capability| {
        let beside = CapabilityStatement::of(capability, found.value, evaluated, settings.coverage);
        Limit { cmc: beside.cmc, below: beside.below, raised: beside.raised }
    });
    let raised = limit.filter(|limit| limit.raised);
    let expanded_uncertainty = raised.map_or(evaluated, |limit| limit.cmc);
    let mut rounded = rounding::expanded(expanded_uncertainty, wanted.digits, wanted.rounding);
    // rounding must not bring a value below the capability that was not below it
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
            let factor = settings.coverage.normal_factor();
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
        of_distribution: found.of_distribution,
        limit,
        rounded,
    })
}
