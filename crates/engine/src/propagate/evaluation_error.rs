//! Why a task cannot be evaluated.

use std::fmt;

use super::monte_carlo::Undefined;
use crate::decimal::{exact, position, rounded};
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
        /// What the law of propagation gives for the outputs, in order; empty if one of them has no
        /// finite estimate.
        by_law: Vec<LinearResult>,
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

/// The result of the law of propagation for an output whose trials are not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearResult {
    /// The output.
    pub name: String,
    /// Its unit as text; empty for 1.
    pub unit: String,
    /// The estimate, in that unit.
    pub estimate: f64,
    /// The standard uncertainty, in that unit; `None` if it is not finite.
    pub standard_uncertainty: Option<f64>,
}

impl fmt::Display for LinearResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, unit, estimate, standard_uncertainty } = self;
        let in_unit = |number: String| match unit.as_str() {
            "" | "1" => number,
            unit => format!("{number} {unit}"),
        };
        match standard_uncertainty.map(|u| (u, position(u, DIGITS))) {
            Some((u, Some(place))) => {
                let [y, u] = [*estimate, u].map(|number| in_unit(rounded(number, place)));
                write!(f, "{name} = {y} with u = {u}")
            }
            Some((_, None)) => write!(f, "{name} = {} with u = 0", in_unit(exact(*estimate))),
            None => write!(f, "{name} = {} without a finite u", in_unit(exact(*estimate))),
        }
    }
}

/// Significant digits of a standard uncertainty in a message.
const DIGITS: u32 = 2;

/// Maximum number of outputs in a message.
const MOST_OUTPUTS: usize = 3;

/// What else can be done if trials are not finite: `limits`, unless a fit fails, a share of such
/// trials, and the law of propagation alone.
fn ways(f: &mut fmt::Formatter<'_>, by_law: &[LinearResult], is_of_fit: bool) -> fmt::Result {
    let shown: Vec<String> =
        by_law.iter().take(MOST_OUTPUTS).map(LinearResult::to_string).collect();
    if !shown.is_empty() {
        write!(f, "; the law of propagation gives {}", shown.join(", "))?;
        if by_law.len() > MOST_OUTPUTS {
            write!(f, " and {} more outputs", by_law.len() - MOST_OUTPUTS)?;
        }
    }
    let mut ways = Vec::new();
    if !is_of_fit {
        ways.push("state the `limits` of an input that cannot have such values");
    }
    ways.push("allow a share P of such trials, `\"allow_undefined\": P`");
    if !by_law.is_empty() {
        ways.push("take the law of propagation alone, `--trials 0`");
    }
    write!(f, "; {}", gumption_units::listed(&ways, ", or "))
}

impl fmt::Display for EvaluationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Task(error) => error.fmt(f),
            Self::Paired { variable, error } => write!(f, "`{variable}`: {error}"),
            Self::Correlation { message, .. }
            | Self::NoEstimate { message, .. }
            | Self::Rounding { message, .. } => f.write_str(message),
            Self::Undefined { undefined, inputs, operation, by_law, .. } => {
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
                if !missing.is_empty() {
                    write!(
                        f,
                        "; a fit to the drawn data of that trial finds no {}: stated uncertainties or \
                         fewer parameters help",
                        missing.join(", ")
                    )?;
                }
                ways(f, by_law, !missing.is_empty())
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
