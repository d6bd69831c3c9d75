//! How far each assumption moves the interval, as a strip.

use plotters::element::Circle;
use plotters::style::Color;

use crate::html::Drawing;
use crate::plot::{AFTER, Axis, INK, STRIP_AXIS, Strip, WEAK, faded, line, px, stroke, svg};
use gumption_assumptions::{InputAudit, OutputAudit, VariantChange};

/// Height of a row in pixels, and space for the names.
const ROW: f64 = 24.0;
const LEFT: f64 = 220.0;
const RIGHT: f64 = 24.0;

/// For each input with assumptions: from width halved to width doubled, and every other shape as a
/// point; `None` where nothing moves.
pub(super) fn draw(output: &OutputAudit, name: impl Fn(usize) -> String) -> Option<Drawing> {
    let shown: Vec<&InputAudit> = output.inputs.iter().filter(|i| i.halved.is_some()).collect();
    let percent = |moved: &VariantChange| moved.change.map(|change| 100.0 * change);
    let widths = |input: &InputAudit| {
        let ends = [input.halved.as_ref(), input.doubled.as_ref()];
        ends.map(|end| end.and_then(percent))
    };
    let shapes = |input: &InputAudit| -> Vec<f64> {
        input.alternatives.iter().filter_map(|other| percent(&other.moved)).collect()
    };
    let all: Vec<f64> = shown
        .iter()
        .flat_map(|input| shapes(input).into_iter().chain(widths(input).into_iter().flatten()))
        .chain([0.0])
        .collect();
    if shown.is_empty() || all.iter().all(|value| *value == 0.0) {
        return None;
    }
    let axis = Axis::over(all);
    let bottom = 4.0 + ROW * shown.len() as f64;
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, "change of the interval's half-length in %")?;
            let zero = strip.x(0.0);
            line(area, [(zero, 0.0), (zero, bottom)], stroke(INK, 1.0))?;
            for (row, input) in shown.iter().enumerate() {
                let y = 4.0 + ROW * (row as f64 + 0.5);
                strip.name(area, &name(input.variable), y)?;
                if let [Some(low), Some(high)] = widths(input) {
                    let ends = [(strip.x(low), y), (strip.x(high), y)];
                    line(area, ends, faded(WEAK, 0.45, 7.0))?;
                }
                for value in shapes(input) {
                    let at = (px(strip.x(value)), px(y));
                    area.draw(&Circle::new(at, px(3.5), AFTER.filled()))?;
                }
            }
            Ok(())
        })
    };
    let caption = "Change of half the length of the coverage interval: with the width halved to \
                   doubled (grey bar) and with every other shape (points)."
        .to_owned();
    Some(Drawing::new(caption, drawn))
}
