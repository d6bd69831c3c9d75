//! One pass over all trials in bounded memory: values are counted in the cells of a partition, and
//! those in the cells that are wanted are kept.

use std::ops::Range;

use rayon::prelude::*;

use super::accumulate::drop_undefined;
use super::block::RowTrials;
use super::partition::{Leaf, Partition, PassTally};
use super::plan::Plan;
use super::products::{self, waves};
use super::request::trials_in;
use super::run::chunks_of;
use super::shortest_scatter::batch_blocks;
use super::sums::Sums;
use super::totals::{ChunkSums, SumTree, Totals};
use crate::distribution::BLOCK;
use crate::number::{CodePath, Kernel};
use crate::propagate::Control;

/// What one pass over some chunks of the trials gives.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) trials: u64,
    pub(super) undefined: u64,
    pub(super) first_undefined: Option<(u64, usize)>,
    pub(super) sums: SumTree,
    pub(super) tallies: Vec<PassTally>,
}

/// What one pass over all trials gives.
#[derive(Debug)]
pub(super) struct Pass {
    pub(super) trials: u64,
    pub(super) undefined: u64,
    pub(super) first_undefined: Option<(u64, usize)>,
    pub(super) totals: Totals,
    pub(super) tallies: Vec<PassTally>,
    /// Whether the run was stopped meanwhile; all of the other figures are of the trials until then.
    pub(super) stopped: bool,
}

/// Adds a block's moments.
struct SumKernel<'a> {
    path: CodePath,
    values: &'a [[f64; BLOCK]],
    count: usize,
    plans: &'a [Plan],
    sums: &'a mut [Sums],
}

impl Kernel for SumKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, values, count, plans, sums } = self;
        for ((plan, sums), values) in plans.iter().zip(sums.iter_mut()).zip(values) {
            sums.add(path, &values[..count], plan.reference);
        }
        products::add(path, values, count, plans, sums.iter_mut());
    }
}

/// The cells of the first pass: the quartiles lie one scale from the middle, and fifteen of them
/// hold nearly all values of most shapes.
pub(super) fn first_partitions(plans: &[Plan]) -> Vec<Partition> {
    let references = plans.iter().map(|plan| (plan.reference.middle, plan.reference.scale));
    references
        .map(|(middle, scale)| Partition::new(middle - 15.0 * scale, middle + 15.0 * scale))
        .collect()
}

/// How many values of each output may be kept: half of the memory, as the threads' values are
/// copied when they are put together.
pub(super) fn kept_budget(plans: &[Plan], control: &Control<'_>) -> usize {
    control.memory / 16 / plans.len().max(1)
}

/// Decides which leaves to keep and which to split, within the budget of kept values.
pub(super) fn narrow(partition: &mut Partition, leaves: &[Leaf], needed: &[bool], budget: usize) {
    let wanted: Vec<usize> = (0..leaves.len()).filter(|&l| needed[l]).collect();
    let total: u64 = wanted.iter().map(|&l| leaves[l].count).sum();
    let parts = (1 << 16) / wanted.len().max(1);
    let parts = parts.clamp(16, 4096);
    let share = (budget / wanted.len().max(1)) as u64;
    let splits = |l: usize| total > budget as u64 && leaves[l].count > share;
    partition.refine(
        leaves,
        |l| needed[l] && !splits(l),
        |l| if needed[l] && splits(l) { parts } else { 0 },
    );
}

/// What a pass looks at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look<'a> {
    /// So many of the first trials.
    pub(super) count: u64,
    pub(super) plans: &'a [Plan],
    /// In which cells the values of each output are counted.
    pub(super) partitions: &'a [Partition],
    /// Whether moments are taken too.
    pub(super) with_sums: bool,
}

impl Look<'_> {
    /// Outputs whose products are summed up.
    fn summed(&self) -> usize {
        if self.with_sums { self.plans.len() } else { 0 }
    }

    /// The chunks of all trials: those of a run that holds its tails, so that sums have the same
    /// bits.
    pub(super) fn chunks(&self) -> u64 {
        chunks_of(self.count)
    }

    /// Nothing yet.
    pub(super) fn empty(&self) -> Stretch {
        Stretch {
            trials: 0,
            undefined: 0,
            first_undefined: None,
            sums: SumTree::new(self.chunks()),
            tallies: self.partitions.iter().map(Partition::tally).collect(),
        }
    }
}

