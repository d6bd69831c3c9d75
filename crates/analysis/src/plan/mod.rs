//! Planning backwards: from the uncertainty that is wanted of an output to what its inputs would
//! have to become, by the law of propagation, with a Monte Carlo check of the plan.
//!
//! An input is changed by its standard uncertainty alone: its estimate and its degrees of freedom
//! stay, and with them the sensitivity coefficients. Readings are changed by their number n, with
//! u = s/sqrt(n) and n - 1 degrees of freedom. The coverage factor follows the effective degrees of
//! freedom as in any evaluation, so that U may jump where their integer part does; every answer is
//! checked on the side where the target holds.
//!
//! Of a sweep the row in which U is furthest above its target is planned, and the plan is tried in all
//! others.

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
    /// Place of the output in the task.
    pub output: usize,
    /// Whether the expanded uncertainty U is meant, or else the standard uncertainty u.
    pub expanded: bool,
    /// The most that it may be, a share of the modulus of the estimate; 0 or above.
    pub share: f64,
    /// What is added to that share, in the output's unit; 0 or above, and one of the two above 0.
    pub most: f64,
}

impl PlanTarget {
    /// The most that the uncertainty of this estimate may be, both in the output's unit.
    pub fn limit(&self, estimate: f64) -> f64 {
        self.share * estimate.abs() + self.most
    }
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct PlanQuestion {
    /// What is wanted.
    pub target: PlanTarget,
    /// What improvements cost.
    pub costs: Costs,
    /// The input that grows with time, for a calibration interval.
    pub drift: Option<Drift>,
}

/// What one input alone would have to become.
#[derive(Clone, Debug, PartialEq)]
pub struct InputNeed {
    /// Place of the variable in the task.
    pub variable: usize,
    /// Its standard uncertainty now.
    pub standard_uncertainty: f64,
    /// The largest standard uncertainty with which the target holds; `None` where it does not even
    /// with 0, or where the input cannot be planned.
    pub needed: Option<f64>,
    /// How many readings there are now, of an input that is changed by their number.
    pub readings: Option<u64>,
    /// The least number of readings with which the target holds; `None` where no number does.
    pub readings_needed: Option<u64>,
    /// Why it cannot be planned.
    pub fixed: Option<&'static str>,
    /// Standard uncertainties with what is wanted of the output at each, for a figure.
    pub curve: Vec<(f64, f64)>,
}

/// The answer.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What was asked for.
    pub target: PlanTarget,
    /// The row of the task that is planned.
    pub row: usize,
    /// The output as it is.
    pub now: Gum,
    /// U or u as it is.
    pub figure: f64,
    /// The most that it may be in the planned row, in the output's unit.
    pub limit: f64,
    /// One entry for each line of the budget, in order.
    pub inputs: Vec<InputNeed>,
    /// The cheapest combination of improvements; `None` where the target holds already.
    pub cheapest: Option<CheapestPlan>,
    /// The longest calibration interval, where a drift was given.
    pub interval: Option<PlannedInterval>,
    /// Rows in which the plan misses the target, though it holds in the planned one.
    pub missed_rows: Vec<usize>,
    /// The Monte Carlo check of the plan; `None` without trials.
    pub check: Option<PlanCheck>,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoPlan {
    /// The law of propagation gives nothing here: a sensitivity coefficient or the coverage factor is
    /// not defined.
    Undefined,
    /// The target is a share of an estimate that is 0.
    NoEstimate,
    /// The target holds already; what it is now, in the output's unit.
    Met(f64),
    /// The target holds already by the law of propagation, which plans, and not by the trials.
    MetByPropagation {
        /// What it is now by the law of propagation, in the output's unit.
        figure: f64,
        /// What it is by the trials.
        by_trials: f64,
        /// The most that it may be by the law of propagation for the trials to come to the target,
        /// where both shrink alike.
        instead: f64,
        /// The input that makes the difference where they do not.
        excess: Option<Excess>,
    },
    /// The target holds with no combination of improvements; the least that was found.
    Unreachable(f64),
    /// More combinations of offers than can be tried.
    TooManyOffers {
        /// How many there are.
        found: usize,
        /// How many can be.
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

/// Plans a measurement: the law of propagation with the task's coverage, then trials with its
/// settings.
///
/// # Errors
/// That there is no plan, and why.
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
        return Err(unplanned(task, &question.costs, budget, figure, control)?);
    }
    // before the needs of the inputs, which take longer and are of no use where there is no plan
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
        let costs = &question.costs;
        found.excess = excess::of(task, costs, budget, &changes, by_trials, aim, control);
    }
    Ok(Plan { target, row, now, figure, limit, inputs, cheapest, interval, missed_rows, check })
}

/// Why nothing is planned where the target holds by the law of propagation: it is met, unless the
/// trials miss it.
fn unplanned(
    task: &Task,
    costs: &Costs,
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
            let none = Changes::default();
            let excess = excess::of(task, costs, budget, &none, by_trials, instead, control);
            NoPlan::MetByPropagation { figure, by_trials, instead, excess }
        }
        _ => NoPlan::Met(figure),
    })
}

/// What one variable alone would have to become.
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
