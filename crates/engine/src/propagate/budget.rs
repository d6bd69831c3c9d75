//! The lines of an uncertainty budget. They follow from the sensitivity coefficients and from what is
//! known about the inputs, and are computed on request: a sweep of a million rows has millions.

use super::gum::Gum;
use crate::distribution::Distribution;

/// One input's line in the budget.
#[derive(Clone, Debug, PartialEq)]
pub struct BudgetLine {
    /// Index of the variable in the task.
    pub variable: usize,
    /// Estimate x_i in the variable's unit.
    pub estimate: f64,
    /// Standard uncertainty u(x_i) in the variable's unit.
    pub standard_uncertainty: f64,
    /// Name of the distribution.
    pub distribution: &'static str,
    /// What the stated width was divided by to give u(x_i), if the distribution has one width.
    pub divisor: Option<f64>,
    /// Degrees of freedom of u(x_i); infinite unless it was estimated.
    pub dof: f64,
    /// What the trials are drawn from, where that is not `distribution` because the standard
    /// uncertainty has finite degrees of freedom.
    pub drawn_as: Option<&'static str>,
    /// Sensitivity coefficient c_i, output unit per input unit.
    pub sensitivity: f64,
    /// Contribution |c_i| u(x_i) in the output's unit.
    pub contribution: f64,
    /// Share of the combined variance.
    pub share: f64,
}

/// The line of a correlation coefficient in the budget.
#[derive(Clone, Debug, PartialEq)]
pub struct CorrelationLine {
    /// Indices of the two variables.
    pub variables: [usize; 2],
    /// The declared coefficient.
    pub coefficient: f64,
    /// Share 2 c_i c_j u_i u_j r / u^2 of the combined variance; it may be negative.
    pub share: f64,
}

impl Gum {
    /// The budget: one line for each variable that is shown, in order.
    pub fn budget(&self) -> impl Iterator<Item = BudgetLine> + '_ {
        let lines = self.shown().iter().filter_map(|&variable| {
            let sensitivity = *self.sensitivities.get(variable)?;
            Some(BudgetLine::new(variable, self.inputs.get(variable)?, sensitivity))
        });
        lines.map(|line| BudgetLine {
            share: self.share(line.relative(self.largest).powi(2)),
            ..line
        })
    }

    /// One line for each coefficient that is not zero: the declared ones, then one for each pair of
    /// paired readings.
    pub fn correlations(&self) -> impl Iterator<Item = CorrelationLine> + '_ {
        let relative = |variable: usize| {
            let known = self.inputs.get(variable).zip(self.sensitivities.get(variable));
            known.map_or(0.0, |(distribution, &sensitivity)| {
                BudgetLine::new(variable, distribution, sensitivity).relative(self.largest)
            })
        };
        self.links().iter().map(move |c| CorrelationLine {
            variables: [c.first, c.second],
            coefficient: c.coefficient,
            share: self.share(2.0 * relative(c.first) * relative(c.second) * c.coefficient),
        })
    }

    /// Whether there are lines of correlation coefficients.
    pub fn is_correlated(&self) -> bool {
        !self.links().is_empty()
    }

    /// A part of the variance in squares of the largest contribution, as a share.
    fn share(&self, part: f64) -> f64 {
        if self.variance > 0.0 { part / self.variance } else { 0.0 }
    }
}

impl BudgetLine {
    /// The line of a variable, without its share.
    pub fn new(variable: usize, distribution: &Distribution, sensitivity: f64) -> Self {
        let standard_uncertainty = distribution.standard_uncertainty();
        Self {
            variable,
            estimate: distribution.mean(),
            standard_uncertainty,
            distribution: distribution.name(),
            divisor: distribution.divisor(),
            dof: distribution.dof(),
            drawn_as: distribution.drawn_as(),
            sensitivity,
            contribution: (sensitivity * standard_uncertainty).abs(),
            share: 0.0,
        }
    }

    /// The contribution with the sign of the sensitivity coefficient, in the largest contribution
    /// of all; 0 if that is 0.
    pub(super) fn relative(&self, largest: f64) -> f64 {
        if largest > 0.0 { self.contribution.copysign(self.sensitivity) / largest } else { 0.0 }
    }
}
