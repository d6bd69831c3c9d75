//! Draws of a model's inputs, and what its formulas give at them: what a function is held against.

use std::sync::{Arc, Mutex, PoisonError};

use gumption::propagate::{Control, evaluate};
use gumption::task::{ColumnFunction, Task, Trials};

/// How many rows of conditions are looked at.
const MOST_ROWS: usize = 8;

/// Takes down the columns that it is called with, and gives zeros.
#[derive(Debug, Default)]
struct Listener(Mutex<Vec<Vec<Vec<f64>>>>);

impl ColumnFunction for Listener {
    fn evaluate(&self, variables: &[Vec<f64>], outputs: &mut [Vec<f64>]) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(variables.to_vec());
        outputs.iter_mut().for_each(|column| column.fill(0.0));
    }
}

/// Columns of one entry for each set of values: those of the variables, then the conditions, each in its
/// unit; and what the task's program makes of them, in the units of the outputs.
pub(crate) struct Draws {
    pub(crate) variables: Vec<Vec<f64>>,
    pub(crate) outputs: Vec<Vec<f64>>,
}

/// Of some rows, the first and the last among them, the estimates and then `count` draws in all: the
/// first ones of the run's own. A row that cannot be drawn has its estimates alone.
pub(crate) fn draws(task: &Task, count: usize, control: &Control<'_>) -> Draws {
    let rows = task.rows.len();
    let looked_at = rows.min(MOST_ROWS);
    let mut variables: Vec<Vec<f64>> = vec![Vec::new(); task.model.program.variables()];
    let mut outputs: Vec<Vec<f64>> = vec![Vec::new(); task.model.program.outputs()];
    let mut of_row = task.clone();
    of_row.settings = task.settings.with_trials(Trials::Fixed(2));
    for place in 0..looked_at {
        let number = place * (rows - 1) / (looked_at - 1).max(1);
        let Some(row) = task.rows.get(number) else { continue };
        let listener = Arc::new(Listener::default());
        of_row.rows = vec![row.clone()];
        of_row.function = Some(Arc::clone(&listener) as Arc<dyn ColumnFunction>);
        // what the evaluation says of zeros is nothing to anybody; what cannot be drawn is said by the run
        let _ = evaluate(&of_row, control);
        let heard = listener.0.lock().unwrap_or_else(PoisonError::into_inner);
        let block = heard.iter().max_by_key(|columns| columns.first().map_or(0, Vec::len));
        let estimates = row.estimates();
        let drawn = block.map_or(&[][..], Vec::as_slice);
        let taken = count.div_ceil(looked_at);
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
