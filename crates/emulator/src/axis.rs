//! One parameter: its value, its normal score, and the scaled coordinate in which outputs are smooth.

use gumption_engine::distribution::Distribution;
use gumption_engine::number::elementary;
use gumption_engine::special::normal;

/// Standard deviations of the prior to one unit of the scaled coordinate of an unbounded parameter.
const DEVIATIONS: f64 = 3.0;

/// Scaled coordinates of unbounded parameters end here, at 7.5 standard deviations: a Gaussian process
/// knows nothing that far from its runs.
const FARTHEST: f64 = 2.5;

/// What lies outside of a bounded prior stands so far from its middle, whose ends are at 1: a little
/// beyond an end.
pub(crate) const BEYOND: f64 = 1.2;

/// The least probability left to a tail when the score of a value is asked for.
const LEAST: f64 = 1e-12;

/// Half of the difference of normal scores by which the slope of a quantile function is taken: its error is
/// about 1e-8 relative, from the third derivative and from rounding alike.
const STEP: f64 = 1e-4;

/// A scaled coordinate and how fast it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinate {
    /// The coordinate: about -1 to 1 over the prior.
    pub at: f64,
    /// Its derivative by what it was made from: the normal score or the value of the parameter.
    pub slope: f64,
}

impl Coordinate {
    /// Kept within limits about 0, beyond which it stands still.
    pub(crate) fn within(self, limit: f64) -> Self {
        if self.at.abs() <= limit { self } else { Self { at: limit.copysign(self.at), slope: 0.0 } }
    }
}

/// The prior of a parameter as a map between its values and normal scores.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Axis {
    /// Known exactly.
    Fixed(f64),
    Normal {
        mean: f64,
        deviation: f64,
    },
    /// Rectangular.
    Bounded {
        lower: f64,
        width: f64,
    },
    /// Rectangular in the logarithm.
    LogUniform {
        ln_lower: f64,
        ln_ratio: f64,
    },
    /// Any other, by its quantile function.
    Other {
        prior: Distribution,
        mean: f64,
        deviation: f64,
    },
}

impl Axis {
    pub(crate) fn of(prior: &Distribution) -> Self {
        let quartiles = [prior.quantile(0.25), prior.quantile(0.75)];
        match prior {
            _ if prior.constant().is_some() => Self::Fixed(prior.mean()),
            Distribution::Normal(_) if prior.is_drawn_normal() => {
                Self::Normal { mean: prior.mean(), deviation: prior.standard_uncertainty() }
            }
            Distribution::Rectangular(_) if prior.drawn_as().is_none() => {
                let width = 2.0 * (quartiles[1] - quartiles[0]);
                Self::Bounded { lower: quartiles[0] - 0.25 * width, width }
            }
            Distribution::LogUniform(_) => {
                let [lower, upper] = quartiles.map(elementary::ln);
                let ln_ratio = 2.0 * (upper - lower);
                Self::LogUniform { ln_lower: lower - 0.25 * ln_ratio, ln_ratio }
            }
            _ => Self::Other {
                prior: prior.clone(),
                mean: prior.mean(),
                deviation: prior.standard_uncertainty(),
            },
        }
    }

    /// The value at a normal score.
    pub(crate) fn value(&self, score: f64) -> f64 {
        match self {
            Self::Fixed(value) => *value,
            Self::Normal { mean, deviation } => mean + deviation * score,
            Self::Bounded { lower, width } => lower + width * normal::cdf(score),
            Self::LogUniform { ln_lower, ln_ratio } => {
                elementary::exp(ln_lower + ln_ratio * normal::cdf(score))
            }
            Self::Other { prior, .. } if score > 0.0 => {
                prior.quantile_upper(normal::sf(score).max(f64::MIN_POSITIVE))
            }
            Self::Other { prior, .. } => prior.quantile(normal::cdf(score).max(f64::MIN_POSITIVE)),
        }
    }

    /// The normal score of a value; at the ends of a bounded prior and beyond it about 7.
    pub(crate) fn score(&self, value: f64) -> f64 {
        match self {
            Self::Fixed(_) => 0.0,
            Self::Normal { mean, deviation } => (value - mean) / deviation,
            Self::Bounded { .. } | Self::LogUniform { .. } => {
                let at = self.of_value(value).at;
                let tail = (0.5 * (1.0 - at.abs())).max(LEAST);
                normal::quantile_upper(tail).copysign(at)
            }
            Self::Other { prior, .. } => prior.score_of(value),
        }
    }

    /// The coordinate of a normal score.
    pub(crate) fn of_score(&self, score: f64) -> Coordinate {
        match self {
            Self::Fixed(_) => Coordinate { at: 0.0, slope: 0.0 },
            Self::Normal { .. } => {
                let slope = 1.0 / DEVIATIONS;
                Coordinate { at: score * slope, slope }.within(FARTHEST)
            }
            Self::Bounded { .. } | Self::LogUniform { .. } => {
                let density = elementary::exp(-0.5 * score * score) * ROOT_TWO_OVER_PI;
                Coordinate { at: normal::cdf(score) - normal::sf(score), slope: density }
            }
            Self::Other { .. } => {
                let Coordinate { at, slope } = self.of_value(self.value(score));
                let rise = self.value(score + STEP) - self.value(score - STEP);
                Coordinate { at, slope: slope * rise / (2.0 * STEP) }
            }
        }
    }

