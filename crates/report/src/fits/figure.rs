//! The curve with its band through the points, and the residuals below; of a complex curve modulus and
//! phase.

use crate::table::unit_text;
use plotters::element::{Circle, PathElement, Polygon};
use plotters::style::Color;

use super::{factor, places};
use crate::html::Drawing;
use crate::plain;
use crate::plot::{AFTER, Area, Axis, Drawn, EVEN, INK, Panel, WEAK, px, stroke, svg};
use gumption_engine::number::elementary;
use gumption_engine::regression::{CurveFunction, Regression};
use gumption_engine::task::Coverage;

/// Heights of the panels in pixels.
const UPPER: f64 = 260.0;
const LOWER: f64 = 190.0;

/// Places of a real curve, and of a complex one, which may have a narrow resonance.
const PLACES: usize = 121;
const COMPLEX_PLACES: usize = 481;

/// Points that a figure shows, at most.
const MOST: usize = 2000;

/// What a panel shows.
struct Shown {
    label: String,
    axis: Axis,
    /// Abscissa, value and expanded uncertainty of the curve; of residuals the value is 0.
    band: Vec<[f64; 3]>,
    /// Abscissa and value of each point, and its expanded uncertainty, which is drawn unless it is 0.
    points: Vec<[f64; 3]>,
    are_residuals: bool,
}

impl Shown {
    /// A curve through its points.
    fn curve(label: String, band: Vec<[f64; 3]>, points: Vec<[f64; 3]>) -> Option<Self> {
        let values = band.iter().flat_map(|[_, y, u]| [y - u, y + u]);
        let axis = Axis::around(values.chain(points.iter().map(|[_, y, _]| *y)))?;
        Some(Self { label, axis, band, points, are_residuals: false })
    }

    /// Residuals with the band of the curve about zero.
    fn residuals(label: String, band: &[[f64; 3]], points: Vec<[f64; 3]>) -> Self {
        let ends = points.iter().flat_map(|[_, y, bar]| [y - bar, y + bar]);
        let axis = Axis::about_zero(ends.chain(band.iter().map(|[_, _, u]| *u)));
        let band = band.iter().map(|[x, _, u]| [*x, 0.0, *u]).collect();
        Self { label, axis, band, points, are_residuals: true }
    }

    fn draw(&self, area: &Area<'_>, (x, x_label): (&Axis, &str)) -> Drawn {
        let marks = if self.are_residuals { [9, 6] } else { [9, 7] };
        let (x_axis, y_axis) = ((x, x_label.to_owned()), (&self.axis, self.label.clone()));
        let panel = Panel { x: x_axis, y: y_axis, marks, title: String::new() };
        let chart = panel.draw(area)?;
        let chart = chart.plotting_area();
        let above = self.band.iter().map(|[at, y, u]| (x.position(*at), y + u));
        let below = self.band.iter().rev().map(|[at, y, u]| (x.position(*at), y - u));
        let around: Vec<(f64, f64)> = above.chain(below).collect();
        chart.draw(&Polygon::new(around, EVEN.mix(0.45).filled()))?;
        let line = self.band.iter().map(|[at, y, _]| (x.position(*at), *y));
        let mut line: Vec<(f64, f64)> = line.collect();
        if self.are_residuals && line.len() > 2 {
            line.drain(1..line.len() - 1);
        }
        chart.draw(&PathElement::new(line, stroke(AFTER, 1.5)))?;
        for [at, y, bar] in &self.points {
            let at = x.position(*at);
            if *bar > 0.0 && self.are_residuals {
                let bar = vec![(at, y - bar), (at, y + bar)];
                chart.draw(&PathElement::new(bar, stroke(WEAK, 1.0)))?;
            }
            chart.draw(&Circle::new((at, *y), px(2.5), INK.filled()))?;
        }
        Ok(())
    }
}

pub(super) fn draw(curve: &CurveFunction, coverage: Coverage) -> Option<Drawing> {
    let (fit, k) = (&*curve.fit, factor(curve, coverage));
    let points = &*fit.points;
    let step = points.count().div_ceil(MOST).max(1);
    let shown: Vec<usize> = (0..points.count()).step_by(step).collect();
    let panels = match fit.is_complex() {
        true => complex(curve, k, &shown)?,
        false => real(curve, k, &shown)?,
    };
    let [least, most] = points.range();
    let margin = 0.04 * (most - least);
    let x = match fit.is_complex() {
        true => Axis::over(points.x.iter().copied()),
        false => Axis::linear(least - margin, most + margin),
    };
    let x_label = labelled("x", &unit_text(&curve.x));
    let heights = |shown: &Shown| if shown.are_residuals { LOWER } else { UPPER };
    let height: f64 = panels.iter().map(heights).sum();
    let are_complex = fit.is_complex();
    let drawn = move |width: f64| {
        svg(width, height, |area| {
            let mut rest = area.clone();
            for (number, panel) in panels.iter().enumerate() {
                let (top, below) = match number + 1 == panels.len() {
                    true => (rest.clone(), rest),
                    false => rest.split_vertically(px(heights(panel))),
                };
                panel.draw(&top, (&x, &x_label))?;
                rest = below;
            }
            Ok(())
        })
    };
    let bars = match (&points.of_y, are_complex) {
        (gumption_engine::regression::Spread::None, _) => "",
        (_, false) => " Bars are the expanded uncertainties of y alone.",
        (_, true) => " Bars are the expanded uncertainties of the points alone.",
    };
    let some = if step > 1 { " Not all points are drawn." } else { "" };
    let name = plain(&fit.name);
    let caption = if are_complex {
        format!(
            "Modulus and phase of {name} with the bands of their expanded uncertainties (of the curve, not of \
             single points), each above the residuals of the points about it.{bars}{some}"
        )
    } else {
        format!(
            "Above: {name} with the band of its expanded uncertainty (of the curve, not of single points); \
             below: residuals of the points about it.{bars}{some}"
        )
    };
    Some(Drawing::new(caption, drawn))
}

