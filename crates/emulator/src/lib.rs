//! What an expensive simulator gives at parameters at which nobody ran it.
//!
//! A simulator is a function from parameters to outputs of all rows of the data: a black box of which
//! some hundreds of runs can be afforded. Its parameters are inputs and those of effects that can be
//! absent. A [`Space`] holds what is known of them; [`Runs`] keeps what was run; an [`Emulator`] learns
//! from it what the outputs do as the parameters move, by a sum of [`Correction`]s: the plain
//! simulator, what each effect adds, an interaction for each pair. A [`Layer`] describes them by few singular
//! vectors (Higdon et al., J. Am. Stat. Assoc. 103 (2008) 570), each with a coefficient that is
//! a [`GaussianProcess`] (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006). A
//! [`Plan`] says which runs come next, from what an inference found so far.
//!
//! Hypotheses are lists of effects by their places, in ascending order. All outputs are in units of their
//! standard uncertainties, u, so that a norm over all rows of 1 is one unit of a residual's norm.
//!
//! Every sum has a fixed order, and elementary functions are the engine's: results are the same bits on
//! every machine.
// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![allow(clippy::needless_range_loop)] // small matrices read best by their places

mod axis;
mod conditioned;
mod correction;
mod emulator;
mod focus;
mod frame;
mod halton;
mod joint_sum;
mod layer;
mod lengths;
mod lines;
mod matern;
mod minimum;
mod plan;
mod posterior_emulator;
mod prediction;
mod process;
mod runs;
mod scatter;
mod simulator;
mod simulator_run;
mod singular;
mod space;
mod state;
mod step;
mod trend;
mod uniforms;
mod unseen;

pub use axis::Coordinate;
pub use conditioned::ValueScatter;
pub use correction::Correction;
pub use emulator::{Emulator, Learnt};
pub use focus::Focus;
pub use halton::space_filling_scores;
pub use layer::{Layer, Reach};
pub use lengths::{ScatteredLengths, likeliest_lengths, scattered_lengths};
pub use lines::DamagedLine;
pub use plan::{GOAL, Plan};
pub use posterior_emulator::PosteriorEmulator;
pub use prediction::Prediction;
pub use process::{Coefficient, GaussianProcess};
pub use runs::{Run, RunHash, RunKey, Runs, RunsError};
pub use scatter::{OutputScatter, Scatter};
pub use simulator::{RunResult, Simulator, SimulatorCase, SimulatorCondition, SimulatorQuantity};
pub use simulator_run::SimulatorRun;
pub use singular::SingularVectors;
pub use space::{Parameter, SimulatorEffect, Space, SpaceError};
pub use state::State;
pub use step::{Batch, Ending, Open, Step, TooFewRuns};
pub use trend::Trend;
pub use unseen::UnseenError;

#[cfg(test)]
mod tests;
