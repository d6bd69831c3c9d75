//! The state of knowledge about quantities: probability distributions, one file each, and the joint
//! draw of many quantities.
//!
//! A new shape is one file that implements `shape::Shape`, and one line in the list of
//! `Distribution`.

mod arcsine;
mod beta;
pub(crate) mod characteristic;
mod constant;
mod curvilinear_trapezoid;
mod exponential;
mod external;
mod fitted;
mod gamma;
mod inexact_width;
mod input;
mod joint;
mod laws;
mod log_uniform;
mod lognormal;
mod normal;
mod poisson_count;
mod quantiles;
mod readings;
mod rectangular;
mod result;
mod samples;
mod score;
mod shape;
mod split_normal;
pub(crate) mod stream;
mod student;
mod trapezoidal;
mod triangular;
mod truncated;

pub use arcsine::Arcsine;
pub use beta::Beta;
pub use constant::Constant;
pub use curvilinear_trapezoid::CurvilinearTrapezoid;
pub use exponential::Exponential;
pub use external::External;
pub use fitted::Fitted;
pub use gamma::Gamma;
pub use input::{EvaluationType, Input, InputError};
pub use joint::Draws;
pub use joint::Fits;
pub use joint::FromScore;
pub use joint::Joint;
pub use joint::Varying;
pub use joint::paired;
pub use joint::{Correlation, CorrelationError};
pub(crate) use joint::{Dependence, Linked, connected};
pub use log_uniform::LogUniform;
pub use lognormal::Lognormal;
pub use normal::Normal;
pub use poisson_count::PoissonCount;
pub use quantiles::Quantiles;
pub use readings::Readings;
pub use rectangular::Rectangular;
pub use result::{
    Occasion, Origin, Root, RootCorrelation, RootFigures, RootName, Saved, SavedResult, Scores,
};
pub use samples::Samples;
pub use shape::Invalid;
use shape::Shape;
pub use split_normal::SplitNormal;
pub use stream::BLOCK;
pub use stream::Stream;
pub use stream::StreamKey;
pub use stream::StreamRng;
pub use student::StudentT;
pub use trapezoidal::Trapezoidal;
pub use triangular::Triangular;
pub use truncated::Truncated;

use crate::number::Column;

macro_rules! distributions {
    ($($(#[$about:meta])* $shape:ident,)*) => {
        /// A probability distribution (JCGM 101, Table 1).
        #[derive(Clone, Debug, PartialEq)]
        pub enum Distribution {
            $($(#[$about])* $shape($shape),)*
        }

        $(
            impl From<$shape> for Distribution {
                fn from(shape: $shape) -> Self {
                    Self::$shape(shape)
                }
            }
        )*

        impl Distribution {
            /// The canonical name, as in files and budgets.
            pub fn name(&self) -> &'static str {
                match self { $(Self::$shape(shape) => shape.name(),)* }
            }

            /// The estimate: the expectation of the distribution.
            pub fn mean(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.mean(),)* }
            }

            /// The standard uncertainty for the law of propagation: the standard deviation, but the
            /// scale of a t distribution, and s/sqrt(n) for readings.
            pub fn standard_uncertainty(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.standard_uncertainty(),)* }
            }

            /// Degrees of freedom of the standard uncertainty; infinite unless it was estimated.
            pub fn dof(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.dof(),)* }
            }

            /// The divisor of the stated width (the half-width of the limits, an expanded
            /// uncertainty, the standard uncertainty itself) that gives the standard uncertainty;
            /// `None` for a shape that is not stated by one width.
            pub fn divisor(&self) -> Option<f64> {
                match self { $(Self::$shape(shape) => shape.divisor(),)* }
            }

            /// Degrees of freedom of the t distribution from which trials are drawn; infinite for
            /// all other shapes. Moments of that order and above do not exist.
            pub fn drawn_dof(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.drawn_dof(),)* }
            }

            /// The name of the distribution from which trials are drawn, if it is not the stated
            /// one: a t distribution for a normal distribution, a curvilinear trapezoid for a
            /// rectangular one, and one with inexact width for a triangular or trapezoidal one
            /// whose standard uncertainty has finite degrees of freedom.
            pub fn drawn_as(&self) -> Option<&'static str> {
                match self { $(Self::$shape(shape) => shape.drawn_as(),)* }
            }

            /// Standard deviation of the drawn values; infinite if it does not exist.
            pub fn standard_deviation(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.standard_deviation(),)* }
            }

            /// The value below which a drawn value lies with probability `p`, 0 < p < 1.
            pub fn quantile(&self, p: f64) -> f64 {
                match self { $(Self::$shape(shape) => shape.quantile(p),)* }
            }

            /// The value above which a drawn value lies with probability `q`, 0 < q < 1: the
            /// quantile of 1 - q, even if that rounds to 1.
            pub fn quantile_upper(&self, q: f64) -> f64 {
                match self { $(Self::$shape(shape) => shape.quantile_upper(q),)* }
            }

            /// The same distribution with its estimate moved: limits move along. Distributions of
            /// positive quantities keep the shape (gamma, exponential, log-uniform) or the standard
            /// deviation (lognormal); a count becomes the one with that estimate.
            ///
            /// # Errors
            /// The estimate is not finite, or impossible for the shape.
            pub fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
                match self {
                    $(Self::$shape(shape) => Ok(Self::$shape(shape.moved_to(estimate)?)),)*
                }
            }

            /// The distribution if its standard uncertainty were known exactly, with infinite degrees
            /// of freedom: normal for a t distribution and for readings, without an inexact width for
            /// a rectangular one. `None` if it is known exactly, and for shapes without such a
            /// counterpart: results, cut-off and empirical distributions, and fits, whose parameters
            /// are drawn together.
            pub(crate) fn with_infinite_dof(&self) -> Option<Self> {
                match self { $(Self::$shape(shape) => Shape::with_infinite_dof(shape),)* }
            }

            /// The distribution of the value times a factor above 0, as in another unit. `None` for
            /// shapes other than constants, normal, rectangular, triangular, t and arcsine
            /// distributions, and if the result is not finite.
            pub(crate) fn times(&self, factor: f64) -> Option<Self> {
                match self {
                    $(Self::$shape(shape) => Shape::times(shape, factor).map(Self::$shape),)*
                }
            }

            #[inline(always)]
            pub(crate) fn draw(&self, stream: &mut Stream, out: &mut Column) {
                match self { $(Self::$shape(shape) => shape.draw(stream, out),)* }
            }
        }
    };
}

