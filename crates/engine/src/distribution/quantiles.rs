//! A distribution given by some of its quantiles, as experts and other programs state it.

use std::sync::Arc;

use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use crate::number::{COLUMN, Column};
use crate::special::normal;
use crate::special::tails::moments;

/// A quantity with some known quantiles. Between them the quantile function is a monotone cubic
/// (Fritsch, Carlson 1980). If the probabilities 0 and 1 are among them, these are hard limits, and
/// the interpolation is in the probability. Without them it is in the normal score, and both tails
/// are normal: quantiles of a normal distribution give that distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantiles {
    /// Probabilities, or normal scores.
    at: Arc<[f64]>,
    values: Arc<[f64]>,
    slopes: Arc<[f64]>,
    bounded: bool,
    mean: f64,
    std: f64,
}

impl Quantiles {
    /// The distribution with these quantiles, at increasing probabilities.
    ///
    /// # Errors
    /// Fewer than two quantiles, or different numbers of values and probabilities; probabilities
    /// that do not increase, are outside 0 to 1, or include only one of 0 and 1; values that
    /// decrease.
    pub fn new(probabilities: &[f64], values: &[f64]) -> Result<Self, Invalid> {
        let wrong = |parameter, value, range| Err(Invalid::OutOfRange { parameter, value, range });
        let count = probabilities.len();
        if count < 2 {
            return wrong("probabilities", count as f64, "at least two of them");
        }
        if values.len() != count {
            let range = "as many as probabilities";
            return wrong("values", values.len() as f64, range);
        }
        for (i, (&p, &x)) in probabilities.iter().zip(values).enumerate() {
            finite("values", x)?;
            if !(0.0..=1.0).contains(&p) {
                return wrong("probabilities", p, "between 0 and 1");
            }
            if i > 0 && p <= probabilities[i - 1] {
                return wrong("probabilities", p, "above the one before it");
            }
            if i > 0 && x <= values[i - 1] {
                return wrong("values", x, "above the one before it");
            }
        }
        let ends = [probabilities[0] == 0.0, probabilities[count - 1] == 1.0];
        let bounded = match ends {
            [true, true] => true,
            [false, false] => false,
            [first, _] => {
                let value = if first { 0.0 } else { 1.0 };
                return wrong("probabilities", value, "with the other of 0 and 1, or without both");
            }
        };
        let at: Vec<f64> = if bounded {
            probabilities.to_vec()
        } else {
            probabilities.iter().map(|&p| normal::quantile(p)).collect()
        };
        let slopes = monotone_slopes(&at, values).into();
        let (at, values) = (at.into(), values.into());
        let mut made = Self { at, values, slopes, bounded, mean: 0.0, std: 0.0 };
        let centre = made.quantile(0.5);
        let (mean, variance) =
            moments(|p| made.quantile(p) - centre, |q| made.quantile_upper(q) - centre);
        made.mean = finite("values", centre + mean)?;
        made.std = finite("values", variance.sqrt())?;
        Ok(made)
    }

    /// The value at a probability or at a normal score.
    fn curve(&self, t: f64) -> f64 {
        let last = self.at.len() - 1;
        let (first, end) = (self.at[0], self.at[last]);
        // straight lines beyond the ends: normal tails
        if t <= first {
            return self.values[0] + self.slopes[0] * (t - first);
        }
        if t >= end {
            return self.values[last] + self.slopes[last] * (t - end);
        }
        let piece = self.at.partition_point(|&at| at <= t).clamp(1, last) - 1;
        let (a, b) = (self.at[piece], self.at[piece + 1]);
        let (p, q) = (self.values[piece], self.values[piece + 1]);
        let (width, steep) = (b - a, (q - p) / (b - a));
        let (d, e) = (self.slopes[piece], self.slopes[piece + 1]);
        let of = t - a;
        let second = (3.0 * steep - 2.0 * d - e) / width;
        let third = (d + e - 2.0 * steep) / (width * width);
        p + of * (d + of * (second + of * third))
    }
}

/// Slopes at the points for which the cubics between them never decrease: harmonic means of the
/// slopes of the lines on both sides; at the ends the slopes of the lines.
fn monotone_slopes(xs: &[f64], ys: &[f64]) -> Vec<f64> {
    let widths: Vec<f64> = xs.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let steep: Vec<f64> =
        ys.windows(2).zip(&widths).map(|(pair, width)| (pair[1] - pair[0]) / width).collect();
    let n = xs.len();
    let mut slopes = vec![steep[0]; n];
    slopes[n - 1] = steep[n - 2];
    for i in 1..n - 1 {
        let (h, k) = (widths[i - 1], widths[i]);
        let (w, v) = (2.0 * k + h, k + 2.0 * h);
        slopes[i] = (w + v) / (w / steep[i - 1] + v / steep[i]);
    }
    slopes
}

impl Shape for Quantiles {
    const NAME: &'static str = "quantiles";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.std
    }

    fn quantile(&self, p: f64) -> f64 {
        self.curve(if self.bounded { p } else { normal::quantile(p) })
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.curve(if self.bounded { 1.0 - q } else { normal::quantile_upper(q) })
    }

    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        if self.bounded {
            stream.uniform(&mut out.0);
        } else {
            super::normal::draw(0.0, 1.0, stream, out);
        }
        for i in 0..COLUMN {
            out.0[i] = self.curve(out.0[i]);
        }
    }

    /// All values are shifted.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let shift = finite("estimate", estimate)? - self.mean;
        let values: Arc<[f64]> = self.values.iter().map(|value| value + shift).collect();
        for &value in values.iter() {
            finite("estimate", value)?;
        }
        Ok(Self { values, mean: estimate, ..self.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of a normal distribution reproduce it, including the tails. 1e-9: the quadrature.
    #[test]
    fn quantiles_of_a_normal_are_that_normal() {
        let p = [0.025, 0.16, 0.5, 0.84, 0.975];
        let values = p.map(|p| 10.0 + 0.5 * normal::quantile(p));
        let of = Quantiles::new(&p, &values).unwrap();
        assert!((of.mean() - 10.0).abs() < 1e-9);
        assert!((of.standard_uncertainty() - 0.5).abs() < 1e-9);
        assert!((of.quantile(1e-6) - (10.0 + 0.5 * normal::quantile(1e-6))).abs() < 1e-12);
    }

    /// A rectangular quantity by its ends and its middle.
    #[test]
    fn hard_limits() {
        let of = Quantiles::new(&[0.0, 0.5, 1.0], &[1.0, 2.0, 3.0]).unwrap();
        assert!((of.mean() - 2.0).abs() < 1e-12);
        assert!((of.standard_uncertainty() - 1.0 / 3.0_f64.sqrt()).abs() < 1e-10);
        assert_eq!(of.quantile(0.25), 1.5);
        let skew = Quantiles::new(&[0.0, 0.5, 1.0], &[0.0, 1.0, 9.0]).unwrap();
        let steps: Vec<f64> = (0..=100).map(|i| skew.quantile(f64::from(i) / 100.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn what_is_no_distribution() {
        for (p, x) in [
            (&[0.5][..], &[1.0][..]),
            (&[0.1, 0.9], &[1.0]),
            (&[0.9, 0.1], &[1.0, 2.0]),
            (&[0.1, 0.9], &[2.0, 1.0]),
            (&[0.0, 0.9], &[1.0, 2.0]),
            (&[0.1, 1.2], &[1.0, 2.0]),
        ] {
            assert!(Quantiles::new(p, x).is_err(), "{p:?}");
        }
    }
}
