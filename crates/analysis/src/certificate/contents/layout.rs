//! The tables of a certificate as a laboratory lays them out: columns of reference, indication,
//! error, expanded uncertainty, coverage factor, limits and decision.

use super::Localized;
use gumption_units::Unit;

/// A table of results with columns of its own.
#[derive(Clone, Debug)]
pub struct LayoutTable {
    /// The name by which rows choose the table; `None` for the only table.
    pub name: Option<String>,
    /// What stands above the table.
    pub title: Option<Localized>,
    /// The columns, in order; at least one.
    pub columns: Vec<LayoutColumn>,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub struct LayoutColumn {
    /// The output, input or condition that it is about; for [`ColumnContent::Label`] it is not used.
    pub quantity: String,
    /// What it shows of that quantity.
    pub content: ColumnContent,
    /// What stands above it instead of the name of the quantity.
    pub heading: Option<Localized>,
    /// The unit of its numbers.
    pub unit: ColumnUnit,
    /// The number of decimals of an input or a condition; `None` for the digits that it has.
    pub decimals: Option<u32>,
}

/// What a column shows of its quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnContent {
    /// The stated value of an output, the estimate of an input, or the value of a condition.
    Value,
    /// The expanded uncertainty U of an output.
    Expanded,
    /// The coverage factor k of an output.
    Factor,
    /// The effective degrees of freedom from which k follows.
    Dof,
    /// The coverage probability in percent.
    Probability,
    /// The tolerance limits of an output.
    Limits,
    /// Whether an output conforms to its tolerance.
    Decision,
    /// The label of the row.
    Label,
}

impl ColumnContent {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Value,
        Self::Expanded,
        Self::Factor,
        Self::Dof,
        Self::Probability,
        Self::Limits,
        Self::Decision,
        Self::Label,
    ];

    /// The name that files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Expanded => "U",
            Self::Factor => "k",
            Self::Dof => "nu_eff",
            Self::Probability => "p",
            Self::Limits => "limits",
            Self::Decision => "decision",
            Self::Label => "label",
        }
    }

    /// The content of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|content| content.name() == name)
    }
}

/// The unit of the numbers of a column.
#[derive(Clone, Debug)]
pub enum ColumnUnit {
    /// That of the quantity; for U of a level with a reference the unit of differences, dB.
    Own,
    /// Another unit of the same kind, to which the numbers are converted.
    Other(Unit),
    /// A unit without dimension such as `%` or `ppm`: U relative to the modulus of a value
    /// (ISO/IEC 17025:2017, 7.8.4.1 a).
    Relative {
        /// The unit.
        unit: Unit,
        /// The quantity to whose value it is relative.
        to: String,
    },
}
