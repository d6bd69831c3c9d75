//! A simulator that is a program: it reads parameters and conditions as JSON and writes outputs as JSON.
//!
//! `child` is a running program, `process` starts one for each run, `lines` keeps one for many runs, and
//! [`Program`] shares the runs among threads. [`KeptRuns`] writes each run to a folder as soon as it ends;
//! `made` reads runs that were made elsewhere, `design` writes which ones to make. `options` are those of
//! the command line, and `diagnosis` diagnoses with it.

mod answer;
mod call;
mod child;
mod design;
mod diagnosis;
mod kept;
mod lines;
mod made;
mod options;
mod process;
mod program;
mod request;
mod runs_file;
mod words;

pub(super) use child::end_all;
pub use design::design;
pub use diagnosis::SimulatedCase;
pub use kept::KeptRuns;
pub use made::{MadeRuns, made};
pub(super) use options::SimulatorOptions;
pub use options::prediction_folder;
pub use program::Program;
