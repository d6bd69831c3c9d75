//! How the figures of the Monte Carlo method settle with the number of trials.

use plotters::element::{PathElement, Polygon};
use plotters::style::Color;

use crate::html::Drawing;
use crate::number::with_uncertainty;
use crate::plain;
use crate::plot::{
    AFTER, Area, Axis, Chart, Drawn, EVEN, Fill, INK, Panel, Titles, mark, stroke, svg_with_titles,
};
use crate::printed::grouped;
use crate::table::in_unit;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::monte_carlo::MonteCarlo;

/// Height of a panel in pixels.
const TALL: f64 = 185.0;

/// Width from which panels stand beside each other.
const BESIDE: f64 = 500.0;

/// A figure at a number of trials.
#[derive(Clone, Copy)]
struct Stage {
    trials: u64,
    value: f64,
    /// Its numerical standard error; NaN where the trials do not tell.
    error: f64,
}

/// A figure and how it settled, the last stage being that of all trials.
struct Settling {
    name: &'static str,
    stages: Vec<Stage>,
}

/// A panel for each of estimate, standard uncertainty and ends of the stated interval: how far the
/// figures of fewer trials are from those of all. `None` with fewer than two stages, and where nothing
/// varies.
pub(in crate::evaluation) fn convergence(
    output: &Quantity,
    stages: &[MonteCarlo],
) -> Option<Drawing> {
    let last = stages.last().filter(|_| stages.len() > 1)?;
    let shortest = last.stated_interval().shortest;
    // without a standard deviation half of the interval says what is large
    let (size, unit) = match last.standard_uncertainty {
        Some(u) => (u, "u"),
        None => {
            let [low, high] = last.stated_interval().ends;
            ((high - low) / 2.0, "half the interval")
        }
    };
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    let settlings = settlings(stages, shortest);
    let share = |stage: &Stage, of: &Settling| {
        let whole = of.stages.last().map_or(f64::NAN, |last| last.value);
        100.0 * (stage.value - whole) / size
    };
    let error = |stage: &Stage| Some(100.0 * stage.error / size).filter(|error| error.is_finite());
    let reach = settlings.iter().flat_map(|of| of.stages.iter().map(move |stage| (of, stage)));
    let reach = reach.map(|(of, stage)| share(stage, of).abs() + error(stage).unwrap_or(0.0));
    let y = Axis::about_zero(reach);
    let trials = |stage: &MonteCarlo| stage.trials as f64;
    let (first, whole) = (trials(stages.first()?), trials(last));
    let x = Axis::logarithmic(first / 1.25, whole * 1.25);
    let panel = |area: &Area<'_>, titles: &mut Titles, of: &Settling| -> Drawn {
        let chart = Panel {
            x: (&x, "trials".to_owned()),
            y: (&y, format!("in % of {unit}")),
            marks: [5, 5],
            title: of.name.to_owned(),
        }
        .draw(area)?;
        let at = |stage: &Stage| x.position(stage.trials as f64);
        band(
            &chart,
            of.stages.iter().filter_map(|stage| {
                let error = error(stage)?;
                Some((at(stage), [share(stage, of) - error, share(stage, of) + error]))
            }),
        )?;
        let zero = [x.ends()[0], x.ends()[1]].map(|end| (end, 0.0));
        chart.plotting_area().draw(&PathElement::new(zero.to_vec(), stroke(AFTER, 1.5)))?;
        let path: Vec<(f64, f64)> =
            of.stages.iter().map(|stage| (at(stage), share(stage, of))).collect();
        chart.plotting_area().draw(&PathElement::new(path, stroke(INK, 1.0)))?;
        for stage in &of.stages {
            let place = (at(stage), share(stage, of));
            mark(&chart, 0, place, 2.5, (INK, Fill::Full))?;
            titles.at(&chart, place, &about(output, of.name, stage));
        }
        Ok(())
    };
    let drawn = |width: f64| {
        let across = if width < BESIDE { 1 } else { 2 };
        let down = settlings.len().div_ceil(across);
        svg_with_titles(width, TALL * down as f64, |area, titles| {
            for (area, of) in area.split_evenly((down, across)).iter().zip(&settlings) {
                panel(area, titles, of)?;
            }
            Ok(())
        })
    };
    let kind = if shortest { "shortest" } else { "symmetric" };
    let caption = format!(
        "Convergence: difference between the result after {} to {} trials (dots) and the result of \
         all {} trials (line), with ± one numerical standard error (band). The endpoints are those of \
         the {kind} coverage interval.",
        grouped(stages.first()?.trials),
        grouped(stages.get(stages.len() - 2)?.trials),
        grouped(last.trials),
    );
    Some(Drawing::new(caption, drawn))
}

/// The figures that there are at every stage.
fn settlings(stages: &[MonteCarlo], shortest: bool) -> Vec<Settling> {
    let of = |name, figure: &dyn Fn(&MonteCarlo) -> Option<(f64, f64)>| {
        let stage = |of: &MonteCarlo| {
            let (value, error) = figure(of).filter(|(value, _)| value.is_finite())?;
            Some(Stage { trials: of.trials, value, error })
        };
        let stages: Option<Vec<Stage>> = stages.iter().map(stage).collect();
        stages.map(|stages| Settling { name, stages })
    };
    let end = |which: usize| {
        move |of: &MonteCarlo| {
            let (ends, errors) = match shortest {
                true => (of.shortest_interval, of.errors.shortest_interval),
                false => (of.symmetric_interval, of.errors.symmetric_interval),
            };
            Some((ends[which], errors[which]))
        }
    };
    let estimate = of("estimate", &|of| Some((of.estimate?, of.errors.estimate?)));
    let median = || of("median", &|of| Some((of.median, of.errors.median)));
    let uncertainty = of("standard uncertainty", &|of| {
        Some((of.standard_uncertainty?, of.errors.standard_uncertainty.unwrap_or(f64::NAN)))
    });
    let ends = [of("lower endpoint", &end(0)), of("upper endpoint", &end(1))];
    let found = [estimate.or_else(median), uncertainty].into_iter().chain(ends);
    found.flatten().collect()
}

/// The area between two lines.
fn band(chart: &Chart<'_>, places: impl Iterator<Item = (f64, [f64; 2])>) -> Drawn {
    let places: Vec<(f64, [f64; 2])> = places.collect();
    if places.len() < 2 {
        return Ok(());
    }
    let low = places.iter().map(|(x, [low, _])| (*x, *low));
    let high = places.iter().rev().map(|(x, [_, high])| (*x, *high));
    let corners: Vec<(f64, f64)> = low.chain(high).collect();
    chart.plotting_area().draw(&Polygon::new(corners, EVEN.filled()))
}

/// A stage in words.
fn about(output: &Quantity, name: &str, stage: &Stage) -> String {
    let (value, error) = match stage.error.is_finite() {
        true => with_uncertainty(stage.value, stage.error, 1),
        false => (crate::number::significant(stage.value, 4), String::new()),
    };
    let value = if error.is_empty() { value } else { format!("({value} ± {error})") };
    let what = format!("{name} of {}", plain(&output.name));
    format!("{} trials: {what} {}", grouped(stage.trials), in_unit(&value, &output.unit))
}
