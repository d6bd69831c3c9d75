//! Input distributions, as small pictures.

use plotters::element::Polygon;
use plotters::style::Color;

use super::curve;
use crate::html::Drawing;
use crate::number::with_uncertainty;
use crate::plain;
use crate::plot::{EVEN, INK, WEAK, centred, line, px, shortened, stroke, svg, write};
use crate::plot::{FONT, Write};
use crate::table::in_unit;
use gumption_engine::distribution::Distribution;
use gumption_engine::task::Task;

/// Width of a picture in pixels, and how many there are at most.
const WIDE: f64 = 180.0;
const MOST: usize = 32;

/// Height of a picture with its words, and of the density in it, in pixels.
const ROW: f64 = 118.0;
const TALL: f64 = 56.0;

/// Free space on both sides of a density.
const SIDE: f64 = 12.0;

/// Steps of a density.
const STEPS: usize = 64;

/// Probabilities at which a distribution is looked at.
const PROBABILITIES: usize = 4000;

/// A picture of the distribution of each variable that varies, in the first row of conditions;
/// `None` where none does.
pub(in crate::evaluation) fn inputs(task: &Task) -> Option<Drawing> {
    let row = task.rows.first()?;
    let all: Vec<(String, String, &Distribution)> = task
        .variables
        .iter()
        .zip(row.distributions.iter())
        .filter(|(variable, distribution)| {
            variable.shown && distribution.standard_uncertainty() > 0.0
        })
        .map(|(variable, distribution)| {
            let (estimate, u) =
                with_uncertainty(distribution.mean(), distribution.standard_uncertainty(), 2);
            let figures = in_unit(&format!("{estimate}, u = {u}"), &variable.unit);
            (plain(&variable.name), figures, distribution.as_ref())
        })
        .collect();
    if all.is_empty() {
        return None;
    }
    let shown = all.get(..MOST).unwrap_or(&all);
    let drawn = |width: f64| {
        let columns = ((width / WIDE) as usize).max(1);
        let wide = width / columns as f64;
        let rows = shown.len().div_ceil(columns);
        svg(width, ROW * rows as f64, |area| {
            for (number, (name, figures, distribution)) in shown.iter().enumerate() {
                let left = wide * (number % columns) as f64;
                let top = ROW * (number / columns) as f64;
                let middle = left + 0.5 * wide;
                let room = wide - 6.0;
                let name = shortened(name, room, FONT);
                write(area, &name, Write { bold: true, ..centred((middle, top + 10.0), FONT) })?;
                let base = top + 22.0 + TALL;
                let [from, to] = [left + SIDE, left + wide - SIDE];
                let outline = outline(distribution, PROBABILITIES);
                let places: Vec<(f64, f64)> = outline
                    .iter()
                    .map(|(x, y)| (from + x * (to - from), base - y * TALL))
                    .collect();
                let area_below: Vec<(i32, i32)> =
                    places.iter().map(|&(x, y)| (px(x), px(y))).collect();
                area.draw(&Polygon::new(area_below, EVEN.filled()))?;
                curve(area, &places, stroke(INK, 1.25))?;
                line(area, [(from, base), (to, base)], stroke(WEAK, 0.75))?;
                let small = FONT - 2.0;
                let shape = shortened(distribution.name(), room, small);
                write(area, &shape, centred((middle, base + 11.0), small))?;
                let figures = shortened(figures, room, small);
                write(area, &figures, centred((middle, base + 25.0), small))?;
            }
            Ok(())
        })
    };
    let mut caption =
        "The distributions that trials are drawn from, each over the range of nearly all of its \
         probability, with estimate and standard uncertainty u"
            .to_owned();
    if task.rows.len() > 1 {
        caption.push_str("; in the first row of conditions");
    }
    if all.len() > shown.len() {
        caption.push_str(&format!("; {} more are left out", all.len() - shown.len()));
    }
    caption.push('.');
    Some(Drawing::new(caption, drawn))
}

/// Probabilities behind a picture that is drawn again at every key.
const FEW_PROBABILITIES: usize = 600;

/// The density of a distribution alone, as a picture that stands in a line of a table.
pub(in crate::evaluation) fn picture(distribution: &Distribution) -> String {
    let (width, height) = (72.0, 26.0);
    let outline = outline(distribution, FEW_PROBABILITIES);
    let base = height - 2.0;
    svg(width, height, |area| {
        let place = |(x, y): &(f64, f64)| (2.0 + x * (width - 4.0), base - y * (height - 6.0));
        let places: Vec<(f64, f64)> = outline.iter().map(place).collect();
        let below: Vec<(i32, i32)> = places.iter().map(|&(x, y)| (px(x), px(y))).collect();
        area.draw(&Polygon::new(below, EVEN.filled()))?;
        curve(area, &places, stroke(INK, 1.0))?;
        line(area, [(2.0, base), (width - 2.0, base)], stroke(WEAK, 0.75))
    })
}

/// The density of a distribution as places in a square, from its quantiles. Beyond the range of the
/// quantiles it is zero.
fn outline(distribution: &Distribution, probabilities: usize) -> Vec<(f64, f64)> {
    let probability = |k: usize| (k as f64 + 0.5) / probabilities as f64;
    let quantiles: Vec<f64> =
        (0..probabilities).map(|k| distribution.quantile(probability(k))).collect();
    let tail = probabilities / 500;
    let (first, last) = (quantiles[tail], quantiles[probabilities - 1 - tail]);
    let room = 0.12 * (last - first);
    let (low, high) = (first - room, last + room);
    let width = (high - low) / STEPS as f64;
    if !(width.is_finite() && width > 0.0) {
        return Vec::new();
    }
    // between two quantiles the distribution function is taken as straight
    let below = |x: f64| {
        let place = quantiles.partition_point(|q| *q <= x);
        let (Some(lower), Some(upper)) = (place.checked_sub(1), quantiles.get(place)) else {
            return place as f64;
        };
        let share = (x - quantiles[lower]) / (upper - quantiles[lower]);
        place as f64 + if share.is_finite() { share } else { 0.0 }
    };
    let counts: Vec<f64> = (0..STEPS)
        .map(|step| {
            let from = low + step as f64 * width;
            below(from + width) - below(from)
        })
        .collect();
    let highest = counts.iter().copied().fold(1.0, f64::max);
    let mut places = vec![(0.0, 0.0)];
    for (step, count) in counts.iter().enumerate() {
        let height = count / highest;
        let edges = [step, step + 1].map(|edge| edge as f64 / STEPS as f64);
        places.extend(edges.map(|x| (x, height)));
    }
    places.push((1.0, 0.0));
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::distribution::{Normal, Rectangular};

    /// The density of a rectangular distribution is the same in every bin inside its limits, and that
    /// of a normal one symmetric, up to rounding and the ends of the table of quantiles.
    #[test]
    fn outlines_have_the_shape() {
        let rectangular = outline(&Rectangular::new(-1.0, 1.0).unwrap().into(), PROBABILITIES);
        let heights: Vec<f64> = rectangular.iter().map(|place| place.1).collect();
        let flat = heights.iter().filter(|height| **height > 0.99).count();
        assert!(flat > 98, "{heights:?}");
        let normal = outline(&Normal::new(5.0, 2.0).unwrap().into(), PROBABILITIES);
        let heights: Vec<f64> = normal.iter().map(|place| place.1).collect();
        let mirrored: Vec<f64> = heights.iter().rev().copied().collect();
        let apart = heights.iter().zip(&mirrored).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-6, "{apart}");
    }
}
