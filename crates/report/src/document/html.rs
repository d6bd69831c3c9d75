//! A document as one HTML file that needs nothing else.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gumption_analysis::certificate::contents::Picture;
use maud::{Markup, html};

use super::{Block, Document, Head};
use crate::html::{FigureSize, bare_figure, figure, page_in, raised, table};
use crate::printed::{Notation, in_print, notation};

/// Numbers of sections for which a page has a table of contents: fewer are visible at once, more do
/// not help.
const LISTED: std::ops::RangeInclusive<usize> = 8..=60;

/// The whole page of the document that `made` makes, in the notation of print.
pub(crate) fn html(made: impl FnOnce() -> Document) -> String {
    in_print(Notation::Print, || page(&made()))
}

fn page(document: &Document) -> String {
    let mut counts = Counts::default();
    let body = html! {
        @if let Some(head) = &document.head { (self::head(head)) }
        h1 { (document.title) }
        @for line in &document.subtitle { p.settings { (raised(line)) } }
        (contents(document))
        @for part in &document.blocks { (block(part, document.comma, &mut counts)) }
    };
    let language = if document.language.is_empty() { "en" } else { document.language };
    page_in(language, &document.title, &document.foot(), &body)
}

/// Counters of figures and tables.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    sections: usize,
    figures: usize,
}

/// The titles of the sections with links, if there are many.
fn contents(document: &Document) -> Markup {
    let titles = document.blocks.iter().filter_map(|block| match block {
        Block::Section(title) => Some(title),
        _ => None,
    });
    let titles: Vec<&String> = titles.collect();
    html! {
        @if LISTED.contains(&titles.len()) {
            nav aria-label="Contents" {
                @for (place, title) in titles.iter().enumerate() {
                    // the section already names its quantity
                    @let name = title.split_once(": ").map_or(title.as_str(), |(name, _)| name);
                    a href={ "#section-" (place + 1) } { (raised(name)) } " "
                }
            }
        }
    }
}

/// The blocks of a document alone, for a page with the same style; figures are not numbered,
/// because the page may have others.
pub(crate) fn fragment(document: &Document, size: FigureSize) -> String {
    let has_comma = document.comma || notation() == Notation::PrintWithComma;
    let part = |part: &Block| match part {
        Block::Figure(drawing) => bare_figure(drawing, size),
        part => block(part, has_comma, &mut Counts::default()),
    };
    html! { @for one in &document.blocks { (part(one)) } }.into_string()
}

fn block(block: &Block, comma: bool, counts: &mut Counts) -> Markup {
    match block {
        Block::Section(title) => {
            counts.sections += 1;
            html! { h2 id={ "section-" (counts.sections) } { (raised(title)) } }
        }
        Block::Text(text) => html! { p { (raised(text)) } },
        // screen readers need the language (WCAG 2.1, 3.1.2)
        Block::InLanguage(language, part) => match part.as_ref() {
            Block::Text(text) => html! { p lang=(language) { (raised(text)) } },
            Block::List(items) => html! {
                ul lang=(language) { @for item in items { li { (raised(item)) } } }
            },
            part => html! { div lang=(language) { (self::block(part, comma, counts)) } },
        },
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
                @for part in blocks { (self::block(part, comma, counts)) }
            }
        },
        Block::Figure(drawing) => {
            counts.figures += 1;
            figure(counts.figures, drawing)
        }
        Block::Characters(_) => html! {},
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

/// The head as a part of an HTML page, with its pictures in it.
fn head(of: &Head) -> Markup {
    let picture = |picture: &Option<Picture>, about: &str| {
        let picture = picture.as_ref()?;
        let (kind, data) = (picture.format.media_type(), STANDARD.encode(&picture.bytes));
        Some(html! { img src={ "data:" (kind) ";base64," (data) } alt=(about); })
    };
    let [logo, mark] = &of.described;
    html! {
        header.letterhead {
            @if let Some(logo) = picture(&of.logo, logo) { div.logo { (logo) } }
            address { @for line in &of.lines { span { (line) } } }
            @if of.mark.is_some() || !of.below_mark.is_empty() {
                div.accreditation {
                    @if let Some(mark) = picture(&of.mark, mark) { (mark) }
                    @for line in &of.below_mark { span { (line) } }
                }
            }
        }
    }
}
