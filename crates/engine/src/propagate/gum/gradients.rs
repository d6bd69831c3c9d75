//! Estimates and sensitivity coefficients of the rows of a task, many rows at a time.

use std::sync::{Arc, OnceLock};

use crate::model::{Columns, Slopes};
use crate::number::{COLUMN, CodePath, Kernel, Operand};
use crate::task::{Row, Task, differences};

/// The outputs' estimates and, for each output, its sensitivity coefficients.
pub(super) type Linear = (Vec<f64>, Vec<Vec<f64>>);

/// How the rows of a task get their sensitivity coefficients.
#[derive(Debug)]
pub(super) struct Gradients<'a> {
    task: &'a Task,
    /// All rows of a sweep at once; `None` for few rows, or where each has to go its own way. Made
    /// when first needed.
    slopes: OnceLock<Option<Slopes>>,
}

/// Fewer rows than this are not worth the preparation.
const FEWEST: usize = 16;

impl<'a> Gradients<'a> {
    pub(super) fn of(task: &'a Task) -> Self {
        Self { task, slopes: OnceLock::new() }
    }

    /// Of one row.
    pub(super) fn one(&self, row: &Row) -> Linear {
        let values = row.estimates();
        let model = &self.task.model;
        match &self.task.function {
            Some(function) => {
                let u: Vec<f64> =
                    row.distributions.iter().map(|d| d.standard_uncertainty()).collect();
                differences(&**function, &values, &u, model.outputs.len())
            }
            None => model.program.gradients(&values),
        }
    }

    /// Of consecutive rows.
    pub(super) fn all(&self, rows: &[Row], path: CodePath) -> Vec<Linear> {
        let slopes = self.slopes.get_or_init(|| {
            let task = self.task;
            let sweeps = task.rows.len() >= FEWEST && task.function.is_none();
            let of = || Slopes::new(&task.model.program, &same(task), task.variables.len());
            sweeps.then(of).flatten()
        });
        let Some(slopes) = slopes else {
            return rows.iter().map(|row| self.one(row)).collect();
        };
        let variables = self.task.model.program.variables();
        let mut columns = slopes.columns();
        let mut made = Vec::with_capacity(rows.len());
        for rows in rows.chunks(COLUMN) {
            for &(variable, register) in &slopes.varying {
                let column = &mut columns.values[register].0;
                for (value, row) in column.iter_mut().zip(rows) {
                    *value = estimate(row, variable);
                }
            }
            path.run(GradientRun { slopes, columns: &mut columns });
            made.extend((0..rows.len()).map(|i| {
                let of_outputs = slopes.outputs.iter().map(|output| {
                    let mut gradient = vec![0.0; variables];
                    for (variable, slope) in &output.gradient {
                        gradient[*variable] = match *slope {
                            Operand::Register(register) => columns.gradients[register].0[i],
                            Operand::Constant(slope) => slope,
                        };
                    }
                    let value = match output.value {
                        Operand::Register(register) => columns.values[register].0[i],
                        Operand::Constant(value) => value,
                    };
                    (value, gradient)
                });
                of_outputs.unzip()
            }));
        }
        made
    }
}

/// The steps on one column of rows.
pub(super) struct GradientRun<'a> {
    pub(super) slopes: &'a Slopes,
    pub(super) columns: &'a mut Columns,
}

impl Kernel for GradientRun<'_> {
    type Output = ();

    // most of the time of a row goes into its budget
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        self.slopes.run(self.columns);
    }
}

/// The value of one of the program's variables in a row.
fn estimate(row: &Row, variable: usize) -> f64 {
    let inputs = row.distributions.len();
    match row.distributions.get(variable) {
        Some(distribution) => distribution.mean(),
        None => row.conditions.get(variable - inputs).copied().unwrap_or(f64::NAN),
    }
}

/// The values of the program's variables that are the same in all rows.
fn same(task: &Task) -> Vec<Option<f64>> {
    let Some((first, others)) = task.rows.split_first() else { return Vec::new() };
    let variables = 0..task.model.program.variables();
    let same = variables.map(|v| {
        let value = estimate(first, v);
        let equal = |row: &Row| {
            // most rows share what is known of most inputs
            let shared = first.distributions.get(v).zip(row.distributions.get(v));
            shared.is_some_and(|(a, b)| Arc::ptr_eq(a, b))
                || estimate(row, v).to_bits() == value.to_bits()
        };
        others.iter().all(equal).then_some(value)
    });
    same.collect()
}
