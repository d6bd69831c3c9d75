//! The distributions that a budget or a certificate names in words, in several languages.

/// What a text says of a distribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedShape {
    /// One that a model file has.
    Known(&'static str),
    /// A t distribution, whose degrees of freedom must be said.
    Student,
    /// None that is known.
    Unknown,
}

impl NamedShape {
    /// What a model file calls it; `None` of one that it does not have.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::Known(name) => Some(name),
            Self::Student => Some("t"),
            Self::Unknown => None,
        }
    }

    /// The distribution that a text names; `None` where it names none.
    pub fn of(text: &str) -> Option<Self> {
        let words = text.trim().to_lowercase();
        let begins = |all: &[&str]| all.iter().any(|word| words.starts_with(word));
        if words.is_empty() || matches!(words.as_str(), "-" | "–" | "—") {
            return None;
        }
        let is = |letters: &[&str]| letters.contains(&words.as_str());
        Some(if begins(&["norm", "gau"]) || is(&["n"]) {
            Self::Known("normal")
        } else if begins(&["student", "t-", "t "]) || is(&["t"]) {
            Self::Student
        } else if begins(&["rect", "uniform", "rechteck", "gleich"]) || is(&["r"]) {
            Self::Known("rectangular")
        } else if begins(&["tri", "dreieck"]) {
            Self::Known("triangular")
        } else if begins(&["u-sh", "u sh", "arc", "u-f", "u-v", "ushape"]) || is(&["u"]) {
            Self::Known("arcsine")
        } else {
            Self::Unknown
        })
    }
}
