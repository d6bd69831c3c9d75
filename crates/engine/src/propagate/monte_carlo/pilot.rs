//! The pilot: the first blocks of a run tell where each output's values lie, how far they spread and
//! where the ends of its coverage intervals will be, so that the main pass keeps few values.

use std::ops::Range;

use super::accumulate::drop_undefined;
use super::block::RowTrials;
use super::bucket_partition::BucketPartition;
use super::plan::{Plan, Reference};
use super::request::{Request, trials_in};
use super::windows::Windows;
use crate::distribution::BLOCK;
use crate::propagate::Control;

/// Blocks of the pilot of a very long run, of which narrower windows keep a sixth less memory.
const VERY_LONG_PILOT: u64 = 64;

/// Blocks of the pilot of a long run.
const PILOT_BLOCKS: u64 = 16;

/// Blocks of the pilot of a short one, where a longer pilot would cost more than narrower windows
/// save. Of every run so many tell the reference about which sums are taken, so that a sum over some
/// trials is the same in a run of any length.
const SHORT_PILOT: u64 = 4;

/// From so many trials on a run is long.
const LONG: u64 = 1_000_000;

/// From so many trials on it is very long.
const VERY_LONG: u64 = 5_000_000;

/// Up to so many trials all values are kept.
const ALL_KEPT: u64 = 1 << 16;

/// Outputs whose pilot values are held at a time: 64 MiB.
const PILOT_OUTPUTS: usize = (64 << 20) / (8 * BLOCK * VERY_LONG_PILOT as usize);

/// Windows wider than this many times the first ones keep everything.
pub(super) const KEEP_ALL_MARGIN: f64 = 20.0;

/// The blocks of the longest pilot.
pub(super) const LONGEST_PILOT: u64 = VERY_LONG_PILOT;

/// The blocks of the pilot of a run.
pub(super) fn pilot_blocks(trials: u64) -> u64 {
    let most = match trials {
        VERY_LONG.. => VERY_LONG_PILOT,
        LONG.. => PILOT_BLOCKS,
        _ => SHORT_PILOT,
    };
    trials.div_ceil(BLOCK as u64).min(most)
}

/// The values of some outputs in the first blocks, and how many of them are those of a short pilot.
fn pilot(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    outputs: Range<usize>,
) -> (Vec<Vec<f64>>, usize) {
    let blocks = pilot_blocks(request.trials);
    let mut workspace = trials.workspace();
    let mut pilot: Vec<Vec<f64>> = vec![Vec::new(); outputs.len()];
    let mut of_short = 0;
    for block in 0..blocks {
        let count = trials_in(block, request.trials);
        trials.block(control.path, block, &mut workspace);
        let (count, _) = drop_undefined(control.path, &mut workspace.outputs, count);
        of_short += if block < SHORT_PILOT { count } else { 0 };
        for (values, out) in pilot.iter_mut().zip(workspace.outputs.iter().skip(outputs.start)) {
            values.extend_from_slice(&out[..count]);
        }
    }
    (pilot, of_short)
}

/// The plan of each output that is that of a run of any length up to so many trials: its reference,
/// with windows that hold those of all lengths.
pub(super) fn plans_of_any_length(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
) -> Vec<Plan> {
    let lengths = [ALL_KEPT + 1, LONG, VERY_LONG].into_iter();
    let lengths = lengths.filter(|&length| length <= request.trials.max(ALL_KEPT + 1));
    let of_length = |length| plans(trials, Request { trials: length, ..request }, control, 1.0);
    let joined = |mut all: Vec<Plan>, more: Vec<Plan>| {
        for (plan, more) in all.iter_mut().zip(more) {
            plan.windows = plan.windows.joined(&more.windows);
            plan.kept = plan.kept.max(more.kept);
        }
        all
    };
    lengths.map(of_length).reduce(joined).unwrap_or_default()
}

/// References and windows from the first blocks.
pub(super) fn plans(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    margin: f64,
) -> Vec<Plan> {
    let groups = (0..trials.outputs()).step_by(PILOT_OUTPUTS);
    let groups = groups.map(|first| first..(first + PILOT_OUTPUTS).min(trials.outputs()));
    groups
        .flat_map(|group| {
            let (values, of_short) = pilot(trials, request, control, group.clone());
            group.zip(values).map(move |(output, values)| (output, values, of_short))
        })
        .map(|(output, values, of_short)| {
            let partition =
                |values: &[f64]| BucketPartition::new(control.path, &[values], &Windows::ALL);
            let limits = trials.limits(output);
            let mut order = partition(&values);
            let reference = if of_short == values.len() {
                reference(of_short, &mut order, limits)
            } else {
                reference(of_short, &mut partition(&values[..of_short]), limits)
            };
            let at = |index: usize| (index < values.len()).then(|| order.at(index));
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

/// The median and a width of `count` values: half the distance of the quartiles, or what is there.
fn reference(count: usize, order: &mut BucketPartition, limits: [f64; 2]) -> Reference {
    let mut at = |index: usize| (index < count).then(|| order.at(index));
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
