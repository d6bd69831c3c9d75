//! Repeated readings: a Type A evaluation (JCGM 100, 4.2; JCGM 101, 6.4.9).

use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use super::{Distribution, Normal, student};
use crate::number::Column;

/// Repeated independent readings of one quantity. The estimate is their mean; trials are drawn from
/// the t distribution with n - 1 degrees of freedom, scaled by s/sqrt(n).
///
/// Readings of several quantities that were taken together are *paired* ([`Readings::paired`]): the
/// i-th readings of all quantities belong to one observation. They are drawn from the multivariate
/// t distribution of JCGM 102, 5.3, with n - N degrees of freedom for N quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    /// Empty where only the summary of the readings is known.
    values: Vec<f64>,
    count: usize,
    mean: f64,
    scale: f64,
    /// Number of quantities read together, including this one.
    together: usize,
    /// Whether the standard uncertainty is the standard deviation of the t distribution.
    bayesian: bool,
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
        // relative to the first reading, so that a common large part does not cost digits
        let origin = values[0];
        let offset = values.iter().map(|v| v - origin).sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - origin - offset).powi(2)).sum();
        let scale = (squares / (n - 1.0) / n).sqrt();
        let differ = values.iter().any(|v| *v != origin);
        if differ && !(scale > 0.0 && scale.is_finite()) {
            return Err(Invalid::ScatterOutOfRange { count });
        }
        if differ {
            Ok(Self {
                values,
                count,
                mean: finite("the mean of the values", origin + offset)?,
                scale: finite("the scatter of the values", scale)?,
                together: 1,
                bayesian: false,
            })
        } else {
            Err(Invalid::NoScatter { count })
        }
    }

    /// A Type A evaluation of at least two readings of which only their mean, the standard deviation of
    /// one reading and their number are known: the same distribution as that of the readings.
    ///
    /// # Errors
    /// Fewer than two readings, values that are not finite, a standard deviation that is not above 0.
    pub fn of_summary(mean: f64, standard_deviation: f64, count: usize) -> Result<Self, Invalid> {
        if count < 2 {
            return Err(Invalid::TooFewReadings { count });
        }
        if standard_deviation == 0.0 {
            return Err(Invalid::NoScatter { count });
        }
        let (parameter, value) = ("s", finite("s", standard_deviation)?);
        if value < 0.0 {
            return Err(Invalid::NotPositive { parameter, value });
        }
        // the variance over n as of the readings themselves, so that the trials have the same bits
        let scale = (standard_deviation.powi(2) / count as f64).sqrt();
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(Invalid::ScatterOutOfRange { count });
        }
        let mean = finite("mean", mean)?;
        Ok(Self { values: Vec::new(), count, mean, scale, together: 1, bayesian: false })
    }

    /// The same readings, taken together with those of other quantities: `together` quantities,
    /// including this one. All paired readings of equal length are drawn together, and there must
    /// be `together` of them.
    ///
    /// # Errors
    /// There are not more than `together` readings, so that there is no joint distribution. With
    /// one or two more it has no covariance ([`Readings::have_covariance`]). A summary has no readings.
    pub fn paired(self, together: usize) -> Result<Self, Invalid> {
        let count = self.values.len();
        if count > together {
            Ok(Self { together: together.max(1), ..self })
        } else {
            Err(Invalid::TooFewPaired { count, together })
        }
    }

    /// Whether the joint t distribution of the paired readings, with n - N degrees of freedom, has
    /// a covariance (JCGM 102, 5.3): more than N + 2 readings of each of N quantities.
    pub fn have_covariance(&self) -> bool {
        self.count > self.together + 2
    }

    /// The error for trials of paired readings without a covariance; `None` for other readings.
    pub fn without_covariance(&self) -> Option<Invalid> {
        let (count, together) = (self.count, self.together);
        (together > 1 && !self.have_covariance())
            .then_some(Invalid::TooFewPaired { count, together })
    }

    /// The same readings with the standard deviation of their t distribution as standard
    /// uncertainty, which has no degrees of freedom (JCGM 101, 6.4.9.4).
    ///
    /// # Errors
    /// Fewer than four readings, for which this standard deviation does not exist.
    pub fn bayesian(self) -> Result<Self, Invalid> {
        let count = self.count;
        if count < 4 {
            let (value, range) = (count as f64, "at least 4 for a Bayesian evaluation");
            return Err(Invalid::OutOfRange { parameter: "values", value, range });
        }
        Ok(Self { bayesian: true, ..self })
    }

    /// Number of quantities read together, including this one: 1 unless paired.
    pub fn together(&self) -> usize {
        self.together
    }

    /// The scale of the t distribution from which trials are drawn: s/sqrt(n), for paired readings
    /// with the divisor n - N in s.
    pub(crate) fn drawn_scale(&self) -> f64 {
        let dof = self.count as f64 - 1.0;
        self.scale * (dof / self.drawn_dof()).sqrt()
    }

    /// The readings; empty for those of [`Readings::of_summary`].
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The number of readings.
    pub fn count(&self) -> usize {
        self.count
    }
}

impl Shape for Readings {
    const NAME: &'static str = "readings";

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        if self.bayesian { self.standard_deviation() } else { self.scale }
    }

    /// The square root of their number, by which their standard deviation is divided; 1 for a
    /// Bayesian evaluation, whose standard uncertainty is a different one.
    fn divisor(&self) -> Option<f64> {
        Some(if self.bayesian { 1.0 } else { (self.count as f64).sqrt() })
    }

    fn dof(&self) -> f64 {
        if self.bayesian { f64::INFINITY } else { self.count as f64 - 1.0 }
    }

    fn drawn_dof(&self) -> f64 {
        self.count as f64 - self.together as f64
    }

    fn standard_deviation(&self) -> f64 {
        student::standard_deviation(self.drawn_scale(), self.drawn_dof())
    }

    fn quantile(&self, p: f64) -> f64 {
        self.mean + self.drawn_scale() * student::standard_quantile(p, self.drawn_dof())
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.mean - self.drawn_scale() * student::standard_quantile(q, self.drawn_dof())
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        student::draw(self.mean, self.drawn_scale(), self.drawn_dof(), stream, out);
    }

    /// A Bayesian standard uncertainty has infinite degrees of freedom already (JCGM 101, 6.4.9.4).
    fn with_infinite_dof(&self) -> Option<Distribution> {
        if self.bayesian {
            return None;
        }
        Normal::new(self.mean, self.scale).ok().map(Distribution::from)
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..self.clone() })
    }
}
