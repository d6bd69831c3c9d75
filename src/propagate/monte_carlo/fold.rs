//! Folding trials: a block's values become sums and the few values that intervals depend on.

use super::moments::{Reference, Sums};
use super::products;
use super::sorting::sort;
use super::windows::Windows;
use crate::distribution::BLOCK;
use crate::number::Kernel;

/// What is left of a run of blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Folded {
    /// Number of trials folded in.
    pub(crate) trials: u64,
    /// Trials whose outputs were not all finite; they are not among `trials`.
    pub(crate) undefined: u64,
    /// The first of them: its block and its place in it.
    pub(crate) first_undefined: Option<(u64, usize)>,
    /// One entry for each output.
    pub(crate) outputs: Vec<FoldedOutput>,
}

/// What is left of one output's values.
#[derive(Clone, Debug, Default)]
pub(crate) struct FoldedOutput {
    pub(crate) sums: Sums,
    /// Kept values; sorted once the run of blocks is finished.
    pub(crate) kept: Vec<f64>,
    /// Number of values below the window about the median.
    pub(crate) below_median: u64,
}

impl FoldedOutput {
    pub(crate) fn sort(&mut self) {
        sort(&mut self.kept);
    }
}

/// How one output is folded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub(crate) reference: Reference,
    pub(crate) windows: Windows,
    /// Share of the values that the windows keep.
    pub(crate) kept: f64,
}

impl Folded {
    pub(crate) fn new(outputs: usize) -> Self {
        Self { outputs: vec![FoldedOutput::default(); outputs], ..Self::default() }
    }
}

/// Removes the trials of a block in which an output is not finite; returns how many trials are left
/// of the first `count`, and the place of the first that was removed.
pub(crate) fn drop_undefined(values: &mut [[f64; BLOCK]], count: usize) -> (usize, Option<usize>) {
    if values.iter().all(|v| all_finite(&v[..count])) {
        return (count, None);
    }
    let mut left = 0;
    let mut first = None;
    for trial in 0..count {
        if values.iter().all(|v| v[trial].is_finite()) {
            for v in values.iter_mut() {
                v[left] = v[trial];
            }
            left += 1;
        } else {
            first = first.or(Some(trial));
        }
    }
    (left, first)
}

/// Whether all values are finite, without a branch on each and in sums that do not wait for each
/// other.
fn all_finite(values: &[f64]) -> bool {
    let mut sums = [0.0; 8];
    for part in values.chunks(sums.len()) {
        for (sum, value) in sums.iter_mut().zip(part) {
            // 0 x is 0 for finite values and not a number otherwise
            *sum += value * 0.0;
        }
    }
    sums.iter().sum::<f64>() == 0.0
}

/// Folds the first `count` trials of a block.
pub(crate) struct FoldKernel<'a> {
    pub(crate) values: &'a [[f64; BLOCK]],
    pub(crate) count: usize,
    pub(crate) plans: &'a [Plan],
    pub(crate) folded: &'a mut Folded,
}

impl Kernel for FoldKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { values, count, plans, folded } = self;
        folded.trials += count as u64;
        for (output, (plan, out)) in plans.iter().zip(&mut folded.outputs).enumerate() {
            let block = &values[output][..count];
            out.sums.add(block, plan.reference);
            out.below_median +=
                block.iter().map(|&v| u64::from(v < plan.windows.median_low)).sum::<u64>();
            keep(block, &plan.windows, &mut out.kept);
        }
        products::add(values, count, plans, folded.outputs.iter_mut().map(|out| &mut out.sums));
    }
}

/// Appends the values that the windows keep, without a branch on each value.
#[inline(always)]
fn keep(block: &[f64], windows: &Windows, kept: &mut Vec<f64>) {
    let mut buffer = [0.0; BLOCK];
    let mut length = 0;
    for &value in block {
        buffer[length] = value;
        length += usize::from(windows.keeps(value));
    }
    kept.extend_from_slice(&buffer[..length]);
}
