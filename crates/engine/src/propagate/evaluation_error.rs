//! Why a task cannot be evaluated.

use std::fmt;

use super::monte_carlo::Undefined;
use crate::distribution::{CorrelationError, Invalid};
use crate::number::Shortest;
use crate::task::{Task, TaskError};

/// Why a task cannot be evaluated.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EvaluationError {
    /// The task does not hold together, as after its fields were set by hand.
    Task(Box<TaskError>),
    /// Declared correlations that no joint distribution has, or that cannot be drawn.
    Correlation {
        /// What is wrong; the quantities are the task's variables.
        error: CorrelationError,
        /// The sentence, with their names.
        message: String,
    },
    /// More trials are not finite than are allowed.
    Undefined {
        /// The row.
        row: usize,
        /// How many, out of how many, and the first one's drawn inputs.
        undefined: Undefined,
        /// Names and values of the varying inputs in the first such trial, and of the conditions.
        inputs: Vec<(String, f64)>,
        /// The operation that gave no number.
        operation: Option<String>,
    },
    /// An output has no value at the inputs' estimates, and there are no trials that would tell more.
    NoEstimate {
        /// The row.
        row: usize,
        /// The output, by its number.
        output: usize,
        /// The sentence.
        message: String,
    },
    /// More trials are not finite than are allowed, of which no more is known.
    NotFinite {
        /// Their share.
        share: f64,
    },
    /// Paired readings too few for a joint distribution with a covariance, which trials need.
    Paired {
        /// The variable that has them.
        variable: String,
        /// What is wrong.
        error: Invalid,
    },
    /// Numbers of double precision do not hold what the trials of an output would vary.
    Rounding {
        /// The row.
        row: usize,
        /// The output, by its number.
        output: usize,
        /// The sentence.
        message: String,
    },
}

impl fmt::Display for EvaluationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Task(error) => error.fmt(f),
            Self::Paired { variable, error } => write!(f, "`{variable}`: {error}"),
            Self::Correlation { message, .. }
            | Self::NoEstimate { message, .. }
            | Self::Rounding { message, .. } => f.write_str(message),
            Self::Undefined { undefined, inputs, operation, .. } => {
                let Undefined { count, trials, .. } = undefined;
                write!(f, "{count} of {trials} trials have no finite result")?;
                let at = named_values(inputs);
                match operation {
                    Some(operation) => write!(f, "; the first is {operation}{at}")?,
                    None if at.is_empty() => {}
                    None => write!(f, "; the first is the one{at}")?,
                }
                let missing = inputs.iter().filter(|(_, value)| value.is_nan());
                let missing: Vec<&str> = missing.map(|(name, _)| name.as_str()).collect();
                if missing.is_empty() {
                    return Ok(());
                }
                write!(
                    f,
                    "; a fit to the drawn data of that trial finds no {}: stated uncertainties or \
                     fewer parameters help, or allow a share of such trials (`allow_undefined`)",
                    missing.join(", ")
                )
            }
            Self::NotFinite { share } => write!(
                f,
                "{} % of the trials have no finite result; an evaluation of the task names the first \
                 of them",
                Shortest(100.0 * share)
            ),
        }
    }
}

/// The place that values of names are.
pub(super) fn named_values(values: &[(String, f64)]) -> String {
    let each = values.iter().map(|(name, value)| format!("{name} = {}", Shortest(*value)));
    let each: Vec<String> = each.collect();
    if each.is_empty() { String::new() } else { format!(", at {}", each.join(", ")) }
}

impl std::error::Error for EvaluationError {}

impl EvaluationError {
    /// Declared correlations that cannot be drawn, with the names of the task.
    pub(super) fn correlation(task: &Task, error: CorrelationError) -> Self {
        let name = |v: usize| task.variables.get(v).map_or("", |v| v.name.as_str());
        let message = error.describe(&|v| format!("`{}`", name(v)));
        Self::Correlation { error, message }
    }
}
