//! Plots of the residuals in a terminal, without colours.

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::{Color, Style};
use ratatui_core::symbols::Marker;
use ratatui_core::widgets::Widget;
use ratatui_widgets::canvas::{Canvas, Line, Points, Shape};

use super::residuals::{self, Over, Residual};
use super::words;
use crate::number::exact;
use crate::plot::Axis;
use crate::wrapped;
use gumption_gap::Diagnosis;

/// Columns left of the plot, of the plot, and its rows.
const LEFT: u16 = 8;
const WIDTH: u16 = 86;
const HEIGHT: u16 = 13;

/// Characters of residuals before and after the correction, and of both in one place.
const BEFORE: char = 'x';
const AFTER: char = 'o';
const BOTH: char = '*';

/// Larger normalized residuals than this are drawn on a scale that grows more slowly.
const LINEAR: f64 = 12.0;

/// Half-width of the band in standard uncertainties.
const BAND: f64 = 2.0;

/// A plot for each output: residuals over their standard uncertainties before and after against the
/// condition with most levels.
pub(super) fn plots(diagnosis: &Diagnosis) -> Vec<String> {
    let over = residuals::finest(diagnosis);
    let along = match over {
        Over::Condition(place) => diagnosis.conditions.get(place).map(words::axis),
        Over::Row => None,
    };
    let along = along.unwrap_or_else(|| "the number of the row".to_owned());
    let outputs = diagnosis.outputs.iter().enumerate();
    outputs
        .filter_map(|(output, named)| {
            let residuals = residuals::of(diagnosis, output, over);
            if residuals.is_empty() {
                return None;
            }
            let name = crate::plain(&named.name);
            let scale = Scale::over(&residuals);
            let compressed = if scale.linear { "" } else { "; compressed far from zero" };
            let title = format!(
                "{name}: residual / u against {along}; {BEFORE} before, \
                 {AFTER} after, {BOTH} both, ┄ ±{BAND}{compressed}"
            );
            Some(wrapped(&title) + &plot(&residuals, scale))
        })
        .collect()
}

/// The vertical scale: linear, or by the inverse hyperbolic sine where residuals are large.
#[derive(Clone, Copy, Debug)]
struct Scale {
    linear: bool,
    end: f64,
}

impl Scale {
    fn over(residuals: &[Residual]) -> Self {
        let values = residuals.iter().flat_map(|r| [z(r.before), z(r.after)]);
        let end = 1.05 * values.map(f64::abs).fold(1.5 * BAND, f64::max);
        Self { linear: end <= LINEAR, end }
    }

    fn position(self, value: f64) -> f64 {
        if self.linear { value } else { libm::asinh(value) }
    }

    /// The row of the plot in which a value stands.
    fn row(self, value: f64) -> u16 {
        let end = self.position(self.end);
        let share = (end - self.position(value)) / (2.0 * end);
        (share * f64::from(HEIGHT - 1)).round() as u16
    }

    /// Values to mark, the most important ones first.
    fn candidates(self) -> Vec<f64> {
        let decades = (0..300).flat_map(|power| [1.0, 5.0].map(|d| d * 10_f64.powi(power)));
        let beyond: Vec<f64> = decades.take_while(|value| *value <= self.end).collect();
        let signed = beyond.into_iter().rev().flat_map(|value| [value, -value]);
        [0.0, BAND, -BAND].into_iter().chain(signed).collect()
    }
}

/// A residual over its standard uncertainty.
fn z((residual, u): (f64, f64)) -> f64 {
    if u > 0.0 { residual / u } else { 0.0 }
}

