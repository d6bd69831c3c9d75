//! Draws of a model's inputs, and what its formulas give at them: what a function is held against.

use gumption::number::CodePath;
use gumption::propagate::first_draws;
use gumption::task::Task;

/// How many rows of conditions are looked at.
const MOST_ROWS: usize = 8;

/// Columns of one entry for each set of values: those of the variables, then the conditions, each in its
/// unit; and what the task's program makes of them, in the units of the outputs.
pub(crate) struct Draws {
    pub(crate) variables: Vec<Vec<f64>>,
    pub(crate) outputs: Vec<Vec<f64>>,
}

/// Of some rows, the first and the last among them, the estimates and then `count` draws in all: the
/// first ones of the run's own. A row that cannot be drawn has its estimates alone.
pub(crate) fn draws(task: &Task, count: usize) -> Draws {
    let rows = task.rows.len();
    let looked_at = rows.min(MOST_ROWS);
    let mut variables: Vec<Vec<f64>> = vec![Vec::new(); task.model.program.variables()];
    let mut outputs: Vec<Vec<f64>> = vec![Vec::new(); task.model.program.outputs()];
    let taken = count.div_ceil(looked_at.max(1));
    for place in 0..looked_at {
        let number = place * (rows - 1) / (looked_at - 1).max(1);
        let Some(row) = task.rows.get(number) else { continue };
        // what cannot be drawn is said by the run
        let drawn = first_draws(task, row, taken, CodePath::best()).unwrap_or_default();
        let estimates = row.estimates();
        for set in 0..=taken {
            let at: Option<Vec<f64>> = match set.checked_sub(1) {
                None => Some(estimates.clone()),
                Some(draw) => drawn.iter().map(|column| column.get(draw).copied()).collect(),
            };
            let Some(at) = at.filter(|at| at.len() == variables.len()) else { break };
            let found = task.model.program.evaluate(&at);
            variables.iter_mut().zip(at).for_each(|(column, value)| column.push(value));
            outputs.iter_mut().zip(found).for_each(|(column, value)| column.push(value));
        }
    }
    Draws { variables, outputs }
}
