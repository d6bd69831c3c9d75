//! The reliability curve.

use plotters::element::{Circle, PathElement};
use plotters::style::Color;

use super::super::html::Drawing;
use crate::plot::{
    AFTER, Anchor, Axis, FONT, INK, Panel, Write, centred, faded, px, stroke, svg, write,
};
use gumption_gap::check::BlindCheckScores;

const HEIGHT: f64 = 400.0;

/// Width of the panel, which makes it about square.
const SQUARE: f64 = 430.0;

/// Half-width of the ends of a bar, on the axis of probabilities.
const END: f64 = 0.008;

/// Shares of right verdicts against their probabilities, with the intervals of the binomial
/// distribution and the diagonal.
pub(super) fn draw(report: &BlindCheckScores) -> Drawing {
    let axis = Axis::linear(-0.04, 1.04);
    let drawn = |width: f64| {
        svg(width, HEIGHT, |area| {
            let side = px(0.5 * (width - SQUARE).max(0.0));
            let square = area.margin(0, 0, side, side);
            let panel = Panel {
                x: (&axis, "mean probability of the verdicts".to_owned()),
                y: (&axis, "share of right verdicts".to_owned()),
                marks: [6, 6],
                title: String::new(),
            };
            let chart = panel.draw(&square)?;
            let plot = chart.plotting_area();
            plot.draw(&PathElement::new(vec![(0.0, 0.0), (1.0, 1.0)], faded(INK, 0.7, 1.0)))?;
            for bin in &report.reliability {
                let (x, [low, high]) = (bin.probability, bin.interval());
                plot.draw(&PathElement::new(vec![(x, low), (x, high)], stroke(AFTER, 1.5)))?;
                for y in [low, high] {
                    let end = vec![(x - END, y), (x + END, y)];
                    plot.draw(&PathElement::new(end, stroke(AFTER, 1.5)))?;
                }
                plot.draw(&Circle::new((x, bin.fraction), px(4.0), AFTER.filled()))?;
                // beside the dot, on the side where the panel goes on
                let (x, y) = plot.map_coordinate(&(x, bin.fraction));
                let place = |units: i32| f64::from(units) / f64::from(px(1.0));
                let (shift, anchor) =
                    if bin.probability > 0.5 { (-8.0, Anchor::End) } else { (8.0, Anchor::Start) };
                let how = centred((place(x) + shift, place(y)), FONT - 1.0);
                write(area, &bin.count.to_string(), Write { anchor, ..how })?;
            }
            Ok(())
        })
    };
    let caption = "Share of right verdicts against their stated probability, in bins of 0.1; the \
                   numbers beside the dots are numbers of verdicts. Bars: 95 % interval of the \
                   binomial share (Wilson). Diagonal: perfect calibration."
        .to_owned();
    Drawing::new(caption, drawn)
}
