//! The curvilinear trapezoid: a rectangular distribution whose limits are themselves known only to
//! within an interval (JCGM 101, 6.4.3).

use super::characteristic::Characteristic;
use super::shape::{Invalid, Shape, finite, limits, positive};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};
use crate::special::ln_1p_minus;
use crate::special::root::{Point, Trend, find};

/// A rectangular distribution with inexact width and a known middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvilinearTrapezoid {
    mean: f64,
    half_width: f64,
    inexactness: f64,
}

impl CurvilinearTrapezoid {
    /// Limits `lower` and `upper`, each known to within +- `inexactness`: above zero and below half
    /// the distance between the limits, so that the limits cannot cross.
    ///
    /// # Errors
    /// Limits that are not finite or not in order, an inexactness out of range.
    pub fn new(lower: f64, upper: f64, inexactness: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = limits(lower, upper)?;
        let inexactness = positive("inexactness", inexactness)?;
        if inexactness < half_width {
            finite("inexactness", half_width + inexactness)?;
            Ok(Self { mean, half_width, inexactness })
        } else {
            Err(Invalid::OutOfRange {
                parameter: "inexactness",
                value: inexactness,
                range: "below half of the distance of the limits",
            })
        }
    }

    /// The same about a middle. The inexactness may equal the half-width.
    pub(super) fn of_width(mean: f64, half_width: f64, inexactness: f64) -> Self {
        Self { mean, half_width, inexactness }
    }

    pub(super) fn characteristic(&self) -> Characteristic {
        let share = self.inexactness / self.half_width;
        Characteristic::Trapezoid { wide: self.half_width, narrow: 0.0, share }
    }

    /// The largest distance of the quantity from the middle.
    fn reach(&self) -> f64 {
        self.half_width + self.inexactness
    }
}

impl Shape for CurvilinearTrapezoid {
    const NAME: &'static str = "curvilinear-trapezoid";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        // (b - a)^2 / 12 + d^2 / 9
        elementary::hypot(self.half_width / 3f64.sqrt(), self.inexactness / 3.0)
    }

    fn divisor(&self) -> Option<f64> {
        Some(self.half_width / self.standard_uncertainty())
    }

    /// With d the inexactness, w the half-width and s the distance from the middle, the density is
    /// ln((w + d) / (w - d)) / 4d up to s = w - d and ln((w + d) / s) / 4d from there to w + d.
    /// Its integral from s = (w + d)(1 - e) to w + d is (w + d) h(e) / 4d with
    /// h(e) = e + (1 - e) ln(1 - e), which is solved for e.
    fn quantile(&self, p: f64) -> f64 {
        let Self { mean, half_width, inexactness } = *self;
        let (reach, flat) = (self.reach(), half_width - inexactness);
        let per_density = 4.0 * inexactness;
        let top = libm::log1p(2.0 * inexactness / flat);
        if flat > 0.0 && (p - 0.5).abs() * per_density <= flat * top {
            return mean + (p - 0.5) * per_density / top;
        }
        let tail = p.min(1.0 - p);
        let target = tail * (per_density / reach);
        let end = 2.0 * inexactness / reach;
        // h(e) >= e^2 / 2
        let start = (2.0 * target).sqrt().min(end);
        let shortfall = find(Trend::Rising, target, start, f64::MIN_POSITIVE, end, |e| {
            let value = e * e + (1.0 - e) * ln_1p_minus(-e);
            Point { value, rate: -e * libm::log1p(-e) }
        });
        let distance = reach * (1.0 - shortfall.min(end));
        mean + if p < 0.5 { -distance } else { distance }
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        let mut width = [0.0; COLUMN];
        stream.uniform(&mut width);
        stream.uniform(&mut out.0);
        for (x, width) in out.0.iter_mut().zip(&width) {
            let half_width = self.half_width + self.inexactness * (1.0 - 2.0 * width);
            *x = self.mean + half_width * (2.0 * *x - 1.0);
        }
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..*self })
    }
}
