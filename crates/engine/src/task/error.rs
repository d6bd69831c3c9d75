//! Why a task cannot be made.

use std::fmt;

use crate::distribution::{CorrelationError, Invalid};
use crate::model::formula::{FormulaError, NameError, ScaleMisfit};
use gumption_units::UnitError;

/// Why a task cannot be made of what was given.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum TaskError {
    /// A unit that cannot be read.
    Unit {
        /// The quantity.
        of: String,
        /// What is wrong with its unit.
        error: UnitError,
    },
    /// A unit of another dimension than the quantity's.
    WrongUnit {
        /// The quantity.
        of: String,
        /// Its unit as given.
        found: String,
        /// A unit that it could have.
        expected: String,
    },
    /// A unit of the right dimension that the scale of the quantity does not fit.
    WrongScale {
        /// The quantity.
        of: String,
        /// Its unit as given.
        unit: String,
        /// Why it does not fit.
        misfit: ScaleMisfit,
    },
    /// A component that is given in another unit than the input that it is added to.
    ComponentUnit {
        /// The input.
        of: String,
        /// The component's unit.
        found: String,
        /// The input's unit.
        expected: String,
    },
    /// A name that no quantity can have.
    Name {
        /// The name.
        name: String,
        /// Why not.
        error: NameError,
    },
    /// A name that stands for two quantities.
    NameTaken {
        /// The name.
        name: String,
    },
    /// A name that stands for no quantity, or for none of the kind that is needed.
    Unknown {
        /// The name.
        name: String,
        /// The kind: `input`, `condition`, `output`.
        kind: &'static str,
    },
    /// An input of a typed measurement that is neither given nor has a default.
    Missing {
        /// The input.
        input: String,
    },
    /// A formula that cannot be read or computed.
    Formula {
        /// The quantity that it is the formula of.
        of: String,
        /// What is wrong with it.
        error: FormulaError,
    },
    /// What is known about an input is impossible in a row.
    Distribution {
        /// The input.
        input: String,
        /// The row, counted from 0.
        row: usize,
        /// What is wrong.
        error: Invalid,
    },
    /// A row that has not one finite value for each condition, or conditions without rows.
    Conditions {
        /// The row, counted from 0.
        row: usize,
        /// How many conditions there are.
        expected: usize,
    },
    /// A coefficient that is not from -1 to 1, of a quantity with itself, given twice, or of
    /// quantities that have not their values in common over the same rows.
    Coefficient {
        /// The names of the quantities.
        between: [String; 2],
        /// What is wrong.
        reason: &'static str,
    },
    /// Coefficients that the quantities cannot have.
    Correlation {
        /// What is wrong; the quantities are those of the task.
        error: CorrelationError,
        /// The sentence, with their names.
        message: String,
    },
    /// Limits that no value lies within, or none.
    Tolerance {
        /// The output.
        of: String,
        /// What is wrong.
        reason: &'static str,
    },
    /// A prior, a capability or a risk that an output cannot have.
    Requirement {
        /// The output.
        of: String,
        /// What is wrong.
        reason: &'static str,
    },
    /// Something that is given twice and can be given once.
    GivenTwice {
        /// What: `output`, `tolerance`, `estimate`, `conditions`.
        what: &'static str,
        /// The quantity that it is of.
        of: String,
    },
    /// Equations beside those that a typed measurement has.
    TypedEquations {
        /// The quantity of the first of them.
        name: String,
    },
    /// Another number of something than the model has.
    Count {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there must be.
        expected: usize,
    },
    /// A setting out of its range.
    Setting {
        /// The setting.
        name: &'static str,
        /// What it may be.
        range: &'static str,
    },
    /// Neither equations nor a typed measurement.
    NoModel,
}

impl fmt::Display for TaskError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unit { of, error } => write!(f, "the unit of `{of}`: {error}"),
            Self::WrongUnit { of, found, expected } => {
                write!(f, "`{of}` is in `{found}`, which cannot be converted to `{expected}`")
            }
            Self::WrongScale { of, unit, misfit } => {
                write!(f, "`{of}` cannot be given in `{unit}`: it {misfit}")
            }
            Self::ComponentUnit { of, found, expected } => {
                write!(f, "a component of `{of}` is in `{found}`, but must be in `{expected}`")
            }
            Self::Name { name, error } => {
                write!(f, "a quantity cannot be called `{name}`: {error}")
            }
            Self::NameTaken { name } => write!(f, "there are two quantities `{name}`"),
            Self::Unknown { name, kind } => write!(f, "there is no {kind} `{name}`"),
            Self::Missing { input } => write!(f, "the input `{input}` is not given"),
            Self::Formula { of, error } => write!(f, "the formula of `{of}`: {error}"),
            Self::Distribution { input, row, error } => {
                write!(f, "`{input}` in row {}: {error}", row + 1)
            }
            Self::Conditions { expected: 0, .. } => {
                f.write_str("there are rows of values, but no conditions")
            }
            Self::Conditions { row, expected } => {
                write!(f, "row {} of the conditions must have {expected} finite values", row + 1)
            }
            Self::Coefficient { between: [a, b], reason } => {
                write!(f, "the correlation coefficient of `{a}` and `{b}` {reason}")
            }
            Self::Correlation { message, .. } => f.write_str(message),
            Self::Tolerance { of, reason } => write!(f, "the tolerance of `{of}` {reason}"),
            Self::Requirement { of, reason } => write!(f, "`{of}` {reason}"),
            Self::GivenTwice { what, of } => write!(f, "`{of}`: the {what} is given twice"),
            Self::TypedEquations { name } => write!(
                f,
                "a typed measurement has equations of its own and takes no others, such as the \
                 equation of `{name}`; write the model in equations, or put the equation into the \
                 measurement"
            ),
            Self::Count { what, found, expected } => {
                write!(f, "the task has {found} {what}, and must have {expected} as its model is")
            }
            Self::Setting { name, range } => write!(f, "the {name} must be {range}"),
            Self::NoModel => {
                f.write_str("there is no model: neither equations nor a typed measurement")
            }
        }
    }
}

impl std::error::Error for TaskError {}
