//! Calibration functions: what was fitted, how well, and where it lies.

mod figure;
mod json;
mod sheets;
mod words;

pub(crate) use json::FitSide;
pub(crate) use sheets::{STATED, correlations};
pub(crate) use words::equation;

use super::document::Document;
use crate::plot::Axis;
use gumption_engine::number::elementary::pow;
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::Coverage;

/// A section for each calibration function.
pub(crate) fn sections<'a>(
    document: &mut Document,
    curves: impl IntoIterator<Item = &'a CurveFunction>,
    coverage: Coverage,
    digits: u32,
) {
    for curve in curves {
        document.section(format!("Calibration function {}", crate::plain(&curve.fit.name)));
        document.text(words::form(curve));
        document.text(words::agreement(curve));
        document.table(sheets::coefficients(curve, digits));
        document.blocks.extend(correlations(curve).map(super::document::Block::Table));
        document.blocks.extend(sheets::degrees(curve).map(super::document::Block::Table));
        document.text(words::statement(curve, coverage));
        document.table(sheets::statement(curve, coverage, digits));
        document.figure(figure::draw(curve, coverage));
    }
}

/// The coverage factor of a curve's expanded uncertainty.
pub(crate) fn factor(curve: &CurveFunction, coverage: Coverage) -> f64 {
    let dof = curve.fit.degrees_of_freedom();
    match (coverage, coverage.nominal_factor()) {
        (Coverage::Factor { factor, fixed: true }, _) => factor,
        (_, Some(factor)) if dof.is_infinite() => factor,
        _ => gumption_engine::special::student::two_sided_factor(coverage.probability(), dof),
    }
}

/// So many places at equal distances over the range of the points; at equal ratios where the points of
/// a complex curve are spaced so.
pub(crate) fn places(curve: &CurveFunction, count: usize) -> impl Iterator<Item = f64> {
    let points = &curve.fit.points;
    let [least, most] = points.range();
    let is_geometric = points.is_complex() && Axis::over(points.x.iter().copied()).is_logarithmic();
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count).map(move |k| match (k as f64 / last, is_geometric) {
        (share, true) if 0.0 < share && share < 1.0 => least * pow(most / least, share),
        (1.0, true) => most,
        (share, _) => least + (most - least) * share,
    })
}
