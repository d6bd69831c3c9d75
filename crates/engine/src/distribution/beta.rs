//! The beta distribution between two limits: a flexible shape for a bounded quantity such as a
//! fraction. It is not in JCGM 101, Table 1.

use super::gamma;
use super::shape::{Invalid, Shape, finite, limits};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};
use crate::special;

/// A beta distribution by its two shapes, from 0 to 1 or between limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beta {
    alpha: f64,
    beta: f64,
    lower: f64,
    width: f64,
}

impl Beta {
    /// A beta distribution from 0 to 1: its density goes as x^(alpha - 1) (1 - x)^(beta - 1).
    ///
    /// # Errors
    /// Shapes that are not from 0.01 to 1e15.
    pub fn new(alpha: f64, beta: f64) -> Result<Self, Invalid> {
        Self::between(alpha, beta, 0.0, 1.0)
    }

    /// The same between two limits.
    ///
    /// # Errors
    /// Shapes that are not from 0.01 to 1e15, limits that are not finite or not in order.
    pub fn between(alpha: f64, beta: f64, lower: f64, upper: f64) -> Result<Self, Invalid> {
        let alpha = gamma::shape_in_range("alpha", alpha)?;
        let beta = gamma::shape_in_range("beta", beta)?;
        limits(lower, upper)?;
        Ok(Self { alpha, beta, lower, width: finite("upper", upper - lower)? })
    }
}

impl Shape for Beta {
    const NAME: &'static str = "beta";

    fn mean(&self) -> f64 {
        self.lower + self.width * (self.alpha / (self.alpha + self.beta))
    }

    fn standard_uncertainty(&self) -> f64 {
        let Self { alpha, beta, width, .. } = *self;
        let sum = alpha + beta;
        width * ((alpha / sum) * (beta / sum) / (sum + 1.0)).sqrt()
    }

    fn quantile(&self, p: f64) -> f64 {
        self.lower + self.width * special::beta::quantile(p, self.alpha, self.beta)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let from_above = special::beta::quantile(q, self.beta, self.alpha);
        self.lower + self.width * (1.0 - from_above)
    }

    /// The fraction X / (X + Y) of two gamma quantities, as 1 / (1 + e^(ln Y - ln X)): for small
    /// shapes both may be below the smallest number, but their logarithms are not. Above the middle
    /// it is 1 minus the other fraction, which keeps the digits near 1.
    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        let mut other = Column::ZERO;
        gamma::draw_ln(self.alpha, stream, out);
        gamma::draw_ln(self.beta, stream, &mut other);
        for i in 0..COLUMN {
            let odds = elementary::exp(other.0[i] - out.0[i]);
            let below_middle = odds > 1.0;
            let less = if below_middle { 1.0 } else { odds } / (1.0 + odds);
            out.0[i] = self.lower + self.width * if below_middle { less } else { 1.0 - less };
        }
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let lower = self.lower + (finite("estimate", estimate)? - self.mean());
        finite("estimate", lower + self.width)?;
        Ok(Self { lower: finite("estimate", lower)?, ..*self })
    }
}
