//! The scaled and shifted t distribution (JCGM 101, 6.4.9).

use super::shape::{Invalid, Shape, drawn_degrees_of_freedom, finite, positive};
use super::stream::Stream;
use super::{Distribution, Normal, normal};
use crate::number::{COLUMN, Column, Kernel, elementary};
use crate::special;

/// From here on, any probability of the t distribution differs from the normal one by less than
/// 1e-9, and the generator of t values would lose digits.
const AS_GOOD_AS_NORMAL: f64 = 1e9;

/// A t distribution: expectation `mean`, `scale` and degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudentT {
    mean: f64,
    scale: f64,
    dof: f64,
}

impl StudentT {
    /// A t distribution of the given centre, scale (> 0) and degrees of freedom (at least 0.2, so
    /// that no draw overflows).
    ///
    /// # Errors
    /// Parameters that are not finite or out of their range.
    pub fn new(mean: f64, scale: f64, dof: f64) -> Result<Self, Invalid> {
        let (mean, scale) = (finite("mean", mean)?, positive("scale", scale)?);
        Ok(Self { mean, scale, dof: drawn_degrees_of_freedom(dof)? })
    }
}

impl Shape for StudentT {
    const NAME: &'static str = "t";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.scale
    }

    fn divisor(&self) -> Option<f64> {
        Some(1.0)
    }

    fn dof(&self) -> f64 {
        self.dof
    }

    fn drawn_dof(&self) -> f64 {
        self.dof
    }

    fn standard_deviation(&self) -> f64 {
        standard_deviation(self.scale, self.dof)
    }

    fn quantile(&self, p: f64) -> f64 {
        self.mean + self.scale * standard_quantile(p, self.dof)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.mean - self.scale * standard_quantile(q, self.dof)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        draw(self.mean, self.scale, self.dof, stream, out);
    }

    fn times(&self, factor: f64) -> Option<Self> {
        Self::new(self.mean * factor, self.scale * factor, self.dof).ok()
    }

    fn with_infinite_dof(&self) -> Option<Distribution> {
        Normal::new(self.mean, self.scale).ok().map(Distribution::from)
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..*self })
    }
}

/// Standard deviation of a t distribution; infinite for two degrees of freedom or fewer.
pub(super) fn standard_deviation(scale: f64, dof: f64) -> f64 {
    if dof.is_infinite() {
        scale
    } else if dof > 2.0 {
        scale * (dof / (dof - 2.0)).sqrt()
    } else {
        f64::INFINITY
    }
}

/// Quantile of the standard t distribution.
pub(super) fn standard_quantile(p: f64, dof: f64) -> f64 {
    if dof.is_finite() { special::student::quantile(p, dof) } else { normal::standard_quantile(p) }
}

/// Bailey's polar form (Mathematics of Computation 62, 1994): exact for any degrees of freedom,
/// with one logarithm, one exponential, one root and one cosine per value, and without rejection.
/// Compiled once for each code path, as [`normal::draw`].
pub(super) fn draw(mean: f64, scale: f64, dof: f64, stream: &mut Stream, out: &mut Column) {
    if dof >= AS_GOOD_AS_NORMAL {
        normal::draw(mean, scale, stream, out);
    } else {
        stream.path().run(DrawKernel { mean, scale, dof, stream, out });
    }
}

struct DrawKernel<'a> {
    mean: f64,
    scale: f64,
    dof: f64,
    stream: &'a mut Stream,
    out: &'a mut Column,
}

impl Kernel for DrawKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { mean, scale, dof, stream, out } = self;
        let mut radius = [0.0; COLUMN];
        let mut turn = [0.0; COLUMN];
        stream.uniform(&mut radius);
        stream.uniform(&mut turn);
        // no logarithm is below that of the smallest uniform number
        if LARGEST_LOGARITHM * 2.0 / dof <= elementary::EXP_LIMIT {
            let grown = elementary::exp_minus_one_positive;
            fill((mean, scale, dof), (&radius, &turn), grown, out);
        } else {
            // with less than an eighth of a degree of freedom hardly any draw is near the middle
            let grown =
                |x: f64| if x < 1e-3 { x * (1.0 + 0.5 * x) } else { elementary::exp(x) - 1.0 };
            fill((mean, scale, dof), (&radius, &turn), grown, out);
        }
    }
}

/// Minus the logarithm of the smallest uniform number, 2^-53.
const LARGEST_LOGARITHM: f64 = 36.8;

/// `grown` is exp(x) - 1.
#[inline(always)]
fn fill(
    (mean, scale, dof): (f64, f64, f64),
    (radius, turn): (&[f64; COLUMN], &[f64; COLUMN]),
    grown: impl Fn(f64) -> f64,
    out: &mut Column,
) {
    let exponent = -2.0 / dof;
    for i in 0..COLUMN {
        let x = exponent * elementary::ln_uniform(radius[i]);
        // a cosine over a whole turn is a sine over half a turn, forth and back
        let cos = elementary::sin_quarters(4.0 * (turn[i] - 0.5).abs() - 1.0);
        out.0[i] = mean + scale * ((dof * grown(x)).sqrt() * cos);
    }
}
