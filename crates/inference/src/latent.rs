//! The unknown quantities of a hypothesis, each as a score of zero mean and unit variance.
//!
//! A rectangular or log-uniform quantity is linear (or its logarithm is) in a score that is
//! rectangular itself, so that ridges of the posterior stay straight; every other quantity is the
//! quantile of its prior at the probability of a standard normal score.

use super::logarithm::HALF_LN_TWO_PI;
use gumption_engine::distribution::Distribution;
use gumption_engine::number::{COLUMN, Column, elementary};
use gumption_engine::special;

/// How a score becomes a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Map {
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
    /// Rectangular.
    Uniform {
        /// Lower bound.
        lower: f64,
        /// Distance of the bounds.
        width: f64,
    },
    /// Log-uniform.
    LogUniform {
        /// Logarithm of the lower bound.
        ln_lower: f64,
        /// Logarithm of the ratio of the bounds.
        ln_ratio: f64,
    },
    /// Any other, by its quantile function.
    Other(Distribution),
}

/// What an unknown quantity is.
#[derive(Clone, Debug)]
pub enum Role {
    /// A variable of the program: an input of the model or a parameter of an effect. Its prior at each
    /// point of the data, or one for all of them.
    Variable {
        /// Its place among the variables.
        place: usize,
        /// By point, or one for all.
        maps: Vec<Map>,
    },
    /// The logarithm of an output's standard deviation of noise, in the output's unit.
    Noise {
        /// The observed output.
        output: usize,
        /// Its prior.
        map: Map,
    },
    /// The power of the model's value that an output's noise is proportional to.
    Power {
        /// The observed output.
        output: usize,
        /// Its prior.
        map: Map,
    },
}

impl Map {
    /// The map of a distribution.
    pub fn of(distribution: &Distribution) -> Self {
        match distribution {
            Distribution::Normal(_) if distribution.is_drawn_normal() => Self::Normal {
                mean: distribution.mean(),
                deviation: distribution.standard_uncertainty(),
            },
            Distribution::Rectangular(_) if distribution.drawn_as().is_none() => {
                let (lower, upper) = (distribution.quantile(0.25), distribution.quantile(0.75));
                let width = 2.0 * (upper - lower);
                Self::Uniform { lower: lower - 0.25 * width, width }
            }
            Distribution::LogUniform(_) => {
                let (lower, upper) = (
                    elementary::ln(distribution.quantile(0.25)),
                    elementary::ln(distribution.quantile(0.75)),
                );
                let ln_ratio = 2.0 * (upper - lower);
                Self::LogUniform { ln_lower: lower - 0.25 * ln_ratio, ln_ratio }
            }
            other => Self::Other(other.clone()),
        }
    }

    /// Whether the score is rectangular, within [`EDGE`] of 0, and not standard normal.
    pub(crate) fn is_bounded(&self) -> bool {
        matches!(self, Self::Uniform { .. } | Self::LogUniform { .. })
    }

    /// The score that a standard normal one stands for.
    pub fn score_of(&self, normal: f64) -> f64 {
        if self.is_bounded() { bounded_from_normal(normal) } else { normal }
    }

    /// The score of a value, also beyond the ends of a rectangular prior; `None` of a prior that is
    /// only known by its quantiles, or where the value has no logarithm.
    pub(crate) fn score(&self, value: f64) -> Option<f64> {
        let score = match self {
            Self::Normal { mean, deviation } => (value - mean) / deviation,
            Self::Uniform { lower, width } => ((value - lower) / width - 0.5) * 2.0 * EDGE,
            Self::LogUniform { ln_lower, ln_ratio } => {
                ((elementary::ln(value) - ln_lower) / ln_ratio - 0.5) * 2.0 * EDGE
            }
            Self::Other(_) => return None,
        };
        score.is_finite().then_some(score)
    }

