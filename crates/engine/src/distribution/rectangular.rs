//! The rectangular distribution (JCGM 101, 6.4.2; JCGM 100, 4.3.7).

use super::Distribution;
use super::characteristic::Characteristic;
use super::curvilinear_trapezoid::CurvilinearTrapezoid;
use super::inexact_width::InexactWidth;
use super::shape::{Invalid, Shape, finite, limits, positive};
use super::stream::Stream;
use crate::number::{COLUMN, Column};

/// A rectangular (uniform) distribution about its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangular {
    mean: f64,
    half_width: f64,
    width: InexactWidth,
}

impl Rectangular {
    /// All values within `half_width` (> 0) of `mean` equally likely.
    ///
    /// # Errors
    /// Parameters that are not finite, a half-width that is not above zero.
    pub fn new(mean: f64, half_width: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = (finite("mean", mean)?, positive("half_width", half_width)?);
        Ok(Self { mean, half_width, width: InexactWidth::EXACT })
    }

    /// All values between two limits equally likely.
    ///
    /// # Errors
    /// Limits that are not finite or not in order.
    pub fn between(lower: f64, upper: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = limits(lower, upper)?;
        Self::new(mean, half_width)
    }

    /// Half the distance between the limits.
    pub(super) fn half_width(&self) -> f64 {
        self.half_width
    }

    /// The same with degrees of freedom (at least 0.5), which describe how well the half-width is
    /// known (JCGM 100, G.4.2). Trials are then drawn from the curvilinear trapezoid (JCGM 101,
    /// 6.4.3) whose inexactness is the half-width divided by sqrt(2 dof).
    ///
    /// # Errors
    /// Degrees of freedom below 0.5, with which the limits could cross.
    pub fn with_dof(self, dof: f64) -> Result<Self, Invalid> {
        let width = InexactWidth::of_dof(dof)?;
        finite("half_width", self.half_width * (1.0 + width.share()))?;
        Ok(Self { width, ..self })
    }

    /// The distribution that is drawn instead of a rectangle with inexact width.
    pub(super) fn inexact(&self) -> Option<CurvilinearTrapezoid> {
        (!self.width.is_exact()).then(|| {
            let inexactness = self.half_width * self.width.share();
            CurvilinearTrapezoid::of_width(self.mean, self.half_width, inexactness)
        })
    }
}

impl Rectangular {
    /// Whether the limits are known exactly.
    pub(crate) fn dof_is_infinite(&self) -> bool {
        self.width.is_exact()
    }

    pub(super) fn characteristic(&self) -> Characteristic {
        let share = self.width.share();
        Characteristic::Trapezoid { wide: self.half_width, narrow: 0.0, share }
    }
}

impl Shape for Rectangular {
    const NAME: &'static str = "rectangular";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.half_width / 3f64.sqrt()
    }

    fn divisor(&self) -> Option<f64> {
        Some(3f64.sqrt())
    }

    fn dof(&self) -> f64 {
        self.width.dof()
    }

    fn drawn_as(&self) -> Option<&'static str> {
        self.inexact().map(|_| CurvilinearTrapezoid::NAME)
    }

    fn standard_deviation(&self) -> f64 {
        self.inexact()
            .map_or_else(|| self.standard_uncertainty(), |drawn| drawn.standard_deviation())
    }

    fn quantile(&self, p: f64) -> f64 {
        if let Some(drawn) = self.inexact() {
            return drawn.quantile(p);
        }
        self.mean + self.half_width * (2.0 * p - 1.0)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        if let Some(drawn) = self.inexact() {
            return drawn.quantile_upper(q);
        }
        self.mean + self.half_width * (1.0 - 2.0 * q)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        if let Some(drawn) = self.inexact() {
            return drawn.draw(stream, out);
        }
        stream.uniform(&mut out.0);
        for i in 0..COLUMN {
            out.0[i] = self.mean + self.half_width * (2.0 * out.0[i] - 1.0);
        }
    }

    fn times(&self, factor: f64) -> Option<Self> {
        let made = Self::new(self.mean * factor, self.half_width * factor).ok()?;
        Some(Self { width: self.width, ..made })
    }

    fn with_infinite_dof(&self) -> Option<Distribution> {
        (!self.width.is_exact()).then(|| Self { width: InexactWidth::EXACT, ..*self }.into())
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..*self })
    }
}
