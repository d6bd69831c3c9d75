//! The arc sine or U-shaped distribution (JCGM 101, 6.4.6).

use super::shape::{Invalid, Shape, finite, limits, positive};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};

/// A quantity that cycles sinusoidally between two limits, observed at an unknown phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arcsine {
    mean: f64,
    half_width: f64,
}

impl Arcsine {
    /// The amplitude `half_width` (> 0) about `mean`.
    ///
    /// # Errors
    /// Parameters that are not finite, a half-width that is not above zero.
    pub fn new(mean: f64, half_width: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = (finite("mean", mean)?, positive("half_width", half_width)?);
        Ok(Self { mean, half_width })
    }

    /// The same between two limits.
    ///
    /// # Errors
    /// Limits that are not finite or not in order.
    pub fn between(lower: f64, upper: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = limits(lower, upper)?;
        Self::new(mean, half_width)
    }

    /// The value at a probability: sin(pi (p - 1/2)) = -cos(pi p) times the amplitude.
    #[inline(always)]
    fn at(&self, p: f64) -> f64 {
        // rounding must not bring a value beyond the limits
        let cos = elementary::sin_quarters(1.0 - 2.0 * p);
        let cos = if cos > 1.0 { 1.0 } else { cos };
        let cos = if cos < -1.0 { -1.0 } else { cos };
        self.mean - self.half_width * cos
    }
}

impl Shape for Arcsine {
    const NAME: &'static str = "arcsine";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.half_width / 2f64.sqrt()
    }

    fn divisor(&self) -> Option<f64> {
        Some(2f64.sqrt())
    }

    fn quantile(&self, p: f64) -> f64 {
        self.at(p)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let (_, cos) = elementary::sin_cos_turn(0.5 * q);
        self.mean + self.half_width * cos
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        stream.uniform(&mut out.0);
        for i in 0..COLUMN {
            out.0[i] = self.at(out.0[i]);
        }
    }

    fn times(&self, factor: f64) -> Option<Self> {
        Self::new(self.mean * factor, self.half_width * factor).ok()
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..*self })
    }
}
