//! What a plan says: runs, inferences, and how it ended.

use std::error::Error;
use std::fmt;

use crate::focus::Focus;

/// What to do next.
#[derive(Clone, Debug)]
pub enum Step {
    /// Make these runs, and learn from the batches one after the other.
    Run(Vec<Batch>),
    /// Infer the posteriors of these hypotheses.
    Infer(Vec<Vec<usize>>),
    /// Weigh all hypotheses as they are to be reported.
    Weigh,
    /// There is nothing more to do.
    Done(Ending),
}

/// Runs of one hypothesis that are learnt together.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// Its effects.
    pub effects: Vec<usize>,
    /// The scores of its unknowns, for each run.
    pub scores: Vec<Vec<f64>>,
    /// Where its posterior was found; `None` at the start.
    pub focus: Option<Focus>,
}

/// How a plan ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// All runs that it asked for.
    pub runs: usize,
    /// The leading hypotheses that are not known well enough; empty where the emulator converged.
    pub open: Vec<Open>,
}

/// A hypothesis that is not known well enough.
#[derive(Clone, Debug, PartialEq)]
pub struct Open {
    /// Its effects.
    pub effects: Vec<usize>,
    /// The error at its posterior: the root mean square of the norm over all rows on runs that were not seen, in u. `None`
    /// where it was never run there.
    pub error: Option<f64>,
    /// About how many more runs it takes, if the error goes on to fall as it did, or by half a round.
    pub runs: usize,
}

/// A budget that does not reach for the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooFewRuns {
    /// How many runs are the least.
    pub least: usize,
}

impl fmt::Display for TooFewRuns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the simulator has to be run {} times at least", self.least)
    }
}

impl Error for TooFewRuns {}
