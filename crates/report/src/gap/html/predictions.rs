//! Corrected predictions with their uncertainties, beside the data and the sim as it was.

use gumption_engine::number::ascending;
use plotters::element::PathElement;

use super::super::groups;
use super::super::residuals::Over;
use super::super::words;
use super::Drawing;
use crate::plot::{AFTER, Axis, BEFORE, Fill, INK, Panel, mark, stroke, svg};
use gumption_gap::{Diagnosis, Predicted};

const HEIGHT: f64 = 240.0;

/// So many predictions are drawn at most; more would be one black area.
const MOST: usize = 400;

/// A prediction: the condition, its value and standard uncertainty, what the sim says, its group.
struct PredictionPoint {
    x: f64,
    value: f64,
    u: f64,
    sim: f64,
    group: usize,
}

/// The predictions of an output against the condition with most values; `None` where nothing
/// varies.
pub(in crate::gap) fn draw(
    diagnosis: &Diagnosis,
    rows: &[Predicted],
    output: usize,
) -> Option<Drawing> {
    let values = |condition: usize| {
        let mut values: Vec<f64> =
            rows.iter().filter_map(|row| row.conditions.get(condition).copied()).collect();
        ascending(&mut values);
        values.dedup();
        values
    };
    let set = (0..diagnosis.conditions.len()).filter(|place| !diagnosis.history.contains(place));
    let finest = set.rev().max_by_key(|&c| values(c).len())?;
    let levels = values(finest);
    if levels.len() < 2 || rows.len() > MOST {
        return None;
    }
    let named = &diagnosis.outputs[output];
    let over = Over::Condition(finest);
    let groups = groups::groups(diagnosis, over);
    let points: Vec<PredictionPoint> = rows
        .iter()
        .filter_map(|row| {
            let (value, u) = *row.outputs.get(output)?;
            let group = groups.of(&row.conditions);
            let sim = *row.model.get(output)?;
            Some(PredictionPoint { x: *row.conditions.get(finest)?, value, u, sim, group })
        })
        .filter(|of| [of.x, of.value, of.u, of.sim].iter().all(|number| number.is_finite()))
        .collect();
    let measured: Vec<(f64, f64, usize)> = diagnosis
        .rows
        .iter()
        .filter_map(|row| {
            let value = row.outputs.get(output)?.measured;
            Some((*row.conditions.get(finest)?, value, groups.of(&row.conditions)))
        })
        .take(MOST)
        .collect();
    let x = Axis::over(levels.iter().copied().chain(measured.iter().map(|(x, ..)| *x)));
    let predicted =
        points.iter().flat_map(|of| [of.value - 2.0 * of.u, of.value + 2.0 * of.u, of.sim]);
    let y = Axis::around(predicted.chain(measured.iter().map(|(_, value, _)| *value)))?;
    let drawn = |width: f64| {
        svg(width, HEIGHT, |area| {
            let along = words::axis(&diagnosis.conditions[finest]);
            let panel = Panel {
                x: (&x, along),
                y: (&y, words::axis(named)),
                marks: [8, 6],
                title: String::new(),
            };
            let chart = panel.draw(area)?;
            for (at, value, group) in &measured {
                mark(&chart, *group, (x.position(*at), *value), 2.0, (INK, Fill::Open))?;
            }
            let [from, to] = x.ends();
            let half = 0.01 * (to - from);
            for of in &points {
                let at = x.position(of.x);
                let dash = vec![((at - half).max(from), of.sim), ((at + half).min(to), of.sim)];
                chart.plotting_area().draw(&PathElement::new(dash, stroke(BEFORE, 2.0)))?;
                let bar = vec![(at, of.value - 2.0 * of.u), (at, of.value + 2.0 * of.u)];
                chart.plotting_area().draw(&PathElement::new(bar, stroke(AFTER, 1.75)))?;
                mark(&chart, of.group, (at, of.value), 3.0, (AFTER, Fill::Full))?;
            }
            Ok(())
        })
    };
    let caption = format!(
        "Corrected prediction of {} (full marks, blue) with ± two standard uncertainties, \
         averaged over the hypotheses by their probability; uncorrected sim (dashes, red) and \
         measured values (open marks).{}",
        crate::plain(&named.name),
        groups.caption(&crate::plain(&diagnosis.conditions[finest].name))
    );
    Some(Drawing::new(caption, drawn))
}
