//! What is said of a calibration function.

use super::factor;
use super::json::own_name;
use crate::number::{degrees_of_freedom, exact, significant};
use crate::plain;
use crate::table::unit_text;
use gumption_engine::regression::{Cross, Curve, CurveFunction, Spread};
use gumption_engine::task::Coverage;

/// The form, what it was fitted to, and how.
pub(super) fn form(curve: &CurveFunction) -> String {
    let fit = &*curve.fit;
    let points = &*fit.points;
    let equation = equation(curve);
    let [least, most] = points.range();
    let unit = |unit: &gumption_units::Unit| match unit_text(unit).trim() {
        "" | "1" => String::new(),
        text => format!(" {}", plain(text)),
    };
    let method = match (points.is_exact_in_x(), &points.of_y, &points.cross) {
        (true, Spread::None, _) => "ordinary least squares, because no uncertainty is stated for y",
        (true, Spread::Each(_), _) => "weighted least squares",
        (true, Spread::Joint(_), _) => "generalized least squares with the covariance matrix of y",
        (false, Spread::Joint(_), _) | (false, _, Cross::Joint(_)) => {
            "generalized distance regression with the covariance matrices of x and y"
        }
        (false, _, Cross::Each(_)) => {
            "generalized distance regression, with correlated x and y of each point"
        }
        (false, ..) => "generalized distance regression, with uncertain x and y",
    };
    format!(
        "{equation}, fitted to {} {}points from x = {} to {}{} by {method}.",
        points.count(),
        if points.is_complex() { "complex " } else { "" },
        exact(least),
        exact(most),
        unit(&curve.x)
    )
}

/// `line(x) = a + b x`
pub(crate) fn equation(curve: &CurveFunction) -> String {
    let fit = &*curve.fit;
    let name = plain(&fit.name);
    match &fit.curve {
        Curve::Polynomial { origin, .. } => {
            let x =
                if *origin == 0.0 { "x".to_owned() } else { format!("(x - {})", exact(*origin)) };
            let term = |(power, (name, _)): (usize, &(String, gumption_units::Unit))| {
                let name = own_name(name);
                match power {
                    0 => name.to_owned(),
                    1 => format!("{name} {x}"),
                    power => format!("{name} {x}^{power}"),
                }
            };
            let terms: Vec<String> = curve.parameters.iter().enumerate().map(term).collect();
            format!("{name}(x) = {}", terms.join(" + "))
        }
        _ => format!("{name}(x), a formula of the file"),
    }
}

/// Whether points, curve and uncertainties agree.
pub(super) fn agreement(curve: &CurveFunction) -> String {
    let fit = &*curve.fit;
    match (fit.is_valid(), fit.limit_of_chi2(), fit.factor) {
        (Some(valid), Some(limit), _) => format!(
            "Chi-squared is {} with {}, {} its 95 % quantile {} (p = {}): the points, \
             the form of the curve and the stated uncertainties {}.",
            significant(fit.chi2, 4),
            degrees_of_freedom(&fit.dof.to_string()),
            if valid { "not above" } else { "above" },
            significant(limit, 4),
            significant(fit.p_value().unwrap_or(f64::NAN), 2),
            if valid { "agree" } else { "do not agree" }
        ),
        (_, _, Some(factor)) if fit.points.of_y == Spread::None => {
            let unit = plain(curve.y.text());
            format!(
                "The standard deviation of the residuals is {}{} with {}; it is used as u(y), so \
                 the fit cannot be tested for lack of fit.",
                significant(factor, 3),
                if unit.is_empty() || unit == "1" { String::new() } else { format!(" {unit}") },
                degrees_of_freedom(&fit.dof.to_string())
            )
        }
        (_, _, Some(factor)) => format!(
            "The stated uncertainties are multiplied by {}, from the residuals with {}, so the \
             fit cannot be tested for lack of fit.",
            significant(factor, 3),
            degrees_of_freedom(&fit.dof.to_string())
        ),
        _ => "The curve goes through all points, so the fit cannot be tested for lack of fit."
            .to_owned(),
    }
}

/// What a certificate may state of it.
pub(super) fn statement(curve: &CurveFunction, coverage: Coverage) -> String {
    let k = factor(curve, coverage);
    let [least, most] = curve.fit.points.range();
    if curve.fit.is_complex() {
        return format!(
            "From x = {} to {} modulus and phase of the calibration function have the expanded \
             uncertainties U, with the coverage factor k = {}; u^2 of each is the sum over all \
             pairs of parameters: their covariance times the derivatives with respect to both:",
            exact(least),
            exact(most),
            significant(k, 3)
        );
    }
    format!(
        "From x = {} to {} the calibration function has the expanded uncertainty U(x) = k u(x), \
         with the coverage factor k = {}, where u(x)^2 is the sum over all pairs of coefficients: \
         their covariance times the derivatives with respect to both:",
        exact(least),
        exact(most),
        significant(k, 3)
    )
}
