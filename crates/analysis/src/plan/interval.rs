//! Calibration intervals: how long the target holds while the uncertainty of one input grows.

use super::search::boundary;
use super::trial_budget::{Change, Changes, Plannable, TrialBudget};

/// How an uncertainty grows with time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriftLaw {
    /// In proportion to time: a steady drift of unknown sign and rate.
    Linear,
    /// With the square root of time: independent steps (a random walk).
    RandomWalk,
}

impl DriftLaw {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Linear, Self::RandomWalk];

    /// The name that the command line and answers use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::RandomWalk => "random-walk",
        }
    }

    /// The factor on the uncertainty after a multiple of the stated time.
    fn factor(self, time: f64) -> f64 {
        match self {
            Self::Linear => time,
            Self::RandomWalk => time.sqrt(),
        }
    }
}

/// An input whose uncertainty is due to drift over a stated time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// Place of the variable in the task.
    pub variable: usize,
    /// The time for which its uncertainty is stated, in any unit; above 0.
    pub stated: f64,
    /// How it grows.
    pub law: DriftLaw,
}

/// The longest interval.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedInterval {
    /// The drift.
    pub drift: Drift,
    /// The longest time for which the target holds, in the unit of the stated one: 0 if it does not
    /// hold even at once, `None` if the drift never matters.
    pub longest: Option<f64>,
    /// The standard uncertainty of the drift after the longest time.
    pub standard_uncertainty: Option<f64>,
    /// Points of a curve for a plot: time, and the uncertainty of the output (U or u).
    pub curve: Vec<(f64, f64)>,
}

/// A drift matters within this multiple of its stated time, or never.
const MOST: f64 = 1e6;

/// The ratio of successive trial times before bisection.
const STEP: f64 = 1.1;

/// Points of the figure.
const POINTS: u32 = 60;

/// The longest interval; `None` if the input has no uncertainty that can grow.
pub(super) fn longest(budget: &TrialBudget<'_>, drift: Drift) -> Option<PlannedInterval> {
    let u = budget.uncertainty(drift.variable);
    if matches!(budget.plannable(drift.variable), Plannable::Not(_)) {
        return None;
    }
    let at = |time: f64| -> Changes {
        vec![(drift.variable, Change::Width(u * drift.law.factor(time)))]
    };
    let holds = |time: f64| budget.holds(&at(time));
    let longest = if holds(0.0) {
        let (mut inside, mut outside) = (0.0, 1e-3);
        while holds(outside) && outside < MOST {
            (inside, outside) = (outside, outside * STEP);
        }
        (outside < MOST).then(|| boundary(inside, outside, holds))
    } else {
        Some(0.0)
    };
    let end = 1.5 * longest.unwrap_or(1.0).max(1.0);
    let point = |number: u32| {
        let time = end * f64::from(number) / f64::from(POINTS);
        Some((time * drift.stated, budget.figure(&at(time))?))
    };
    Some(PlannedInterval {
        drift,
        longest: longest.map(|time| time * drift.stated),
        standard_uncertainty: longest.map(|time| u * drift.law.factor(time)),
        curve: (0..=POINTS).filter_map(point).filter(|(_, figure)| figure.is_finite()).collect(),
    })
}
