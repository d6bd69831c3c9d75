//! What makes how much of the gap, taken out one after the other.

use plotters::element::Rectangle;
use plotters::style::Color;

use super::super::{digits, words};
use super::Drawing;
use crate::plot::{
    AFTER, Axis, BEFORE, EVEN, FONT, INK, STRIP_AXIS, Strip, WEAK, length, line, px, stroke, svg,
};
use gumption_gap::{Diagnosis, GapPart};

const ROW: f64 = 28.0;
const BAR: f64 = 16.0;

/// Space for the figures beside the bars, and what parts the names from them.
const RIGHT: f64 = 60.0;
const BEFORE_STRIP: f64 = 16.0;
const LEFT: f64 = 285.0;

/// A bar for the whole and one for each part, which begins where the one before ends; `None` without a gap.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis) -> Option<Drawing> {
    let shares = &diagnosis.shrinkage.shares;
    if shares.is_empty() {
        return None;
    }
    let mut rows = vec![("the whole gap".to_owned(), [0.0, 1.0], BEFORE.filled())];
    let mut left = 1.0;
    for of in shares {
        let colour = match of.what {
            GapPart::Effect(_) => AFTER.filled(),
            GapPart::Departure => EVEN.filled(),
            GapPart::Noise => WEAK.mix(0.45).filled(),
        };
        rows.push((words::part(&of.what), [left - of.share_of_gap, left], colour));
        left -= of.share_of_gap;
    }
    let ends = rows.iter().flat_map(|(_, ends, _)| *ends);
    let (least, most) = ends.fold((0.0, 1.0), |(a, b): (f64, f64), x| (a.min(x), b.max(x)));
    let axis = Axis::linear(least, most);
    let names = rows.iter().map(|(name, ..)| length(name, FONT)).fold(0.0, f64::max);
    let bottom = ROW * rows.len() as f64;
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT.min(names + BEFORE_STRIP), RIGHT]);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, "share of the mean square of the residuals")?;
            for (row, (name, [from, to], colour)) in rows.iter().enumerate() {
                let y = ROW * (row as f64 + 0.5);
                let [x, end] = [strip.x(*from), strip.x(*to)];
                let corners = [(px(x), px(y - 0.5 * BAR)), (px(end), px(y + 0.5 * BAR))];
                area.draw(&Rectangle::new(corners, *colour))?;
                // the next bar ends where this one begins
                if row > 0 && row + 1 < rows.len() {
                    line(area, [(x, y - 0.5 * BAR), (x, y + ROW - 0.5 * BAR)], stroke(INK, 1.0))?;
                }
                strip.name(area, name, y)?;
                strip.beside(area, &digits::percent_of(to - from), to.max(*from), y)?;
            }
            Ok(())
        })
    };
    let caption = "Parts of the gap: mean square of the residuals, in standard uncertainties with \
                   the inputs at their posterior estimates, and its decrease if each part is \
                   subtracted from the data, one after the other. All parts were fitted together.";
    Some(Drawing::new(caption.to_owned(), drawn))
}
