//! The distribution of an output: its trials, the density that the GUM gives it, and the coverage
//! intervals of both.

use crate::table::unit_text;
use plotters::element::{Circle, Rectangle};
use plotters::style::{Color, RGBColor};

use super::curve;
use crate::html::Drawing;
use crate::number::{exact, position, significant, to};
use crate::plot::{
    AFTER, Anchor, Area, Axis, BEFORE, Drawn, EVEN, FAINT, FONT, INK, Layer, STRIP_AXIS, Strip,
    Titles, Write, centred, faded, line, px, shortened, stroke, svg_in_layers, write,
};
use crate::printed::grouped;
use crate::table::{in_unit, title_text};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::Histogram;
use gumption_units::Unit;

/// Methods that found what a layer shows, as the columns of tables have them.
const GUM: &str = "GUM";
const TRIALS: &str = "Monte Carlo";

/// The row of what the file states.
const STATED: &str = "tolerance";

/// Heights in pixels: of the densities, and of a row with an interval.
const TALL: f64 = 230.0;
const ROW: f64 = 22.0;

/// Space for names, and on the right.
const LEFT: f64 = 185.0;
const RIGHT: f64 = 20.0;

/// Space for the numbers of the axis of densities, beside the names.
const NUMBERS: f64 = 38.0;

/// Free space beyond a limit, as a share of what the trials span.
const EDGE: f64 = 0.06;

/// Points of the GUM's density.
const POINTS: usize = 300;

/// Half of the height of a number, in pixels.
const HALF_A_NUMBER: f64 = 7.0;

/// Marks of the axis of densities, at most.
const DENSITIES: usize = 4;

/// What stands below the density: its name, its ends, infinite where it has none, its estimate, and
/// its colour.
struct IntervalRow {
    /// The method that found it; none for what the file states.
    method: Option<&'static str>,
    name: &'static str,
    ends: [f64; 2],
    estimate: Option<f64>,
    colour: RGBColor,
}

