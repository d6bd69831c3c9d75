//! Conditions that follow from the order in which rows were taken.

use std::fmt;

use crate::Case;

/// What of the order of the rows a condition says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HistoryKind {
    /// The direction of a condition's last change: 1 up, -1 down, 0 before the first.
    Direction,
    /// The condition's value in the row before.
    Previous,
    /// The condition's value where it last turned round.
    Extreme,
    /// The time, or the number of rows, since the condition's last change.
    Since,
    /// How often the conditions have come to be as they are, this time included.
    Repetition,
    /// The number of the row in the order in which rows were taken.
    Order,
}

/// A condition that follows from the order of the rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct History {
    /// What it says.
    pub kind: HistoryKind,
    /// The place of the condition whose history it is, where it is that of one.
    pub of: Option<usize>,
}

impl HistoryKind {
    /// The name that formulas and answers have for it, of a condition of this name.
    ///
    /// ```
    /// use gumption_inference::HistoryKind;
    ///
    /// assert_eq!(HistoryKind::Since.name("m"), "since(m)");
    /// assert_eq!(HistoryKind::Repetition.name("m"), "repetition");
    /// ```
    pub fn name(self, condition: &str) -> String {
        match self {
            Self::Repetition | Self::Order => self.to_string(),
            _ => format!("{self}({condition})"),
        }
    }
}

impl fmt::Display for HistoryKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direction => "direction",
            Self::Previous => "previous",
            Self::Extreme => "extreme",
            Self::Since => "since",
            Self::Repetition => "repetition",
            Self::Order => "order",
        })
    }
}

impl Case {
    /// How many conditions are set or read: the first ones, which those that follow from the order of
    /// the rows and columns of a simulation come after.
    pub fn measured(&self) -> usize {
        self.described().saturating_sub(self.history.len())
    }

    /// How many conditions a departure may be a function of: all but the columns of a simulation.
    pub fn described(&self) -> usize {
        self.model.conditions.len().saturating_sub(self.simulated)
    }

    /// The places of the conditions that do not follow from the order of the rows.
    pub fn set_conditions(&self) -> impl Iterator<Item = usize> {
        (0..self.model.conditions.len()).filter(|&condition| self.history_of(condition).is_none())
    }

    /// The values of these in a row, by which rows are the same setting.
    pub(crate) fn setting(&self, row: usize) -> Vec<u64> {
        let conditions = &self.task.rows[row].conditions;
        self.set_conditions().map(|place| conditions[place].to_bits()).collect()
    }

    /// What a condition says of the order of the rows, if it follows from that.
    pub fn history_of(&self, condition: usize) -> Option<History> {
        let place = condition.checked_sub(self.measured())?;
        self.history.get(place).copied()
    }
}
