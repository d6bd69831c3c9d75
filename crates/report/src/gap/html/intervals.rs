//! The parameters of the verdict with their intervals, in each hypothesis of its group.

use plotters::element::Circle;
use plotters::style::Color;

use super::super::{digits, sheets, words};
use super::Drawing;
use crate::number::exact;
use crate::plot::{
    AFTER, Anchor, Axis, FONT, INK, STRIP_AXIS, Strip, WEAK, Write, centred, px, svg, write,
};
use gumption_gap::{Diagnosis, EffectParameter, NamedQuantity};

/// Height of a row and of a parameter's name in pixels.
const ROW: f64 = 24.0;
const TITLE: f64 = 22.0;

/// Free space below a parameter.
const GAP: f64 = 8.0;

const LEFT: f64 = 285.0;
const RIGHT: f64 = 20.0;

/// So many hypotheses are compared at most.
const COMPARED: usize = 6;

/// A parameter of the verdict with what each hypothesis of the group says of it.
struct Compared<'a> {
    own: &'a EffectParameter,
    lines: Vec<(String, &'a EffectParameter)>,
}

/// The interval and the estimate of every parameter; `None` where the verdict has none.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis) -> Option<Drawing> {
    let winner = sheets::winner(diagnosis)?;
    let in_group = |effects: &Option<Vec<String>>| {
        effects.as_ref().is_some_and(|own| diagnosis.most_probable.indistinguishable.contains(own))
    };
    let others = diagnosis
        .hypotheses
        .iter()
        .filter(|other| other.effects != winner.effects && in_group(&other.effects));
    let compared = winner.parameters.iter().map(|own| {
        let all = std::iter::once(winner).chain(others.clone());
        let lines = all.filter_map(|hypothesis| {
            let found = hypothesis.parameters.iter().find(|other| other.name == own.name)?;
            Some((words::hypothesis(hypothesis.effects.as_deref()), found))
        });
        Compared { own, lines: lines.take(COMPARED).collect() }
    });
    let compared: Vec<Compared<'_>> = compared.collect();
    if compared.is_empty() {
        return None;
    }
    let height = |one: &Compared<'_>| TITLE + ROW * one.lines.len() as f64 + STRIP_AXIS + GAP;
    let total = compared.iter().map(height).sum();
    let drawn = |width: f64| {
        svg(width, total, |area| {
            let mut top = 0.0;
            for one in &compared {
                let values =
                    one.lines.iter().flat_map(|(_, p)| [p.interval[0], p.interval[1], p.estimate]);
                let axis = Axis::around(values).unwrap_or_else(|| Axis::over([one.own.estimate]));
                let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
                let named =
                    NamedQuantity { name: one.own.name.clone(), unit: one.own.unit.clone() };
                let title = words::axis(&named);
                let how =
                    Write { anchor: Anchor::Start, bold: true, ..centred((4.0, top + 10.0), FONT) };
                write(area, &crate::plot::shortened(&title, width - 10.0, FONT), how)?;
                let bottom = top + TITLE + ROW * one.lines.len() as f64;
                strip.draw(area, top + TITLE, bottom, &title)?;
                for (row, (name, parameter)) in one.lines.iter().enumerate() {
                    let y = top + TITLE + ROW * (row as f64 + 0.5);
                    let colour = if row == 0 { AFTER } else { WEAK };
                    strip.name(area, name, y)?;
                    strip.interval(area, parameter.interval, y, (colour, &exact))?;
                    let place = (px(strip.x(parameter.estimate)), px(y));
                    area.draw(&Circle::new(
                        place,
                        px(4.0),
                        if row == 0 { INK } else { WEAK }.filled(),
                    ))?;
                }
                top += height(one);
            }
            Ok(())
        })
    };
    let caption = format!(
        "Parameters of the verdict: estimate (dot) and {} interval. First line: the verdict. \
         Below it: hypotheses with the same parameter that these data cannot distinguish from it.",
        digits::percent(diagnosis.probability)
    );
    Some(Drawing::new(caption, drawn))
}
