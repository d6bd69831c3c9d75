//! The choice of a polynomial degree (ISO/TS 28038): the corrected Akaike criterion besides
//! chi-squared.

use std::sync::Arc;

use super::curve::Curve;
use super::error::RegressionError;
use super::points::Points;
use super::result::Regression;

/// A degree that was tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DegreeChoice {
    /// The degree.
    pub degree: usize,
    /// The weighted sum of squares of the residuals.
    pub chi2: f64,
    /// Degrees of freedom.
    pub dof: usize,
    /// The probability of a sum at least this large, if uncertainties are stated.
    pub p_value: Option<f64>,
    /// The corrected Akaike criterion; the degree with the smallest one is chosen.
    pub aicc: f64,
}

/// Fits polynomials with degrees from 1 to `most`, and returns the one with the smallest corrected
/// Akaike criterion, together with all degrees tried. Degrees that the points do not determine are
/// left out.
///
/// # Errors
/// Not even a straight line can be fitted to the points.
pub fn choose_degree(
    name: &str,
    origin: f64,
    points: &Arc<Points>,
    most: usize,
) -> Result<Regression, RegressionError> {
    let noise = Arc::new(points.noise()?);
    let mut tried: Vec<DegreeChoice> = Vec::new();
    let mut best: Option<(f64, Regression)> = None;
    for degree in 1..=most.max(1) {
        let curve = Curve::Polynomial { degree, origin };
        let fitted = match Regression::with(name, &curve, (points, Arc::clone(&noise)), &[]) {
            Ok(fitted) => fitted,
            Err(error) if degree == 1 => return Err(error),
            Err(_) => break,
        };
        let Some(aicc) = aicc(&fitted) else {
            if degree == 1 {
                best = Some((f64::INFINITY, fitted));
            }
            break;
        };
        let (chi2, dof, p_value) = (fitted.chi2, fitted.dof, fitted.p_value());
        tried.push(DegreeChoice { degree, chi2, dof, p_value, aicc });
        if best.as_ref().is_none_or(|(least, _)| aicc < *least) {
            best = Some((aicc, fitted));
        }
    }
    let (_, mut fitted) = best.ok_or(RegressionError::NoScatter)?;
    fitted.degrees = tried;
    Ok(fitted)
}

/// The criterion; `None` if there are too few points for the correction.
fn aicc(fitted: &Regression) -> Option<f64> {
    let n = fitted.points.len() as f64;
    let (deviance, parameters) = match fitted.factor {
        None => (fitted.chi2, fitted.count() as f64),
        // the scatter is an additional parameter
        Some(_) => (n * libm::log(fitted.chi2 / n), fitted.count() as f64 + 1.0),
    };
    let left = n - parameters - 1.0;
    (left > 0.0)
        .then(|| deviance + 2.0 * parameters + 2.0 * parameters * (parameters + 1.0) / left)
        .filter(|aicc| !aicc.is_nan())
}
