//! Reports of the audit of Type B assumptions, one file for each format.

mod csv;
#[cfg(feature = "cli")]
mod figure;
#[cfg(feature = "cli")]
mod html;
mod json;
#[cfg(feature = "cli")]
mod sheets;
#[cfg(feature = "cli")]
mod table;
#[cfg(test)]
#[cfg(feature = "cli")]
mod tests;
#[cfg(feature = "cli")]
mod words;

pub use csv::csv;
#[cfg(feature = "cli")]
pub use html::html;
pub use json::json;
#[cfg(feature = "cli")]
pub use table::table;

use crate::assumptions::Audit;
use crate::report::Provenance;
use crate::task::{Task, Warning};

/// Everything that a report of an audit may show.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// What was audited.
    pub task: &'a Task,
    /// The results.
    pub audit: &'a Audit,
    /// Notes, in order.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

impl Report<'_> {
    /// The name of a variable.
    fn name(&self, variable: usize) -> &str {
        self.task.variables.get(variable).map_or("", |variable| &variable.name)
    }
}
