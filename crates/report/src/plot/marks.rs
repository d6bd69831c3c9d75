//! Marks of points that differ in shape, so that groups can be distinguished without colours.

use plotters::element::{Circle, EmptyElement, PathElement, Polygon};
use plotters::style::{Color, RGBColor};

use super::{Chart, Drawn, px, stroke};

/// Whether a mark is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fill {
    Full,
    Open,
}

/// Draws the mark of a group at a position; `size` is half of its width in pixels.
pub(crate) fn mark(
    chart: &Chart<'_>,
    group: usize,
    place: (f64, f64),
    size: f64,
    (colour, fill): (RGBColor, Fill),
) -> Drawn {
    let area = chart.plotting_area();
    let s = px(size);
    let corners: Vec<(i32, i32)> = match group {
        0 => {
            let style = if fill == Fill::Full { colour.filled() } else { stroke(colour, 1.25) };
            return area.draw(&Circle::new(place, s, style));
        }
        1 => vec![(-s, -s), (s, -s), (s, s), (-s, s)],
        2 => vec![(0, -s - s / 4), (s + s / 8, s), (-s - s / 8, s)],
        3 => vec![(0, -s - s / 3), (s + s / 3, 0), (0, s + s / 3), (-s - s / 3, 0)],
        _ => {
            let style = stroke(colour, if fill == Fill::Full { 2.0 } else { 1.0 });
            let one = PathElement::new(vec![(-s, -s), (s, s)], style);
            let other = PathElement::new(vec![(-s, s), (s, -s)], style);
            return area.draw(&(EmptyElement::at(place) + one + other));
        }
    };
    if fill == Fill::Full {
        return area.draw(&(EmptyElement::at(place) + Polygon::new(corners, colour.filled())));
    }
    let closed: Vec<(i32, i32)> = corners.iter().chain(corners.first()).copied().collect();
    area.draw(&(EmptyElement::at(place) + PathElement::new(closed, stroke(colour, 1.25))))
}
