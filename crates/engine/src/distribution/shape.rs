//! The trait of all distributions, and the errors of their parameters.

use std::fmt;

use super::Distribution;
use super::stream::Stream;
use crate::number::{Column, Shortest};

/// A probability distribution of one quantity.
///
/// The law of propagation uses [`Shape::mean`], [`Shape::standard_uncertainty`] and [`Shape::dof`];
/// Monte Carlo uses [`Shape::draw`] and, for dependent quantities, [`Shape::quantile`].
pub(crate) trait Shape {
    /// The canonical name, as in files and budgets.
    const NAME: &'static str;

    /// The name of this distribution, if not all of the kind have the same.
    fn name(&self) -> &'static str {
        Self::NAME
    }

    /// The estimate: the expectation.
    fn mean(&self) -> f64;

    /// The standard uncertainty for the law of propagation: the standard deviation, but the scale
    /// of a t distribution (JCGM 100, 4.2.3 and G.3).
    fn standard_uncertainty(&self) -> f64;

    /// Degrees of freedom of the standard uncertainty; infinite unless it was estimated.
    fn dof(&self) -> f64 {
        f64::INFINITY
    }

    /// The divisor of the stated width (the half-width of the limits, an expanded uncertainty, the
    /// standard uncertainty itself) that gives the standard uncertainty; `None` for a shape that is
    /// not stated by one width.
    fn divisor(&self) -> Option<f64> {
        None
    }

    /// Degrees of freedom of the t distribution from which trials are drawn, infinite for all other
    /// shapes. Moments of that order and above do not exist.
    fn drawn_dof(&self) -> f64 {
        f64::INFINITY
    }

    /// The name of the distribution from which trials are drawn, if it is another shape because the
    /// standard uncertainty has finite degrees of freedom.
    fn drawn_as(&self) -> Option<&'static str> {
        None
    }

    /// Standard deviation of the drawn values; infinite if it does not exist.
    fn standard_deviation(&self) -> f64 {
        self.standard_uncertainty()
    }

    /// The value below which the drawn quantity lies with probability `p`, 0 < p < 1.
    fn quantile(&self, p: f64) -> f64;

    /// The value above which the drawn quantity lies with probability `q`, 0 < q < 1. If 1 - `q`
    /// rounds to 1, the default stays at the largest double below 1; a shape with a relevant tail
    /// overrides it.
    fn quantile_upper(&self, q: f64) -> f64 {
        self.quantile((1.0 - q).min(1.0 - 0.5 * f64::EPSILON))
    }

    /// Fills a column with independent draws.
    fn draw(&self, stream: &mut Stream, out: &mut Column);

    /// The distribution of the value times a factor above 0, as in another unit; `None` if the
    /// result is not finite, and for shapes for which it is not needed.
    fn times(&self, _factor: f64) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The distribution if its standard uncertainty were known exactly, with infinite degrees of
    /// freedom; `None` if it is, and for shapes that have no such counterpart.
    fn with_infinite_dof(&self) -> Option<Distribution> {
        None
    }

    /// The same distribution with its estimate moved to `estimate`. A shape with a location is
    /// shifted with its limits; a shape of positive quantities decides what it keeps.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid>
    where
        Self: Sized;
}

