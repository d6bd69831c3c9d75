//! The residuals of one output before and after the correction, over each condition.

use gumption_engine::number::{median, smallest_first};
use plotters::element::{PathElement, Polygon};
use plotters::style::{Color, RGBColor};

use super::super::groups;
use super::super::residuals::{self, Residual};
use super::super::words;
use super::Drawing;
use crate::plain;
use crate::plot::{
    AFTER, Area, Axis, BEFORE, Chart, Drawn, Fill, Groups, INK, Panel, faded, mark, stroke, svg,
};
use gumption_gap::Diagnosis;

/// Height of a row of panels in pixels.
const HEIGHT: f64 = 185.0;

/// The least width of two panels beside each other, in pixels.
const BESIDE: f64 = 500.0;

/// Half-width of the band in standard uncertainties.
const BAND: f64 = 2.0;

/// Standard uncertainties that differ by more than this factor are what residuals are divided by.
const UNEQUAL: f64 = 10.0;

/// More values than this are drawn as ranges of neighbours, in so many strokes.
const POINTS: usize = 1500;
const STROKES: usize = 240;

/// A point: the condition, the residual, its standard uncertainty and its group.
type ResidualPoint = (f64, f64, f64, usize);

/// Which residual and standard uncertainty are meant.
type ResidualOf = fn(&Residual) -> (f64, f64);

/// Two panels for each condition that varies; `None` without values.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis, output: usize) -> Option<Drawing> {
    let named = diagnosis.outputs.get(output)?;
    let over = residuals::panels(diagnosis);
    let own = residuals::of(diagnosis, output, *over.first()?);
    if own.is_empty() {
        return None;
    }
    let divided = is_unequal(&own);
    let label = if divided { "residual / u".to_owned() } else { unit_label(diagnosis, output) };
    let many = own.len() > POINTS;
    let groups: Vec<Groups> = over.iter().map(|over| groups::groups(diagnosis, *over)).collect();
    let both: [(&str, RGBColor, ResidualOf); 2] =
        [("before", BEFORE, |r| r.before), ("after", AFTER, |r| r.after)];
    // one scale for both sides of all panels, so that what shrinks is seen to
    let scaled = |residual: &Residual, of: ResidualOf| {
        let (value, u) = of(residual);
        let scale = if divided { u } else { 1.0 };
        (value / scale, u / scale)
    };
    let y = scale(both.iter().flat_map(|(.., of)| own.iter().map(|r| scaled(r, *of))));
    let drawn = |width: f64| {
        // side by side where there is room, else one below the other
        let halves = if width < BESIDE { (2, 1) } else { (1, 2) };
        let total = HEIGHT * (over.len() * halves.0) as f64;
        svg(width, total, |area| {
            let panels = area.split_evenly((over.len(), 1));
            for (rows, (over, groups)) in panels.iter().zip(over.iter().zip(&groups)) {
                let points = residuals::of(diagnosis, output, *over);
                let along = over.axis(diagnosis);
                let sides = rows.split_evenly(halves);
                for (side, (title, colour, of)) in sides.iter().zip(both) {
                    let points: Vec<ResidualPoint> = points
                        .iter()
                        .map(|residual| {
                            let (value, u) = scaled(residual, of);
                            (
                                residual.x,
                                value,
                                u,
                                groups.of(&diagnosis.rows[residual.row].conditions),
                            )
                        })
                        .collect();
                    half(side, title, &points, &y, (along.clone(), label.clone()), colour)?;
                }
            }
            Ok(())
        })
    };
    let told_apart = if many {
        String::new()
    } else {
        groups::captions(diagnosis, over.iter().copied().zip(&groups))
    };
    let marks = if many {
        "Each stroke spans the residuals of neighbouring values."
    } else {
        "Full marks are further from zero than twice their own standard uncertainty."
    };
    let scale = if divided {
        ", divided by their standard uncertainties, which differ too much between the rows for \
         one scale"
    } else {
        ""
    };
    let caption = format!(
        "Residuals of {}, measured less predicted{scale}, before (left, or above) and after the \
         correction (right, or below, each predicted by a fit without its own block of \
         conditions). Band: ± two standard uncertainties of the residuals, from the noise and the \
         inputs before, from the noise and the fitted parameters after. {marks}{told_apart}",
        plain(&named.name)
    );
    Some(Drawing::new(caption, drawn))
}

fn unit_label(diagnosis: &Diagnosis, output: usize) -> String {
    match words::unit(&diagnosis.outputs[output].unit) {
        Some(unit) => format!("residual in {unit}"),
        None => "residual".to_owned(),
    }
}

fn is_unequal(residuals: &[Residual]) -> bool {
    let [least, most] = residuals
        .iter()
        .flat_map(|residual| [residual.before.1, residual.after.1])
        .fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], u| [a.min(u), b.max(u)]);
    least > 0.0 && most > UNEQUAL * least
}

