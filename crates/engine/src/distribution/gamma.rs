//! The gamma distribution (JCGM 101, 6.4.11).

use super::characteristic::Characteristic;
use super::shape::{Invalid, Shape, positive, within};
use super::stream::Stream;
use crate::number::{COLUMN, Column, Kernel, elementary};
use crate::special;

/// The smallest shape: one draw in a thousand is then below the smallest normal number, which
/// replaces it.
pub(super) const LEAST_SHAPE: f64 = 0.01;

/// The largest shape: above it, the distribution is so narrow that rounding distorts it.
pub(super) const MOST_SHAPE: f64 = 1e15;

/// A gamma distribution by shape and rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gamma {
    shape: f64,
    rate: f64,
}

impl Gamma {
    /// A gamma distribution with the given shape (0.01 to 1e15) and rate (> 0): its density is
    /// proportional to x^(shape - 1) e^(-rate x), its expectation is shape / rate.
    ///
    /// # Errors
    /// Parameters that are not finite or out of their range.
    pub fn new(shape: f64, rate: f64) -> Result<Self, Invalid> {
        let shape = shape_in_range("shape", shape)?;
        let rate = positive("rate", rate)?;
        within("rate", rate, 1e-290, 1e290, "from 1e-290 to 1e290")?;
        Ok(Self { shape, rate })
    }
}

impl Gamma {
    pub(super) fn characteristic(&self) -> Characteristic {
        Characteristic::Gamma { shape: self.shape, rate: self.rate }
    }
}

/// A shape parameter from 0.01 to 1e15.
pub(super) fn shape_in_range(parameter: &'static str, value: f64) -> Result<f64, Invalid> {
    let value = positive(parameter, value)?;
    within(parameter, value, LEAST_SHAPE, MOST_SHAPE, "from 0.01 to 1e15")
}

impl Shape for Gamma {
    const NAME: &'static str = "gamma";

    fn mean(&self) -> f64 {
        self.shape / self.rate
    }

    fn standard_uncertainty(&self) -> f64 {
        self.shape.sqrt() / self.rate
    }

    fn quantile(&self, p: f64) -> f64 {
        let value = special::gamma::quantile(p, self.shape) / self.rate;
        value.max(f64::MIN_POSITIVE)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let value = special::gamma::quantile_upper(q, self.shape) / self.rate;
        value.max(f64::MIN_POSITIVE)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        draw(self.shape, stream, out);
        for i in 0..COLUMN {
            let value = out.0[i] / self.rate;
            out.0[i] = if value > f64::MIN_POSITIVE { value } else { f64::MIN_POSITIVE };
        }
    }

    /// The gamma distribution with the same shape, and so the same relative standard uncertainty.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Self::new(self.shape, self.shape / positive("estimate", estimate)?)
    }
}

/// Draws of unit rate; at shapes below 1 they may be subnormal or 0.
#[inline(always)]
pub(super) fn draw(shape: f64, stream: &mut Stream, out: &mut Column) {
    if shape < 1.0 {
        draw_ln(shape, stream, out);
        for i in 0..COLUMN {
            out.0[i] = elementary::exp(out.0[i]);
        }
        return;
    }
    let generator = Generator::new(shape);
    generator.fill(stream, out);
    for i in 0..COLUMN {
        let root = 1.0 + out.0[i];
        out.0[i] = generator.d * (root * root * root);
    }
}

/// Logarithms of draws of unit rate, which do not underflow at any shape. For shapes below 1 a draw
/// of the shape + 1 is multiplied by a uniform number to the power 1 / shape. Compiled once for each
/// path, as [`super::normal::draw`].
pub(super) fn draw_ln(shape: f64, stream: &mut Stream, out: &mut Column) {
    stream.path().run(LogarithmKernel { shape, stream, out });
}

struct LogarithmKernel<'a> {
    shape: f64,
    stream: &'a mut Stream,
    out: &'a mut Column,
}

