//! Texts with code.

use maud::{Markup, html};

use crate::printed;

/// A text in the notation of the page, in which text between backticks is shown as code.
pub(crate) fn raised(text: &str) -> Markup {
    let text = printed::text(text);
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return html! { (text) };
    }
    html! {
        @for (place, part) in parts.into_iter().enumerate() {
            @if place % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printed::{Notation, in_print};

    #[test]
    fn what_a_file_says_is_set_apart() {
        let shown = |text: &str| in_print(Notation::Print, || raised(text).into_string());
        assert_eq!(shown("`a_x`: 5 m^2"), "<code>a_x</code>: 5 m\u{b2}");
        assert_eq!(shown("`<a>` and `b^2`"), "<code>&lt;a&gt;</code> and <code>b^2</code>");
        assert_eq!(shown("a ` alone"), "a ` alone");
    }
}