/// Goes once over all trials, as far as the run is not stopped.
pub(super) fn pass(trials: &RowTrials, look: Look<'_>, control: &Control<'_>) -> Pass {
    let mut whole = Pass::empty(look);
    for wave in waves(0..look.chunks(), look.summed()) {
        whole.take(stretch_of(trials, look, wave, control));
        if control.is_stopped() {
            break;
        }
    }
    whole.totals.close();
    whole.stopped = control.is_stopped();
    whole
}

/// Goes once over some chunks of the trials, as far as the run is not stopped.
pub(super) fn stretch(
    trials: &RowTrials,
    look: Look<'_>,
    chunks: Range<u64>,
    control: &Control<'_>,
) -> Stretch {
    let mut all = look.empty();
    for wave in waves(chunks, look.summed()) {
        all.add(stretch_of(trials, look, wave, control));
    }
    all
}

fn stretch_of(
    trials: &RowTrials,
    look: Look<'_>,
    chunks: Range<usize>,
    control: &Control<'_>,
) -> Stretch {
    let Look { count, plans, partitions, with_sums } = look;
    let blocks = count.div_ceil(BLOCK as u64);
    let chunk_blocks = batch_blocks(count);
    let found = chunks.into_par_iter().with_min_len(16).fold(
        || (look.empty(), trials.workspace()),
        |(mut found, mut workspace), chunk| {
            if control.is_stopped() {
                return (found, workspace);
            }
            let chunk = chunk as u64;
            let mut sums = vec![Sums::default(); plans.len()];
            let before = found.trials;
            for block in chunk * chunk_blocks..((chunk + 1) * chunk_blocks).min(blocks) {
                if control.is_stopped() {
                    break;
                }
                trials.block(control.path, block, &mut workspace);
                let wanted = trials_in(block, count);
                let (left, first) = drop_undefined(control.path, &mut workspace.outputs, wanted);
                if let Some(first) = first {
                    found.undefined += (wanted - left) as u64;
                    let place = (block, first);
                    let earlier = found.first_undefined.unwrap_or(place);
                    found.first_undefined = Some(earlier.min(place));
                }
                let values = &workspace.outputs;
                if with_sums {
                    let sums = &mut sums[..];
                    let path = control.path;
                    path.run(SumKernel { path, values, count: left, plans, sums });
                    control.advance(wanted as u64);
                }
                found.trials += left as u64;
                for ((tally, partition), v) in found.tallies.iter_mut().zip(partitions).zip(values)
                {
                    tally.add(partition, &v[..left]);
                }
            }
            if with_sums {
                let sums = ChunkSums { trials: found.trials - before, outputs: sums };
                found.sums.insert(chunk, 1, sums);
            }
            (found, workspace)
        },
    );
    found.map(|(found, _)| found).reduce(
        || look.empty(),
        |mut a, b| {
            a.add(b);
            a
        },
    )
}

/// The earlier of two trials.
fn earlier(a: Option<(u64, usize)>, b: Option<(u64, usize)>) -> Option<(u64, usize)> {
    match (a, b) {
        (Some(x), Some(y)) => Some(x.min(y)),
        (x, y) => x.or(y),
    }
}

fn merge(tallies: &mut [PassTally], others: Vec<PassTally>) {
    for (tally, other) in tallies.iter_mut().zip(others) {
        tally.merge(other);
    }
}

impl Stretch {
    /// Takes over what another part of the trials gave.
    fn add(&mut self, other: Self) {
        self.trials += other.trials;
        self.undefined += other.undefined;
        self.first_undefined = earlier(self.first_undefined, other.first_undefined);
        self.sums.merge(other.sums);
        merge(&mut self.tallies, other.tallies);
    }
}

impl Pass {
    /// Nothing yet.
    pub(super) fn empty(look: Look<'_>) -> Self {
        let Stretch { tallies, .. } = look.empty();
        let totals = Totals::new(look.chunks());
        Self { trials: 0, undefined: 0, first_undefined: None, totals, tallies, stopped: false }
    }

    /// Takes over what some chunks gave.
    pub(super) fn take(&mut self, found: Stretch) {
        self.trials += found.trials;
        self.undefined += found.undefined;
        self.first_undefined = earlier(self.first_undefined, found.first_undefined);
        self.totals.take(found.sums);
        merge(&mut self.tallies, found.tallies);
    }
}
