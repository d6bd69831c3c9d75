//! A map of outputs and conditions that shows where the residuals are large, with the regions that
//! the scan named.

use plotters::element::{PathElement, Rectangle};
use plotters::style::{Color, RGBColor};

use super::super::residuals::levels;
use super::super::{digits, residuals, words};
use super::Drawing;
use crate::number::significant;
use crate::plain;
use crate::plot::{
    Anchor, Area, Drawn, FONT, INK, SHADES, Write, centred, line, px, shortened, stroke, svg, write,
};
use gumption_gap::{Diagnosis, GapRegion};

/// Heights in pixels: of a region's bracket, of an output, of what stands below a panel.
const BRACKET: f64 = 24.0;
const CELL: f64 = 26.0;
const BELOW: f64 = 46.0;

const LEFT: f64 = 120.0;
const RIGHT: f64 = 12.0;

/// So many cells stand beside each other at most, each of this width in pixels at least; more levels
/// are taken together.
const MOST: usize = 12;
const LEAST: f64 = 42.0;

/// Root mean squares of normalized residuals at which the shade changes.
const STEPS: [f64; 4] = [1.5, 3.0, 6.0, 12.0];

/// The levels of one condition, in cells.
struct Panel<'a> {
    name: String,
    levels: Vec<f64>,
    /// Places of the first level of each cell, and the number of levels.
    edges: Vec<usize>,
    /// Regions in this condition, with their letters.
    regions: Vec<(String, &'a GapRegion)>,
    condition: usize,
    /// Where cells begin and end, in pixels.
    ends: [f64; 2],
}

impl<'a> Panel<'a> {
    fn new(diagnosis: &'a Diagnosis, condition: usize, first: bool, width: f64) -> Self {
        let levels = levels(diagnosis, condition);
        let ends_of_cells = [LEFT.min(0.25 * width), width - RIGHT];
        let [from, to] = ends_of_cells;
        let most = MOST.min(((to - from) / LEAST) as usize).max(1);
        let size = levels.len().div_ceil(most).max(1);
        let mut edges: Vec<usize> = (0..levels.len()).step_by(size).collect();
        edges.push(levels.len());
        let own = |region: &GapRegion| match region.range {
            Some((place, _)) => place == condition,
            // what is about no condition stands in the first panel
            None => first,
        };
        let regions = diagnosis.regions.iter().enumerate();
        let regions: Vec<(String, &GapRegion)> = regions
            .filter(|(_, region)| own(region))
            .map(|(place, region)| (words::letter(place), region))
            .collect();
        // a frame runs between cells and not through one
        let ends = regions.iter().flat_map(|(_, region)| places(&levels, region));
        for end in ends.filter(|end| *end < levels.len()) {
            let last = edges.len() - 1;
            let nearest = (1..last).min_by_key(|&edge| edges[edge].abs_diff(end));
            if let Some(edge) = nearest.filter(|_| !edges.contains(&end)) {
                edges[edge] = end;
            }
        }
        edges.sort_unstable();
        let name = words::axis(&diagnosis.conditions[condition]);
        Self { name, levels, edges, regions, condition, ends: ends_of_cells }
    }

    fn height(&self, outputs: usize) -> f64 {
        BRACKET * self.regions.len() as f64 + CELL * outputs as f64 + BELOW
    }

    /// Where a level begins, in pixels.
    fn x(&self, place: usize) -> f64 {
        let [from, to] = self.ends;
        from + place as f64 / self.levels.len() as f64 * (to - from)
    }

    /// Where a region begins and ends.
    fn span(&self, region: &GapRegion) -> [f64; 2] {
        places(&self.levels, region).map(|place| self.x(place))
    }

