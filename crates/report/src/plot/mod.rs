//! Parts of figures, for paper and for terminals.

mod axis;
mod characters;
mod groups;
mod ink;
mod marks;
mod panel;
mod strip;
mod svg;

pub(super) use axis::Axis;
pub(super) use characters::{CharacterGrid, bars, cell_at, horizontal_bar};
pub(super) use groups::Groups;
pub(super) use ink::{AFTER, BEFORE, EVEN, FAINT, INK, SHADES, WEAK};
pub(super) use marks::{Fill, mark};
pub(super) use panel::{Chart, Panel};
pub(super) use strip::{
    CHROME, STRIP_AXIS, Strip, WIDER, axis_of_bars, centred, dashed, faded, line, stroke,
};
pub(super) use svg::{
    Anchor, Area, Drawn, FONT, Layer, Titles, Write, length, px, shortened, svg, svg_in_layers,
    svg_with_titles, text_style, write,
};
