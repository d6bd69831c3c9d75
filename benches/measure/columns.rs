//! The budgets of a sweep as columns: what `propagate::gum::bulk` is measured with.

use gumption::distribution::Distribution;
use gumption::number::CodePath;
use gumption::task::Task;
use gumption_engine::propagate::gum::bulk::{Budgets, BulkInput, BulkOptions, BulkValue, budgets};

/// A column, or the value of all its entries.
#[derive(Debug)]
enum Column {
    Same(f64),
    Rows(Vec<f64>),
}

impl Column {
    fn new(values: Vec<f64>, apart: bool) -> Self {
        match values.first() {
            Some(&first) if !apart && values.iter().all(|value| *value == first) => {
                Self::Same(first)
            }
            _ => Self::Rows(values),
        }
    }

    fn each(&self) -> BulkValue<'_> {
        match self {
            Self::Same(value) => BulkValue::Same(*value),
            Self::Rows(values) => BulkValue::Rows(values),
        }
    }
}

/// What is known of the inputs of a task in all of its rows, and its conditions.
#[derive(Debug)]
pub struct Columns<'a> {
    task: &'a Task,
    inputs: Vec<[Column; 3]>,
    conditions: Vec<Column>,
}

impl<'a> Columns<'a> {
    /// With `apart`, estimates that are the same in all rows are columns all the same.
    pub fn of(task: &'a Task, apart: bool) -> Self {
        let inputs = (0..task.variables.len()).map(|v| {
            let column = |apart: bool, f: fn(&Distribution) -> f64| {
                let values = task.rows.iter().map(|row| f(&row.distributions[v]));
                Column::new(values.collect(), apart)
            };
            let known = [Distribution::standard_uncertainty, Distribution::dof];
            let [u, dof] = known.map(|f| column(false, f));
            [column(apart, Distribution::mean), u, dof]
        });
        let conditions = (0..task.model.conditions.len()).map(|c| {
            let values = task.rows.iter().map(|row| row.conditions[c]);
            Column::new(values.collect(), apart)
        });
        Self { inputs: inputs.collect(), conditions: conditions.collect(), task }
    }

    /// The budgets of all rows.
    ///
    /// # Errors
    /// Columns that do not fit the model.
    pub fn budgets(&self, path: CodePath) -> Result<Vec<Budgets>, String> {
        let known = self.inputs.iter().map(|[estimate, u, dof]| BulkInput {
            estimate: estimate.each(),
            standard_uncertainty: u.each(),
            dof: dof.each(),
        });
        let known: Vec<BulkInput<'_>> = known.collect();
        let conditions: Vec<BulkValue<'_>> = self.conditions.iter().map(Column::each).collect();
        let correlations = &self.task.correlations;
        let settings = &self.task.settings;
        let options = BulkOptions {
            coverage: settings.coverage,
            real_dof: settings.real_dof,
            correlations,
            path,
        };
        budgets(&self.task.model.program, &known, &conditions, options).map_err(|e| e.to_string())
    }
}