    /// Root mean square of the normalized residuals in a cell.
    fn rms(&self, diagnosis: &Diagnosis, output: usize, from: usize, to: usize) -> Option<f64> {
        let (low, high) = (self.levels[from], self.levels[to - 1]);
        let over = residuals::Over::Condition(self.condition);
        let squares: Vec<f64> = residuals::of(diagnosis, output, over)
            .into_iter()
            .filter(|residual| (low..=high).contains(&residual.x) && residual.before.1 > 0.0)
            .map(|residual| (residual.before.0 / residual.before.1).powi(2))
            .collect();
        (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
    }
}

/// The places of a region's first level and of the level after its last.
fn places(levels: &[f64], region: &GapRegion) -> [usize; 2] {
    let [low, high] = region.range.map_or([f64::NEG_INFINITY, f64::INFINITY], |(_, r)| r);
    let first = levels.partition_point(|level| *level < low);
    [first, levels.partition_point(|level| *level <= high).max(first + 1)]
}

/// A panel for each condition that varies; `None` where none does.
pub(in crate::gap) fn draw(diagnosis: &Diagnosis) -> Option<Drawing> {
    let varying = residuals::varying(diagnosis);
    if varying.is_empty() {
        return None;
    }
    let outputs = diagnosis.outputs.len();
    let drawn = |width: f64| {
        let panels: Vec<Panel<'_>> = varying
            .iter()
            .enumerate()
            .map(|(number, &condition)| Panel::new(diagnosis, condition, number == 0, width))
            .collect();
        let total = panels.iter().map(|panel| panel.height(outputs)).sum();
        svg(width, total, |area| {
            let mut top = 0.0;
            for panel in &panels {
                one(area, diagnosis, panel, top)?;
                top += panel.height(outputs);
            }
            Ok(())
        })
    };
    let mut caption =
        "Location of the gap: root mean square of the residuals before the correction, divided by \
                       their standard uncertainties, by output and condition; about 1 is expected \
                       without a gap."
            .to_owned();
    if !diagnosis.regions.is_empty() {
        caption.push_str(
            " Frames: notable regions, with the probability p of an equally surprising region \
             anywhere in data without a gap.",
        );
    }
    Some(Drawing::new(caption, drawn))
}

fn one(area: &Area<'_>, diagnosis: &Diagnosis, panel: &Panel<'_>, top: f64) -> Drawn {
    let outputs = diagnosis.outputs.len();
    let cells = top + BRACKET * panel.regions.len() as f64;
    let bottom = cells + CELL * outputs as f64;
    for (output, named) in diagnosis.outputs.iter().enumerate() {
        let y = cells + CELL * output as f64;
        let [left, _] = panel.ends;
        let how = Write { anchor: Anchor::End, ..centred((left - 8.0, y + 0.5 * CELL), FONT) };
        write(area, &shortened(&plain(&named.name), left - 12.0, FONT), how)?;
        for edge in panel.edges.windows(2) {
            let place = [(panel.x(edge[0]), y), (panel.x(edge[1]), y + CELL)];
            cell(area, place, panel.rms(diagnosis, output, edge[0], edge[1]))?;
        }
    }
    marks(area, panel, bottom)?;
    for (row, (letter, region)) in panel.regions.iter().enumerate() {
        let [from, to] = panel.span(region);
        let rows = match region.output {
            Some(output) => [cells + CELL * output as f64, cells + CELL * (output + 1) as f64],
            None => [cells, bottom],
        };
        frame(area, [from, to], rows)?;
        let y = top + BRACKET * row as f64;
        let text = format!("{letter}: {}", digits::p_equals(region.p_value));
        bracket(area, [from, to], y, (&text, panel.ends[1]))?;
    }
    Ok(())
}

fn cell(area: &Area<'_>, [(x0, y0), (x1, y1)]: [(f64, f64); 2], rms: Option<f64>) -> Drawn {
    let Some(rms) = rms else { return Ok(()) };
    let (fill, text) = shade(rms);
    let inset = 0.5;
    let corners = [(px(x0 + inset), px(y0 + inset)), (px(x1 - inset), px(y1 - inset))];
    area.draw(&Rectangle::new(corners, fill.filled()))?;
    let how = centred((0.5 * (x0 + x1), 0.5 * (y0 + y1)), FONT - 1.0);
    write(area, &significant(rms, 2), Write { colour: text, ..how })
}

fn shade(rms: f64) -> (RGBColor, RGBColor) {
    SHADES[STEPS.iter().take_while(|step| rms >= **step).count()]
}

/// The levels below the cells; of cells with several the first one.
fn marks(area: &Area<'_>, panel: &Panel<'_>, bottom: f64) -> Drawn {
    let room = (panel.x(panel.edges[1]) - panel.x(0)) - 4.0;
    let grouped = panel.edges.len() - 1 < panel.levels.len();
    for edge in panel.edges.windows(2) {
        let text = digits::condition(panel.levels[edge[0]]);
        let x =
            if grouped { panel.x(edge[0]) } else { 0.5 * (panel.x(edge[0]) + panel.x(edge[1])) };
        let anchor = if grouped { Anchor::Start } else { Anchor::Middle };
        if grouped {
            line(area, [(x, bottom), (x, bottom + 4.0)], stroke(INK, 0.75))?;
        }
        let how = Write { anchor, ..centred((x, bottom + 11.0), FONT - 2.0) };
        write(area, &shortened(&text, room, FONT - 2.0), how)?;
    }
    let [from, to] = panel.ends;
    let middle = 0.5 * (from + to);
    let name = if grouped {
        format!("{} (from the value below each cell's left end)", panel.name)
    } else {
        panel.name.clone()
    };
    write(area, &shortened(&name, to - from, FONT), centred((middle, bottom + 27.0), FONT))
}

fn frame(area: &Area<'_>, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Drawn {
    let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0), (x1, y0)];
    let places = corners.map(|(x, y)| (px(x), px(y))).to_vec();
    area.draw(&PathElement::new(places, stroke(INK, 2.5)))
}

/// A line over the range of a region, with its letter and probability, which end at `end` at most.
fn bracket(area: &Area<'_>, [from, to]: [f64; 2], top: f64, (text, end): (&str, f64)) -> Drawn {
    let y = top + BRACKET - 5.0;
    line(area, [(from, y + 4.0), (from, y), (to, y), (to, y + 4.0)], stroke(INK, 1.25))?;
    // about 0.58 of its size for each letter
    let width = 0.58 * FONT * text.chars().count() as f64;
    let fits = from + width < end;
    let (x, anchor) = if fits { (from, Anchor::Start) } else { (to, Anchor::End) };
    let how = Write { anchor, ..centred((x, top + 10.0), FONT - 1.0) };
    write(area, text, Write { bold: true, ..how })
}