/// A scale that holds zero, all residuals and the band where it is usual.
fn scale(points: impl Iterator<Item = (f64, f64)>) -> Axis {
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    let mut bands = Vec::new();
    for (value, u) in points.filter(|(value, _)| value.is_finite()) {
        (low, high) = (low.min(value), high.max(value));
        bands.push(BAND * u);
    }
    let usual = median(bands).unwrap_or(0.0);
    let (low, high) = (low.min(-usual), high.max(usual));
    let margin = 0.05 * (high - low);
    if margin > 0.0 && margin.is_finite() {
        Axis::linear(low - margin, high + margin)
    } else {
        Axis::about_zero([])
    }
}

/// One panel.
fn half(
    area: &Area<'_>,
    title: &str,
    points: &[ResidualPoint],
    y: &Axis,
    (along, label): (String, String),
    colour: RGBColor,
) -> Drawn {
    let x = Axis::over(points.iter().map(|(x, ..)| *x));
    let panel = Panel { x: (&x, along), y: (y, label), marks: [6, 5], title: title.to_owned() };
    let chart = panel.draw(area)?;
    band(&chart, &x, y, points)?;
    let [from, to] = x.ends();
    chart
        .plotting_area()
        .draw(&PathElement::new(vec![(from, 0.0), (to, 0.0)], faded(INK, 0.7, 0.75)))?;
    if points.len() > POINTS {
        return strokes(&chart, &x, points, colour);
    }
    for (at, value, u, group) in points {
        let fill = if value.abs() > BAND * u { Fill::Full } else { Fill::Open };
        mark(&chart, *group, (x.position(*at), *value), 2.75, (colour, fill))?;
    }
    Ok(())
}

/// Neighbouring values together, so that there are at most so many groups.
fn groups(points: &[ResidualPoint], most: usize) -> Vec<Vec<ResidualPoint>> {
    let mut sorted = points.to_vec();
    smallest_first(&mut sorted, |a| a.0);
    let levels: Vec<Vec<ResidualPoint>> =
        sorted.chunk_by(|a, b| a.0 == b.0).map(<[ResidualPoint]>::to_vec).collect();
    let size = levels.len().div_ceil(most).max(1);
    levels.chunks(size).map(<[Vec<ResidualPoint>]>::concat).collect()
}

/// Twice the root mean square of the standard uncertainties at each value of the condition.
fn band(chart: &Chart<'_>, x: &Axis, y: &Axis, points: &[ResidualPoint]) -> Drawn {
    let groups = groups(points, STROKES);
    let edge: Vec<(f64, f64)> = groups
        .iter()
        .map(|group| {
            let count = group.len() as f64;
            let mean = group.iter().map(|(x, ..)| x).sum::<f64>() / count;
            let square = group.iter().map(|(_, _, u, _)| u * u).sum::<f64>() / count;
            (x.position(mean), BAND * square.sqrt())
        })
        .collect();
    let (Some(first), Some(last)) = (edge.first(), edge.last()) else { return Ok(()) };
    // to both ends of the panel
    let [from, to] = x.ends();
    let upper: Vec<(f64, f64)> = std::iter::once((from, first.1))
        .chain(edge.iter().copied())
        .chain([(to, last.1)])
        .collect();
    // a band that is wide somewhere ends at the edge of the panel
    let [bottom, top] = y.ends();
    let lower: Vec<(f64, f64)> = upper.iter().map(|(x, y)| (*x, (-y).max(bottom))).collect();
    let upper: Vec<(f64, f64)> = upper.into_iter().map(|(x, y)| (x, y.min(top))).collect();
    let around: Vec<(f64, f64)> =
        upper.iter().copied().chain(lower.iter().rev().copied()).collect();
    chart.plotting_area().draw(&Polygon::new(around, INK.mix(0.1).filled()))?;
    for edge in [upper, lower] {
        let style = faded(INK, 0.45, 0.75);
        chart.plotting_area().draw(&PathElement::new(edge, style))?;
    }
    Ok(())
}

/// The range of the residuals of neighbouring values.
fn strokes(chart: &Chart<'_>, x: &Axis, points: &[ResidualPoint], colour: RGBColor) -> Drawn {
    for group in groups(points, STROKES) {
        let mean = group.iter().map(|(x, ..)| x).sum::<f64>() / group.len() as f64;
        let [least, most] = group
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], (_, r, ..)| [a.min(*r), b.max(*r)]);
        let ends = vec![(x.position(mean), least), (x.position(mean), most)];
        chart.plotting_area().draw(&PathElement::new(ends, stroke(colour, 1.5)))?;
    }
    Ok(())
}
