//! The lognormal distribution for a positive quantity whose logarithm is normal (JCGM 101, 6.4.7,
//! for the logarithm).

use super::normal;
use super::shape::{Invalid, Shape, positive, within};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};
use crate::special;

/// Larger ratios of standard deviation and expectation do not occur in measurements.
const MOST_RELATIVE: f64 = 1e6;

/// A lognormal distribution by the expectation and standard deviation of the quantity itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lognormal {
    mean: f64,
    std: f64,
    /// Standard deviation of the logarithm.
    sigma: f64,
}

impl Lognormal {
    /// A lognormal distribution of the given expectation (> 0) and standard deviation (> 0, at most
    /// a million times the expectation) of the quantity itself, not of its logarithm.
    ///
    /// # Errors
    /// Parameters that are not finite or out of their range.
    pub fn new(mean: f64, std: f64) -> Result<Self, Invalid> {
        let (mean, std) = (positive("mean", mean)?, positive("std", std)?);
        // so that no draw, e^-60 to e^32 times the mean, leaves the range of double precision
        within("mean", mean, 1e-280, 1e290, "from 1e-280 to 1e290")?;
        let relative = std / mean;
        let sigma = libm::log1p(relative * relative).sqrt();
        if relative > MOST_RELATIVE {
            let range = "at most a million times the mean";
            return Err(Invalid::OutOfRange { parameter: "std", value: std, range });
        }
        if sigma > 0.0 {
            Ok(Self { mean, std, sigma })
        } else {
            Err(Invalid::WidthLost { parameter: "std", value: std, estimate: mean })
        }
    }

    /// Expectation and standard deviation of the logarithm.
    pub(crate) fn of_logarithm(&self) -> [f64; 2] {
        [elementary::ln(self.mean) - 0.5 * self.sigma * self.sigma, self.sigma]
    }

    /// The value at a standard normal value of the logarithm.
    #[inline(always)]
    fn at(&self, z: f64) -> f64 {
        self.mean * elementary::exp(self.sigma * (z - 0.5 * self.sigma))
    }
}

impl Shape for Lognormal {
    const NAME: &'static str = "lognormal";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.std
    }

    fn divisor(&self) -> Option<f64> {
        Some(1.0)
    }

    fn quantile(&self, p: f64) -> f64 {
        self.at(special::normal::quantile(p))
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.at(special::normal::quantile_upper(q))
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        normal::draw(0.0, 1.0, stream, out);
        for i in 0..COLUMN {
            out.0[i] = self.at(out.0[i]);
        }
    }

    /// The lognormal distribution with that expectation and the same standard deviation.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Self::new(positive("estimate", estimate)?, self.std)
    }
}
