//! A calibration function for programs.

use gumption_engine::regression::{Curve, CurveFunction, DegreeChoice};
use serde::Serialize;

use crate::answer::in_order;

/// A calibration function in the answer.
#[derive(Serialize)]
pub(crate) struct FitSide<'a> {
    form: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    degree: Option<usize>,
    #[serde(skip_serializing_if = "is_zero")]
    origin: f64,
    x_unit: &'a str,
    y_unit: &'a str,
    range: [f64; 2],
    #[serde(serialize_with = "in_order")]
    coefficients: Vec<(&'a str, CoefficientSide<'a>)>,
    covariance: Vec<Vec<f64>>,
    chi2: f64,
    dof: usize,
    p_value: Option<f64>,
    valid: Option<bool>,
    /// Where uncertainties come from the residuals: the standard deviation of these, or the factor of
    /// the stated ones.
    residual_standard_deviation: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    degrees: Vec<DegreeSide>,
    residuals: ResidualsSide,
}

/// Residuals; of complex points the relative ones of the modulus, and those of the phase in radians.
#[derive(Serialize)]
#[serde(untagged)]
enum ResidualsSide {
    Real(Vec<f64>),
    Complex { relative_modulus: Vec<f64>, phase: Vec<f64> },
}

#[derive(Serialize)]
struct CoefficientSide<'a> {
    estimate: f64,
    standard_uncertainty: f64,
    unit: &'a str,
}

#[derive(Serialize)]
struct DegreeSide {
    degree: usize,
    chi2: f64,
    dof: usize,
    p_value: Option<f64>,
    aicc: f64,
}

impl<'a> FitSide<'a> {
    pub(crate) fn of(curve: &'a CurveFunction) -> Self {
        let fit = &*curve.fit;
        let (form, degree, origin) = match &fit.curve {
            Curve::Polynomial { degree: 1, origin } => ("straight-line", None, *origin),
            Curve::Polynomial { degree, origin } => ("polynomial", Some(*degree), *origin),
            _ if fit.is_complex() => ("complex-formula", None, 0.0),
            _ => ("formula", None, 0.0),
        };
        let coefficient = |(number, (name, unit)): (usize, &'a (String, gumption_units::Unit))| {
            let side = CoefficientSide {
                estimate: fit.estimate(number),
                standard_uncertainty: fit.standard_uncertainty(number),
                unit: unit.text(),
            };
            (own_name(name), side)
        };
        let residuals = if fit.is_complex() {
            let beside = fit.complex_residuals();
            let beside = beside.iter().map(|residual| (residual.modulus(), residual.phase()));
            let (relative_modulus, phase) = beside.unzip();
            ResidualsSide::Complex { relative_modulus, phase }
        } else {
            ResidualsSide::Real(fit.residuals())
        };
        let row = |i: usize| (0..fit.count()).map(|j| fit.covariance(i, j)).collect();
        Self {
            form,
            degree,
            origin,
            x_unit: curve.x.text(),
            y_unit: curve.y.text(),
            range: fit.points.range(),
            coefficients: curve.parameters.iter().enumerate().map(coefficient).collect(),
            covariance: (0..fit.count()).map(row).collect(),
            chi2: fit.chi2,
            dof: fit.dof,
            p_value: fit.p_value(),
            valid: fit.is_valid(),
            residual_standard_deviation: fit.factor,
            degrees: fit.degrees.iter().map(DegreeSide::from).collect(),
            residuals,
        }
    }
}

impl From<&DegreeChoice> for DegreeSide {
    fn from(choice: &DegreeChoice) -> Self {
        let DegreeChoice { degree, chi2, dof, p_value, aicc } = *choice;
        Self { degree, chi2, dof, p_value, aicc }
    }
}

/// The name of a parameter within its function: `a` of `line.a`.
pub(super) fn own_name(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(_, own)| own)
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