fn plot(residuals: &[Residual], scale: Scale) -> String {
    let axis = Axis::over(residuals.iter().map(|residual| residual.x));
    let points = |of: &dyn Fn(&Residual) -> f64| -> Vec<(f64, f64)> {
        let place = |r: &Residual| (axis.position(r.x), scale.position(of(r)));
        residuals.iter().map(place).collect()
    };
    let clouds = [points(&|r| z(r.before)), points(&|r| z(r.after))];
    let bounds = [axis.ends(), [-scale.position(scale.end), scale.position(scale.end)]];
    let mut buffer = Buffer::empty(Rect::new(0, 0, LEFT + WIDTH, HEIGHT + 2));
    let level = |value: f64| {
        let y = scale.position(value);
        let [x1, x2] = bounds[0];
        Line { x1, y1: y, x2, y2: y, color: Color::Reset }
    };
    draw(&mut buffer, bounds, '┄', &[level(BAND), level(-BAND)]);
    let clouds = clouds.each_ref().map(|coords| Points { coords, color: Color::Reset });
    let [before, after] = [(BEFORE, &clouds[0]), (AFTER, &clouds[1])].map(|(marker, cloud)| {
        let mut drawn = Buffer::empty(buffer.area);
        draw(&mut drawn, bounds, marker, std::slice::from_ref(cloud));
        drawn
    });
    overlay(&mut buffer, &before, &after);
    frame(&mut buffer);
    mark_values(&mut buffer, scale);
    mark_levels(&mut buffer, &axis);
    lines(&buffer)
}

/// Draws shapes with one character where the plot is.
fn draw<S: Shape>(buffer: &mut Buffer, bounds: [[f64; 2]; 2], marker: char, shapes: &[S]) {
    let canvas = Canvas::default()
        .marker(Marker::Custom(marker))
        .x_bounds(bounds[0])
        .y_bounds(bounds[1])
        .paint(|context| shapes.iter().for_each(|shape| context.draw(shape)));
    canvas.render(Rect::new(LEFT, 0, WIDTH, HEIGHT), buffer);
}

/// Lays the residuals before and after over what is drawn.
fn overlay(buffer: &mut Buffer, before: &Buffer, after: &Buffer) {
    let both = before.content().iter().zip(after.content());
    for (cell, (before, after)) in buffer.content.iter_mut().zip(both) {
        match (before.symbol() != " ", after.symbol() != " ") {
            (true, true) => drop(cell.set_char(BOTH)),
            (true, false) => drop(cell.set_symbol(before.symbol())),
            (false, true) => drop(cell.set_symbol(after.symbol())),
            (false, false) => {}
        }
    }
}

/// The axes.
fn frame(buffer: &mut Buffer) {
    for row in 0..HEIGHT {
        buffer.set_string(LEFT - 1, row, "│", Style::new());
    }
    buffer.set_string(LEFT - 1, HEIGHT, "└", Style::new());
    buffer.set_string(LEFT, HEIGHT, "─".repeat(usize::from(WIDTH)), Style::new());
}

/// Marks on the vertical axis, as many as do not crowd each other.
fn mark_values(buffer: &mut Buffer, scale: Scale) {
    let mut taken: Vec<u16> = Vec::new();
    for value in scale.candidates() {
        let row = scale.row(value);
        if row >= HEIGHT || taken.iter().any(|other| other.abs_diff(row) < 2) {
            continue;
        }
        taken.push(row);
        let text = exact(value);
        let width = usize::from(LEFT) - 2;
        buffer.set_string(0, row, format!("{text:>width$} ┤"), Style::new());
    }
}

/// Marks on the horizontal axis.
fn mark_levels(buffer: &mut Buffer, axis: &Axis) {
    let [left, right] = axis.ends();
    let mut free = 0;
    for (position, text) in axis.marks(9) {
        let share = (position - left) / (right - left);
        let column = LEFT + (share * f64::from(WIDTH - 1)).round() as u16;
        let width = text.chars().count() as u16;
        let from = column.saturating_sub(width / 2);
        if from < free || from + width > LEFT + WIDTH {
            continue;
        }
        free = from + width + 1;
        buffer.set_string(column, HEIGHT, "┬", Style::new());
        buffer.set_string(from, HEIGHT + 1, &text, Style::new());
    }
}

fn lines(buffer: &Buffer) -> String {
    let width = usize::from(buffer.area.width);
    let rows = buffer.content().chunks(width);
    rows.map(|cells| {
        let line: String = cells.iter().map(ratatui_core::buffer::Cell::symbol).collect();
        line.trim_end().to_owned() + "\n"
    })
    .collect()
}
