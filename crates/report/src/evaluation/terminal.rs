//! The distribution of an output in a terminal, without colours: it reads on dark and on light.

use crate::number::{position, to};
use crate::plot::{Axis, CharacterGrid};
use crate::table::{grouped, text_width, title_text};
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

/// The histogram of an output as lines of at most 100 columns: bars, an axis with its marks, and the
/// coverage intervals of both methods below.
pub(super) fn histogram(output: &Quantity, found: &OutputEvaluation, counts: &Histogram) -> String {
    let counts = &narrowed(counts);
    let about = Quantity { about: String::new(), ..output.clone() };
    let title = format!("{}: {} trials", title_text(&about), grouped(counts.trials()));
    let width = counts.counts.len();
    let gum = found.gum.as_ref().and_then(Gum::interval);
    let figures = found.monte_carlo.as_ref();
    let intervals: Vec<(&str, [f64; 2])> = [
        ("GUM", gum),
        ("MC, symmetric", figures.map(|figures| figures.symmetric_interval)),
        ("MC, shortest", figures.map(|figures| figures.shortest_interval)),
    ]
    .into_iter()
    .filter_map(|(name, interval)| Some((name, interval?)))
    .collect();
    let mut grid = CharacterGrid::new(LEFT + width, HEIGHT + 2 + intervals.len());
    let most = counts.counts.iter().copied().max().unwrap_or(0).max(1);
    for (bar, count) in counts.counts.iter().enumerate() {
        // rounded down, in integers of more bits than counts have
        let eighths = u128::from(*count) * (8 * HEIGHT as u128) / u128::from(most);
        grid.bar(LEFT + bar, HEIGHT - 1, eighths as usize);
    }
    marks(&mut grid, counts, width);
    for (row, (name, interval)) in (HEIGHT + 2..).zip(&intervals) {
        let name_width = LEFT - 2;
        grid.write(0, row, &format!("{name:>name_width$}"));
        line(&mut grid, (counts, width), row, *interval);
    }
    wrapped(&title) + &grid.lines()
}

/// An interval: a bracket at each end that lies among the bars, an arrow with its number for each that
/// lies beyond them.
fn line(
    grid: &mut CharacterGrid,
    (counts, width): (&Histogram, usize),
    row: usize,
    ends: [f64; 2],
) {
    let [first, last] = [counts.low, counts.high()];
    let place = position(ends[1] - ends[0], 3);
    let beyond = |is_beyond: &dyn Fn(f64) -> bool| {
        let numbers = ends.into_iter().filter(|end| is_beyond(*end)).map(|end| to(end, place));
        numbers.collect::<Vec<_>>().join(" … ")
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
