//! Reports of plans, one file for each format.

mod csv;
mod figure;
mod json;
mod page;
mod sheets;
mod words;

pub use csv::csv;
pub use json::json;
pub use page::{html, markdown, table};
pub use words::{excess_text, wanted, worse_offers};

use crate::Provenance;
use gumption_analysis::plan::{Costs, Plan};
use gumption_engine::model::Quantity;
use gumption_engine::task::{Task, Warning};

/// The contents of a report of a plan.
#[derive(Clone, Copy, Debug)]
pub struct PlanReport<'a> {
    /// What was planned.
    pub task: &'a Task,
    /// The plan.
    pub plan: &'a Plan,
    /// Costs of improvements.
    pub costs: &'a Costs,
    /// The unit of the times of a drift, as typed.
    pub time_unit: &'a str,
    /// Notes.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

impl<'a> PlanReport<'a> {
    /// The output that is planned.
    fn output(&self) -> Option<&'a Quantity> {
        let output = self.task.model.outputs.get(self.plan.target.output)?;
        Some(&output.quantity)
    }

    /// The name of a variable.
    fn name(&self, variable: usize) -> &'a str {
        self.task.variables.get(variable).map_or("", |variable| variable.name.as_str())
    }

    /// The unit of a variable.
    fn unit(&self, variable: usize) -> &'a str {
        self.task.variables.get(variable).map_or("", |variable| variable.unit.text())
    }

    /// The target quantity: `U` or `u`.
    fn kind(&self) -> &'static str {
        if self.plan.target.expanded { "U" } else { "u" }
    }
}
