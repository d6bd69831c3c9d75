//! A Monte Carlo run of one row: pilot, main pass, figures.

use std::ops::Range;

use crate::parallel;

use super::accumulate::{AccumulateKernel, Accumulated, AccumulatedOutput, drop_undefined};
use super::block::{RowTrials, Workspace};
use super::figures::{Finished, Intervals, MonteCarlo, NumericalError, Undefined, of_moments};
use super::interval::{Ranks, is_extreme, quantile_error, shortest, symmetric};
use super::moments::Moments;
use super::order::Order;
use super::pilot::{KEEP_ALL_MARGIN, pilot_blocks, plans};
use super::plan::Plan;
use super::products::waves;
use super::request::{Request, trials_in};
use super::several_pass;
use super::shortest_scatter::{BATCHES, BatchInterval, ShortestScatter, batch_blocks};
use super::totals::{ChunkSums, Totals};
use super::windows::Windows;
use crate::distribution::BLOCK;
use crate::number::CodePath;
use crate::propagate::Control;

/// Runs the trials of one row. Where every trial is undefined, or the run was stopped before the
/// first one, there are no outputs.
pub(crate) fn run(trials: &mut RowTrials, request: Request<'_>, control: &Control<'_>) -> Finished {
    // what the pilot computes is not computed again
    trials.hold(control.path, pilot_blocks(request.trials), control.memory);
    run_held(trials, request, control)
}

fn run_held(trials: &RowTrials, request: Request<'_>, control: &Control<'_>) -> Finished {
    let mut margin = 1.0;
    // from the first windows, which a run in less memory has as well
    let mut scatters: Vec<Option<ShortestScatter>> = vec![None; trials.outputs()];
    loop {
        let plans = plans(trials, request, control, margin);
        if kept_bytes(&plans, request) > control.memory {
            return run_in_passes(trials, request, control, &plans);
        }
        let (chunks, totals) = accumulate_all(trials, request.trials, &plans, control);
        if let Some(finished) =
            finish(trials, request, control, &plans, chunks, &totals, &mut scatters)
        {
            return finished;
        }
        // a tail came out short: wider windows, in the end everything, which cannot come out short
        debug_assert!(margin <= KEEP_ALL_MARGIN);
        margin *= 4.0;
    }
}

/// The memory that the kept values of all outputs would take.
pub(super) fn kept_bytes(plans: &[Plan], request: Request<'_>) -> usize {
    let share: f64 = plans.iter().map(|plan| plan.kept).sum();
    (8.0 * share * request.trials as f64) as usize
}

/// A run in bounded memory. A run of its first trials is what is handed back if the user stops the
/// whole before it has come farther.
fn run_in_passes(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
) -> Finished {
    let affordable = control.memory as f64 / 8.0 / plans.len().max(1) as f64;
    let part = (request.trials / 64).min(affordable as u64 / 2).max(2);
    let quiet = Control { progress: None, ..*control };
    let mut first = run_held(trials, Request { trials: part, ..request }, &quiet);
    let scatters = scatters(trials, request, &quiet, plans);
    let whole = several_pass::run(trials, request, control, plans, &scatters);
    match whole.filter(|whole| !whole.stopped || whole.trials > first.trials) {
        Some(whole) => whole,
        None => {
            first.stopped = true;
            first
        }
    }
}

/// How the shortest intervals of the first batches scatter, made by themselves: the same as those of
/// a run that holds its tails, in memory for a batch on each thread.
pub(super) fn scatters(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
) -> Vec<ShortestScatter> {
    let chunk = batch_blocks(request.trials);
    let count = request.trials.min(BATCHES as u64 * chunk * BLOCK as u64);
    let batch = |workspace: &mut Workspace, number: u64| {
        let made = accumulate_chunk(trials, request.trials, plans, control, workspace, number);
        let batch = |output: AccumulatedOutput| Batch {
            trials: made.trials,
            below_median: output.below_median,
            kept: output.kept,
        };
        made.outputs.into_iter().map(batch).collect::<Vec<Batch>>()
    };
    let of_batch = |workspace: &mut Workspace, number: u64| {
        let intervals = batch(workspace, number).into_iter().zip(plans).map(|(batch, plan)| {
            let mut order = order_of(control.path, std::slice::from_ref(&batch), &plan.windows);
            BatchInterval::of(&mut order, request.probability, number).filter(|_| batch.trials > 0)
        });
        intervals.collect::<Vec<_>>()
    };
    let numbers = 0..count.div_ceil(BLOCK as u64).div_ceil(chunk);
    let found: Vec<Vec<Option<BatchInterval>>> =
        parallel::map_with(numbers, || trials.workspace(), of_batch);
    (0..plans.len())
        .map(|output| {
            // made once more: seldom, and so that no more than a batch of each thread is held
            let near = |batches: &[BatchInterval], end: usize| {
                let of_batch = |workspace: &mut Workspace, interval: &BatchInterval| {
                    let made = batch(workspace, interval.number());
                    let own = made.get(output).map_or(&[][..], std::slice::from_ref);
                    let mut order = order_of(control.path, own, &plans[output].windows);
                    interval.nearest(&mut order, end)
                };
                parallel::map_with(batches, || trials.workspace(), of_batch)
            };
            let batches = found.iter().filter_map(|intervals| intervals.get(output)?.clone());
            ShortestScatter::of(batches.collect(), request.trials, near)
        })
        .collect()
}

