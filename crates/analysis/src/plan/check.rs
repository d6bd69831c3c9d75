//! The Monte Carlo check of a plan.

use std::sync::Arc;

use super::NoPlan;
use super::excess::Excess;
use super::trial_budget::{Change, Changes, TrialBudget, stand_in};
use gumption_engine::distribution::{
    Arcsine, Constant, Distribution, Fits, Invalid, Normal, Rectangular, StudentT, Trapezoidal,
    Triangular,
};
use gumption_engine::propagate::{Control, evaluate};
use gumption_engine::task::{Row, Task};

/// The results of the trials for a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanCheck {
    /// The number of trials.
    pub trials: u64,
    /// Half the length of the symmetric coverage interval, or the standard uncertainty if that is
    /// wanted; `None` if the trials do not determine it.
    pub figure: Option<f64>,
    /// Its numerical standard error.
    pub numerical_standard_error: Option<f64>,
    /// Whether the target holds; `None` if the result is within two numerical standard errors of
    /// it, or unknown.
    pub holds: Option<bool>,
    /// Variables that are drawn from a normal or t distribution of the planned standard
    /// uncertainty, because theirs has no width that can be changed alone.
    pub stood_in: Vec<usize>,
    /// The fewest degrees of freedom with which an input of the plan is drawn.
    pub drawn_dof: f64,
    /// The input because of which the trials miss the target, if a lower target would not help.
    pub excess: Option<Excess>,
}

/// The trials of the planned row.
pub(super) fn of(
    task: &Task,
    budget: &TrialBudget<'_>,
    changes: &Changes,
    control: &Control<'_>,
) -> Result<PlanCheck, NoPlan> {
    let target = budget.target;
    let mut stood_in = Vec::new();
    let mut distributions = budget.row.distributions.to_vec();
    for &(variable, change) in changes {
        let Some(place) = distributions.get_mut(variable) else { continue };
        let u = budget.changed_uncertainty(variable, change);
        let made = match change {
            Change::Readings(count) => stand_in(place.mean(), u, count - 1.0),
            Change::Width(u) => match narrowed(place, u) {
                Some(made) => made,
                None => {
                    stood_in.push(variable);
                    stand_in(place.mean(), u, place.dof())
                }
            },
        };
        *place = Arc::new(made.map_err(|_| NoPlan::Undefined)?);
    }
    let row =
        Row { conditions: budget.row.conditions.clone(), distributions: distributions.into() };
    let mut planned = task.clone();
    (planned.rows, planned.fits) = (vec![row], Fits::default());
    let found = evaluate(&planned, control).map_err(NoPlan::Evaluation)?;
    let output = found.rows.first().and_then(|row| row.outputs.get(target.output));
    let figures = output.and_then(|output| output.monte_carlo.as_deref());
    let figure = figures.and_then(|figures| {
        let [low, high] = figures.symmetric_interval;
        if target.expanded { Some(0.5 * high - 0.5 * low) } else { figures.standard_uncertainty }
    });
    let error = figures.and_then(|figures| {
        let [low, high] = figures.errors.symmetric_interval;
        let of_half = 0.5 * (low * low + high * high).sqrt();
        if target.expanded { Some(of_half) } else { figures.errors.standard_uncertainty }
    });
    let holds = figure.zip(error).and_then(|(figure, error)| {
        let clear = (figure - budget.limit).abs() > 2.0 * error;
        clear.then_some(figure <= budget.limit)
    });
    Ok(PlanCheck {
        trials: figures.map_or(0, |figures| figures.trials),
        figure,
        numerical_standard_error: error,
        holds,
        stood_in,
        drawn_dof: output.map_or(f64::INFINITY, |output| output.drawn_dof),
        excess: None,
    })
}

/// A distribution with another standard uncertainty, the same estimate and the same degrees of
/// freedom; `None` for a distribution without its own width.
fn narrowed(stated: &Distribution, u: f64) -> Option<Result<Distribution, Invalid>> {
    let mean = stated.mean();
    if u == 0.0 {
        return Some(Constant::new(mean).map(Into::into));
    }
    let dof = stated.dof();
    let with = |made: Result<Distribution, Invalid>| Some(made);
    // the divisor of a width that gives u
    let half_width = stated.divisor().map(|divisor| divisor * u);
    match stated {
        Distribution::Normal(_) if dof.is_finite() => {
            with(Normal::with_dof(mean, u, dof).map(Into::into))
        }
        Distribution::Normal(_) => with(Normal::new(mean, u).map(Into::into)),
        Distribution::StudentT(_) => with(StudentT::new(mean, u, dof).map(Into::into)),
        Distribution::Rectangular(_) => {
            let made = Rectangular::new(mean, half_width?);
            with(if dof.is_finite() {
                made.and_then(|made| made.with_dof(dof)).map(Into::into)
            } else {
                made.map(Into::into)
            })
        }
        Distribution::Triangular(_) => {
            let made = Triangular::new(mean, half_width?);
            with(if dof.is_finite() {
                made.and_then(|made| made.with_dof(dof)).map(Into::into)
            } else {
                made.map(Into::into)
            })
        }
        Distribution::Trapezoidal(_) => {
            // divisor^2 = 6/(1 + beta^2)
            let divisor = stated.divisor()?;
            let beta = (6.0 / (divisor * divisor) - 1.0).clamp(0.0, 1.0).sqrt();
            let made = Trapezoidal::new(mean, half_width?, beta);
            with(if dof.is_finite() {
                made.and_then(|made| made.with_dof(dof)).map(Into::into)
            } else {
                made.map(Into::into)
            })
        }
        Distribution::Arcsine(_) => with(Arcsine::new(mean, half_width?).map(Into::into)),
        _ => None,
    }
}
