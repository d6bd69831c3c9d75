//! The coverage that an evaluation is asked for.

use crate::special;

/// Coverage probabilities that are approximately 95 %, of factors from 1.92 to 2.06.
const ABOUT_95: std::ops::RangeInclusive<f64> = 0.945..=0.96;

/// A coverage probability, or the coverage factor that accreditation practice names instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coverage {
    /// What is usual where nobody states a coverage: the factor 2 for infinite degrees of freedom,
    /// approximately 95 % (EA-4/02, 5.1; ILAC-P14). No factor is given by it where the degrees of
    /// freedom are undefined.
    Usual,
    /// The coverage probability p, 0 < p < 1.
    Probability(f64),
    /// The coverage factor K, above 0 and at most 8, for infinite degrees of freedom; it sets the probability.
    Factor {
        /// K.
        factor: f64,
        /// Whether K is kept whatever the degrees of freedom.
        fixed: bool,
    },
}

/// What is usual.
impl Default for Coverage {
    fn default() -> Self {
        Self::Usual
    }
}

/// A coverage probability.
impl From<f64> for Coverage {
    fn from(probability: f64) -> Self {
        Self::Probability(probability)
    }
}

impl Coverage {
    /// This coverage factor in place of what is here; one that is kept fixed is kept fixed.
    #[must_use]
    pub fn with_factor(self, factor: f64) -> Self {
        Self::Factor { factor, fixed: matches!(self, Self::Factor { fixed: true, .. }) }
    }

    /// What it must be, where it is out of its range.
    pub(crate) fn fault(self) -> Option<&'static str> {
        match self {
            Self::Probability(p) if !(p > 0.0 && p < 1.0) => Some("a probability between 0 and 1"),
            Self::Factor { factor, .. } if !(factor > 0.0 && factor <= 8.0) => {
                Some("a factor above 0 and at most 8")
            }
            _ => None,
        }
    }

    /// The coverage probability: 0.9545 for K = 2 (EA-4/02, 5.1), else 2 Phi(K) - 1.
    pub fn probability(self) -> f64 {
        match self {
            Self::Probability(p) => p,
            Self::Usual | Self::Factor { factor: 2.0, .. } => 0.9545,
            Self::Factor { factor, .. } => 1.0 - 2.0 * special::normal::sf(factor),
        }
    }

    /// Whether it is approximately 95 %, as capabilities of laboratories and the guard bands of ILAC-G8
    /// have it.
    pub fn is_about_95(self) -> bool {
        ABOUT_95.contains(&self.probability())
    }

    /// The coverage factor of a normal distribution.
    pub fn normal_factor(self) -> f64 {
        let of_probability = || special::normal::quantile(0.5 + 0.5 * self.probability());
        self.nominal_factor().unwrap_or_else(of_probability)
    }

    /// The factor that the file gives, if it gives one.
    pub fn given_factor(self) -> Option<f64> {
        match self {
            Self::Probability(_) | Self::Usual => None,
            Self::Factor { factor, .. } => Some(factor),
        }
    }

    /// The factor for infinite degrees of freedom that sets the probability, where one does.
    pub fn nominal_factor(self) -> Option<f64> {
        match self {
            Self::Usual => Some(2.0),
            Self::Probability(_) | Self::Factor { .. } => self.given_factor(),
        }
    }
}
