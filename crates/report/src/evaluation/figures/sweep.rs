//! A sweep: estimates with expanded uncertainties over a condition, and the uncertainties alone.

use plotters::element::{Circle, PathElement};
use plotters::style::Color;

use crate::html::{Drawing, WIDTH};
use crate::plain;
use crate::plot::{AFTER, Axis, INK, Panel, px, stroke, svg};
use crate::table::has_name;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::task::Task;

/// Height of a panel in pixels.
const TALL: f64 = 210.0;

/// Points that a figure shows, at most.
const MOST: usize = 2000;

/// A row: the condition's value, the estimate and its expanded uncertainty.
type Point = (f64, f64, f64);

/// Two panels over the condition with most levels; `None` where none varies or nothing is known.
pub(in crate::evaluation) fn sweep(
    task: &Task,
    rows: &[RowEvaluation],
    output: usize,
) -> Option<Drawing> {
    let levels = |place: usize| {
        let mut values: Vec<f64> =
            rows.iter().filter_map(|row| row.conditions.get(place).copied()).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values.len()
    };
    let counted = (0..task.model.conditions.len()).map(|place| (levels(place), place));
    // of equally many the first
    let (_, place) = counted
        .filter(|(count, _)| *count > 1)
        .max_by_key(|(count, p)| (*count, usize::MAX - p))?;
    let condition = task.model.conditions.get(place)?;
    let quantity = &task.model.outputs.get(output)?.quantity;
    let points: Vec<Point> = rows
        .iter()
        .take(MOST)
        .filter_map(|row| {
            let gum = row.outputs.get(output)?.gum.as_ref()?;
            Some((*row.conditions.get(place)?, gum.estimate, gum.expanded_uncertainty()?))
        })
        .filter(|(x, y, u)| x.is_finite() && y.is_finite() && u.is_finite())
        .collect();
    if points.is_empty() {
        return None;
    }
    let x = Axis::over(points.iter().map(|point| point.0));
    let values = linear_over(points.iter().flat_map(|(_, y, u)| [y - u, y + u]))?;
    let most = points.iter().map(|point| point.2).fold(0.0, f64::max);
    let widths = Axis::linear(0.0, if most > 0.0 { 1.08 * most } else { 1.0 });
    let drawn = svg(WIDTH, 2.0 * TALL, |area| {
        let (top, bottom) = area.split_vertically(px(TALL));
        let over = |label: String, y| Panel {
            x: (&x, axis(condition)),
            y: (y, label),
            marks: [9, 6],
            title: String::new(),
        };
        let upper = over(axis(quantity), &values).draw(&top)?;
        let upper = upper.plotting_area();
        for (at, y, u) in &points {
            let at = x.position(*at);
            let bar = vec![(at, y - u), (at, y + u)];
            upper.draw(&PathElement::new(bar, stroke(AFTER, 1.5)))?;
            upper.draw(&Circle::new((at, *y), px(2.5), INK.filled()))?;
        }
        let name = format!("U({})", quantity.name);
        let lower = over(axis(&Quantity { name, ..quantity.clone() }), &widths).draw(&bottom)?;
        for (at, _, u) in &points {
            let dot = Circle::new((x.position(*at), *u), px(2.5), AFTER.filled());
            lower.plotting_area().draw(&dot)?;
        }
        Ok(())
    });
    let left_out = if rows.len() > MOST { ", the first rows" } else { "" };
    let caption = format!(
        "Above: estimates with their expanded uncertainties U by the law of propagation{left_out}; \
         below: U alone."
    );
    Some(Drawing { svg: drawn, caption })
}

/// A linear axis over values; `None` where they are all the same.
fn linear_over(values: impl Iterator<Item = f64>) -> Option<Axis> {
    let [from, to] = values
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| [a.min(value), b.max(value)]);
    let margin = 0.06 * (to - from);
    (margin.is_finite() && margin > 0.0).then(|| Axis::linear(from - margin, to + margin))
}

/// Name and unit.
fn axis(quantity: &Quantity) -> String {
    let name = plain(&quantity.name);
    if has_name(&quantity.unit) {
        format!("{name} in {}", plain(quantity.unit.text()))
    } else {
        name
    }
}
