//! The shares of the variance as bars.

use gumption_engine::number::largest_first;

use crate::html::Drawing;
use crate::number::rounded;
use crate::plain;
use crate::plot::{AFTER, Axis, EVEN, INK, STRIP_AXIS, Strip, line, stroke, svg};
use gumption_engine::propagate::gum::Gum;
use gumption_engine::task::Task;

/// Height of a row and of its bar in pixels.
const ROW: f64 = 22.0;
const BAR: f64 = 14.0;

/// Space for names and for figures beside the bars.
const LEFT: f64 = 220.0;
const RIGHT: f64 = 60.0;

/// Bars, at most; the largest ones are shown.
const MOST: usize = 24;

/// A bar for each line of the budget that contributes; `None` where none does.
pub(in crate::evaluation) fn shares(task: &Task, gum: &Gum) -> Option<Drawing> {
    let name = |place: usize| task.variables.get(place).map_or("", |variable| &variable.name);
    let inputs = gum.budget().map(|line| (plain(name(line.variable)), line.share, false));
    let coefficients = gum.correlations().map(|line| {
        let [a, b] = line.variables.map(|place| plain(name(place)));
        (format!("r({a}, {b})"), line.share, true)
    });
    let mut bars: Vec<(String, f64, bool)> =
        inputs.chain(coefficients).filter(|(_, share, _)| *share != 0.0).collect();
    if bars.is_empty() {
        return None;
    }
    let all = bars.len();
    largest_first(&mut bars, |a| a.1.abs());
    bars.truncate(MOST);
    let least = bars.iter().map(|bar| bar.1).fold(0.0, f64::min);
    let most = bars.iter().map(|bar| bar.1).fold(0.0, f64::max);
    let axis = Axis::linear(100.0 * least * 1.05, (100.0 * most * 1.05).max(1.0));
    let bottom = 4.0 + ROW * bars.len() as f64;
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, "share of the variance in %")?;
            for (row, (name, share, coefficient)) in bars.iter().enumerate() {
                let y = 4.0 + ROW * (row as f64 + 0.5);
                let percent = 100.0 * share;
                let colour = if *coefficient { EVEN } else { AFTER };
                strip.bar(area, [0.0, percent], y, (BAR, colour))?;
                strip.name(area, name, y)?;
                strip.beside(area, &rounded(percent, -1), percent.max(0.0), y)?;
            }
            line(area, [(strip.x(0.0), 0.0), (strip.x(0.0), bottom)], stroke(INK, 1.0))
        })
    };
    let mut caption = "Shares of the combined variance, largest first".to_owned();
    if bars.iter().any(|bar| bar.2) {
        caption.push_str("; paler bars: correlation coefficients");
    }
    if all > bars.len() {
        caption.push_str(&format!("; {} smaller ones are left out", all - bars.len()));
    }
    caption.push('.');
    Some(Drawing::new(caption, drawn))
}
