//! The split normal distribution: two halves of normal distributions of different width, joined at
//! the mode, for stated asymmetric uncertainties (5 +0.2 -0.1).

use super::shape::{Invalid, Shape, finite, positive};
use super::stream::Stream;
use crate::number::{COLUMN, Column};
use crate::special::normal;

/// A quantity whose density decreases like a normal one on either side of its mode, with a
/// different standard deviation on each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitNormal {
    mode: f64,
    low: f64,
    high: f64,
}

impl SplitNormal {
    /// Mode, and the standard deviations below and above it.
    ///
    /// # Errors
    /// A mode that is not finite, standard deviations that are not finite and above zero.
    pub fn new(mode: f64, std_low: f64, std_high: f64) -> Result<Self, Invalid> {
        let (low, high) = (positive("std_low", std_low)?, positive("std_high", std_high)?);
        Ok(Self { mode: finite("mode", mode)?, low, high })
    }
}

impl Shape for SplitNormal {
    const NAME: &'static str = "split-normal";

    /// mode + sqrt(2/pi) (high - low)
    fn mean(&self) -> f64 {
        self.mode + (2.0 / std::f64::consts::PI).sqrt() * (self.high - self.low)
    }

    /// sqrt((1 - 2/pi) (high - low)^2 + high low)
    fn standard_uncertainty(&self) -> f64 {
        let difference = self.high - self.low;
        let share = 1.0 - 2.0 / std::f64::consts::PI;
        (share * difference * difference + self.high * self.low).sqrt()
    }

    fn quantile(&self, p: f64) -> f64 {
        let both = self.low + self.high;
        if p * both < self.low {
            self.mode + self.low * normal::quantile(p * both / (2.0 * self.low))
        } else {
            self.quantile_upper(1.0 - p)
        }
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let both = self.low + self.high;
        if q * both <= self.high {
            self.mode + self.high * normal::quantile_upper(q * both / (2.0 * self.high))
        } else {
            self.mode + self.low * normal::quantile((1.0 - q) * both / (2.0 * self.low))
        }
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        let mut side = [0.0; COLUMN];
        super::normal::draw(0.0, 1.0, stream, out);
        stream.uniform(&mut side);
        let share = self.low / (self.low + self.high);
        for (x, side) in out.0.iter_mut().zip(&side) {
            let (width, sign) = if *side < share { (self.low, -1.0) } else { (self.high, 1.0) };
            *x = self.mode + sign * width * x.abs();
        }
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let mode = self.mode + (finite("estimate", estimate)? - self.mean());
        Ok(Self { mode: finite("estimate", mode)?, ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 5 +0.2 -0.1: expectation 5 + 0.1 sqrt(2/pi), variance 0.01 (1 - 2/pi) + 0.02; the
    /// probability below the mode is 1/3.
    #[test]
    fn moments_and_quantiles() {
        let split = SplitNormal::new(5.0, 0.1, 0.2).unwrap();
        assert!((split.mean() - 5.079_788_456_080_286_5).abs() < 1e-14);
        let variance = split.standard_uncertainty() * split.standard_uncertainty();
        assert!((variance - 0.023_633_802_276_324_19).abs() < 1e-16);
        assert!((split.quantile(1.0 / 3.0) - 5.0).abs() < 1e-15);
        for p in [1e-9, 0.1, 0.3, 0.4, 0.9] {
            assert!((split.quantile(p) - split.quantile_upper(1.0 - p)).abs() < 1e-8, "{p}");
        }
        let same = SplitNormal::new(5.0, 0.1, 0.1).unwrap();
        assert!((same.quantile(0.975) - 5.195_996_398_454_005).abs() < 1e-14);
    }
}
