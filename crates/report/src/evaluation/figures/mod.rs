//! The figures of an evaluation.

mod distribution;
mod inputs;
mod shares;
mod sweep;

pub(super) use distribution::distribution;
pub(super) use inputs::{inputs, picture};
pub(super) use shares::shares;
pub(super) use sweep::sweep;

use crate::html::WIDTH;
use plotters::element::PathElement;
use plotters::style::ShapeStyle;

use crate::plot::{Area, Drawn, px};

/// A line through any number of places in pixels.
fn curve(area: &Area<'_>, places: &[(f64, f64)], style: ShapeStyle) -> Drawn {
    if places.len() < 2 {
        return Ok(());
    }
    let places: Vec<(i32, i32)> = places.iter().map(|&(x, y)| (px(x), px(y))).collect();
    area.draw(&PathElement::new(places, style))
}

/// How much room a figure has: figures are scaled to it, and their words with them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FigureSize {
    /// That of a page.
    #[default]
    Page,
    /// That of a column beside others, or of a phone.
    Narrow,
}

impl FigureSize {
    /// The width in pixels.
    fn width(self) -> f64 {
        match self {
            Self::Page => WIDTH,
            Self::Narrow => 440.0,
        }
    }

    /// Space for the names of intervals.
    fn names(self) -> f64 {
        match self {
            Self::Page => 185.0,
            Self::Narrow => 100.0,
        }
    }

    /// The name of an interval in that space.
    fn name(self, name: &'static str) -> &'static str {
        match self {
            Self::Page => name,
            Self::Narrow => name.strip_prefix("Monte Carlo, ").unwrap_or(name),
        }
    }
}
