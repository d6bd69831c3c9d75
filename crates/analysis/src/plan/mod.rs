//! Planning: from the target uncertainty of an output to the required uncertainties of its inputs,
//! by the law of propagation, with a Monte Carlo check of the plan.
//!
//! An input is changed only by its standard uncertainty: its estimate and its degrees of freedom
//! stay, and so do the sensitivity coefficients. Readings are changed by their number n, with u =
//! s/sqrt(n) and n - 1 degrees of freedom. The coverage factor follows the effective degrees of
//! freedom as in any evaluation, so that U may jump where their integer part jumps; every answer
//! lies on the side where the target holds.
//!
//! In a sweep, the row in which U exceeds its target most is planned, and the plan is checked in
//! all other rows.

mod check;
mod cost;
mod excess;
mod interval;
mod optimum;
mod search;
#[cfg(test)]
mod tests;
mod trial_budget;

use std::fmt;

pub use check::PlanCheck;
pub use cost::{Costs, Improvement, Offer};
pub use excess::Excess;
pub use interval::{Drift, DriftLaw, PlannedInterval};
pub use optimum::{CheapestPlan, PlannedInput};

use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::{Control, EvaluationError};
use gumption_engine::task::{Task, Trials};
use trial_budget::{Changes, Plannable, TrialBudget};

/// The uncertainty that is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanTarget {
    /// Index of the output in the task.
    pub output: usize,
    /// Whether the target is for the expanded uncertainty U; otherwise for the standard uncertainty
    /// u.
    pub expanded: bool,
    /// The relative part of the limit, as a fraction of the modulus of the estimate; 0 or above.
    pub share: f64,
    /// The absolute part of the limit, in the output's unit; 0 or above, and one of the two parts
    /// above 0.
    pub most: f64,
}

impl PlanTarget {
    /// The limit for the uncertainty at this estimate, both in the output's unit.
    pub fn limit(&self, estimate: f64) -> f64 {
        self.share * estimate.abs() + self.most
    }
}

/// The request.
#[derive(Clone, Debug)]
pub struct PlanQuestion {
    /// The target.
    pub target: PlanTarget,
    /// Costs of improvements.
    pub costs: Costs,
    /// The input whose uncertainty grows with time, for a calibration interval.
    pub drift: Option<Drift>,
}

/// The required uncertainty of a single input.
#[derive(Clone, Debug, PartialEq)]
pub struct InputNeed {
    /// Place of the variable in the task.
    pub variable: usize,
    /// Its standard uncertainty now.
    pub standard_uncertainty: f64,
    /// The largest standard uncertainty with which the target holds; `None` if it does not hold
    /// even with 0, or if the input cannot be planned.
    pub needed: Option<f64>,
    /// The present number of readings, for an input that is changed by their number.
    pub readings: Option<u64>,
    /// The smallest number of readings with which the target holds; `None` if there is none.
    pub readings_needed: Option<u64>,
    /// Why it cannot be planned.
    pub fixed: Option<&'static str>,
    /// Points of a curve for a plot: standard uncertainty of the input, and the uncertainty of the
    /// output (U or u).
    pub curve: Vec<(f64, f64)>,
}

/// The answer.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The request.
    pub target: PlanTarget,
    /// The index of the planned row.
    pub row: usize,
    /// The output as it is.
    pub now: Gum,
    /// The present U or u.
    pub figure: f64,
    /// The limit in the planned row, in the output's unit.
    pub limit: f64,
    /// One entry for each line of the budget, in order.
    pub inputs: Vec<InputNeed>,
    /// The cheapest combination of improvements; `None` if the target already holds.
    pub cheapest: Option<CheapestPlan>,
    /// The longest calibration interval, if a drift was given.
    pub interval: Option<PlannedInterval>,
    /// Rows in which the plan misses the target although it holds in the planned row.
    pub missed_rows: Vec<usize>,
    /// The Monte Carlo check of the plan; `None` without trials.
    pub check: Option<PlanCheck>,
}

/// The reason why there is no plan.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoPlan {
    /// The law of propagation gives no result: a sensitivity coefficient or the coverage factor is
    /// not defined.
    Undefined,
    /// The target is a fraction of an estimate that is 0.
    NoEstimate,
    /// The target already holds; the present value, in the output's unit.
    Met(f64),
    /// The target already holds by the law of propagation, which is used for planning, but not by
    /// the trials.
    MetByPropagation {
        /// The present value by the law of propagation, in the output's unit.
        figure: f64,
        /// The present value by the trials.
        by_trials: f64,
        /// The limit for the law of propagation with which the trials would meet the target, if
        /// both shrink by the same factor.
        instead: f64,
        /// The input that causes the difference, if they do not.
        excess: Option<Excess>,
    },
    /// No combination of improvements reaches the target; the smallest value that was found.
    Unreachable(f64),
    /// Too many combinations of offers.
    TooManyOffers {
        /// Their number.
        found: usize,
        /// The largest possible number.
        most: usize,
    },
    /// The quantity of the drift has no uncertainty to grow.
    NoDrift,
    /// The evaluation of the check failed.
    Evaluation(EvaluationError),
}

