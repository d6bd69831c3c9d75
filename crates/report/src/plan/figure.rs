//! Plots of the output's uncertainty against each input, and against time.

use gumption_engine::number::{largest_first, smallest_first};
use plotters::element::{Circle, EmptyElement, PathElement, Text};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::PlanReport;
use crate::html::Drawing;
use crate::plain;
use crate::plot::{
    AFTER, Area, Axis, BEFORE, Drawn, FONT, INK, Panel, dashed, px, stroke, svg, text_style,
};
use crate::table::unit_text;
use gumption_analysis::plan::{InputNeed, PlannedInterval};
use gumption_units::Unit;

/// Height of a panel in pixels.
const TALL: f64 = 190.0;

/// Minimum width of two panels side by side, in pixels.
const BESIDE: f64 = 500.0;

/// Maximum number of panels: for the inputs that matter most.
const MOST: usize = 12;

/// A curve with its marks.
struct Curve<'a> {
    points: &'a [(f64, f64)],
    label: String,
    /// The present value, and the one at which the target begins to hold.
    marks: [Option<f64>; 2],
}

/// A panel for each input; `None` if none can be planned.
pub(super) fn inputs(report: &PlanReport<'_>) -> Option<Drawing> {
    let plan = report.plan;
    let share = |need: &InputNeed| {
        let mut lines = plan.now.budget();
        lines.find(|line| line.variable == need.variable).map_or(0.0, |line| line.share.abs())
    };
    let mut shown: Vec<&InputNeed> =
        plan.inputs.iter().filter(|need| need.curve.len() > 1 && share(need) > 0.0).collect();
    largest_first(&mut shown, |line| share(line));
    shown.truncate(MOST);
    smallest_first(&mut shown, |need| need.variable as f64);
    if shown.is_empty() {
        return None;
    }
    let label = |need: &InputNeed| {
        let unit = report.task.variables.get(need.variable).map(|variable| &variable.unit);
        labelled(format!("u({})", plain(report.name(need.variable))), unit)
    };
    let curves: Vec<Curve<'_>> = shown
        .iter()
        .map(|need| Curve {
            points: &need.curve,
            label: label(need),
            marks: [Some(need.standard_uncertainty), need.needed],
        })
        .collect();
    let drawn = |width: f64| {
        let columns = if curves.len() == 1 || width < BESIDE { 1 } else { 2 };
        let rows = curves.len().div_ceil(columns);
        svg(width, rows as f64 * TALL, |area| {
            let parts = area.split_evenly((rows, columns));
            parts.iter().zip(&curves).try_for_each(|(area, curve)| panel(report, area, curve))
        })
    };
    let caption = format!(
        "{} against the standard uncertainty of each input while the others stay as they are (without \
         a change of degrees of freedom). {}",
        report.kind(),
        legend(&curves, ["as it is", "where the target begins to hold"])
    );
    Some(Drawing::new(caption, drawn))
}

/// The uncertainty against time.
pub(super) fn interval(report: &PlanReport<'_>, found: &PlannedInterval) -> Option<Drawing> {
    if found.curve.len() < 2 {
        return None;
    }
    let unit = plain(report.time_unit);
    let label = if unit.is_empty() { "time".to_owned() } else { format!("time in {unit}") };
    let marks = [Some(found.drift.stated), found.longest];
    let curve = Curve { points: &found.curve, label, marks };
    let drawn = |width: f64| svg(width, 1.2 * TALL, |area| panel(report, area, &curve));
    let marks = ["the time for which the drift is stated", "the longest interval"];
    let caption = format!(
        "{} against the time since the calibration. {}",
        report.kind(),
        legend(std::slice::from_ref(&curve), marks)
    );
    Some(Drawing::new(caption, drawn))
}

/// A name with the unit of its axis.
fn labelled(name: String, unit: Option<&Unit>) -> String {
    match unit.filter(|unit| unit.has_name()) {
        Some(unit) => format!("{name} in {}", unit_text(unit)),
        None => name,
    }
}

/// The meaning of the dots that are drawn, by their colours.
fn legend(curves: &[Curve<'_>], meanings: [&str; 2]) -> String {
    let is_drawn = |place: usize| {
        curves
            .iter()
            .any(|curve| curve.marks[place].is_some_and(|mark| curve.point(mark).is_some()))
    };
    let dots = ["vermilion dot", "blue dot"].into_iter().zip(meanings).enumerate();
    let drawn = dots.filter(|(place, _)| is_drawn(*place));
    let parts: Vec<String> = drawn.map(|(_, (dot, meaning))| format!("{dot}: {meaning}")).collect();
    if parts.is_empty() {
        return "Dashed line: the target.".to_owned();
    }
    format!("Dashed line: the target; {}.", parts.join("; "))
}

fn panel(report: &PlanReport<'_>, area: &Area<'_>, curve: &Curve<'_>) -> Drawn {
    let target = report.plan.limit;
    let end = curve.points.iter().map(|point| point.0).fold(0.0, f64::max);
    let top = curve.points.iter().map(|point| point.1).fold(target, f64::max);
    let (x, y) = (Axis::linear(0.0, end), Axis::linear(0.0, 1.08 * top));
    let output = report.output();
    let name = plain(output.map_or("", |output| output.name.as_str()));
    let unit = output.map(|output| output.unit.of_differences());
    let panel = Panel {
        x: (&x, curve.label.clone()),
        y: (&y, labelled(format!("{}({name})", report.kind()), unit.as_ref())),
        marks: [6, 5],
        title: String::new(),
    };
    let chart = panel.draw(area)?;
    let inside = chart.plotting_area();
    inside.draw(&PathElement::new(curve.points.to_vec(), stroke(INK, 1.5)))?;
    inside.draw(&dashed(vec![(0.0, target), (end, target)], stroke(INK, 1.0)))?;
    // the first dot is larger, so that both are seen where they agree
    for (mark, (colour, size)) in curve.marks.into_iter().zip([(BEFORE, 5.0), (AFTER, 3.25)]) {
        if let Some(point) = mark.and_then(|mark| curve.point(mark)) {
            inside.draw(&Circle::new(point, px(size), colour.filled()))?;
        }
    }
    // its name is above the line, at the end where the curve is farther from it
    let height = |point: Option<&(f64, f64)>| point.map_or(0.0, |point| (point.1 - target).abs());
    let is_left = height(curve.points.first()) > height(curve.points.last());
    let (x, side, inwards) =
        if is_left { (0.0, HPos::Left, px(4.0)) } else { (end, HPos::Right, -px(4.0)) };
    let style = text_style(FONT - 1.0, INK, false).pos(Pos::new(side, VPos::Bottom));
    inside.draw(&(EmptyElement::at((x, target)) + Text::new("target", (inwards, -px(2.0)), style)))
}

impl Curve<'_> {
    /// The point at x, interpolated between those of the curve; `None` beyond its end.
    fn point(&self, x: f64) -> Option<(f64, f64)> {
        let after = self.points.iter().position(|point| point.0 >= x)?;
        let (right, left) = (self.points[after], self.points[after.saturating_sub(1)]);
        let width = right.0 - left.0;
        let share = if width > 0.0 { (x - left.0) / width } else { 1.0 };
        Some((x, left.1 + share * (right.1 - left.1)))
    }
}
