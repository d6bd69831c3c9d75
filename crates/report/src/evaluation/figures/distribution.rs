//! The distribution of an output: its trials, the density that the GUM gives it, and the coverage
//! intervals of both.

use plotters::element::{Circle, Rectangle};
use plotters::style::{Color, RGBColor};

use super::curve;
use crate::html::Drawing;
use crate::plain;
use crate::plot::{
    AFTER, Anchor, Area, Axis, BEFORE, Drawn, EVEN, FAINT, FONT, INK, STRIP_AXIS, Strip, Write,
    centred, faded, line, px, shortened, stroke, svg, write,
};
use crate::table::{grouped, has_name, title_text};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::Histogram;
use gumption_units::Unit;

/// Heights in pixels: of the densities, and of a row with an interval.
const TALL: f64 = 230.0;
const ROW: f64 = 22.0;

/// Space for names, and on the right.
const LEFT: f64 = 185.0;
const RIGHT: f64 = 20.0;

/// Space for the numbers of the axis of densities, beside the names.
const NUMBERS: f64 = 38.0;

/// Free space beyond a limit, as a share of what the trials span.
const EDGE: f64 = 0.06;

/// Points of the GUM's density.
const POINTS: usize = 300;

/// Marks of the axis of densities, at most.
const DENSITIES: usize = 4;

/// What stands below the density: its name, its ends, infinite where it has none, its estimate, and
/// its colour.
struct Row {
    name: &'static str,
    ends: [f64; 2],
    estimate: Option<f64>,
    colour: RGBColor,
}

/// The histogram with the GUM's density over it, and below them the intervals, the tolerance and what
/// is accepted; `None` without figures.
pub(in crate::evaluation) fn distribution(
    output: &Quantity,
    found: &OutputEvaluation,
    histogram: &Histogram,
    probability: f64,
) -> Option<Drawing> {
    let figures = found.monte_carlo.as_ref()?;
    let gum = found.gum.as_ref();
    let (low, high) = (histogram.low, histogram.high());
    let place = |share: f64| low + share * (high - low);
    let density: Vec<(f64, f64)> = (0..=POINTS)
        .map(|point| place(point as f64 / POINTS as f64))
        .filter_map(|x| Some((x, gum?.density(x)?)))
        .collect();
    let highest = histogram.densities().fold(0.0, f64::max);
    // a GUM density much narrower than the trials is cut off
    let top = density.iter().map(|point| point.1).fold(highest, f64::max).min(3.0 * highest) * 1.06;
    let y = |density: f64| TALL * (1.0 - (density / top).min(1.0));
    let mut rows = Vec::new();
    let mut row = |name, ends: Option<[f64; 2]>, estimate, colour| {
        rows.extend(ends.map(|ends| Row { name, ends, estimate, colour }));
    };
    row("GUM", gum.and_then(Gum::interval), gum.map(|gum| gum.estimate), INK);
    let trials = figures.estimate.unwrap_or(figures.median);
    row("Monte Carlo, symmetric", Some(figures.symmetric_interval), Some(trials), AFTER);
    row("Monte Carlo, shortest", Some(figures.shortest_interval), Some(trials), AFTER);
    if let Some(conformity) = &found.conformity {
        row("tolerance", Some(conformity.tolerance.ends()), None, BEFORE);
        let accepted = conformity.acceptance.filter(|_| conformity.wanted_risk.is_some());
        row("acceptance", accepted.map(|limits| limits.ends()), None, BEFORE);
    }
    let axis = axis(low, high, rows.iter().flat_map(|row| row.ends));
    let bottom = TALL + 6.0 + ROW * rows.len() as f64;
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        svg(width, bottom + STRIP_AXIS, |area| {
            let label = title_text(&Quantity { about: String::new(), ..output.clone() });
            strip.draw(area, 0.0, bottom, &label)?;
            for (position, text) in Axis::linear(0.0, top).marks(DENSITIES) {
                let at = y(position);
                line(area, [(strip.from, at), (strip.to, at)], stroke(FAINT, 0.75))?;
                if position > 0.0 {
                    strip.name(area, &text, at)?;
                }
            }
            for (bin, density) in histogram.densities().enumerate() {
                if density > 0.0 {
                    let from = strip.x(low + bin as f64 * histogram.width);
                    let to = strip.x(low + (bin + 1) as f64 * histogram.width);
                    let corners = [(px(from), px(y(density))), (px(to), px(TALL))];
                    area.draw(&Rectangle::new(corners, EVEN.filled()))?;
                }
            }
            line(area, [(strip.from, TALL), (strip.to, TALL)], stroke(INK, 0.75))?;
            let places: Vec<(f64, f64)> =
                density.iter().map(|&(x, d)| (strip.x(x), y(d))).collect();
            curve(area, &places, stroke(INK, 2.0))?;
            for (number, row) in rows.iter().enumerate() {
                let at = TALL + 6.0 + ROW * (number as f64 + 0.5);
                strip.name(area, row.name, at)?;
                strip.interval(area, row.ends, at, row.colour)?;
                for end in row.ends.into_iter().filter(|end| end.is_finite()) {
                    let x = strip.x(end);
                    line(area, [(x, at), (x, 0.35 * TALL)], faded(row.colour, 0.55, 0.75))?;
                }
                if let Some(estimate) = row.estimate {
                    let place = (px(strip.x(estimate)), px(at));
                    area.draw(&Circle::new(place, px(3.5), row.colour.filled()))?;
                }
            }
            legend(area, gum.filter(|_| !density.is_empty()), strip.from, &output.unit)
        })
    };
    let trials = grouped(histogram.trials());
    let first = if histogram.trials() < figures.trials { "first " } else { "" };
    let line = if density.is_empty() { "" } else { ", the density that the GUM gives (line)" };
    let percent = crate::number::exact(100.0 * probability);
    let limits = match found.conformity.as_ref().map(|of| of.wanted_risk) {
        None => "",
        Some(None) => "; below them the tolerance",
        Some(Some(_)) => "; below them the tolerance and the limits of acceptance",
    };
    let caption = format!(
        "The {first}{trials} Monte Carlo trials (bars){line} and the coverage intervals for {percent} % \
         with the estimates (dots){limits}."
    );
    Some(Drawing::new(caption, drawn))
}