/// The histogram with the GUM's density over it, and below them the intervals, the tolerance and what
/// is accepted; `None` without figures.
pub(in crate::evaluation) fn distribution(
    output: &Quantity,
    found: &OutputEvaluation,
    histogram: &Histogram,
    probability: f64,
) -> Option<Drawing> {
    let figures = found.monte_carlo.as_deref()?;
    let gum = found.gum.as_ref();
    let (low, high) = (histogram.low, histogram.high());
    let place = |share: f64| low + share * (high - low);
    let density: Vec<(f64, f64)> = (0..=POINTS)
        .map(|point| place(point as f64 / POINTS as f64))
        .filter_map(|x| Some((x, gum?.density(x)?)))
        .collect();
    let highest = histogram.densities().fold(0.0, f64::max);
    // a GUM density much narrower than the trials is cut off
    let top = density.iter().map(|point| point.1).fold(highest, f64::max).min(3.0 * highest) * 1.06;
    let y = |density: f64| TALL * (1.0 - (density / top).min(1.0));
    let mut rows = Vec::new();
    let mut row = |(method, name), ends: Option<[f64; 2]>, estimate, colour| {
        rows.extend(ends.map(|ends| IntervalRow { method, name, ends, estimate, colour }));
    };
    row((Some(GUM), "GUM"), gum.and_then(Gum::interval), gum.map(|gum| gum.estimate), INK);
    let trials = found.located().map(|(value, _)| value);
    let (symmetric, shortest) = ("Monte Carlo, symmetric", "Monte Carlo, shortest");
    row((Some(TRIALS), symmetric), Some(figures.symmetric_interval), trials, AFTER);
    row((Some(TRIALS), shortest), Some(figures.shortest_interval), trials, AFTER);
    if let Some(conformity) = &found.conformity {
        row((None, STATED), Some(conformity.tolerance.ends()), None, BEFORE);
        let accepted = conformity.acceptance.filter(|_| conformity.is_guarded());
        row((None, "acceptance"), accepted.map(|limits| limits.ends()), None, BEFORE);
    }
    let axis = axis(low, high, rows.iter().flat_map(|row| row.ends));
    let bottom = TALL + 6.0 + ROW * rows.len() as f64;
    let drawn = |width: f64| {
        let strip = Strip::within(&axis, width, [LEFT, RIGHT]);
        let ground = |area: &Area<'_>, _: &mut Titles| -> Drawn {
            let label = title_text(&Quantity { about: String::new(), ..output.clone() });
            strip.draw(area, 0.0, bottom, &label)?;
            for (position, text) in Axis::linear(0.0, top).marks(DENSITIES) {
                let at = y(position);
                line(area, [(strip.from, at), (strip.to, at)], stroke(FAINT, 0.75))?;
                // a number at the upper edge would be cut
                if position > 0.0 && at > HALF_A_NUMBER {
                    strip.name(area, &text, at)?;
                }
            }
            density_legend(area, strip.from, &output.unit)
        };
        let of_rows = |method: Option<&'static str>, area: &Area<'_>, titles: &mut Titles| {
            let own = rows.iter().enumerate().filter(|(_, row)| row.method == method);
            own.clone().try_for_each(|(number, row)| {
                let at = TALL + 6.0 + ROW * (number as f64 + 0.5);
                row.draw((&strip, &output.unit), area, titles, at)
            })
        };
        let of_trials = |area: &Area<'_>, titles: &mut Titles| -> Drawn {
            for (bin, density) in histogram.densities().enumerate() {
                if density > 0.0 {
                    let ends = [bin, bin + 1].map(|end| low + end as f64 * histogram.width);
                    let [from, to] = ends.map(|end| strip.x(end));
                    let corners = [(px(from), px(y(density))), (px(to), px(TALL))];
                    area.draw(&Rectangle::new(corners, EVEN.filled()))?;
                    let share = significant(100.0 * density * histogram.width, 2);
                    let said = format!("{}: {share} % of the trials", range(ends, &output.unit));
                    titles.at_pixels((0.5 * (from + to), y(density)), &said);
                }
            }
            trials_legend(area, strip.from)?;
            of_rows(Some(TRIALS), area, titles)
        };
        let of_file = |area: &Area<'_>, titles: &mut Titles| -> Drawn {
            line(area, [(strip.from, TALL), (strip.to, TALL)], stroke(INK, 0.75))?;
            of_rows(None, area, titles)
        };
        let of_law = |area: &Area<'_>, titles: &mut Titles| -> Drawn {
            let places: Vec<(f64, f64)> =
                density.iter().map(|&(x, d)| (strip.x(x), y(d))).collect();
            curve(area, &places, stroke(INK, 2.0))?;
            law_legend(area, gum.filter(|_| !density.is_empty()), strip.from)?;
            of_rows(Some(GUM), area, titles)
        };
        let layers: [Layer<'_>; 4] =
            [(None, &ground), (Some(TRIALS), &of_trials), (None, &of_file), (Some(GUM), &of_law)];
        svg_in_layers(width, bottom + STRIP_AXIS, &layers)
    };
    let trials = grouped(histogram.trials());
    let first = if histogram.trials() < figures.trials { "first " } else { "" };
    let line = if density.is_empty() { "" } else { ", the density that the GUM gives (line)" };
    let percent = exact(100.0 * probability);
    let limits = match found.conformity.as_ref().map(|of| of.is_guarded()) {
        None => "",
        Some(false) => "; below them the tolerance",
        Some(true) => "; below them the tolerance and the limits of acceptance",
    };
    let caption = format!(
        "The {first}{trials} Monte Carlo trials (bars){line} and the coverage intervals for {percent} % \
         with the estimates (dots){limits}."
    );
    Some(Drawing::new(caption, drawn))
}

