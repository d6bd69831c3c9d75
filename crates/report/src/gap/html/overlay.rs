//! What was measured beside what the sim says and what the corrected sim says, over each condition:
//! the first figure that a person looks for.

use gumption_engine::number::smallest_first;
use std::collections::BTreeMap;

use plotters::element::PathElement;
use plotters::style::RGBColor;

use super::super::groups;
use super::super::residuals::{self, Over};
use super::super::{digits, words};
use super::Drawing;
use crate::plain;
use crate::plot::{
    AFTER, Area, Axis, BEFORE, Chart, Drawn, Fill, Groups, INK, Panel, Titles, faded, mark, stroke,
    svg_with_titles,
};
use gumption_gap::{Diagnosis, ValueGap};

/// Height of a panel in pixels.
const HEIGHT: f64 = 230.0;

/// Of more rows than this every so many-th is drawn.
const POINTS: usize = 200;

/// Lines join what differs in one condition only, in so many lines at most.
const LINES: usize = 24;

/// Half the length of a dash, as a share of the axis.
const DASH: f64 = 0.008;

/// A row: the condition, its group, what it shares with others on a line, and its values.
struct OverlayPoint {
    x: f64,
    group: usize,
    line: Vec<u64>,
    value: ValueGap,
    /// What it is, in words.
    about: String,
}

/// Which value of a row is meant.
type ValueOfPoint = fn(&OverlayPoint) -> f64;

/// A panel for each condition that varies; `None` without values.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis, output: usize) -> Option<Drawing> {
    let named = diagnosis.outputs.get(output)?;
    let mut panels = Vec::new();
    for over in residuals::panels(diagnosis) {
        let groups = groups::groups(diagnosis, over);
        let points = points(diagnosis, output, over, &groups);
        if !points.is_empty() {
            panels.push((over, groups, points));
        }
    }
    panels.first()?;
    let marks = panels.iter().map(|(over, groups, _)| (*over, groups));
    let marks = groups::captions(diagnosis, marks);
    let caption = format!(
        "{}: measured (dark marks{}), predicted by the sim (red) and by the corrected sim (blue); \
         lines join points that differ only in this condition.{}",
        plain(&named.name),
        if panels.iter().any(|(_, _, points)| has_bars(points)) {
            " with ± two standard uncertainties"
        } else {
            ""
        },
        marks
    );
    let ends = panels
        .iter()
        .flat_map(|(_, _, points)| points)
        .flat_map(|point| [point.value.measured, point.value.sim(), point.value.corrected()]);
    let y = Axis::around(ends)?;
    let drawn = |width: f64| {
        svg_with_titles(width, HEIGHT * panels.len() as f64, |area, titles| {
            let rows = area.split_evenly((panels.len(), 1));
            for (row, (over, _, points)) in rows.iter().zip(&panels) {
                panel(row, points, (over.axis(diagnosis), words::axis(named)), &y, titles)?;
            }
            Ok(())
        })
    };
    Some(Drawing::new(caption, drawn))
}

fn points(diagnosis: &Diagnosis, output: usize, over: Over, groups: &Groups) -> Vec<OverlayPoint> {
    let step = diagnosis.rows.len().div_ceil(POINTS).max(1);
    let rows = diagnosis.rows.iter().enumerate().step_by(step);
    rows.filter_map(|(number, row)| {
        let value = *row.outputs.get(output)?;
        let x = over.of(number, row)?;
        let others = row.conditions.iter().enumerate();
        let others = others.filter(|(place, _)| over != Over::Condition(*place));
        let line = others.map(|(_, value)| value.to_bits()).collect();
        let group = groups.of(&row.conditions);
        let about = about(diagnosis, output, &row.conditions, &value);
        let point = OverlayPoint { x, group, line, value, about };
        let numbers = [x, value.measured, point.value.sim(), point.value.corrected()];
        numbers.iter().all(|number| number.is_finite()).then_some(point)
    })
    .collect()
}

/// A row in words: its conditions, what was measured, and what the sim says before and after.
fn about(diagnosis: &Diagnosis, output: usize, conditions: &[f64], value: &ValueGap) -> String {
    let named = &diagnosis.outputs[output];
    let at: Vec<String> = diagnosis
        .conditions
        .iter()
        .zip(conditions)
        .map(|(condition, at)| {
            let at = words::in_unit(&digits::condition(*at), condition);
            format!("{} = {at}", plain(&condition.name))
        })
        .collect();
    let text = |number: f64| words::in_unit(&digits::beside(number, value.u), named);
    format!(
        "{}: measured {}, sim {}, corrected {}",
        at.join(", "),
        text(value.measured),
        text(value.sim()),
        text(value.corrected())
    )
}

/// Whether uncertainties are large enough to be seen beside the values.
fn has_bars(points: &[OverlayPoint]) -> bool {
    let values = points.iter().map(|point| point.value.measured);
    let [low, high] =
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
    points.iter().any(|point| 4.0 * point.value.u > 0.02 * (high - low))
}

fn panel(
    area: &Area<'_>,
    points: &[OverlayPoint],
    labels: (String, String),
    y: &Axis,
    titles: &mut Titles,
) -> Drawn {
    let x = Axis::over(points.iter().map(|point| point.x));
    let panel = Panel { x: (&x, labels.0), y: (y, labels.1), marks: [9, 6], title: String::new() };
    let chart = panel.draw(area)?;
    sims(&chart, &x, points)?;
    let [bottom, top] = y.ends();
    let bars = has_bars(points);
    for point in points {
        let at = x.position(point.x);
        let measured = point.value.measured;
        if bars && point.value.u.is_finite() {
            let ends = [measured - 2.0 * point.value.u, measured + 2.0 * point.value.u];
            let bar = ends.map(|end| (at, end.clamp(bottom, top))).to_vec();
            chart.plotting_area().draw(&PathElement::new(bar, faded(INK, 0.5, 1.0)))?;
        }
        mark(&chart, point.group, (at, measured), 2.5, (INK, Fill::Full))?;
        titles.at(&chart, (at, measured), &point.about);
    }
    Ok(())
}

/// The sim and the corrected sim: lines through what differs in this condition alone, else dashes.
fn sims(chart: &Chart<'_>, x: &Axis, points: &[OverlayPoint]) -> Drawn {
    let mut lines: BTreeMap<&[u64], Vec<&OverlayPoint>> = BTreeMap::new();
    for point in points {
        lines.entry(&point.line).or_default().push(point);
    }
    let joined = lines.len() <= LINES && lines.values().any(|line| line.len() > 1);
    let of: [(RGBColor, f64, ValueOfPoint); 2] =
        [(BEFORE, 1.25, |point| point.value.sim()), (AFTER, 1.75, |point| point.value.corrected())];
    for (colour, width, value) in of {
        for line in lines.values_mut().filter(|_| joined) {
            smallest_first(line, |a| a.x);
            let places: Vec<(f64, f64)> =
                line.iter().map(|point| (x.position(point.x), value(point))).collect();
            if places.len() > 1 {
                let path = PathElement::new(places, stroke(colour, width));
                chart.plotting_area().draw(&path)?;
            }
        }
        if !joined {
            let [from, to] = x.ends();
            let half = DASH * (to - from);
            for point in points {
                let at = x.position(point.x);
                let ends = vec![
                    ((at - half).max(from), value(point)),
                    ((at + half).min(to), value(point)),
                ];
                let dash = PathElement::new(ends, stroke(colour, width));
                chart.plotting_area().draw(&dash)?;
            }
        }
    }
    Ok(())
}
