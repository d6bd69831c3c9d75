//! The normal distribution (JCGM 101, 6.4.7), and the t distribution that replaces it if the
//! standard uncertainty itself has few degrees of freedom (JCGM 101, 6.4.9.7).

use super::Distribution;
use super::shape::{Invalid, Shape, drawn_degrees_of_freedom, finite, positive};
use super::stream::Stream;
use super::student;
use crate::number::{COLUMN, Column, Kernel, elementary};
use crate::special;

/// A normal distribution, or a scaled and shifted t if it has finite degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    mean: f64,
    std: f64,
    dof: f64,
    /// The divisor of the stated uncertainty that gave `std`.
    divisor: f64,
}

impl Normal {
    /// A normal distribution of the given expectation and standard deviation (> 0).
    ///
    /// # Errors
    /// Parameters that are not finite, a standard deviation that is not above zero.
    pub fn new(mean: f64, std: f64) -> Result<Self, Invalid> {
        Self::with_dof(mean, std, f64::INFINITY)
    }

    /// The same with degrees of freedom (at least 0.2) of the standard uncertainty, as on a
    /// certificate. Trials are then drawn from the t distribution of JCGM 101, 6.4.9.7.
    ///
    /// # Errors
    /// Parameters that are not finite, a standard deviation or degrees of freedom not above zero.
    pub fn with_dof(mean: f64, std: f64, dof: f64) -> Result<Self, Invalid> {
        let (mean, std) = (finite("mean", mean)?, positive("std", std)?);
        Ok(Self { mean, std, dof: drawn_degrees_of_freedom(dof)?, divisor: 1.0 })
    }

    /// The same, derived from an expanded uncertainty with coverage factor `factor` (> 0). The
    /// distribution is unchanged; a budget may show the factor as the divisor.
    ///
    /// # Errors
    /// A factor that is not finite or not above zero.
    pub fn stated_with(self, factor: f64) -> Result<Self, Invalid> {
        Ok(Self { divisor: positive("k", factor)?, ..self })
    }
}

impl Shape for Normal {
    const NAME: &'static str = "normal";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.std
    }

    fn divisor(&self) -> Option<f64> {
        Some(self.divisor)
    }

    fn dof(&self) -> f64 {
        self.dof
    }

    fn drawn_dof(&self) -> f64 {
        self.dof
    }

    fn drawn_as(&self) -> Option<&'static str> {
        self.dof.is_finite().then_some(student::StudentT::NAME)
    }

    fn standard_deviation(&self) -> f64 {
        student::standard_deviation(self.std, self.dof)
    }

    fn quantile(&self, p: f64) -> f64 {
        self.mean + self.std * student::standard_quantile(p, self.dof)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.mean - self.std * student::standard_quantile(q, self.dof)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        if self.dof.is_finite() {
            student::draw(self.mean, self.std, self.dof, stream, out);
        } else {
            draw(self.mean, self.std, stream, out);
        }
    }

    fn times(&self, factor: f64) -> Option<Self> {
        let made = Self::with_dof(self.mean * factor, self.std * factor, self.dof).ok()?;
        Some(Self { divisor: self.divisor, ..made })
    }

    fn with_infinite_dof(&self) -> Option<Distribution> {
        self.dof.is_finite().then(|| Self { dof: f64::INFINITY, ..*self }.into())
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..*self })
    }
}

impl Normal {
    /// Fills a column with draws of the standard normal distribution.
    pub fn standard_draw(stream: &mut Stream, out: &mut Column) {
        draw(0.0, 1.0, stream, out);
    }
}

/// Box-Muller: a pair of uniform numbers gives two independent normal ones (JCGM 101, C.4). The
/// cosines fill the first half of the column, the sines the second. Compiled once for each code
/// path and called by every distribution that begins with it, because a call costs nothing compared
/// with a column.
pub(super) fn draw(mean: f64, std: f64, stream: &mut Stream, out: &mut Column) {
    stream.path().run(DrawKernel { mean, std, stream, out });
}

struct DrawKernel<'a> {
    mean: f64,
    std: f64,
    stream: &'a mut Stream,
    out: &'a mut Column,
}

impl Kernel for DrawKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        const HALF: usize = COLUMN / 2;
        let Self { mean, std, stream, out } = self;
        let mut uniforms = [0.0; COLUMN];
        stream.uniform(&mut uniforms);
        let (radius, turn) = uniforms.split_at(HALF);
        let (first, second) = out.0.split_at_mut(HALF);
        for i in 0..HALF {
            let r = (-2.0 * elementary::ln_uniform(radius[i])).sqrt();
            let (sin, cos) = elementary::sin_cos_turn(turn[i]);
            first[i] = mean + std * (r * cos);
            second[i] = mean + std * (r * sin);
        }
    }
}

/// Quantile of the standard normal distribution.
pub(super) fn standard_quantile(p: f64) -> f64 {
    special::normal::quantile(p)
}
