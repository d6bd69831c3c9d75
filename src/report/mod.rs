//! Reports: what an evaluation looks like, one file for each format.

pub mod assumptions;
#[cfg(feature = "cli")]
pub mod certificate;
pub mod compare;
mod csv;
#[cfg(feature = "cli")]
mod document;
#[cfg(feature = "cli")]
mod evaluation;
pub mod gap;
#[cfg(feature = "cli")]
mod html;
mod json;
pub mod number;
pub mod observe;
#[cfg(feature = "cli")]
mod plot;
mod samples;
mod saved;
#[cfg(feature = "cli")]
mod sheet;
#[cfg(feature = "cli")]
mod si;
mod subtotals;
#[cfg(feature = "cli")]
mod table;
mod tree;
#[cfg(feature = "cli")]
mod workbook;

pub use csv::{csv, write_csv};
#[cfg(feature = "cli")]
pub use evaluation::{MOST_RESULTS, Shown, histograms, html, latex, markdown, xlsx};
pub use json::{json, write_json};
pub use samples::Samples;
pub use saved::saved;
#[cfg(feature = "cli")]
pub use table::{Column, Style, table, write_table};
#[cfg(feature = "cli")]
pub(crate) use table::{Grid, WIDTH, conditions_text, grouped, plain, wrapped};

use crate::propagate::Evaluation;
use crate::task::{Task, Warning};

/// Where a result comes from: enough to repeat it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// SHA-256 of the model file, in hexadecimal.
    pub model_sha256: String,
    /// SHA-256 of every other file that was read, by its name as the model file has it.
    pub files: Vec<(String, String)>,
}

/// Everything that a report may show.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// What was evaluated.
    pub task: &'a Task,
    /// The results.
    pub evaluation: &'a Evaluation,
    /// Warnings and notes, in order.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

#[cfg(test)]
mod tests;
