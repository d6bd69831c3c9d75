//! Finds why the trials miss a target that the law of propagation meets, and whether a lower target
//! would help.
//!
//! If the model is not linear over the uncertainty of an input, its contribution to the trials does
//! not shrink with U by the law of propagation. An angle about 0 deg, whose cosine has a
//! sensitivity coefficient of 0, does not contribute to that U at all. A lower target then only
//! makes other inputs more expensive.

use super::check;
use super::cost::Costs;
use super::optimum;
use super::trial_budget::{Change, Changes, Plannable, TrialBudget};
use gumption_engine::propagate::Control;
use gumption_engine::task::{Task, Trials};

/// Maximum number of trials of each attempt.
const MOST_TRIALS: u64 = 50_000;

/// Maximum number of inputs that are tried one by one.
const MOST_TRIED: usize = 40;

/// Number of bisections of a standard uncertainty, which gives three digits.
const HALVINGS: u32 = 16;

/// A lower target helps if the trials exceed the wanted one by less than this fraction.
const ABOUT: f64 = 0.1;

/// The input because of which the trials miss a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Index of the variable in the task.
    pub variable: usize,
    /// The result of the trials without its uncertainty, all others as planned.
    pub without: f64,
    /// The largest standard uncertainty of this input alone with which the trials meet the target;
    /// `None` if they miss it even with 0, or if it has no width that can be changed.
    pub needed: Option<f64>,
}

/// The target for a plan by the law of propagation with which the trials would meet the wanted one,
/// if both shrink by the same factor.
pub(super) fn lower_target(budget: &TrialBudget<'_>, by_propagation: f64, by_trials: f64) -> f64 {
    budget.limit * by_propagation / by_trials
}

/// The input because of which the trials of these changes give `by_trials`; `None` if a plan for
/// the lower target `aim` would help, or if no input stands out.
pub(super) fn of(
    (task, costs): (&Task, &Costs),
    budget: &TrialBudget<'_>,
    (changes, by_trials): (&Changes, f64),
    aim: f64,
    control: &Control<'_>,
) -> Option<Excess> {
    let mut few = task.clone();
    few.regions.clear();
    few.settings.decide_up_to = 0;
    few.settings.trials = Trials::Fixed(match task.settings.trials {
        Trials::Fixed(count) => count.min(MOST_TRIALS),
        Trials::Adaptive => MOST_TRIALS,
    });
    let tried = |changes: &Changes| check::of(&few, budget, changes, control).ok()?.figure;
    let mut lower = TrialBudget::of(task, budget.row, budget.target);
    lower.limit = aim;
    let aimed = optimum::cheapest(&lower, costs).ok().and_then(|plan| tried(&plan.changes()));
    if aimed.is_none_or(|figure| figure <= (1.0 + ABOUT) * budget.limit) {
        return None;
    }
    let with = |variable: usize, change: Change| {
        let others = changes.iter().filter(|(changed, _)| *changed != variable).copied();
        others.chain([(variable, change)]).collect::<Changes>()
    };
    let varies = |variable: &usize| !matches!(budget.plannable(*variable), Plannable::Not(_));
    let candidates: Vec<usize> = (0..task.variables.len()).filter(varies).collect();
    if candidates.len() > MOST_TRIED {
        return None;
    }
    let linear = budget.figure(changes)?;
    // its excess: the contribution to the trials beyond the contribution by the law of propagation
    let mut most: Option<(f64, usize, f64)> = None;
    for variable in candidates {
        if control.is_stopped() {
            return None;
        }
        let without = with(variable, Change::Width(0.0));
        let Some((figure, own)) = tried(&without).zip(budget.figure(&without)) else { continue };
        let excess = (by_trials - figure) - (linear - own);
        if most.is_none_or(|(known, ..)| excess > known) {
            most = Some((excess, variable, figure));
        }
    }
    let (_, variable, without) = most.filter(|(excess, ..)| *excess > 0.0)?;
    let is_width = budget.plannable(variable) == Plannable::Width;
    let needed = (is_width && without <= budget.limit).then(|| {
        let (mut inside, mut outside) = (0.0, planned(budget, changes, variable));
        for _ in 0..HALVINGS {
            let middle = 0.5 * inside + 0.5 * outside;
            let figure = tried(&with(variable, Change::Width(middle)));
            if figure.is_some_and(|figure| figure <= budget.limit) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        inside
    });
    Some(Excess { variable, without, needed: needed.filter(|needed| *needed > 0.0) })
}

/// The standard uncertainty of a variable after these changes.
fn planned(budget: &TrialBudget<'_>, changes: &Changes, variable: usize) -> f64 {
    let changed = changes.iter().find(|(of, _)| *of == variable);
    changed.map_or_else(
        || budget.uncertainty(variable),
        |(_, change)| budget.changed_uncertainty(variable, *change),
    )
}
