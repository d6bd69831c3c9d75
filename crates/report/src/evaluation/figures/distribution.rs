//! The distribution of an output: its trials, the density that the GUM gives it, and the coverage
//! intervals of both.

use plotters::element::Rectangle;
use plotters::style::Color;

use super::{FigureSize, curve};
use crate::html::Drawing;
use crate::plot::{
    AFTER, Axis, EVEN, INK, STRIP_AXIS, Strip, centred, faded, line, px, stroke, svg, write,
};
use crate::plot::{Anchor, FONT, Write};
use crate::table::{grouped, title_text};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::Histogram;

/// Heights in pixels: of the densities, and of a row with an interval.
const TALL: f64 = 230.0;
const ROW: f64 = 22.0;

/// Space on the right.
const RIGHT: f64 = 20.0;

/// Points of the GUM's density.
const POINTS: usize = 300;

/// The histogram with the GUM's density over it and the intervals below; `None` without figures.
pub(in crate::evaluation) fn distribution(
    output: &Quantity,
    found: &OutputEvaluation,
    histogram: &Histogram,
    probability: f64,
    size: FigureSize,
) -> Option<Drawing> {
    let (width, left) = (size.width(), size.names());
    let figures = found.monte_carlo.as_ref()?;
    let gum = found.gum.as_ref();
    let (low, high) = (histogram.low, histogram.high());
    let axis = Axis::linear(low, high);
    let strip = Strip { axis: &axis, from: left, to: width - RIGHT };
    let place = |share: f64| low + share * (high - low);
    let density: Vec<(f64, f64)> = (0..=POINTS)
        .map(|point| place(point as f64 / POINTS as f64))
        .filter_map(|x| Some((x, gum?.density(x)?)))
        .collect();
    let highest = histogram.densities().fold(0.0, f64::max);
    // a GUM density much narrower than the trials is cut off
    let top = density.iter().map(|point| point.1).fold(highest, f64::max).min(3.0 * highest) * 1.06;
    let y = |density: f64| TALL * (1.0 - (density / top).min(1.0));
    let intervals = [
        ("GUM", gum.and_then(Gum::interval), INK),
        (size.name("Monte Carlo, symmetric"), Some(figures.symmetric_interval), AFTER),
        (size.name("Monte Carlo, shortest"), Some(figures.shortest_interval), AFTER),
    ];
    let rows: Vec<_> =
        intervals.into_iter().filter_map(|(n, interval, c)| Some((n, interval?, c))).collect();
    let bottom = TALL + 6.0 + ROW * rows.len() as f64;
    let drawn = svg(width, bottom + STRIP_AXIS, |area| {
        strip.draw(
            area,
            0.0,
            bottom,
            &title_text(&Quantity { about: String::new(), ..output.clone() }),
        )?;
        for (bin, density) in histogram.densities().enumerate() {
            if density > 0.0 {
                let from = strip.x(low + bin as f64 * histogram.width);
                let to = strip.x(low + (bin + 1) as f64 * histogram.width);
                let corners = [(px(from), px(y(density))), (px(to), px(TALL))];
                area.draw(&Rectangle::new(corners, EVEN.filled()))?;
            }
        }
        line(area, [(left, TALL), (width - RIGHT, TALL)], stroke(INK, 0.75))?;
        let places: Vec<(f64, f64)> = density.iter().map(|&(x, d)| (strip.x(x), y(d))).collect();
        curve(area, &places, stroke(INK, 2.0))?;
        for (row, (name, interval, colour)) in rows.iter().enumerate() {
            let at = TALL + 6.0 + ROW * (row as f64 + 0.5);
            strip.name(area, name, at)?;
            strip.interval(area, *interval, at, *colour)?;
            for end in interval {
                let x = strip.x(*end);
                line(area, [(x, at), (x, 0.35 * TALL)], faded(*colour, 0.55, 0.75))?;
            }
        }
        legend(area, gum)
    });
    let trials = grouped(histogram.trials());
    let first = if histogram.trials() < figures.trials { "first " } else { "" };
    let line = if density.is_empty() { "" } else { ", the density that the GUM gives (line)" };
    let percent = crate::number::exact(100.0 * probability);
    let caption = format!(
        "The {first}{trials} Monte Carlo trials (bars){line} and the coverage intervals for {percent} %."
    );
    Some(Drawing { svg: drawn, caption })
}

/// What bars and line are.
fn legend(area: &crate::plot::Area<'_>, gum: Option<&Gum>) -> crate::plot::Drawn {
    let corners = [(px(14.0), px(14.0)), (px(34.0), px(26.0))];
    area.draw(&Rectangle::new(corners, EVEN.filled()))?;
    let text = |text: &str, y: f64| {
        let how = Write { anchor: Anchor::Start, ..centred((42.0, y), FONT) };
        write(area, text, how)
    };
    text("Monte Carlo", 20.0)?;
    let shape = match gum.map(|gum| gum.dof) {
        Some(Dof::Infinite) => "GUM: normal",
        Some(Dof::Finite(_)) => "GUM: t",
        _ => return Ok(()),
    };
    line(area, [(14.0, 42.0), (34.0, 42.0)], stroke(INK, 2.0))?;
    text(shape, 42.0)
}
