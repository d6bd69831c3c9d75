//! A finished run's trials generated again: for what needs more of them than an evaluation keeps.

use super::evaluation::{in_pool, joint, paired_have_covariance, reach};
use super::gum::Gum;
use super::moment_order::moment_orders;
use super::monte_carlo::{self, Histogram, MonteCarlo, QuantilesAndRanks, Request, RowTrials};
use super::{Control, Evaluation, EvaluationError, gum};
use crate::number::CodePath;
use crate::task::{Row, Task};

/// Trials in the sample that represents all of them in a result file, at most.
const MOST_ROWS: usize = 1 << 15;

/// Ranks of that sample in all outputs together, at most: some megabytes of the file.
const MOST_RANKS: usize = 1 << 20;

/// How many trials the run of a row made, undefined ones included; 0 without trials.
fn made(evaluation: &Evaluation, row: usize) -> u64 {
    evaluation.rows.get(row).and_then(|row| row.made()).unwrap_or(0)
}

fn trials(task: &Task, row: usize) -> Result<Option<RowTrials>, EvaluationError> {
    let Some(row) = task.rows.get(row) else {
        return Ok(None);
    };
    let estimates = gum::evaluate(task, row).estimates;
    Ok(Some(RowTrials::new(task, row, &estimates, &joint(task, row)?)))
}

/// For each output of a row the quantiles of the run's trials at the probabilities Phi(score);
/// `None` without trials, or if stopped.
///
/// # Errors
/// A task that does not hold together.
pub fn quantiles(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    scores: &[f64],
    control: &Control<'_>,
) -> Result<Option<Vec<Vec<f64>>>, EvaluationError> {
    let count = made(evaluation, row);
    in_pool(task, control, || {
        let trials = trials(task, row)?.filter(|_| count > 0);
        Ok(trials.and_then(|trials| monte_carlo::quantiles(&trials, count, scores, control)))
    })?
}

/// For each output of a row the quantiles of the run's trials ([`quantiles`]), and its joint ranks
/// ([`joint_ranks`]); `None` without trials, or if stopped. The trials are made once more for both,
/// where memory can hold them.
///
/// # Errors
/// A task that does not hold together.
pub fn quantiles_and_ranks(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    scores: &[f64],
    control: &Control<'_>,
) -> Result<Option<QuantilesAndRanks>, EvaluationError> {
    let count = made(evaluation, row);
    let rows = rows(task);
    in_pool(task, control, || {
        let trials = trials(task, row)?.filter(|_| count > 0);
        Ok(trials.and_then(|t| monte_carlo::quantiles_and_ranks(&t, count, scores, rows, control)))
    })?
}

/// How the outputs of a row vary together: for each its ranks, from 1, in a few of the run's trials
/// that stand for all of them. Entry i of all outputs is of the same trial; an output that does not
/// vary has none. `None` without trials, or if stopped.
///
/// # Errors
/// A task that does not hold together.
pub fn joint_ranks(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    control: &Control<'_>,
) -> Result<Option<Vec<Vec<u32>>>, EvaluationError> {
    let count = made(evaluation, row);
    in_pool(task, control, || {
        let trials = trials(task, row)?.filter(|_| count > 0);
        Ok(trials.and_then(|t| monte_carlo::joint_ranks(&t, count, rows(task), control)))
    })?
}

/// Trials in the sample that represents all.
fn rows(task: &Task) -> usize {
    (MOST_RANKS / task.model.outputs.len().max(1)).min(MOST_ROWS)
}

