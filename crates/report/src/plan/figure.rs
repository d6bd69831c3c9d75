//! Plots of the output's uncertainty against each input, and against time.

use gumption_engine::number::{largest_first, smallest_first};
use plotters::element::{Circle, PathElement};
use plotters::style::Color;

use super::PlanReport;
use crate::html::Drawing;
use crate::plain;
use crate::plot::{AFTER, Area, Axis, BEFORE, Drawn, INK, Panel, px, stroke, svg};
use gumption_analysis::plan::{InputNeed, PlannedInterval};

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
        let unit = report.unit(need.variable).trim();
        let name = format!("u({})", plain(report.name(need.variable)));
        if matches!(unit, "" | "1") { name } else { format!("{name} in {}", plain(unit)) }
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
         a change of degrees of freedom), with the target as a line. Vermilion: as it is; blue: where \
         the target begins to hold.",
        report.kind()
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
    let caption = format!(
        "{} against the time since the calibration, with the target as a line. Vermilion: the time \
         for which the drift is stated; blue: the longest interval.",
        report.kind()
    );
    Some(Drawing::new(caption, drawn))
}

fn panel(report: &PlanReport<'_>, area: &Area<'_>, curve: &Curve<'_>) -> Drawn {
    let target = report.plan.limit;
    let end = curve.points.iter().map(|point| point.0).fold(0.0, f64::max);
    let top = curve.points.iter().map(|point| point.1).fold(target, f64::max);
    let (x, y) = (Axis::linear(0.0, end), Axis::linear(0.0, 1.08 * top));
    let output = report.output().map_or("", |output| output.name.as_str());
    let panel = Panel {
        x: (&x, curve.label.clone()),
        y: (&y, format!("{}({})", report.kind(), plain(output))),
        marks: [6, 5],
        title: String::new(),
    };
    let chart = panel.draw(area)?;
    let inside = chart.plotting_area();
    inside.draw(&PathElement::new(vec![(0.0, target), (end, target)], stroke(INK, 1.0)))?;
    inside.draw(&PathElement::new(curve.points.to_vec(), stroke(AFTER, 1.75)))?;
    for (mark, colour) in curve.marks.into_iter().zip([BEFORE, AFTER]) {
        let at = mark.filter(|mark| *mark <= end).and_then(|mark| Some((mark, at(curve, mark)?)));
        if let Some(point) = at {
            inside.draw(&Circle::new(point, px(4.0), colour.filled()))?;
        }
    }
    Ok(())
}

/// The height of a curve at x, interpolated between its points.
fn at(curve: &Curve<'_>, x: f64) -> Option<f64> {
    let after = curve.points.iter().position(|point| point.0 >= x)?;
    let (right, left) = (curve.points[after], curve.points[after.saturating_sub(1)]);
    let width = right.0 - left.0;
    let share = if width > 0.0 { (x - left.0) / width } else { 1.0 };
    Some(left.1 + share * (right.1 - left.1))
}
