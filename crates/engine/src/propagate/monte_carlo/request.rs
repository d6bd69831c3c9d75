//! What is asked of a Monte Carlo run.

use crate::distribution::BLOCK;

/// What a run needs beside its trials.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request<'a> {
    /// Number of trials.
    pub(crate) trials: u64,
    /// Coverage probability.
    pub(crate) probability: f64,
    /// For each output the order from which on moments of its trials do not exist
    /// ([`moment_orders`](crate::propagate::moment_order::moment_orders)).
    pub(crate) moment_order: &'a [f64],
}

/// How many of the first `trials` trials lie in a block.
pub(super) fn trials_in(block: u64, trials: u64) -> usize {
    trials.saturating_sub(block * BLOCK as u64).min(BLOCK as u64) as usize
}
