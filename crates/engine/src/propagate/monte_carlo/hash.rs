//! A hash over the bits of all trials, by which runs are compared: between numbers of threads,
//! between code paths, between machines.

use super::block::{RowTrials, Workspace};
use crate::distribution::BLOCK;
use crate::number::CodePath;
use crate::parallel;

/// The hash of the outputs' bits in the first `count` trials. Every value enters with its output
/// and trial, so equal hashes mean equal trials in equal positions (up to a chance of 2^-64).
pub(crate) fn hash_trials(trials: &RowTrials, count: u64, path: CodePath) -> u64 {
    let blocks = count.div_ceil(BLOCK as u64);
    let of_block = |workspace: &mut Workspace, block: u64| {
        trials.block(path, block, workspace);
        let left = (count - block * BLOCK as u64).min(BLOCK as u64) as usize;
        let values = workspace.outputs.iter().flat_map(|v| &v[..left]);
        values.fold(block, |hash, value| step(hash, value.to_bits()))
    };
    parallel::map_with(0..blocks, || trials.workspace(), of_block).into_iter().fold(0, step)
}

/// One step of a multiplicative hash with a rotation, so that order counts.
fn step(hash: u64, bits: u64) -> u64 {
    (hash.rotate_left(5) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}
