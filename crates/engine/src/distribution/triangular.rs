//! The triangular distribution (JCGM 101, 6.4.5; JCGM 100, 4.3.9).

use super::Distribution;
use super::characteristic::Characteristic;
use super::inexact_width::InexactWidth;
use super::shape::{Invalid, Shape, finite, limits, positive};
use super::stream::Stream;
use crate::number::{COLUMN, Column};

/// A triangular distribution between two limits with its peak at the mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangular {
    lower: f64,
    /// Distance from the lower limit to the mode.
    rise: f64,
    /// Distance from the mode to the upper limit.
    fall: f64,
    inexact: InexactWidth,
}

impl Triangular {
    /// A symmetric triangle of the given half-width (> 0) about `mean`.
    ///
    /// # Errors
    /// Parameters that are not finite, a half-width that is not above zero.
    pub fn new(mean: f64, half_width: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = (finite("mean", mean)?, positive("half_width", half_width)?);
        Ok(Self {
            lower: mean - half_width,
            rise: half_width,
            fall: half_width,
            inexact: InexactWidth::EXACT,
        })
    }

    /// A triangle between two limits, its peak at `mode` or in the middle.
    ///
    /// # Errors
    /// Limits that are not finite or not in order, a mode outside them.
    pub fn between(lower: f64, upper: f64, mode: Option<f64>) -> Result<Self, Invalid> {
        let (middle, half_width) = limits(lower, upper)?;
        let Some(mode) = mode else {
            return Self::new(middle, half_width);
        };
        if mode >= lower && mode <= upper {
            Ok(Self { lower, rise: mode - lower, fall: upper - mode, inexact: InexactWidth::EXACT })
        } else {
            Err(Invalid::OutOfRange { parameter: "mode", value: mode, range: "between the limits" })
        }
    }

    /// The same with degrees of freedom (at least 0.5), which describe how well its width is known
    /// (JCGM 100, G.4.2). Every trial then has its own limits, whose distances from the mode are
    /// multiplied by a factor between 1 - 1/sqrt(2 dof) and 1 + 1/sqrt(2 dof).
    ///
    /// # Errors
    /// Degrees of freedom below 0.5, with which the width could be negative.
    pub fn with_dof(self, dof: f64) -> Result<Self, Invalid> {
        let inexact = InexactWidth::of_dof(dof)?;
        finite("half_width", self.width() * (1.0 + inexact.share()))?;
        Ok(Self { inexact, ..self })
    }

    fn width(&self) -> f64 {
        self.rise + self.fall
    }

    /// The distance of the value from the mode below (or above) which the probability `tail` lies,
    /// for an inexact width. `near` is the distance of that limit from the mode, `far` that of the
    /// other.
    fn inexact_distance(&self, tail: f64, near: f64, far: f64) -> f64 {
        // the probabilities of the two sides, which do not depend on the width
        let share = near / (near + far);
        if tail < share {
            near * self.inexact.distance(0.0, 0.5 * tail / share)
        } else {
            -far * self.inexact.distance(0.0, (0.5 * (1.0 - tail) / (1.0 - share)).min(0.5))
        }
    }
}

impl Triangular {
    /// `None` for a triangle with an inexact width whose mode is not in the middle.
    pub(super) fn characteristic(&self) -> Option<Characteristic> {
        let Self { rise, fall, inexact, .. } = *self;
        if rise == fall {
            let (wide, narrow) = (0.5 * rise, 0.5 * rise);
            return Some(Characteristic::Trapezoid { wide, narrow, share: inexact.share() });
        }
        inexact.is_exact().then_some(Characteristic::Triangle { rise, fall })
    }

    /// The distances from the mode to the limits, if these are known exactly.
    pub(crate) fn exact_sides(&self) -> Option<[f64; 2]> {
        self.inexact.is_exact().then_some([self.rise, self.fall])
    }

    /// The probability below the mode.
    pub(crate) fn share_below_mode(&self) -> f64 {
        self.rise / self.width()
    }
}

impl Shape for Triangular {
    const NAME: &'static str = "triangular";

