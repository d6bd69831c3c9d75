//! The page as GitHub and editors show it.

use crate::{Provenance, document};
use gumption_gap::Diagnosis;

/// The diagnosis as GitHub Flavored Markdown: what the page says. It has figures within
/// [`crate::with_figures`].
pub fn markdown(diagnosis: &Diagnosis, provenance: &Provenance) -> String {
    document::markdown(|| super::page::document(diagnosis, provenance, false))
}
