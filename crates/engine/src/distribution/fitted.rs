//! A parameter of a fitted calibration function.

use std::sync::Arc;

use super::shape::{Invalid, Shape, finite, positive};
use super::stream::Stream;
use super::{normal, student};
use crate::number::Column;
use crate::regression::Regression;

/// A parameter of a calibration function. All parameters of one fit are drawn together: from their
/// joint normal distribution, or from the multivariate t distribution if their uncertainties come
/// from the residuals. If they are not linear in the data, each trial is a fit to data of its own.
///
/// A further reading with the scatter of the residuals belongs to the same set: the uncertainty of
/// its standard deviation is the same as for the parameters.
#[derive(Clone, Debug)]
pub struct Fitted {
    fit: Arc<Regression>,
    /// `None` for a reading.
    parameter: Option<usize>,
    mean: f64,
    scale: f64,
}

impl Fitted {
    /// A parameter of a fit, by its index.
    ///
    /// # Errors
    /// A parameter without a finite estimate or a standard uncertainty above zero.
    pub fn new(fit: &Arc<Regression>, parameter: usize) -> Result<Self, Invalid> {
        Ok(Self {
            mean: finite("estimate", fit.estimate(parameter))?,
            scale: positive("standard uncertainty", fit.standard_uncertainty(parameter))?,
            fit: Arc::clone(fit),
            parameter: Some(parameter),
        })
    }

    /// A reading, or mean of readings, whose standard uncertainty `scale` comes from the residuals
    /// of a fit that is linear in its parameters; independent of these apart from the common
    /// scatter.
    ///
    /// # Errors
    /// A mean that is not finite, or a standard uncertainty that is not above zero.
    pub fn reading(fit: &Arc<Regression>, mean: f64, scale: f64) -> Result<Self, Invalid> {
        Ok(Self {
            mean: finite("mean", mean)?,
            scale: positive("standard uncertainty", scale)?,
            fit: Arc::clone(fit),
            parameter: None,
        })
    }

    /// The same parameter or reading of a fit that is the same but for its degrees of freedom.
    pub(crate) fn of_fit(&self, fit: &Arc<Regression>) -> Self {
        Self { fit: Arc::clone(fit), ..self.clone() }
    }

    /// The fit.
    pub fn fit(&self) -> &Arc<Regression> {
        &self.fit
    }

    /// The index of the parameter; `None` for a reading.
    pub fn parameter(&self) -> Option<usize> {
        self.parameter
    }
}

impl PartialEq for Fitted {
    fn eq(&self, other: &Self) -> bool {
        self.parameter == other.parameter
            && self.mean == other.mean
            && (Arc::ptr_eq(&self.fit, &other.fit) || self.fit == other.fit)
    }
}

impl Shape for Fitted {
    const NAME: &'static str = "fit";

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
        self.fit.degrees_of_freedom()
    }

    fn drawn_dof(&self) -> f64 {
        self.dof()
    }

    fn drawn_as(&self) -> Option<&'static str> {
        (self.dof().is_finite() && self.fit.is_linear()).then_some(student::StudentT::NAME)
    }

    fn standard_deviation(&self) -> f64 {
        student::standard_deviation(self.scale, self.dof())
    }

    fn quantile(&self, p: f64) -> f64 {
        self.mean + self.scale * student::standard_quantile(p, self.dof())
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.mean - self.scale * student::standard_quantile(q, self.dof())
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        if self.dof().is_finite() {
            student::draw(self.mean, self.scale, self.dof(), stream, out);
        } else {
            normal::draw(self.mean, self.scale, stream, out);
        }
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { mean: finite("estimate", estimate)?, ..self.clone() })
    }
}