/// The axis over the trials, and over limits that lie no further from them than the trials reach.
fn axis(low: f64, high: f64, ends: impl Iterator<Item = f64>) -> Axis {
    let span = high - low;
    let near = (low - span)..=(high + span);
    let [from, to] = ends
        .filter(|end| near.contains(end))
        .map(|end| [end - EDGE * span, end + EDGE * span])
        .fold([low, high], |[from, to], [a, b]| [from.min(a), to.max(b)]);
    Axis::linear(from, to)
}

impl IntervalRow {
    /// Draws it at a height in pixels.
    fn draw(
        &self,
        (strip, unit): (&Strip<'_>, &Unit),
        area: &Area<'_>,
        titles: &mut Titles,
        at: f64,
    ) -> Drawn {
        strip.name(area, self.name, at)?;
        // what the file states is shown as it is stated, the rest to what can be told apart here
        let [first, last] = strip.axis.ends();
        let place = position(last - first, 3);
        let number = |end: f64| if self.name == STATED { exact(end) } else { to(end, place) };
        strip.interval(area, self.ends, at, (self.colour, &number))?;
        let said = format!("{}: {}", self.name, range(self.ends, unit));
        for end in self.ends.into_iter().filter(|end| end.is_finite()) {
            let x = strip.x(end);
            if strip.holds(end) {
                line(area, [(x, at), (x, 0.35 * TALL)], faded(self.colour, 0.55, 0.75))?;
            }
            titles.at_pixels((x, at), &said);
        }
        // the estimate of an interval beyond an end is beyond it as well
        if let Some(estimate) = self.estimate.filter(|estimate| strip.holds(*estimate)) {
            let place = (px(strip.x(estimate)), px(at));
            area.draw(&Circle::new(place, px(3.5), self.colour.filled()))?;
            titles.at_pixels((strip.x(estimate), at), &said);
        }
        Ok(())
    }
}

/// Ends of a range in words, told apart to a hundredth of it.
fn range([low, high]: [f64; 2], unit: &Unit) -> String {
    let place = position(high - low, 3);
    let text = |end: f64| if end.is_finite() { to(end, place) } else { exact(end) };
    match (low.is_finite(), high.is_finite()) {
        (false, true) => format!("up to {}", in_unit(&exact(high), unit)),
        (true, false) => format!("from {} on", in_unit(&exact(low), unit)),
        _ => format!("{} to {}", text(low), in_unit(&text(high), unit)),
    }
}

/// A text of the legend, left of a place.
fn said(area: &Area<'_>, text: &str, (from, y): (f64, f64), room: f64) -> Drawn {
    let how = Write { anchor: Anchor::Start, ..centred((from, y), FONT) };
    write(area, &shortened(text, room - from - NUMBERS, FONT), how)
}

/// What the bars are.
fn trials_legend(area: &Area<'_>, room: f64) -> Drawn {
    let corners = [(px(14.0), px(14.0)), (px(34.0), px(26.0))];
    area.draw(&Rectangle::new(corners, EVEN.filled()))?;
    said(area, "Monte Carlo", (42.0, 20.0), room)
}

/// What the line is.
fn law_legend(area: &Area<'_>, gum: Option<&Gum>, room: f64) -> Drawn {
    let shape = match gum.map(|gum| gum.dof) {
        Some(Dof::Infinite) => "GUM: normal",
        Some(Dof::Finite(_)) => "GUM: t",
        _ => return Ok(()),
    };
    line(area, [(14.0, 42.0), (34.0, 42.0)], stroke(INK, 2.0))?;
    said(area, shape, (42.0, 42.0), room)
}

/// What the axis of densities is.
fn density_legend(area: &Area<'_>, room: f64, unit: &Unit) -> Drawn {
    said(area, "density", (14.0, 64.0), room)?;
    if unit.has_name() {
        let unit = unit_text(unit);
        let is_one = unit.chars().all(|c| c.is_alphanumeric());
        let unit = if is_one { unit } else { format!("({unit})") };
        said(area, &format!("in 1/{unit}"), (14.0, 80.0), room)?;
    }
    Ok(())
}
