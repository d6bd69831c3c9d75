//! Reports of the audit of Type B assumptions, one file for each format.

mod csv;
mod document;
mod figure;
mod html;
mod json;
mod sheets;
mod table;
#[cfg(test)]
mod tests;
mod words;

pub use csv::csv;
pub use html::fragment;
pub use json::json;
pub use table::table;

use crate::{Provenance, document as look};
use gumption_assumptions::Audit;
use gumption_engine::task::{Task, Warning};

/// The audit in GitHub Flavored Markdown.
pub fn markdown(report: &AuditReport<'_>) -> String {
    look::markdown(|| document::of(report))
}

/// The audit as one HTML file with figures that needs nothing else.
pub fn html(report: &AuditReport<'_>) -> String {
    look::html(|| document::of(report))
}

/// Everything that a report of an audit may show.
#[derive(Clone, Copy, Debug)]
pub struct AuditReport<'a> {
    /// What was audited.
    pub task: &'a Task,
    /// The results.
    pub audit: &'a Audit,
    /// Notes, in order.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

impl AuditReport<'_> {
    /// The name of a variable.
    fn name(&self, variable: usize) -> &str {
        self.task.variables.get(variable).map_or("", |variable| &variable.name)
    }
}
