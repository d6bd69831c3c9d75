//! Numbers in messages.

use std::fmt;

/// A number as the shortest decimal text that reads back as the same number, with an exponent from
/// 1e16 on and below 1e-5.
///
/// ```
/// use gumption_engine::number::Shortest;
///
/// let texts = [0.1, -4.0, 1e308, 2.5e-9].map(|x| Shortest(x).to_string());
/// assert_eq!(texts, ["0.1", "-4", "1e308", "2.5e-9"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortest(pub f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:?}", self.0);
        f.write_str(text.strip_suffix(".0").unwrap_or(&text))
    }
}
