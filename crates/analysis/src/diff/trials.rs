//! Results of trials beside the attributed change of U, which is that of the law of propagation.

use super::{Difference, common_outputs, pairs};
use gumption_engine::distribution::Fits;
use gumption_engine::number::elementary;
use gumption_engine::propagate::validate::numerical_tolerance;
use gumption_engine::propagate::{Control, OutputEvaluation, evaluate};
use gumption_engine::task::{Row, Task, Trials};

/// Maximum number of trials for a row: their results are shown beside others, and two digits of
/// them are enough.
const MOST_TRIALS: u64 = 100_000;

/// Numerical standard error of an endpoint of the symmetric interval in standard uncertainties,
/// times the square root of the number of trials: for a normal distribution at 2.3 %, and less for
/// most others.
const ERROR_OF_AN_END: f64 = 2.9;

/// The results of the trials for an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByTrials {
    /// Half the length of the symmetric coverage interval.
    pub half_length: f64,
    /// Its numerical standard error; 0 if it is unknown.
    pub numerical_standard_error: f64,
    /// Whether the interval of the law of propagation is validated (JCGM 101, clause 8); `None` if
    /// undecided.
    pub gum_valid: Option<bool>,
}

impl ByTrials {
    /// From an evaluation; `None` without trials.
    fn of(found: &OutputEvaluation) -> Option<Self> {
        let figures = found.monte_carlo.as_deref()?;
        let [low, high] = figures.symmetric_interval;
        let [low_error, high_error] = figures.errors.symmetric_interval;
        let error = 0.5 * elementary::hypot(low_error, high_error);
        Some(Self {
            half_length: 0.5 * high - 0.5 * low,
            numerical_standard_error: if error.is_finite() { error } else { 0.0 },
            gum_valid: found.validation.and_then(|validation| validation.gum_valid),
        })
    }

    /// From a saved result: both intervals, the standard uncertainty and the number of trials,
    /// which is infinite if unknown. The verdict is that for two digits.
    pub fn saved(gum: Option<[f64; 2]>, trials: [f64; 2], u: f64, count: f64) -> Self {
        let error = ERROR_OF_AN_END * u / count.sqrt();
        let tolerance = numerical_tolerance(u, 2);
        let apart = gum.map(|gum| [0, 1].map(|end| (gum[end] - trials[end]).abs()));
        let gum_valid = apart.and_then(|apart| {
            let most = apart.into_iter().fold(0.0, f64::max);
            ((most - tolerance).abs() >= 2.0 * error).then_some(most <= tolerance)
        });
        Self {
            half_length: 0.5 * trials[1] - 0.5 * trials[0],
            numerical_standard_error: error * f64::sqrt(0.5),
            gum_valid,
        }
    }

    /// In a unit that is smaller by `factor`.
    #[must_use]
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self {
            half_length: factor * self.half_length,
            numerical_standard_error: factor * self.numerical_standard_error,
            ..self
        }
    }
}

/// The results of the trials for these rows of a task, row by row; empty if no trials are wanted or
/// possible.
pub(super) fn of_rows(
    task: &Task,
    rows: &[&Row],
    control: &Control<'_>,
) -> Vec<Vec<Option<ByTrials>>> {
    let mut tried = task.clone();
    // draws that were fitted belong to the unchanged rows
    if rows.len() != task.rows.len() {
        tried.rows = rows.iter().map(|row| (*row).clone()).collect();
        tried.fits = Fits::default();
    }
    tried.regions.clear();
    tried.settings.decide_up_to = 0;
    tried.settings.trials = match task.settings.trials {
        Trials::Fixed(0) => return Vec::new(),
        Trials::Fixed(count) => Trials::Fixed(count.min(MOST_TRIALS)),
        Trials::Adaptive => Trials::Fixed(MOST_TRIALS),
    };
    let Ok(found) = evaluate(&tried, control) else { return Vec::new() };
    let of_row = |outputs: &[OutputEvaluation]| outputs.iter().map(ByTrials::of).collect();
    found.rows.iter().map(|row| of_row(&row.outputs)).collect()
}

/// Adds the results of the trials of both tasks to their comparison by the law of propagation.
pub fn add_trials(difference: &mut Difference, tasks: [&Task; 2], control: &Control<'_>) {
    let outputs = common_outputs(tasks);
    let pairs = pairs(tasks);
    let found = [0, 1].map(|side| {
        let rows: Vec<&Row> = pairs.iter().map(|pair| pair[side]).collect();
        of_rows(tasks[side], &rows, control)
    });
    for (number, row) in difference.rows.iter_mut().enumerate() {
        for (compared, output) in row.outputs.iter_mut().zip(&outputs) {
            compared.by_trials = [0, 1].map(|side| {
                let own = *found[side].get(number)?.get(output.indices[side])?;
                Some(own?.scaled(if side == 0 { 1.0 } else { output.factor }))
            });
        }
    }
}
