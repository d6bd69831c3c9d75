//! Samples: an empirical distribution, for example from another calculation (JCGM 101, 7.5).

use std::sync::Arc;

use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use crate::number::{COLUMN, Column, ascending};

/// Samples of a quantity, all equally likely and drawn with replacement. The standard uncertainty
/// is their standard deviation with the divisor n.
///
/// Their order does not matter. Clones share them.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// In ascending order.
    values: Arc<[f64]>,
    mean: f64,
    std: f64,
}

impl Samples {
    /// The empirical distribution of at least two samples.
    ///
    /// # Errors
    /// Fewer than two samples, samples that are not finite, samples that are all equal.
    pub fn new(mut values: Vec<f64>) -> Result<Self, Invalid> {
        let count = values.len();
        if count < 2 {
            return Err(Invalid::TooFewSamples { count });
        }
        for &value in &values {
            finite("values", value)?;
        }
        ascending(&mut values);
        let n = count as f64;
        // relative to the median, so that a common large part does not cost digits
        let origin = values[count / 2];
        let offset = values.iter().map(|v| v - origin).sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - origin - offset).powi(2)).sum();
        let std = finite("values", (squares / n).sqrt())?;
        if values[0] < values[count - 1] && std > 0.0 {
            Ok(Self { values: values.into(), mean: finite("values", origin + offset)?, std })
        } else {
            Err(Invalid::EqualSamples { count })
        }
    }

    /// The samples in ascending order.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

impl Shape for Samples {
    const NAME: &'static str = "samples";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.std
    }

    /// The smallest sample that at least the fraction `p` of the samples does not exceed.
    fn quantile(&self, p: f64) -> f64 {
        let n = self.values.len();
        let number = (p * n as f64).ceil() as usize;
        self.values[number.clamp(1, n) - 1]
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        // uniform numbers are whole multiples of 2^-53, so the index floor(u n) is exact in integers
        const DENOMINATOR: f64 = (1_u64 << 53) as f64;
        stream.uniform(&mut out.0);
        let n = self.values.len() as u128;
        for i in 0..COLUMN {
            let numerator = (out.0[i] * DENOMINATOR) as u64;
            out.0[i] = self.values[((u128::from(numerator) * n) >> 53) as usize];
        }
    }

    /// All samples are shifted.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let shift = finite("estimate", estimate)? - self.mean;
        let values: Arc<[f64]> = self.values.iter().map(|value| value + shift).collect();
        finite("estimate", values[0])?;
        finite("estimate", values[values.len() - 1])?;
        Ok(Self { values, mean: estimate, ..*self })
    }
}
