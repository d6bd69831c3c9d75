//! A panel of a figure: two axes with a grid between them.

use std::ops::Range;

use plotters::backend::SVGBackend;
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use super::ink::{FAINT, INK, WEAK};
use super::strip::marks_within;
use super::svg::{Area, Drawn, FONT, px, text_style};
use crate::printed::figure_text;

/// Space for the marks of an axis and its label, in pixels.
const BELOW: f64 = 42.0;
const LEFT: f64 = 60.0;

/// Minimum space on the right of the axis.
const RIGHT: f64 = 12.0;

/// The width of a digit, and the space beside the tick labels: the label of the axis and its
/// distance.
const DIGIT: f64 = 6.6;
const BESIDE: f64 = 26.0;

/// An axis in the form of the plotting library.
#[derive(Clone, Debug)]
pub(crate) struct Marked {
    ends: [f64; 2],
    marks: Vec<(f64, String)>,
}

impl Marked {
    fn new(axis: &Axis, most: usize) -> Self {
        let marks = axis.marks(most).into_iter().map(|(place, text)| (place, figure_text(&text)));
        Self { ends: axis.ends(), marks: marks.collect() }
    }

    /// How far the last number extends beyond the end of a horizontal axis of this length, in
    /// pixels.
    fn beyond(&self, length: f64) -> f64 {
        let [from, to] = self.ends;
        let Some((place, text)) = self.marks.last() else { return 0.0 };
        let free = (to - place) / (to - from) * length;
        0.5 * DIGIT * (text.chars().count() + 1) as f64 - free
    }
}

impl Ranged for Marked {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let [from, to] = self.ends;
        let share = ((value - from) / (to - from)).clamp(-0.5, 1.5);
        first + (share * f64::from(last - first)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            return Vec::new();
        }
        self.marks.iter().map(|(place, _)| *place).collect()
    }

    fn range(&self) -> Range<f64> {
        self.ends[0]..self.ends[1]
    }
}

impl ValueFormatter<f64> for Marked {
    fn format_ext(&self, value: &f64) -> String {
        let found = self.marks.iter().find(|(place, _)| place == value);
        found.map(|(_, text)| text.clone()).unwrap_or_default()
    }
}

/// A drawn panel; positions on it are values of the axes.
pub(crate) type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Marked, Marked>>;

/// A panel to be drawn.
#[derive(Clone, Debug)]
pub(crate) struct Panel<'a> {
    /// The horizontal axis and its label.
    pub(crate) x: (&'a Axis, String),
    /// The vertical axis and its label.
    pub(crate) y: (&'a Axis, String),
    /// The maximum number of tick marks of each axis.
    pub(crate) marks: [usize; 2],
    /// A line above it.
    pub(crate) title: String,
}

impl Panel<'_> {
    /// Draws axes and grid.
    pub(crate) fn draw<'a>(&self, area: &Area<'a>) -> Drawn<Chart<'a>> {
        let y = Marked::new(self.y.0, self.marks[1]);
        let [x_label, y_label] = [&self.x.1, &self.y.1].map(|label| figure_text(label));
        let longest = y.marks.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
        let left = LEFT.max(DIGIT * longest as f64 + BESIDE);
        let inner = f64::from(area.dim_in_pixel().0) / f64::from(px(1.0)) - left - 18.0;
        let x = Marked::new(self.x.0, self.marks[0].min(marks_within(inner)));
        let area = area.margin(px(8.0), 0, px(6.0), px(RIGHT.max(x.beyond(inner))));
        let area = if self.title.is_empty() { area } else { titled(&area, &self.title)? };
        let mut builder = ChartBuilder::on(&area);
        builder.x_label_area_size(px(BELOW)).y_label_area_size(px(left));
        let mut chart = builder.build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .axis_style(WEAK.stroke_width(px(0.75).unsigned_abs()))
            .bold_line_style(FAINT.stroke_width(px(0.75).unsigned_abs()))
            .label_style(text_style(FONT - 1.0, INK, false))
            .axis_desc_style(text_style(FONT, INK, false))
            .x_desc(x_label)
            .y_desc(y_label)
            .set_all_tick_mark_size(px(4.0))
            .draw()?;
        Ok(chart)
    }
}

/// Writes a title over an area and returns the area below it. The plotting library's own function
/// measures the text, for which it needs a document in a browser.
fn titled<'a>(area: &Area<'a>, title: &str) -> Drawn<Area<'a>> {
    let style = text_style(FONT, INK, true);
    // the library's size of an em
    let em = style.font.get_size() / 1.24 / 1.24;
    let height = em.round() as i32 + (0.24 * em).round() as i32;
    let space = (height / 2).min(5);
    let middle = area.dim_in_pixel().0.cast_signed() / 2;
    let centred = style.pos(Pos::new(HPos::Center, VPos::Top));
    area.draw_text(&figure_text(title), &centred, (middle, space))?;
    Ok(area.margin(2 * space + height, 0, 0, 0))
}
