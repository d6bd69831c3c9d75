//! Pages for a browser and for print: one file each, without scripts and without anything from
//! elsewhere.

mod foot;
mod raised;
mod table;

pub(super) use raised::raised;
pub(super) use table::table;

use super::document::Foot;
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// How pages look, in light and dark and on A4.
const STYLE: &str = include_str!("style.css");

/// Nothing but the page's own style is loaded or run, whatever names a user chose.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'";

/// A whole page in English, which its title names on every sheet of paper.
pub(super) fn page(title: &str, body: &Markup) -> String {
    page_in("en", title, &Foot::of_title(title), body)
}

/// A whole page in a language, a code of ISO 639-1, with what stands at the foot of printed pages.
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
            body { (body) }
        }
    };
    page.into_string() + "\n"
}

/// Width of all figures in pixels.
pub(crate) const WIDTH: f64 = 720.0;

/// A figure with what is written below it.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    pub(super) svg: String,
    pub(super) caption: String,
}

/// A figure with its number and caption; the drawing is an `svg` element.
pub(super) fn figure(number: usize, drawing: String, caption: &str) -> Markup {
    html! {
        figure {
            (PreEscaped(drawing))
            figcaption { b { "Figure " (number) "." } " " (caption) }
        }
    }
}
