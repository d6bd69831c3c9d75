//! Texts with exponents and code.

use maud::{Markup, html};

/// A text in which whole exponents, as in `m/s^2`, are raised, and text between backticks is shown
/// as code.
pub(crate) fn raised(text: &str) -> Markup {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return exponents(text);
    }
    html! {
        @for (place, part) in parts.into_iter().enumerate() {
            @if place % 2 == 1 { code { (part) } } @else { (exponents(part)) }
        }
    }
}

fn exponents(text: &str) -> Markup {
    let mut parts = text.split('^');
    let first = parts.next().unwrap_or_default();
    html! {
        (first)
        @for part in parts {
            @let sign = usize::from(part.starts_with('-'));
            @let digits = part.bytes().skip(sign).take_while(u8::is_ascii_digit).count();
            @if digits == 0 {
                "^" (part)
            } @else {
                @let (power, rest) = part.split_at(sign + digits);
                sup { (power.replace('-', "\u{2212}")) } (rest)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_exponents_are_raised() {
        let shown = |text: &str| raised(text).into_string();
        assert_eq!(shown("m/s^2"), "m/s<sup>2</sup>");
        assert_eq!(shown("kg*m^-3*K"), "kg*m<sup>\u{2212}3</sup>*K");
        assert_eq!(shown("a^b <c>^"), "a^b &lt;c&gt;^");
    }

    #[test]
    fn what_a_file_says_is_set_apart() {
        let shown = |text: &str| raised(text).into_string();
        assert_eq!(shown("`a_x`: 5 m^2"), "<code>a_x</code>: 5 m<sup>2</sup>");
        assert_eq!(shown("`<a>` and `b^2`"), "<code>&lt;a&gt;</code> and <code>b^2</code>");
        assert_eq!(shown("a ` alone"), "a ` alone");
    }
}
