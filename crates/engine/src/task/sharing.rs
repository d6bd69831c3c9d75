//! In which rows of a sweep a variable has the same value.

use std::collections::HashMap;

use crate::model::Quantity;

/// In which rows of a sweep a variable has the same unknown value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// One value for all rows.
    All,
    /// A value of its own in every row.
    Row,
    /// One value for each value of the condition of this index.
    Condition(usize),
}

impl Sharing {
    /// The conditions that a variable has a value of its own for, with their values, in words; `None`
    /// where all rows share one.
    pub(crate) fn conditions_of(&self, names: &[Quantity], values: &[f64]) -> Option<String> {
        let of = names.iter().zip(values).enumerate().filter(|(place, _)| match self {
            Self::All => false,
            Self::Row => true,
            Self::Condition(own) => place == own,
        });
        let words: Vec<String> =
            of.map(|(_, (of, value))| format!("{} = {value}", of.name)).collect();
        (!words.is_empty()).then(|| words.join(", "))
    }

    /// Which of the rows have a value in common: equal keys.
    fn keys<R: AsRef<[f64]>>(&self, rows: &[R]) -> Vec<Vec<u64>> {
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect();
        let key = |row: &R| match self {
            Self::All => Vec::new(),
            Self::Row => bits(row.as_ref()),
            Self::Condition(index) => bits(row.as_ref().get(*index..=*index).unwrap_or_default()),
        };
        rows.iter().map(key).collect()
    }

    /// Whether two variables have their values in common over the same rows; `rows` are the values
    /// of the conditions. A coefficient between variables that have not would tie rows to each other
    /// that are said to be independent.
    pub fn is_alike<R: AsRef<[f64]>>(&self, other: &Self, rows: &[R]) -> bool {
        if self == other {
            return true;
        }
        let (a, b) = (self.keys(rows), other.keys(rows));
        let (mut forth, mut back) = (HashMap::new(), HashMap::new());
        a.iter()
            .zip(&b)
            .all(|(a, b)| *forth.entry(a).or_insert(b) == b && *back.entry(b).or_insert(a) == a)
    }
}