    /// The value of a score.
    pub fn value(&self, score: f64) -> f64 {
        let share = 0.5 + score / (2.0 * EDGE);
        match self {
            Self::Normal { mean, deviation } => mean + deviation * score,
            Self::Uniform { lower, width } => lower + width * share,
            Self::LogUniform { ln_lower, ln_ratio } => elementary::exp(ln_lower + ln_ratio * share),
            Self::Other(distribution) if score > 0.0 => {
                distribution.quantile_upper(special::normal::sf(score).max(f64::MIN_POSITIVE))
            }
            Self::Other(distribution) => {
                distribution.quantile(special::normal::cdf(score).max(f64::MIN_POSITIVE))
            }
        }
    }
}

/// Where rectangular scores end: they have unit variance.
pub(crate) const EDGE: f64 = 1.732_050_807_568_877_2;

/// A rectangular score beyond this share of its range is at a bound.
pub(crate) const AT_BOUND: f64 = 0.98;

/// The logarithm of the density of a rectangular score, times the root of two pi as that of a normal
/// one is given everywhere.
pub(crate) const LN_BOUNDED: f64 = HALF_LN_TWO_PI - 1.242_453_324_894_000_3;

/// The rectangular score at the probability of a standard normal one.
pub(crate) fn bounded_from_normal(normal: f64) -> f64 {
    EDGE * (2.0 * special::normal::cdf(normal) - 1.0)
}

/// The logarithm of the prior density of a score, times the root of two pi.
pub(crate) fn ln_prior(bounded: bool, score: f64) -> f64 {
    if !bounded {
        -0.5 * score * score
    } else if score.abs() <= EDGE {
        LN_BOUNDED
    } else {
        f64::NEG_INFINITY
    }
}

/// The logarithm of the prior density at a column of points, without the constant of normal scores.
pub(crate) fn ln_priors(bounded: &[bool], scores: &[Column]) -> [f64; COLUMN] {
    let mut sums = [0.0; COLUMN];
    for (bounded, column) in bounded.iter().zip(scores) {
        for (sum, score) in sums.iter_mut().zip(&column.0) {
            *sum += ln_prior(*bounded, *score);
        }
    }
    sums
}

impl Role {
    /// Its prior, at the first point of the data.
    pub(crate) fn map(&self) -> Option<&Map> {
        self.maps().first()
    }

    /// Its prior at each point of the data, or one for all of them.
    pub(crate) fn maps(&self) -> &[Map] {
        match self {
            Self::Variable { maps, .. } => maps,
            Self::Noise { map, .. } | Self::Power { map, .. } => std::slice::from_ref(map),
        }
    }

    /// Whether two roles are of the same quantity, whatever is known of it.
    pub(crate) fn is_same_quantity(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Variable { place: a, .. }, Self::Variable { place: b, .. })
            | (Self::Noise { output: a, .. }, Self::Noise { output: b, .. })
            | (Self::Power { output: a, .. }, Self::Power { output: b, .. }) => a == b,
            _ => false,
        }
    }

    /// Whether its score is rectangular.
    pub(crate) fn is_bounded(&self) -> bool {
        self.map().is_some_and(Map::is_bounded)
    }

    /// Whether it belongs to the noise and not to the model.
    pub(crate) fn is_noise(&self) -> bool {
        !matches!(self, Self::Variable { .. })
    }
}

/// Scores of the unknown quantities `from` at one point as those of `to`; `None` where a quantity has a
/// prior from which its values cannot be taken back.
pub(crate) fn converted_point(scores: &[f64], from: &[Role], to: &[Role]) -> Option<Vec<f64>> {
    let score = |role: &Role| match from.iter().position(|other| other.is_same_quantity(role)) {
        None => score_of_none(role),
        Some(at) => score_as(*scores.get(at)?, &from[at], role),
    };
    to.iter().map(score).collect()
}

/// The score of a quantity that is taken for certain elsewhere: the factor of uncertainties that are
/// right is one, whose logarithm is zero.
pub(crate) fn score_of_none(role: &Role) -> Option<f64> {
    role.map().and_then(|map| map.score(0.0))
}

/// The score of the same value with another prior.
pub(crate) fn score_as(score: f64, from: &Role, to: &Role) -> Option<f64> {
    let (theirs, own) = (from.map()?, to.map()?);
    if theirs == own { Some(score) } else { own.score(theirs.value(score)) }
}
