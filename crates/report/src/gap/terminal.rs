//! Plots of the residuals in a terminal, without colours.

use super::residuals::{self, Residual};
use super::words;
use crate::number::exact;
use crate::plot::{Axis, CharacterGrid, cell_at};
use crate::table::text_width;
use crate::wrapped;
use gumption_gap::Diagnosis;

/// Columns left of the plot, and on both sides of it together.
const LEFT: usize = 8;
const BESIDE: usize = 14;

/// Rows of the plot.
const HEIGHT: usize = 13;

/// Characters of residuals before and after the correction, and of both in one place.
const BEFORE: char = 'x';
const AFTER: char = 'o';
const BOTH: char = '*';

/// Larger normalized residuals than this are drawn on a scale that grows more slowly.
const LINEAR: f64 = 12.0;

/// Half-width of the band in standard uncertainties.
const BAND: f64 = 2.0;

/// Columns of a plot.
fn columns() -> usize {
    text_width().saturating_sub(BESIDE)
}

/// The residuals of an output over their standard uncertainties before and after against the condition
/// with most levels.
pub(super) fn residuals(diagnosis: &Diagnosis, output: usize) -> Option<String> {
    let over = residuals::finest(diagnosis);
    let along = over.in_sentence(diagnosis);
    let residuals = residuals::of(diagnosis, output, over);
    if residuals.is_empty() {
        return None;
    }
    let name = crate::plain(&diagnosis.outputs.get(output)?.name);
    let scale = Scale::over(&residuals);
    let compressed = if scale.linear { "" } else { "; compressed far from zero" };
    let title = format!(
        "{name}: residual / u against {along}; {BEFORE} before, {AFTER} after, {BOTH} both, \
         ┄ ±{BAND}{compressed}"
    );
    Some(wrapped(&title) + &plot(&residuals, scale))
}

/// Characters of what was measured, of the sim and of the corrected sim.
const MEASURED: char = 'o';
const SIM: char = '-';
const CORRECTED: char = '+';

/// What was measured of an output, the sim and the corrected sim against the condition with most levels.
pub(super) fn overlay(diagnosis: &Diagnosis, output: usize) -> Option<String> {
    let over = residuals::finest(diagnosis);
    let points = residuals::overlaid(diagnosis, output, over);
    let values = points.iter().flat_map(|(_, values)| *values);
    let [low, high] =
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
    if high.partial_cmp(&low) != Some(std::cmp::Ordering::Greater) {
        return None;
    }
    let title = format!(
        "{} against {}; {MEASURED} measured, {SIM} sim, {CORRECTED} corrected sim, {BOTH} several in \
         one place",
        words::axis(diagnosis.outputs.get(output)?),
        over.in_sentence(diagnosis)
    );
    Some(wrapped(&title) + &overlaid(&points, [low, high]))
}

fn overlaid(points: &[(f64, [f64; 3])], [low, high]: [f64; 2]) -> String {
    let axis = Axis::over(points.iter().map(|(x, _)| *x));
    let mut grid = CharacterGrid::new(LEFT + columns(), HEIGHT + 2);
    let margin = 0.02 * (high - low);
    let row = |value: f64| cell_at((high + margin - value) / (high - low + 2.0 * margin), HEIGHT);
    for (place, marker) in [SIM, CORRECTED, MEASURED].into_iter().enumerate() {
        // as in the points: measured, sim, corrected
        let place = [1, 2, 0][place];
        for (x, values) in points {
            let cell = column(&axis, axis.position(*x)).zip(row(values[place]));
            let Some((column, row)) = cell else { continue };
            if let Some(cell) = grid.cell(column, row) {
                *cell = if *cell == ' ' || *cell == marker { marker } else { BOTH };
            }
        }
    }
    frame(&mut grid);
    let values = Axis::linear(low - margin, high + margin);
    for (value, text) in values.marks(5) {
        let Some(row) = row(value) else { continue };
        let width = LEFT - 2;
        if text.chars().count() <= width {
            grid.write(0, row, &format!("{text:>width$} ┤"));
        }
    }
    mark_levels(&mut grid, &axis);
    grid.lines()
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

    /// The row of the plot in which a value stands; `None` beyond its ends.
    fn row(self, value: f64) -> Option<usize> {
        let end = self.position(self.end);
        cell_at((end - self.position(value)) / (2.0 * end), HEIGHT)
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
    let mut grid = CharacterGrid::new(LEFT + columns(), HEIGHT + 2);
    for row in [BAND, -BAND].into_iter().filter_map(|level| scale.row(level)) {
        grid.write(LEFT, row, &"┄".repeat(columns()));
    }
    for (marker, other, of) in [
        (BEFORE, AFTER, (|r| z(r.before)) as fn(&Residual) -> f64),
        (AFTER, BEFORE, |r| z(r.after)),
    ] {
        let cells = residuals
            .iter()
            .filter_map(|r| Some((column(&axis, axis.position(r.x))?, scale.row(of(r))?)));
        for (column, row) in cells {
            if let Some(cell) = grid.cell(column, row) {
                *cell = if [other, BOTH].contains(cell) { BOTH } else { marker };
            }
        }
    }
    frame(&mut grid);
    mark_values(&mut grid, scale);
    mark_levels(&mut grid, &axis);
    grid.lines()
}

/// The column in which a position of the axis stands; `None` beyond its ends.
fn column(axis: &Axis, position: f64) -> Option<usize> {
    let [left, right] = axis.ends();
    cell_at((position - left) / (right - left), columns()).map(|column| LEFT + column)
}

/// The axes.
fn frame(grid: &mut CharacterGrid) {
    for row in 0..HEIGHT {
        grid.put(LEFT - 1, row, '│');
    }
    grid.put(LEFT - 1, HEIGHT, '└');
    grid.write(LEFT, HEIGHT, &"─".repeat(columns()));
}

/// Marks on the vertical axis, as many as do not crowd each other.
fn mark_values(grid: &mut CharacterGrid, scale: Scale) {
    let mut taken: Vec<usize> = Vec::new();
    for value in scale.candidates() {
        let Some(row) = scale.row(value) else { continue };
        if taken.iter().any(|other| other.abs_diff(row) < 2) {
            continue;
        }
        taken.push(row);
        let text = exact(value);
        let width = LEFT - 2;
        grid.write(0, row, &format!("{text:>width$} ┤"));
    }
}

/// Marks on the horizontal axis.
fn mark_levels(grid: &mut CharacterGrid, axis: &Axis) {
    let mut free = 0;
    for (position, text) in axis.marks(9) {
        let Some(column) = column(axis, position) else { continue };
        let width = text.chars().count();
        let from = column.saturating_sub(width / 2);
        if from < free || from + width > LEFT + columns() {
            continue;
        }
        free = from + width + 1;
        grid.put(column, HEIGHT, '┬');
        grid.write(from, HEIGHT + 1, &text);
    }
}
