//! The log-uniform distribution: rectangular in the logarithm, as for a positive quantity of which
//! only the order of magnitude is known (JCGM 101, 6.4.2, for the logarithm).

use super::shape::{Invalid, Shape, finite, positive};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};

/// A positive quantity whose logarithm is uniformly distributed between the logarithms of two
/// limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogUniform {
    lower: f64,
    upper: f64,
}

impl LogUniform {
    /// All ratios to the limits `lower` < `upper`, both above zero, equally likely.
    ///
    /// # Errors
    /// Limits that are not finite, not above zero or not in order.
    pub fn new(lower: f64, upper: f64) -> Result<Self, Invalid> {
        let (lower, upper) = (positive("lower", lower)?, positive("upper", upper)?);
        if lower < upper {
            Ok(Self { lower, upper })
        } else {
            Err(Invalid::LimitsReversed { lower, upper })
        }
    }

    /// The geometric middle of the limits.
    fn middle(&self) -> f64 {
        self.lower.sqrt() * self.upper.sqrt()
    }

    /// Half of the logarithm of the ratio of the limits.
    fn spread(&self) -> f64 {
        let excess = (self.upper - self.lower) / self.lower;
        if excess < 1.0 {
            0.5 * libm::log1p(excess)
        } else {
            0.5 * (libm::log(self.upper) - libm::log(self.lower))
        }
    }

    /// The value at the position `s`, from -1 to 1 between the limits; rounding cannot move it
    /// beyond them.
    #[inline(always)]
    fn at(&self, middle: f64, spread: f64, s: f64) -> f64 {
        let x = middle * elementary::exp(spread * s);
        let x = if x < self.upper { x } else { self.upper };
        if x > self.lower { x } else { self.lower }
    }
}

impl Shape for LogUniform {
    const NAME: &'static str = "log-uniform";

    /// (b - a) / ln(b / a)
    fn mean(&self) -> f64 {
        (0.5 * self.upper - 0.5 * self.lower) / self.spread()
    }

    /// With m the geometric middle and h half of ln(b / a), the variance is
    /// m^2 (sinh(2h) / 2h - sinh(h)^2 / h^2).
    fn standard_uncertainty(&self) -> f64 {
        let h = self.spread();
        if h < 3.0 {
            // the series of the bracket has positive terms only: (2h)^2k k / ((k + 1) (2k + 1)!)
            let square = 4.0 * h * h;
            let (mut power, mut sum) = (1.0, 0.0);
            for k in 1..=30_u8 {
                let k = f64::from(k);
                power *= square / (2.0 * k * (2.0 * k + 1.0));
                sum += power * k / (k + 1.0);
            }
            return self.middle() * sum.sqrt();
        }
        // relative to the upper limit, so that no square overflows
        let (ratio, upper) = (self.lower / self.upper, self.upper);
        let mean = (1.0 - ratio) / (2.0 * h);
        let square = (1.0 - ratio * ratio) / (4.0 * h);
        upper * (square - mean * mean).sqrt()
    }

    fn quantile(&self, p: f64) -> f64 {
        self.at(self.middle(), self.spread(), 2.0 * p - 1.0)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.at(self.middle(), self.spread(), 1.0 - 2.0 * q)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        stream.uniform(&mut out.0);
        let (middle, spread) = (self.middle(), self.spread());
        for i in 0..COLUMN {
            out.0[i] = self.at(middle, spread, 2.0 * out.0[i] - 1.0);
        }
    }

    /// Both limits are multiplied by the same number, so their ratio is unchanged.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let factor = positive("estimate", estimate)? / self.mean();
        let (lower, upper) = (self.lower * factor, self.upper * factor);
        Self::new(finite("estimate", lower)?, finite("estimate", upper)?)
    }
}
