//! Corrected predictions with their uncertainties.

use plotters::element::{Circle, PathElement};
use plotters::style::Color;

use super::super::words;
use super::{Drawing, WIDTH};
use crate::plot::{AFTER, Axis, Panel, px, stroke, svg};
use gumption_gap::{Diagnosis, Predicted};

const HEIGHT: f64 = 240.0;

/// So many predictions are drawn at most; more would be one black area.
const MOST: usize = 400;

/// The predictions of an output against the condition with most values; `None` where nothing
/// varies.
pub(super) fn draw(diagnosis: &Diagnosis, rows: &[Predicted], output: usize) -> Option<Drawing> {
    let values = |condition: usize| {
        let mut values: Vec<f64> =
            rows.iter().filter_map(|row| row.conditions.get(condition).copied()).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let finest = (0..diagnosis.conditions.len()).rev().max_by_key(|&c| values(c).len())?;
    let levels = values(finest);
    if levels.len() < 2 || rows.len() > MOST {
        return None;
    }
    let named = &diagnosis.outputs[output];
    let points: Vec<(f64, f64, f64)> = rows
        .iter()
        .filter_map(|row| {
            let (value, u) = *row.outputs.get(output)?;
            Some((*row.conditions.get(finest)?, value, u))
        })
        .filter(|(x, value, u)| [x, value, u].iter().all(|number| number.is_finite()))
        .collect();
    let x = Axis::over(levels);
    let ends = points.iter().flat_map(|(_, value, u)| [value - 2.0 * u, value + 2.0 * u]);
    let y = linear_over(ends)?;
    let drawn = svg(WIDTH, HEIGHT, |area| {
        let along = words::axis(&diagnosis.conditions[finest]);
        let panel = Panel {
            x: (&x, along),
            y: (&y, words::axis(named)),
            marks: [8, 6],
            title: String::new(),
        };
        let chart = panel.draw(area)?;
        for (at, value, u) in &points {
            let at = x.position(*at);
            let bar = vec![(at, value - 2.0 * u), (at, value + 2.0 * u)];
            chart.plotting_area().draw(&PathElement::new(bar, stroke(AFTER, 1.25)))?;
            chart.plotting_area().draw(&Circle::new((at, *value), px(3.0), AFTER.filled()))?;
        }
        Ok(())
    });
    let caption = format!(
        "Corrected prediction of {} (dot) with two standard uncertainties on either side, averaged \
         over the hypotheses by their probability.",
        crate::plain(&named.name)
    );
    Some(Drawing { svg: drawn, caption })
}

fn linear_over(values: impl Iterator<Item = f64>) -> Option<Axis> {
    let [from, to] = values
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| [a.min(value), b.max(value)]);
    let margin = 0.06 * (to - from);
    (margin.is_finite() && margin > 0.0).then(|| Axis::linear(from - margin, to + margin))
}
