//! The confusion matrix as a heat map.

use plotters::element::{PathElement, Rectangle};
use plotters::style::Color;

use super::super::html::Drawing;
use super::confusion::Confused;
use crate::plot::{
    Anchor, Area, Drawn, FONT, INK, SHADES, Write, centred, px, shortened, stroke, svg, write,
};
use gumption_gap::check::BlindCheckScores;

/// Space for the names on the left, the sums on the right and the numbers above, in pixels.
const LEFT: f64 = 230.0;
const RIGHT: f64 = 60.0;
const TOP: f64 = 44.0;
const BELOW: f64 = 6.0;

/// Height of a row and the greatest width of a column.
const ROW: f64 = 24.0;
const COLUMN: f64 = 48.0;

/// Shares of a row at which the shade changes; nothing has the lightest one.
const STEPS: [f64; 4] = [f64::MIN_POSITIVE, 0.1, 0.4, 0.8];

/// Truths in rows, verdicts in columns; `None` without draws.
pub(super) fn draw(report: &BlindCheckScores) -> Option<Drawing> {
    let confused = Confused::new(report);
    let size = confused.labels.len();
    if size == 0 {
        return None;
    }
    let drawn = |wide: f64| {
        let left = LEFT.min(0.4 * wide);
        let width = COLUMN.min((wide - left - RIGHT) / size as f64);
        svg(wide, TOP + ROW * size as f64 + BELOW, |area| {
            let middle = left + 0.5 * width * size as f64;
            write(area, "verdict", centred((middle.max(left + 30.0), 10.0), FONT))?;
            let beside = |x: f64, y: f64, anchor| Write { anchor, ..centred((x, y), FONT) };
            write(area, "truth", beside(left - 8.0, TOP - 14.0, Anchor::End))?;
            let sums = left + width * size as f64 + 8.0;
            write(area, "draws", beside(sums, TOP - 14.0, Anchor::Start))?;
            for (place, label) in confused.labels.iter().enumerate() {
                let number = place + 1;
                let x = left + width * (place as f64 + 0.5);
                let y = TOP + ROW * (place as f64 + 0.5);
                let text_size = (FONT - 1.0).min(0.55 * width);
                write(area, &number.to_string(), centred((x, TOP - 14.0), text_size))?;
                let name = shortened(&label.name(), left - 44.0, FONT);
                write(area, &name, beside(left - 34.0, y, Anchor::End))?;
                write(area, &number.to_string(), beside(left - 8.0, y, Anchor::End))?;
                let row = &confused.counts[place];
                let sum: usize = row.iter().sum();
                write(area, &sum.to_string(), beside(sums, y, Anchor::Start))?;
                for (column, &count) in row.iter().enumerate() {
                    let corner = (left + width * column as f64, TOP + ROW * place as f64);
                    cell(area, corner, width, [count, sum])?;
                }
            }
            (0..size).try_for_each(|place| {
                frame(area, (left + width * place as f64, TOP + ROW * place as f64), width)
            })
        })
    };
    Some(Drawing::new(caption(&confused), drawn))
}

/// A cell with its count, darker with its share of the row.
fn cell(area: &Area<'_>, (x, y): (f64, f64), width: f64, [count, sum]: [usize; 2]) -> Drawn {
    let share = count as f64 / sum.max(1) as f64;
    let (fill, colour) = SHADES[STEPS.iter().take_while(|step| share >= **step).count()];
    let inset = 0.5;
    let corners = [(px(x + inset), px(y + inset)), (px(x + width - inset), px(y + ROW - inset))];
    area.draw(&Rectangle::new(corners, fill.filled()))?;
    if count == 0 {
        return Ok(());
    }
    let text = count.to_string();
    let size = (FONT - 1.0).min(1.5 * width / text.len() as f64);
    let how = centred((x + 0.5 * width, y + 0.5 * ROW), size);
    write(area, &text, Write { colour, ..how })
}

/// A frame about a cell of the diagonal.
fn frame(area: &Area<'_>, (x, y): (f64, f64), width: f64) -> Drawn {
    let corners =
        [(x, y), (x + width, y), (x + width, y + ROW), (x, y + ROW), (x, y), (x + width, y)];
    let places = corners.map(|(x, y)| (px(x), px(y))).to_vec();
    area.draw(&PathElement::new(places, stroke(INK, 1.25)))
}

fn caption(confused: &Confused) -> String {
    let mut caption =
        "Truths (rows) and verdicts (columns, with the numbers of the rows): number of draws, \
                       darker for a larger share of the row. Frames: the verdict is the truth; in \
                       the row \"unexplained\" the effect was removed from the list."
            .to_owned();
    if confused.as_good > 0 {
        caption += &format!(
            " Outside the frame of that row, {} verdicts count as right because they predict within \
             the uncertainties.",
            confused.as_good
        );
    }
    if confused.together {
        let [all, same] = confused.several;
        caption += &format!(
            " Several effects are taken together: of the {all} verdicts in their frame, {same} \
             name exactly the true ones."
        );
    }
    caption
}