distributions! {
    /// Known exactly.
    Constant,
    /// Normal, or the t distribution that replaces it for few degrees of freedom.
    Normal,
    /// Rectangular (uniform).
    Rectangular,
    /// Triangular.
    Triangular,
    /// Scaled and shifted t.
    StudentT,
    /// Trapezoidal, symmetric.
    Trapezoidal,
    /// Rectangular with inexactly known limits.
    CurvilinearTrapezoid,
    /// Arc sine (U-shaped).
    Arcsine,
    /// Repeated readings (Type A).
    Readings,
    /// Exponential.
    Exponential,
    /// Gamma.
    Gamma,
    /// Lognormal.
    Lognormal,
    /// Beta between two limits.
    Beta,
    /// Rectangular in the logarithm.
    LogUniform,
    /// Expectation of a Poisson process, given a number of counted events.
    PoissonCount,
    /// Empirical: samples drawn with replacement.
    Samples,
    /// Two halves of normal distributions.
    SplitNormal,
    /// Stated by quantiles.
    Quantiles,
    /// Any other, cut off at limits.
    Truncated,
    /// One output of a saved result.
    SavedResult,
    /// Drawn by another crate.
    External,
    /// A parameter of a fitted calibration function.
    Fitted,
}

impl Distribution {
    /// The value of an exactly known quantity.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(constant) => Some(constant.mean()),
            _ => None,
        }
    }

    /// The quantiles for probabilities below one half, in order, the median, and the quantiles for
    /// the complementary probabilities; each once.
    pub(crate) fn quantiles_about_median(&self, below: &[f64]) -> Vec<f64> {
        let lower = below.iter().map(|&p| self.quantile(p));
        let upper = below.iter().rev().map(|&q| self.quantile_upper(q));
        let mut all: Vec<f64> = lower.chain([self.quantile(0.5)]).chain(upper).collect();
        all.dedup();
        all
    }

    /// The saved result; `None` for other distributions.
    pub fn saved(&self) -> Option<&SavedResult> {
        match self {
            Self::SavedResult(saved) => Some(saved),
            _ => None,
        }
    }

    /// Whether [`Distribution::quantile`] is known; all but some [`External`] ones have it.
    pub fn has_quantiles(&self) -> bool {
        !matches!(self, Self::External(external) if !external.has_quantiles())
    }

    /// Whether trials are drawn from a normal distribution, so that a joint normal distribution is
    /// exact.
    pub fn is_drawn_normal(&self) -> bool {
        matches!(self, Self::Normal(normal) if normal.drawn_dof().is_infinite())
    }
}

#[cfg(test)]
mod tests;
