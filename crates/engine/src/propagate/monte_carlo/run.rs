//! A Monte Carlo run of one row: pilot, main pass, figures.

use rayon::prelude::*;

use super::accumulate::{AccumulateKernel, Accumulated, drop_undefined};
use super::block::{RowTrials, Workspace};
use super::figures::{Finished, MonteCarlo, NumericalError, Undefined};
use super::interval::{Ranks, is_extreme, quantile_error, shortest, symmetric};
use super::moments::{Moments, correlations};
use super::order::Order;
use super::pilot::{KEEP_ALL_MARGIN, pilot_blocks, plans};
use super::plan::Plan;
use super::products::{Products, waves};
use super::request::{Request, trials_in};
use super::several_pass;
use super::sums::Sums;
use super::windows::Windows;
use crate::distribution::BLOCK;
use crate::number::{CodePath, elementary};
use crate::propagate::Control;

/// Batches whose scatter gives the numerical standard error of the shortest interval.
const BATCHES: usize = 32;

/// Blocks that a thread works on at a time, at most.
const LARGEST_CHUNK: u64 = 64;

/// Runs the trials of one row. Where every trial is undefined, or the run was stopped before the
/// first one, there are no outputs.
pub(crate) fn run(trials: &mut RowTrials, request: Request<'_>, control: &Control<'_>) -> Finished {
    // what the pilot computes is not computed again
    trials.hold(control.path, pilot_blocks(request.trials), control.memory);
    run_held(trials, request, control)
}

fn run_held(trials: &RowTrials, request: Request<'_>, control: &Control<'_>) -> Finished {
    let mut margin = 1.0;
    loop {
        let plans = plans(trials, request, control, margin);
        if kept_bytes(&plans, request) > control.memory {
            return run_in_passes(trials, request, control, &plans);
        }
        let (chunks, products) = accumulate_all(trials, request.trials, &plans, control);
        if let Some(finished) = finish(trials, request, control, &plans, chunks, &products) {
            return finished;
        }
        // a tail came out short: wider windows, in the end everything, which cannot come out short
        debug_assert!(margin <= KEEP_ALL_MARGIN);
        margin *= 4.0;
    }
}

/// The memory that the kept values of all outputs would take.
fn kept_bytes(plans: &[Plan], request: Request<'_>) -> usize {
    let share: f64 = plans.iter().map(|plan| plan.kept).sum();
    (8.0 * share * request.trials as f64) as usize
}

/// A run in bounded memory. A run of its first trials tells how far the shortest interval scatters,
/// and is what is handed back if the user stops the whole before it has come farther.
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
    let law = elementary::cbrt(part as f64 / request.trials as f64);
    let errors: Vec<[f64; 2]> = first
        .outputs
        .iter()
        .map(|output| output.errors.shortest_interval.map(|error| law * error))
        .collect();
    let whole = several_pass::run(trials, request, control, plans, &errors);
    match whole.filter(|whole| !whole.stopped || whole.trials > first.trials) {
        Some(whole) => whole,
        None => {
            first.stopped = true;
            first
        }
    }
}

/// Accumulates all trials, chunk by chunk on all threads; the chunks come back in order, with the sums of
/// products of all together.
fn accumulate_all(
    trials: &RowTrials,
    count: u64,
    plans: &[Plan],
    control: &Control<'_>,
) -> (Vec<Accumulated>, Products) {
    let blocks = count.div_ceil(BLOCK as u64);
    let chunk = blocks.div_ceil(BATCHES as u64).clamp(1, LARGEST_CHUNK);
    let path = control.path;
    let accumulate_chunk = |workspace: &mut Workspace, number: u64| {
        let own = number * chunk..((number + 1) * chunk).min(blocks);
        let mut accumulated = Accumulated::new(plans, (own.end - own.start) * BLOCK as u64);
        for block in own {
            if control.is_stopped() {
                break;
            }
            trials.block(control.path, block, workspace);
            let values = &mut workspace.outputs;
            let wanted = trials_in(block, count);
            let (count, first) = drop_undefined(path, values, wanted);
            if let Some(first) = first {
                accumulated.undefined += (wanted - count) as u64;
                accumulated.first_undefined = accumulated.first_undefined.or(Some((block, first)));
            }
            path.run(AccumulateKernel {
                path,
                values,
                count,
                plans,
                accumulated: &mut accumulated,
            });
            control.advance(wanted as u64);
        }
        accumulated
    };
    let mut chunks: Vec<Accumulated> = Vec::new();
    let mut products = Products::new(plans.len());
    for wave in waves(blocks.div_ceil(chunk), plans.len()) {
        let wave = wave.into_par_iter().map(|number| number as u64);
        let wave = wave.map_init(|| trials.workspace(), accumulate_chunk);
        let mut wave: Vec<Accumulated> = wave.collect();
        for accumulated in &mut wave {
            products.take(accumulated.outputs.iter_mut().map(|output| &mut output.sums));
        }
        chunks.extend(wave);
    }
    (chunks, products)
}