    fn mean(&self) -> f64 {
        // the middle of a symmetric triangle to the last bit: 0 and not 1e-17
        if self.rise == self.fall {
            return self.lower + self.rise;
        }
        self.lower + (2.0 * self.rise + self.fall) / 3.0
    }

    fn standard_uncertainty(&self) -> f64 {
        let Self { rise, fall, .. } = *self;
        ((rise * rise + rise * fall + fall * fall) / 18.0).sqrt()
    }

    fn dof(&self) -> f64 {
        self.inexact.dof()
    }

    fn drawn_as(&self) -> Option<&'static str> {
        (!self.inexact.is_exact()).then_some("triangular-inexact-width")
    }

    fn standard_deviation(&self) -> f64 {
        // the mode stays where it is
        let (square, off) = (self.inexact.mean_square(), (self.fall - self.rise) / 3.0);
        (square * self.standard_uncertainty().powi(2) + (square - 1.0) * off * off).sqrt()
    }

    /// The limits of a triangle whose mode is not in the middle are not one width.
    fn divisor(&self) -> Option<f64> {
        let off = (self.rise - self.fall).abs();
        (off <= 1e-9 * self.width()).then(|| 6f64.sqrt())
    }

    fn quantile(&self, p: f64) -> f64 {
        let width = self.width();
        if !self.inexact.is_exact() {
            return self.lower + self.rise - self.inexact_distance(p, self.rise, self.fall);
        }
        if p * width < self.rise {
            self.lower + (p * width * self.rise).sqrt()
        } else {
            self.lower + width - ((1.0 - p) * width * self.fall).sqrt()
        }
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let width = self.width();
        if !self.inexact.is_exact() {
            return self.lower + self.rise + self.inexact_distance(q, self.fall, self.rise);
        }
        if q * width < self.fall {
            self.lower + width - (q * width * self.fall).sqrt()
        } else {
            self.lower + ((1.0 - q) * width * self.rise).sqrt()
        }
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        stream.uniform(&mut out.0);
        let width = self.width();
        let upper = self.lower + width;
        for i in 0..COLUMN {
            let u = out.0[i];
            let low = self.lower + (u * width * self.rise).sqrt();
            let high = upper - ((1.0 - u) * width * self.fall).sqrt();
            out.0[i] = if u * width < self.rise { low } else { high };
        }
        if !self.inexact.is_exact() {
            let mode = self.lower + self.rise;
            let mut factors = [0.0; COLUMN];
            stream.uniform(&mut factors);
            for (x, factor) in out.0.iter_mut().zip(&factors) {
                *x = mode + self.inexact.factor(*factor) * (*x - mode);
            }
        }
    }

    fn times(&self, factor: f64) -> Option<Self> {
        let scaled = [self.lower, self.rise, self.fall].map(|part| part * factor);
        let [lower, rise, fall] = scaled;
        let is_finite = scaled.iter().all(|part| part.is_finite()) && rise + fall > 0.0;
        is_finite.then_some(Self { lower, rise, fall, ..*self })
    }

    fn with_infinite_dof(&self) -> Option<Distribution> {
        (!self.inexact.is_exact()).then(|| Self { inexact: InexactWidth::EXACT, ..*self }.into())
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let shift = finite("estimate", estimate)? - self.mean();
        Ok(Self { lower: finite("estimate", self.lower + shift)?, ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A correction of 0 within symmetric limits has the estimate exactly 0, so no relative width
    /// exists.
    #[test]
    fn means_of_symmetric_triangles_are_exact() {
        for n in 1..1000 {
            let half_width = f64::from(n) * 0.1;
            assert_eq!(Triangular::new(0.0, half_width).unwrap().mean(), 0.0, "{half_width}");
            let between = Triangular::between(-half_width, half_width, None).unwrap();
            assert_eq!(between.mean(), 0.0, "{half_width}");
        }
        assert_eq!(Triangular::between(0.0, 3.0, Some(0.0)).unwrap().mean(), 1.0);
    }
}
