//! Repeated readings: a Type A evaluation (JCGM 100, 4.2; JCGM 101, 6.4.9).

use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use super::student;
use crate::number::Column;

/// Repeated independent readings of one quantity. The estimate is their mean; trials are drawn from
/// the t distribution with n - 1 degrees of freedom, scaled by s/sqrt(n).
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    values: Vec<f64>,
    mean: f64,
    scale: f64,
}

impl Readings {
    /// A Type A evaluation of at least two readings.
    ///
    /// # Errors
    /// Fewer than two readings, readings that are not finite, readings that are all equal.
    pub fn new(values: Vec<f64>) -> Result<Self, Invalid> {
        let count = values.len();
        if count < 2 {
            return Err(Invalid::TooFewReadings { count });
        }
        for &value in &values {
            finite("values", value)?;
        }
        let n = count as f64;
        // about the first reading, so that a common large part does not cost digits
        let origin = values[0];
        let offset = values.iter().map(|v| v - origin).sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - origin - offset).powi(2)).sum();
        let scale = (squares / (n - 1.0) / n).sqrt();
        if scale > 0.0 {
            Ok(Self {
                values,
                mean: finite("values", origin + offset)?,
                scale: finite("values", scale)?,
            })
        } else {
            Err(Invalid::NoScatter { count })
        }
    }

    /// The readings.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

impl Shape for Readings {
    const NAME: &'static str = "readings";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.scale
    }

    fn dof(&self) -> f64 {
        self.values.len() as f64 - 1.0
    }

    fn drawn_dof(&self) -> f64 {
        self.dof()
    }

    fn standard_deviation(&self) -> f64 {
        student::standard_deviation(self.scale, self.dof())
    }

    fn quantile(&self, p: f64) -> f64 {
        self.mean + self.scale * student::standard_quantile(p, self.dof())
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        student::draw(self.mean, self.scale, self.dof(), stream, out);
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..self.clone() })
    }
}
