//! A sweep: estimates with the intervals that are to be taken over a condition, and their half-lengths
//! alone.

use crate::table::unit_text;
use gumption_engine::number::ascending;
use plotters::element::PathElement;
use plotters::style::RGBColor;

use crate::evaluation::Taken;
use crate::html::Drawing;
use crate::number::{exact, position, to, with_uncertainty};
use crate::plain;
use crate::plot::{
    AFTER, Axis, BEFORE, Fill, Groups, INK, Panel, mark, px, stroke, svg_with_titles,
};
use crate::table::{conditions_text, in_unit};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::{RowEvaluation, naming};
use gumption_engine::task::{Settings, Task};

/// Height of a panel in pixels.
const TALL: f64 = 210.0;

/// Points that a figure shows, at most.
const MOST: usize = 2000;

/// A row.
struct SweepPoint {
    /// The condition's value.
    x: f64,
    estimate: f64,
    /// The interval that is to be taken.
    ends: [f64; 2],
    /// Whether it is that of the trials.
    of_trials: bool,
    group: usize,
    /// What it is, in words.
    about: String,
}

/// Two panels over the condition with most levels of those that name rows, which are told apart by
/// the one with the fewest; `None` where none varies or nothing is known.
pub(in crate::evaluation) fn sweep(
    task: &Task,
    rows: &[RowEvaluation],
    (output, settings): (usize, &Settings),
) -> Option<Drawing> {
    let levels = |place: usize| -> Vec<f64> {
        let mut values: Vec<f64> =
            rows.iter().filter_map(|row| row.conditions.get(place).copied()).collect();
        ascending(&mut values);
        values.dedup();
        values
    };
    let named = naming(rows);
    let counted = named.iter().map(|&place| (levels(place).len(), place));
    let counted = counted.filter(|(count, _)| *count > 1);
    // of equally many the first
    let (_, place) = counted.clone().max_by_key(|(count, p)| (*count, usize::MAX - p))?;
    let groups = match counted.filter(|(_, other)| *other != place).min() {
        Some((_, other)) => groups(task, other, &levels(other)),
        None => Groups::default(),
    };
    let condition = task.model.conditions.get(place)?;
    let quantity = &task.model.outputs.get(output)?.quantity;
    let points: Vec<SweepPoint> = rows
        .iter()
        .take(MOST)
        .filter_map(|row| {
            let taken = Taken::of(settings, row.outputs.get(output)?);
            let (estimate, ends) = taken.interval()?;
            let x = *row.conditions.get(place)?;
            let group = groups.of(&row.conditions);
            let about = about(task, &named, row, (quantity, taken));
            let of_trials = matches!(taken, Taken::Interval { .. });
            Some(SweepPoint { x, estimate, ends, of_trials, group, about })
        })
        .filter(|of| [of.x, of.estimate, of.half()].iter().all(|number| number.is_finite()))
        .collect();
    if points.is_empty() {
        return None;
    }
    let x = Axis::over(points.iter().map(|point| point.x));
    let values = Axis::around(points.iter().flat_map(|of| of.ends))?;
    let most = points.iter().map(SweepPoint::half).fold(0.0, f64::max);
    let widths = Axis::linear(0.0, if most > 0.0 { 1.08 * most } else { 1.0 });
    let trials = points.iter().filter(|of| of.of_trials).count();
    let drawn = |width: f64| {
        svg_with_titles(width, 2.0 * TALL, |area, titles| {
            let (top, bottom) = area.split_vertically(px(TALL));
            let over = |label: String, y| Panel {
                x: (&x, axis(condition)),
                y: (y, label),
                marks: [9, 6],
                title: String::new(),
            };
            let upper = over(axis(quantity), &values).draw(&top)?;
            for of in &points {
                let at = x.position(of.x);
                let ends = of.ends.map(|end| (at, end));
                let bar = PathElement::new(ends.to_vec(), stroke(of.colour(), 1.5));
                upper.plotting_area().draw(&bar)?;
                mark(&upper, of.group, (at, of.estimate), 2.75, (INK, Fill::Full))?;
                titles.at(&upper, (at, of.estimate), &of.about);
            }
            let name = match trials {
                0 => format!("U({})", quantity.name),
                _ => format!("half of the interval of {}", quantity.name),
            };
            let label = axis(&Quantity { name, ..quantity.clone() });
            let lower = over(label, &widths).draw(&bottom)?;
            for of in &points {
                let place = (x.position(of.x), of.half());
                mark(&lower, of.group, place, 2.75, (of.colour(), Fill::Full))?;
                titles.at(&lower, place, &of.about);
            }
            Ok(())
        })
    };
    let left_out = if rows.len() > MOST { ", the first rows" } else { "" };
    let propagated = "estimates with their expanded uncertainties U by the law of propagation";
    let [what, below] = match points.len() - trials {
        _ if trials == 0 => [propagated.to_owned(), "U alone".to_owned()],
        rest => {
            let of_trials = "estimates with their coverage intervals by the Monte Carlo method, where \
                             the GUM interval is not validated";
            let others = format!("; blue: {propagated}");
            let others = if rest == 0 { "" } else { &others };
            [
                format!("{of_trials} (vermilion){others}"),
                "half of the length of the interval alone".to_owned(),
            ]
        }
    };
    let caption = format!(
        "Above: {what}{left_out}; below: {below}.{}",
        groups.caption(&plain(&condition.name))
    );
    Some(Drawing::new(caption, drawn))
}

impl SweepPoint {
    /// Half of the length of the interval: U, where it lies about the estimate.
    fn half(&self) -> f64 {
        0.5 * (self.ends[1] - self.ends[0])
    }

    fn colour(&self) -> RGBColor {
        if self.of_trials { BEFORE } else { AFTER }
    }
}

/// Rows told apart by a condition.
fn groups(task: &Task, condition: usize, levels: &[f64]) -> Groups {
    let Some(quantity) = task.model.conditions.get(condition) else { return Groups::default() };
    let name = plain(&quantity.name);
    Groups::of_levels(condition, levels, |low, high| {
        let last = in_unit(&exact(high), &quantity.unit);
        match low == high {
            true => format!("{name} = {last}"),
            false => format!("{name} {} to {last}", exact(low)),
        }
    })
}

/// A row in words: the conditions that name it, and its result.
fn about(
    task: &Task,
    named: &[usize],
    row: &RowEvaluation,
    (quantity, taken): (&Quantity, Taken<'_>),
) -> String {
    let of = |place: &usize| {
        Some((task.model.conditions.get(*place)?.clone(), *row.conditions.get(*place)?))
    };
    let (conditions, at): (Vec<Quantity>, Vec<f64>) = named.iter().filter_map(of).unzip();
    let result = match (taken, taken.interval()) {
        (Taken::Expanded { estimate, expanded, .. }, _) => {
            let (estimate, expanded) = with_uncertainty(estimate, expanded, 2);
            format!("({estimate} ± {expanded})")
        }
        (_, Some((estimate, [low, high]))) => {
            let place = position(0.5 * (high - low), 2);
            let [estimate, low, high] = [estimate, low, high].map(|value| to(value, place));
            format!("{estimate}, from {low} to {high}")
        }
        (_, None) => String::new(),
    };
    let result = in_unit(&result, &quantity.unit);
    format!("{}: {} = {result}", conditions_text(&conditions, &at), plain(&quantity.name))
}

/// Name and unit.
fn axis(quantity: &Quantity) -> String {
    let name = plain(&quantity.name);
    if quantity.unit.has_name() { format!("{name} in {}", unit_text(&quantity.unit)) } else { name }
}
