//! Two outputs: trials, and the ellipse and the box of both methods.

use crate::table::unit_text;
use plotters::element::{Circle, PathElement};
use plotters::style::Color;

use crate::html::Drawing;
use crate::plain;
use crate::plot::{AFTER, Axis, BEFORE, Panel, WEAK, dashed, px, stroke, svg};
use gumption_engine::number::elementary::sin_cos_turn;
use gumption_engine::propagate::{JointRegion, RegionEvaluation};
use gumption_engine::task::Task;

/// Height in pixels.
const TALL: f64 = 420.0;

/// Corners of an ellipse as it is drawn.
const CORNERS: usize = 180;

/// The figure of a region of two outputs; `None` of more.
pub(super) fn draw(task: &Task, region: &RegionEvaluation) -> Option<Drawing> {
    let &[first, second] = region.outputs.as_slice() else { return None };
    let quantities =
        [first, second].map(|output| task.model.outputs.get(output).map(|o| &o.quantity));
    let [Some(a), Some(b)] = quantities else { return None };
    let found = region.monte_carlo.as_ref();
    let sample: Vec<(f64, f64)> = match found.map(|found| found.sample.as_slice()) {
        Some([x, y]) => x.iter().copied().zip(y.iter().copied()).collect(),
        _ => Vec::new(),
    };
    // the dashed one is above, so that both are seen where they agree
    let of_trials = found.map(|found| (&found.region, false, AFTER));
    let of_law = region.gum.as_ref().map(|gum| (gum, true, BEFORE));
    let outlines: Vec<Outline> = [of_trials, of_law]
        .into_iter()
        .flatten()
        .filter_map(|(of, is_dashed, colour)| {
            Some(Outline { ellipse: ellipse(of)?, corners: corners(of), is_dashed, colour })
        })
        .collect();
    if outlines.is_empty() {
        return None;
    }
    let places = || {
        let lines = outlines.iter().flat_map(|o| o.ellipse.iter().chain(&o.corners));
        lines.chain(&sample).copied()
    };
    let x = Axis::around(places().map(|place| place.0))?;
    let y = Axis::around(places().map(|place| place.1))?;
    let label = |quantity: &gumption_engine::model::Quantity| match unit_text(&quantity.unit).trim()
    {
        "" | "1" => plain(&quantity.name),
        text => format!("{} in {}", plain(&quantity.name), plain(text)),
    };
    let drawn = |width: f64| {
        svg(width, TALL, |area| {
            let panel =
                Panel { x: (&x, label(a)), y: (&y, label(b)), marks: [8, 8], title: String::new() };
            let chart = panel.draw(area)?;
            let chart = chart.plotting_area();
            for place in &sample {
                chart.draw(&Circle::new(*place, px(1.0), WEAK.mix(0.5).filled()))?;
            }
            for Outline { ellipse, corners, is_dashed, colour } in &outlines {
                for (path, width) in [(ellipse, 2.0), (corners, 1.0)] {
                    let style = stroke(*colour, width);
                    match is_dashed {
                        true => chart.draw(&dashed(path.clone(), style))?,
                        false => chart.draw(&PathElement::new(path.clone(), style))?,
                    }
                }
            }
            Ok(())
        })
    };
    let trials = if sample.is_empty() { "" } else { " Dots are some of the trials." };
    let caption = format!(
        "Coverage ellipse and box by the law of propagation (vermilion, dashed) and from the trials (blue).{trials}"
    );
    Some(Drawing::new(caption, drawn))
}

struct Outline {
    ellipse: Vec<(f64, f64)>,
    corners: Vec<(f64, f64)>,
    is_dashed: bool,
    colour: plotters::style::RGBColor,
}

/// The ellipse: the root of the covariance matrix times a circle of radius k.
fn ellipse(of: &JointRegion) -> Option<Vec<(f64, f64)>> {
    let k = of.ellipsoid_k?;
    let (&[a, b], &[aa, ab, _, bb]) = (of.estimates.as_slice(), of.covariance.as_slice()) else {
        return None;
    };
    let first = aa.sqrt();
    let common = ab / first;
    let own = (bb - common * common).max(0.0).sqrt();
    let place = |corner: usize| {
        let (sin, cos) = sin_cos_turn(corner as f64 / CORNERS as f64);
        (a + k * first * cos, b + k * (common * cos + own * sin))
    };
    Some((0..=CORNERS).map(place).collect())
}

fn corners(of: &JointRegion) -> Vec<(f64, f64)> {
    let (&[a, b], &[aa, _, _, bb]) = (of.estimates.as_slice(), of.covariance.as_slice()) else {
        return Vec::new();
    };
    let Some(k) = of.box_k else { return Vec::new() };
    let (da, db) = (k * aa.sqrt(), k * bb.sqrt());
    vec![(a - da, b - db), (a + da, b - db), (a + da, b + db), (a - da, b + db), (a - da, b - db)]
}
