//! Costs of improvements of the inputs.

use super::trial_budget::{Plannable, TrialBudget};

/// Ways to improve an input, and their cost.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Improvement {
    /// A standard uncertainty u instead of u0 costs `cost` ((u0/u)^`power` - 1): nothing if
    /// unchanged, and `cost` (2^`power` - 1) for half of it.
    Continuous {
        /// The scale of the cost, above 0.
        cost: f64,
        /// The power, above 0.
        power: f64,
        /// The smallest possible standard uncertainty, in the input's unit; 0 or more.
        least: f64,
    },
    /// Each further reading costs the same.
    Readings {
        /// The cost of a reading, above 0.
        each: f64,
        /// The largest possible number of readings in total.
        most: u64,
    },
    /// One of these can replace the present input.
    Offers(Vec<Offer>),
}

/// An offer: another instrument, another calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Offer {
    /// The resulting standard uncertainty of the input, in its unit; above 0.
    pub standard_uncertainty: f64,
    /// Its cost, 0 or more.
    pub cost: f64,
    /// What it is, in words.
    pub about: String,
}

/// The costs of a plan.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Costs {
    /// Halving any standard uncertainty costs 1, also by readings, which must then be quadrupled.
    Equal,
    /// For each variable of the task, how it can be improved; `None` for one that stays unchanged.
    Stated {
        /// The improvements.
        improvements: Vec<Option<Improvement>>,
        /// The unit of costs, for pages; may be empty.
        currency: String,
    },
}

impl Costs {
    /// How a variable can be improved; `None` if it stays unchanged.
    pub(super) fn improvement(
        &self,
        budget: &TrialBudget<'_>,
        variable: usize,
    ) -> Option<Improvement> {
        let plannable = budget.plannable(variable);
        if matches!(plannable, Plannable::Not(_)) {
            return None;
        }
        match self {
            Self::Equal => Some(match plannable {
                Plannable::Readings(now) => {
                    let most = super::search::MOST_READINGS;
                    Improvement::Readings { each: 1.0 / (3.0 * now as f64), most }
                }
                _ => Improvement::Continuous { cost: 1.0, power: 1.0, least: 0.0 },
            }),
            Self::Stated { improvements, .. } => improvements.get(variable).cloned().flatten(),
        }
    }

    /// The unit of costs.
    pub fn currency(&self) -> &str {
        match self {
            Self::Equal => "",
            Self::Stated { currency, .. } => currency,
        }
    }
}
