//! What figures need, whether they are drawn on paper or in a terminal.

mod axis;
mod characters;
mod ink;
mod panel;
mod strip;
mod svg;

pub(super) use axis::Axis;
pub(super) use characters::{CharacterGrid, bars, cell_at};
pub(super) use ink::{AFTER, BEFORE, EVEN, INK, SHADES, WEAK};
pub(super) use panel::{Chart, Panel};
pub(super) use strip::{STRIP_AXIS, Strip, centred, faded, line, stroke};
pub(super) use svg::{Anchor, Area, Drawn, FONT, Write, px, shortened, svg, write};
