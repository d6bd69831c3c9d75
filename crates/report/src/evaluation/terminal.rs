//! The distribution of an output in a terminal, without colours: it reads on dark and on light.

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::Style;
use ratatui_core::widgets::Widget;
use ratatui_widgets::sparkline::Sparkline;

use super::Shown;
use crate::plot::Axis;
use crate::table::{conditions_text, grouped, title_text};
use crate::{Report, wrapped};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::monte_carlo::Histogram;

/// Columns left of the bars, and rows of the bars.
const LEFT: u16 = 16;
const HEIGHT: u16 = 10;

/// The histograms of all rows, each below an empty line; nothing where none is shown.
pub fn histograms(report: &Report<'_>, shown: &Shown<'_>) -> String {
    let Report { task, evaluation, .. } = *report;
    let mut page = String::new();
    for (row, (found, histograms)) in evaluation.rows.iter().zip(shown.histograms).enumerate() {
        if evaluation.rows.len() > 1 && !histograms.is_empty() {
            let at = conditions_text(&task.model.conditions, &found.conditions);
            page += &format!("\n{}", wrapped(&format!("at {at}")));
        }
        for (place, output) in task.model.outputs.iter().enumerate() {
            let counts = shown.histogram(row, place);
            if let Some((counts, found)) = counts.zip(found.outputs.get(place)) {
                page += &format!("\n{}", histogram(&output.quantity, found, counts));
            }
        }
    }
    page
}

/// The histogram of an output as lines of at most 100 columns: bars, an axis with its marks, and the
/// coverage intervals of both methods below.
fn histogram(output: &Quantity, found: &OutputEvaluation, counts: &Histogram) -> String {
    let about = Quantity { about: String::new(), ..output.clone() };
    let title = format!("{}: {} trials", title_text(&about), grouped(counts.trials()));
    let width = u16::try_from(counts.counts.len()).unwrap_or(u16::MAX - LEFT);
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
    let rows = HEIGHT + 2 + intervals.len() as u16;
    let mut buffer = Buffer::empty(Rect::new(0, 0, LEFT + width, rows));
    let bars = Sparkline::default().data(counts.counts.iter().copied());
    bars.render(Rect::new(LEFT, 0, width, HEIGHT), &mut buffer);
    marks(&mut buffer, counts, width);
    for (row, (name, interval)) in intervals.iter().enumerate() {
        let row = HEIGHT + 2 + row as u16;
        let name_width = usize::from(LEFT) - 2;
        buffer.set_string(0, row, format!("{name:>name_width$}"), Style::new());
        let [from, to] = interval.map(|end| column(counts, width, end));
        for place in from..=to {
            let part = match place {
                _ if place == from => "├",
                _ if place == to => "┤",
                _ => "─",
            };
            buffer.set_string(place, row, part, Style::new());
        }
    }
    wrapped(&title) + &lines(&buffer)
}

/// The column in which a value stands; beyond the bars the nearest.
fn column(counts: &Histogram, width: u16, value: f64) -> u16 {
    let share = (value - counts.low) / (counts.high() - counts.low);
    let place = (share * f64::from(width)).floor().clamp(0.0, f64::from(width.saturating_sub(1)));
    LEFT + place as u16
}

/// The axis and its marks.
fn marks(buffer: &mut Buffer, counts: &Histogram, width: u16) {
    buffer.set_string(LEFT, HEIGHT, "─".repeat(usize::from(width)), Style::new());
    let axis = Axis::linear(counts.low, counts.high());
    let mut free = 0;
    for (value, text) in axis.marks(8) {
        let at = column(counts, width, value);
        let length = text.chars().count() as u16;
        let from = at.saturating_sub(length / 2);
        if from < free || from + length > LEFT + width {
            continue;
        }
        free = from + length + 2;
        buffer.set_string(at, HEIGHT, "┬", Style::new());
        buffer.set_string(from, HEIGHT + 1, &text, Style::new());
    }
}

fn lines(buffer: &Buffer) -> String {
    let rows = buffer.content().chunks(usize::from(buffer.area.width).max(1));
    rows.map(|cells| {
        let line: String = cells.iter().map(ratatui_core::buffer::Cell::symbol).collect();
        line.trim_end().to_owned() + "\n"
    })
    .collect()
}
