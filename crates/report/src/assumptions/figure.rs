//! The effect of each assumption on the interval: a tornado of the inputs, and bars of other shapes.

use gumption_engine::number::largest_first;
use plotters::style::RGBColor;

use crate::html::Drawing;
use crate::number::rounded;
use crate::plot::{
    AFTER, EVEN, FONT, INK, STRIP_AXIS, Strip, WIDER, axis_of_bars, length, line, stroke, svg,
};
use gumption_assumptions::{InputAudit, Kept, OutputAudit, VariantChange};

/// Heights of a row and of its bar in pixels, space for the names, and space at both ends for values.
const ROW: f64 = 22.0;
const BAR: f64 = 14.0;
const LEFT: f64 = 220.0;
const RIGHT: f64 = 14.0;

/// Free space beside a value.
const MARGIN: f64 = 7.0;

/// Maximum number of rows; the largest changes are shown.
const MOST: usize = 24;

/// The label of the axis.
const LABEL: &str = "change of U in %";

/// A row: its name, and its bars from zero, each with its colour.
struct Row {
    name: String,
    bars: Vec<(f64, RGBColor)>,
}

/// For each input the change of half the length of the interval without its uncertainty, and with its
/// width doubled, the largest effect first; `None` where nothing moves.
pub(super) fn tornado(output: &OutputAudit, name: impl Fn(usize) -> String) -> Option<Drawing> {
    let effect = |input: &InputAudit| percent(input.removed.as_ref()).map_or(0.0, f64::abs);
    let mut inputs: Vec<&InputAudit> = output.inputs.iter().collect();
    largest_first(&mut inputs, |input| effect(input));
    let rows = inputs.into_iter().filter_map(|input| {
        let changes = [(&input.removed, AFTER), (&input.doubled, EVEN)];
        let bars = changes.into_iter();
        let bars = bars.filter_map(|(of, colour)| Some((seen(of.as_ref())?, colour)));
        Some(Row { name: name(input.variable), bars: bars.collect() })
            .filter(|row| !row.bars.is_empty())
    });
    let rows: Vec<Row> = rows.collect();
    let caption = "Change of U, half the length of the coverage interval: if the input is known \
                   exactly (solid), and if the width of its Type B distribution is doubled (outlined). The \
                   input with the largest effect is at the top";
    draw(rows, caption)
}

/// The change of half the length of the interval with every other shape, the largest first; `None`
/// where nothing moves.
pub(super) fn shapes(output: &OutputAudit, name: impl Fn(usize) -> String) -> Option<Drawing> {
    let mut shapes: Vec<Row> = output
        .inputs
        .iter()
        .flat_map(|input| input.alternatives.iter().map(move |other| (input, other)))
        .filter_map(|(input, other)| {
            let colour = match other.kept {
                Kept::StandardUncertainty => EVEN,
                Kept::Limits => AFTER,
            };
            let name = format!("{}: {}", name(input.variable), other.distribution.name());
            Some(Row { name, bars: vec![(seen(Some(&other.moved))?, colour)] })
        })
        .collect();
    largest_first(&mut shapes, |row| row.bars[0].0.abs());
    let caption = "Change of U, half the length of the coverage interval, if an input has another \
                   shape with the same limits (solid) or the same standard uncertainty (outlined), the \
                   largest first";
    draw(shapes, caption)
}

/// A change in per cent.
fn percent(of: Option<&VariantChange>) -> Option<f64> {
    of?.change.map(|change| 100.0 * change)
}

/// A change in per cent, if there is one to be seen.
fn seen(of: Option<&VariantChange>) -> Option<f64> {
    percent(of.filter(|of| of.is_seen()))
}

/// Rows of bars about zero; the caption has no full stop.
fn draw(mut rows: Vec<Row>, caption: &str) -> Option<Drawing> {
    let all = rows.len();
    rows.truncate(MOST);
    let changes = || rows.iter().flat_map(|row| row.bars.iter().map(|bar| bar.0));
    let [least, most] =
        changes().fold([0.0_f64, 0.0_f64], |[a, b], change| [a.min(change), b.max(change)]);
    if least == most {
        return None;
    }
    // for the values beside the bars
    let texts = rows.iter().flat_map(|row| values(&row.bars));
    let room = texts.fold([MARGIN; 2], |[left, right], (change, text)| {
        let space = WIDER * length(&text, FONT - 1.0) + 2.0 * MARGIN;
        if change < 0.0 { [left.max(space), right] } else { [left, right.max(space)] }
    });
    let bottom = 4.0 + ROW * rows.len() as f64;
    let longest = rows.iter().map(|row| WIDER * length(&row.name, FONT)).fold(0.0, f64::max);
    let drawn = |width: f64| {
        let sides = [longest.min(LEFT) + 16.0, RIGHT];
        let axis = axis_of_bars([least, most], (width, sides), room);
        let strip = Strip::within(&axis, width, sides);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, LABEL)?;
            for (place, row) in rows.iter().enumerate() {
                let y = 4.0 + ROW * (place as f64 + 0.5);
                strip.name(area, &row.name, y)?;
                for &(change, colour) in &row.bars {
                    strip.bar(area, [0.0, change], y, (BAR, colour))?;
                }
                for (change, text) in values(&row.bars) {
                    match change < 0.0 {
                        true => strip.before(area, &text, change, y)?,
                        false => strip.beside(area, &text, change, y)?,
                    }
                }
            }
            line(area, [(strip.x(0.0), 0.0), (strip.x(0.0), bottom)], stroke(INK, 1.0))
        })
    };
    let left_out = match all - rows.len() {
        0 => String::new(),
        count => format!("; {count} smaller ones are left out"),
    };
    Some(Drawing::new(format!("{caption}{left_out}."), drawn))
}

/// The values beside the bars: on each side that of the longest bar.
fn values(bars: &[(f64, RGBColor)]) -> Vec<(f64, String)> {
    let changes = || bars.iter().map(|bar| bar.0);
    let ends = [changes().fold(0.0, f64::min), changes().fold(0.0, f64::max)];
    let sign = |change: f64| if change > 0.0 { "+" } else { "" };
    let text = |change: f64| format!("{}{} %", sign(change), rounded(change, -1));
    ends.into_iter().filter(|end| *end != 0.0).map(|end| (end, text(end))).collect()
}
