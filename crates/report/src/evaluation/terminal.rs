//! The distribution of an output in a terminal, without colours: it reads on dark and on light.

use crate::number::{exact, position, to};
use crate::plot::{Axis, CharacterGrid};
use crate::printed::grouped;
use crate::table::{text_width, title_text};
use crate::wrapped;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::monte_carlo::Histogram;

/// Columns left of the bars, and rows of the bars.
const LEFT: usize = 16;
const HEIGHT: usize = 10;

/// The same with as many bins in one as the page asks for.
fn narrowed(counts: &Histogram) -> Histogram {
    let room = text_width().saturating_sub(LEFT).max(1);
    let together = counts.counts.len().div_ceil(room).max(1);
    Histogram {
        width: counts.width * together as f64,
        counts: counts.counts.chunks(together).map(|bins| bins.iter().sum()).collect(),
        ..counts.clone()
    }
}

/// An interval below the bars.
struct IntervalLine {
    name: &'static str,
    /// Its ends, infinite where it has none.
    ends: [f64; 2],
    /// Whether its ends are written as they are stated, or else to what the axis tells apart.
    is_stated: bool,
}

/// The coverage intervals of both methods, and the limits of an output with a tolerance.
fn intervals(found: &OutputEvaluation) -> Vec<IntervalLine> {
    let figures = found.monte_carlo.as_deref();
    let conformity = found.conformity.as_deref();
    let guarded = conformity.filter(|of| of.is_guarded());
    let computed = [
        ("GUM", found.gum.as_ref().and_then(Gum::interval)),
        ("MC, symmetric", figures.map(|figures| figures.symmetric_interval)),
        ("MC, shortest", figures.map(|figures| figures.shortest_interval)),
    ];
    let limits = [
        ("tolerance", conformity.map(|of| of.tolerance.ends()), true),
        ("acceptance", guarded.and_then(|of| of.acceptance).map(|of| of.ends()), false),
    ];
    let computed = computed.map(|(name, ends)| (name, ends, false));
    computed
        .into_iter()
        .chain(limits)
        .filter_map(|(name, ends, is_stated)| Some(IntervalLine { name, ends: ends?, is_stated }))
        .collect()
}

/// The histogram of an output as lines of at most 100 columns: bars, an axis with its marks, and below
/// them the coverage intervals of both methods, the tolerance and the limits of acceptance.
pub(super) fn histogram(output: &Quantity, found: &OutputEvaluation, counts: &Histogram) -> String {
    let counts = &narrowed(counts);
    let about = Quantity { about: String::new(), ..output.clone() };
    let title = format!("{}: {} trials", title_text(&about), grouped(counts.trials()));
    let width = counts.counts.len();
    let intervals = intervals(found);
    let mut grid = CharacterGrid::new(LEFT + width, HEIGHT + 2 + intervals.len());
    let most = counts.counts.iter().copied().max().unwrap_or(0).max(1);
    for (bar, count) in counts.counts.iter().enumerate() {
        // rounded down, in integers of more bits than counts have
        let eighths = u128::from(*count) * (8 * HEIGHT as u128) / u128::from(most);
        grid.bar(LEFT + bar, HEIGHT - 1, eighths as usize);
    }
    marks(&mut grid, counts, width);
    for (row, interval) in (HEIGHT + 2..).zip(&intervals) {
        let name_width = LEFT - 2;
        grid.write(0, row, &format!("{:>name_width$}", interval.name));
        line(&mut grid, (counts, width), row, interval);
    }
    wrapped(&title) + &grid.lines()
}

/// An interval: a bracket at each end that lies among the bars, an arrow with its number for each
/// finite one that lies beyond them.
fn line(
    grid: &mut CharacterGrid,
    (counts, width): (&Histogram, usize),
    row: usize,
    interval: &IntervalLine,
) {
    let ends = interval.ends;
    let [first, last] = [counts.low, counts.high()];
    let place = position((ends[1] - ends[0]).min(last - first), 3);
    let number = |end: f64| if interval.is_stated { exact(end) } else { to(end, place) };
    let beyond = |is_beyond: &dyn Fn(f64) -> bool| {
        let finite = ends.into_iter().filter(|end| end.is_finite() && is_beyond(*end));
        finite.map(number).collect::<Vec<_>>().join(" … ")
    };
    let [left, right] = [beyond(&|end| end < first), beyond(&|end| end > last)];
    if ends[0] <= last && ends[1] >= first {
        let columns = ends.map(|end| column(counts, width, end));
        (columns[0]..=columns[1]).for_each(|position| grid.put(position, row, '─'));
        for (end, (column, bracket)) in ends.into_iter().zip(columns.into_iter().zip(['├', '┤']))
        {
            if (first..=last).contains(&end) {
                grid.put(column, row, bracket);
            }
        }
    }
    if !left.is_empty() {
        grid.write(LEFT, row, &format!("← {left} "));
    }
    if !right.is_empty() {
        let text = format!(" {right} →");
        grid.write((LEFT + width).saturating_sub(text.chars().count()), row, &text);
    }
}

/// The column in which a value stands; beyond the bars the nearest.
fn column(counts: &Histogram, width: usize, value: f64) -> usize {
    let share = (value - counts.low) / (counts.high() - counts.low);
    LEFT + (share * width as f64).floor().clamp(0.0, width.saturating_sub(1) as f64) as usize
}

/// The axis and its marks.
fn marks(grid: &mut CharacterGrid, counts: &Histogram, width: usize) {
    grid.write(LEFT, HEIGHT, &"─".repeat(width));
    let axis = Axis::linear(counts.low, counts.high());
    let mut free = 0;
    for (value, text) in axis.marks(8) {
        let at = column(counts, width, value);
        let length = text.chars().count();
        let from = at.saturating_sub(length / 2);
        if from < free || from + length > LEFT + width {
            continue;
        }
        free = from + length + 2;
        grid.put(at, HEIGHT, '┬');
        grid.write(from, HEIGHT + 1, &text);
    }
}
