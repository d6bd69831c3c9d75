//! Why a curve cannot be fitted.

use std::fmt;

/// A coordinate of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// The abscissae.
    X,
    /// The ordinates.
    Y,
    /// Covariances of the two.
    Both,
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Both => "x with y",
        })
    }
}

/// Why a curve cannot be fitted to points. `Display` gives a sentence without a capital; points count
/// from 1 there.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RegressionError {
    /// Another number of values than of points.
    Length {
        /// Of what.
        coordinate: Coordinate,
        /// The expected number.
        expected: usize,
        /// Their number.
        found: usize,
    },
    /// A number that is infinite or NaN.
    NotFinite {
        /// Of what.
        coordinate: Coordinate,
        /// The point, from 0.
        point: usize,
    },
    /// A variance that is not positive.
    NoVariance {
        /// Of what.
        coordinate: Coordinate,
        /// The point, from 0.
        point: usize,
    },
    /// A covariance matrix that is not positive definite.
    NotDefinite {
        /// The coordinate whose rows fail, if it is only one.
        coordinate: Option<Coordinate>,
        /// The point up to which it is positive definite, from 0.
        point: usize,
    },
    /// Fewer points than the curve needs.
    TooFewPoints {
        /// Their number.
        points: usize,
        /// The number of parameters of the curve.
        parameters: usize,
        /// The smallest number of points that can, with the uncertainties estimated from the
        /// residuals if none are known.
        needed: usize,
        /// Whether the uncertainties are also estimated from the residuals.
        estimated: bool,
    },
    /// Fewer different abscissae than coefficients of the polynomial.
    TooFewAbscissae {
        /// Their number.
        different: usize,
        /// The number of coefficients of the polynomial.
        parameters: usize,
    },
    /// Parameters that the points cannot distinguish from the others.
    Dependent {
        /// The parameter, from 0.
        parameter: usize,
    },
    /// The uncertainties of the abscissae are stated but those of the ordinates are not.
    OrdinatesUnknown,
    /// The curve has no value at a point.
    Undefined {
        /// The point, from 0.
        point: usize,
    },
    /// The iteration does not converge to a minimum.
    NotConverged {
        /// The number of steps.
        steps: usize,
    },
    /// The points lie exactly on the curve, so that their uncertainty cannot be estimated.
    NoScatter,
    /// Either the curve or the ordinates are complex, and the other side is real.
    Complexity {
        /// Whether the curve is complex.
        curve: bool,
    },
}

impl RegressionError {
    /// The same with another index of the point.
    pub(super) fn at_point(mut self, index: impl Fn(usize) -> usize) -> Self {
        if let Self::NotFinite { point, .. }
        | Self::NoVariance { point, .. }
        | Self::NotDefinite { point, .. } = &mut self
        {
            *point = index(*point);
        }
        self
    }
}

impl fmt::Display for RegressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { coordinate, expected, found } => {
                write!(f, "{expected} numbers of {coordinate} are needed, but there are {found}")
            }
            Self::NotFinite { coordinate, point } => {
                write!(f, "{coordinate} of point {} is not a finite number", point + 1)
            }
            Self::NoVariance { coordinate, point } => {
                write!(f, "the uncertainty of {coordinate} of point {} is not above 0", point + 1)
            }
            Self::NotDefinite { coordinate: None, point } => write!(
                f,
                "the covariance of x and y of point {} is not below the product of their standard \
                 uncertainties",
                point + 1
            ),
            Self::NotDefinite { coordinate: Some(coordinate), point } => write!(
                f,
                "the covariance matrix is not positive definite: {coordinate} of point {} would be \
                 known exactly, or better, from those before it",
                point + 1
            ),
            Self::TooFewPoints { points, parameters, estimated: false, .. } => {
                write!(f, "{points} points cannot determine {parameters} parameters")
            }
            Self::TooFewPoints { points, parameters, needed, estimated: true } => write!(
                f,
                "{points} points cannot determine {parameters} parameters and the scatter about \
                 the curve; state the standard uncertainties of y, or take {needed} points or more"
            ),
            Self::TooFewAbscissae { different, parameters } => write!(
                f,
                "x has {different} different value{}, but a curve with {parameters} coefficients \
                 needs {parameters}",
                if *different == 1 { "" } else { "s" }
            ),
            Self::Dependent { .. } => f.write_str("the points cannot distinguish all parameters"),
            Self::OrdinatesUnknown => f.write_str(
                "the uncertainties of x are stated, but not the uncertainties of y; state both, \
                 or neither",
            ),
            Self::Undefined { point } => {
                write!(
                    f,
                    "the curve has no value at point {} with the parameters that the search has \
                     reached; other values of `start` may help",
                    point + 1
                )
            }
            Self::NotConverged { steps } => write!(
                f,
                "no smallest sum of squares was found in {steps} steps; other values of `start` \
                 may help"
            ),
            Self::Complexity { curve: true } => f.write_str("the curve is complex, but y is real"),
            Self::Complexity { curve: false } => f.write_str("y is complex, but the curve is real"),
            Self::NoScatter => f.write_str(
                "the points lie exactly on the curve, so that their scatter gives no uncertainty; \
                 state the standard uncertainties of y",
            ),
        }
    }
}

impl std::error::Error for RegressionError {}
