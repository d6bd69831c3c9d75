//! The footer of printed pages.

use crate::document::{Foot, FootPart};

/// The rule for the margins of printed pages.
pub(super) fn rule(foot: &Foot) -> String {
    let page = foot.parts().into_iter().map(|part| match part {
        FootPart::Text(text) => quoted(text),
        FootPart::Page => "counter(page)".to_owned(),
        FootPart::Pages => "counter(pages)".to_owned(),
    });
    let page = page.collect::<Vec<_>>().join(" ");
    let about = quoted(&foot.about);
    format!("@page {{ @bottom-left {{ content: {about}; }} @bottom-right {{ content: {page}; }} }}")
}

/// A text in CSS: characters that could end the text or the style sheet are written as codes.
fn quoted(text: &str) -> String {
    let letters = text.chars().filter(|c| !c.is_control()).map(|c| match c {
        '"' | '\\' | '<' | '>' | '&' | '@' | '{' | '}' => format!("\\{:06x}", u32::from(c)),
        c => c.to_string(),
    });
    format!("\"{}\"", letters.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_cannot_leave_the_style_sheet() {
        assert_eq!(
            quoted("a </style> \" \\ b"),
            "\"a \\00003c/style\\00003e \\000022 \\00005c b\""
        );
    }
}
