//! Rows of marks above one horizontal axis: bars and intervals with their names on the left.

use plotters::element::{DashedPathElement, PathElement, Rectangle};
use plotters::style::{Color, RGBColor, ShapeStyle};

use super::axis::Axis;
use super::ink::{FAINT, INK, WEAK};
use super::svg::{Anchor, Area, Drawn, FONT, Write, length, px, shortened, write};

/// Height of the axis with its marks and label, in pixels.
pub(crate) const STRIP_AXIS: f64 = 40.0;

/// Maximum fraction of a figure's width for names and values beside a strip.
pub(crate) const CHROME: f64 = 0.54;

/// Minimum distance between two tick marks, in pixels.
const MARK_ROOM: f64 = 62.0;

/// The arrow to a limit beyond the axis: its length, half the height of its head, and the gaps
/// between it, its number and the line, in pixels.
const SHAFT: f64 = 12.0;
const HEAD: f64 = 4.0;
const APART: f64 = 3.0;

/// How much wider digits are than the usual letter.
pub(crate) const WIDER: f64 = 1.15;

/// A horizontal axis between two positions, in pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip<'a> {
    /// The axis.
    pub(crate) axis: &'a Axis,
    /// Where it begins and ends.
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl<'a> Strip<'a> {
    /// A strip in a figure with this width, with space for names on the left and for values on the
    /// right; both shrink if they would take more than a fraction of the width.
    pub(crate) fn within(axis: &'a Axis, width: f64, [left, right]: [f64; 2]) -> Self {
        let give = (CHROME * width / (left + right)).min(1.0);
        Self { axis, from: give * left, to: width - give * right }
    }

    /// The position of a value, in pixels; values beyond an end are at that end.
    pub(crate) fn x(&self, value: f64) -> f64 {
        let [first, last] = self.axis.ends();
        let share = (self.axis.position(value) - first) / (last - first);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// Grid lines from the top to the axis, the axis, its marks and its label.
    pub(crate) fn draw(&self, area: &Area<'_>, top: f64, bottom: f64, label: &str) -> Drawn {
        let [first, last] = self.axis.ends();
        for (position, text) in self.axis.marks(marks_within(self.to - self.from).min(7)) {
            let x = self.from + (position - first) / (last - first) * (self.to - self.from);
            line(area, [(x, top), (x, bottom)], stroke(FAINT, 0.75))?;
            line(area, [(x, bottom), (x, bottom + 4.0)], stroke(WEAK, 0.75))?;
            write(area, &text, centred((x, bottom + 13.0), FONT - 1.0))?;
        }
        line(area, [(self.from, bottom), (self.to, bottom)], stroke(WEAK, 0.75))?;
        let middle = 0.5 * (self.from + self.to);
        // to the nearer edge of the figure on either side
        let width = f64::from(area.dim_in_pixel().0) / f64::from(px(1.0));
        let room = 2.0 * middle.min(width - middle);
        write(area, &shortened(label, room, FONT), centred((middle, bottom + 30.0), FONT))
    }

    /// A name on the left of a row.
    pub(crate) fn name(&self, area: &Area<'_>, name: &str, y: f64) -> Drawn {
        let room = self.from - 14.0;
        let at = (self.from - 8.0, y);
        let how = Write { anchor: Anchor::End, ..centred(at, FONT) };
        write(area, &shortened(name, room, FONT), how)
    }

    /// A text to the right of a value.
    pub(crate) fn beside(&self, area: &Area<'_>, text: &str, value: f64, y: f64) -> Drawn {
        let at = (self.x(value) + 7.0, y);
        write(area, text, Write { anchor: Anchor::Start, ..centred(at, FONT - 1.0) })
    }

    /// A text to the left of a value.
    pub(crate) fn before(&self, area: &Area<'_>, text: &str, value: f64, y: f64) -> Drawn {
        let at = (self.x(value) - 7.0, y);
        write(area, text, Write { anchor: Anchor::End, ..centred(at, FONT - 1.0) })
    }

    /// A bar from one value to another.
    pub(crate) fn bar(
        &self,
        area: &Area<'_>,
        ends: [f64; 2],
        y: f64,
        (height, colour): (f64, RGBColor),
    ) -> Drawn {
        let [from, to] = [ends[0].min(ends[1]), ends[0].max(ends[1])].map(|end| self.x(end));
        let corners = [(px(from), px(y - 0.5 * height)), (px(to), px(y + 0.5 * height))];
        area.draw(&Rectangle::new(corners, colour.filled()))
    }

    /// Whether a value lies on the axis.
    pub(crate) fn holds(&self, value: f64) -> bool {
        let [first, last] = self.axis.ends();
        (first..=last).contains(&self.axis.position(value))
    }

    /// An interval: a cap at each end on the axis, and for each finite end beyond it an arrow at
    /// the edge with its number.
    pub(crate) fn interval(
        &self,
        area: &Area<'_>,
        ends: [f64; 2],
        y: f64,
        (colour, number): (RGBColor, &dyn Fn(f64) -> String),
    ) -> Drawn {
        let style = stroke(colour, 1.75);
        let [first, _] = self.axis.ends();
        let below = |end: f64| self.axis.position(end) < first;
        let beyond = |end: &f64| end.is_finite() && !self.holds(*end);
        // both beyond one side: an arrow to each
        let of_edge = |left: bool| {
            let there = ends.iter().filter(|end| beyond(end) && below(**end) == left);
            there.map(|end| number(*end)).collect::<Vec<_>>().join(" … ")
        };
        let texts = [of_edge(true), of_edge(false)];
        let [mut from, mut to] = ends.map(|end| self.x(end));
        for (text, left) in texts.iter().zip([true, false]).filter(|(text, _)| !text.is_empty()) {
            let (edge, inwards) = if left { (self.from, 1.0) } else { (self.to, -1.0) };
            let shaft = edge + inwards * SHAFT;
            line(area, [(edge, y), (shaft, y)], style)?;
            for side in [-HEAD, HEAD] {
                line(area, [(edge, y), (edge + inwards * HEAD, y + side)], style)?;
            }
            let anchor = if left { Anchor::Start } else { Anchor::End };
            let at = (shaft + inwards * APART, y);
            write(area, text, Write { anchor, colour, ..centred(at, FONT - 1.0) })?;
            let behind = at.0 + inwards * (WIDER * length(text, FONT - 1.0) + APART);
            if left { from = from.max(behind) } else { to = to.min(behind) }
        }
        if from < to {
            line(area, [(from, y), (to, y)], style)?;
        }
        for end in ends.into_iter().filter(|end| end.is_finite() && self.holds(*end)) {
            let x = self.x(end);
            line(area, [(x, y - 4.0), (x, y + 4.0)], style)?;
        }
        Ok(())
    }
}

/// A linear axis for bars between two values, with space in pixels beyond each end, in a figure with
/// this width and space for names on the left ([`Strip::within`]).
pub(crate) fn axis_of_bars(
    [least, most]: [f64; 2],
    (width, [left, right]): (f64, [f64; 2]),
    room: [f64; 2],
) -> Axis {
    let give = (CHROME * width / (left + right)).min(1.0);
    let bars = (width - give * (left + right) - room[0] - room[1]).max(1.0);
    let unit = (most - least) / bars;
    Axis::linear(least - room[0] * unit, most + room[1] * unit)
}

/// The number of tick marks that fit on a length in pixels.
pub(crate) fn marks_within(length: f64) -> usize {
    ((length / MARK_ROOM) as usize).max(2)
}

/// Text centred at a position, in the text colour.
pub(crate) fn centred(at: (f64, f64), size: f64) -> Write {
    Write { at, anchor: Anchor::Middle, size, colour: INK, bold: false }
}

/// A line with a colour and a width in pixels.
pub(crate) fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width(px(width).unsigned_abs())
}

/// A line with a faded colour and a width in pixels.
pub(crate) fn faded(colour: RGBColor, share: f64, width: f64) -> ShapeStyle {
    colour.mix(share).stroke_width(px(width).unsigned_abs())
}

/// Lengths of the dashes and of the gaps of a dashed line, in pixels.
const DASH: f64 = 7.0;
const GAP: f64 = 4.0;

/// A dashed line through positions in the coordinates of an area.
pub(crate) fn dashed<X: Clone, Y: Clone>(
    places: Vec<(X, Y)>,
    style: ShapeStyle,
) -> DashedPathElement<std::vec::IntoIter<(X, Y)>, i32> {
    DashedPathElement::new(places, px(DASH), px(GAP), style)
}

/// A line through positions in pixels.
pub(crate) fn line<const N: usize>(
    area: &Area<'_>,
    places: [(f64, f64); N],
    style: ShapeStyle,
) -> Drawn {
    area.draw(&PathElement::new(places.map(|(x, y)| (px(x), px(y))).to_vec(), style))
}
