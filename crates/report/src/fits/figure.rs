//! The curve with its band through the points, and the residuals below.

use crate::table::unit_text;
use plotters::element::{Circle, PathElement, Polygon};
use plotters::style::Color;

use super::{factor, places};
use crate::html::Drawing;
use crate::plain;
use crate::plot::{AFTER, Axis, EVEN, INK, Panel, WEAK, px, stroke, svg};
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::Coverage;

/// Heights of the panels in pixels.
const UPPER: f64 = 260.0;
const LOWER: f64 = 190.0;

/// Places of the curve.
const PLACES: usize = 121;

/// Points that a figure shows, at most.
const MOST: usize = 2000;

pub(super) fn draw(curve: &CurveFunction, coverage: Coverage) -> Option<Drawing> {
    let (fit, k) = (&*curve.fit, factor(curve, coverage));
    let points = &*fit.points;
    let band: Vec<[f64; 3]> =
        places(curve, PLACES).map(|x| [x, fit.at(x), k * fit.uncertainty_at(x)]).collect();
    if !band.iter().flatten().all(|value| value.is_finite()) {
        return None;
    }
    let residuals = fit.residuals();
    let step = points.len().div_ceil(MOST).max(1);
    let shown: Vec<usize> = (0..points.len()).step_by(step).collect();
    let bar = |point: usize| points.uncertainty_of_y(point).map_or(0.0, |u| k * u);
    let [least, most] = points.range();
    let margin = 0.04 * (most - least);
    let x = Axis::linear(least - margin, most + margin);
    let values = band.iter().flat_map(|[_, y, u]| [y - u, y + u]);
    let y = Axis::around(values.chain(shown.iter().map(|p| points.y[*p])))?;
    let ends = shown.iter().flat_map(|p| [residuals[*p] - bar(*p), residuals[*p] + bar(*p)]);
    let left = Axis::about_zero(ends.chain(band.iter().map(|[_, _, u]| *u)));
    let label = |name: &str, unit: &gumption_units::Unit| match unit_text(unit).trim() {
        "" | "1" => plain(name),
        text => format!("{} in {}", plain(name), plain(text)),
    };
    let around = |centre: &dyn Fn(&[f64; 3]) -> f64| -> Vec<(f64, f64)> {
        let above = band.iter().map(|of| (of[0], centre(of) + of[2]));
        above.chain(band.iter().rev().map(|of| (of[0], centre(of) - of[2]))).collect()
    };
    let drawn = |width: f64| {
        svg(width, UPPER + LOWER, |area| {
            let (top, bottom) = area.split_vertically(px(UPPER));
            let panel = |label: String, axis, marks| Panel {
                x: (&x, self::label(&curve.x)),
                y: (axis, label),
                marks,
                title: String::new(),
            };
            let upper = panel(label(&fit.name, &curve.y), &y, [9, 7]).draw(&top)?;
            let upper = upper.plotting_area();
            upper.draw(&Polygon::new(around(&|of| of[1]), EVEN.mix(0.45).filled()))?;
            let line: Vec<(f64, f64)> = band.iter().map(|[x, y, _]| (*x, *y)).collect();
            upper.draw(&PathElement::new(line, stroke(AFTER, 1.5)))?;
            for point in &shown {
                let place = (points.x[*point], points.y[*point]);
                upper.draw(&Circle::new(place, px(2.5), INK.filled()))?;
            }
            let lower = panel(label("residual", &curve.y), &left, [9, 6]).draw(&bottom)?;
            let lower = lower.plotting_area();
            lower.draw(&Polygon::new(around(&|_| 0.0), EVEN.mix(0.45).filled()))?;
            lower.draw(&PathElement::new(vec![(least, 0.0), (most, 0.0)], stroke(AFTER, 1.5)))?;
            for point in &shown {
                let (x, residual) = (points.x[*point], residuals[*point]);
                let bar = bar(*point);
                if bar > 0.0 {
                    let bar = vec![(x, residual - bar), (x, residual + bar)];
                    lower.draw(&PathElement::new(bar, stroke(WEAK, 1.0)))?;
                }
                lower.draw(&Circle::new((x, residual), px(2.5), INK.filled()))?;
            }
            Ok(())
        })
    };
    let bars = if points.of_y == gumption_engine::regression::Spread::None {
        ""
    } else {
        " Bars are the expanded uncertainties of y alone."
    };
    let some = if step > 1 { " Not all points are drawn." } else { "" };
    let caption = format!(
        "Above: {} with the band of its expanded uncertainty (of the curve, not of single points); below: \
         residuals of the points about it.{bars}{some}",
        plain(&fit.name)
    );
    Some(Drawing::new(caption, drawn))
}

fn label(unit: &gumption_units::Unit) -> String {
    match unit_text(unit).trim() {
        "" | "1" => "x".to_owned(),
        text => format!("x in {}", plain(text)),
    }
}
