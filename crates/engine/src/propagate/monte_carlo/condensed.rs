//! What is kept of single blocks of trials, made before it is known how many trials a run has.
//!
//! The figures of a run are made of sums over blocks and of the few values that coverage intervals can
//! depend on. Where the number of trials is found on the way (JCGM 101, 7.9), both are taken when a
//! block is drawn, about the reference that a run of any length has and within windows that hold
//! those of all lengths. The run that follows then adds them up instead of drawing its trials again:
//! the same sums in the same order, so the same bits.

use std::ops::Range;

use crate::parallel;

use super::accumulate::{AccumulateKernel, Accumulated, AccumulatedOutput, drop_undefined, keep};
use super::block::{RowTrials, Workspace};
use super::plan::Plan;
use super::sums::Sums;
use crate::distribution::BLOCK;
use crate::number::{CodePath, Kernel};
use crate::propagate::Control;

/// The first blocks of a row's trials, each by itself.
#[derive(Debug, Default)]
pub(crate) struct Condensed {
    plans: Vec<Plan>,
    blocks: Vec<CondensedBlock>,
    bytes: usize,
}

/// What is kept of one block.
#[derive(Debug)]
pub(super) struct CondensedBlock {
    whole: Accumulated,
    /// The two parts of a block in which a block of the adaptive procedure ends and the next begins.
    parts: Option<[BlockPart; 2]>,
}

/// Some of a block's trials.
#[derive(Debug, Default)]
struct BlockPart {
    trials: u64,
    /// For each output its sums, and which of the values that are kept of the block are of the part.
    outputs: Vec<(Sums, Range<usize>)>,
}

/// Which trials of a block are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Share {
    Whole,
    BeforeEdge,
    AfterEdge,
}

impl Condensed {
    /// Of no block yet, to be made by these plans.
    pub(super) fn new(plans: Vec<Plan>) -> Self {
        Self { plans, ..Self::default() }
    }

    /// How many of the first blocks there are.
    pub(super) fn len(&self) -> u64 {
        self.blocks.len() as u64
    }

    pub(super) fn get(&self, block: u64) -> Option<&CondensedBlock> {
        self.blocks.get(usize::try_from(block).ok()?)
    }

    /// Takes over the blocks that follow those that are there, as far as `memory` (bytes) has room.
    pub(super) fn extend(&mut self, made: Vec<CondensedBlock>, memory: usize) {
        for block in made {
            let bytes = self.bytes + block.bytes();
            if bytes > memory {
                return;
            }
            self.bytes = bytes;
            self.blocks.push(block);
        }
    }

    /// Adds a block to what is accumulated by `plans`. `false` if it is not there, or does not hold
    /// what these plans keep.
    pub(super) fn add(
        &self,
        path: CodePath,
        block: u64,
        plans: &[Plan],
        accumulated: &mut Accumulated,
    ) -> bool {
        let Some(CondensedBlock { whole, .. }) = self.get(block) else {
            return false;
        };
        let fits = |(own, wanted): (&Plan, &Plan)| {
            own.reference == wanted.reference && own.windows.cover(&wanted.windows)
        };
        if self.plans.len() != plans.len() || !self.plans.iter().zip(plans).all(fits) {
            return false;
        }
        accumulated.trials += whole.trials;
        accumulated.undefined += whole.undefined;
        accumulated.first_undefined = accumulated.first_undefined.or(whole.first_undefined);
        let outputs = accumulated.outputs.iter_mut().zip(&whole.outputs);
        for ((out, condensed), (plan, own)) in outputs.zip(plans.iter().zip(&self.plans)) {
            out.sums.merge(&condensed.sums);
            path.run(KeepKernel { path, plan, own, condensed, out });
        }
        true
    }
}

/// Keeps of a block's values those that another plan keeps.
struct KeepKernel<'a> {
    path: CodePath,
    plan: &'a Plan,
    /// The plan by which the block was condensed.
    own: &'a Plan,
    condensed: &'a AccumulatedOutput,
    out: &'a mut AccumulatedOutput,
}