/// How many chunks the first `count` trials are summed up in.
pub(super) fn chunks_of(count: u64) -> u64 {
    count.div_ceil(BLOCK as u64).div_ceil(batch_blocks(count))
}

/// Accumulates all trials, chunk by chunk on all threads; the chunks come back in order, with the sums
/// of all together.
fn accumulate_all(
    trials: &RowTrials,
    count: u64,
    plans: &[Plan],
    control: &Control<'_>,
) -> (Vec<Accumulated>, Totals) {
    let mut chunks: Vec<Accumulated> = Vec::new();
    let mut totals = Totals::new(chunks_of(count));
    for wave in waves(0..chunks_of(count), plans.len()) {
        let first = wave.start as u64;
        let mut wave = accumulate_chunks(trials, count, wave, plans, control);
        for (number, accumulated) in (first..).zip(&mut wave) {
            totals.take_chunk(number, sums_of(accumulated));
        }
        chunks.extend(wave);
    }
    totals.close();
    (chunks, totals)
}

/// The sums of a chunk, which are then no longer there.
pub(super) fn sums_of(chunk: &mut Accumulated) -> ChunkSums {
    let outputs = chunk.outputs.iter_mut().map(|output| std::mem::take(&mut output.sums));
    ChunkSums { trials: chunk.trials, outputs: outputs.collect() }
}

/// Accumulates some of the chunks of the first `count` trials, on all threads.
pub(super) fn accumulate_chunks(
    trials: &RowTrials,
    count: u64,
    chunks: Range<usize>,
    plans: &[Plan],
    control: &Control<'_>,
) -> Vec<Accumulated> {
    let accumulate = |workspace: &mut Workspace, number: usize| {
        accumulate_chunk(trials, count, plans, control, workspace, number as u64)
    };
    parallel::map_with(chunks, || trials.workspace(), accumulate)
}

/// Accumulates one chunk of the first `count` trials.
fn accumulate_chunk(
    trials: &RowTrials,
    count: u64,
    plans: &[Plan],
    control: &Control<'_>,
    workspace: &mut Workspace,
    number: u64,
) -> Accumulated {
    let (path, chunk) = (control.path, batch_blocks(count));
    let own = number * chunk..((number + 1) * chunk).min(count.div_ceil(BLOCK as u64));
    let mut accumulated = Accumulated::new(plans, (own.end - own.start) * BLOCK as u64);
    for block in own {
        if control.is_stopped() {
            break;
        }
        let wanted = trials_in(block, count);
        if wanted == BLOCK && trials.condensed.add(path, block, plans, &mut accumulated) {
            control.advance(wanted as u64);
            continue;
        }
        trials.block(path, block, workspace);
        let values = &mut workspace.outputs;
        let (count, first) = drop_undefined(path, values, wanted);
        if let Some(first) = first {
            accumulated.undefined += (wanted - count) as u64;
            accumulated.first_undefined = accumulated.first_undefined.or(Some((block, first)));
        }
        path.run(AccumulateKernel { path, values, count, plans, accumulated: &mut accumulated });
        control.advance(wanted as u64);
    }
    // the room that was reserved for more would stay for the whole run; the next chunk takes it
    for output in &mut accumulated.outputs {
        output.kept.shrink_to_fit();
    }
    accumulated
}