    /// The coordinate of a value. What lies outside of a bounded prior is a little beyond its end.
    pub(crate) fn of_value(&self, value: f64) -> Coordinate {
        let bounded = |position: f64, slope: f64| {
            Coordinate { at: 2.0 * position - 1.0, slope: 2.0 * slope }.within(BEYOND)
        };
        match self {
            Self::Fixed(_) => Coordinate { at: 0.0, slope: 0.0 },
            Self::Normal { mean, deviation } | Self::Other { mean, deviation, .. } => {
                let slope = 1.0 / (DEVIATIONS * deviation);
                Coordinate { at: (value - mean) * slope, slope }.within(FARTHEST)
            }
            Self::Bounded { lower, width } => bounded((value - lower) / width, 1.0 / width),
            Self::LogUniform { .. } if value <= 0.0 => Coordinate { at: -BEYOND, slope: 0.0 },
            Self::LogUniform { ln_lower, ln_ratio } => {
                bounded((elementary::ln(value) - ln_lower) / ln_ratio, 1.0 / (ln_ratio * value))
            }
        }
    }

    /// Where the coordinate of a value is that makes an effect absent; `None` where the prior cannot come
    /// near it.
    pub(crate) fn neutral(&self, value: f64) -> Option<f64> {
        let at = self.of_value(value).at;
        match self {
            Self::Fixed(_) => None,
            // rounding may bring an end a little beyond itself
            Self::Bounded { .. } if at.abs() > 1.0 + 1e-9 => None,
            _ => Some(at),
        }
    }
}

/// Twice the density of a standard normal variable at 0.
const ROOT_TWO_OVER_PI: f64 = 0.797_884_560_802_865_4;

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::distribution::{Constant, LogUniform, Normal, Rectangular, Triangular};

    fn axes() -> Vec<Axis> {
        let triangle = Triangular::new(3.0, 2.0).unwrap();
        vec![
            Axis::of(&Normal::new(0.5, 0.001).unwrap().into()),
            Axis::of(&Rectangular::between(0.0, 0.2).unwrap().into()),
            Axis::of(&LogUniform::new(1e-4, 1e-1).unwrap().into()),
            Axis::of(&triangle.into()),
        ]
    }

    #[test]
    fn scores_and_values_belong_together() {
        for axis in axes() {
            for score in [-2.5, -0.3, 0.0, 1.7] {
                // halving finds scores to 1e-13, through a tail of 6e-3 of the probability
                let back = axis.score(axis.value(score));
                assert!((back - score).abs() < 1e-9, "{axis:?} {score} {back}");
                let (by_score, by_value) = (axis.of_score(score), axis.of_value(axis.value(score)));
                assert!((by_score.at - by_value.at).abs() < 1e-12, "{axis:?}");
            }
        }
    }

    /// Differences over 1e-5 have an error of 1e-10 of curvature and 1e-11 of rounding; what is taken by
    /// differences over 1e-4 itself 1e-8.
    #[test]
    fn slopes_are_those_of_the_coordinates() {
        for axis in axes() {
            for score in [-1.2, 0.4, 2.0] {
                let difference = axis.of_score(score + 1e-5).at - axis.of_score(score - 1e-5).at;
                let slope = axis.of_score(score).slope;
                assert!((difference / 2e-5 - slope).abs() < 1e-7 * (1.0 + slope), "{axis:?}");
                let value = axis.value(score);
                let step = 1e-5 * (axis.value(0.5) - axis.value(0.0));
                let difference = axis.of_value(value + step).at - axis.of_value(value - step).at;
                let slope = axis.of_value(value).slope;
                assert!((difference / (2.0 * step) / slope - 1.0).abs() < 1e-7, "{axis:?}");
            }
        }
    }

    #[test]
    fn neutral_values_are_at_their_coordinates() {
        let [normal, rectangle, logarithmic, _] = &axes()[..] else { unreachable!() };
        assert_eq!(normal.neutral(0.5), Some(0.0));
        assert!((rectangle.neutral(0.0).unwrap() + 1.0).abs() < 1e-12);
        assert_eq!(rectangle.neutral(1e6), None);
        assert_eq!(logarithmic.neutral(0.0), Some(-BEYOND));
        assert_eq!(logarithmic.neutral(1e9), Some(BEYOND));
        assert_eq!(Axis::of(&Constant::new(2.0).unwrap().into()).neutral(2.0), None);
        // a score far out stays where the outermost ones are
        assert_eq!(normal.of_score(40.0), Coordinate { at: FARTHEST, slope: 0.0 });
    }
}
