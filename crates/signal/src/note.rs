//! What is to be borne in mind about a channel, and how numbers stand in it.

use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::Shortest;

/// What to bear in mind about a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChannelNote {
    /// The channel, by its place among those of the recipe.
    pub channel: usize,
    /// What was found.
    pub fact: Fact,
}

impl ChannelNote {
    /// A short fixed name, such as `near-noise`.
    pub fn code(&self) -> &'static str {
        self.fact.code()
    }
}

/// A number with so many digits.
pub(super) fn short(value: f64, digits: usize) -> Argument {
    in_unit(value, digits, "")
}

/// A number with so many digits and its unit, which begins with a space.
pub(super) fn in_unit(value: f64, digits: usize, unit: &str) -> Argument {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let shortest = Shortest(text.parse().unwrap_or(value));
    Argument::Number(format!("{shortest}{unit}"))
}
