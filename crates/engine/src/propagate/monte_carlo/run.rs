//! A Monte Carlo run of one row: pilot, main pass, figures.

use std::ops::Range;

use rayon::prelude::*;

use super::adaptive::Adaptive;
use super::block::{Trials, Workspace};
use super::capped;
use super::fold::{FoldKernel, Folded, Plan, drop_undefined};
use super::interval::{Ranks, is_extreme, quantile_error, shortest, symmetric};
use super::moments::{Moments, Reference, Sums, correlations};
use super::order::Order;
use super::products::{Products, waves};
use super::shelves::Shelves;
use super::windows::Windows;
use crate::distribution::BLOCK;
use crate::number::{CodePath, elementary};
use crate::propagate::Control;

/// Blocks of the pilot of a long run.
const PILOT_BLOCKS: u64 = 16;

/// Blocks of the pilot of a short one, where a longer pilot would cost more than narrower windows
/// save.
const SHORT_PILOT: u64 = 4;

/// From so many trials on a run is long.
const LONG: u64 = 1_000_000;

/// Up to so many trials all values are kept.
const ALL_KEPT: u64 = 1 << 16;

/// Outputs whose pilot values are held at a time: 64 MiB.
const PILOT_OUTPUTS: usize = (64 << 20) / (8 * BLOCK * PILOT_BLOCKS as usize);

/// Batches whose scatter gives the numerical standard error of the shortest interval.
const BATCHES: usize = 32;

/// Windows wider than this many times the first ones keep everything.
const KEEP_ALL_MARGIN: f64 = 20.0;

/// Blocks that a thread works on at a time, at most.
const LARGEST_CHUNK: u64 = 64;

/// One output's figures from the trials.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MonteCarlo {
    /// Number of trials behind the figures.
    pub trials: u64,
    /// Mean of the trials.
    pub estimate: f64,
    /// Standard deviation of the trials; `None` if the distribution has none, or of a single trial.
    pub standard_uncertainty: Option<f64>,
    /// Median of the trials.
    pub median: f64,
    /// Probabilistically symmetric coverage interval.
    pub symmetric_interval: [f64; 2],
    /// Shortest coverage interval.
    pub shortest_interval: [f64; 2],
    /// Whether the shortest interval is exactly that of the trials.
    pub shortest_exact: bool,
    /// Skewness; `None` if the distribution has none, or if all trials are equal.
    pub skewness: Option<f64>,
    /// Excess kurtosis; `None` as for the skewness.
    pub excess_kurtosis: Option<f64>,
    /// Numerical standard errors.
    pub errors: NumericalError,
    /// Share of the trials within the output's tolerance limits; 1 where it has none.
    pub inside: f64,
    /// How the adaptive procedure ended, if the number of trials was found by it.
    pub adaptive: Option<Adaptive>,
}

/// How far the finite number of trials lets each figure scatter: one standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumericalError {
    /// Of the estimate; `None` if the distribution has no standard deviation.
    pub estimate: Option<f64>,
    /// Of the standard uncertainty; `None` if the distribution has no fourth moment.
    pub standard_uncertainty: Option<f64>,
    /// Of the median; not a number of two trials.
    pub median: f64,
    /// Of the ends of the symmetric interval; not a number where they are the least and the greatest
    /// trial, because there are too few.
    pub symmetric_interval: [f64; 2],
    /// Of the ends of the shortest interval, which settles only with the cube root of the trials;
    /// not a number with too few trials to tell.
    pub shortest_interval: [f64; 2],
    /// Of the skewness; `None` if there is none, or with too few trials to tell.
    pub skewness: Option<f64>,
    /// Of the excess kurtosis; `None` as for the skewness.
    pub excess_kurtosis: Option<f64>,
}

/// Trials whose outputs were not all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Undefined {
    /// How many there were.
    pub count: u64,
    /// Out of how many.
    pub trials: u64,
    /// The drawn values of the varying inputs in the first such trial, in order.
    pub first: Vec<f64>,
}

/// What a run of one row gives.
#[derive(Clone, Debug)]
pub(crate) struct Finished {
    /// Trials behind the figures.
    pub(crate) trials: u64,
    /// One entry for each output.
    pub outputs: Vec<MonteCarlo>,
    /// Correlation coefficients of the outputs i < j.
    pub(crate) correlations: Vec<f64>,
    /// Trials that were left out.
    pub(crate) undefined: Option<Undefined>,
    /// Whether the run was stopped early.
    pub(crate) stopped: bool,
}