impl Kernel for LogarithmKernel<'_> {
    type Output = ();

    // only drawn for beta distributions and small shapes
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        let Self { shape, stream, out } = self;
        let boosted = shape < 1.0;
        let generator = Generator::new(if boosted { shape + 1.0 } else { shape });
        generator.fill(stream, out);
        let ln_d = elementary::ln(generator.d);
        for i in 0..COLUMN {
            out.0[i] = ln_d + 3.0 * elementary::ln(1.0 + out.0[i]);
        }
        if boosted {
            let mut power = [0.0; COLUMN];
            stream.uniform(&mut power);
            for (x, &power) in out.0.iter_mut().zip(&power) {
                *x += elementary::ln_uniform(power) / shape;
            }
        }
    }
}

/// The rejection method of Marsaglia and Tsang (ACM Transactions on Mathematical Software 26,
/// 2000) for shapes from 1 on: with a normal x and t = c x, the value is d (1 + t)^3.
///
/// At least 95 % of the candidates are accepted. They are generated and tested side by side, then
/// the accepted ones are taken in order, so a block's draws follow from its stream alone.
#[derive(Clone, Copy)]
struct Generator {
    d: f64,
    c: f64,
}

/// Fills a column with accepted t.
struct FillKernel<'a> {
    generator: Generator,
    stream: &'a mut Stream,
    out: &'a mut Column,
}

impl Kernel for FillKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { generator, stream, out } = self;
        let mut filled = 0;
        generator.round::<{ COLUMN / 2 }>(stream, out, &mut filled);
        while filled < COLUMN {
            generator.round::<8>(stream, out, &mut filled);
        }
    }
}

impl Generator {
    #[inline(always)]
    fn new(shape: f64) -> Self {
        let d = shape - 1.0 / 3.0;
        Self { d, c: 1.0 / (9.0 * d).sqrt() }
    }

    /// Fills a column with accepted t.
    fn fill(self, stream: &mut Stream, out: &mut Column) {
        stream.path().run(FillKernel { generator: self, stream, out });
    }

    /// Two times `HALF` candidates, by the pairs of normals of Box and Muller.
    #[inline(always)]
    fn round<const HALF: usize>(&self, stream: &mut Stream, out: &mut Column, filled: &mut usize) {
        let (mut radius, mut turn) = ([0.0; HALF], [0.0; HALF]);
        let (mut first, mut second) = ([0.0; HALF], [0.0; HALF]);
        stream.uniform(&mut radius);
        stream.uniform(&mut turn);
        for i in 0..HALF {
            let r = self.c * (-2.0 * elementary::ln_uniform(radius[i])).sqrt();
            let (sin, cos) = elementary::sin_cos_turn(turn[i]);
            first[i] = r * cos;
            second[i] = r * sin;
        }
        for candidates in [&first, &second] {
            let mut judge = [0.0; HALF];
            stream.uniform(&mut judge);
            for i in 0..HALF {
                judge[i] = self.margin(candidates[i]) - elementary::ln_uniform(judge[i]);
            }
            for i in 0..HALF {
                if judge[i] > 0.0 && *filled < COLUMN {
                    out.0[*filled] = candidates[i];
                    *filled += 1;
                }
            }
        }
    }

    /// The logarithm of the probability of acceptance: x^2/2 + d - d v + d ln v with v = (1 + t)^3,
    /// which is 3 d (ln(1 + t) - t + t^2/2 - t^3/3). Small t, for which that cancels, take the
    /// series; t <= -1, where v would be negative, give no number.
    #[inline(always)]
    fn margin(&self, t: f64) -> f64 {
        let square = t * t;
        let series = square
            * square
            * (-1.0 / 4.0 + t * (1.0 / 5.0 + t * (-1.0 / 6.0 + t * (1.0 / 7.0 - t / 8.0))));
        let direct = elementary::ln(1.0 + t) - t + square * (0.5 - t * (1.0 / 3.0));
        3.0 * self.d * if t.abs() < 0.01 { series } else { direct }
    }
}
