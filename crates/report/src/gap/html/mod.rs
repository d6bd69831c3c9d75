//! Figures of the page, and the page for a browser and for print.

mod bars;
mod intervals;
mod overlay;
mod predictions;
mod residuals;
mod shares;
mod shrinkage;
mod where_map;

pub(super) use bars::draw as bars;
pub(super) use intervals::draw as intervals;
pub(super) use overlay::draw as overlay;
pub(super) use predictions::draw as predictions;
pub(super) use residuals::draw as residuals;
pub(super) use shares::draw as shares;
pub(super) use shrinkage::draw as shrinkage;
pub(super) use where_map::draw as where_map;

pub(crate) use crate::html::Drawing;
use crate::{Provenance, document};
use gumption_gap::Diagnosis;

/// The diagnosis as one HTML file with figures that needs nothing else: it loads nothing and runs
/// nothing, reads in light and dark and prints on A4.
pub fn html(diagnosis: &Diagnosis, provenance: &Provenance) -> String {
    document::html(|| super::page::document(diagnosis, provenance, false))
}
