//! Accumulation of trials: of a block's values only sums are kept and the few values that coverage
//! intervals can depend on, so that memory does not grow with the trials as such.
#![allow(unsafe_code)] // instructions of a path that the machine has

use super::plan::Plan;
use super::products;
use super::sums::Sums;
use super::windows::Windows;
#[cfg(target_arch = "x86_64")]
use super::{avx2, avx512};
use crate::distribution::BLOCK;
#[cfg(target_arch = "x86_64")]
use crate::number::Instructions;
use crate::number::{CodePath, Kernel};

/// What is kept of some consecutive blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Accumulated {
    /// Number of trials.
    pub(crate) trials: u64,
    /// Trials whose outputs were not all finite; they are not among `trials`.
    pub(crate) undefined: u64,
    /// The first of them: its block and its index there.
    pub(crate) first_undefined: Option<(u64, usize)>,
    /// One entry for each output.
    pub outputs: Vec<AccumulatedOutput>,
}

/// What is kept of one output's values.
#[derive(Clone, Debug, Default)]
pub(crate) struct AccumulatedOutput {
    pub(crate) sums: Sums,
    /// Kept values, in the order of the trials.
    pub(crate) kept: Vec<f64>,
    /// Number of values below the window about the median.
    pub(crate) below_median: u64,
}

impl Accumulated {
    /// For so many trials, with room for what the plans keep.
    pub(super) fn new(plans: &[Plan], trials: u64) -> Self {
        let room = |plan: &Plan| (1.1 * plan.kept * trials as f64) as usize + 2 * BLOCK;
        let output =
            |plan| AccumulatedOutput { kept: Vec::with_capacity(room(plan)), ..Default::default() };
        Self { outputs: plans.iter().map(output).collect(), ..Self::default() }
    }
}

/// Removes the trials of a block in which an output is not finite; returns how many trials are left
/// of the first `count`, and the index of the first that was removed.
pub(crate) fn drop_undefined(
    path: CodePath,
    values: &mut [[f64; BLOCK]],
    count: usize,
) -> (usize, Option<usize>) {
    if values.iter().all(|v| path.run(AllFinite(&v[..count]))) {
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
struct AllFinite<'a>(&'a [f64]);

impl Kernel for AllFinite<'_> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let mut sums = [0.0; 32];
        let parts = self.0.chunks_exact(sums.len());
        // 0 x is 0 for finite values and not a number otherwise
        let rest: f64 = parts.remainder().iter().map(|value| value * 0.0).sum();
        for part in parts {
            for (sum, value) in sums.iter_mut().zip(part) {
                *sum += value * 0.0;
            }
        }
        sums.iter().sum::<f64>() + rest == 0.0
    }
}

/// Accumulates the first `count` trials of a block.
pub(crate) struct AccumulateKernel<'a> {
    /// The path that it runs on.
    pub(crate) path: CodePath,
    pub(crate) values: &'a [[f64; BLOCK]],
    pub(crate) count: usize,
    pub(crate) plans: &'a [Plan],
    pub(crate) accumulated: &'a mut Accumulated,
}

impl Kernel for AccumulateKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, values, count, plans, accumulated } = self;
        accumulated.trials += count as u64;
        for (output, (plan, out)) in plans.iter().zip(&mut accumulated.outputs).enumerate() {
            let block = &values[output][..count];
            out.sums.add(path, block, plan.reference);
            out.below_median += keep(path, block, &plan.windows, &mut out.kept);
        }
        products::add(
            path,
            values,
            count,
            plans,
            accumulated.outputs.iter_mut().map(|out| &mut out.sums),
        );
    }
}

/// Appends the values that the windows keep, without a branch on each value; returns how many lie
/// below the window about the median.
#[inline(always)]
pub(super) fn keep(path: CodePath, block: &[f64], windows: &Windows, kept: &mut Vec<f64>) -> u64 {
    #[cfg(target_arch = "x86_64")]
    match path.instructions() {
        // SAFETY: the machine has the instructions of a path.
        Instructions::Avx512 => return unsafe { avx512::keep(block, windows, kept) },
        // SAFETY: as above.
        Instructions::Avx2 => return unsafe { avx2::keep(block, windows, kept) },
        Instructions::Baseline => {}
    }
    let _ = path;
    let mut wanted = [0u8; BLOCK];
    for (wanted, &value) in wanted.iter_mut().zip(block) {
        *wanted = u8::from(windows.keeps(value));
    }
    let mut buffer = [0.0; BLOCK];
    let mut length = 0;
    for (&value, &wanted) in block.iter().zip(&wanted) {
        buffer[length % BLOCK] = value;
        length += usize::from(wanted);
    }
    kept.extend_from_slice(&buffer[..length]);
    block.iter().map(|&v| u64::from(v < windows.median_low)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same values in the same order on every path, behind those that were kept before, whatever
    /// part of a register the last values fill.
    #[test]
    fn kept_values_are_the_same_on_every_path() {
        let some = Windows {
            low: -0.6,
            median_low: -0.05,
            median_high: 0.04,
            high: 0.7,
            ends: [-1.0, 1.0],
        };
        for count in (0..=33).chain([BLOCK]) {
            let block: Vec<f64> = (0..count).map(|i| (i * 37 % 101) as f64 / 50.0 - 1.0).collect();
            for windows in [some, Windows::ALL] {
                let of = |path| {
                    let mut kept = vec![7.0];
                    (keep(path, &block, &windows, &mut kept), kept)
                };
                for path in CodePath::available() {
                    assert_eq!(of(path), of(CodePath::BASELINE), "{count} values, {path:?}");
                }
            }
        }
    }
}
