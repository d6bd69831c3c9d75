//! The scores as bars, from the smallest to the largest one.

use gumption_engine::number::largest_first;
use plotters::element::Rectangle;
use plotters::style::Color;

use crate::compare::sheets::score;
use crate::html::Drawing;
use crate::plain;
use crate::plot::{AFTER, Axis, BEFORE, INK, STRIP_AXIS, Strip, WEAK, line, px, stroke, svg};
use gumption_analysis::compare::proficiency::LIMITS;
use gumption_analysis::compare::{ProficiencyTest, Signal};

/// Height of a row and of its bar in pixels.
const ROW: f64 = 22.0;
const BAR: f64 = 14.0;

/// Space for names and for numbers beside the bars.
const LEFT: f64 = 170.0;
const RIGHT: f64 = 60.0;

/// Maximum number of bars; the largest scores are shown.
const MOST: usize = 100;

/// The largest score on the axis: a bar beyond it ends there, and its number stands beside it.
const FARTHEST: f64 = 10.0;

/// A bar for each participant with a score; `None` without one.
pub(in crate::compare) fn figure(test: &ProficiencyTest) -> Option<Drawing> {
    let is_by_z_prime = test.is_by_z_prime();
    let scored = test.rows.iter().filter_map(|row| {
        let score = if is_by_z_prime { row.z_prime } else { row.z };
        Some((row.participant.label.as_str(), score?))
    });
    let mut bars: Vec<(&str, f64)> = scored.collect();
    let all = bars.len();
    largest_first(&mut bars, |bar| bar.1.abs());
    bars.truncate(MOST);
    let end = 1.05 * bars.first()?.1.abs().clamp(1.2 * LIMITS[1], FARTHEST);
    bars.reverse();
    largest_first(&mut bars, |bar| -bar.1);
    let bars: Vec<(String, f64)> =
        bars.into_iter().map(|(name, score)| (plain(name), score)).collect();
    let is_clipped = bars.iter().any(|(_, score)| score.abs() > end);
    let name = if is_by_z_prime { "z'" } else { "z" };
    let axis = Axis::linear(-end, end);
    let bottom = 4.0 + ROW * bars.len() as f64;
    let drawn = move |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, &format!("{name} score"))?;
            for (limit, colour) in LIMITS.into_iter().zip([WEAK, BEFORE]) {
                for x in [-limit, limit].map(|at| strip.x(at)) {
                    line(area, [(x, 0.0), (x, bottom)], stroke(colour, 1.0))?;
                }
            }
            for (row, (label, value)) in bars.iter().enumerate() {
                let y = 4.0 + ROW * (row as f64 + 0.5);
                let (from, to) = (strip.x(value.min(0.0)), strip.x(value.max(0.0)));
                let corners = [(px(from), px(y - 0.5 * BAR)), (px(to), px(y + 0.5 * BAR))];
                let is_action = Signal::of(*value) == Signal::Action;
                let colour = if is_action { BEFORE } else { AFTER };
                area.draw(&Rectangle::new(corners, colour.filled()))?;
                strip.name(area, label, y)?;
                strip.beside(area, &score(*value), value.max(0.0), y)?;
            }
            line(area, [(strip.x(0.0), 0.0), (strip.x(0.0), bottom)], stroke(INK, 1.0))
        })
    };
    let mut caption = format!(
        "The {name} scores from the smallest to the largest one, with the limits of warning signals \
         (±2) and action signals (±3, vermilion)"
    );
    if is_clipped {
        caption.push_str("; a bar that ends at the edge is longer");
    }
    if all > MOST {
        caption.push_str(&format!("; the {} smallest moduli are left out", all - MOST));
    }
    caption.push('.');
    Some(Drawing::new(caption, drawn))
}
