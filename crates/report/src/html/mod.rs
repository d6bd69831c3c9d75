//! Pages for a browser and for print: one file each, without scripts and without external content.

mod foot;
mod interactive;
mod mathml;
mod raised;
mod standalone;
mod table;

pub use interactive::{interactive, interactive_script_digest};
pub(super) use raised::raised;
pub(super) use table::table;

use super::document::Foot;
use super::printed::{Notation, in_print, notation};
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// The style of pages, in light and dark mode and on A4.
const STYLE: &str = include_str!("style.css");

/// Only the page's own style and the pictures in it are loaded, whatever names a user chose.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

/// A whole page in a language, a code of ISO 639-1, with a footer for printed pages.
pub(super) fn page_in(language: &str, title: &str, foot: &Foot, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(language) {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(foot::rule(foot))) }
            }
            body { main { (body) } }
        }
    };
    page.into_string() + "\n"
}

/// Widths of figures in pixels: for a page, and for a narrow screen.
const WIDTHS: [(&str, f64); 2] = [("wide", 720.0), ("narrow", 360.0)];

/// A figure with its caption, drawn once for each of [`WIDTHS`], with text of one size.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    pictures: [String; 2],
    caption: String,
}

impl Drawing {
    /// A figure for which `draw` returns an `svg` element with a width in pixels.
    pub(super) fn new(caption: String, draw: impl Fn(f64) -> String) -> Self {
        // figures have the notation of print also where the page has that of files
        let notation = match notation() {
            Notation::File => Notation::Print,
            other => other,
        };
        let pictures = in_print(notation, || WIDTHS.map(|(_, width)| draw(width)));
        Self { pictures, caption }
    }

    /// Its caption.
    pub(super) fn caption(&self) -> &str {
        &self.caption
    }

    /// The figure for a page as an SVG file that needs nothing else.
    pub(super) fn standalone(&self) -> String {
        let [wide, _] = &self.pictures;
        standalone::standalone(wide, &self.caption)
    }
}

/// A figure with its number and caption.
pub(super) fn figure(number: usize, drawing: &Drawing) -> Markup {
    let id = format!("figure-{number}");
    html! {
        figure {
            @for ((class, _), picture) in WIDTHS.iter().zip(&drawing.pictures) {
                // one picture with its caption, instead of many tick labels that are read out one
                // by one
                @let named = format!("<svg class=\"{class}\" role=\"img\" aria-labelledby=\"{id}\" ");
                (PreEscaped(picture.replacen("<svg ", &named, 1)))
            }
            figcaption id=(id) { b { "Figure " (number) "." } " " (drawing.caption) }
        }
    }
}

/// The size of figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FigureSize {
    /// For a page: drawn for its width, and for a narrow screen.
    #[default]
    Page,
    /// For a column beside others: drawn for a narrow screen.
    Narrow,
}

/// A figure without a number: the caption names the picture.
pub(super) fn bare_figure(drawing: &Drawing, size: FigureSize) -> Markup {
    let label = html! { (drawing.caption) }.into_string().replace('"', "&quot;");
    let pictures = WIDTHS.iter().zip(&drawing.pictures);
    let pictures = pictures.skip(usize::from(size == FigureSize::Narrow));
    html! {
        figure {
            @for ((class, _), picture) in pictures {
                // the only picture is shown on every screen
                @let class = if size == FigureSize::Narrow { "only" } else { class };
                @let named = format!("<svg class=\"{class}\" role=\"img\" aria-label=\"{label}\" ");
                (PreEscaped(picture.replacen("<svg ", &named, 1)))
            }
            figcaption { (drawing.caption) }
        }
    }
}

/// A formula as MathML in the notation of print; a text that is no formula, as it is.
///
/// ```
/// let html = gumption_report::equation_html("m/V");
/// assert!(html.contains("<mfrac><mi>m</mi><mi>V</mi></mfrac>"), "{html}");
/// ```
pub fn equation_html(formula: &str) -> String {
    in_print(Notation::Print, || mathml::equation(formula).into_string())
}

/// The style sheet of pages, for a page that contains parts of them ([`crate::page_parts`]).
pub fn page_style() -> &'static str {
    STYLE
}

#[cfg(test)]
mod tests {
    use super::STYLE;

    /// The colours of the light and of the dark page.
    fn colours(name: &str) -> Vec<[f64; 3]> {
        let values = STYLE.lines().filter_map(|line| {
            line.trim().strip_prefix(&format!("--{name}: #"))?.strip_suffix(';')
        });
        let channel = |hex: &str, place: usize| {
            let value = f64::from(u8::from_str_radix(&hex[2 * place..2 * place + 2], 16).unwrap());
            let value = value / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        values.map(|hex| [0, 1, 2].map(|place| channel(hex, place))).collect()
    }

    /// The contrast ratio of WCAG 2.2.
    fn contrast(a: [f64; 3], b: [f64; 3]) -> f64 {
        let light = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let [a, b] = [light(a), light(b)];
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// WCAG 2.2: 1.4.3 requires 4.5 for text, 1.4.11 requires 3 for the essential parts of a
    /// figure.
    #[test]
    fn text_and_lines_stand_out() {
        for scheme in [0, 1] {
            let colour = |name: &str| colours(name)[scheme];
            for text in ["ink", "weak"] {
                let found = contrast(colour(text), colour("paper"));
                assert!(found >= 4.5, "{text}, scheme {scheme}: {found}");
            }
            for line in ["before", "after", "edge"] {
                let found = contrast(colour(line), colour("paper"));
                assert!(found >= 3.0, "{line}, scheme {scheme}: {found}");
            }
            // intervals are drawn across bars
            let found = contrast(colour("after"), colour("even"));
            assert!(found >= 3.0, "after on even, scheme {scheme}: {found}");
        }
    }
}