/// The figures from the chunks; `None` if a window missed a value that is needed.
pub(super) fn finish(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
    mut chunks: Vec<Accumulated>,
    totals: &Totals,
    scatters: &mut [Option<ShortestScatter>],
) -> Option<Finished> {
    let undefined = undefined(trials, control.path, &chunks);
    let stopped = control.is_stopped();
    let count: u64 = chunks.iter().map(|chunk| chunk.trials).sum();
    if count == 0 {
        return Some(Finished { undefined, stopped, ..Finished::default() });
    }
    let moments = plans.iter().enumerate();
    let moments: Vec<Moments> =
        moments.map(|(output, plan)| totals.moments(output, plan.reference)).collect();
    let correlations = totals.correlations();
    let correlation_errors = totals.correlation_errors(&correlations);
    let mut per_output: Vec<Vec<Batch>> = (0..plans.len()).map(|_| Vec::new()).collect();
    for chunk in &mut chunks {
        for (batches, output) in per_output.iter_mut().zip(&mut chunk.outputs) {
            batches.push(Batch {
                trials: chunk.trials,
                below_median: output.below_median,
                kept: std::mem::take(&mut output.kept),
            });
        }
    }
    let path = control.path;
    // one output after the other: sorting copies, and memory is for one copy at a time
    let outputs: Vec<Option<MonteCarlo>> = per_output
        .into_iter()
        .enumerate()
        .zip(scatters)
        .map(|((o, chunks), scatter)| {
            let dof = request.moment_order.get(o).copied().unwrap_or(f64::INFINITY);
            let (p, windows) = (request.probability, &plans[o].windows);
            figures(path, moments[o], dof, p, windows, chunks, scatter)
        })
        .collect();
    let outputs = outputs.into_iter().collect::<Option<Vec<_>>>()?;
    let correlation_errors = of_moments(correlation_errors, &outputs);
    Some(Finished { trials: count, outputs, correlations, correlation_errors, undefined, stopped })
}

fn undefined(trials: &RowTrials, path: CodePath, chunks: &[Accumulated]) -> Option<Undefined> {
    let (block, trial) = chunks.iter().find_map(|chunk| chunk.first_undefined)?;
    let count = chunks.iter().map(|chunk| chunk.undefined).sum();
    let defined: u64 = chunks.iter().map(|chunk| chunk.trials).sum();
    Some(Undefined { count, trials: defined + count, first: trials.inputs_of(path, block, trial) })
}

/// Kept values of some consecutive trials of one output.
struct Batch {
    trials: u64,
    below_median: u64,
    kept: Vec<f64>,
}

/// The order statistics of some batches together.
fn order_of(path: CodePath, batches: &[Batch], windows: &Windows) -> Order {
    let sum = |count: fn(&Batch) -> u64| batches.iter().map(count).sum();
    let kept: Vec<&[f64]> = batches.iter().map(|batch| batch.kept.as_slice()).collect();
    Order::new(path, sum(|b| b.trials), &kept, sum(|b| b.below_median), windows)
}

fn figures(
    path: CodePath,
    moments: Moments,
    moment_order: f64,
    probability: f64,
    windows: &Windows,
    chunks: Vec<Batch>,
    scatter: &mut Option<ShortestScatter>,
) -> Option<MonteCarlo> {
    let (found, mut order) = rayon::join(
        || scatter.unwrap_or_else(|| shortest_scatter(path, &chunks, probability, windows)),
        || order_of(path, &chunks, windows),
    );
    drop(chunks);
    *scatter = Some(found);
    let order = &mut order;
    let symmetric_interval = symmetric(order, probability)?;
    let (shortest_interval, _) = shortest(order, probability)?;
    let median = order.median()?;
    let ranks = Ranks::new(order.trials, probability);
    let upper = (ranks.r + ranks.q).min(order.trials);
    let quantile_errors = [
        quantile_error(order, ranks.r)?,
        quantile_error(order, upper)?,
        quantile_error(order, order.trials.div_ceil(2))?,
    ];
    // with so few trials the shortest interval, too, is that of the extremes
    let few = is_extreme(order.trials, ranks.r);
    let shortest_error = if few { [f64::NAN; 2] } else { found.errors };
    let extremes = [order.get(1)?, order.get(order.trials)?];
    let errors =
        NumericalError::new(&moments, moment_order, quantile_errors, shortest_error, extremes);
    let intervals = Intervals {
        symmetric: symmetric_interval,
        shortest: shortest_interval,
        exact: true,
        unique: found.unique,
    };
    Some(MonteCarlo::new(&moments, extremes, moment_order, median, intervals, errors))
}

/// How the shortest intervals of the first batches scatter.
fn shortest_scatter(
    path: CodePath,
    chunks: &[Batch],
    probability: f64,
    windows: &Windows,
) -> ShortestScatter {
    let total = chunks.iter().map(|chunk| chunk.trials).sum();
    let order = |number: u64| order_of(path, &chunks[number as usize..][..1], windows);
    let numbers = 0..chunks.len().min(BATCHES) as u64;
    let numbers = numbers.filter(|number| chunks[*number as usize].trials > 0);
    let of_number = |number| BatchInterval::of(&mut order(number), probability, number);
    let intervals = parallel::map(numbers, of_number).into_iter().flatten().collect();
    let near = |batches: &[BatchInterval], end: usize| {
        let of_batch =
            |interval: &BatchInterval| interval.nearest(&mut order(interval.number()), end);
        parallel::map(batches, of_batch)
    };
    ShortestScatter::of(intervals, total, near)
}
