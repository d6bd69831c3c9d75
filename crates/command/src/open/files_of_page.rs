//! The files of the page.

use gumption_live::page;
use gumption_server::ServedAsset;

/// All of them.
pub(super) fn all() -> Vec<ServedAsset> {
    let served = |asset: page::PageAsset| ServedAsset {
        name: asset.name,
        content_type: asset.content_type,
        content: asset.text.as_bytes(),
    };
    page::all().into_iter().map(served).collect()
}
