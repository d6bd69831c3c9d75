//! The posterior probabilities as bars.

use plotters::element::Rectangle;
use plotters::style::Color;

use super::super::{digits, sheets, words};
use super::Drawing;
use crate::plot::{AFTER, Axis, EVEN, INK, STRIP_AXIS, Strip, WEAK, line, px, stroke, svg};
use gumption_gap::{Diagnosis, Hypothesis};

/// Height of a row, of its bar and of its prior's mark in pixels.
const ROW: f64 = 26.0;
const BAR: f64 = 15.0;
const PRIOR: f64 = 21.0;

/// Space for names and for figures beside the bars.
const LEFT: f64 = 285.0;
const RIGHT: f64 = 60.0;

/// A bar for each hypothesis that is shown by name, with its prior.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis) -> Drawing {
    let shown = sheets::shown(diagnosis);
    let verdict = &diagnosis.most_probable;
    let colour = |hypothesis: &Hypothesis| {
        let first = sheets::winner(diagnosis).is_some_and(|w| w.effects == hypothesis.effects);
        let alike =
            hypothesis.effects.as_ref().is_some_and(|own| verdict.indistinguishable.contains(own));
        match (first, alike) {
            (true, _) => AFTER.filled(),
            (false, true) => EVEN.filled(),
            (false, false) => WEAK.mix(0.45).filled(),
        }
    };
    let bottom = 4.0 + ROW * shown.len() as f64;
    let axis = Axis::linear(0.0, 1.0);
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, "posterior probability")?;
            for (row, hypothesis) in shown.iter().enumerate() {
                let y = 4.0 + ROW * (row as f64 + 0.5);
                let (from, to) = (strip.x(0.0), strip.x(hypothesis.probability));
                let corners = [(px(from), px(y - 0.5 * BAR)), (px(to), px(y + 0.5 * BAR))];
                area.draw(&Rectangle::new(corners, colour(hypothesis)))?;
                let prior = strip.x(hypothesis.prior);
                let ends = [(prior, y - 0.5 * PRIOR), (prior, y + 0.5 * PRIOR)];
                line(area, ends, stroke(INK, 1.75))?;
                strip.name(area, &words::tabled(hypothesis), y)?;
                let text = digits::probability(hypothesis.probability);
                strip.beside(area, &text, hypothesis.probability.max(hypothesis.prior), y)?;
            }
            Ok(())
        })
    };
    let mut caption =
        "Posterior probability (bar) and prior (vertical line) of each hypothesis. Strong blue: \
                       the verdict"
            .to_owned();
    if verdict.indistinguishable.len() > 1 {
        caption.push_str("; faint blue: hypotheses that these data cannot distinguish from it");
    }
    caption.push_str("; grey: the others.");
    Drawing::new(caption, drawn)
}