fn labelled(name: &str, unit: &str) -> String {
    match unit.trim() {
        "" | "1" => plain(name),
        text => format!("{} in {}", plain(name), plain(text)),
    }
}

/// The curve, and its residuals.
fn real(curve: &CurveFunction, k: f64, shown: &[usize]) -> Option<Vec<Shown>> {
    let (fit, unit) = (&*curve.fit, unit_text(&curve.y));
    let (points, residuals) = (&*fit.points, fit.residuals());
    let band: Vec<[f64; 3]> =
        places(curve, PLACES).map(|x| [x, fit.at(x), k * fit.uncertainty_at(x)]).collect();
    if !band.iter().flatten().all(|value| value.is_finite()) {
        return None;
    }
    let bar = |point: usize| points.uncertainty_of_y(point).map_or(0.0, |u| k * u);
    let beside = shown.iter().map(|&p| [points.x[p], residuals[p], bar(p)]).collect();
    let left = Shown::residuals(labelled("residual", &unit), &band, beside);
    let through = shown.iter().map(|&p| [points.x[p], points.y[p], 0.0]).collect();
    Some(vec![Shown::curve(labelled(&fit.name, &unit), band, through)?, left])
}

/// Modulus with its relative residuals, and phase with its residuals in degrees.
fn complex(curve: &CurveFunction, k: f64, shown: &[usize]) -> Option<Vec<Shown>> {
    let (fit, unit) = (&*curve.fit, unit_text(&curve.y));
    let of_curve: Vec<_> = places(curve, COMPLEX_PLACES).map(|x| (x, fit.polar_at(x))).collect();
    let phases = continuous(fit, of_curve.iter().map(|(x, _)| *x));
    let modulus: Vec<[f64; 3]> =
        of_curve.iter().map(|(x, at)| [*x, at.modulus, k * at.modulus_uncertainty]).collect();
    let relative: Vec<[f64; 3]> =
        modulus.iter().map(|[x, modulus, u]| [*x, 0.0, 100.0 * u / modulus]).collect();
    let phase: Vec<[f64; 3]> = of_curve
        .iter()
        .zip(phases)
        .map(|((x, at), phase)| [*x, phase.to_degrees(), k * at.phase_uncertainty.to_degrees()])
        .collect();
    if !modulus.iter().chain(&phase).flatten().all(|value| value.is_finite()) {
        return None;
    }
    let all = fit.complex_residuals();
    let (mut of_modulus, mut of_phase) = (Vec::new(), Vec::new());
    let (mut left_modulus, mut left_phase) = (Vec::new(), Vec::new());
    for residual in shown.iter().map(|&point| all[point]) {
        let x = residual.x;
        let bars = residual.covariance.map_or([0.0; 2], |of| [of[0][0], of[1][1]]);
        let [u_modulus, u_phase] = bars.map(|variance| k * variance.sqrt());
        // the phase beside the nearest place of the curve, on the same turn
        let place = phase.partition_point(|[at, ..]| *at < x).min(phase.len() - 1);
        let near = phase[place][1].to_radians();
        let [re, im] = residual.value;
        let own = elementary::atan2(im, re);
        let turns = ((near - own) / std::f64::consts::TAU).round();
        of_phase.push([x, (own + turns * std::f64::consts::TAU).to_degrees(), 0.0]);
        of_modulus.push([x, elementary::hypot(re, im), 0.0]);
        left_modulus.push([x, 100.0 * residual.modulus(), 100.0 * u_modulus]);
        left_phase.push([x, residual.phase().to_degrees(), u_phase.to_degrees()]);
    }
    let left = Shown::residuals("residual of abs in %".to_owned(), &relative, left_modulus);
    let label = |part: &str, unit: &str| labelled(&format!("{part} {}", fit.name), unit);
    let left_phase = Shown::residuals("residual of arg in deg".to_owned(), &phase, left_phase);
    Some(vec![
        Shown::curve(label("abs", &unit), modulus, of_modulus)?,
        left,
        Shown::curve(label("arg", "deg"), phase, of_phase)?,
        left_phase,
    ])
}

/// The phase of a complex curve in radians, without jumps from one place to the next.
fn continuous(fit: &Regression, places: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut last: Option<f64> = None;
    let next = |x: f64| {
        let own = fit.polar_at(x).phase;
        let turns = last.map_or(0.0, |last| ((last - own) / std::f64::consts::TAU).round());
        let phase = own + turns * std::f64::consts::TAU;
        last = Some(phase);
        phase
    };
    places.map(next).collect()
}
