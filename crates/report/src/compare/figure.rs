//! Results with their uncertainties as a strip.

use plotters::element::{Circle, Rectangle};
use plotters::style::Color;

use super::sheets::has_name;
use super::{Compare, proficiency};
use crate::html::Drawing;
use crate::number::{exact, with_uncertainty};
use crate::plain;
use crate::plot::{
    AFTER, Axis, BEFORE, EVEN, INK, STRIP_AXIS, Strip, line, px, stroke, svg_with_titles,
};
use gumption_analysis::compare::FACTOR;

/// Height of a row in pixels, and space beside the bars.
const ROW: f64 = 24.0;
const LEFT: f64 = 170.0;
const RIGHT: f64 = 24.0;

/// A row of the figure: name, value, expanded uncertainty, and whether it is highlighted.
type Bar = (String, f64, f64, bool);

/// Values of laboratories with their U and the reference band, differences with their U and zero, or
/// scores; `None` without a score.
pub(super) fn draw(compare: &Compare) -> Option<Drawing> {
    match compare {
        Compare::Pairs { compared, units, .. } => {
            // differences in several units have no common axis
            let unit = units.first().filter(|first| units.iter().all(|unit| unit == *first));
            let bars = compared
                .iter()
                .map(|row| (plain(&row.label), row.difference, row.expanded, !row.is_compatible()));
            let caption = "Difference of the two results with its expanded uncertainty (k = 2). A bar \
                           that does not reach 0 (vermilion) is a pair that is not compatible.";
            let label = of_unit("difference", unit.map_or("", String::as_str));
            Some(strip(&bars.collect::<Vec<Bar>>(), [0.0, 0.0], &label, caption))
        }
        Compare::Laboratories { comparison, unit } => {
            let bars = comparison
                .rows
                .iter()
                .map(|row| (plain(&row.label), row.value, row.expanded_stated, !row.member));
            let of = &comparison.reference;
            let half = FACTOR * of.standard_uncertainty;
            let caption = "Results with their expanded uncertainties as stated, and the reference \
                           value with its own (band, k = 2). Vermilion: not in the reference value.";
            let band = [of.value - half, of.value + half];
            let bars: Vec<Bar> = bars.collect();
            Some(strip(&bars, band, &of_unit("result", unit), caption))
        }
        Compare::Proficiency { test, .. } => proficiency::figure(test),
        Compare::Gauge { .. } => None,
    }
}

/// The title of an axis with its unit.
fn of_unit(title: &str, unit: &str) -> String {
    if has_name(unit) { format!("{title} in {}", plain(unit)) } else { title.to_owned() }
}

fn strip(bars: &[Bar], band: [f64; 2], label: &str, caption: &str) -> Drawing {
    let ends = bars.iter().flat_map(|(_, value, u, _)| [value - u, value + u]).chain(band);
    let [low, high] =
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    let margin = if high > low { 0.04 * (high - low) } else { 1.0 };
    let axis = Axis::linear(low - margin, high + margin);
    let bottom = 4.0 + ROW * bars.len() as f64;
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        svg_with_titles(width, bottom + STRIP_AXIS, |area, titles| {
            let [from, to] = band.map(|end| strip.x(end));
            let corners = [(px(from), px(0.0)), (px(to), px(bottom))];
            area.draw(&Rectangle::new(corners, EVEN.mix(0.35).filled()))?;
            strip.draw(area, 0.0, bottom, label)?;
            let middle = 0.5 * (from + to);
            line(area, [(middle, 0.0), (middle, bottom)], stroke(INK, 1.0))?;
            for (row, (name, value, u, out)) in bars.iter().enumerate() {
                let y = 4.0 + ROW * (row as f64 + 0.5);
                let colour = if *out { BEFORE } else { AFTER };
                strip.name(area, name, y)?;
                strip.interval(area, [value - u, value + u], y, (colour, &exact))?;
                area.draw(&Circle::new((px(strip.x(*value)), px(y)), px(3.5), colour.filled()))?;
                let (number, expanded) = with_uncertainty(*value, *u, 2);
                titles.at_pixels((strip.x(*value), y), &format!("{name}: {number} ± {expanded}"));
            }
            Ok(())
        })
    };
    Drawing::new(caption.to_owned(), drawn)
}
