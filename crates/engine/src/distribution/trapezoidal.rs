//! The symmetric trapezoidal distribution (JCGM 101, 6.4.4; JCGM 100, 4.3.9).

use super::Distribution;
use super::characteristic::Characteristic;
use super::inexact_width::InexactWidth;
use super::shape::{Invalid, Shape, finite, limits, positive, within};
use super::stream::Stream;
use crate::number::{COLUMN, Column};

/// A symmetric trapezoid: the sum of two independent rectangular quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trapezoidal {
    mean: f64,
    half_width: f64,
    beta: f64,
    inexact: InexactWidth,
}

impl Trapezoidal {
    /// A trapezoid with the given half-width (> 0) of its base about `mean`; `beta` is the width of
    /// its top divided by that of its base, from 0 (a triangle) to 1 (a rectangle).
    ///
    /// # Errors
    /// Parameters that are not finite, a half-width that is not above zero, a ratio out of range.
    pub fn new(mean: f64, half_width: f64, beta: f64) -> Result<Self, Invalid> {
        Ok(Self {
            mean: finite("mean", mean)?,
            half_width: positive("half_width", half_width)?,
            beta: within("beta", beta, 0.0, 1.0, "from 0 to 1")?,
            inexact: InexactWidth::EXACT,
        })
    }

    /// The same between two limits.
    ///
    /// # Errors
    /// Limits that are not finite or not in order, a ratio out of range.
    pub fn between(lower: f64, upper: f64, beta: f64) -> Result<Self, Invalid> {
        let (mean, half_width) = limits(lower, upper)?;
        Self::new(mean, half_width, beta)
    }

    /// The same with degrees of freedom (at least 0.5), which describe how well its width is known
    /// (JCGM 100, G.4.2). Every trial then has its own limits, whose distance from the middle is
    /// multiplied by a factor between 1 - 1/sqrt(2 dof) and 1 + 1/sqrt(2 dof).
    ///
    /// # Errors
    /// Degrees of freedom below 0.5, with which the width could be negative.
    pub fn with_dof(self, dof: f64) -> Result<Self, Invalid> {
        let inexact = InexactWidth::of_dof(dof)?;
        finite("half_width", self.half_width * (1.0 + inexact.share()))?;
        Ok(Self { inexact, ..self })
    }
}

impl Trapezoidal {
    pub(super) fn characteristic(&self) -> Characteristic {
        let half = 0.5 * self.half_width;
        let (wide, narrow) = (half * (1.0 + self.beta), half * (1.0 - self.beta));
        Characteristic::Trapezoid { wide, narrow, share: self.inexact.share() }
    }

    /// The probability of each flank.
    pub(crate) fn share_of_flank(&self) -> f64 {
        0.5 * (1.0 - self.beta) / (1.0 + self.beta)
    }
}

impl Shape for Trapezoidal {
    const NAME: &'static str = "trapezoidal";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.half_width * ((1.0 + self.beta * self.beta) / 6.0).sqrt()
    }

    fn divisor(&self) -> Option<f64> {
        Some((6.0 / (1.0 + self.beta * self.beta)).sqrt())
    }

    fn dof(&self) -> f64 {
        self.inexact.dof()
    }

    fn drawn_as(&self) -> Option<&'static str> {
        (!self.inexact.is_exact()).then_some("trapezoidal-inexact-width")
    }

    fn standard_deviation(&self) -> f64 {
        self.standard_uncertainty() * self.inexact.mean_square().sqrt()
    }

    fn quantile(&self, p: f64) -> f64 {
        let Self { mean, half_width, beta, inexact } = *self;
        let tail = p.min(1.0 - p);
        if !inexact.is_exact() {
            let distance = half_width * inexact.distance(beta, tail);
            return mean + if p < 0.5 { -distance } else { distance };
        }
        // the flanks have the probability (1 - beta) / (1 + beta), half of it each
        if 2.0 * tail * (1.0 + beta) < 1.0 - beta {
            let inwards = (2.0 * tail * (1.0 - beta) * (1.0 + beta)).sqrt();
            mean + half_width * if p < 0.5 { inwards - 1.0 } else { 1.0 - inwards }
        } else {
            mean + half_width * ((p - 0.5) * (1.0 + beta))
        }
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        let mut second = [0.0; COLUMN];
        stream.uniform(&mut out.0);
        stream.uniform(&mut second);
        let (wide, narrow) = (1.0 + self.beta, 1.0 - self.beta);
        for (x, second) in out.0.iter_mut().zip(&second) {
            let sum = wide * *x + narrow * second;
            *x = self.mean + self.half_width * (sum - 1.0);
        }
        if !self.inexact.is_exact() {
            stream.uniform(&mut second);
            for (x, factor) in out.0.iter_mut().zip(&second) {
                *x = self.mean + self.inexact.factor(*factor) * (*x - self.mean);
            }
        }
    }

    fn with_infinite_dof(&self) -> Option<Distribution> {
        (!self.inexact.is_exact()).then(|| Self { inexact: InexactWidth::EXACT, ..*self }.into())
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..*self })
    }
}
