//! Pairs of outputs: the first trials as dots, and the ellipse of the law of propagation.

use gumption_engine::number::elementary::{ln, sin_cos_turn};
use gumption_engine::propagate::gum;
use gumption_engine::task::Task;
use plotters::element::Circle;
use plotters::style::Color;

use crate::EvaluationReport;
use crate::html::Drawing;
use crate::number::exact;
use crate::plain;
use crate::plot::{Area, Axis, BEFORE, Drawn, Panel, WEAK, dashed, px, stroke, svg};
use crate::printed::grouped;
use crate::table::unit_text;
use gumption_engine::model::Quantity;

/// Numbers of outputs whose pairs are drawn.
const OUTPUTS: std::ops::RangeInclusive<usize> = 2..=4;

/// Maximum number of dots in all panels.
const MOST_DOTS: usize = 1200;

/// Height of a panel in pixels, and of a single one.
const TALL: f64 = 260.0;
const TALL_ALONE: f64 = 360.0;

/// Width from which panels are side by side.
const BESIDE: f64 = 500.0;

/// Corners of an ellipse.
const CORNERS: usize = 180;

/// Number of trials from which the pairs of outputs of an evaluation are drawn; 0 where its page has no
/// such figure.
pub fn trials_of_pairs(report: &EvaluationReport<'_>) -> u64 {
    match report.evaluation.rows.as_slice() {
        [row] if row.regions.is_empty() && OUTPUTS.contains(&row.outputs.len()) => MOST_DOTS as u64,
        _ => 0,
    }
}

/// A pair of outputs that both vary.
struct Pair<'a> {
    quantities: [&'a Quantity; 2],
    dots: Vec<(f64, f64)>,
    /// Empty where the law of propagation has no covariance.
    ellipse: Vec<(f64, f64)>,
    axes: [Axis; 2],
}

/// A panel for each pair of two to four outputs; `trials` are the values of each output in the first
/// trials of the row. `None` for other numbers of outputs, and where no two outputs vary.
pub(in crate::evaluation) fn scatter(
    task: &Task,
    (row, probability): (usize, f64),
    trials: &[Vec<f64>],
) -> Option<Drawing> {
    let count = trials.len();
    if !OUTPUTS.contains(&count) {
        return None;
    }
    let law = gum::evaluate(task, task.rows.get(row)?);
    let coefficients = law.correlations();
    let places = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
    let dots = MOST_DOTS / (count * (count - 1) / 2);
    let pair = |(place, [i, j]): (usize, [usize; 2])| {
        let [x, y] = [i, j].map(|output| &trials[output]);
        let dots = x.iter().copied().zip(y.iter().copied()).take(dots).collect::<Vec<_>>();
        let [a, b] = [i, j].map(|output| law.outputs.get(output).and_then(Option::as_ref));
        let ellipse = a.zip(b).zip(coefficients.get(place)).map(|((a, b), r)| {
            let ends = [a, b].map(|gum| (gum.estimate, gum.standard_uncertainty));
            ellipse(ends, *r, probability)
        });
        let ellipse = ellipse.unwrap_or_default();
        let all = || dots.iter().chain(&ellipse).copied();
        let axes = [Axis::around(all().map(|at| at.0))?, Axis::around(all().map(|at| at.1))?];
        let quantity = |output: usize| task.model.outputs.get(output).map(|of| &of.quantity);
        Some(Pair { quantities: [quantity(i)?, quantity(j)?], dots, ellipse, axes })
    };
    let pairs: Vec<Pair<'_>> = places.enumerate().filter_map(pair).collect();
    let shown = pairs.first()?.dots.len();
    let drawn = |width: f64| {
        let columns = if pairs.len() == 1 || width < BESIDE { 1 } else { 2 };
        let rows = pairs.len().div_ceil(columns);
        let tall = if pairs.len() == 1 && width >= BESIDE { TALL_ALONE } else { TALL };
        svg(width, tall * rows as f64, |area| {
            let areas = area.split_evenly((rows, columns));
            areas.iter().zip(&pairs).try_for_each(|(area, pair)| pair.draw(area))
        })
    };
    let dots = grouped(shown as u64);
    let law = match pairs.iter().any(|pair| !pair.ellipse.is_empty()) {
        true => format!(
            "; dashed: the ellipse that holds {} % of a normal distribution with the covariance by the \
             law of propagation",
            exact(100.0 * probability)
        ),
        false => String::new(),
    };
    let caption = format!("Pairs of outputs: the first {dots} Monte Carlo trials (dots){law}.");
    Some(Drawing::new(caption, drawn))
}

impl Pair<'_> {
    fn draw(&self, area: &Area<'_>) -> Drawn {
        let [x, y] = &self.axes;
        let [x_label, y_label] = self.quantities.map(label);
        let panel = Panel { x: (x, x_label), y: (y, y_label), marks: [6, 6], title: String::new() };
        let chart = panel.draw(area)?;
        let inside = chart.plotting_area();
        for place in &self.dots {
            inside.draw(&Circle::new(*place, px(1.5), WEAK.mix(0.6).filled()))?;
        }
        if self.ellipse.is_empty() {
            return Ok(());
        }
        inside.draw(&dashed(self.ellipse.clone(), stroke(BEFORE, 2.0)))
    }
}

/// Name and unit.
fn label(quantity: &Quantity) -> String {
    let name = plain(&quantity.name);
    if quantity.unit.has_name() { format!("{name} in {}", unit_text(&quantity.unit)) } else { name }
}

/// The ellipse about two estimates, with their standard uncertainties and correlation coefficient,
/// that holds a probability of the normal distribution: k^2 is the quantile of the chi-squared
/// distribution with two degrees of freedom, -2 ln(1 - p). Empty where nothing varies.
fn ellipse([(a, u_a), (b, u_b)]: [(f64, f64); 2], r: f64, probability: f64) -> Vec<(f64, f64)> {
    if !(u_a > 0.0 && u_b > 0.0 && r.abs() <= 1.0) {
        return Vec::new();
    }
    let k = (-2.0 * ln(1.0 - probability)).sqrt();
    let own = (1.0 - r * r).sqrt();
    let place = |corner: usize| {
        let (sin, cos) = sin_cos_turn(corner as f64 / CORNERS as f64);
        (a + k * u_a * cos, b + k * u_b * (r * cos + own * sin))
    };
    (0..=CORNERS).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The projections of the ellipse are the estimates plus and minus k u, and k is 2.4477 for 95 %
    /// (JCGM 102, 6.5.2, table 1).
    #[test]
    fn the_ellipse_reaches_k_u() {
        let corners = ellipse([(10.0, 2.0), (-1.0, 0.5)], 0.6, 0.95);
        let highest =
            |of: &dyn Fn(&(f64, f64)) -> f64| corners.iter().map(of).fold(f64::MIN, f64::max);
        assert!((highest(&|at| at.0) - (10.0 + 2.4477 * 2.0)).abs() < 1e-3);
        assert!((highest(&|at| at.1) - (-1.0 + 2.4477 * 0.5)).abs() < 1e-3);
        assert!(ellipse([(10.0, 0.0), (-1.0, 0.5)], f64::NAN, 0.95).is_empty());
    }
}
