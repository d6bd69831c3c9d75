//! How far the residuals shrink towards the noise.

use plotters::element::{Circle, Rectangle};
use plotters::style::Color;

use super::super::{digits, words};
use super::Drawing;
use crate::number::significant;
use crate::plain;
use crate::plot::{
    AFTER, Axis, BEFORE, CHROME, FONT, INK, STRIP_AXIS, Strip, WIDER, length, line, px, stroke, svg,
};
use gumption_gap::{Diagnosis, NamedQuantity, Shrunk};

const ROW: f64 = 30.0;
const LEFT: f64 = 150.0;

/// What parts the names from the strip.
const BEFORE_STRIP: f64 = 16.0;

/// From the end of the strip to the figures beside it.
const BESIDE: f64 = 7.0;

/// Half the side of a square mark, the radius of a round one.
const MARK: f64 = 4.5;

/// Root mean squares before and after over the noise floor; `None` where no noise floor is known.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis) -> Option<Drawing> {
    let shrinkage = &diagnosis.shrinkage;
    let all = (
        "all outputs".to_owned(),
        "u".to_owned(),
        shrinkage.all,
        Some(shrinkage.rms_after_interval),
    );
    let each = diagnosis.outputs.iter().zip(&shrinkage.outputs).map(
        |(named, shrunk): (&NamedQuantity, &Shrunk)| {
            (plain(&named.name), words::unit(&named.unit).unwrap_or_default(), *shrunk, None)
        },
    );
    let rows: Vec<_> = std::iter::once(all)
        .chain(each)
        .filter(|(_, _, shrunk, _)| shrunk.noise_floor > 0.0 && shrunk.noise_floor.is_finite())
        .collect();
    if rows.is_empty() {
        return None;
    }
    let ratios = |(_, _, shrunk, interval): &(String, String, Shrunk, Option<[f64; 2]>)| {
        let floor = shrunk.noise_floor;
        let ends = interval.unwrap_or([shrunk.rms_after; 2]);
        [shrunk.rms_before / floor, shrunk.rms_after / floor, ends[0] / floor, ends[1] / floor]
    };
    let values: Vec<f64> = rows.iter().flat_map(ratios).filter(|ratio| ratio.is_finite()).collect();
    let most = values.iter().copied().fold(1.0, f64::max);
    let least = values.iter().copied().filter(|ratio| *ratio > 0.0).fold(1.0, f64::min);
    let axis = if most > 10.0 {
        Axis::logarithmic(least.max(1e-3) / 1.25, most * 1.25)
    } else {
        Axis::linear(0.0, 1.08 * most)
    };
    let bottom = ROW * rows.len() as f64;
    // in their units, which stand in the table as well and give way where there is no room
    let figures: Vec<[String; 2]> = rows
        .iter()
        .map(|(_, unit, shrunk, _)| {
            let [before, after] = [shrunk.rms_before, shrunk.rms_after]
                .map(|value| digits::beside(value, shrunk.noise_floor));
            let alone = format!("{before} → {after}");
            [format!("{alone} {unit}").trim_end().to_owned(), alone]
        })
        .collect();
    let names = rows.iter().map(|(name, ..)| length(name, FONT)).fold(0.0, f64::max);
    let drawn = |width: f64| {
        let left = LEFT.min(names + BEFORE_STRIP);
        let right = |which: usize| {
            let lengths = figures.iter().map(|texts| length(&texts[which], FONT - 1.0));
            // digits are wider than the usual letter
            BESIDE + WIDER * lengths.fold(0.0, f64::max)
        };
        let which = usize::from(left + right(0) > CHROME * width);
        let strip = Strip { axis: &axis, from: left, to: width - right(which) };
        svg(width, bottom + STRIP_AXIS, |area| {
            strip.draw(area, 0.0, bottom, "root mean square residual / noise floor")?;
            let floor = strip.x(1.0);
            line(area, [(floor, 0.0), (floor, bottom)], stroke(INK, 1.5))?;
            for (row, (entry, texts)) in rows.iter().zip(&figures).enumerate() {
                let (name, _, _, interval) = entry;
                let y = ROW * (row as f64 + 0.5);
                strip.name(area, name, y)?;
                let [before, after, low, high] = ratios(entry);
                if interval.is_some() {
                    strip.interval(area, [low, high], y, (AFTER, &|end| significant(end, 2)))?;
                }
                let x = strip.x(before);
                let corners = [(px(x - MARK), px(y - MARK)), (px(x + MARK), px(y + MARK))];
                area.draw(&Rectangle::new(corners, BEFORE.filled()))?;
                area.draw(&Circle::new((px(strip.x(after)), px(y)), px(MARK), AFTER.filled()))?;
                strip.beside(area, &texts[which], f64::INFINITY, y)?;
            }
            Ok(())
        })
    };
    let caption = format!(
        "Root mean square residuals before (square) and after (dot, with its {} interval) the \
         correction, divided by the noise floor (vertical line). On the right: in their units, \
         all outputs together in standard uncertainties u. Each value was predicted by a fit \
         without its own block of conditions.",
        digits::percent(diagnosis.probability)
    );
    Some(Drawing::new(caption, drawn))
}