impl Kernel for KeepKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, plan, own, condensed, out } = self;
        let in_low_tail: u64 =
            condensed.kept.iter().map(|&v| u64::from(v < own.windows.median_low)).sum();
        let not_kept = condensed.below_median - in_low_tail;
        out.below_median += not_kept + keep(path, &condensed.kept, &plan.windows, &mut out.kept);
    }
}

/// Makes some blocks for a procedure whose own blocks have `size` trials, no fewer than a block here;
/// `None` if the run was stopped.
pub(super) fn condense(
    trials: &RowTrials,
    control: &Control<'_>,
    plans: &[Plan],
    blocks: Range<u64>,
    size: u64,
) -> Option<Vec<CondensedBlock>> {
    let path = control.path;
    let room = || (trials.workspace(), Accumulated::new(plans, BLOCK as u64));
    let make = |(workspace, room): &mut (Workspace, Accumulated), block: u64| {
        if control.is_stopped() {
            return None;
        }
        let start = block * BLOCK as u64;
        let edge = (start.next_multiple_of(size) - start) as usize;
        trials.block(path, block, workspace);
        Some(CondensedBlock::of(path, plans, workspace, block, edge, room))
    };
    parallel::map_with(blocks, room, make).into_iter().collect()
}

impl CondensedBlock {
    /// Of the values in a workspace; the `edge` divides them if it lies between two trials.
    fn of(
        path: CodePath,
        plans: &[Plan],
        workspace: &mut Workspace,
        block: u64,
        edge: usize,
        room: &mut Accumulated,
    ) -> Self {
        let values = &mut workspace.outputs;
        let is_divided = edge > 0 && edge < BLOCK;
        let is_defined = |trial: &usize| values.iter().all(|values| values[*trial].is_finite());
        let edge = if is_divided { (0..edge).filter(is_defined).count() } else { 0 };
        let (count, first) = drop_undefined(path, values, BLOCK);
        room.trials = 0;
        for output in &mut room.outputs {
            output.kept.clear();
            (output.sums, output.below_median) = (Sums::default(), 0);
        }
        path.run(AccumulateKernel { path, values, count, plans, accumulated: room });
        let of_part = |from: usize, to: usize| {
            let outputs = values.iter().zip(plans).map(|(values, plan)| {
                let kept =
                    |values: &[f64]| values.iter().filter(|&&v| plan.windows.keeps(v)).count();
                let mut sums = Sums::default();
                path.run(SumKernel { path, plan, values: &values[from..to], sums: &mut sums });
                let before = kept(&values[..from]);
                (sums, before..before + kept(&values[from..to]))
            });
            BlockPart { trials: (to - from) as u64, outputs: outputs.collect() }
        };
        let parts = is_divided.then(|| [of_part(0, edge), of_part(edge, count)]);
        let outputs = room.outputs.iter_mut().map(|output| AccumulatedOutput {
            sums: std::mem::take(&mut output.sums),
            kept: output.kept.as_slice().to_vec(),
            below_median: output.below_median,
        });
        let whole = Accumulated {
            trials: count as u64,
            undefined: (BLOCK - count) as u64,
            first_undefined: first.map(|first| (block, first)),
            outputs: outputs.collect(),
        };
        Self { whole, parts }
    }

    /// The memory that it takes.
    fn bytes(&self) -> usize {
        let of_output = |output: &AccumulatedOutput| {
            let products = 8 * output.sums.products.len();
            size_of::<AccumulatedOutput>() + 8 * output.kept.len() + products
        };
        self.whole.outputs.iter().map(of_output).sum::<usize>() + size_of::<Self>()
    }

    /// How many trials are in a share of the block.
    pub(super) fn trials(&self, share: Share) -> u64 {
        match (self.part(share), share) {
            (Some(part), _) => part.trials,
            (None, Share::Whole) => self.whole.trials,
            (None, _) => 0,
        }
    }

