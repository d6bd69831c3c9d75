//! The distributions that budgets and certificates name in words, in several languages.

/// What a text says about a distribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedShape {
    /// A distribution of model files.
    Known(&'static str),
    /// A t distribution; its degrees of freedom must be given.
    Student,
    /// None that is known.
    Unknown,
}

impl NamedShape {
    /// Its name in a model file; `None` if model files have no such distribution.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::Known(name) => Some(name),
            Self::Student => Some("t"),
            Self::Unknown => None,
        }
    }

    /// The distribution that a text names; `None` if it names none.
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
