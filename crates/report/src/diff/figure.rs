//! From the U of one file to that of another, change by change.

use gumption_analysis::diff::OutputDifference;
use gumption_engine::number::largest_first;
use plotters::style::RGBColor;

use super::{cause, unit_of};
use crate::html::Drawing;
use crate::number::{position, significant, to};
use crate::plain;
use crate::plot::{
    AFTER, BEFORE, EVEN, FAINT, FONT, INK, STRIP_AXIS, Strip, WIDER, axis_of_bars, length, line,
    stroke, svg,
};

/// Heights of a row and of its bar in pixels, and the largest space for the names.
const ROW: f64 = 24.0;
const BAR: f64 = 15.0;
const LEFT: f64 = 220.0;
const RIGHT: f64 = 14.0;

/// Maximum number of changes with a row of their own.
const MOST: usize = 16;

/// A bar between two values of U, with a text at its end.
struct Step {
    name: String,
    ends: [f64; 2],
    text: String,
    colour: RGBColor,
}

/// U in the first file, the part of every change in descending order, and U in the second file;
/// `None` where nothing changed, or the change cannot be shared out.
pub(super) fn waterfall(output: &OutputDifference) -> Option<Drawing> {
    let [Some(before), Some(after)] = output.expanded else { return None };
    let parts = output.parts.iter().filter(|part| part.is_changed() && part.change != Some(0.0));
    let parts = parts.map(|part| Some((plain(cause(part)), part.change?)));
    let mut parts = parts.collect::<Option<Vec<(String, f64)>>>()?;
    if parts.is_empty() || before == after {
        return None;
    }
    largest_first(&mut parts, |part| part.1.abs());
    if parts.len() > MOST {
        let others = parts.split_off(MOST - 1);
        let sum = others.iter().map(|part| part.1).sum();
        parts.push((format!("{} smaller changes", others.len()), sum));
    }
    let place = position(parts[0].1, 3);
    let total = |name: &str, value: f64| Step {
        name: name.to_owned(),
        ends: [0.0, value],
        text: significant(value, 3),
        colour: EVEN,
    };
    let mut steps = vec![total("U before", before)];
    let mut reached = before;
    for (name, change) in parts {
        let next = reached + change;
        let (sign, colour) = if change > 0.0 { ("+", BEFORE) } else { ("", AFTER) };
        let text = format!("{sign}{}", to(change, place));
        steps.push(Step { name, ends: [reached, next], text, colour });
        reached = next;
    }
    steps.push(total("U after", after));
    let most = steps.iter().flat_map(|step| step.ends).fold(0.0, f64::max);
    let least = steps.iter().flat_map(|step| step.ends).fold(0.0, f64::min);
    let texts = steps.iter().map(|step| WIDER * length(&step.text, FONT - 1.0) + 14.0);
    let room = texts.fold(0.0, f64::max);
    let longest = steps.iter().map(|step| WIDER * length(&step.name, FONT)).fold(0.0, f64::max);
    let bottom = 4.0 + ROW * steps.len() as f64;
    let drawn = |width: f64| {
        let label = match unit_of(output).as_str() {
            "" => format!("U({})", plain(&output.name)),
            unit => format!("U({}) in {unit}", plain(&output.name)),
        };
        let sides = [longest.min(LEFT) + 16.0, RIGHT];
        let axis = axis_of_bars([least, most], (width, sides), [0.0, room]);
        let strip = Strip::within(&axis, width, sides);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, &label)?;
            let middle = |row: usize| 4.0 + ROW * (row as f64 + 0.5);
            for (row, step) in steps.iter().enumerate() {
                let y = middle(row);
                strip.name(area, &step.name, y)?;
                strip.bar(area, step.ends, y, (BAR, step.colour))?;
                strip.beside(area, &step.text, step.ends[0].max(step.ends[1]), y)?;
                if row + 1 < steps.len() {
                    let x = strip.x(step.ends[1]);
                    let joint = [(x, y + 0.5 * BAR), (x, middle(row + 1) - 0.5 * BAR)];
                    line(area, joint, stroke(INK, 0.75))?;
                }
            }
            line(area, [(strip.x(0.0), 0.0), (strip.x(0.0), bottom)], stroke(FAINT, 1.0))
        })
    };
    let caption =
        "U by the law of propagation in the first file and in the second one (outlined), and between \
                   them the part of each change, the largest first: vermilion where U grows, blue where it falls."
            .to_owned();
    Some(Drawing::new(caption, drawn))
}
