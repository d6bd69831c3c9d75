//! The budget of a row with some of its inputs changed.

use std::sync::Arc;

use super::PlanTarget;
use gumption_engine::distribution::{Constant, Distribution, Invalid, Normal, StudentT};
use gumption_engine::propagate::gum::{AtEstimates, Gum};
use gumption_engine::task::{Row, Task};

/// What can be changed for an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Plannable {
    /// Its standard uncertainty.
    Width,
    /// The number of its readings; the value is the present number.
    Readings(u64),
    /// Nothing, and why.
    Not(&'static str),
}

/// The change of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// A standard uncertainty.
    Width(f64),
    /// A number of readings, which may be fractional on the way to an integer.
    Readings(f64),
}

/// Variables with their changes.
pub(super) type Changes = Vec<(usize, Change)>;

/// A row of a task and its planned output.
#[derive(Debug)]
pub(super) struct TrialBudget<'a> {
    pub(super) task: &'a Task,
    pub(super) row: &'a Row,
    pub(super) target: PlanTarget,
    /// The limit for the uncertainty in this row, in the output's unit.
    pub(super) limit: f64,
    at: AtEstimates<'a>,
}

impl<'a> TrialBudget<'a> {
    pub(super) fn of(task: &'a Task, row: &'a Row, target: PlanTarget) -> Self {
        let mut budget =
            Self { task, row, target, limit: target.most, at: AtEstimates::of(task, row) };
        if target.share > 0.0 {
            let estimate = budget.gum(&Changes::default()).map_or(f64::NAN, |gum| gum.estimate);
            budget.limit = target.limit(estimate);
        }
        budget
    }

    fn distribution(&self, variable: usize) -> Option<&Arc<Distribution>> {
        self.row.distributions.get(variable)
    }

    /// The present standard uncertainty of a variable.
    pub(super) fn uncertainty(&self, variable: usize) -> f64 {
        self.distribution(variable).map_or(0.0, |known| known.standard_uncertainty())
    }

    /// What can be changed for a variable.
    pub(super) fn plannable(&self, variable: usize) -> Plannable {
        let Some(known) = self.distribution(variable) else {
            return Plannable::Not("no such quantity");
        };
        if known.standard_uncertainty() == 0.0 {
            return Plannable::Not("known exactly");
        }
        match &**known {
            Distribution::SavedResult(_) => {
                Plannable::Not("a saved result: plan the evaluation that it comes from")
            }
            // a single reading cannot be bought if all points determine a coefficient
            Distribution::Fitted(_) => {
                Plannable::Not("a parameter of a calibration function: plan the points of its fit")
            }
            Distribution::Readings(readings) if readings.together() > 1 => {
                Plannable::Not("paired readings: all have the same number")
            }
            Distribution::Readings(readings) => {
                let count = readings.count();
                // if the scatter of these readings determines it
                if known.dof() == count as f64 - 1.0 {
                    Plannable::Readings(count as u64)
                } else {
                    Plannable::Width
                }
            }
            _ => Plannable::Width,
        }
    }

    /// The standard uncertainty and the degrees of freedom after a change.
    fn changed(&self, variable: usize, change: Change) -> (f64, f64) {
        let (u, dof) = self
            .distribution(variable)
            .map_or((0.0, f64::INFINITY), |known| (known.standard_uncertainty(), known.dof()));
        match change {
            Change::Width(u) => (u, dof),
            Change::Readings(count) => (u * ((dof + 1.0) / count).sqrt(), count - 1.0),
        }
    }

    /// The standard uncertainty after a change.
    pub(super) fn changed_uncertainty(&self, variable: usize, change: Change) -> f64 {
        self.changed(variable, change).0
    }

    /// The output after some changes; `None` if it is not defined.
    pub(super) fn gum(&self, changes: &Changes) -> Option<Gum> {
        let mut distributions = self.row.distributions.to_vec();
        for &(variable, change) in changes {
            let (u, dof) = self.changed(variable, change);
            let place = distributions.get_mut(variable)?;
            // only estimate, standard uncertainty and degrees of freedom count here
            *place = Arc::new(stand_in(place.mean(), u, dof).ok()?);
        }
        self.at.with(distributions.into()).into_iter().nth(self.target.output)?
    }

    /// U or u, as the target requires, after some changes.
    pub(super) fn figure(&self, changes: &Changes) -> Option<f64> {
        let gum = self.gum(changes)?;
        if self.target.expanded {
            gum.expanded_uncertainty()
        } else {
            Some(gum.standard_uncertainty)
        }
    }

    /// Whether the target holds after some changes.
    pub(super) fn holds(&self, changes: &Changes) -> bool {
        self.figure(changes).is_some_and(|figure| figure <= self.limit)
    }

    /// The changes for another row: widths change by the same factor.
    pub(super) fn carried_to(&self, other: &TrialBudget<'_>, changes: &Changes) -> Changes {
        let carried = |&(variable, change): &(usize, Change)| match change {
            Change::Width(u) => {
                let factor = u / self.uncertainty(variable);
                (variable, Change::Width(factor * other.uncertainty(variable)))
            }
            Change::Readings(_) => (variable, change),
        };
        let varies = |(variable, _): &&(usize, Change)| other.uncertainty(*variable) > 0.0;
        changes.iter().filter(varies).map(carried).collect()
    }
}

/// A distribution with an estimate, a standard uncertainty and degrees of freedom.
pub(super) fn stand_in(mean: f64, u: f64, dof: f64) -> Result<Distribution, Invalid> {
    Ok(if u == 0.0 {
        Constant::new(mean)?.into()
    } else if dof.is_finite() {
        StudentT::new(mean, u, dof)?.into()
    } else {
        Normal::new(mean, u)?.into()
    })
}
