//! Headings of parts of the help that clap does not write.

use clap::builder::Styles;

/// A heading in the style of those that clap writes, and a newline.
pub(super) fn heading(text: &str) -> String {
    let styles = Styles::styled();
    let style = styles.get_header();
    format!("{style}{text}:{style:#}\n")
}
