//! A document as one HTML file that needs nothing else.

use maud::{Markup, html};

use super::{Block, Document};
use crate::html::{figure, page_in, raised, table};

/// The whole page.
pub(crate) fn html(document: &Document) -> String {
    let mut figures = 0;
    let body = html! {
        h1 { (document.title) }
        @for line in &document.subtitle { p.settings { (line) } }
        @for part in &document.blocks { (block(part, document.comma, &mut figures)) }
    };
    let language = if document.language.is_empty() { "en" } else { document.language };
    page_in(language, &document.title, &document.foot(), &body)
}

/// The blocks of a document alone, to stand in a page with the same style; figures are not numbered,
/// because the page may have others.
pub(crate) fn fragment(document: &Document) -> String {
    let part = |part: &Block| match part {
        Block::Figure(drawing) => crate::html::bare_figure(&drawing.svg, &drawing.caption),
        part => block(part, document.comma, &mut 0),
    };
    html! { @for one in &document.blocks { (part(one)) } }.into_string()
}

fn block(block: &Block, comma: bool, figures: &mut usize) -> Markup {
    match block {
        Block::Section(title) => html! { h2 { (raised(title)) } },
        Block::Text(text) => html! { p { (raised(text)) } },
        Block::Verdict(sentences) => html! {
            div.verdict {
                @for (place, sentence) in sentences.iter().enumerate() {
                    @let sentence = raised(sentence);
                    @if place == 0 { p { strong { (sentence) } } } @else { p { (sentence) } }
                }
            }
        },
        Block::List(items) => html! { ul { @for item in items { li { (raised(item)) } } } },
        Block::Table(sheet) if comma => table(&sheet.clone().with_commas()),
        Block::Table(sheet) => table(sheet),
        Block::Folded(title, blocks) => html! {
            details {
                summary { (raised(title)) }
                @for part in blocks { (self::block(part, comma, figures)) }
            }
        },
        Block::Figure(drawing) => {
            *figures += 1;
            figure(*figures, drawing.svg.clone(), &drawing.caption)
        }
        Block::Signature(places) => html! {
            div.signature { @for place in places { p { (place) } } }
        },
        Block::End(text) => html! { p.end { (text) } },
        Block::Listing { about, text } => html! {
            p { (about) }
            pre { code { (text) } }
        },
    }
}
