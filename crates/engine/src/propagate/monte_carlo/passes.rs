//! One pass over all trials in bounded memory: values are counted in the cells of a partition, and
//! those in the cells that are wanted are kept.

use rayon::prelude::*;

use super::accumulate::drop_undefined;
use super::block::RowTrials;
use super::partition::{Leaf, Partition, Tally};
use super::plan::Plan;
use super::products::{self, Products, waves};
use super::request::trials_in;
use super::shortest_scatter::batch_blocks;
use super::sums::Sums;
use crate::distribution::BLOCK;
use crate::number::{CodePath, Kernel};
use crate::propagate::Control;

/// What one pass over all trials gives.
#[derive(Debug)]
pub(super) struct Pass {
    pub(super) trials: u64,
    pub(super) undefined: u64,
    pub(super) first_undefined: Option<(u64, usize)>,
    /// Sums of each chunk with its number and its trials, without the products.
    pub(super) sums: Vec<(u64, u64, Vec<Sums>)>,
    pub(super) products: Products,
    pub(super) tallies: Vec<Tally>,
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
        products::add(values, count, plans, sums.iter_mut());
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

/// Goes once over the first `count` trials, as far as the run is not stopped.
pub(super) fn pass(
    trials: &RowTrials,
    count: u64,
    control: &Control<'_>,
    plans: &[Plan],
    partitions: &[Partition],
    with_sums: bool,
) -> Pass {
    let blocks = count.div_ceil(BLOCK as u64);
    // the chunks of a run that holds its tails, so that sums have the same bits
    let chunk_blocks = batch_blocks(count);
    let chunks = blocks.div_ceil(chunk_blocks);
    let empty = || Pass {
        trials: 0,
        undefined: 0,
        first_undefined: None,
        sums: Vec::new(),
        products: Products::default(),
        tallies: partitions.iter().map(Partition::tally).collect(),
        stopped: false,
    };
    let mut whole = empty();
    whole.products = Products::new(if with_sums { plans.len() } else { 0 }, chunks);
    for wave in waves(chunks, if with_sums { plans.len() } else { 0 }) {
        let wave = wave.into_par_iter().with_min_len(16).fold(
            || (empty(), trials.workspace()),
            |(mut pass, mut workspace), chunk| {
                let chunk = chunk as u64;
                let mut sums = vec![Sums::default(); plans.len()];
                let before = pass.trials;
                for block in chunk * chunk_blocks..((chunk + 1) * chunk_blocks).min(blocks) {
                    if control.is_stopped() {
                        break;
                    }
                    trials.block(control.path, block, &mut workspace);
                    let wanted = trials_in(block, count);
                    let (left, first) =
                        drop_undefined(control.path, &mut workspace.outputs, wanted);
                    if let Some(first) = first {
                        pass.undefined += (wanted - left) as u64;
                        let found = (block, first);
                        let earlier = pass.first_undefined.unwrap_or(found);
                        pass.first_undefined = Some(earlier.min(found));
                    }
                    let values = &workspace.outputs;
                    if with_sums {
                        let sums = &mut sums[..];
                        let path = control.path;
                        path.run(SumKernel { path, values, count: left, plans, sums });
                        control.advance(wanted as u64);
                    }
                    pass.trials += left as u64;
                    for ((tally, partition), v) in
                        pass.tallies.iter_mut().zip(partitions).zip(values)
                    {
                        tally.add(partition, &v[..left]);
                    }
                }
                if with_sums {
                    pass.sums.push((chunk, pass.trials - before, sums));
                }
                (pass, workspace)
            },
        );
        let mut found = wave.map(|(pass, _)| pass).reduce(empty, |mut a, b| {
            a.add(b);
            a
        });
        found.sums.sort_by_key(|(chunk, ..)| *chunk);
        for (_, _, sums) in &mut found.sums {
            whole.products.take(sums.iter_mut());
        }
        whole.add(found);
        if control.is_stopped() {
            break;
        }
    }
    whole.stopped = control.is_stopped();
    whole
}

impl Pass {
    /// Takes over what another part of the trials gave.
    fn add(&mut self, other: Self) {
        self.trials += other.trials;
        self.undefined += other.undefined;
        self.first_undefined = match (self.first_undefined, other.first_undefined) {
            (Some(x), Some(y)) => Some(x.min(y)),
            (x, y) => x.or(y),
        };
        self.sums.extend(other.sums);
        for (tally, other) in self.tallies.iter_mut().zip(other.tallies) {
            tally.merge(other);
        }
    }
}
