//! The Monte Carlo method (JCGM 101, clauses 5.9 and 7).
//!
//! Trials are made in blocks (`block`) whose draws are functions of (seed, input, block), so any
//! thread can compute any block and the results are the same bits however the work is shared. A
//! pilot of the first blocks (`pilot`) fixes where the tails lie (`windows`); the main pass (`run`)
//! accumulates sums and keeps only what the coverage intervals and the median can depend on
//! (`accumulate`); order statistics of what was kept are then those of all trials (`order`,
//! `bucket_partition`, `interval`). Where that would not fit into memory, the trials are generated
//! again in a few passes (`several_pass`). Where their number is found on the way (`adaptive`), what
//! is kept of a block is made when it is drawn (`condensed`), and the main pass adds it up.

mod accumulate;
mod adaptive;
mod avx2;
mod avx512;
mod block;
mod bucket_partition;
mod condensed;
mod convergence;
mod figures;
mod hash;
mod histogram;
mod interval;
mod joint_ranks;
mod limit_scatter;
mod moments;
mod order;
mod partition;
mod parts;
mod passes;
mod pilot;
mod pilot_refinement;
mod plan;
mod products;
mod quantiles;
mod repeat;
mod request;
mod run;
mod several_pass;
mod shortest_scatter;
#[cfg(target_arch = "x86_64")]
mod sorting;
mod sums;
mod targets;
mod totals;
mod windows;

pub use adaptive::FIRST_STAGE;
pub(crate) use adaptive::{AdaptiveSearch, find_trials};
pub(crate) use block::RowTrials;
pub use block::stream_name;
pub(crate) use convergence::settling;
pub(crate) use figures::Finished;
pub use figures::{Adaptive, MonteCarlo, NumericalError, StatedInterval, Undefined};
pub(crate) use hash::hash_trials;
pub use histogram::Histogram;
pub(crate) use histogram::histograms;
pub use interval::Ranks;
pub use joint_ranks::QuantilesAndRanks;
pub(crate) use joint_ranks::{joint_ranks, quantiles_and_ranks};
pub use parts::Damaged;
pub(crate) use parts::{ByteReader, Gathered, Prepared, RowOutcome, RowPass, Writer, share};
pub(crate) use quantiles::quantiles;
pub(crate) use repeat::{collected, repeat};
pub(crate) use request::Request;
pub(crate) use run::run;
