//! A figure as an SVG file that needs no page.

use maud::{PreEscaped, html};

/// What the style sheet of a page says of a figure, in the colours of the light page.
const STYLE: &str = "text{font-family:system-ui,\"Segoe UI\",\"Helvetica Neue\",\"DejaVu Sans\",Arial,\
    sans-serif}[fill=\"#56B4E9\"]{fill:#cde6f7;stroke:#3a7fae;stroke-width:4}\
    [stroke=\"#56B4E9\"]{stroke:#3a7fae}";

/// How an invisible mark with a text for the pointer begins and ends.
const POINTED: [&str; 2] = ["<circle ", "</circle>"];

/// The picture with its style on white, its caption as its title, and without the texts for the
/// pointer, which viewers of pictures do not show.
pub(super) fn standalone(picture: &str, caption: &str) -> String {
    let drawn = without_pointer_texts(picture);
    let Some(end) = drawn.find('>') else { return drawn };
    let (open, rest) = drawn.split_at(end);
    let head = html! {
        title { (caption) }
        style { (PreEscaped(STYLE)) }
        rect width="100%" height="100%" fill="#ffffff" {}
    };
    let open = open.replacen("<svg ", "<svg role=\"img\" ", 1);
    format!("{open}>\n{}{}", head.into_string(), rest.strip_prefix('>').unwrap_or(rest))
}

/// The picture without invisible circles and their texts.
fn without_pointer_texts(picture: &str) -> String {
    let [begin, end] = POINTED;
    let mut left = String::with_capacity(picture.len());
    let mut rest = picture;
    while let Some(from) = rest.find(begin) {
        let (before, circle) = rest.split_at(from);
        left += before;
        let tag = circle.find('>').map_or(circle.len(), |tag| tag + 1);
        let is_pointed = circle[..tag].contains("fill=\"transparent\"");
        let to = match circle.find(end).filter(|_| is_pointed) {
            Some(to) => to + end.len(),
            None => {
                left += &circle[..tag];
                tag
            }
        };
        rest = &circle[to..];
    }
    left + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_style_is_that_of_a_light_page() {
        let page = include_str!("style.css");
        for (name, colour) in [("even", "#cde6f7"), ("edge", "#3a7fae")] {
            let first = page.lines().find(|line| line.trim().starts_with(&format!("--{name}:")));
            assert!(first.is_some_and(|line| line.contains(colour)), "{name}");
            assert!(STYLE.contains(colour));
        }
    }

    #[test]
    fn texts_for_the_pointer_are_left_out() {
        let picture = "<svg width=\"9\">\n<circle r=\"1\" fill=\"#000000\"/>\n\
                       <circle r=\"7\" fill=\"transparent\"><title>a</title></circle></svg>\n";
        let found = standalone(picture, "1 < 2");
        assert!(
            found.starts_with("<svg role=\"img\" width=\"9\">\n<title>1 &lt; 2</title><style>")
        );
        assert!(found.ends_with("\n<circle r=\"1\" fill=\"#000000\"/>\n</svg>\n"), "{found}");
    }
}
