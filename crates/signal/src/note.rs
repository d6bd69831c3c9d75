//! What is to be borne in mind about a channel, and how numbers stand in it.

/// A fixed short name, the channel, and the sentence.
pub(super) type Note = (&'static str, usize, String);

/// A number with so many digits.
pub(super) fn short(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    gumption_engine::number::Shortest(text.parse().unwrap_or(value)).to_string()
}
