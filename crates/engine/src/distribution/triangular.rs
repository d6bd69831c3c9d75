//! The triangular distribution (JCGM 101, 6.4.5; JCGM 100, 4.3.9).

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
}

impl Triangular {
    /// A symmetric triangle of the given half-width (> 0) about `mean`.
    ///
    /// # Errors
    /// Parameters that are not finite, a half-width that is not above zero.
    pub fn new(mean: f64, half_width: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = (finite("mean", mean)?, positive("half_width", half_width)?);
        Ok(Self { lower: mean - half_width, rise: half_width, fall: half_width })
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
            Ok(Self { lower, rise: mode - lower, fall: upper - mode })
        } else {
            Err(Invalid::OutOfRange { parameter: "mode", value: mode, range: "between the limits" })
        }
    }

    fn width(&self) -> f64 {
        self.rise + self.fall
    }
}

impl Shape for Triangular {
    const NAME: &'static str = "triangular";

    fn mean(&self) -> f64 {
        self.lower + (2.0 * self.rise + self.fall) / 3.0
    }

    fn standard_uncertainty(&self) -> f64 {
        let Self { rise, fall, .. } = *self;
        ((rise * rise + rise * fall + fall * fall) / 18.0).sqrt()
    }

    /// The limits of a triangle with its mode off the middle are not one width.
    fn divisor(&self) -> Option<f64> {
        let off = (self.rise - self.fall).abs();
        (off <= 1e-9 * self.width()).then(|| 6f64.sqrt())
    }

    fn quantile(&self, p: f64) -> f64 {
        let width = self.width();
        if p * width < self.rise {
            self.lower + (p * width * self.rise).sqrt()
        } else {
            self.lower + width - ((1.0 - p) * width * self.fall).sqrt()
        }
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let width = self.width();
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
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let shift = finite("estimate", estimate)? - self.mean();
        Ok(Self { lower: finite("estimate", self.lower + shift)?, ..*self })
    }
}