/// For each output of a row the histogram of the run's trials (of the first ten million of more), over
/// a range that nearly all of them lie in and that shows the coverage intervals of both methods. An
/// entry is `None` for an output that does not vary; the whole is `None` without trials, or if
/// stopped.
///
/// # Errors
/// A task that does not hold together.
pub fn histograms(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    control: &Control<'_>,
) -> Result<Option<Vec<Option<Histogram>>>, EvaluationError> {
    let count = made(evaluation, row);
    let outputs = evaluation.rows.get(row).map_or(&[][..], |row| &row.outputs);
    let shown: Vec<Option<[f64; 2]>> = outputs
        .iter()
        .map(|output| {
            let gum = output.gum.as_ref().and_then(Gum::interval);
            let own = output.monte_carlo.as_deref();
            let own = own.into_iter().flat_map(|m| [m.symmetric_interval, m.shortest_interval]);
            gum.into_iter().chain(own).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
        })
        .collect();
    in_pool(task, control, || {
        let trials = trials(task, row)?.filter(|_| count > 0);
        Ok(trials.and_then(|trials| monte_carlo::histograms(&trials, count, &shown, control)))
    })?
}

/// How the figures of a row settle: for each output those of its first 1000, 2000, 5000, 10 000, ...
/// trials, up to ten million, and last those of all of them. Each are what a run of so many trials
/// gives, with its numerical standard errors. `None` without trials, or if stopped.
///
/// # Errors
/// A task that does not hold together.
pub fn convergence(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    control: &Control<'_>,
) -> Result<Option<Vec<Vec<MonteCarlo>>>, EvaluationError> {
    let count = made(evaluation, row);
    let (Some(row_of_task), Some(whole)) = (task.rows.get(row), evaluation.rows.get(row)) else {
        return Ok(None);
    };
    let reaches = reach(&task.model.program, task.variables.len());
    let moment_order =
        moment_orders(task, row_of_task, &reaches, &gum::evaluate(task, row_of_task));
    let probability = task.settings.coverage.probability();
    let request = Request { trials: count, probability, moment_order: &moment_order };
    in_pool(task, control, || {
        let trials = trials(task, row)?.filter(|_| count > 0);
        let found =
            trials.and_then(|mut trials| monte_carlo::settling(&mut trials, request, control));
        Ok(found.map(|mut outputs| {
            for (stages, output) in outputs.iter_mut().zip(&whole.outputs) {
                stages.extend(output.monte_carlo.as_deref().cloned());
            }
            outputs
        }))
    })?
}

/// Hands over the trials of a row, block by block in order: for each output its values, without
/// the trials that were left out of the figures. The bits are those of the run. `false` if stopped.
///
/// # Errors
/// The taker's; threads that cannot be started.
pub fn for_each_block<E: Send + From<EvaluationError>>(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    control: &Control<'_>,
    take: impl FnMut(&[Vec<f64>]) -> Result<(), E> + Send,
) -> Result<bool, E> {
    let count = made(evaluation, row);
    in_pool(task, control, || match trials(task, row)? {
        Some(trials) if count > 0 => monte_carlo::repeat(&trials, count, control, take),
        _ => Ok(true),
    })?
}

/// For each output its values in the first trials of a row, at most `most` of them, without the
/// trials that were left out of the figures. Entry i of all outputs is of the same trial, and the
/// bits are those of the run. `None` without trials, or if stopped.
///
/// # Errors
/// A task that does not hold together.
pub fn first_trials(
    task: &Task,
    evaluation: &Evaluation,
    row: usize,
    most: u64,
    control: &Control<'_>,
) -> Result<Option<Vec<Vec<f64>>>, EvaluationError> {
    let count = made(evaluation, row).min(most);
    in_pool(task, control, || {
        let trials = trials(task, row)?.filter(|_| count > 0);
        Ok(trials.and_then(|trials| monte_carlo::collected(&trials, count, control)))
    })?
}