/// Why a distribution cannot be constructed from the given numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Invalid {
    /// A parameter is infinite or not a number.
    NotFinite {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter must be above zero.
    NotPositive {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter lies outside its range.
    OutOfRange {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The range, in words.
        range: &'static str,
    },
    /// The lower limit is not below the upper one.
    LimitsReversed {
        /// The lower limit.
        lower: f64,
        /// The upper limit.
        upper: f64,
    },
    /// A Type A evaluation needs at least two readings.
    TooFewReadings {
        /// Their number.
        count: usize,
    },
    /// All readings are equal, so their scatter says nothing about the uncertainty.
    NoScatter {
        /// The number of readings.
        count: usize,
    },
    /// The readings differ, but by so much or so little that their variance overflows or vanishes.
    ScatterOutOfRange {
        /// The number of readings.
        count: usize,
    },
    /// An empirical distribution needs at least two samples.
    TooFewSamples {
        /// Their number.
        count: usize,
    },
    /// All samples are equal, so the quantity does not vary.
    EqualSamples {
        /// The number of samples.
        count: usize,
    },
    /// Too few paired readings for a joint distribution with a covariance.
    TooFewPaired {
        /// Number of readings of each quantity.
        count: usize,
        /// The number of paired quantities.
        together: usize,
    },
    /// The draws of a distribution contradict its stated parameters.
    NotOfDraws {
        /// Name of the parameter.
        parameter: &'static str,
        /// The stated value; for a quantile its probability.
        stated: f64,
        /// The value of the draws.
        found: f64,
    },
    /// The width is lost in the rounding of the estimate.
    WidthLost {
        /// Name of the width.
        parameter: &'static str,
        /// The width.
        value: f64,
        /// The estimate.
        estimate: f64,
    },
}

impl Invalid {
    /// The invalid parameter, by its name in files.
    pub fn parameter(&self) -> &'static str {
        match self {
            Self::NotFinite { parameter, .. }
            | Self::NotPositive { parameter, .. }
            | Self::OutOfRange { parameter, .. }
            | Self::NotOfDraws { parameter, .. }
            | Self::WidthLost { parameter, .. } => parameter,
            Self::LimitsReversed { .. } => "upper",
            Self::TooFewReadings { .. }
            | Self::NoScatter { .. }
            | Self::ScatterOutOfRange { .. }
            | Self::TooFewSamples { .. }
            | Self::EqualSamples { .. }
            | Self::TooFewPaired { .. } => "values",
        }
    }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { parameter, value } => {
                write!(f, "{parameter} is {}, but must be a finite number", Shortest(*value))
            }
            Self::NotPositive { parameter, value } => {
                write!(f, "{parameter} is {}, but must be above zero", Shortest(*value))
            }
            Self::OutOfRange { parameter, value, range } => {
                write!(f, "{parameter} is {}, but must be {range}", Shortest(*value))
            }
            Self::LimitsReversed { lower, upper } => {
                let (lower, upper) = (Shortest(*lower), Shortest(*upper));
                write!(f, "the lower limit {lower} is not below the upper limit {upper}")
            }
            Self::TooFewReadings { count } => {
                write!(f, "a Type A evaluation needs at least two readings, not {count}")
            }
            Self::NoScatter { count } => write!(
                f,
                "all {count} readings are equal, so they show no scatter to evaluate; \
                 state the resolution as a rectangular distribution"
            ),
            Self::ScatterOutOfRange { count } => write!(
                f,
                "the variance of these {count} readings is beyond what numbers of double precision \
                 can be; give them in another unit"
            ),
            Self::TooFewSamples { count } => {
                write!(f, "an empirical distribution needs at least two samples, not {count}")
            }
            Self::EqualSamples { count } => write!(
                f,
                "all {count} samples are equal, so nothing varies; state a constant, or the \
                 resolution as a rectangular distribution"
            ),
            Self::TooFewPaired { count, together } => write!(
                f,
                "{count} readings of each of {together} paired quantities are too few for their \
                 joint distribution to have a covariance; at least {} are needed (JCGM 102, 5.3). \
                 With fewer, evaluate by the law of propagation alone, without trials (`\"trials\": \
                 0`), or give each quantity its mean, the standard uncertainty and degrees of \
                 freedom of that, and their `correlations` (JCGM 100, 5.2.3)",
                together + 3
            ),
            Self::NotOfDraws { parameter: "quantile", stated, found } => write!(
                f,
                "the quantile of the probability {} has the share {} of the draws below it; do both \
                 have the same parameters?",
                Shortest(*stated),
                Shortest(*found)
            ),
            Self::NotOfDraws { parameter, stated, found } => write!(
                f,
                "{parameter} is {}, but it is {} for the draws; do both have the same parameters?",
                Shortest(*stated),
                Shortest(*found)
            ),
            Self::WidthLost { parameter, value, estimate } => {
                let (value, estimate) = (Shortest(*value), Shortest(*estimate));
                write!(
                    f,
                    "{parameter} is {value}, which is lost in the rounding of the estimate \
                     {estimate}"
                )
            }
        }
    }
}

impl std::error::Error for Invalid {}

/// The value if it is finite.
pub(crate) fn finite(parameter: &'static str, value: f64) -> Result<f64, Invalid> {
    if value.is_finite() { Ok(value) } else { Err(Invalid::NotFinite { parameter, value }) }
}

/// The value if it is finite and above zero.
pub(crate) fn positive(parameter: &'static str, value: f64) -> Result<f64, Invalid> {
    let value = finite(parameter, value)?;
    if value > 0.0 { Ok(value) } else { Err(Invalid::NotPositive { parameter, value }) }
}

/// Degrees of freedom: above zero, infinite allowed.
pub(crate) fn degrees_of_freedom(value: f64) -> Result<f64, Invalid> {
    if value > 0.0 { Ok(value) } else { Err(Invalid::NotPositive { parameter: "dof", value }) }
}

/// Degrees of freedom of a t distribution that is drawn: at least 0.2, infinite allowed. With
/// fewer, a draw can exceed the largest `f64`.
pub(crate) fn drawn_degrees_of_freedom(value: f64) -> Result<f64, Invalid> {
    let value = degrees_of_freedom(value)?;
    if value >= 0.2 {
        Ok(value)
    } else {
        Err(Invalid::OutOfRange { parameter: "dof", value, range: "at least 0.2" })
    }
}

/// The value if it lies from `least` to `most`; `range` describes this in words.
pub(crate) fn within(
    parameter: &'static str,
    value: f64,
    least: f64,
    most: f64,
    range: &'static str,
) -> Result<f64, Invalid> {
    let value = finite(parameter, value)?;
    if value >= least && value <= most {
        Ok(value)
    } else {
        Err(Invalid::OutOfRange { parameter, value, range })
    }
}

/// Centre and half-width of two limits.
pub(crate) fn limits(lower: f64, upper: f64) -> Result<(f64, f64), Invalid> {
    let (lower, upper) = (finite("lower", lower)?, finite("upper", upper)?);
    // halves first: the sum or difference of huge limits would overflow
    let (centre, half_width) = (0.5 * lower + 0.5 * upper, 0.5 * upper - 0.5 * lower);
    if lower < upper {
        Ok((centre, half_width))
    } else {
        Err(Invalid::LimitsReversed { lower, upper })
    }
}
