//! The worksheet of the distributions: for each output the density of its trials, that which the GUM
//! gives, and a figure of both.

use rust_xlsxwriter::{Chart, ChartType, XlsxError};

use super::Shown;
use super::inputs::Places;
use crate::number::position;
use crate::workbook::{Leaf, Look};
use crate::{EvaluationReport, plain};

/// Columns and rows of an output, and the width and height of its figure in pixels.
const WIDE: u16 = 12;
const TOP: u32 = 2;
const SIZE: (u32, u32) = (640, 360);

/// Labels of the axis of values, about.
const LABELS: usize = 8;

/// Digits of densities.
const DIGITS: u32 = 4;

/// Writes the outputs whose histograms are known; whether there was one.
pub(super) fn write(
    leaf: &mut Leaf,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    inputs: &Places,
) -> Result<bool, XlsxError> {
    let EvaluationReport { task, evaluation, .. } = *report;
    let Some(row) = evaluation.rows.first() else { return Ok(false) };
    let mut first = 0;
    for (output, declared) in task.model.outputs.iter().enumerate() {
        let Some(histogram) = shown.histogram(0, output) else { continue };
        let gum = row.outputs.get(output).and_then(|found| found.gum.as_ref());
        let name = plain(&declared.quantity.name);
        let unit = plain(declared.quantity.unit.text());
        let value = if unit.trim() == "1" { name.clone() } else { format!("{name} in {unit}") };
        leaf.headers_from((TOP, first), [value.as_str(), "density, Monte Carlo", "density, GUM"])?;
        let most = histogram.densities().fold(0.0, f64::max);
        let (place, shown_density) = (position(histogram.width, 2), position(most, DIGITS));
        let mut at = TOP + 1;
        for (bin, density) in histogram.densities().enumerate() {
            let centre = histogram.low + (bin as f64 + 0.5) * histogram.width;
            leaf.number((at, first), centre, place, Look::Plain)?;
            leaf.number((at, first + 1), density, shown_density, Look::Plain)?;
            if let Some(density) = gum.and_then(|gum| gum.density(centre)) {
                leaf.number((at, first + 2), density, shown_density, Look::Plain)?;
            }
            at += 1;
        }
        let range = |column: u16| leaf.range((TOP + 1, first + column), (at - 1, first + column));
        let mut chart = Chart::new(ChartType::Column);
        chart
            .add_series()
            .set_name("Monte Carlo")
            .set_categories(range(0).as_str())
            .set_values(range(1).as_str())
            .set_gap(0);
        if gum.is_some_and(|gum| gum.density(gum.estimate).is_some()) {
            let mut line = Chart::new(ChartType::Line);
            line.add_series()
                .set_name("GUM")
                .set_categories(range(0).as_str())
                .set_values(range(2).as_str());
            chart.combine(&line);
        }
        chart.title().set_name(&value);
        let decimals = place.map_or(0, |place| (-place).max(0)) as usize;
        let format =
            if decimals > 0 { format!("0.{}", "0".repeat(decimals)) } else { "0".to_owned() };
        let every = u16::try_from(histogram.counts.len() / LABELS).unwrap_or(1).max(1);
        chart.x_axis().set_name(&value).set_num_format(format);
        chart.x_axis().set_label_interval(every).set_tick_interval(every);
        chart.y_axis().set_name("density");
        chart.set_width(SIZE.0).set_height(SIZE.1);
        leaf.chart((TOP, first + 4), &chart)?;
        first += WIDE + 3;
    }
    if first > 0 {
        inputs.marked(leaf, (0, 0), "Distributions")?;
    }
    Ok(first > 0)
}
