//! What a user should know about an answer that is given all the same.

use crate::fact::Fact;

/// A warning or a note beside a result. A report has its sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The input, output or row that it is about; empty for the whole.
    pub place: String,
    /// What was found.
    pub fact: Fact,
    /// Where that is, as a part before its sentence: a row, another file.
    pub within: Option<Fact>,
}

impl Warning {
    /// A warning about `place`.
    pub fn new(place: impl Into<String>, fact: Fact) -> Self {
        Self { place: place.into(), fact, within: None }
    }

    /// The same with that part before its sentence.
    #[must_use]
    pub fn within(self, part: Fact) -> Self {
        Self { within: Some(part), ..self }
    }

    /// A short fixed name, such as `few-trials`.
    pub fn code(&self) -> &'static str {
        self.fact.code()
    }
}
