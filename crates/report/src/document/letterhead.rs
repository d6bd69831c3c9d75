//! The head of the first page of a certificate.

use gumption_analysis::certificate::contents::Picture;

/// Logo, name and address, and accreditation of who issues a document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Head {
    /// The logo, on the left.
    pub(crate) logo: Option<Picture>,
    /// Name and address, line by line.
    pub(crate) lines: Vec<String>,
    /// The mark of the accreditation body, on the right.
    pub(crate) mark: Option<Picture>,
    /// What stands below the mark.
    pub(crate) below_mark: Vec<String>,
    /// What the pictures show, for readers that cannot see them: logo, mark.
    pub(crate) described: [String; 2],
}

impl Head {
    /// The lines of the head in a page of text.
    pub(super) fn text(&self) -> Vec<String> {
        self.lines.iter().chain(&self.below_mark).cloned().collect()
    }
}
