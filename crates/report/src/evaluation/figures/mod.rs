//! The figures of an evaluation.

mod convergence;
mod distribution;
mod inputs;
mod scatter;
mod shares;
mod sweep;

pub(super) use convergence::convergence;
pub(super) use distribution::distribution;
pub(super) use inputs::{inputs, picture};
pub(super) use scatter::scatter;
pub use scatter::trials_of_pairs;
pub(super) use shares::shares;
pub(super) use sweep::sweep;

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
