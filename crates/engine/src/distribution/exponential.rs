//! The exponential distribution (JCGM 101, 6.4.10).

use super::shape::{Invalid, Shape, positive, within};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};

/// A positive quantity of which only the best estimate is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    mean: f64,
}

impl Exponential {
    /// An exponential distribution of the given expectation (> 0).
    ///
    /// # Errors
    /// An expectation that is not finite or not above zero.
    pub fn new(mean: f64) -> Result<Self, Invalid> {
        let mean = positive("mean", mean)?;
        // so that no draw, at most 54 ln 2 times the mean, overflows
        Ok(Self { mean: within("mean", mean, 0.0, 1e306, "at most 1e306")? })
    }
}

impl Shape for Exponential {
    const NAME: &'static str = "exponential";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.mean
    }

    fn quantile(&self, p: f64) -> f64 {
        -self.mean * libm::log1p(-p)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        -self.mean * libm::log(q)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        stream.uniform(&mut out.0);
        for i in 0..COLUMN {
            out.0[i] = -self.mean * elementary::ln_uniform(out.0[i]);
        }
    }

    /// The exponential distribution with that expectation.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Self::new(positive("estimate", estimate)?)
    }
}