/// The axis over the trials, and over limits that lie no further from them than the trials reach.
fn axis(low: f64, high: f64, ends: impl Iterator<Item = f64>) -> Axis {
    let span = high - low;
    let near = (low - span)..=(high + span);
    let [from, to] = ends
        .filter(|end| near.contains(end))
        .map(|end| [end - EDGE * span, end + EDGE * span])
        .fold([low, high], |[from, to], [a, b]| [from.min(a), to.max(b)]);
    Axis::linear(from, to)
}

/// What bars, line and the axis of densities are, left of a place.
fn legend(area: &Area<'_>, gum: Option<&Gum>, room: f64, unit: &Unit) -> Drawn {
    let text = |text: &str, from: f64, y: f64| {
        let how = Write { anchor: Anchor::Start, ..centred((from, y), FONT) };
        write(area, &shortened(text, room - from - NUMBERS, FONT), how)
    };
    let corners = [(px(14.0), px(14.0)), (px(34.0), px(26.0))];
    area.draw(&Rectangle::new(corners, EVEN.filled()))?;
    text("Monte Carlo", 42.0, 20.0)?;
    let shape = match gum.map(|gum| gum.dof) {
        Some(Dof::Infinite) => Some("GUM: normal"),
        Some(Dof::Finite(_)) => Some("GUM: t"),
        _ => None,
    };
    if let Some(shape) = shape {
        line(area, [(14.0, 42.0), (34.0, 42.0)], stroke(INK, 2.0))?;
        text(shape, 42.0, 42.0)?;
    }
    text("density", 14.0, 64.0)?;
    if has_name(unit) {
        let unit = plain(unit.text());
        let is_one = unit.chars().all(|c| c.is_alphanumeric());
        let unit = if is_one { unit } else { format!("({unit})") };
        text(&format!("in 1/{unit}"), 14.0, 80.0)?;
    }
    Ok(())
}