impl fmt::Display for NoPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Undefined => f.write_str(
                "the law of propagation gives no uncertainty here (a sensitivity coefficient or the \
                 coverage factor is not defined), so there is nothing to plan with",
            ),
            Self::NoEstimate => f.write_str(
                "the target is a share of the estimate, which is 0: state it in the unit of the output",
            ),
            Self::Met(now) => write!(f, "the target is met already: it is {now} now"),
            Self::MetByPropagation { figure, by_trials, .. } => write!(
                f,
                "the target is met already by the law of propagation ({figure}), but not by the trials \
                 ({by_trials})"
            ),
            Self::Unreachable(least) => write!(
                f,
                "the target cannot be reached: with every improvement that there is, {least} remains"
            ),
            Self::TooManyOffers { found, most } => write!(
                f,
                "there are {found} combinations of offers, but at most {most} can be tried; leave \
                 out offers that nobody would take"
            ),
            Self::NoDrift => {
                f.write_str("the input of the drift has no uncertainty that could grow with time")
            }
            Self::Evaluation(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for NoPlan {}

/// Plans a measurement by the law of propagation with the task's coverage, then checks the plan by
/// trials with the task's settings.
///
/// # Errors
/// The reason why there is no plan.
pub fn plan(task: &Task, question: &PlanQuestion, control: &Control<'_>) -> Result<Plan, NoPlan> {
    let target = question.target;
    let budgets: Vec<TrialBudget<'_>> =
        task.rows.iter().map(|row| TrialBudget::of(task, row, target)).collect();
    let none = Changes::default();
    let mut worst: Option<(usize, f64)> = None;
    for (row, budget) in budgets.iter().enumerate() {
        let figure = budget.figure(&none).filter(|figure| figure.is_finite());
        let figure = figure.ok_or(NoPlan::Undefined)?;
        if budget.limit == 0.0 {
            return Err(NoPlan::NoEstimate);
        }
        let used = figure / budget.limit;
        if worst.is_none_or(|(_, most)| used > most) {
            worst = Some((row, used));
        }
    }
    let (row, _) = worst.ok_or(NoPlan::Undefined)?;
    let budget = budgets.get(row).ok_or(NoPlan::Undefined)?;
    let limit = budget.limit;
    let figure = budget.figure(&none).ok_or(NoPlan::Undefined)?;
    let now = budget.gum(&none).ok_or(NoPlan::Undefined)?;
    let interval = match question.drift {
        Some(drift) => Some(interval::longest(budget, drift).ok_or(NoPlan::NoDrift)?),
        None => None,
    };
    let met = figure <= limit;
    if met && interval.is_none() {
        return Err(unplanned((task, &question.costs), budget, figure, control)?);
    }
    // before the requirements of the inputs, which take longer and are useless without a plan
    let cheapest = if met { None } else { Some(optimum::cheapest(budget, &question.costs)?) };
    let inputs = now.budget().map(|line| need(budget, line.variable, met)).collect();
    let changes = cheapest.as_ref().map(CheapestPlan::changes).unwrap_or_default();
    let missed_rows = budgets
        .iter()
        .enumerate()
        .filter(|(_, other)| !other.holds(&budget.carried_to(other, &changes)))
        .map(|(row, _)| row)
        .collect();
    let mut check = match task.settings.trials {
        Trials::Fixed(0) => None,
        _ => Some(check::of(task, budget, &changes, control)?),
    };
    if let Some(found) = check.as_mut().filter(|found| found.holds == Some(false) && !met)
        && let Some((by_trials, planned)) = found.figure.zip(budget.figure(&changes))
    {
        let aim = excess::lower_target(budget, planned, by_trials);
        let asked = (task, &question.costs);
        found.excess = excess::of(asked, budget, (&changes, by_trials), aim, control);
    }
    Ok(Plan { target, row, now, figure, limit, inputs, cheapest, interval, missed_rows, check })
}

/// Why nothing is planned if the target already holds by the law of propagation: it is met, unless
/// the trials miss it.
fn unplanned(
    (task, costs): (&Task, &Costs),
    budget: &TrialBudget<'_>,
    figure: f64,
    control: &Control<'_>,
) -> Result<NoPlan, NoPlan> {
    if task.settings.trials == Trials::Fixed(0) {
        return Ok(NoPlan::Met(figure));
    }
    let check = check::of(task, budget, &Changes::default(), control)?;
    Ok(match (check.holds, check.figure) {
        (Some(false), Some(by_trials)) => {
            let instead = excess::lower_target(budget, figure, by_trials);
            let as_it_is = (&Changes::default(), by_trials);
            let excess = excess::of((task, costs), budget, as_it_is, instead, control);
            NoPlan::MetByPropagation { figure, by_trials, instead, excess }
        }
        _ => NoPlan::Met(figure),
    })
}

/// The required uncertainty of a single variable.
fn need(budget: &TrialBudget<'_>, variable: usize, met: bool) -> InputNeed {
    let u = budget.uncertainty(variable);
    let mut need = InputNeed {
        variable,
        standard_uncertainty: u,
        needed: None,
        readings: None,
        readings_needed: None,
        fixed: None,
        curve: Vec::new(),
    };
    let readings = match budget.plannable(variable) {
        Plannable::Not(why) => {
            need.fixed = Some(why);
            return need;
        }
        Plannable::Width => None,
        Plannable::Readings(count) => Some(count),
    };
    need.readings = readings;
    need.curve = search::curve(budget, variable);
    if met {
        (need.needed, need.readings_needed) = (Some(u), readings);
        return need;
    }
    need.needed = search::needed(budget, variable);
    need.readings_needed = readings.and_then(|now| search::readings_needed(budget, variable, now));
    need
}
