//! Things a user should know about an answer that is given all the same.

/// A warning or a note beside a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// A short fixed name, such as `few-trials`.
    pub code: &'static str,
    /// The input, output or row that it is about; empty for the whole.
    pub place: String,
    /// The sentence.
    pub text: String,
}

impl Warning {
    /// A warning about `place`.
    pub fn new(code: &'static str, place: impl Into<String>, text: impl Into<String>) -> Self {
        Self { code, place: place.into(), text: text.into() }
    }
}
