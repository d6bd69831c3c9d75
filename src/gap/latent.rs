//! The unknown quantities of a hypothesis, each as a standard normal score.
//!
//! A value is the quantile of its prior distribution at the probability of its score, so that the
//! prior of all scores together is the standard normal one, whatever the distributions are.

use crate::distribution::{Distribution, special};

/// How a score becomes a value.
#[derive(Clone, Debug)]
pub(crate) enum Map {
    Normal { mean: f64, deviation: f64 },
    Uniform { lower: f64, width: f64 },
    LogUniform { ln_lower: f64, ln_ratio: f64 },
    Other(Distribution),
}

/// What an unknown quantity is.
#[derive(Clone, Debug)]
pub(crate) enum Role {
    /// A variable of the program: an input of the sim or a parameter of an effect. Its prior at each
    /// point of the data, or one for all of them.
    Variable { place: usize, maps: Vec<Map> },
    /// The logarithm of an output's standard deviation of noise, in the output's unit.
    Noise { output: usize, map: Map },
    /// The power of the sim's value that an output's noise is proportional to.
    Power { output: usize, map: Map },
}

impl Map {
    pub(crate) fn of(distribution: &Distribution) -> Self {
        match distribution {
            Distribution::Normal(_) if distribution.is_drawn_normal() => Self::Normal {
                mean: distribution.mean(),
                deviation: distribution.standard_uncertainty(),
            },
            Distribution::Rectangular(_) => {
                let (lower, upper) = (distribution.quantile(0.25), distribution.quantile(0.75));
                let width = 2.0 * (upper - lower);
                Self::Uniform { lower: lower - 0.25 * width, width }
            }
            Distribution::LogUniform(_) => {
                let (lower, upper) =
                    (distribution.quantile(0.25).ln(), distribution.quantile(0.75).ln());
                let ln_ratio = 2.0 * (upper - lower);
                Self::LogUniform { ln_lower: lower - 0.25 * ln_ratio, ln_ratio }
            }
            other => Self::Other(other.clone()),
        }
    }

    /// The value of a score.
    pub(crate) fn value(&self, score: f64) -> f64 {
        match self {
            Self::Normal { mean, deviation } => mean + deviation * score,
            Self::Uniform { lower, width } => lower + width * special::normal::cdf(score),
            Self::LogUniform { ln_lower, ln_ratio } => {
                (ln_lower + ln_ratio * special::normal::cdf(score)).exp()
            }
            Self::Other(distribution) if score > 0.0 => {
                distribution.quantile_upper(special::normal::sf(score).max(f64::MIN_POSITIVE))
            }
            Self::Other(distribution) => {
                distribution.quantile(special::normal::cdf(score).max(f64::MIN_POSITIVE))
            }
        }
    }
}

impl Role {
    /// Whether it belongs to the noise and not to the sim.
    pub(crate) fn is_noise(&self) -> bool {
        !matches!(self, Self::Variable { .. })
    }
}