    /// An output's sums and kept values in a share of the block; `None` if there is no such part.
    pub(super) fn output(&self, share: Share, output: usize) -> Option<(&Sums, &[f64])> {
        let whole = self.whole.outputs.get(output)?;
        if share == Share::Whole {
            return Some((&whole.sums, &whole.kept));
        }
        let (sums, kept) = self.part(share)?.outputs.get(output)?;
        Some((sums, whole.kept.get(kept.clone())?))
    }

    fn part(&self, share: Share) -> Option<&BlockPart> {
        let [before, after] = self.parts.as_ref()?;
        match share {
            Share::Whole => None,
            Share::BeforeEdge => Some(before),
            Share::AfterEdge => Some(after),
        }
    }
}

/// Adds some values' powers.
struct SumKernel<'a> {
    path: CodePath,
    plan: &'a Plan,
    values: &'a [f64],
    sums: &'a mut Sums,
}

impl Kernel for SumKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, plan, values, sums } = self;
        sums.add(path, values, plan.reference);
    }
}

#[cfg(test)]
mod tests {
    use super::super::pilot::{plans, plans_of_any_length};
    use super::super::request::Request;
    use super::*;
    use crate::distribution::{Input, Normal, Rectangular};
    use crate::propagate::evaluation::joint;
    use crate::task::Task;

    /// What is condensed comes to the bits of what is drawn, in chunks of a run of any length: sums,
    /// products of outputs, kept values in their order, counts, trials that are not defined.
    #[test]
    fn condensed_blocks_accumulate_to_the_bits_of_drawn_ones() {
        let task = Task::builder("test")
            .input("a", Input::new(Normal::new(1.0, 0.3).unwrap(), "1").unwrap())
            .input("b", Input::new(Rectangular::new(0.5, 0.501).unwrap(), "1").unwrap())
            .equation("y", "a*sqrt(b)")
            .equation("z", "a + b")
            .output("y", "1")
            .output("z", "1")
            .build()
            .unwrap();
        let control = Control::default();
        let path = control.path;
        let row = &task.rows[0];
        let mut trials = RowTrials::new(&task, row, &[1.0, 1.5], &joint(&task, row).unwrap());
        let request = |trials| Request { trials, probability: 0.95, moment_order: &[] };
        let own = plans_of_any_length(&trials, request(10_000_000), &control);
        let mut condensed = Condensed::new(own.clone());
        condensed.extend(condense(&trials, &control, &own, 0..70, 10_000).unwrap(), usize::MAX);
        trials.condensed = condensed;
        for count in [100_000, 2_000_000, 6_000_000] {
            let plans = plans(&trials, request(count), &control, 1.0);
            let mut summed = Accumulated::new(&plans, 0);
            let mut drawn = Accumulated::new(&plans, 0);
            let mut workspace = trials.workspace();
            for block in 0..70 {
                assert!(trials.condensed.add(path, block, &plans, &mut summed));
                trials.block(path, block, &mut workspace);
                let values = &mut workspace.outputs;
                let (count, first) = drop_undefined(path, values, BLOCK);
                drawn.undefined += (BLOCK - count) as u64;
                drawn.first_undefined = drawn.first_undefined.or(first.map(|f| (block, f)));
                let (plans, accumulated) = (&plans[..], &mut drawn);
                path.run(AccumulateKernel { path, values, count, plans, accumulated });
            }
            assert!(drawn.undefined > 10);
            assert_eq!(
                (summed.trials, summed.undefined, summed.first_undefined),
                (drawn.trials, drawn.undefined, drawn.first_undefined)
            );
            for (summed, drawn) in summed.outputs.iter().zip(&drawn.outputs) {
                assert_eq!(summed.sums, drawn.sums);
                assert_eq!(summed.kept, drawn.kept);
                assert_eq!(summed.below_median, drawn.below_median);
            }
        }
        // windows that keep more than the condensed ones, and blocks that are not there
        let wide = plans(&trials, request(2_000_000), &control, 4.0);
        let mut summed = Accumulated::new(&wide, 0);
        assert!(!trials.condensed.add(path, 0, &wide, &mut summed));
        assert!(!trials.condensed.add(path, 70, &own, &mut summed));
        assert_eq!(summed.trials, 0);
    }
}
