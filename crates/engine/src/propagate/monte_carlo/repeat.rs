//! The trials of a run once more, handed over in order.

use crate::parallel;

use super::accumulate::drop_undefined;
use super::block::{RowTrials, Workspace};
use super::request::trials_in;
use crate::distribution::BLOCK;
use crate::propagate::Control;

/// Blocks that are held at a time, at most.
const MOST_BLOCKS: u64 = 256;

/// Generates the first `count` trials again and hands them over block by block in order: the
/// outputs' values, without the trials in which one is not finite. A few blocks are held at a time.
/// `false` if the run was stopped.
pub(crate) fn repeat<E: Send>(
    trials: &RowTrials,
    count: u64,
    control: &Control<'_>,
    mut take: impl FnMut(&[Vec<f64>]) -> Result<(), E>,
) -> Result<bool, E> {
    let blocks = count.div_ceil(BLOCK as u64);
    let held = control.memory / (8 * BLOCK * trials.outputs().max(1));
    let held = (held as u64).clamp(1, MOST_BLOCKS);
    for first in (0..blocks).step_by(held as usize) {
        if control.is_stopped() {
            return Ok(false);
        }
        let make = |workspace: &mut Workspace, block: u64| -> Vec<Vec<f64>> {
            trials.block(control.path, block, workspace);
            let (left, _) =
                drop_undefined(control.path, &mut workspace.outputs, trials_in(block, count));
            workspace.outputs.iter().map(|values| values[..left].to_vec()).collect()
        };
        let numbers = first..(first + held).min(blocks);
        let made: Vec<Vec<Vec<f64>>> = parallel::map_with(numbers, || trials.workspace(), make);
        for values in &made {
            take(values)?;
        }
    }
    Ok(true)
}

/// The values of all outputs in the first `count` trials, which are made again; `None` if stopped.
pub(crate) fn collected(
    trials: &RowTrials,
    count: u64,
    control: &Control<'_>,
) -> Option<Vec<Vec<f64>>> {
    let mut values: Vec<Vec<f64>> = vec![Vec::with_capacity(count as usize); trials.outputs()];
    let whole = repeat(trials, count, control, |block| {
        for (kept, values) in values.iter_mut().zip(block) {
            kept.extend_from_slice(values);
        }
        Ok::<(), std::convert::Infallible>(())
    });
    whole.unwrap_or(false).then_some(values)
}
