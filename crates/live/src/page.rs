//! The page: one file of markup, a style sheet, scripts as modules. Nothing of it is made while it is
//! served, and nothing is loaded from elsewhere.

/// A file of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PageAsset {
    /// Its name: the page itself is `index.html`, everything else is looked for in `assets/`.
    pub name: &'static str,
    /// What it is, for the header `Content-Type`.
    pub content_type: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! assets {
    ($($name:literal: $kind:literal,)*) => {
        &[$(PageAsset {
            name: $name,
            content_type: $kind,
            text: include_str!(concat!("../page/", $name)),
        },)*]
    };
}

/// The files of the page, without the style of the reports' parts ([`all`]).
const OWN: &[PageAsset] = assets! {
    "index.html": "text/html; charset=utf-8",
    "style.css": "text/css; charset=utf-8",
    "page.js": "text/javascript; charset=utf-8",
};

/// All files of the page.
pub fn all() -> Vec<PageAsset> {
    let report = PageAsset {
        name: "report.css",
        content_type: "text/css; charset=utf-8",
        text: gumption_report::page_style(),
    };
    OWN.iter().copied().chain([report]).collect()
}

/// The policy for the page: scripts and styles of its own alone, and none within the markup.
pub const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; \
    img-src 'self' data:; connect-src 'self'; frame-src 'self' blob:; worker-src 'self'; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
