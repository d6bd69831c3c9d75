//! Published values recomputed (ISO/IEC 17025, 7.11): the printed value of a document next to the
//! value that this program computes.

use gumption_engine::task::Trials;
use serde::Deserialize;

/// A number that a document prints.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PublishedValue {
    /// The output; `None` if the value belongs to all outputs.
    pub output: Option<String>,
    /// Its path in the answer: `gum.interval[0]`.
    pub path: String,
    /// The number, in the unit of the output.
    pub value: f64,
    /// The largest difference, at least 0, that counts as agreement.
    pub tolerance: f64,
    /// Where the tolerance comes from.
    pub why: String,
}

/// Whether a recomputed value agrees with the published one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedVerdict {
    /// The difference is not larger than the tolerance.
    Pass,
    /// The difference is larger, or there is no recomputed value.
    Diff,
}

impl PublishedVerdict {
    /// The word that answers use.
    pub fn text(self) -> &'static str {
        match self {
            Self::Pass => "PASS",
            Self::Diff => "DIFF",
        }
    }
}

/// A published value and the value recomputed on this machine.
#[derive(Clone, Debug, PartialEq)]
pub struct RecomputedValue {
    /// What is published.
    pub published: PublishedValue,
    /// The figure in words.
    pub words: String,
    /// The recomputed value, if there is one.
    pub got: Option<f64>,
    /// Whether it agrees.
    pub verdict: PublishedVerdict,
}

impl RecomputedValue {
    /// A recomputed value beside the published one.
    pub fn new(published: PublishedValue, words: String, got: Option<f64>) -> Self {
        let near = got.is_some_and(|got| (got - published.value).abs() <= published.tolerance);
        let verdict = if near { PublishedVerdict::Pass } else { PublishedVerdict::Diff };
        Self { published, words, got, verdict }
    }
}

/// A published example with its recomputed values.
#[derive(Clone, Debug, PartialEq)]
pub struct RecomputedExample {
    /// Its name.
    pub name: String,
    /// The document.
    pub source: String,
    /// What a reader of the table should know.
    pub notes: String,
    /// Trials and seed; `None` without trials.
    pub trials: Option<(Trials, u64)>,
    /// Its values.
    pub rows: Vec<RecomputedValue>,
    /// Why the example could not be evaluated.
    pub failure: Option<String>,
}