/// The figures from the chunks; `None` if a window missed a value that is needed.
fn finish(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
    mut chunks: Vec<Accumulated>,
    products: &Products,
) -> Option<Finished> {
    let undefined = undefined(trials, control.path, &chunks);
    let stopped = control.is_stopped();
    let count: u64 = chunks.iter().map(|chunk| chunk.trials).sum();
    if count == 0 {
        let (outputs, correlations) = (Vec::new(), Vec::new());
        return Some(Finished { trials: 0, outputs, correlations, undefined, stopped });
    }
    let summaries: Vec<(Moments, Sums)> = plans
        .iter()
        .enumerate()
        .map(|(output, plan)| {
            let parts = chunks.iter().filter(|chunk| chunk.trials > 0);
            let parts = parts.map(|chunk| (chunk.trials, &chunk.outputs[output].sums));
            Moments::of_parts(parts, plan.reference)
        })
        .collect();
    let totals: Vec<&Sums> = summaries.iter().map(|(_, total)| total).collect();
    let correlations = correlations(count, &totals, products);
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
        .map(|(o, chunks)| {
            let dof = request.drawn_dof.get(o).copied().unwrap_or(f64::INFINITY);
            figures(path, summaries[o].0, dof, request.probability, &plans[o].windows, chunks)
        })
        .collect();
    let outputs = outputs.into_iter().collect::<Option<Vec<_>>>()?;
    Some(Finished { trials: count, outputs, correlations, undefined, stopped })
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
    let sum = |of: fn(&Batch) -> u64| batches.iter().map(of).sum();
    let kept: Vec<&[f64]> = batches.iter().map(|batch| batch.kept.as_slice()).collect();
    Order::new(path, sum(|b| b.trials), &kept, sum(|b| b.below_median), windows)
}

fn figures(
    path: CodePath,
    moments: Moments,
    drawn_dof: f64,
    probability: f64,
    windows: &Windows,
    chunks: Vec<Batch>,
) -> Option<MonteCarlo> {
    let (shortest_error, mut order) = rayon::join(
        || shortest_error(path, &chunks, probability, windows),
        || order_of(path, &chunks, windows),
    );
    drop(chunks);
    let order = &mut order;
    let symmetric_interval = symmetric(order, probability)?;
    let shortest_interval = shortest(order, probability)?;
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
    let shortest_error = if few { [f64::NAN; 2] } else { shortest_error };
    let errors = NumericalError::new(&moments, drawn_dof, quantile_errors, shortest_error);
    let intervals = (symmetric_interval, shortest_interval, true);
    Some(MonteCarlo::new(&moments, drawn_dof, median, intervals, errors))
}

/// The scatter of the shortest interval between batches of the trials, brought to the number of
/// all trials by the cube-root law of such intervals (Kim and Pollard, Annals of Statistics 18,
/// 1990).
fn shortest_error(
    path: CodePath,
    chunks: &[Batch],
    probability: f64,
    windows: &Windows,
) -> [f64; 2] {
    let batches: Vec<&[Batch]> = chunks.chunks(chunks.len().div_ceil(BATCHES).max(1)).collect();
    let trials = |batch: &[Batch]| batch.iter().map(|chunk| chunk.trials).sum::<u64>();
    let total: u64 = batches.iter().map(|batch| trials(batch)).sum();
    let largest = batches.iter().map(|batch| trials(batch)).max().unwrap_or(0);
    let ends: Vec<[f64; 2]> = batches
        .into_par_iter()
        // a last batch of few trials would scatter more than the others
        .filter(|batch| 2 * trials(batch) > largest)
        .filter_map(|batch| shortest(&mut order_of(path, batch, windows), probability))
        .collect();
    let n = ends.len() as f64;
    if ends.len() < 4 {
        return [f64::NAN; 2];
    }
    let law = elementary::cbrt(largest as f64 / total as f64);
    [0, 1].map(|end| {
        let mean = ends.iter().map(|e| e[end]).sum::<f64>() / n;
        let squares: f64 = ends.iter().map(|e| (e[end] - mean).powi(2)).sum();
        law * (squares / (n - 1.0)).sqrt()
    })
}