/// The values of the program's variables (inputs, then conditions) in the first trials of a row, as a run
/// draws them: a column for each variable, of `count` entries, or of as many as a block has.
///
/// # Errors
/// Correlations that cannot be drawn, or paired readings without a covariance.
pub fn first_draws(
    task: &Task,
    row: &Row,
    count: usize,
    path: CodePath,
) -> Result<Vec<Vec<f64>>, EvaluationError> {
    paired_have_covariance(task, row)?;
    // the branch of a phase is a matter of the outputs
    let estimates = vec![f64::NAN; task.model.outputs.len()];
    let trials = RowTrials::new(task, row, &estimates, &joint(task, row)?);
    Ok(trials.first_draws(path, row, count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Input;
    use crate::model::typed::example::Projection;
    use crate::propagate::evaluate;
    use crate::task::{Settings, Trials};

    /// A task with readings, whose t distribution has few degrees of freedom.
    fn task(trials: u64) -> Task {
        let plane = Projection {
            a_ref: Input::readings(&[9.81, 9.79, 9.82, 9.80, 9.80, 9.83], "m/s^2").unwrap(),
            tilt: Input::rectangular(30.0, 0.5, "deg").unwrap(),
            rotation: Input::normal(10.0, 0.2, "deg").unwrap(),
        };
        let settings = Settings { trials: Trials::Fixed(trials), ..Settings::default() };
        Task::of(plane, settings).unwrap()
    }

    /// Shortest digits, which tell all bits of a number; an error that is not stated is NaN, which no
    /// comparison finds equal.
    fn printed(figures: &impl std::fmt::Debug) -> String {
        format!("{figures:?}")
    }

    /// Every stage is what a run of so many trials prints, whatever the threads and the memory, and the
    /// last is the run itself, to the bit.
    #[test]
    fn a_stage_is_a_run_of_so_many_trials() {
        let of = |trials| {
            let task = task(trials);
            let evaluation = evaluate(&task, &Control::default()).unwrap();
            (task, evaluation)
        };
        let (whole, evaluation) = of(30_000);
        let settled = |control| convergence(&whole, &evaluation, 0, &control).unwrap().unwrap();
        let stages = settled(Control::default());
        let counts: Vec<u64> = stages[0].iter().map(|figures| figures.trials).collect();
        assert_eq!(counts, [1000, 2000, 5000, 10_000, 20_000, 30_000]);
        for (place, count) in counts.into_iter().enumerate() {
            let (_, alone) = of(count);
            let alone = alone.rows[0].outputs[0].monte_carlo.as_deref();
            assert_eq!(printed(&Some(&stages[0][place])), printed(&alone));
        }
        let stages = printed(&stages);
        assert_eq!(stages, printed(&settled(Control::default().with_threads(3))));
        let little = Control::default().with_threads(1).with_memory(1 << 16);
        assert_eq!(stages, printed(&settled(little)));
    }

    /// The first trials are those of the run, whatever the threads and the memory.
    #[test]
    fn the_first_trials_are_those_of_the_run() {
        let task = task(30_000);
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let mut whole: Vec<Vec<f64>> = vec![Vec::new(); evaluation.rows[0].outputs.len()];
        let all = for_each_block(&task, &evaluation, 0, &Control::default(), |block| {
            whole.iter_mut().zip(block).for_each(|(kept, block)| kept.extend(block));
            Ok::<(), EvaluationError>(())
        });
        assert_eq!(all, Ok(true));
        let first = |most: usize, control: Control<'_>| {
            first_trials(&task, &evaluation, 0, most as u64, &control).unwrap().unwrap_or_default()
        };
        for most in [1, 700, 12_345, 30_000, 1_000_000] {
            let expected: Vec<&[f64]> =
                whole.iter().map(|values| &values[..values.len().min(most)]).collect();
            let little = Control::default().with_threads(3).with_memory(1 << 16);
            assert_eq!(first(most, little), expected);
            assert_eq!(first(most, Control::default().with_threads(1)), expected);
        }
        assert!(first(0, Control::default()).is_empty());
    }

    #[test]
    fn without_trials_nothing_settles() {
        let task = task(0);
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        assert_eq!(convergence(&task, &evaluation, 0, &Control::default()), Ok(None));
        assert_eq!(convergence(&task, &evaluation, 7, &Control::default()), Ok(None));
    }
}
