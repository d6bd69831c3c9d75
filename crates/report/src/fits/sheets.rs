//! Tables of a calibration function.

use super::json::own_name;
use super::{factor, places};
use crate::number::{exact, significant, with_uncertainty};
use crate::sheet::{Figure, Sheet};
use crate::table::unit_text;
use crate::{number, plain};
use gumption_engine::decimal::to_digits;
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::Coverage;

/// Places at which the statement is tabulated.
pub(crate) const STATED: usize = 7;

/// Estimates and standard uncertainties of the coefficients.
pub(super) fn coefficients(curve: &CurveFunction, digits: u32) -> Sheet {
    let fit = &*curve.fit;
    let rounded: Vec<(String, String)> = (0..fit.count())
        .map(|k| with_uncertainty(fit.estimate(k), fit.standard_uncertainty(k), digits))
        .collect();
    let figures = |of: &dyn Fn(usize) -> (f64, String)| -> Vec<Figure> {
        (0..fit.count()).map(of).map(|(value, text)| Figure::of(value, text)).collect()
    };
    let mut sheet = Sheet::default();
    sheet.text("coefficient", curve.parameters.iter().map(|(name, _)| plain(name)));
    sheet.figures("estimate", figures(&|k| (fit.estimate(k), rounded[k].0.clone())));
    sheet.figures("std. unc.", figures(&|k| (fit.standard_uncertainty(k), rounded[k].1.clone())));
    sheet.units("unit", curve.parameters.iter().map(|(_, unit)| unit_text(unit)));
    sheet
}

/// Their correlation coefficients, where there are several.
pub(crate) fn correlations(curve: &CurveFunction) -> Option<Sheet> {
    let fit = &*curve.fit;
    let count = fit.count();
    if count < 2 {
        return None;
    }
    let mut sheet = Sheet::default();
    sheet.text("r", curve.parameters.iter().map(|(name, _)| plain(own_name(name))));
    for (j, (name, _)) in curve.parameters.iter().enumerate() {
        let cells = (0..count).map(|i| {
            let r = if i == j { 1.0 } else { fit.correlation(i, j) };
            Figure::of(r, number::rounded(r, -4))
        });
        sheet.figures(own_name(name), cells);
    }
    Some(sheet)
}

/// The degrees that were compared.
pub(super) fn degrees(curve: &CurveFunction) -> Option<Sheet> {
    let tried = &curve.fit.degrees;
    if tried.is_empty() {
        return None;
    }
    let mut sheet = Sheet::default();
    sheet.numbers("degree", tried.iter().map(|of| of.degree.to_string()));
    sheet.figures(
        "chi-squared",
        tried.iter().map(|of| Figure::of(of.chi2, significant(of.chi2, 4))),
    );
    sheet.numbers("deg. of freedom", tried.iter().map(|of| of.dof.to_string()));
    let p = |p| Figure::rounded(p, |p| significant(p, 2));
    sheet.figures("p-value", tried.iter().map(|of| p(of.p_value)));
    sheet.figures("AICc", tried.iter().map(|of| Figure::of(of.aicc, number::rounded(of.aicc, -2))));
    Some(sheet)
}

/// The curve with its expanded uncertainty over the range; of a complex one modulus and phase.
pub(super) fn statement(curve: &CurveFunction, coverage: Coverage, digits: u32) -> Sheet {
    let k = factor(curve, coverage);
    let at: Vec<f64> = places(curve, STATED).collect();
    let unit = |name: &str, unit: &str| match unit.trim() {
        "" | "1" => name.to_owned(),
        text => format!("{name}\n{}", plain(text)),
    };
    let mut sheet = Sheet::default();
    let x = at.iter().map(|x| Figure::of(*x, exact(to_digits(*x, 6))));
    sheet.figures(&unit("x", &unit_text(&curve.x)), x);
    let mut state = |[name, u_name]: [&str; 2], y_unit: &str, values: Vec<(f64, f64)>| {
        let text = |&(y, u): &(f64, f64)| with_uncertainty(y, u, digits);
        let texts: Vec<(String, String)> = values.iter().map(text).collect();
        let each = values.iter().zip(&texts);
        let of_y = each.clone().map(|((y, _), t)| Figure::of(*y, t.0.clone()));
        sheet.figures(&unit(name, y_unit), of_y);
        sheet.figures(&unit(u_name, y_unit), each.map(|((_, u), t)| Figure::of(*u, t.1.clone())));
    };
    let name = format!("{}(x)", plain(&curve.fit.name));
    let y_unit = unit_text(&curve.y);
    if curve.fit.is_complex() {
        let polar: Vec<_> = at.iter().map(|x| curve.fit.polar_at(*x)).collect();
        let modulus = polar.iter().map(|of| (of.modulus, k * of.modulus_uncertainty)).collect();
        let phase =
            polar.iter().map(|of| (of.phase.to_degrees(), k * of.phase_uncertainty.to_degrees()));
        state([&format!("abs {name}"), "U of abs"], &y_unit, modulus);
        state([&format!("arg {name}"), "U of arg"], "deg", phase.collect());
    } else {
        let value = |x: &f64| (curve.fit.at(*x), k * curve.fit.uncertainty_at(*x));
        state([&name, "U"], &y_unit, at.iter().map(value).collect());
    }
    sheet
}
