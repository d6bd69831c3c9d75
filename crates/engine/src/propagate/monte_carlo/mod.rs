//! The Monte Carlo method (JCGM 101, clauses 5.9 and 7).
//!
//! Trials are made in blocks (`block`) whose draws are functions of (seed, input, block), so any
//! thread can compute any block and the results are the same bits however the work is shared. A
//! pilot of the first blocks fixes where the tails lie (`windows`); the main pass keeps only what
//! the coverage intervals and the median can depend on (`fold`); order statistics of what was
//! kept are then those of all trials (`order`, `interval`). Where that would not fit into memory,
//! the trials are generated again in a few passes (`capped`).

mod adaptive;
mod block;
mod capped;
mod fold;
mod foresight;
mod hash;
mod histogram;
mod interval;
mod moments;
mod order;
mod partition;
mod products;
mod quantiles;
mod repeat;
mod run;
mod shelves;
mod sorting;
mod together;
#[cfg(target_arch = "x86_64")]
mod wide;
mod windows;

pub use adaptive::Adaptive;
pub use adaptive::FIRST_STAGE;
pub(crate) use adaptive::{Search, find_trials};
pub(crate) use block::Trials;
pub use block::onto_branch;
pub use block::stream_name;
pub(crate) use hash::hash_trials;
pub use histogram::Histogram;
pub(crate) use histogram::histograms;
pub use interval::Ranks;
pub(crate) use quantiles::quantiles;
pub(crate) use repeat::repeat;
pub use run::run;
pub(crate) use run::{Finished, Request};
pub use run::{MonteCarlo, NumericalError, Undefined};
pub(crate) use together::joint_ranks;
