//! A corrected record with its band, and its standard uncertainty over time.

use plotters::element::{PathElement, Polygon};
use plotters::style::Color;

use super::{FACTOR, WaveformReport};
use crate::html::Drawing;
use crate::plain;
use crate::plot::{AFTER, Axis, BEFORE, Chart, Drawn, EVEN, INK, Panel, px, stroke, svg};
use crate::printed::grouped;
use gumption_signal::{TRACE_COLUMNS, Waveform, WaveformChannel};

/// Heights of the panels in pixels.
const VALUES: f64 = 250.0;
const UNCERTAINTIES: f64 = 170.0;

/// The least and the greatest of several lines in a column of samples.
struct Column {
    instant: f64,
    /// The least and the greatest value with their instants, in the order of these.
    values: [(f64, f64); 2],
    band: [f64; 2],
    u: f64,
    of_trials: f64,
}

/// The figure; none where there is nothing to see.
pub(super) fn of(
    found: &WaveformReport<'_>,
    channel: &WaveformChannel,
    of: &Waveform,
) -> Option<Drawing> {
    let n = of.signal.values.len();
    let each = n.div_ceil(2 * TRACE_COLUMNS).max(1);
    let columns: Vec<Column> = (0..n).step_by(each).map(|first| column(of, first, each)).collect();
    let unit = found.unit(channel.channel);
    let label =
        |what: &str| if unit == "1" { what.to_owned() } else { format!("{what} in {unit}") };
    let (from, to) = (columns.first()?.instant, of.signal.instant(n as f64 - 1.0));
    let x = if to > from { Axis::linear(from, to) } else { return None };
    let values = Axis::around(columns.iter().flat_map(|of| of.band))?;
    let has_trials = of.trials.is_some();
    let most = columns.iter().map(|of| of.u.max(of.of_trials)).fold(0.0, f64::max);
    let uncertainties = Axis::linear(0.0, if most > 0.0 { 1.1 * most } else { 1.0 });
    let (values_label, u_label) = (label("value"), label("u"));
    let drawn = move |width: f64| {
        svg(width, VALUES + UNCERTAINTIES, |area| {
            let (top, bottom) = area.split_vertically(px(VALUES));
            let panel = |y: &Axis, label: &str, area| {
                let x = (&x, "t in s".to_owned());
                Panel { x, y: (y, label.to_owned()), marks: [6, 5], title: String::new() }
                    .draw(area)
            };
            let chart = panel(&values, &values_label, &top)?;
            band(&chart, &columns)?;
            line(&chart, columns.iter().flat_map(|of| of.values), INK)?;
            let chart = panel(&uncertainties, &u_label, &bottom)?;
            if has_trials {
                line(&chart, columns.iter().map(|of| (of.instant, of.of_trials)), BEFORE)?;
            }
            line(&chart, columns.iter().map(|of| (of.instant, of.u)), AFTER)
        })
    };
    let trials = if has_trials { " (blue) and of the trials (orange)" } else { "" };
    let thinned = match each {
        1 => String::new(),
        several => format!(" Least and greatest of each {} samples.", grouped(several as u64)),
    };
    let caption = format!(
        "{}: the corrected signal with its band of 95 % at each instant, {FACTOR:.2} u to both sides; below, the standard \
         uncertainty by the law of propagation{trials}.{thinned}",
        plain(&channel.name)
    );
    Some(Drawing::new(caption, drawn))
}

fn column(of: &Waveform, first: usize, each: usize) -> Column {
    let last = (first + each).min(of.signal.values.len());
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
    };
    let own = || of.signal.values[first..last].iter().zip(&of.standard_uncertainties[first..last]);
    let [low, _] = range(&mut own().map(|(x, u)| x - FACTOR * u));
    let [_, high] = range(&mut own().map(|(x, u)| x + FACTOR * u));
    let order = |a: &usize, b: &usize| of.signal.values[*a].total_cmp(&of.signal.values[*b]);
    let [least, greatest] = [(first..last).min_by(order), (first..last).max_by(order)];
    let mut places = [least.unwrap_or(first), greatest.unwrap_or(first)];
    places.sort_unstable();
    let values = places.map(|at| (of.signal.instant(at as f64), of.signal.values[at]));
    let of_trials = of.trials.as_ref().and_then(|of| of.standard_uncertainties.get(first..last));
    Column {
        instant: of.signal.instant(0.5 * (first + last - 1) as f64),
        values,
        band: [low, high],
        u: own().map(|(_, u)| *u).fold(0.0, f64::max),
        of_trials: of_trials.map_or(0.0, |all| all.iter().copied().fold(0.0, f64::max)),
    }
}

fn band(chart: &Chart<'_>, columns: &[Column]) -> Drawn {
    let high = columns.iter().map(|of| (of.instant, of.band[1]));
    let low = columns.iter().rev().map(|of| (of.instant, of.band[0]));
    let corners: Vec<(f64, f64)> = high.chain(low).collect();
    chart.plotting_area().draw(&Polygon::new(corners, EVEN.mix(0.45).filled()))
}

fn line(
    chart: &Chart<'_>,
    points: impl Iterator<Item = (f64, f64)>,
    colour: plotters::style::RGBColor,
) -> Drawn {
    chart.plotting_area().draw(&PathElement::new(points.collect::<Vec<_>>(), stroke(colour, 1.0)))
}
