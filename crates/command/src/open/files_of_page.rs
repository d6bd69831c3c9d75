//! The files of the page.

use gumption_server::ServedAsset;

/// All of them.
pub(super) fn all() -> Vec<ServedAsset> {
    Vec::new()
}