/// What a run needs beside its trials.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request<'a> {
    /// Number of trials.
    pub(crate) trials: u64,
    /// Coverage probability.
    pub(crate) probability: f64,
    /// For each output the fewest degrees of freedom among the t distributions that it depends on:
    /// moments of that order and above do not exist.
    pub(crate) drawn_dof: &'a [f64],
}

/// Runs the trials of one row. Where every trial is undefined, or the run was stopped before the
/// first one, there are no outputs.
pub fn run(trials: &mut Trials, request: Request<'_>, control: &Control<'_>) -> Finished {
    // what the pilot computes is not computed again
    trials.hold(control.path, pilot_blocks(request.trials), control.memory);
    run_held(trials, request, control)
}

fn run_held(trials: &Trials, request: Request<'_>, control: &Control<'_>) -> Finished {
    let mut margin = 1.0;
    loop {
        let plans = plans(trials, request, control, margin);
        if kept_bytes(&plans, request) > control.memory {
            return run_capped(trials, request, control, &plans);
        }
        let (chunks, products) = fold_all(trials, request.trials, &plans, control);
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
/// and is what is handed back if the user stops the whole.
fn run_capped(
    trials: &Trials,
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
    capped::run(trials, request, control, plans, &errors).unwrap_or_else(|| {
        first.stopped = true;
        first
    })
}

/// The blocks of the pilot of a run.
fn pilot_blocks(trials: u64) -> u64 {
    let most = if trials >= LONG { PILOT_BLOCKS } else { SHORT_PILOT };
    trials.div_ceil(BLOCK as u64).min(most)
}

/// The values of some outputs in the first blocks.
fn pilot(
    trials: &Trials,
    request: Request<'_>,
    control: &Control<'_>,
    outputs: Range<usize>,
) -> Vec<Vec<f64>> {
    let blocks = pilot_blocks(request.trials);
    let mut workspace = trials.workspace();
    let mut pilot: Vec<Vec<f64>> = vec![Vec::new(); outputs.len()];
    for block in 0..blocks {
        let count = trials_in(block, request.trials);
        trials.block(control.path, block, &mut workspace);
        let (count, _) = drop_undefined(control.path, &mut workspace.outputs, count);
        for (values, out) in pilot.iter_mut().zip(workspace.outputs.iter().skip(outputs.start)) {
            values.extend_from_slice(&out[..count]);
        }
    }
    pilot
}

/// References and windows from the first blocks.
pub(super) fn plans(
    trials: &Trials,
    request: Request<'_>,
    control: &Control<'_>,
    margin: f64,
) -> Vec<Plan> {
    let groups = (0..trials.outputs()).step_by(PILOT_OUTPUTS);
    let groups = groups.map(|first| first..(first + PILOT_OUTPUTS).min(trials.outputs()));
    groups
        .flat_map(|group| group.clone().zip(pilot(trials, request, control, group)))
        .map(|(output, values)| {
            let mut order = Shelves::new(control.path, &[&values], &Windows::ALL);
            let mut at = |place: usize| (place < values.len()).then(|| order.at(place));
            let reference = reference(values.len(), &mut at, trials.limits(output));
            let all = request.trials <= ALL_KEPT || margin > KEEP_ALL_MARGIN;
            let windows = if all {
                Windows::ALL
            } else {
                Windows::from_pilot(values.len(), at, request.probability, margin)
            };
            let kept = values.iter().filter(|v| windows.keeps(**v)).count() as f64;
            Plan { reference, windows, kept: kept / values.len().max(1) as f64 }
        })
        .collect()
}

/// The median and a width of `count` values, `at` a place in their order: half the distance of the
/// quartiles, or what is there.
fn reference(
    count: usize,
    at: &mut impl FnMut(usize) -> Option<f64>,
    limits: [f64; 2],
) -> Reference {
    let mut share = |share: f64| at((share * count as f64) as usize);
    let middle = share(0.5).unwrap_or(0.0);
    let quartiles = share(0.25).zip(share(0.75));
    let widths = [quartiles, at(0).zip(at(count.saturating_sub(1)))];
    let scale = widths
        .into_iter()
        .flatten()
        .map(|(low, high)| 0.5 * high - 0.5 * low)
        .find(|width| *width > 0.0)
        .unwrap_or(1.0);
    Reference { middle, scale, limits }
}

/// How many of the first `trials` trials lie in a block.
pub(super) fn trials_in(block: u64, trials: u64) -> usize {
    trials.saturating_sub(block * BLOCK as u64).min(BLOCK as u64) as usize
}

/// Folds all trials, chunk by chunk on all threads; the chunks come back in order, with the sums of
/// products of all together.
fn fold_all(
    trials: &Trials,
    count: u64,
    plans: &[Plan],
    control: &Control<'_>,
) -> (Vec<Folded>, Products) {
    let blocks = count.div_ceil(BLOCK as u64);
    let chunk = blocks.div_ceil(BATCHES as u64).clamp(1, LARGEST_CHUNK);
    let path = control.path;
    let fold_chunk = |workspace: &mut Workspace, number: u64| {
        let own = number * chunk..((number + 1) * chunk).min(blocks);
        let mut folded = Folded::new(plans, (own.end - own.start) * BLOCK as u64);
        for block in own {
            if control.is_stopped() {
                break;
            }
            trials.block(control.path, block, workspace);
            let values = &mut workspace.outputs;
            let wanted = trials_in(block, count);
            let (count, first) = drop_undefined(path, values, wanted);
            if let Some(first) = first {
                folded.undefined += (wanted - count) as u64;
                folded.first_undefined = folded.first_undefined.or(Some((block, first)));
            }
            path.run(FoldKernel { path, values, count, plans, folded: &mut folded });
            control.advance(wanted as u64);
        }
        folded
    };
    let mut chunks: Vec<Folded> = Vec::new();
    let mut products = Products::new(plans.len());
    for wave in waves(blocks.div_ceil(chunk), plans.len()) {
        let wave = wave.into_par_iter().map(|number| number as u64);
        let wave = wave.map_init(|| trials.workspace(), fold_chunk);
        let mut wave: Vec<Folded> = wave.collect();
        for folded in &mut wave {
            products.take(folded.outputs.iter_mut().map(|output| &mut output.sums));
        }
        chunks.extend(wave);
    }
    (chunks, products)
}

/// The figures from the folded chunks; `None` if a window missed a value that is needed.
fn finish(
    trials: &Trials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
    mut chunks: Vec<Folded>,
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

fn undefined(trials: &Trials, path: CodePath, chunks: &[Folded]) -> Option<Undefined> {
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

impl MonteCarlo {
    /// The figures, without the moments that do not exist for t distributions of `drawn_dof`
    /// degrees of freedom. The intervals are the symmetric one, the shortest one and whether that
    /// is exact.
    pub fn new(
        moments: &Moments,
        drawn_dof: f64,
        median: f64,
        intervals: ([f64; 2], [f64; 2], bool),
        errors: NumericalError,
    ) -> Self {
        let spread = moments.std > 0.0;
        // a single trial does not scatter
        let several = moments.trials > 1.0;
        Self {
            trials: moments.trials as u64,
            estimate: moments.mean,
            standard_uncertainty: (drawn_dof > 2.0 && several).then_some(moments.std),
            median,
            symmetric_interval: intervals.0,
            shortest_interval: intervals.1,
            shortest_exact: intervals.2,
            inside: moments.inside,
            adaptive: None,
            skewness: (drawn_dof > 3.0 && spread).then_some(moments.skewness),
            excess_kurtosis: (drawn_dof > 4.0 && spread).then_some(moments.excess_kurtosis),
            errors,
        }
    }
}

impl NumericalError {
    /// The errors, `quantiles` being those of the lower end, the upper end and the median.
    pub fn new(
        moments: &Moments,
        drawn_dof: f64,
        quantiles: [f64; 3],
        shortest_interval: [f64; 2],
    ) -> Self {
        let [low, high, median] = quantiles;
        let shape = |order: f64, which: usize| {
            let exists = drawn_dof > order && moments.std > 0.0;
            moments.shape_errors.filter(|_| exists).map(|errors| errors[which])
        };
        let several = moments.trials > 1.0;
        Self {
            estimate: (drawn_dof > 2.0 && several).then(|| moments.mean_error()),
            standard_uncertainty: (drawn_dof > 4.0 && several).then(|| moments.std_error()),
            median,
            symmetric_interval: [low, high],
            shortest_interval,
            // the variance of the third moment is of sixth order, that of the fourth of eighth
            skewness: shape(6.0, 0),
            excess_kurtosis: shape(8.0, 1),
        }
    }
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
