//! Reports of comparisons, one file for each format.

mod csv;
mod figure;
mod gauge;
mod json;
mod page;
mod proficiency;
mod sheets;
mod words;

pub use csv::csv;
pub use json::json;
pub use page::{html, markdown, table};

use gumption_analysis::compare::{
    ComparedPair, Comparison, GaugeStudy, ProficiencyTest, ResultPair,
};

/// A comparison.
#[derive(Clone, Debug)]
pub enum Compare {
    /// Results two by two.
    Pairs {
        /// The results.
        pairs: Vec<ResultPair>,
        /// Their comparisons, in the same order.
        compared: Vec<ComparedPair>,
        /// Their units, in the same order; empty if unknown.
        units: Vec<String>,
        /// Whether the range that printed digits allow is requested.
        rounding: bool,
    },
    /// The results of many laboratories.
    Laboratories {
        /// The comparison.
        comparison: Comparison,
        /// The unit of all of them; empty if none is stated.
        unit: String,
    },
    /// The scores of a proficiency test.
    Proficiency {
        /// The scores.
        test: ProficiencyTest,
        /// The unit of all results; empty if none is stated.
        unit: String,
    },
    /// Repeatability and reproducibility of a gauge.
    Gauge {
        /// The study.
        study: GaugeStudy,
        /// The unit of all readings; empty if none is stated.
        unit: String,
    },
}

impl Compare {
    /// Whether everything is compatible: all normalized errors at most 1, laboratories consistent,
    /// no action signal, and a gauge that is not refused.
    pub fn is_compatible(&self) -> bool {
        match self {
            Self::Pairs { compared, .. } => compared.iter().all(ComparedPair::is_compatible),
            Self::Laboratories { comparison, .. } => comparison.all.is_consistent(),
            Self::Proficiency { test, .. } => test.is_satisfied(),
            Self::Gauge { study, .. } => study.is_acceptable(),
        }
    }
}
